"""Members at the points of a deterministic design: rank-1 lattices, the smaller ones contained in the larger."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from rocking.assessment.ensemble.distribution import SIZES, Ensemble, EnsembleSettings
from rocking.assessment.ensemble.ground_motions import GroundMotions
from rocking.assessment.verdict import NEGLIGIBLE, Verdict
from rocking.errors import MotionError
from rocking.motion.forcing import forcing_of
from rocking.motion.integration import TOLERANCES, Rocking, reduce
from rocking.motion.members import follow_factors
from rocking.quantities import within
from rocking.structures import EquivalentBlock, Mechanism

_GENERATOR = (1, 182667, 469891, 377, 1723, 1677)
"""Amplitude, restitution and polarity have the first components of the vector exod2_base2_m20 of Cools, Kuo & Nuyens
(2006), Constructing embedded lattice rules for multivariate integration, SIAM J. Sci. Comput. 28, 2162-2188, published
before any record here was seen. Its next component is that of the amplitude again at 64 points, so the others,
direction, processing and vertical, follow from the same criterion for SIZES: of all numbers, one after the other, the
one whose pairs with those before it have the least worst-case error (unanchored Sobolev space, order 2), relative to
the best at each size, at the worst size. No record takes part in it, so every site is left out of the choice."""
_SHIFT = 0.5 / 64 + 0.5 / SIZES[-1]
"""Of all points: the first coordinate of the 64 that are usual stands in the middle of its strata, but for half a step
of the largest lattice, which leaves no point of it on a border."""


@lru_cache(maxsize=16)
def lattice(size: int, dimensions: int) -> np.ndarray:
    """Return `size` points in (0, 1), (size, dimensions), read-only; the first of them are those of a smaller lattice.

    size: one of SIZES. dimensions: at most 6. A point k has the coordinates k z/size modulo 1 with the generating
    vector z, moved by _SHIFT. Those of the lattice of a quarter the size come first.
    """
    generator = np.array(_GENERATOR[:dimensions]) % size
    points = (_order(size)[:, None] * generator % size / size + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


def _order(size: int) -> np.ndarray:
    """The numbers below `size`, those that a quarter of the points would have before the others."""
    if size <= SIZES[0]:
        return np.arange(size)
    coarse = _order(size // 4) * 4
    return np.concatenate([coarse, np.setdiff1d(np.arange(size), coarse)])


FIRST, MOST_NEAR_A_LIMIT = 16, 256
"""Members with which an ensemble begins, and those it grows to where its verdict is not clear."""
CAUSES = 6
"""Coordinates of a point of the design: amplitude, restitution, polarity, direction, processing, vertical."""


def ensemble(
    structure: Rocking,
    motions: GroundMotions,
    settings: EnsembleSettings | None = None,
    *,
    nominal: float = float("nan"),
    tolerance: float = 1e-6,
    verdict_only: bool = False,
) -> Ensemble:
    """Follow `structure` through the members of its ensemble, the same ones at every call.

    It ends after FIRST members that all rest, and grows to MOST_NEAR_A_LIMIT where those asked for leave a verdict in
    doubt that more may settle. verdict_only: it ends after FIRST members, too, that all stay far from overturning:
    that settles the verdict but says less of the band. Raises MotionError as `integrate` does.
    """
    settings = settings or EnsembleSettings()
    reduced = reduce(structure)
    points = lattice(max(settings.size, MOST_NEAR_A_LIMIT), CAUSES)
    found = drawn(reduced, motions, points[:FIRST], settings, nominal=nominal, tolerance=tolerance)
    if np.all(found.rotation_ratios <= NEGLIGIBLE) or (verdict_only and found.far):
        return found
    for size in (settings.size, MOST_NEAR_A_LIMIT):
        done = found.rotation_ratios.size
        if size > done and (done == FIRST or _near_a_limit(found)):
            more = drawn(reduced, motions, points[done:size], settings, nominal=nominal, tolerance=tolerance)
            found = _joined(found, more)
    return found


def _near_a_limit(found: Ensemble) -> bool:
    opposite = min(found.overturning_share, 1 - found.overturning_share)
    risk = found.settings.risk
    return found.verdict is Verdict.UNDECIDED and opposite - found.probability_error <= risk


def drawn(
    structure: Rocking,
    motions: GroundMotions,
    points: np.ndarray,
    settings: EnsembleSettings,
    *,
    nominal: float = float("nan"),
    tolerance: float = 1e-6,
) -> Ensemble:
    """Return the members at `points`, (m, 6) in (0, 1): one column for each cause, used where it varies."""
    reduced = reduce(structure)
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    if isinstance(reduced, Mechanism) and reduced.restitution_range is not None:
        settings = replace(settings, restitution_range=reduced.restitution_range)
    varied = _Varied.of(reduced, motions, points, settings)
    ratios = np.full(len(points), np.nan)
    reasons: dict[int, str] = {}
    for place, motion in enumerate(motions.horizontal.values()):
        rows = np.flatnonzero(varied.motion == place)
        if rows.size:
            forcing = forcing_of(motion, motions.vertical)
            responses = follow_factors(reduced, forcing, *varied.factors(rows), tolerance)
            ratios[rows] = responses.rotation_ratio
            reasons |= {int(rows[k]): reason for k, reason in responses.reasons.items()}
    return Ensemble(ratios, varied.causes, nominal, settings, reasons)


@dataclass(frozen=True, eq=False)
class _Varied:
    """What differs between the members, (m,) each: factor on the motion, η by side (m, 2), sign, place of the motion
    among the horizontal ones, and whether the vertical one acts (None: there is none). causes: that vary, by name.
    """

    amplitude: np.ndarray
    restitution: np.ndarray
    polarity: np.ndarray
    motion: np.ndarray
    vertical: np.ndarray | None
    causes: Mapping[str, np.ndarray]

    @classmethod
    def of(
        cls,
        reduced: Mechanism | EquivalentBlock,
        motions: GroundMotions,
        points: np.ndarray,
        settings: EnsembleSettings,
    ) -> "_Varied":
        amplitude = 1 + settings.amplitude_range * (2 * points[:, 0] - 1)
        offset = settings.restitution_range * (2 * points[:, 1] - 1)
        own = np.array([reduced.sides[0].restitution, reduced.sides[-1].restitution])
        unlike = settings.polarity and not reduced.symmetric
        polarity = np.where(points[:, 2] < 0.5, -1.0, 1.0) if unlike else np.ones(len(points))
        motion, chosen = _chosen_motions(motions, points[:, 3], points[:, 4])
        vertical = None if motions.vertical is None else points[:, 5] < 0.5
        varies = {
            "amplitude": amplitude if settings.amplitude_range else None,
            "restitution": offset if settings.restitution_range else None,
            "polarity": polarity if unlike else None,
            **chosen,
            "vertical": vertical,
        }
        causes = {name: values for name, values in varies.items() if values is not None}
        return cls(amplitude, np.clip(own + offset[:, None], 0.0, 1.0), polarity, motion, vertical, causes)

    def factors(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray | None, np.ndarray]:
        """Of the horizontal motion and of the vertical one, and the restitutions, of some members."""
        factor = self.amplitude[rows]
        lift = None if self.vertical is None else np.where(self.vertical[rows], factor, 0.0)
        return factor * self.polarity[rows], lift, self.restitution[rows]


def _chosen_motions(
    motions: GroundMotions, along: np.ndarray, done: np.ndarray
) -> tuple[np.ndarray, dict[str, np.ndarray]]:
    """The place of each member's motion, and the names of its direction and of its processing where there are more."""
    if len(motions.horizontal) == 1:
        return np.zeros(along.size, dtype=int), {}
    named = {"direction": (motions.directions, along), "processing": (motions.processings, done)}
    chosen = {
        cause: np.array(names)[(places * len(names)).astype(int)] for cause, (names, places) in named.items()
    }
    places = {key: place for place, key in enumerate(motions.horizontal)}
    motion = [places[key] for key in zip(chosen["direction"], chosen["processing"], strict=True)]
    return np.array(motion), {cause: chosen[cause] for cause, (names, _) in named.items() if len(names) > 1}


def _joined(first: Ensemble, more: Ensemble) -> Ensemble:
    count = first.rotation_ratios.size
    return replace(
        first,
        rotation_ratios=np.concatenate([first.rotation_ratios, more.rotation_ratios]),
        causes={name: np.concatenate([values, more.causes[name]]) for name, values in first.causes.items()},
        reasons={**first.reasons, **{count + k: reason for k, reason in more.reasons.items()}},
    )
