"""The possible motions of the ground under one record: its directions, its processings, the vertical motion."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from rocking.errors import RecordError
from rocking.floors.support import Support
from rocking.records import Accelerogram
from rocking.records.processing import process, variants
from rocking.records.rotation import aligned, rotate

AS_IT_IS = "unchanged"
"""Name of the processing that leaves a record as it is."""
DIRECTIONS = 8
"""Directions of the motion of two components, spread evenly over half a turn; the other half is that of the sign. The
target `calibrate_ensemble` holds their verdicts against draws over three times as many directions."""


@lru_cache(maxsize=2)  # the two components of a record
def processed(accelerogram: Accelerogram) -> Mapping[str, Accelerogram]:
    """Return the record after each variant of the processing, by name, but for those that do not fit the record.

    The one AS_IT_IS is the same object. The variants are computed once.
    """
    records = {}
    for name, processing in variants().items():
        with suppress(RecordError):
            records[name] = process(accelerogram, processing)
    return MappingProxyType(records)


@dataclass(frozen=True, eq=False)
class GroundMotions:
    """The possible motions of the ground: at least one horizontal by direction and processing, and the vertical one.

    All have the same samples.
    """

    horizontal: Mapping[tuple[str, str], Accelerogram]
    vertical: Accelerogram | None = None

    @classmethod
    def of(
        cls, *components: Accelerogram, vertical: Accelerogram | None = None, processing: bool = False
    ) -> "GroundMotions":
        """Return the motions of one component, or of two and the directions between them, DIRECTIONS in all.

        vertical: with one component it must have the same samples. processing: whether raw components enter after each
        variant of their processing. Raises RecordError for components that do not belong together.
        """
        raw = all(each.source.path and each.processed is False for each in components)
        variants_of = [processed(each) if processing and raw else {"": each} for each in components]
        names = [name for name in variants_of[0] if all(name in each for each in variants_of)]
        ends = {0: components[0].component or "first", DIRECTIONS // 2: components[-1].component or "second"}
        horizontal = {}
        for name in names:
            first, *others = (each[name] for each in variants_of)
            if not others:
                horizontal[first.component, name] = first
            for second in others:
                for place in range(DIRECTIONS):
                    motion = rotate(first, second, angle=np.pi * place / DIRECTIONS)
                    horizontal[ends.get(place, motion.component), name] = motion
        if vertical is not None and len(components) > 1:
            vertical = aligned(vertical, next(iter(horizontal.values())))
        return cls(horizontal, vertical)

    @property
    def directions(self) -> tuple[str, ...]:
        """The directions of the horizontal motion, by name."""
        return tuple(dict.fromkeys(direction for direction, _ in self.horizontal))

    @property
    def processings(self) -> tuple[str, ...]:
        """The processings of the horizontal motion, by name; "" for the one that the record has."""
        return tuple(dict.fromkeys(processing for _, processing in self.horizontal))

    def on(self, support: Support | None) -> "GroundMotions":
        """Return the motions as they arrive on a support; None: on the ground, as they are."""
        if support is None:
            return self
        horizontal = list(self.horizontal.values())
        if self.vertical is None:
            floors = support.motions(horizontal)
            return replace(self, horizontal=dict(zip(self.horizontal, floors, strict=True)))
        *floors_below, vertical = support.motions([*horizontal, replace(self.vertical, vertical=True)])
        of_each = dict(zip(self.horizontal, floors_below, strict=True))
        return replace(self, horizontal=of_each, vertical=vertical)

    def scaled(self, factor: float) -> "GroundMotions":
        """Return the motions with the horizontal ones multiplied by `factor`."""
        horizontal = {each: motion.scaled(factor) for each, motion in self.horizontal.items()}
        return replace(self, horizontal=horizontal)
