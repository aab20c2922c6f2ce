"""Stacks of courses and chains of stones on moving ground by contact dynamics: the dearest method, without mechanisms.

The compiled steps stand in `kernel.py`. They are of first order in the time step, and near a limit the outcome
changes with it, so that one run says less than the share of several (`assessment/contacts.py`).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rocking.contacts import kernel
from rocking.errors import MotionError
from rocking.quantities import GRAVITY, finite, instance
from rocking.records import Accelerogram
from rocking.structures.stack import STEP, Stack
from rocking.structures.stones import Stones

AFTERWARDS = 20.0
"""The longest time that a stack is followed on still ground, s: it then rocks by what no longer overturns it."""
SHORTEST = 1e-6
"""Shortest time step, s."""


@dataclass(frozen=True, eq=False)
class StackResponse:
    """The response of a stack or of stones: whether one falls, and the largest turn of each.

    Parameters
    ----------
    falls : bool
        Whether a body turned further than it comes back from, or a stone slipped out.
    turns : ndarray
        (n,) turns of the bodies when the largest of them was reached, clockwise positive, rad.
    largest_turns : ndarray
        (n,) largest turn of each body, rad.
    steps : int
        Time steps that were followed.
    unsolved_steps : int
        Time steps whose impulses were found one after the other, to a hundred-thousandth, not at once.
    times : ndarray or None, optional
        (k,) times of the history, s; None without one.
    places : ndarray or None, optional
        (k, n, 3) how far each centre of mass moved to the right and up relative to the ground, m, and its
        clockwise turn, rad.
    velocities : ndarray or None, optional
        (k, n, 3) rates of the places, m/s and rad/s.

    Examples
    --------
    >>> record = rocking.read("records/synthetic_strong_pulse.AT2")[0]
    >>> response = rocking.follow_stack(rocking.Spire(width=3.0, height=15.0).stack(), record.scaled(0.4))
    >>> response.falls, response.largest_turns.shape
    (False, (6,))
    """

    falls: bool
    turns: np.ndarray
    largest_turns: np.ndarray
    steps: int
    unsolved_steps: int
    times: np.ndarray | None = None
    places: np.ndarray | None = None
    velocities: np.ndarray | None = None

    @property
    def opened(self) -> int:
        """The number of bodies before the joint that had opened most where the largest turn was reached."""
        return int(np.abs(np.diff(self.turns, prepend=0.0)).argmax())


def follow_stack(
    stack: Stack | Stones,
    motion: Accelerogram,
    step: float = STEP,
    *,
    vertical: Accelerogram | None = None,
    history: bool = False,
    initial_velocity: np.ndarray | None = None,
) -> StackResponse:
    """Follow the bodies of `stack` through `motion`, linear between its samples, and on until they rest or fall.

    Parameters
    ----------
    stack : Stack or Stones
        The courses, or the stones between two grounds.
    motion : Accelerogram
        Horizontal ground acceleration, linear between its samples.
    step : float, default 0.0005
        Time step, s.
    vertical : Accelerogram or None, optional
        Vertical acceleration ü_v, sample by sample as `motion`.
    history : bool, default False
        Whether states are kept, one a sample of the motion or every step where that is longer.
    initial_velocity : ndarray or None, optional
        (n, 3) velocities of the bodies to the right and up, m/s, and clockwise, rad/s; None: at rest.

    Returns
    -------
    StackResponse
        Whether one falls, and the largest turn of each.

    Raises
    ------
    MotionError
        For a step that is too long for the stack, or another number of samples.

    Examples
    --------
    >>> record = rocking.read("records/synthetic_strong_pulse.AT2")[0]
    >>> rocking.follow_stack(rocking.Block.of_size(breadth=0.6, height=4.0).stack(), record).falls
    True
    """
    instance(MotionError, "stack", stack, Stack, Stones)
    instance(MotionError, "motion", motion, Accelerogram)
    step = finite(MotionError, "step", step, "s")
    longest = stack.longest_step
    if not SHORTEST <= step <= longest:
        raise MotionError(
            f"the time step is {step:.4g} s, but must be {SHORTEST:g} to {longest:.4g} s, which the smallest body "
            "and the stiffest tie of this stack allow; give a shorter step, or join bodies.",
            step=step,
        )
    ground = _ground(motion, vertical)
    shaken = math.ceil(motion.duration / step)
    start, still = 0, shaken
    if vertical is None and not history and initial_velocity is None:
        start, still = _strong(stack, motion, step)
    bodies = _bodies(stack)
    every = max(round(motion.time_step / step), 1) if history else 0
    steps = shaken + math.ceil(AFTERWARDS / step)
    kept = np.zeros((steps // every + 1 if every else 0, len(bodies.centres), 6))
    limits = kernel.Limits(step, GRAVITY, stack.fallen_turn, stack.settled_turn, start, still, steps, every)
    state, joints = _beginning(stack, bodies, initial_velocity)
    ending, followed, swept = kernel.follow(bodies, _acting(stack), ground, limits, state, joints, kept)
    response = StackResponse(
        falls=ending == kernel.FALLS,
        turns=-state.turns[1 : stack.count + 1],
        largest_turns=state.most[1 : stack.count + 1],
        steps=followed,
        unsolved_steps=swept,
    )
    return _with_history(response, kept[:, 1 : stack.count + 1], step, every) if every else response


def _with_history(response: StackResponse, kept: np.ndarray, step: float, every: int) -> StackResponse:
    """The response with its history: the kernel kept the states after each `every` steps, with turns to the left."""
    states = kept[: (response.steps - 1) // every + 1] * np.array([1, 1, -1, 1, 1, -1])
    times = step * (1 + every * np.arange(len(states)))
    return replace(response, times=times, places=states[..., :3], velocities=states[..., 3:])


def _ground(motion: Accelerogram, vertical: Accelerogram | None) -> kernel.ContactGround:
    """The motion of the ground as the kernel takes it."""
    components = [motion.acceleration]
    if vertical is not None:
        if vertical.acceleration.size != motion.acceleration.size:
            raise MotionError(
                f"the vertical component has {vertical.acceleration.size} samples, but must have "
                f"{motion.acceleration.size}, as the horizontal one; cut both alike."
            )
        components.append(vertical.acceleration)
    samples = np.array(components)
    gains = (samples[:, 1:] + samples[:, :-1]) / 2 * motion.time_step
    return kernel.ContactGround(samples, np.pad(np.cumsum(gains, axis=1), ((0, 0), (1, 0))), motion.time_step)


def _strong(stack: Stack | Stones, motion: Accelerogram, step: float) -> tuple[int, int]:
    """The step from which on the ground may lift a stack at rest, and the one after which it no longer may.

    Half of what lifts is the border, for bodies that still rock.
    """
    lifting = np.flatnonzero(np.abs(motion.acceleration) > 0.5 * stack.resting_multiplier * GRAVITY)
    if not lifting.size:
        return 0, -1
    before, after = max(lifting[0] - 1, 0) * motion.time_step, (lifting[-1] + 1) * motion.time_step
    return int(before / step), math.ceil(after / step)


def _bodies(stack: Stack | Stones) -> kernel.Bodies:
    """The bodies as the kernel takes them."""
    laid = stack.at_rest
    return kernel.Bodies(
        laid.centres,
        laid.corners,
        laid.mobility,
        laid.drops,
        float(stack.friction),
        float(laid.softness),
        np.array(laid.pinned, dtype=float),
    )


def _acting(stack: Stack | Stones) -> kernel.Acting:
    """Forces and ties as the kernel takes them."""
    forces, ties, stops = [], [], []
    centres = stack.at_rest.centres
    for hold in stack.held:
        body = hold.course + 1
        across, up = np.array(hold.point) - centres[body]
        if hold.stop is not None:
            stops.append([body, across, up, hold.stop.stiffness, hold.stop.damping])
        if hold.tie is not None:
            tie = hold.tie
            ties.append([body, across, up, tie.stiffness, tie.pretension, tie.strength, tie.rupture_stretch])
        if any(hold.force):
            forces.append([body, across, up, *hold.force])
    return kernel.Acting(
        np.array(forces).reshape(-1, 5), np.array(ties).reshape(-1, 7), np.array(stops).reshape(-1, 5)
    )


def _beginning(
    stack: Stack | Stones, bodies: kernel.Bodies, initial_velocity: np.ndarray | None
) -> tuple[kernel.State, kernel.JointArrays]:
    """The state in which a stack begins, and its joints, closed."""
    count, ties = len(bodies.centres), sum(hold.tie is not None for hold in stack.held)
    place, velocity = np.zeros((count, 3)), np.zeros((count, 3))
    place[:, :2] = bodies.centres
    if initial_velocity is not None:
        velocity[1 : stack.count + 1] = np.asarray(initial_velocity) * [1, 1, -1]
    state = kernel.State(
        place,
        velocity,
        turns=np.zeros(count),
        most=np.zeros(count),
        stretched=np.zeros(ties),
        faces=np.zeros((count, 4, 2)),
        scale=np.zeros(count),
        work=np.zeros((count, 3, 7)),
        least=np.zeros(3),
        free=np.zeros((count, 3)),
        still=np.zeros((count, 3)),
        pushed=np.zeros((count, 3)),
    )
    joints = kernel.JointArrays(
        gap=np.full((count, 2), np.inf),
        rows=np.zeros((count, 3, 6)),
        pushes=np.zeros((count, 3, 6)),
        impulse=np.zeros((count, 3)),
        touches=np.full(count, kernel.CLOSED),
        slides=np.zeros(count, dtype=np.int64),
    )
    return state, joints
