"""Arch and wall against free bars with constraint multipliers: motion to 1e-8, pin forces to 1e-9."""

import numpy as np
import pytest
from multibody import Bar, Multibody, Pin
from scipy.integrate import solve_ivp

from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch
from rocking.structures.wall import Wall


def ground(time):
    return 1.5 * np.sin(7.0 * time + 0.4) - 0.8


def vertical(time):
    return 2.0 * np.cos(11.0 * time)


def sector(inner, outer, start, end):
    """An annular sector of unit density by quadrature over its area: angles from the vertical, clockwise."""
    nodes, weights = np.polynomial.legendre.leggauss(20)
    radius = (outer - inner) / 2 * nodes + (outer + inner) / 2
    angle = (end - start) / 2 * nodes + (end + start) / 2
    radius, angle = np.meshgrid(radius, angle)
    area = np.outer(weights, weights) * radius * (outer - inner) * (end - start) / 4
    points = np.stack([radius * np.sin(angle), radius * np.cos(angle)])
    centre = (area * points).sum(axis=(1, 2)) / area.sum()
    return Bar(area.sum(), (area * ((points - centre[:, None, None]) ** 2).sum(axis=0)).sum(), centre)


def arch_bodies(arch):
    sections = arch.onset.hinges - arch.embrace_angle / 2
    inner, outer = arch.radius - arch.thickness / 2, arch.radius + arch.thickness / 2
    radii = np.array([inner, outer, inner, outer])
    points = np.stack([radii * np.sin(sections), radii * np.cos(sections)], axis=1)
    bars = tuple(sector(inner, outer, *sections[k : k + 2]) for k in range(3))
    pins = (Pin(points[0], 0), Pin(points[1], 1, 0), Pin(points[2], 2, 1), Pin(points[3], 2))
    return Multibody(bars, pins, GRAVITY)


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
    np.testing.assert_allclose(structure.linkage.motion(motion.y[0]).angles.T, angles, rtol=0, atol=1e-8)


@pytest.mark.parametrize("case", CASES)
def test_hinge_thrusts_are_the_constraint_forces(case):
    structure, bodies, speed = CASES[case]
    system, mechanism = bodies(structure), structure.mechanism()
    mass = sum(bar.mass for bar in system.bars)
    if isinstance(structure, Arch):
        mass = structure.embrace_angle * structure.radius * structure.thickness
    for phi, velocity in ((0.0, 0.0), (0.05, speed), (0.6 * mechanism.critical_rotation, -speed)):
        acceleration = mechanism.angular_acceleration(phi, velocity, 1.3, -2.0)
        contacts = structure.contact_forces(phi, velocity, acceleration, 1.3, -2.0)
        motion = structure.linkage.motion(phi)
        _, forces = system.solve(motion.angles, motion.spins * velocity, 1.3, -2.0)
        for hinge in range(len(contacts.names)):
            size = np.hypot(*forces[2 * hinge : 2 * hinge + 2]) / mass
            found = np.hypot(contacts.normal[hinge, 0], contacts.tangential[hinge, 0])
            assert found == pytest.approx(size, rel=1e-9)
