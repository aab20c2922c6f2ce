"""The compiled motion of a chain of rigid bodies: contact dynamics in the plane with the time stepping of Moreau.

A stack of courses stands on the ground, its first body; an arch of stones between two, its first body and its last.

Coordinates move with the ground, so that its acceleration is a force on every mass. Each joint may touch at its left
and at its right end: a corner of either course on the face of the other. A contact is unilateral, its shock inelastic,
and its friction Coulomb's. At a joint hold at most three impulses: normal at the left, normal at the right, and along
the joint. What touches, and what slides, is guessed as it was in the step before; the impulses of all joints then
follow at once from equations that couple neighbours only, and the guess is changed until every impulse presses, nothing
goes into anything and friction stays in its cone. Where no guess does after MOST_GUESSES, the impulses are found one
after the other until they no longer change.
"""

import math
from typing import NamedTuple

import numpy as np

from rocking.motion.runs import compiled, entry

ALERT = 1e-2
"""Gap up to which a joint may close within a step, m."""
MOST_GUESSES = 60
"""Guesses of what touches before the impulses are found one after the other."""
MORE_GUESSES = 10
"""Further ones for each body of a chain between two grounds, where more hangs together."""
ALL_AT_ONCE = 12
"""Guesses in which all that was wrong is changed; from then on one contact at a time, which ends without friction."""
SWEEPS = 200
"""Most sweeps over the contacts where they are found one after the other."""
ROUNDING = 1e-9
"""Impulse over that of the weight in a step, and velocity over g times the step, that count as none."""
EDGE = 1e-6
"""The distance of a corner beyond the face that still bears it, over the length of the face."""
REST = 1.0
"""The time that bodies must be nearly upright on still ground, and stones not slide, to count as standing, s."""
CALM = 1e-6
"""Velocity over what weight gains in a step below which a stack rests."""
CREEP = 2e4
"""What soft contacts add to it, over their softness: arches at rest creep, those of sixty voussoirs by up to 8e3."""
SINGULAR = 1e-10
"""Pivot over the compliance of an impulse below which others do all that it does."""
TRIED_EVERY = 20
"""Sweeps between two guesses of what touches from the impulses found so far."""
PRECISION = 1e4
"""Change of an impulse in the last sweep that counts as none, in ROUNDING: a hundred-thousandth of the weight."""
OPEN, LEFT, RIGHT, CLOSED = 0, 1, 2, 3
"""The ends that touch at a joint, in a set of bits."""
FALLS, STAYS, MOVES = 1, 0, 2
"""The endings of a run: a course fell, all rest, or the samples ended first."""


class Bodies(NamedTuple):
    """n courses on the ground, which is body 0; or stones between it and the last body, which is ground, too.

    centres: (n + 1, 2) of mass, m. corners: (n + 1, 4, 2) from the centre, the lower left first, counterclockwise, m.
    mobility: (n + 1, 3) inverse inertias along x, z and the turn, 0 where a body is held. drops: (n + 1,) by how much a
    centre sinks whose body has fallen, m. friction: coefficient. softness: share by which a contact gives more than a
    rigid one, so that of many impulses in equilibrium one choice acts; 0 of a stack. pinned: x, z from the centre of
    the uppermost body of the point that is held sideways; nan where none is.
    """

    centres: np.ndarray
    corners: np.ndarray
    mobility: np.ndarray
    drops: np.ndarray
    friction: float
    softness: float
    pinned: np.ndarray


class Acting(NamedTuple):
    """Forces (k, 5): body, point from its centre [m], force; ties (m, 7): body, point, stiffness, pretension, strength,
    largest elongation before they break [m]; stops (s, 5): body, point, stiffness, damping. An infinite strength is
    elastic. A stop pushes to the right where its point has moved to the left, and never pulls.
    """

    forces: np.ndarray
    ties: np.ndarray
    stops: np.ndarray


class ContactGround(NamedTuple):
    """acceleration: (c, n) samples of the horizontal, and perhaps the vertical, component, m/s². velocity: (c, n) its
    integral from the first one, m/s. spacing: of the samples, s.
    """

    acceleration: np.ndarray
    velocity: np.ndarray
    spacing: float


