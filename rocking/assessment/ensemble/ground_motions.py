"""GroundMotions: what the ground may have done under a structure, by direction and processing."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache
from types import MappingProxyType

import numpy as np

from rocking.errors import RecordError
from rocking.pulses import rotated
from rocking.records import Accelerogram
from rocking.records.processing import process, variants
from rocking.records.rotation import aligned

AS_IT_IS = "unchanged"
"""The variant that is the record itself."""


def is_raw(accelerogram: Accelerogram) -> bool:
    """Whether the record comes from a file that says it is uncorrected, whatever was done to it since."""
    return bool(accelerogram.source.path) and accelerogram.processed is False


DIRECTIONS = 8
"""Of the motion of two components, spread evenly over half a turn; the other half is that of the sign. Of 53 decided
verdicts over three directions, 7 went beyond their risk in 24."""


@lru_cache(maxsize=2)  # the two components of a record
def processed(accelerogram: Accelerogram) -> Mapping[str, Accelerogram]:
    """Return the record as each variant of the processing leaves it, by name, made once; those that do not fit are left
    out. The one AS_IT_IS is the same object.
    """
    records = {}
    for name, processing in variants().items():
        with suppress(RecordError):
            records[name] = process(accelerogram, processing)
    return MappingProxyType(records)


@dataclass(frozen=True, eq=False)
class GroundMotions:
    """What the ground may have done: at least one horizontal motion by direction and processing, and the vertical one.

    All have the same samples. The members are shared out evenly to directions and to processings, and half of them
    feel the vertical motion where there is one.
    """

    horizontal: Mapping[tuple[str, str], Accelerogram]
    vertical: Accelerogram | None = None

    @classmethod
    def of(
        cls, accelerogram: Accelerogram, vertical: Accelerogram | None = None, *, processing: bool = False
    ) -> "GroundMotions":
        """One component as it is; with `processing`, a raw one as each variant of its processing leaves it."""
        found = _processings(processing, accelerogram)
        horizontal = {(accelerogram.component, name): motions[0] for name, motions in found.items()}
        return cls(horizontal, vertical)

    @classmethod
    def of_pair(
        cls,
        first: Accelerogram,
        second: Accelerogram,
        vertical: Accelerogram | None = None,
        *,
        processing: bool = False,
    ) -> "GroundMotions":
        """Both horizontal components and the directions between them, DIRECTIONS in all. Raises RecordError.

        processing: as in `of`.
        """
        horizontal: dict[tuple[str, str], Accelerogram] = {}
        for processed_as, (one, other) in _processings(processing, first, second).items():
            for place in range(DIRECTIONS):
                motion = rotated(one, other, np.pi * place / DIRECTIONS)
                horizontal[_direction(place, first, second, motion), processed_as] = motion
        along = next(iter(horizontal.values()))
        return cls(horizontal, None if vertical is None else aligned(vertical, along))

    @cached_property
    def directions(self) -> tuple[str, ...]:
        """The names of the directions."""
        return tuple(dict.fromkeys(direction for direction, _ in self.horizontal))

    @cached_property
    def processings(self) -> tuple[str, ...]:
        """The names of the processings."""
        return tuple(dict.fromkeys(processing for _, processing in self.horizontal))


def _direction(place: int, first: Accelerogram, second: Accelerogram, motion: Accelerogram) -> str:
    """Its name: that of a component where it is one."""
    if place == 0:
        return first.component or "first"
    return (second.component or "second") if 2 * place == DIRECTIONS else motion.component


def _processings(wanted: bool, *components: Accelerogram) -> dict[str, tuple[Accelerogram, ...]]:
    """The components by what their processing is named; those of raw ones that fit them all, if wanted."""
    if not wanted or not all(map(is_raw, components)):
        return {"": components}
    found = [processed(component) for component in components]
    return {
        name: tuple(each[name] for each in found) for name in found[0] if all(name in each for each in found)
    }
