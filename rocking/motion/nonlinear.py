"""The nonlinear response: a table and a forcing handed to the kernel, and what it says turned into a Response."""

import math

import numpy as np

from rocking.errors import MotionError
from rocking.motion import nonlinear_kernel as kernel
from rocking.motion.forcing import Forcing
from rocking.motion.response import Response
from rocking.motion.side_table import SideTable
from rocking.motion.table import Table
from rocking.structures.outcome import Outcome

OUTCOMES = {0: Outcome.NO_UPLIFT, kernel.ROCKS: Outcome.ROCKS, kernel.OVERTURNS: Outcome.OVERTURNS}
STEP_SHARE = 0.03
"""Share of the tolerance that one step may spend: each flight amplifies the errors of those before it."""

_NO_LOG = np.empty((0, 3))


def follow(
    table: Table, forcing: Forcing, tolerance: float, start: tuple[float, float, int], history: bool
) -> Response:
    """Integrate the table's mechanism through the forcing. start: rotation, rate outward, side (0: at rest)."""
    sides = table.kernel_of(forcing)
    state = kernel.Start(*(initial_arc(table, *start) if start[2] else (0.0, 0.0, 0)))
    member = kernel.Member(forcing.factor, forcing.factor if forcing.vertical else 0.0, table.restitution)
    peaks = np.empty((2, 2))
    (status, impacts, uplift, last_side, steps, _), log = logged_run(
        kernel.rock,
        (
            sides,
            forcing.ground,
            member,
            state,
            STEP_SHARE * tolerance,
            False,
            kernel.memory(sides.ties),
            peaks,
        ),
        forcing.samples if history else 0,
    )
    best, when = peaks
    ratios = [_ratio(table.side(1), best[0]), _ratio(table.side(-1), best[1])]
    response = concluded(
        status, ratios, when, impacts, uplift, last_side, steps, forcing.start_time, tolerance
    )
    return with_history(response, *states(table, log), forcing.start_time) if history else response


def logged_run(run, arguments: tuple, expected: int) -> tuple[tuple, np.ndarray]:
    """Call the compiled `run` with a log that is large enough; `expected` samples, 0 for no log."""
    log = np.empty((2 * expected + 1000, 3)) if expected else _NO_LOG
    found = run(*arguments, log)
    if found[-1] > log.shape[0] > 0:
        log = np.empty((found[-1], 3))
        found = run(*arguments, log)
    return found, log[: found[-1]]


def concluded(
    status: int,
    ratios: list[float],
    when: np.ndarray,
    impacts: int,
    uplift: float,
    last_side: int,
    steps: int,
    start_time: float,
    tolerance: float,
) -> Response:
    """The Response of a finished run, overturned where a ratio is past the end of the mechanism.

    Raises MotionError for a run that has no answer.
    """
    if status not in OUTCOMES:
        raise failure(status, impacts)
    outcome = OUTCOMES[status] if math.isfinite(max(ratios)) else Outcome.OVERTURNS
    largest = 0 if ratios[0] >= ratios[1] else 1
    rocks = outcome is Outcome.ROCKS
    return Response(
        rotation_ratio=math.inf if outcome is Outcome.OVERTURNS else ratios[largest],
        outcome=outcome,
        impacts=impacts,
        peak_time=start_time + float(when[largest]) if rocks else math.nan,
        uplift_time=start_time + uplift,
        peak_side=(1, -1)[largest] if rocks else last_side,
        steps=steps,
        tolerance=tolerance,
    )


def failure(status: int, impacts: int) -> MotionError:
    """Why a run has no answer."""
    if status == kernel.TOO_MANY_IMPACTS:
        return MotionError(
            f"the structure met {impacts} impacts before the motion ended, but at most {kernel.IMPACT_LIMIT} are "
            "followed; a restitution below 1 brings it to rest."
        )
    return MotionError("the motion left the range of floating-point numbers; check the record's amplitude.")


def with_history(
    response: Response, times: np.ndarray, rotation: np.ndarray, velocity: np.ndarray, start_time: float
) -> Response:
    """The response with its history, times counted from `start_time`."""
    fields = {name: getattr(response, name) for name in response.__dataclass_fields__}
    return Response(
        **fields | {"times": times + start_time, "rotation": rotation, "angular_velocity": velocity}
    )


def initial_arc(table: Table, rotation: float, velocity: float, sign: int) -> tuple[float, float, int]:
    """The initial state in the arc; raises MotionError beyond the end of the mechanism."""
    side = table.side(sign)
    arc = float(side.arc(np.array(rotation)))
    if not arc < side.end:
        raise MotionError(f"initial_rotation is {rotation!r} rad, but the mechanism ends before that.")
    return arc, velocity / float(side.slope(arc)), sign


def _ratio(side: SideTable, arc: float) -> float:
    return side.rotation_at(float(arc)) / side.critical_rotation if arc > 0 else 0.0


def states(table: Table, log: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Times, rotations and angular velocities, signed, of the lines of a log, which holds arcs."""
    times, arcs, speeds = log.T
    rotation, velocity = np.empty_like(arcs), np.empty_like(arcs)
    negative = (arcs < 0) | ((arcs == 0) & (speeds < 0))
    for sign, rows in ((1, ~negative), (-1, negative)):
        side = table.side(sign)
        within = np.minimum(np.abs(arcs[rows]), side.end)
        turned = side.rotation(within)
        rotation[rows] = sign * turned
        velocity[rows] = speeds[rows] * side.slope(within, turned)
    return times, rotation, velocity