class Limits(NamedTuple):
    """step: s. gravity: m/s². fallen: turn from which nothing comes back, rad. settled: turn below which a stack on
    still ground rests, rad. start: the first step that is followed. still: step from which the ground rests. steps: the
    most. every: steps between two states that are kept.
    """

    step: float
    gravity: float
    fallen: float
    settled: float
    start: int
    still: int
    steps: int
    every: int


class JointArrays(NamedTuple):
    """The terms of the equations of the impulses, by joint: the last is that of the pin.

    gap: (j, 2) at the left and right end, inf where nothing faces. rows: (j, 3, 6) velocity of the upper body from the
    lower one at each impulse, per velocity of both bodies. pushes: (j, 3, 6) what each impulse does to both bodies.
    impulse: (j, 3). touches: (j,) of OPEN to CLOSED. slides: (j,) 0, or the sign of the friction on the upper body.
    """

    gap: np.ndarray
    rows: np.ndarray
    pushes: np.ndarray
    impulse: np.ndarray
    touches: np.ndarray
    slides: np.ndarray


class State(NamedTuple):
    """The state of a stack and its extremes so far, with room to work in; n + 1 bodies, m ties.

    place: (n + 1, 3) of the centres and turns. velocity: (n + 1, 3). turns: (n + 1,) where their largest was reached,
    rad. most: (n + 1,) the largest turn of each, rad. stretched: (m,) largest elongation so far, m. faces:
    (n + 1, 4, 2) where the corners are. scale: (n + 1,) impulse that counts as none at each joint. work: (n + 1, 3, 7)
    the equations of the impulses, least: (3,) their least pivots, free: (n + 1, 3) velocities, still, pushed: (n + 1,
    3) impulses.
    """

    place: np.ndarray
    velocity: np.ndarray
    turns: np.ndarray
    most: np.ndarray
    stretched: np.ndarray
    faces: np.ndarray
    scale: np.ndarray
    work: np.ndarray
    least: np.ndarray
    free: np.ndarray
    still: np.ndarray
    pushed: np.ndarray


