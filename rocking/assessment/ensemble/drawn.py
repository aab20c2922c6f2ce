"""Members drawn at the points of a design, and the ensemble that grows until its verdict is clear."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from rocking.assessment.ensemble.design import lattice
from rocking.assessment.ensemble.distribution import Ensemble
from rocking.assessment.ensemble.ground_motions import GroundMotions
from rocking.assessment.ensemble.settings import EnsembleSettings
from rocking.assessment.verdict import NEGLIGIBLE, Verdict
from rocking.motion.integration import Rocking, reduce
from rocking.motion.members import Members, integrate_members
from rocking.structures import EquivalentBlock, Mechanism

FIRST, MOST_NEAR_A_LIMIT = 16, 256
"""Members with which an ensemble begins, and those it grows to where its verdict is not clear."""
CAUSES = 6
"""Coordinates of a point of the design: amplitude, restitution, polarity, direction, processing, vertical."""
_Reduced = Mechanism | EquivalentBlock


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
    opposite = min(found.overturning_probability, 1 - found.overturning_probability)
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
    if isinstance(reduced, Mechanism) and reduced.restitution_range is not None:
        settings = replace(settings, restitution_range=reduced.restitution_range)
    varied = _Varied.of(reduced, motions, points, settings)
    ratios = np.full(len(points), np.nan)
    reasons: dict[int, str] = {}
    for (direction, processing), motion in motions.horizontal.items():
        rows = np.flatnonzero((varied.direction == direction) & (varied.processing == processing))
        if not rows.size:
            continue
        responses = integrate_members(
            reduced, motion, varied.members(reduced, rows), tolerance, vertical=motions.vertical
        )
        ratios[rows] = responses.rotation_ratio
        reasons |= {int(rows[k]): reason for k, reason in responses.reasons.items()}
    return Ensemble(ratios, varied.causes(reduced, motions, settings), nominal, settings, reasons)


@dataclass(frozen=True, eq=False)
class _Varied:
    """The value of each cause by member, (m,): factor on the motion, what is added to η, sign, names, and on or off."""

    amplitude: np.ndarray
    restitution: np.ndarray
    polarity: np.ndarray
    direction: np.ndarray
    processing: np.ndarray
    vertical: np.ndarray

    @classmethod
    def of(
        cls, reduced: _Reduced, motions: GroundMotions, points: np.ndarray, settings: EnsembleSettings
    ) -> "_Varied":
        amplitude, restitution, polarity, direction, processing, vertical = points.T
        unlike = settings.polarity and not reduced.symmetric
        return cls(
            1 + settings.amplitude_range * (2 * amplitude - 1),
            settings.restitution_range * (2 * restitution - 1),
            np.where((polarity < 0.5) & unlike, -1.0, 1.0),
            _chosen(direction, motions.directions),
            _chosen(processing, motions.processings),
            (vertical < 0.5) & (motions.vertical is not None),
        )

    def members(self, reduced: _Reduced, rows: np.ndarray) -> Members:
        own = np.array([reduced.sides[0].restitution, reduced.sides[-1].restitution])
        eta = np.clip(own + self.restitution[rows, None], 0.0, 1.0)
        return Members(self.amplitude[rows], self.polarity[rows], self.vertical[rows], eta)

    def causes(
        self, reduced: _Reduced, motions: GroundMotions, settings: EnsembleSettings
    ) -> dict[str, np.ndarray]:
        """Those that vary, by name."""
        varies = {
            "amplitude": settings.amplitude_range > 0,
            "restitution": settings.restitution_range > 0,
            "polarity": settings.polarity and not reduced.symmetric,
            "direction": len(motions.directions) > 1,
            "processing": len(motions.processings) > 1,
            "vertical": motions.vertical is not None,
        }
        return {name: getattr(self, name) for name, does in varies.items() if does}


def _chosen(places: np.ndarray, names: Sequence[str]) -> np.ndarray:
    return np.array(names)[np.minimum((places * len(names)).astype(int), len(names) - 1)]


def _joined(first: Ensemble, more: Ensemble) -> Ensemble:
    count = first.rotation_ratios.size
    return replace(
        first,
        rotation_ratios=np.concatenate([first.rotation_ratios, more.rotation_ratios]),
        causes={name: np.concatenate([values, more.causes[name]]) for name, values in first.causes.items()},
        reasons={**first.reasons, **{count + k: reason for k, reason in more.reasons.items()}},
    )
