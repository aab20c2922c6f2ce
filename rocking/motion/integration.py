"""The front door: follow a structure through a ground motion, to a tolerance or exactly where a closed form exists."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, Protocol

import numpy as np

from rocking.errors import MotionError
from rocking.motion import linear_kernel, nonlinear_kernel
from rocking.motion.compiled import IMPACT_LIMIT, OVERTURNS, ROCKS, TOO_MANY_IMPACTS
from rocking.motion.forcing import Forcing, GroundMotion, forcing_of
from rocking.motion.response import Response
from rocking.motion.table import SideTable, Table, linear_table, table_of
from rocking.quantities import GRAVITY, finite, within
from rocking.records.accelerogram import Accelerogram
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock, Mechanism


class Structure(Protocol):
    """Anything that reduces to a Mechanism."""

    def mechanism(self) -> Mechanism: ...


Rocking = Mechanism | EquivalentBlock | Structure
Start = tuple[float, float, int]
"""Magnitude of the rotation, its rate (> 0 outward), and the side; side 0 is rest."""

TOLERANCES = (1e-13, 0.1)
"""Smallest and largest relative tolerance."""
STEP_SHARE = 0.03
"""Share of the tolerance that one step may spend: each flight amplifies the errors of those before it."""
OUTCOMES = {0: Outcome.NO_UPLIFT, ROCKS: Outcome.ROCKS, OVERTURNS: Outcome.OVERTURNS}
WEIGHTLESS = (
    "the vertical motion takes away more than gravity for an instant, so that bodies would fly; the model keeps them "
    "on the ground."
)
_TIGHT = 1e-12
_NUDGE = 1e-5
_AGAIN = 1e-9
"""Tolerance of the second run, and by how much its motion is stronger: an exact response has no tolerance to change."""
_REPRODUCIBLE = 1e-5
"""Relative change of the largest rotation in the second run above which the first one is called fragile."""
LARGEST_GROWTH = 50.0
"""Largest p Δt for which exp(p Δt) leaves the exact update its digits."""
NO_LOG = np.empty((0, 3))


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
    and whether the verdict is `fragile`. initial_rotation [rad] and initial_velocity [rad/s], signed: the state when
    the motion begins, instead of rest.

    Overturning is a rotation past the mechanism's end, or outward motion that the largest acceleration still to come
    cannot turn back. Rocking ends at an impact that leaves less than 1e-14 of the energy that reaches φ_cr.
    Raises MotionError for a setting or a forcing outside what is allowed, or a motion of more than 5e6 impacts.

    >>> from rocking import Block, Pulse, integrate
    >>> integrate(Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)).outcome
    <Outcome.ROCKS: 'rocks'>
    """
    tolerance = within(MotionError, "tolerance", tolerance, *TOLERANCES)
    start = _start(structure, initial_rotation, initial_velocity)
    forcing = forcing_of(motion, vertical)
    reduced = reduce(structure)
    response = _follow(reduced, forcing, tolerance, start, history)
    if not sensitivity:
        return response
    change = within(MotionError, "fragility_change", fragility_change, 0, 0.5)
    again = _follow(reduced, forcing.scaled(1 + _AGAIN), min(tolerance, _AGAIN), start)
    close = math.isclose(again.rotation_ratio, response.rotation_ratio, rel_tol=_REPRODUCIBLE)
    return replace(
        response,
        sensitivity=_sensitivity(reduced, forcing, start) if response.outcome is Outcome.ROCKS else math.nan,
        fragile=not close
        or any(
            _follow(reduced, forcing.scaled(factor), tolerance, start).outcome is not response.outcome
            for factor in (1 - change, 1 + change)
        ),
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


def solvable_exactly(block: EquivalentBlock, forcing: Forcing) -> bool:
    """Whether the closed form per sample holds: a sampled record, no vertical component, a sane p Δt."""
    frequency = max(each.frequency_parameter for each in block.sides)
    return (
        forcing.ground.circular_frequency == 0
        and not forcing.vertical
        and frequency * forcing.ground.time_step <= LARGEST_GROWTH
    )


def blocks_of(block: EquivalentBlock) -> linear_kernel.Blocks:
    """What the linear kernel takes of a block."""
    sides = block.sides
    return linear_kernel.Blocks(
        frequency=np.array([each.frequency_parameter for each in sides]),
        push=np.array([1 / (GRAVITY * each.uplift_multiplier) for each in sides]),
        span=np.array([each.critical_arc for each in sides]),
        one_sided=block.one_sided,
    )


def samples_of(sides: Sequence[EquivalentBlock], forcing: Forcing) -> linear_kernel.Samples:
    """What the linear kernel takes of a record, for these sides of a block."""
    ground, time_step = forcing.ground.horizontal, forcing.ground.time_step
    takeable = np.empty((len(sides), 2, ground.size))
    for side, both in zip(sides, takeable, strict=True):
        for sign, out in zip((1, -1), both, strict=True):
            linear_kernel.takeback(ground, time_step, side.frequency_parameter, sign, out)
    return linear_kernel.Samples(ground, time_step, takeable)


def failure(status: int, impacts: int) -> MotionError:
    """Why a run has no answer."""
    if status == TOO_MANY_IMPACTS:
        return MotionError(
            f"the structure met {impacts} impacts before the motion ended, but at most "
            f"{IMPACT_LIMIT} are followed; a restitution below 1 brings it to rest."
        )
    return MotionError("the motion left the range of floating-point numbers; check the record's amplitude.")


def _start(structure: Rocking, rotation: float, velocity: float) -> Start:
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
    start: Start,
    history: bool = False,
) -> Response:
    if isinstance(reduced, EquivalentBlock) and solvable_exactly(reduced, forcing):
        return _exact(reduced, forcing, start, history)
    table = table_of(reduced, forcing.vertical)
    sides = table.kernel_of(forcing)
    arc, speed, side = _initial_arc(table, start) if start[2] else (0.0, 0.0, 0)
    begin = nonlinear_kernel.Motion(0, 0.0, arc, speed, side, arc, abs(speed))
    lift = forcing.factor if forcing.vertical else 0.0
    member = nonlinear_kernel.Member(forcing.factor, lift, table.restitution)
    phase = nonlinear_kernel.memory(sides.ties)
    arguments = sides, forcing.ground, member, begin, STEP_SHARE * tolerance, False, phase
    return _answer(
        nonlinear_kernel.rock, arguments, table.sides, forcing, tolerance, table if history else None
    )


