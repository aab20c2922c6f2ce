"""The front door: follow a structure through a ground motion, one case or many."""

import math
from dataclasses import replace
from typing import Protocol

import numpy as np

from rocking.errors import MotionError
from rocking.motion.forcing import Forcing, GroundMotion, forcing_of
from rocking.motion.linear import follow_exactly, solvable_exactly
from rocking.motion.nonlinear import follow
from rocking.motion.response import Response
from rocking.motion.table import linear_table, table_of
from rocking.quantities import finite, within
from rocking.records.accelerogram import Accelerogram
from rocking.structures.mechanism import EquivalentBlock, Mechanism
from rocking.structures.outcome import Outcome


class Structure(Protocol):
    """Anything that reduces to a Mechanism."""

    def mechanism(self) -> Mechanism: ...


Rocking = Mechanism | EquivalentBlock | Structure

TOLERANCES = (1e-13, 0.1)
"""Smallest and largest relative tolerance."""

_TIGHT = 1e-12
_NUDGE = 1e-5


def integrate(
    structure: Rocking,
    motion: GroundMotion,
    tolerance: float = 1e-6,
    *,
    history: bool = False,
    vertical: Accelerogram | None = None,
    sensitivity: bool = False,
    fragility_change: float = 0.01,
    initial_rotation: float = 0.0,
    initial_velocity: float = 0.0,
) -> Response:
    """Follow `structure` through `motion`, and on over still ground until no larger peak and no overturning can come.

    structure: a Mechanism, an EquivalentBlock, or anything with `.mechanism()`. motion: an Accelerogram, linear between
    its samples, or a Pulse, exact. An EquivalentBlock under a record is solved exactly and ignores `tolerance`.
    tolerance: of the largest rotation, relative, in [1e-13, 0.1]. history: keep times, rotation and angular velocity.
    vertical: ü_v, sample by sample as `motion`; gravity becomes g + ü_v. sensitivity: also compute d ln φ_max / d ln a
    and whether scaling the motion by 1 ± fragility_change flips the verdict. initial_rotation [rad] and
    initial_velocity [rad/s], signed: the state when the motion begins, instead of rest.

    Overturning is a rotation past the mechanism's end, or outward motion that the largest acceleration still to come
    cannot turn back. Rocking ends at an impact that leaves less than 1e-14 of the energy that reaches φ_cr.
    Raises MotionError for a setting or a forcing outside what is allowed, or a motion of more than 5e6 impacts.
    """
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    start = _start(structure, initial_rotation, initial_velocity)
    forcing = forcing_of(motion, vertical)
    reduced = reduce(structure)
    response = _follow(reduced, forcing, tolerance, start, history)
    if not sensitivity:
        return response
    change = within(MotionError, "fragility_change", fragility_change, 0, 0.5)
    slope = _sensitivity(reduced, forcing, start) if response.outcome is Outcome.ROCKS else math.nan
    return replace(
        response,
        sensitivity=slope,
        fragile=_fragile(reduced, forcing, tolerance, start, response.outcome, change),
    )


def reduce(structure: Rocking) -> Mechanism | EquivalentBlock:
    """Return the Mechanism or EquivalentBlock of `structure`."""
    if isinstance(structure, Mechanism | EquivalentBlock):
        return structure
    if not hasattr(structure, "mechanism"):
        raise MotionError(
            f"the structure is a {type(structure).__name__}, but must be a Mechanism, an EquivalentBlock, "
            "or have a mechanism() method."
        )
    return structure.mechanism()


def _start(structure: Rocking, rotation: float, velocity: float) -> tuple[float, float, int]:
    """Magnitude of the rotation, its rate (> 0 outward), and the side; side 0 is rest."""
    rotation = finite(MotionError, "initial_rotation", rotation, "rad")
    velocity = finite(MotionError, "initial_velocity", velocity, "rad/s")
    side = int(np.sign(rotation) or np.sign(velocity))
    if side < 0 and getattr(structure, "one_sided", False):
        raise MotionError(
            "the initial state lies on the negative side, but a one-sided structure rocks to the positive only."
        )
    return abs(rotation), side * velocity, side


def _follow(
    reduced: Mechanism | EquivalentBlock,
    forcing: Forcing,
    tolerance: float,
    start: tuple[float, float, int],
    history: bool = False,
) -> Response:
    if isinstance(reduced, Mechanism):
        return follow(table_of(reduced, forcing.vertical), forcing, tolerance, start, history)
    if solvable_exactly(reduced, forcing):
        return follow_exactly(reduced, forcing, start, history)
    return follow(linear_table(reduced), forcing, tolerance, start, history)


def _sensitivity(
    reduced: Mechanism | EquivalentBlock, forcing: Forcing, start: tuple[float, float, int]
) -> float:
    """d ln φ_max / d ln a, by a central difference of two tightly integrated neighbours."""
    factors = (1 - _NUDGE, 1 + _NUDGE)
    below, above = (
        _follow(reduced, forcing.scaled(factor), _TIGHT, start).rotation_ratio for factor in factors
    )
    if math.isinf(below) or math.isinf(above):
        return math.inf
    if not below > 0 or not above > 0:
        return math.inf
    return math.log(above / below) / math.log(factors[1] / factors[0])


def _fragile(
    reduced: Mechanism | EquivalentBlock,
    forcing: Forcing,
    tolerance: float,
    start: tuple[float, float, int],
    outcome: Outcome,
    change: float,
) -> bool:
    return any(
        _follow(reduced, forcing.scaled(factor), tolerance, start).outcome is not outcome
        for factor in (1 - change, 1 + change)
    )
