"""Arch and wall against free bars with constraint multipliers: motion to 1e-8, pin forces to 1e-9."""

import numpy as np
import pytest
from free_bars import BOTH, ONE, SMOOTH, UNDER_FILL, free_bars, pier_part, places_of, ring_part
from multibody import Bar, Multibody, Pin
from scipy.integrate import solve_ivp

from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch, ArchOnPiers
from rocking.structures.linkage import MotionState
from rocking.structures.wall import Wall


def ground(time):
    return 1.5 * np.sin(7.0 * time + 0.4) - 0.8


def vertical(time):
    return 2.0 * np.cos(11.0 * time)


def arch_bodies(arch):
    return free_bars(arch, places_of(arch))


def wall_bodies(wall):
    h1, h2, t = wall.lower_height, wall.upper_height, wall.thickness
    bars = (
        Bar(h1 * t, h1 * t * (h1**2 + t**2) / 12, np.array([0.0, h1 / 2])),
        Bar(h2 * t, h2 * t * (h2**2 + t**2) / 12, np.array([0.0, h1 + h2 / 2])),
    )
    pins = (
        Pin(np.array([t / 2, 0.0]), 0),
        Pin(np.array([-t / 2, h1]), 1, 0),
        Pin(np.array([t / 2, h1 + h2]), 1, None, (0,)),
    )
    return Multibody(bars, pins, GRAVITY)


CASES = {
    "arch": (Arch(3.0, 0.6, np.radians(165)), arch_bodies, 0.6),
    "thick arch": (Arch(1.0, 0.35, np.radians(180)), arch_bodies, 1.2),
    "voussoir arch": (Arch(10.0, 1.5, np.radians(157.5), 7), arch_bodies, 0.25),
    "arch under fill": (SMOOTH, arch_bodies, 3 * SMOOTH.mechanism().critical_rotation),
    "arch and a pier": (ONE, arch_bodies, 3 * ONE.mechanism().critical_rotation),
    "arch and two piers": (BOTH, arch_bodies, 3 * BOTH.mechanism().critical_rotation),
    "arch and piers under fill": (UNDER_FILL, arch_bodies, 3 * UNDER_FILL.mechanism().critical_rotation),
    "wall": (Wall(2.0, 2.0, 0.4), wall_bodies, 1.0),
    "low hinge": (Wall(1.2, 2.5, 0.4), wall_bodies, 1.5),
    "high hinge": (Wall(2.5, 1.2, 0.4), wall_bodies, 0.6),
}


@pytest.mark.parametrize("case", CASES)
def test_motion_is_that_of_free_bars_with_constraints(case):
    structure, bodies, speed = CASES[case]
    mechanism = structure.mechanism()
    times = np.linspace(0.0, 0.25, 26)

    def rate(time, state):
        acceleration = mechanism.angular_acceleration(state[0], state[1], ground(time), vertical(time))
        return [state[1], float(acceleration)]

    motion = solve_ivp(rate, (0.0, times[-1]), [0.0, speed], "DOP853", times, rtol=1e-12, atol=1e-14)
    angles, spins = bodies(structure).simulate(-speed, times, ground, vertical)
    assert motion.y[0].max() > 0.3 * mechanism.critical_rotation, "the motion is no small one"
    assert motion.y[0].min() >= 0, "the mechanism of one side is followed"
    np.testing.assert_allclose(-angles[:, 0], motion.y[0], rtol=0, atol=1e-8 * np.abs(motion.y[0]).max())
    np.testing.assert_allclose(-spins[:, 0], motion.y[1], rtol=0, atol=1e-8 * np.abs(motion.y[1]).max())
    np.testing.assert_allclose(structure.linkages[0].motion(motion.y[0]).angles.T, angles, rtol=0, atol=1e-8)


@pytest.mark.parametrize("case", CASES)
def test_hinge_thrusts_are_the_constraint_forces(case):
    structure, bodies, speed = CASES[case]
    system, mechanism = bodies(structure), structure.mechanism()
    mass = sum(bar.mass for bar in system.bars)
    if isinstance(structure, Arch):
        half = structure.embrace_angle / 2
        mass = ring_part(structure, -half, half)[0].sum()
    if isinstance(structure, ArchOnPiers):
        mass += sum(pier_part(structure, side)[0].sum() for side in (-1, 1))
    for phi, velocity in ((0.0, 0.0), (0.05, speed), (0.6 * mechanism.critical_rotation, -speed)):
        acceleration = mechanism.angular_acceleration(phi, velocity, 1.3, -2.0)
        contacts = structure.contact_forces(
            MotionState.of(structure.mechanism(), phi, velocity, acceleration, 1.3, -2.0)
        )
        motion = structure.linkages[0].motion(phi)
        _, forces = system.solve(motion.angles, motion.spins * velocity, 1.3, -2.0)
        for hinge in range(len(contacts.names)):
            size = np.hypot(*forces[2 * hinge : 2 * hinge + 2]) / mass
            found = np.hypot(contacts.normal[hinge, 0], contacts.tangential[hinge, 0])
            assert found == pytest.approx(size, rel=1e-9)
            if isinstance(structure, Arch):
                # square through a radial joint or a level foot, midway between the turned faces
                point = structure.hinges()[hinge]
                distance = np.hypot(*point)
                radial = np.isclose(abs(distance - structure.radius), structure.thickness / 2)
                along = np.array([point[1], -point[0]]) / distance if radial else np.array([0.0, 1.0])
                turn = np.exp(1j * np.convolve(np.squeeze(motion.angles), [0.5, 0.5])[hinge])
                across = turn * complex(*along)
                pressing = abs(forces[2 * hinge : 2 * hinge + 2] @ [across.real, across.imag]) / mass
                assert abs(contacts.normal[hinge, 0]) == pytest.approx(pressing, rel=1e-9)
                if velocity == 0:
                    assert contacts.normal[hinge, 0] > 0, "a ring that starts from rest is pressed together"