def _exact(block: EquivalentBlock, forcing: Forcing, start: Start, history: bool) -> Response:
    """Follow the block through a record in closed form: no time-stepping error, only event times are iterated."""
    sides, begin = block.sides, linear_kernel.Motion(0, 0.0, 0.0, 0.0, 0)
    if start[2]:
        own = sides[0 if start[2] > 0 else -1]
        arc, speed, side = _initial_arc(linear_table(block), start)
        begin = linear_kernel.Motion(0, 0.0, arc / own.critical_arc, speed / own.velocity_scale, side)
    restitution = sides[0].restitution, sides[-1].restitution
    arguments = blocks_of(block), samples_of(sides, forcing), forcing.factor, restitution, begin, False
    table = linear_table(block) if history else None
    return _answer(linear_kernel.rock_linear, arguments, sides, forcing, 0.0, table)


def _initial_arc(table: Table, start: Start) -> Start:
    """The initial state in the arc; raises MotionError beyond the end of the mechanism."""
    rotation, velocity, sign = start
    side = table.side(sign)
    arc = side.arc(rotation)
    if not arc < side.end:
        raise MotionError(f"initial_rotation is {rotation!r} rad, but the mechanism ends before that.")
    return arc, velocity / float(side.slope(np.array(arc))), sign


def _answer(
    run: Any,
    arguments: tuple[Any, ...],
    sides: Sequence[SideTable | EquivalentBlock],
    forcing: Forcing,
    tolerance: float,
    table: Table | None,
) -> Response:
    """The Response of the compiled `run`, overturned where a side is past its end; with a table, its history as well.

    Raises MotionError for a run that has no answer.
    """
    peaks, log = np.empty((2, 2)), NO_LOG if table is None else np.zeros((2 * forcing.samples + 1001, 3))
    status, impacts, uplift, last_side, steps = run(*arguments, peaks, log)
    if table is not None and log[0, 0] >= log.shape[0]:
        log = np.zeros((int(log[0, 0]) + 1, 3))
        run(*arguments, peaks, log)
    if status not in OUTCOMES:
        raise failure(status, impacts)
    ratios = [sides[k].rotation_ratio(float(peaks[0, k])) for k in (0, -1)]
    outcome = OUTCOMES[status] if math.isfinite(max(ratios)) else Outcome.OVERTURNS
    largest = 0 if ratios[0] >= ratios[1] else 1
    rocks = outcome is Outcome.ROCKS
    times, rotation, velocity = (None, None, None) if table is None else _states(table, log)
    return Response(
        rotation_ratio=math.inf if outcome is Outcome.OVERTURNS else ratios[largest],
        outcome=outcome,
        impacts=impacts,
        peak_time=forcing.start_time + float(peaks[1, largest]) if rocks else math.nan,
        uplift_time=forcing.start_time + uplift,
        peak_side=(1, -1)[largest] if rocks else last_side,
        steps=steps,
        tolerance=tolerance,
        warning=WEIGHTLESS if forcing.weightless else "",
        times=None if times is None else times + forcing.start_time,
        rotation=rotation,
        angular_velocity=velocity,
    )


def _states(table: Table, log: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, rotations and angular velocities, signed, of the lines of a log, which holds arcs."""
    times, arcs, speeds = log[1 : int(log[0, 0]) + 1].T
    rotation, velocity = np.empty_like(arcs), np.empty_like(arcs)
    negative = (arcs < 0) | ((arcs == 0) & (speeds < 0))
    for sign, rows in ((1, ~negative), (-1, negative)):
        side = table.side(sign)
        within_end = np.minimum(np.abs(arcs[rows]), side.end)
        rotation[rows] = sign * side.rotation(within_end)
        velocity[rows] = speeds[rows] * side.slope(within_end)
    return times, rotation, velocity


def _sensitivity(reduced: Mechanism | EquivalentBlock, forcing: Forcing, start: Start) -> float:
    """d ln φ_max / d ln a, by a central difference of two tightly integrated neighbours; inf where one overturns."""
    factors = (1 - _NUDGE, 1 + _NUDGE)
    below, above = (
        _follow(reduced, forcing.scaled(factor), _TIGHT, start).rotation_ratio for factor in factors
    )
    if not (0 < below < math.inf and 0 < above < math.inf):
        return math.inf
    return math.log(above / below) / math.log(factors[1] / factors[0])
