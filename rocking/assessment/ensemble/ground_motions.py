"""GroundMotions: what the ground may have done under a structure."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from rocking.assessment.processings import is_raw, processed
from rocking.pulses import rotated
from rocking.records import Accelerogram, rotd
from rocking.records.rotation import aligned


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
        """Both horizontal components, and the direction in which their acceleration peaks. Raises RecordError.

        processing: as in `of`; the direction stays that of the components as they are.
        """
        turn = np.radians(rotd(first, second).azimuth)
        worst = rotated(first, second, turn)
        size = worst.acceleration.size
        names = (first.component or "first", second.component or "second", worst.component)
        horizontal: dict[tuple[str, str], Accelerogram] = {}
        for processed_as, (one, other) in _processings(processing, first, second).items():
            both = [replace(each, acceleration=each.acceleration[:size]) for each in (one, other)]
            turned = worst if (one, other) == (first, second) else rotated(one, other, turn)
            horizontal |= {
                (name, processed_as): motion for name, motion in zip(names, [*both, turned], strict=True)
            }
        return cls(horizontal, None if vertical is None else aligned(vertical, worst))

    @cached_property
    def directions(self) -> tuple[str, ...]:
        """The names of the directions."""
        return tuple(dict.fromkeys(direction for direction, _ in self.horizontal))

    @cached_property
    def processings(self) -> tuple[str, ...]:
        """The names of the processings."""
        return tuple(dict.fromkeys(processing for _, processing in self.horizontal))


def _processings(wanted: bool, *components: Accelerogram) -> dict[str, tuple[Accelerogram, ...]]:
    """The components by what their processing is named; those of raw ones that fit them all, if wanted."""
    if not wanted or not all(map(is_raw, components)):
        return {"": components}
    found = [processed(component) for component in components]
    return {
        name: tuple(each[name] for each in found) for name in found[0] if all(name in each for each in found)
    }
