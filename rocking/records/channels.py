"""Channels: those of one file under names that tell them apart, none of them twice."""

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace
from itertools import combinations

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.site import channel_warnings


def told_apart(records: Sequence[Accelerogram]) -> list[Accelerogram]:
    """Return the channels of a file, each with a component of its own and what is doubtful of it as warnings.

    One without a name is called after its place, "channel 1"; those that share a name get their place as well.
    Raises RecordError when one channel stands in the file twice: it was appended to itself.
    """
    for (i, a), (k, b) in combinations(enumerate(records, 1), 2):
        if a.component == b.component and _same(a.acceleration, b.acceleration):
            raise RecordError(
                f"channel {k} ({a.component or 'not named'}) repeats channel {i} number by number: the file is "
                "appended to itself; fetch it again."
            )
    shared = Counter(record.component for record in records)
    return [
        replace(
            record,
            component=_component(record.component, place, shared[record.component] > 1),
            warnings=(*record.warnings, *channel_warnings(record.component)),
        )
        for place, record in enumerate(records, 1)
    ]


def is_unnamed(record: Accelerogram) -> bool:
    """Whether the component is no more than the place of the channel in its file."""
    return not record.component or record.component.removeprefix("channel ").isdecimal()


def _component(name: str, place: int, shared: bool) -> str:
    if not name:
        return f"channel {place}"
    return f"{name} (channel {place})" if shared else name


def _same(a: np.ndarray, b: np.ndarray) -> bool:
    return bool(np.any(a)) and np.array_equal(a, b)