@entry
def follow(bodies, acting, ground, limits, state, joints, history):
    """Return how the run ends, the steps that were followed, and those whose impulses were not found at once.

    state: as it begins, before step `limits.start`; what came of it is written there. history: (k, n + 1, 6), filled
    with place from rest and velocity after every so many steps; none for k = 0.
    """
    count, step = len(bodies.centres), limits.step
    place, velocity = state.place, state.velocity
    weight = limits.gravity * step
    between = _ends_on_ground(bodies)
    calm = (CALM + CREEP * bodies.softness) * weight
    guesses = MOST_GUESSES + (MORE_GUESSES * count if between else 0)
    _fill_scale(bodies, limits, state.scale)
    quiet, swept, largest_of_all = 0, 0, 0.0
    # What has slipped stands elsewhere, and less may move it than half of what lifts: it is watched as long as the
    # ground shakes.
    shaken = max(limits.still, int((len(ground.acceleration[0]) - 1) * ground.spacing / step))
    before_x = _velocity(ground, 0, limits.start * step)
    before_z = _velocity(ground, 1, limits.start * step)
    low, high = _shut(bodies, acting, limits, state, joints)
    for number in range(limits.start, limits.steps):
        now_x = _velocity(ground, 0, (number + 1) * step)
        now_z = _velocity(ground, 1, (number + 1) * step)
        kick_x, fall = now_x - before_x, weight + now_z - before_z
        before_x, before_z = now_x, now_z
        if low < high and low * fall <= kick_x <= high * fall:
            # At rest, and this opens nothing.
            if limits.every > 0 and number % limits.every == 0 and number // limits.every < len(history):
                _keep(bodies, state, history[number // limits.every])
            if number > (limits.still if _widest(joints) <= calm * step else shaken):
                return STAYS, number + 1 - limits.start, swept
            continue
        _drift(place, velocity, step / 2)
        _pull(bodies, acting, kick_x, fall, limits, state)
        _find_contacts(bodies, place, state.faces, joints)
        found = _solve(bodies, joints, velocity, limits, state, guesses)
        if not found and not _sweep(bodies, joints, velocity, limits, state):
            swept += 1
        low, high = _shut(bodies, acting, limits, state, joints)
        _drift(place, velocity, step / 2)
        largest, dropped = 0.0, False
        for body in range(1, count):
            dropped = dropped or bodies.centres[body, 1] - place[body, 1] > bodies.drops[body]
            turn = abs(place[body, 2])
            state.most[body] = max(state.most[body], turn)
            largest = max(largest, turn)
        if largest > largest_of_all:
            largest_of_all = largest
            for body in range(count):
                state.turns[body] = place[body, 2]
        if limits.every > 0 and number % limits.every == 0 and number // limits.every < len(history):
            _keep(bodies, state, history[number // limits.every])
        if largest > limits.fallen or dropped:
            return FALLS, number + 1 - limits.start, swept
        settles = largest < limits.settled
        if between and number > limits.still:
            # A stone that slips out need not turn, and one that has come to rest may have turned.
            settles = (settles and _sliding(joints) == 0) or (number > shaken and _is_calm(velocity, calm))
        quiet = quiet + 1 if number > limits.still and settles else 0
        if quiet * step > REST:
            return STAYS, number + 1 - limits.start, swept
    return MOVES, limits.steps - limits.start, swept


@compiled
def _sliding(joints):
    """The number of joints that slide."""
    number = 0
    for joint in range(len(joints.slides)):
        number += abs(joints.slides[joint])
    return number


@compiled
def _velocity(ground, component, time):
    """The velocity of the ground, exact for an acceleration linear between samples; as at the last one after it."""
    if component >= len(ground.acceleration):
        return 0.0
    samples = ground.acceleration[component]
    time = min(time, (len(samples) - 1) * ground.spacing)
    interval = min(int(time / ground.spacing), len(samples) - 2)
    offset = time - interval * ground.spacing
    slope = (samples[interval + 1] - samples[interval]) / ground.spacing
    return ground.velocity[component, interval] + samples[interval] * offset + slope * offset * offset / 2


@compiled
def _widest(joints):
    """The largest gap at an end of a joint."""
    gap = 0.0
    for joint in range(len(joints.gap) - 1):
        gap = max(gap, joints.gap[joint, 0], joints.gap[joint, 1])
    return gap


@compiled
def _is_calm(velocity, calm):
    """Whether nothing moves faster than `calm`."""
    for body in range(len(velocity)):
        for axis in range(3):
            if abs(velocity[body, axis]) > calm:
                return False
    return True


@compiled
def _halt(velocity):
    for body in range(len(velocity)):
        for axis in range(3):
            velocity[body, axis] = 0.0


@compiled
def _shut(bodies, acting, limits, state, joints):
    """Return the least and the largest gain of the ground, over that of weight, that opens nothing of a stack at rest.

    The impulses of what touches are linear in what the ground gains in a step; each must press, and friction stay in
    its cone. 0, 0 of a stack that moves, slides, or is held by a tie that was tightened. A joint may be open at one
    end, as in an arch that slipped and rests on other hinges. What touches at rest is one choice of several where more
    touches than need be: beyond its bounds a step finds another one.
    """
    count, velocity = len(bodies.centres), state.velocity
    weight = limits.gravity * limits.step
    calm = (CALM + CREEP * bodies.softness) * weight
    if not _is_calm(velocity, calm):
        return 0.0, 0.0
    for joint in range(count - 1):
        if joints.touches[joint] == OPEN or joints.slides[joint] != 0:
            return 0.0, 0.0
    for number in range(len(acting.ties)):
        if acting.ties[number, 4] > 0:
            return 0.0, 0.0
    _find_contacts(bodies, state.place, state.faces, joints)
    for joint in range(count - 1):
        for end in range(2):
            if joints.touches[joint] >> end & 1 == 1 and joints.gap[joint, end] > calm * limits.step:
                return 0.0, 0.0
    still, pushed = state.still, state.pushed
    for kept, gain in ((still, 0.0), (pushed, weight)):
        _halt(velocity)
        _pull(bodies, acting, gain, weight, limits, state)
        _impulses(bodies, joints, velocity, limits.step, state)
        for joint in range(count):
            for k in range(3):
                kept[joint, k] = joints.impulse[joint, k]
                _push(bodies, joints, velocity, joint, k, joints.impulse[joint, k])
        if not _is_calm(velocity, calm):
            _halt(velocity)
            return 0.0, 0.0
    _halt(velocity)
    low, high = -np.inf, np.inf
    for joint in range(count - 1):
        for k in range(4):
            # Impulses that must not be negative: two that press, and what is left of friction to either side.
            if k < 2:
                here, after = still[joint, k], pushed[joint, k]
            else:
                sign = 5.0 - 2.0 * k
                here = bodies.friction * (still[joint, 0] + still[joint, 1]) - sign * still[joint, 2]
                after = bodies.friction * (pushed[joint, 0] + pushed[joint, 1]) - sign * pushed[joint, 2]
            gained = after - here
            here += state.scale[joint]
            if gained < 0:
                high = min(high, -here / gained)
            elif gained > 0:
                low = max(low, -here / gained)
            elif here < 0:
                return 0.0, 0.0
    return low, high


@compiled
def _drift(place, velocity, time):
    for body in range(len(place)):
        for axis in range(3):
            place[body, axis] += time * velocity[body, axis]


@compiled
def _keep(bodies, state, line):
    for body in range(len(state.place)):
        for axis in range(3):
            rest = bodies.centres[body, axis] if axis < 2 else 0.0
            line[body, axis] = state.place[body, axis] - rest
            line[body, 3 + axis] = state.velocity[body, axis]


@compiled
def _fill_scale(bodies, limits, scale):
    """Write the impulse that counts as none at each joint, from the mass above it; between two grounds from all."""
    count, above = len(bodies.centres), 0.0
    for body in range(count - 1, -1, -1):
        scale[body] = ROUNDING * above * limits.gravity * limits.step
        if bodies.mobility[body, 1] > 0:
            above += 1 / bodies.mobility[body, 1]
    scale[count - 1] = scale[max(count - 2, 0)]
    if _ends_on_ground(bodies):
        scale[:] = ROUNDING * above * limits.gravity * limits.step
    return scale


@compiled
def _ends_on_ground(bodies):
    """Whether nothing moves the last body."""
    last = len(bodies.centres) - 1
    return bodies.mobility[last, 0] == 0 and bodies.mobility[last, 1] == 0 and bodies.mobility[last, 2] == 0


@compiled
def _pull(bodies, acting, kick, fall, limits, state):
    """Add to the velocities what the ground, gravity, forces, ties and stops give within a step."""
    step, mobility = limits.step, bodies.mobility
    place, velocity, stretched = state.place, state.velocity, state.stretched
    for body in range(1, len(place)):
        if mobility[body, 1] > 0:
            velocity[body, 1] -= fall
        if mobility[body, 0] > 0:
            velocity[body, 0] -= kick
    for number in range(len(acting.forces)):
        body = int(acting.forces[number, 0])
        across, up = _arm(place[body, 2], acting.forces[number, 1], acting.forces[number, 2])
        share = fall / limits.gravity  # a force is a weight: it grows with g + ü_v
        _give(
            velocity,
            mobility,
            body,
            across,
            up,
            share * acting.forces[number, 3],
            share * acting.forces[number, 4],
        )
    for number in range(len(acting.ties)):
        tie = acting.ties[number]
        body = int(tie[0])
        across, up = _arm(place[body, 2], tie[1], tie[2])
        stretch = place[body, 0] + across - bodies.centres[body, 0] - tie[1]
        stretched[number] = max(stretched[number], stretch)
        tension = 0.0
        if stretch >= 0 and stretched[number] <= tie[6]:
            plastic = max(stretched[number] - (tie[5] - tie[4]) / tie[3], 0.0) if tie[5] < np.inf else 0.0
            tension = min(max(tie[4] + tie[3] * (stretch - plastic), 0.0), tie[5])
        _give(velocity, mobility, body, across, up, -step * tension, 0.0)
    for number in range(len(acting.stops)):
        stop = acting.stops[number]
        body = int(stop[0])
        across, up = _arm(place[body, 2], stop[1], stop[2])
        pressed = bodies.centres[body, 0] + stop[1] - place[body, 0] - across
        if pressed > 0:
            closing = -(velocity[body, 0] - up * velocity[body, 2])
            force = max(stop[3] * pressed + stop[4] * closing, 0.0)
            _give(velocity, mobility, body, across, up, step * force, 0.0)


@compiled
def _arm(turn, across, up):
    cosine, sine = math.cos(turn), math.sin(turn)
    return cosine * across - sine * up, sine * across + cosine * up


@compiled
def _give(velocity, mobility, body, across, up, push_x, push_z):
    velocity[body, 0] += mobility[body, 0] * push_x
    velocity[body, 1] += mobility[body, 1] * push_z
    velocity[body, 2] += mobility[body, 2] * (across * push_z - up * push_x)


@compiled
def _find_contacts(bodies, place, faces, joints):
    """Write the gap at both ends of every joint, and how fast it opens and slides per velocity of both bodies."""
    count = len(place)
    for body in range(count):
        cosine, sine = math.cos(place[body, 2]), math.sin(place[body, 2])
        for corner in range(4):
            x, z = bodies.corners[body, corner]
            faces[body, corner, 0] = place[body, 0] + cosine * x - sine * z
            faces[body, corner, 1] = place[body, 1] + sine * x + cosine * z
    for joint in range(count - 1):
        lower, upper = faces[joint], faces[joint + 1]
        # Along the top of the lower course, and along the bottom of the upper one.
        low_x, low_z, low = _along(lower[3], lower[2])
        high_x, high_z, high = _along(upper[0], upper[1])
        for end in range(2):
            joints.gap[joint, end] = np.inf
            x, z = upper[end]
            from_x, from_z = x - lower[3, 0], z - lower[3, 1]
            offset = low_x * from_x + low_z * from_z
            if -EDGE * low <= offset <= (1 + EDGE) * low:
                height = low_x * from_z - low_z * from_x
                _write(joints, joint, end, x, z, low_x, low_z, height, place)
                continue
            x, z = lower[3 - end]
            from_x, from_z = x - upper[0, 0], z - upper[0, 1]
            offset = high_x * from_x + high_z * from_z
            if -EDGE * high <= offset <= (1 + EDGE) * high:
                height = high_z * from_x - high_x * from_z
                _write(joints, joint, end, x, z, high_x, high_z, height, place)
    if not math.isnan(bodies.pinned[0]):
        last = count - 1
        _, up = _arm(place[last, 2], bodies.pinned[0], bodies.pinned[1])
        joints.rows[last, 2, 0], joints.rows[last, 2, 2] = 1.0, -up


@compiled
def _along(first, last):
    x, z = last[0] - first[0], last[1] - first[1]
    length = math.hypot(x, z)
    return x / length, z / length, length


@compiled
def _write(joints, joint, end, x, z, along_x, along_z, height, place):
    """Write the rows of a contact at x, z; the row along the joint is that of the end with the smaller gap."""
    joints.gap[joint, end] = max(height, 0.0)
    _row(joints.rows[joint, end], joint, x, z, -along_z, along_x, place)
    if end == 0 or joints.gap[joint, 1] < joints.gap[joint, 0]:
        _row(joints.rows[joint, 2], joint, x, z, along_x, along_z, place)


@compiled
def _row(row, joint, x, z, push_x, push_z, place):
    for side in range(2):
        body, sign = joint + side, 2.0 * side - 1.0
        lever = (x - place[body, 0]) * push_z - (z - place[body, 1]) * push_x
        row[3 * side], row[3 * side + 1], row[3 * side + 2] = sign * push_x, sign * push_z, sign * lever


@compiled
def _solve(bodies, joints, velocity, limits, state, guesses):
    """Find what touches and the impulses of this step, and add them to the velocities; return whether it was found."""
    count = len(velocity)
    for joint in range(count - 1):
        facing = (LEFT if joints.gap[joint, 0] <= ALERT else 0) | (
            RIGHT if joints.gap[joint, 1] <= ALERT else 0
        )
        joints.touches[joint] &= facing
        if joints.touches[joint] == OPEN:
            joints.slides[joint] = 0
    step, speed = limits.step, ROUNDING * 10.0 * limits.step
    for guess in range(guesses):
        _impulses(bodies, joints, velocity, step, state)
        if _mend(bodies, joints, velocity, state.scale, step, speed, guess < ALL_AT_ONCE):
            for joint in range(count):
                for k in range(3):
                    _push(bodies, joints, velocity, joint, k, joints.impulse[joint, k])
            return True
    return False


@compiled
def _holds(bodies, joints, joint, k, count):
    """Whether an impulse may act at a joint."""
    if joint == count - 1:
        return k == 2 and not math.isnan(bodies.pinned[0])
    if k == 2:
        return joints.touches[joint] != OPEN and joints.slides[joint] == 0
    return joints.touches[joint] >> k & 1 == 1


# One elimination over three equations a joint, compiled; cut, its matrix would be handed on.
@compiled
def _impulses(bodies, joints, velocity, step, state):
    """Solve for the impulses of all joints: three equations each, coupled to those of its neighbours (Thomas)."""
    count, mobility = len(velocity), bodies.mobility
    work, least = state.work, state.least
    for joint in range(count):
        matrix = work[joint]
        for k in range(3):
            friction = joints.slides[joint] * bodies.friction if k < 2 else 0.0
            for axis in range(6):
                push = joints.rows[joint, k, axis] + friction * joints.rows[joint, 2, axis]
                joints.pushes[joint, k, axis] = push
        held = (
            _holds(bodies, joints, joint, 0, count),
            _holds(bodies, joints, joint, 1, count),
            _holds(bodies, joints, joint, 2, count),
        )
        for k in range(3):
            row = joints.rows[joint, k]
            for column in range(7):
                matrix[k, column] = 0.0
            if not held[k]:
                matrix[k, k] = 1.0
                least[k] = 0.0
                continue
            rate = joints.gap[joint, k] / step if k < 2 else 0.0
            for axis in range(3):
                rate += row[axis] * velocity[joint, axis]
                if joint < count - 1:
                    rate += row[3 + axis] * velocity[joint + 1, axis]
            matrix[k, 6] = -rate
            for other in range(3):
                if not held[other]:
                    continue
                push = joints.pushes[joint, other]
                value = 0.0
                for axis in range(3):
                    value += row[axis] * mobility[joint, axis] * push[axis]
                    if joint < count - 1:
                        value += row[3 + axis] * mobility[joint + 1, axis] * push[3 + axis]
                matrix[k, other] = value
            matrix[k, k] *= 1.0 + bodies.softness
            least[k] = SINGULAR * matrix[k, k]
            if joint == 0:
                continue
            # The joint beneath acts on the lower body of this one; its impulses are those it has, less what they owe
            # to the impulses here: p₋ = f − E p, of which work[joint − 1] holds E (3:6) and f (6).
            before = work[joint - 1]
            for other in range(3):
                push = joints.pushes[joint - 1, other]
                value = 0.0
                for axis in range(3):
                    value += row[axis] * mobility[joint, axis] * push[3 + axis]
                if value != 0.0:
                    matrix[k, 6] -= value * before[other, 6]
                    for here in range(3):
                        matrix[k, here] -= value * before[other, 3 + here]
        if joint < count - 1:
            _couple(bodies, joints, joint, held, matrix, count)
        _eliminate(matrix, joints.slides[joint] == 0, least)
    for joint in range(count - 1, -1, -1):
        matrix = work[joint]
        for k in range(3):
            value = matrix[k, 6]
            if joint < count - 1:
                for other in range(3):
                    value -= matrix[k, 3 + other] * joints.impulse[joint + 1, other]
            joints.impulse[joint, k] = value


@compiled
def _couple(bodies, joints, joint, held, matrix, count):
    """Write how the impulses of the joint above act at this one, columns 3 to 5."""
    upper = joint + 1
    for other in range(3):
        if not _holds(bodies, joints, upper, other, count):
            continue
        row_above = joints.rows[upper, other]
        for k in range(3):
            if not held[k]:
                continue
            value = 0.0
            for axis in range(3):
                push = row_above[axis]
                if other < 2 and joints.slides[upper] != 0:
                    push += joints.slides[upper] * bodies.friction * joints.rows[upper, 2, axis]
                value += joints.rows[joint, k, 3 + axis] * bodies.mobility[upper, axis] * push
            matrix[k, 3 + other] = value


@compiled
def _eliminate(matrix, is_symmetric, least):
    """Turn the first three columns of a (3, 7) into the unit matrix; symmetric without friction, else by pivots.

    least: (3,) pivots below which an impulse does nothing that others do not, as that of a joint between two bodies
    which the ground holds upright; it is none.
    """
    for k in range(3):
        pivot = k
        if not is_symmetric:
            for other in range(k + 1, 3):
                if abs(matrix[other, k]) > abs(matrix[pivot, k]):
                    pivot = other
        if pivot != k:
            for column in range(7):
                matrix[k, column], matrix[pivot, column] = matrix[pivot, column], matrix[k, column]
        if abs(matrix[k, k]) <= least[k]:
            for column in range(7):
                matrix[k, column] = 0.0
            for other in range(3):
                matrix[other, k] = 0.0
            matrix[k, k] = 1.0
            continue
        factor = 1 / matrix[k, k]
        for column in range(k, 7):
            matrix[k, column] *= factor
        for other in range(3):
            share = matrix[other, k]
            if other != k and share != 0.0:
                for column in range(k, 7):
                    matrix[other, column] -= share * matrix[k, column]


@compiled
def _rate(bodies, joints, velocity, joint, k):
    """Velocity at which a joint opens or slides once all impulses have acted."""
    value, row = 0.0, joints.rows[joint, k]
    for side in range(2):
        body = joint + side
        for axis in range(3):
            own = velocity[body, axis]
            for other in range(3):
                own += bodies.mobility[body, axis] * (
                    joints.impulse[body, other] * joints.pushes[body, other, axis]
                )
                if body > 0:
                    own += bodies.mobility[body, axis] * (
                        joints.impulse[body - 1, other] * joints.pushes[body - 1, other, 3 + axis]
                    )
            value += row[3 * side + axis] * own
    return value


@compiled
def _mend(bodies, joints, velocity, scale, step, speed, all_at_once):
    """Change what was guessed wrongly; return whether nothing was."""
    right = True
    for joint in range(len(velocity) - 1):
        touches, slides = joints.touches[joint], joints.slides[joint]
        now = touches
        for end in range(2):
            bit = 1 << end
            if touches & bit:
                if joints.impulse[joint, end] < -scale[joint]:
                    now &= ~bit
            elif joints.gap[joint, end] <= ALERT:
                closing = _rate(bodies, joints, velocity, joint, end) + joints.gap[joint, end] / step
                if closing < -speed:
                    now |= bit
            if now != touches and not all_at_once:
                break
        if now == touches and touches != OPEN:
            pressing = joints.impulse[joint, 0] + joints.impulse[joint, 1]
            if slides == 0:
                if abs(joints.impulse[joint, 2]) > bodies.friction * pressing + scale[joint]:
                    joints.slides[joint] = 1 if joints.impulse[joint, 2] > 0 else -1
                    right = False
            elif slides * _rate(bodies, joints, velocity, joint, 2) > speed:
                joints.slides[joint] = 0
                right = False
        if now != touches:
            if touches == OPEN or now == OPEN:
                joints.slides[joint] = 0
            joints.touches[joint] = now
            right = False
        if not right and not all_at_once:
            return False
    return right


@compiled
def _push(bodies, joints, velocity, joint, k, impulse):
    if impulse == 0.0:
        return
    for axis in range(3):
        velocity[joint, axis] += bodies.mobility[joint, axis] * joints.pushes[joint, k, axis] * impulse
        if joint < len(velocity) - 1:
            velocity[joint + 1, axis] += (
                bodies.mobility[joint + 1, axis] * joints.pushes[joint, k, 3 + axis] * impulse
            )


@compiled
def _sweep(bodies, joints, velocity, limits, state):
    """Find the impulses one after the other (Gauss and Seidel), up and down the stack, until none changes.

    What touches and slides then is tried at once now and again, which ends most of these searches. Return whether it
    did.
    """
    count = len(velocity)
    free, kept = state.free, state.still
    scale, step = state.scale, limits.step
    pinned = not math.isnan(bodies.pinned[0])
    for body in range(count):
        for axis in range(3):
            free[body, axis] = velocity[body, axis]
    for joint in range(count):
        for k in range(3):
            joints.impulse[joint, k] = 0.0
            for axis in range(6):
                joints.pushes[joint, k, axis] = joints.rows[joint, k, axis]
    for sweep in range(SWEEPS):
        change = 0.0
        for place in range(count if pinned else count - 1):
            joint = place if sweep % 2 == 0 else (count if pinned else count - 1) - 1 - place
            for k in range(3):
                if joint < count - 1:
                    if k < 2 and not joints.gap[joint, k] <= ALERT:
                        continue
                    if k == 2 and min(joints.gap[joint, 0], joints.gap[joint, 1]) > ALERT:
                        continue
                elif k < 2:
                    continue
                change = max(change, _correct(bodies, joints, velocity, joint, k, step) / scale[joint])
        done = change <= PRECISION
        if not done and (sweep + 1) % TRIED_EVERY != 0:
            continue
        for joint in range(count):
            for k in range(3):
                kept[joint, k] = joints.impulse[joint, k]
        _guess(bodies, joints, scale)
        if _solve(bodies, joints, free, limits, state, ALL_AT_ONCE):
            for body in range(count):
                for axis in range(3):
                    velocity[body, axis] = free[body, axis]
            return True
        for joint in range(count):
            for k in range(3):
                joints.impulse[joint, k] = kept[joint, k]
                for axis in range(6):
                    joints.pushes[joint, k, axis] = joints.rows[joint, k, axis]
        if done:
            break
    _guess(bodies, joints, scale)
    return False


@compiled
def _guess(bodies, joints, scale):
    """Take from the impulses what touches, and what slides."""
    for joint in range(len(joints.touches) - 1):
        touches = 0
        for end in range(2):
            if joints.impulse[joint, end] > 0:
                touches |= 1 << end
        along = joints.impulse[joint, 2]
        most = bodies.friction * (joints.impulse[joint, 0] + joints.impulse[joint, 1])
        slides = touches != OPEN and abs(along) >= most - scale[joint]
        joints.touches[joint] = touches
        joints.slides[joint] = 0 if not slides else 1 if along > 0 else -1


@compiled
def _correct(bodies, joints, velocity, joint, k, step):
    """Correct one impulse; return by how much it changed."""
    row, before, last = joints.rows[joint, k], joints.impulse[joint, k], len(velocity) - 1
    rate = joints.gap[joint, k] / step if k < 2 else 0.0
    compliance = 0.0
    for axis in range(3):
        rate += row[axis] * velocity[joint, axis]
        compliance += bodies.mobility[joint, axis] * row[axis] ** 2
        if joint < last:
            rate += row[3 + axis] * velocity[joint + 1, axis]
            compliance += bodies.mobility[joint + 1, axis] * row[3 + axis] ** 2
    after = before - rate / compliance
    if joint < last:
        if k < 2:
            after = max(after, 0.0)
        else:
            most = bodies.friction * (joints.impulse[joint, 0] + joints.impulse[joint, 1])
            after = min(max(after, -most), most)
    joints.impulse[joint, k] = after
    _push(bodies, joints, velocity, joint, k, after - before)
    return abs(after - before)
