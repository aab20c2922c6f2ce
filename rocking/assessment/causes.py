"""The causes: the inputs of a case that nobody knows exactly, in which ranges they vary, and the points that draw them.

Each cause is uniform in its range and independent of the others. The ranges are assumptions, not measurements; the
ensemble says how sure an answer can be if they are right. A cause is either chance, which no survey of the structure
can remove, or ignorance, which a measurement can.

The points stand on rank-1 lattices, the smaller ones contained in the larger. To add a cause, put it into CAUSES with
the next component of the generating vector by the criterion stated there, and let `ensemble.drawn` use its values.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import lru_cache

import numpy as np

from rocking.assessment.motions import GroundMotions
from rocking.assessment.settings import SIZES, EnsembleSettings
from rocking.structures.mechanism import EquivalentBlock, Mechanism


class Origin(StrEnum):
    """Why an input is not known."""

    CHANCE = "chance"
    """It is another at the next earthquake."""
    IGNORANCE = "ignorance"
    """It has one value, which a measurement or a better record would tell."""


@dataclass(frozen=True)
class Interval:
    """All values within ± `half_width` of the `centre`."""

    centre: float
    half_width: float

    @property
    def varies(self) -> bool:
        """Whether it holds more than one value."""
        return self.half_width > 0

    def at(self, coordinates: np.ndarray) -> np.ndarray:
        """Return the values (m,) at coordinates (m,) in (0, 1)."""
        return self.centre + self.half_width * (2 * coordinates - 1)


@dataclass(frozen=True)
class Options:
    """A few values, each as likely as the others."""

    values: tuple[object, ...]

    @property
    def varies(self) -> bool:
        """Whether there is more than one value."""
        return len(self.values) > 1

    def at(self, coordinates: np.ndarray) -> np.ndarray:
        """Return the values (m,) at coordinates (m,) in (0, 1)."""
        places = (coordinates * len(self.values)).astype(int)
        drawn: np.ndarray = np.array(self.values)[places]
        return drawn


@dataclass(frozen=True, eq=False)
class Situation:
    """The case on which the ranges of the causes depend."""

    structure: Mechanism | EquivalentBlock
    motions: GroundMotions
    settings: EnsembleSettings

    @classmethod
    def of(
        cls, structure: Mechanism | EquivalentBlock, motions: GroundMotions, settings: EnsembleSettings
    ) -> "Situation":
        """Return the situation with the structure's own range of the restitution where it states one."""
        own = structure.restitution_range if isinstance(structure, Mechanism) else None
        if own is not None:
            settings = replace(settings, restitution_range=own)
        return cls(structure, motions, settings)


@dataclass(frozen=True)
class Cause:
    """One input that is not known.

    range_in: its range in a situation. generator: its component of the generating vector of the lattices.
    """

    name: str
    origin: Origin
    generator: int
    range_in: Callable[[Situation], Interval | Options]


CAUSES = (
    # A factor on the ground motion, the vertical component included.
    Cause("amplitude", Origin.IGNORANCE, 1, lambda case: Interval(1.0, case.settings.amplitude_range)),
    # A difference from the restitution of the structure.
    Cause(
        "restitution", Origin.IGNORANCE, 182667, lambda case: Interval(0.0, case.settings.restitution_range)
    ),
    # The sign of the horizontal motion changes nothing for a structure with two sides alike.
    Cause(
        "polarity",
        Origin.CHANCE,
        469891,
        lambda case: Options(
            (-1.0, 1.0) if case.settings.polarity and not case.structure.symmetric else (1.0,)
        ),
    ),
    Cause("direction", Origin.CHANCE, 377, lambda case: Options(case.motions.directions)),
    Cause("processing", Origin.IGNORANCE, 1723, lambda case: Options(case.motions.processings)),
    # Half of the members feel the vertical motion where there is one.
    Cause(
        "vertical",
        Origin.IGNORANCE,
        1677,
        lambda case: Options((False,) if case.motions.vertical is None else (True, False)),
    ),
)
"""Every cause, in the order of the coordinates of a point.

Amplitude, restitution and polarity have the first components of the vector exod2_base2_m20 of Cools, Kuo & Nuyens
(2006), Constructing embedded lattice rules for multivariate integration, SIAM J. Sci. Comput. 28, 2162-2188, published
before any record here was seen. Its next component is that of the amplitude again at 64 points, so the others,
direction, processing and vertical, follow from the same criterion for SIZES: of all numbers, one after the other, the
one whose pairs with those before it have the least worst-case error (unanchored Sobolev space, order 2), relative to
the best at each size, at the worst size. No record takes part in it, so every site is left out of the choice."""
_SHIFT = 0.5 / 64 + 0.5 / SIZES[-1]
"""Shift of all points: the first coordinate of the 64 that are usual stands in the middle of its strata, but for half a
step of the largest lattice, which leaves no point of it on a border."""


@lru_cache(maxsize=16)
def lattice(size: int) -> np.ndarray:
    """Return `size` points in (0, 1), one coordinate for each of CAUSES, read-only.

    size: one of SIZES. The points of a smaller lattice come first. A point k has the coordinates k z/size modulo 1 with
    the generating vector z, moved by _SHIFT. Those of the lattice of a quarter the size come first.
    """
    order = np.arange(SIZES[0])
    while order.size < size:
        order = np.append(4 * order, np.setdiff1d(np.arange(4 * order.size), 4 * order))
    generator = np.array([cause.generator for cause in CAUSES])
    points: np.ndarray = (order[:, None] * (generator % size) % size / size + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


def draw(situation: Situation, points: np.ndarray) -> Mapping[str, np.ndarray]:
    """Return the value of every cause by member, (m,) each, by name.

    points: (m, c) in (0, 1), one coordinate for each of CAUSES.
    """
    return {
        cause.name: cause.range_in(situation).at(coordinates)
        for cause, coordinates in zip(CAUSES, points.T, strict=True)
    }
