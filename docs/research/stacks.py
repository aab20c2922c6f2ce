"""Stacks of rigid courses on moving ground by contact dynamics in the plane, with the time stepping of Moreau.

Each joint has up to four contacts: a corner of either course on the face of the other. A contact is unilateral, its
shock inelastic, so that an impact keeps what the balance of angular momentum keeps, and its friction is Coulomb's.
LMGC90 does the same for bodies in space, at a hundred times the cost.
"""

import math

import numpy as np
from numba import njit
from numpy.typing import NDArray

from docs.research.comparison.bodies import RigidBodies
from rocking.quantities import GRAVITY

FRICTION = 5.0
"""More than the courses need, so that none slides."""
PRECISION = 1e-3
"""Largest change of an impulse in the last sweep, over the weight above the joint times the step."""
SWEEPS = 20_000
"""Most sweeps over the contacts in one step."""
ALERT = 1e-2
"""Gap within which a contact counts, m."""
REST = 1.0
"""How long the courses must have been nearly upright on still ground to stay up, s."""
Floats = NDArray[np.float64]


def largest_turns(
    bodies: RigidBodies, speed: Floats, step: float, fallen: float, still: int, settled: float
) -> Floats:
    """Return the turns (bodies,) where the largest of them was reached, counterclockwise, rad.

    bodies: each a quadrilateral on the one before, its corners from the lower left; the first is the ground.
    speed: (steps,) of the ground after each `step` [s], m/s. fallen: turn [rad] from which nothing comes back.
    still: step from which the ground rests; then the run ends where nothing turns by more than `settled` [rad].
    """
    masses, centres, gyrations = bodies.properties
    places = np.column_stack([centres.real, centres.imag])
    mobility = 1 / np.column_stack([masses, masses, masses * gyrations])
    mobility[list(bodies.driven)] = 0.0
    mobility[np.ix_(list(bodies.guided), [0, 2])] = 0.0
    above = np.cumsum(masses[::-1])[-2::-1]
    corners = np.array(bodies.polygons) - places[:, None]
    smallest = PRECISION * GRAVITY * step * above
    return _follow(corners, places, mobility, smallest, speed, step, fallen, still, settled)


@njit(cache=True)
def _follow(corners, centres, mobility, smallest, speed, step, fallen, still, settled):
    """Of largest_turns; mobility: (n, 3) inverse inertias along x, z and the turn, 0 where a body is driven."""
    bodies, joints = len(centres), len(centres) - 1
    place = np.zeros((bodies, 3))
    place[:, :2] = centres
    velocity, turns = np.zeros((bodies, 3)), np.zeros(bodies)
    impulse, gap = np.zeros((joints, 4, 2)), np.zeros((joints, 4))
    rows, compliance = np.zeros((joints, 4, 2, 6)), np.zeros((joints, 4, 2))
    quiet = 0
    for number in range(len(speed)):
        place += step / 2 * velocity
        for body in range(bodies):
            if mobility[body, 1] > 0:
                velocity[body, 1] -= step * GRAVITY
            if mobility[body, 0] == 0:
                velocity[body, 0] = speed[number]
        _find_contacts(corners, place, mobility, gap, rows, compliance)
        for joint in range(joints):  # what held in the last step is the first guess
            for contact in range(4):
                if gap[joint, contact] > ALERT:
                    impulse[joint, contact] = 0.0
                for axis in range(2):
                    row, push = rows[joint, contact, axis], impulse[joint, contact, axis]
                    _push(velocity, mobility, joint, row, push)
        for _ in range(SWEEPS):
            if _sweep(velocity, mobility, impulse, gap / step, rows, compliance, ALERT / step, smallest):
                break
        place += step / 2 * velocity
        largest = np.abs(place[:, 2]).max()
        if largest > np.abs(turns).max():
            turns = place[:, 2].copy()
        quiet = quiet + 1 if number > still and largest < settled else 0
        if largest > fallen or quiet * step > REST:
            break
    return turns


@njit(cache=True)
def _find_contacts(corners, place, mobility, gap, rows, compliance):
    """Write the gap [m] of each corner from its face, inf beside it, and how fast it opens and slides per velocity."""
    for joint in range(len(gap)):
        for contact in range(4):
            # A lower corner of the upper course on the lower one, or an upper one of the lower.
            above = contact < 2
            own, other = (joint + 1, joint) if above else (joint, joint + 1)
            x, z = _corner(corners, place, own, contact)
            first_x, first_z = _corner(corners, place, other, 3 if above else 0)
            last_x, last_z = _corner(corners, place, other, 2 if above else 1)
            length = math.hypot(last_x - first_x, last_z - first_z)
            along_x, along_z = (last_x - first_x) / length, (last_z - first_z) / length
            offset = along_x * (x - first_x) + along_z * (z - first_z)
            height = along_x * (z - first_z) - along_z * (x - first_x)
            gap[joint, contact] = max(height if above else -height, 0.0)
            if not -1e-9 <= offset <= length + 1e-9:
                gap[joint, contact] = np.inf
            for axis in range(2):  # away from the lower course, and along it
                push_x, push_z = (-along_z, along_x) if axis == 0 else (along_x, along_z)
                row = rows[joint, contact, axis]
                compliance[joint, contact, axis] = 0.0
                for side in range(2):
                    body, sign = joint + side, 2 * side - 1
                    lever = (x - place[body, 0]) * push_z - (z - place[body, 1]) * push_x
                    row[3 * side : 3 * side + 3] = sign * push_x, sign * push_z, sign * lever
                    for k in range(3):
                        compliance[joint, contact, axis] += mobility[body, k] * row[3 * side + k] ** 2


@njit(cache=True)
def _sweep(velocity, mobility, impulse, closing, rows, compliance, alert, smallest):
    """Correct the impulse of each contact in turn (Gauss and Seidel); return whether none changed much."""
    converged = True
    for joint in range(len(impulse)):
        for contact in range(4):
            if closing[joint, contact] > alert:
                continue
            for axis in range(2):
                row, before = rows[joint, contact, axis], impulse[joint, contact, axis]
                rate = 0.0
                for k in range(3):
                    rate += row[k] * velocity[joint, k] + row[3 + k] * velocity[joint + 1, k]
                if axis == 0:
                    after = before - (rate + closing[joint, contact]) / compliance[joint, contact, axis]
                    after = max(after, 0.0)
                else:
                    most = FRICTION * impulse[joint, contact, 0]
                    after = min(max(before - rate / compliance[joint, contact, axis], -most), most)
                impulse[joint, contact, axis] = after
                _push(velocity, mobility, joint, row, after - before)
                converged &= abs(after - before) <= smallest[joint]
    return converged


@njit(cache=True)
def _push(velocity, mobility, joint, row, impulse):
    for k in range(3):
        velocity[joint, k] += mobility[joint, k] * row[k] * impulse
        velocity[joint + 1, k] += mobility[joint + 1, k] * row[3 + k] * impulse


@njit(cache=True)
def _corner(corners, place, body, corner):
    cosine, sine = math.cos(place[body, 2]), math.sin(place[body, 2])
    x, z = corners[body, corner]
    return place[body, 0] + cosine * x - sine * z, place[body, 1] + sine * x + cosine * z
