"""The front door: follow a structure through a ground motion, to a tolerance or exactly where a closed form exists.

Once, or for all members of an ensemble in one compiled call.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any, NamedTuple, Protocol, TypeGuard

import numpy as np

from rocking.errors import MotionError
from rocking.motion import linear_kernel, nonlinear_kernel, runs
from rocking.motion.kinds import MotionKind
from rocking.motion.response import Response
from rocking.motion.table import (
    Forcing,
    GroundMotion,
    MechanismTable,
    SideTable,
    forcing_of,
    linear_table,
    table_of,
)
from rocking.quantities import GRAVITY, finite, kind_of, within
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock, Mechanism
from rocking.warnings import RockingWarning


class HasMechanism(Protocol):
    """Anything that reduces to a Mechanism."""

    def mechanism(self) -> Mechanism: ...


Rocking = Mechanism | EquivalentBlock | HasMechanism
Start = tuple[float, float, int]
"""Magnitude of the rotation, its rate (> 0 outward), and the side; side 0 is rest."""

LEAST_TOLERANCE = 1e-13
LARGEST_TOLERANCE = 0.1
"""Smallest and largest relative tolerance."""
STEP_SHARE = 0.03
"""Share of the tolerance that one step may spend: each flight amplifies the errors of those before it."""
OUTCOMES = {0: Outcome.NO_UPLIFT, runs.ROCKS: Outcome.ROCKS, runs.OVERTURNS: Outcome.OVERTURNS}
_TIGHT = 1e-12
_NUDGE = 1e-5
STRICT = 1e-9
"""Tolerance of a repeated run, and by how much the motion of two others is weaker and stronger, which show whether a
run is fragile: an exact response has no tolerance to change."""
_REPRODUCIBLE = 1e-5
"""Relative change of the largest rotation in one of these runs above which the first one is called fragile."""
LARGEST_GROWTH = 50.0
"""Largest p Δt for which exp(p Δt) leaves the exact update its digits."""


class Runs(NamedTuple):
    """What varies between the runs of one call, (m,) each.

    horizontal, vertical: factors of the two components; None without a vertical one. restitution: (m, 2), positive
    side first; None: the structure's own.
    """

    horizontal: np.ndarray
    vertical: np.ndarray | None = None
    restitution: np.ndarray | None = None

    @property
    def lift(self) -> np.ndarray:
        """The factors of the vertical component, 0 where none acts."""
        return np.zeros(self.horizontal.size) if self.vertical is None else self.vertical

    def at(self, places: np.ndarray) -> "Runs":
        """Return the runs at `places`."""
        return Runs(*(None if values is None else values[places] for values in self))  # type: ignore[arg-type]


class RunOptions(NamedTuple):
    """How runs begin and end: from what state, whether each ends where its verdict is settled, and where states go.

    log: (k, 3), filled with time, arc and its rate, or without lines.
    """

    start: Start = (0.0, 0.0, 0)
    settle: bool = True
    log: np.ndarray = np.empty((0, 3))


FROM_REST = RunOptions()


def integrate(
    structure: Rocking,
    motion: GroundMotion,
    tolerance: float = 1e-6,
    *,
    history: bool = False,
    vertical: Accelerogram | None = None,
    sensitivity: bool = False,
    repeat_fragile: bool = False,
    fragile_change: float = 0.01,
    initial_rotation: float = 0.0,
    initial_velocity: float = 0.0,
) -> Response:
    """Follow `structure` through `motion`, and on over still ground until no larger peak and no overturning can come.

    Overturning is a rotation past the mechanism's end, or outward motion that the largest acceleration still
    to come cannot turn back. Rocking ends at an impact that leaves less than 1e-14 of the energy that reaches
    φ_cr.

    A call prepares its motion once, and again when it is given another one. Of one record at many amplitudes take
    `integrate_members`, which follows them in one compiled call; of many structures, each at many amplitudes,
    `integrate_batch`, on all cores. Under many different records call this once for each, of each record with all
    structures before the next, and with the same Mechanism, `structure.mechanism()`, throughout.

    Parameters
    ----------
    structure : Mechanism, EquivalentBlock or Structure
        What rocks: a Mechanism, an EquivalentBlock, or anything with a method `mechanism()`.
    motion : Accelerogram or Pulse
        Accelerogram, linear between its samples, or Pulse, exact. An EquivalentBlock under a record is solved
        exactly and ignores `tolerance`.
    tolerance : float, default 1e-06
        Relative tolerance of the largest rotation, in [1e-13, 0.1].
    history : bool, default False
        Whether times, rotation and angular velocity are kept.
    vertical : Accelerogram or None, optional
        Vertical acceleration ü_v, sample by sample as the horizontal motion; gravity becomes g + ü_v.
    sensitivity : bool, default False
        Whether d ln φ_max / d ln a is found as well, and whether the verdict is fragile.
    repeat_fragile : bool, default False
        Whether to find if the verdict is `fragile`; a run that is repeats itself at 1e-9, the tolerance that
        the response then states.
    fragile_change : float, default 0.01
        Relative change of the ground motion that a verdict which is not fragile must bear, in [0, 0.5].
    initial_rotation : float, default 0.0
        Rotation when the motion begins, rad, signed.
    initial_velocity : float, default 0.0
        Angular velocity when the motion begins, rad/s, signed.

    Returns
    -------
    Response
        Largest rotation over the critical one, outcome, and what is needed to trust them.

    Raises
    ------
    MotionError
        For a setting or a forcing outside what is allowed, or a motion of more than 5e6 impacts.

    Examples
    --------
    >>> from rocking import Block, Pulse, integrate
    >>> integrate(Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)).outcome
    <Outcome.ROCKS: 'rocks'>
    """
    tolerance = within(MotionError, "tolerance", tolerance, low=LEAST_TOLERANCE, high=LARGEST_TOLERANCE)
    rotation = finite(MotionError, "initial_rotation", initial_rotation, "rad")
    velocity = finite(MotionError, "initial_velocity", initial_velocity, "rad/s")
    leading = rotation or velocity
    side = (leading > 0) - (leading < 0)
    if side < 0 and getattr(structure, "one_sided", False):
        raise MotionError(
            "the initial state lies on the negative side, but a one-sided structure rocks to the positive only.",
            initial_rotation=rotation,
        )
    start = abs(rotation), side * velocity, side

    forcing = forcing_of(motion, vertical)
    reduced = reduce(structure)
    response = _response(reduced, forcing, tolerance, start, history)
    if not (sensitivity or repeat_fragile):
        return response

    change = within(MotionError, "fragile_change", fragile_change, low=0, high=0.5)
    fragile = _is_fragile(response, reduced, forcing, tolerance, start, change)
    if fragile and response.tolerance > strict(tolerance):
        response = _response(reduced, forcing, strict(tolerance), start, history)
    response = replace(response, fragile=fragile)

    if sensitivity and response.outcome is Outcome.ROCKS:
        return replace(response, sensitivity=_sensitivity(reduced, forcing, start))
    return response


def strict(tolerance: float) -> float:
    """Return the tolerance of a run on which a verdict hangs: that of a fragile run's repetition, or a smaller one.

    To ask of a run whether it is fragile takes four runs more; to follow it at this tolerance at once, a fifth more
    time. Runs that do not report whether they are fragile are therefore strict from the start.
    """
    return min(tolerance, STRICT)


def reduce(structure: Rocking) -> Mechanism | EquivalentBlock:
    """Return the Mechanism or EquivalentBlock of `structure`."""
    if isinstance(structure, Mechanism | EquivalentBlock):
        return structure
    if not hasattr(structure, "mechanism"):
        raise MotionError(
            f"the structure is {kind_of(structure)}, but must be a Mechanism, an EquivalentBlock, "
            "or have a mechanism() method.",
            structure=structure,
        )
    return structure.mechanism()


def solvable_exactly(structure: Rocking, forcing: Forcing) -> TypeGuard[EquivalentBlock]:
    """Whether the closed form per sample holds without a vertical component: a block, a sampled record, a sane p Δt."""
    if not isinstance(structure, EquivalentBlock) or forcing.ground.circular_frequency != 0:
        return False
    frequency = max(side.frequency_parameter for side in structure.sides)
    return frequency * forcing.ground.time_step <= LARGEST_GROWTH


def follow(
    reduced: Mechanism | EquivalentBlock,
    forcing: Forcing,
    several: Runs,
    tolerance: float,
    course: RunOptions = FROM_REST,
) -> tuple[Sequence[SideTable | EquivalentBlock], np.ndarray]:
    """Follow a structure once for each of several runs: what measures its sides, and the results (m, 9) of the kernel.

    Without vertical motion an EquivalentBlock is followed through a record exactly.
    """
    lift = several.lift
    if solvable_exactly(reduced, forcing) and not lift.any():
        return reduced.sides, follow_blocks([reduced], forcing, several, course)
    table = table_of(reduced, forcing.vertical)
    results = np.zeros((lift.size, runs.COLUMNS))
    kernel = table.kernel
    if frequency := forcing.ground.circular_frequency:  # of a sine, which the steps must resolve as well
        kernel = kernel._replace(longest_step=np.minimum(kernel.longest_step, 1 / frequency))
    eta = np.empty((lift.size, 2))
    own = table.sides[0].restitution, table.sides[-1].restitution
    eta[:] = own if several.restitution is None else several.restitution
    start, settle, log = course
    arc, speed = _initial_arc(table, start) if start[2] else (0.0, 0.0)
    begin = nonlinear_kernel.RockingState(0, 0.0, arc, speed, start[2], arc, abs(speed))
    how = STEP_SHARE * tolerance, settle, nonlinear_kernel.memory(kernel.ties), np.empty((2, 2)), log
    nonlinear_kernel.rock(kernel, forcing.ground, several.horizontal, lift, eta, begin, *how, results)
    return table.sides, results


def follow_blocks(
    blocks: Sequence[EquivalentBlock],
    forcing: Forcing,
    several: Runs,
    course: RunOptions = FROM_REST,
) -> np.ndarray:
    """Follow b blocks, alike in their sides, exactly through a record once for each of m runs: results (b m, 9).

    A restitution of the runs, and a start, are those of one block.
    """
    rows, own = _rows(tuple(blocks))
    factors = several.horizontal
    eta = np.empty((len(blocks), factors.size, 2))
    eta[:] = own if several.restitution is None else several.restitution
    start, settle, log = course
    begin = linear_kernel.LinearState(0, 0.0, 0.0, 0.0, 0)
    if start[2]:
        side = blocks[0].sides[0 if start[2] > 0 else -1]
        arc, speed = _initial_arc(linear_table(blocks[0]), start)
        begin = begin._replace(x=arc / side.critical_arc, w=speed / side.velocity_scale, side=start[2])
    ground = forcing.ground
    sides = rows.span.shape[1]
    samples = linear_kernel.Samples(
        ground.horizontal, ground.time_step, np.empty((sides, 2, ground.horizontal.size))
    )
    results = np.zeros((len(blocks) * factors.size, runs.COLUMNS))
    linear_kernel.rock_linear(rows, samples, factors, eta, begin, settle, np.empty((2, 2)), log, results)
    return results


@lru_cache(maxsize=256)
def _rows(blocks: tuple[EquivalentBlock, ...]) -> tuple[linear_kernel.Blocks, np.ndarray]:
    """The rows that the kernel takes of b blocks, alike in their sides, and their restitution (b, 1, 2)."""
    numbers = [
        [(s.frequency_parameter, 1 / (GRAVITY * s.uplift_multiplier), s.critical_arc) for s in block.sides]
        for block in blocks
    ]
    frequency, push, span = np.array(numbers).transpose(2, 0, 1).copy()
    near = np.zeros((*span.shape, 8))
    near[..., 0] = linear_kernel.NEAR * span
    near[..., 4] = frequency**2 / GRAVITY
    near[..., 1] = span * near[..., 4] * (1 - linear_kernel.NEAR)
    near[..., 3] = span * frequency**2 * push
    eta = np.array([[(block.sides[0].restitution, block.sides[-1].restitution)] for block in blocks])
    return linear_kernel.Blocks(frequency, push, span, near, blocks[0].one_sided), eta


def failure(status: float, impacts: float) -> MotionError:
    """Why a run has no answer."""
    if status == runs.TOO_MANY_IMPACTS:
        return MotionError(
            f"the structure met {impacts:.0f} impacts before the motion ended, but at most "
            f"{runs.IMPACT_LIMIT} are followed; a restitution below 1 brings it to rest.",
            impacts=int(impacts),
        )
    return MotionError(
        "the motion left the range of floating-point numbers; check the record's amplitude.",
        acceleration="overflow",
    )


def _initial_arc(table: MechanismTable, start: Start) -> tuple[float, float]:
    """The initial arc and its rate; raises MotionError beyond the end of the mechanism."""
    rotation, velocity, sign = start
    side = table.sides[0 if sign > 0 else -1]
    arc = side.arc(rotation)
    if not arc < side.end:
        raise MotionError(
            f"initial_rotation is {rotation!r} rad, but the mechanism ends before that.",
            initial_rotation=rotation,
        )
    return arc, velocity / float(side.slope(np.array(arc)))


def _response(
    reduced: Mechanism | EquivalentBlock,
    forcing: Forcing,
    tolerance: float,
    start: Start,
    history: bool = False,
    factor: float = 1.0,
) -> Response:
    """The Response to the motion times `factor`; overturned, too, where a side is past its end. Raises MotionError."""
    factors = np.array([factor])
    one = Runs(factors, factors if forcing.vertical else None)
    log = np.zeros((2 * forcing.ground.horizontal.size + 1001, 3)) if history else FROM_REST.log
    sides, results = follow(reduced, forcing, one, tolerance, RunOptions(start, False, log))
    if history and log[0, 0] >= log.shape[0]:
        log = np.zeros((int(log[0, 0]) + 1, 3))
        follow(reduced, forcing, one, tolerance, RunOptions(start, False, log))
    row = results[0].tolist()
    if row[runs.STATUS] not in OUTCOMES:
        raise failure(row[runs.STATUS], row[runs.IMPACTS])
    ratios = sides[0].rotation_ratio(row[runs.PEAKS]), sides[-1].rotation_ratio(row[runs.PEAKS + 1])
    outcome = OUTCOMES[row[runs.STATUS]] if math.isfinite(max(ratios)) else Outcome.OVERTURNS
    largest = 0 if ratios[0] >= ratios[1] else 1
    rocks = outcome is Outcome.ROCKS
    begin = forcing.start_time
    states = _states(table_of(reduced, forcing.vertical), log, begin) if history else {}
    if history and outcome is Outcome.OVERTURNS:
        states["fall_time"] = _fall_time(sides, states["times"], states["rotation"])
    return Response(
        rotation_ratio=math.inf if outcome is Outcome.OVERTURNS else ratios[largest],
        outcome=outcome,
        impacts=int(row[runs.IMPACTS]),
        peak_time=begin + row[runs.TIMES + largest] if rocks else math.nan,
        uplift_time=begin + row[runs.UPLIFT],
        peak_side=(1, -1)[largest] if rocks else int(row[runs.SIDE]),
        steps=int(row[runs.STEPS]),
        tolerance=0.0 if isinstance(sides[0], EquivalentBlock) else tolerance,
        warning=RockingWarning(MotionKind.WEIGHTLESS) if forcing.weightless else None,
        critical_rotations=(sides[0].critical_rotation, sides[-1].critical_rotation),
        **states,
    )


def _is_fragile(
    response: Response,
    reduced: Mechanism | EquivalentBlock,
    forcing: Forcing,
    tolerance: float,
    start: Start,
    change: float,
) -> bool:
    """Whether tighter runs a hair weaker or stronger differ, or one weaker or stronger by `change` ends otherwise.

    Both hairs are needed: where two limits lie less than `change` apart, only a motion beyond the nearer one differs.
    """
    for factor in (1 + STRICT, 1 - STRICT):
        again = _response(reduced, forcing, strict(tolerance), start, factor=factor)
        if not math.isclose(again.rotation_ratio, response.rotation_ratio, rel_tol=_REPRODUCIBLE):
            return True
    neighbours = (
        _response(reduced, forcing, tolerance, start, factor=factor) for factor in (1 - change, 1 + change)
    )
    return any(neighbour.outcome is not response.outcome for neighbour in neighbours)


def _states(table: MechanismTable, log: np.ndarray, begin: float) -> dict[str, Any]:
    """The history of a Response, whose motion starts at the time `begin`, from the lines of a log, which holds arcs."""
    times, arcs, speeds = log[1 : int(log[0, 0]) + 1].T
    rotation = np.empty_like(arcs)
    velocity = np.empty_like(arcs)
    negative = (arcs < 0) | ((arcs == 0) & (speeds < 0))
    for sign, rows, side in ((1, ~negative, table.sides[0]), (-1, negative, table.sides[-1])):
        within_end = np.minimum(np.abs(arcs[rows]), side.end)
        rotation[rows] = sign * side.rotation(within_end)
        velocity[rows] = speeds[rows] * side.slope(within_end)
    return {"times": times + begin, "rotation": rotation, "angular_velocity": velocity}


def _fall_time(sides: Sequence[Any], times: np.ndarray, rotation: np.ndarray) -> float:
    """The time at which a history first passes the critical rotation; its end where it stops at that."""
    limits = np.where(rotation > 0, sides[0].critical_rotation, sides[-1].critical_rotation)
    passed = np.flatnonzero(np.abs(rotation) >= limits * (1 - 1e-9))
    return float(times[passed[0] if passed.size else -1])


def _sensitivity(reduced: Mechanism | EquivalentBlock, forcing: Forcing, start: Start) -> float:
    """d ln φ_max / d ln a, by a central difference of two tightly integrated neighbours; inf where one overturns."""
    factors = (1 - _NUDGE, 1 + _NUDGE)
    below, above = (
        _response(reduced, forcing, _TIGHT, start, factor=factor).rotation_ratio for factor in factors
    )
    if not (0 < below < math.inf and 0 < above < math.inf):
        return math.inf
    return math.log(above / below) / math.log(factors[1] / factors[0])


Values = float | Sequence[float] | np.ndarray


@dataclass(frozen=True, eq=False, init=False, repr=False)
class Members:
    """The inputs that vary between the members of an ensemble; each argument one value for all, or one per member (m,).

    Parameters
    ----------
    scale_factor : ndarray, default 1.0
        (m,) factors, > 0, of the ground motion, its vertical component included.
    polarity : ndarray, default 1.0
        (m,) +1, or −1 for the horizontal motion reversed.
    vertical : ndarray, default True
        (m,) whether the vertical component acts.
    restitution : ndarray or None, optional
        η, (m,) or one per side (m, 2), positive side first, kept as (m, 2); None takes the structure's own.

    Raises
    ------
    MotionError
        For a value out of range, or for arguments that do not fit each other.

    Examples
    --------
    >>> from rocking import Members
    >>> Members(scale_factor=[0.9, 1.0, 1.1], restitution=0.85).count
    3
    """

    scale_factor: np.ndarray
    polarity: np.ndarray
    vertical: np.ndarray
    restitution: np.ndarray | None

    def __init__(
        self,
        scale_factor: Values = 1.0,
        polarity: Values = 1.0,
        vertical: Values = True,
        restitution: Values | Sequence[Sequence[float]] | None = None,
    ) -> None:
        columns = {
            "scale_factor": (scale_factor, float),
            "polarity": (polarity, float),
            "vertical": (vertical, bool),
        }
        arrays = {name: np.atleast_1d(np.asarray(*column)) for name, column in columns.items()}
        if restitution is not None:
            eta = np.atleast_1d(np.asarray(restitution, dtype=float))
            arrays["restitution"] = eta if eta.ndim == 2 else np.stack([eta, eta], axis=-1)
        size = max(array.shape[0] for array in arrays.values())
        for name, array in arrays.items():
            shape = (size, 2) if name == "restitution" else (size,)
            if array.ndim != len(shape) or array.shape[0] not in (1, size) or array.shape[1:] != shape[1:]:
                raise MotionError(
                    f"{name} has the shape {array.shape}, but must hold one value or {size}.", **{name: array}
                )
            object.__setattr__(self, name, np.array(np.broadcast_to(array, shape)))
        if restitution is None:
            object.__setattr__(self, "restitution", None)
        for name, allowed, holds in (
            ("scale_factor", "be greater than 0", lambda values: values > 0),
            ("polarity", "be 1 or -1", lambda values: np.abs(values) == 1),
            ("restitution", "lie between 0 and 1", lambda values: (values >= 0) & (values <= 1)),
        ):
            values = arrays.get(name, np.ones(1))
            wrong = values[~(holds(values) & np.isfinite(values))]  # type: ignore[no-untyped-call]
            if wrong.size:
                raise MotionError(
                    f"{name} holds {wrong[0]!s}, but every value must {allowed}.", **{name: float(wrong[0])}
                )

    def __repr__(self) -> str:
        low = self.scale_factor.min()
        high = self.scale_factor.max()
        return f"<Members: {self.count}, scaled by {low:.4g} to {high:.4g}>"

    @property
    def count(self) -> int:
        """The number of members."""
        return self.scale_factor.size


class MemberResponses(NamedTuple):
    """The members' responses, (m,) each.

    Parameters
    ----------
    rotation_ratio : ndarray
        (m,) largest φ/φ_cr over the sides; inf overturns, 0 without uplift, nan failed.
    peak_side : ndarray
        (m,) +1 or −1, the side of the largest rotation; 0 without uplift, and unknown where it overturns.
    reasons : dict of int to str
        Why a member failed, by its place.

    Examples
    --------
    >>> from rocking import Block, Members, Pulse, integrate_members
    >>> block, pulse = Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)
    >>> integrate_members(block, pulse, Members(scale_factor=[0.5, 1.0])).lifted.tolist()
    [False, True]
    """

    rotation_ratio: np.ndarray
    peak_side: np.ndarray
    reasons: dict[int, str]

    @property
    def lifted(self) -> np.ndarray:
        """Whether the structure rocks at all."""
        result: np.ndarray = self.rotation_ratio != 0
        return result

    @property
    def overturns(self) -> np.ndarray:
        """Whether it overturns."""
        return np.isposinf(self.rotation_ratio)


def integrate_members(
    structure: Rocking,
    motion: GroundMotion,
    members: Members,
    tolerance: float = 1e-6,
    *,
    vertical: Accelerogram | None = None,
) -> MemberResponses:
    """Follow `structure` through `motion` once for every member, in one compiled call that lets other threads run.

    Each result is that of `integrate` with the scaled motion, within `tolerance`; an EquivalentBlock without
    vertical motion is solved exactly.

    Parameters
    ----------
    structure : Mechanism, EquivalentBlock or Structure
        What rocks: a Mechanism, an EquivalentBlock, or anything with a method `mechanism()`.
    motion : Accelerogram or Pulse
        Accelerogram, linear between its samples, or Pulse, exact.
    members : Members
        Inputs that vary between the members.
    tolerance : float, default 1e-06
        Relative tolerance of the largest rotation, in [1e-13, 0.1].
    vertical : Accelerogram or None, optional
        Vertical acceleration ü_v, sample by sample as the horizontal motion; gravity becomes g + ü_v.

    Returns
    -------
    MemberResponses
        Response of each member; a member that cannot be followed is nan, with its reason.

    Raises
    ------
    MotionError
        As `integrate` does for a setting that is wrong for every member; a member that cannot be followed is
        nan, with its reason.

    Examples
    --------
    >>> from rocking import Block, Members, Pulse, integrate_members
    >>> block, pulse = Block(semi_diagonal=2.0, slenderness=0.2), Pulse(amplitude=3.0, circular_frequency=9.0)
    >>> integrate_members(block, pulse, Members(scale_factor=[0.5, 1.0, 9.0])).overturns.tolist()
    [False, False, True]
    """
    if not isinstance(members, Members):
        raise MotionError(
            f"members is {kind_of(members)}, but must be Members, as Members([0.9, 1.0, 1.1]).",
            members=members,
        )
    tolerance = within(MotionError, "tolerance", tolerance, low=LEAST_TOLERANCE, high=LARGEST_TOLERANCE)
    forcing = forcing_of(motion, vertical)
    lift = np.where(members.vertical, members.scale_factor, 0.0) if forcing.vertical else None
    several = Runs(members.scale_factor * members.polarity, lift, members.restitution)
    return follow_runs(reduce(structure), forcing, several, tolerance)


def follow_runs(
    reduced: Mechanism | EquivalentBlock, forcing: Forcing, several: Runs, tolerance: float
) -> MemberResponses:
    """`integrate_members` of what is prepared already."""
    lift = several.lift
    if isinstance(reduced, Mechanism) and not lift.any():
        # Without a run that lifts it needs no table, which takes longer than the runs; what is close is left to them.
        largest = np.abs(several.horizontal).max(initial=0.0) * forcing.excitation
        if largest < (1 - 1e-9) * reduced.uplift_multiplier:
            return MemberResponses(np.zeros(lift.size), np.zeros(lift.size, int), {})
    if solvable_exactly(reduced, forcing) and 0 < np.count_nonzero(lift) < lift.size:
        # Members with and without vertical motion each go their own way.
        ratio = np.empty(lift.size)
        side = np.empty(lift.size, int)
        reasons: dict[int, str] = {}
        for places in (np.flatnonzero(lift == 0), np.flatnonzero(lift)):
            some = follow_runs(reduced, forcing, several.at(places), tolerance)
            ratio[places] = some.rotation_ratio
            side[places] = some.peak_side
            reasons |= {int(places[k]): reason for k, reason in some.reasons.items()}
        return MemberResponses(ratio, side, reasons)
    return concluded(*follow(reduced, forcing, several, tolerance))


def concluded(sides: Sequence[SideTable | EquivalentBlock], results: np.ndarray) -> MemberResponses:
    """Return what the results (m, 9) of a kernel say; sides: one where they are mirrored."""
    status = results[:, runs.STATUS]
    reasons = {}
    arcs = np.where(status == runs.ROCKS, results[:, runs.PEAKS : runs.PEAKS + 2].T, 0.0)
    if len(sides) == 1:
        one, other = sides[0].rotation_ratios(arcs)
    else:
        one, other = (side.rotation_ratios(own) for side, own in zip(sides, arcs, strict=True))
    ratio = np.maximum(one, other)
    side = np.where(one >= other, 1, -1)
    side[status == 0] = 0
    if status.max(initial=runs.ROCKS) > runs.ROCKS:
        ratio[status == runs.OVERTURNS] = np.inf  # as it is where it passed the end of the mechanism
        failed = np.flatnonzero(status > runs.OVERTURNS)
        ratio[failed] = np.nan
        side[failed] = 0
        reasons = {int(k): str(failure(*results[k, [runs.STATUS, runs.IMPACTS]])) for k in failed}
    return MemberResponses(ratio, side, reasons)
