"""Ties as the kernel sees them: their laws in arcs, and the tables of both sides stacked."""

from collections.abc import Sequence

import numpy as np

from rocking.motion.nonlinear_kernel import Ties
from rocking.quantities import GRAVITY
from rocking.structures.equivalent_block import Arc
from rocking.structures.mechanism import Side
from rocking.structures.ties import SideTie


def tie_law(side: Side, tie: SideTie, arc: Arc, reach: float) -> tuple[float, ...]:
    """Return the law (9,) of a tie as `Ties` has it; reach: the arc that is near rest."""
    law, rotations = tie.tie, np.linspace(0.0, arc.last, 129)
    yields, breaks = (
        float(arc.at(rotation)) if (rotation := tie.rotation(stretch, arc.last)) < np.inf else np.inf
        for stretch in (law.yield_stretch, law.rupture_stretch)
    )
    stiffest = np.max(tie.stretch_slope(rotations) ** 2 / side.inertia(rotations))
    return (
        GRAVITY * law.stiffness,
        GRAVITY * law.pretension,
        GRAVITY * law.strength,
        law.yield_stretch,
        yields,
        breaks,
        GRAVITY * law.stiffness * float(stiffest),
        float(tie.stretch_slope(np.asarray(0.0))) / side.at("inertia", 0.0),
        _slope_near_rest(side, tie, arc.rotation(np.linspace(0.0, reach, 65)), reach),
    )


def _slope_near_rest(side: Side, tie: SideTie, rotations: np.ndarray, reach: float) -> float:
    """Return a bound of |d(T D̃)/dq| over `rotations` (n,) at equal arcs up to `reach`, widened for those between."""
    rest = side.at("inertia", 0.0)
    pull = tie.stretch_slope(rotations) / np.sqrt(side.inertia(rotations) * rest)
    stretch = tie.stretch(rotations)
    force = tie.tie.pretension + tie.tie.stiffness * stretch[-1]
    steepest = np.abs(np.diff(stretch)).max() * (rotations.size - 1) / reach
    bends = np.abs(np.diff(pull)).max() * (rotations.size - 1) / reach
    return float(1.5 * GRAVITY * (tie.tie.stiffness * steepest * np.abs(pull).max() + force * bends))


def stacked_ties(sides: Sequence[Ties | None], pieces: int) -> Ties | None:
    """Return the ties of one side or two with as many pieces each; a tie that one side lacks has no force there."""
    count = max((each.law.shape[1] for each in sides if each is not None), default=0)
    if not count:
        return None
    pieces_of, law = np.zeros((len(sides) * count, pieces, 24)), np.zeros((len(sides), count, 9))
    law[:, :, 2:6] = np.inf
    for k, each in enumerate(sides):
        if each is not None:
            own = each.law.shape[1]
            pieces_of[k * count : k * count + own, : each.pieces.shape[1]] = each.pieces
            law[k, :own] = each.law[0]
    return Ties(pieces_of, law)
