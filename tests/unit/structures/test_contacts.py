"""Contact forces of single bodies from the second derivative of their motion, and the flags."""

import numpy as np
import pytest

from rocking.quantities import GRAVITY
from rocking.structures.block import Block, RigidBody
from rocking.structures.wall import Wall


def test_at_rest_the_base_carries_the_weight_and_needs_the_ground_acceleration_as_friction():
    found = Wall(2.0, 2.0, 0.4).contact_forces(0.0, 0.0, 0.0, 0.0)
    assert found.normal[0, 0] == pytest.approx(GRAVITY, rel=1e-14)
    assert found.normal[1, 0] == pytest.approx(GRAVITY / 2, rel=1e-14)
    block = Block(2.0, 0.2).contact_forces(0.0, 0.0, 0.0, [0.5, -1.0])
    np.testing.assert_allclose(block.required_friction[0], np.array([0.5, 1.0]) / GRAVITY, rtol=1e-14)


def test_at_zero_rotation_the_velocity_chooses_the_side():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    leaving = body.mechanism().angular_acceleration([0.0, 0.0], [0.4, -0.4])
    inside = body.mechanism().angular_acceleration([1e-13, -1e-13], [0.4, -0.4])
    np.testing.assert_allclose(leaving, inside, rtol=1e-11)
    found = body.contact_forces([0.0, 0.0], [0.4, -0.4], leaving)
    expected = body.contact_forces([1e-13, -1e-13], [0.4, -0.4], inside)
    np.testing.assert_allclose(found.normal, expected.normal, rtol=1e-11)
    np.testing.assert_allclose(found.tangential, expected.tangential, rtol=1e-11)
