"""Stacks of rigid courses on moving ground by contact dynamics: the most expensive method, which asks for no mechanism.

The compiled steps stand in `kernel.py`. They are of first order in the time step, and near a limit the outcome
changes with it, so that one run says less than the share of several (`assessment/contacts.py`).
"""

import math
from dataclasses import dataclass, replace

import numpy as np

from rocking.contacts import kernel
from rocking.errors import MotionError
from rocking.quantities import GRAVITY, finite
from rocking.records import Accelerogram
from rocking.structures.stack import Stack

STEP = 5e-4
"""Time step, s: the target `stack` of docs/research says how far a rotation is then from its limit."""
AFTERWARDS = 20.0
"""The longest time that a stack is followed on still ground, s: it then rocks by what no longer overturns it."""
SHORTEST = 1e-6
"""Shortest time step, s."""


@dataclass(frozen=True, eq=False)
class StackResponse:
    """The response of a stack: whether a course falls, and the largest turn of each.

    falls: whether a course turned further than it comes back from. turns: (n,) of the courses where the largest of
    them was reached, clockwise positive, rad. largest_turns: (n,) the largest of each, rad. steps: that were followed.
    unsolved_steps: those whose impulses were found one after the other, to a hundred-thousandth, not at once.
    With history: times (k,) s; places (k, n, 3), how far each centre of mass moved to the right and up beside the
    ground [m] and its clockwise turn [rad]; velocities (k, n, 3) of these.

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
        """The number of courses beneath the joint that had opened most where the largest turn was reached."""
        return int(np.abs(np.diff(self.turns, prepend=0.0)).argmax())


def follow_stack(
    stack: Stack,
    motion: Accelerogram,
    step: float = STEP,
    *,
    vertical: Accelerogram | None = None,
    history: bool = False,
    initial_velocity: np.ndarray | None = None,
) -> StackResponse:
    """Follow the courses of `stack` through `motion`, linear between its samples, and on until they rest or fall.

    step: time step, s. vertical: ü_v, sample by sample as `motion`. history: keep states, one a sample of the motion or
    every step where that is longer. initial_velocity: (n, 3) of the courses to the right and up [m/s] and clockwise
    [rad/s]; at rest without it. Raises MotionError for a step that is too long for the stack, or another number of
    samples.

    >>> record = rocking.read("records/synthetic_strong_pulse.AT2")[0]
    >>> rocking.follow_stack(rocking.Block.of_size(breadth=0.6, height=4.0).stack(), record).falls
    True
    """
    step = finite(MotionError, "step", step, "s")
    longest = stack.longest_step
    if not SHORTEST <= step <= longest:
        raise MotionError(
            f"the time step is {step:.4g} s, but must be {SHORTEST:g} to {longest:.4g} s, which the smallest course "
            "and the stiffest tie of this stack allow; give a shorter step, or join courses."
        )
    kicks, still = _strong(stack, _kicks(motion, vertical, step), step, whole=history or vertical is not None)
    kicks = np.vstack([kicks, np.zeros((math.ceil(AFTERWARDS / step), 2))])
    bodies = _bodies(stack)
    every = max(round(motion.time_step / step), 1) if history else 0
    kept = np.zeros((len(kicks) // every + 1 if every else 0, len(stack.courses) + 1, 6))
    settled = min(each.slenderness for each in stack.courses if not (each.guided or each.upright)) / 30
    limits = kernel.Limits(step, GRAVITY, stack.fallen_turn, settled, still, every)
    state, joints = _beginning(stack, bodies, initial_velocity)
    ending, steps, swept = kernel.follow(bodies, _acting(stack), kicks, limits, state, joints, kept)
    response = StackResponse(
        falls=ending == kernel.FALLS,
        turns=-state.turns[1:],
        largest_turns=state.most[1:],
        steps=steps,
        unsolved_steps=swept,
    )
    return _with_history(response, kept, step, every) if every else response


def _with_history(response: StackResponse, kept: np.ndarray, step: float, every: int) -> StackResponse:
    """The response with its history: the kernel kept the states after each `every` steps, with turns to the left."""
    states = kept[: (response.steps - 1) // every + 1, 1:] * np.array([1, 1, -1, 1, 1, -1])
    times = step * (1 + every * np.arange(len(states)))
    return replace(response, times=times, places=states[..., :3], velocities=states[..., 3:])


def _kicks(motion: Accelerogram, vertical: Accelerogram | None, step: float) -> np.ndarray:
    """The velocity (steps, 2) that the ground gains in each step, exact for an acceleration linear between samples."""
    times = np.arange(math.ceil(motion.duration / step) + 1) * step
    gains = []
    for component in (motion, vertical):
        if component is None:
            gains.append(np.zeros(len(times) - 1))
            continue
        if component.acceleration.size != motion.acceleration.size:
            raise MotionError(
                f"the vertical component has {component.acceleration.size} samples, but must have "
                f"{motion.acceleration.size}, as the horizontal one; cut both alike."
            )
        gains.append(np.diff(_velocity(component, times)))
    return np.column_stack(gains)


def _strong(stack: Stack, kicks: np.ndarray, step: float, whole: bool) -> tuple[np.ndarray, int]:
    """The steps from where the ground may lift a stack at rest on, and the first one from which it no longer may.

    Half of what lifts is the border, for bodies that still rock. whole: all of them are needed.
    """
    lifting = np.flatnonzero(np.abs(kicks[:, 0]) > 0.5 * stack.resting_multiplier * GRAVITY * step)
    if whole or not lifting.size:
        return kicks, len(kicks)
    return kicks[lifting[0] :], int(lifting[-1] - lifting[0]) + 1


def _velocity(motion: Accelerogram, times: np.ndarray) -> np.ndarray:
    """The integral of the acceleration from the first sample, m/s; zero acceleration after the last."""
    samples, spacing = motion.acceleration, motion.time_step
    whole = np.append(0.0, np.cumsum((samples[1:] + samples[:-1]) / 2 * spacing))
    at = np.minimum(times, motion.duration)
    interval = np.minimum((at / spacing).astype(int), samples.size - 2)
    offset = at - interval * spacing
    slope = (samples[interval + 1] - samples[interval]) / spacing
    gained: np.ndarray = whole[interval] + samples[interval] * offset + slope * offset**2 / 2
    return gained


def _bodies(stack: Stack) -> kernel.Bodies:
    """The courses on the ground as the kernel takes them."""
    first, last = stack.courses[0], stack.courses[-1]
    left, right = first.bottom
    left, right = 2 * left - right, 2 * right - left
    depth = stack.height
    low, high = first.base - depth, first.base
    ground = np.array([[left, low], [right, low], [right, high], [left, high]])
    centres = np.array([[0.0, first.base - depth / 2], *(each.centre for each in stack.courses)])
    corners = np.array([ground, *(each.corners for each in stack.courses)]) - centres[:, None]
    mobility = [[0.0, 0.0, 0.0]]
    for each in stack.courses:
        across = 0.0 if each.guided else 1 / each.mass
        turning = 0.0 if each.guided or each.upright else 1 / each.inertia
        mobility.append([across, 1 / each.mass, turning])
    pinned = np.full(2, np.nan)
    if stack.top_held_at is not None:
        pinned = np.array(stack.top_held_at) - last.centre
    return kernel.Bodies(centres, corners, np.array(mobility), float(stack.friction), pinned)


def _acting(stack: Stack) -> kernel.Acting:
    """Forces and ties as the kernel takes them."""
    forces, ties = [], []
    for each in stack.held:
        across, up = np.array(each.point) - stack.courses[each.course].centre
        body = each.course + 1
        if each.tie is not None:
            tie = each.tie
            ties.append([body, across, up, tie.stiffness, tie.pretension, tie.strength, tie.rupture_stretch])
        if any(each.force):
            forces.append([body, across, up, *each.force])
    return kernel.Acting(np.array(forces).reshape(-1, 5), np.array(ties).reshape(-1, 7))


def _beginning(
    stack: Stack, bodies: kernel.Bodies, initial_velocity: np.ndarray | None
) -> tuple[kernel.State, kernel.Joints]:
    """The state in which a stack begins, and its joints, closed."""
    count, ties = len(bodies.centres), sum(each.tie is not None for each in stack.held)
    place, velocity = np.zeros((count, 3)), np.zeros((count, 3))
    place[:, :2] = bodies.centres
    if initial_velocity is not None:
        velocity[1:] = np.asarray(initial_velocity) * [1, 1, -1]
    state = kernel.State(
        place,
        velocity,
        turns=np.zeros(count),
        most=np.zeros(count),
        stretched=np.zeros(ties),
        faces=np.zeros((count, 4, 2)),
        scale=np.zeros(count),
        work=np.zeros((count, 3, 7)),
    )
    joints = kernel.Joints(
        gap=np.full((count, 2), np.inf),
        rows=np.zeros((count, 3, 6)),
        pushes=np.zeros((count, 3, 6)),
        impulse=np.zeros((count, 3)),
        touches=np.full(count, kernel.CLOSED),
        slides=np.zeros(count, dtype=np.int64),
    )
    return state, joints
