"""Contact forces of single bodies from the second derivative of their motion, and the flags."""

import numpy as np
import pytest

from rocking.quantities import GRAVITY
from rocking.structures.block import Block, RigidBody
from rocking.structures.wall import Wall


def centroid(polygon):
    x, y = polygon.T
    turn = x * np.roll(y, -1) - np.roll(x, -1) * y
    return np.array([((x + np.roll(x, -1)) * turn).sum(), ((y + np.roll(y, -1)) * turn).sum()]) / (
        3 * turn.sum()
    )


def rotation_at(time):
    return 0.1 + 0.04 * np.sin(3 * time)


@pytest.mark.parametrize("body", [Block(2.0, 0.2), RigidBody(0.3, 0.5, 2.0, 1.4)])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_force_of_the_ground_is_mass_times_acceleration_and_gravity(body, sign):
    """The drawing's centre of mass is differentiated numerically along a motion; ü_g and ü_v are added."""
    time, step, ground, vertical = 0.3, 4e-3, 1.7, -0.9
    weights = {
        0: -205 / 72,
        1: 8 / 5,
        2: -1 / 5,
        3: 8 / 315,
        4: -1 / 560,
    }  # eighth order, truncation near 1e-13
    path = {k: centroid(body.outline(sign * rotation_at(time + k * step))[0]) for k in range(-4, 5)}
    acceleration = sum(weights[abs(k)] * path[k] for k in path) / step**2
    found = body.contact_forces(
        sign * rotation_at(time),
        sign * 0.12 * np.cos(3 * time),
        -sign * 0.36 * np.sin(3 * time),
        ground,
        vertical,
    )
    assert found.names == ("corner",)
    assert found.normal[0, 0] == pytest.approx(GRAVITY + vertical + acceleration[1], abs=1e-8)
    assert found.tangential[0, 0] == pytest.approx(sign * (ground + acceleration[0]), abs=1e-8)


def test_at_rest_the_base_carries_the_weight_and_needs_the_ground_acceleration_as_friction():
    found = Wall(2.0, 2.0, 0.4).contact_forces(0.0, 0.0, 0.0, 0.0)
    assert found.normal[0, 0] == pytest.approx(GRAVITY, rel=1e-14)
    assert found.normal[1, 0] == pytest.approx(GRAVITY / 2, rel=1e-14)
    block = Block(2.0, 0.2).contact_forces(0.0, 0.0, 0.0, [0.5, -1.0])
    np.testing.assert_allclose(block.friction_needed[0], np.array([0.5, 1.0]) / GRAVITY, rtol=1e-14)


def test_at_zero_rotation_the_velocity_chooses_the_side():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    leaving = body.mechanism().angular_acceleration([0.0, 0.0], [0.4, -0.4])
    inside = body.mechanism().angular_acceleration([1e-13, -1e-13], [0.4, -0.4])
    np.testing.assert_allclose(leaving, inside, rtol=1e-11)
    found = body.contact_forces([0.0, 0.0], [0.4, -0.4], leaving)
    expected = body.contact_forces([1e-13, -1e-13], [0.4, -0.4], inside)
    np.testing.assert_allclose(found.normal, expected.normal, rtol=1e-11)
    np.testing.assert_allclose(found.tangential, expected.tangential, rtol=1e-11)
