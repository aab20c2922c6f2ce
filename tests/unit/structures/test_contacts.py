"""Contact forces of single bodies from the second derivative of their motion, and the flags."""

import numpy as np
import pytest

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.block import Block, RigidBody
from rocking.structures.bodies import Contacts, UnknownContacts
from rocking.structures.frame import Frame
from rocking.structures.spire import Spire
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


def test_spire_rocks_as_its_body():
    spire = Spire(3.0, 12.0, 0.3, crack_height=4.0)
    state = (0.1, 0.3, -0.5, 1.0, 0.2)
    np.testing.assert_array_equal(
        spire.contact_forces(*state).normal, spire.body.contact_forces(*state).normal
    )


def test_at_rest_the_base_carries_the_weight_and_needs_the_ground_acceleration_as_friction():
    found = Wall(2.0, 2.0, 0.4).contact_forces(0.0, 0.0, 0.0, 0.0)
    assert found.normal[0, 0] == pytest.approx(GRAVITY, rel=1e-14)
    assert found.normal[1, 0] == pytest.approx(GRAVITY / 2, rel=1e-14)
    block = Block(2.0, 0.2).contact_forces(0.0, 0.0, 0.0, [0.5, -1.0])
    np.testing.assert_allclose(block.friction_needed[0], np.array([0.5, 1.0]) / GRAVITY, rtol=1e-14)


@pytest.mark.parametrize("structure", [Block(2.0, 0.2), Wall(1.5, 2.5, 0.4)])
def test_along_a_response_the_acceleration_is_the_mechanisms(structure):
    rotation, velocity = np.array([0.0, 0.02, -0.03, 0.0]), np.array([0.0, 0.3, 0.1, 0.2])
    ground, vertical = np.array([0.4, 1.0, -2.0, 0.7]), np.array([0.0, 0.1, 0.3, -0.2])
    found = structure.contact_history(rotation, velocity, ground, vertical)
    acceleration = structure.mechanism().angular_acceleration(rotation, velocity, ground, vertical)
    expected = structure.contact_forces(rotation, velocity, acceleration, ground, vertical)
    np.testing.assert_array_equal(found.normal[:, 1:], expected.normal[:, 1:])
    np.testing.assert_array_equal(found.tangential[:, 1:], expected.tangential[:, 1:])
    if isinstance(structure, Block):
        assert found.friction_needed[0, 0] == pytest.approx(0.4 / GRAVITY, rel=1e-14)
    else:
        assert np.isnan(found.friction_needed[:, 0]).all()
        assert not (found.friction_needed[:, 0] > 0.5).any()
        assert not found.opens[:, 0].any()


def test_flags():
    contacts = Contacts(("corner",), np.array([[2.0, -1.0, 4.0]]), np.array([[1.0, 0.5, -3.0]]))
    np.testing.assert_array_equal(contacts.friction_needed, [[0.5, np.inf, 0.75]])
    np.testing.assert_array_equal(contacts.opens, [[False, True, False]])
    np.testing.assert_array_equal(contacts.friction_needed > 0.6, [[False, True, True]])


def test_a_fast_fall_of_a_wide_body_lifts_off():
    """Centripetal acceleration beyond g: the corner would have to pull."""
    found = Block(2.0, 0.3).contact_forces(0.1, [0.0, 4.0], 0.0)
    np.testing.assert_array_equal(found.opens, [[False, True]])


def test_constant_vertical_acceleration_is_scaled_gravity():
    """−0.2 g of vertical acceleration is gravity times 0.8: time runs slower by sqrt(0.8)."""
    for structure in (Block(2.0, 0.2), Wall(1.5, 2.5, 0.4), RigidBody(0.3, 0.5, 2.0, 1.4)):
        mechanism = structure.mechanism()
        rotation, velocity, ground = np.array([0.05, -0.05]), np.array([0.4, -0.2]), 1.3
        lightened = mechanism.angular_acceleration(rotation, velocity, ground, -0.2 * GRAVITY)
        slowed = mechanism.angular_acceleration(rotation, velocity / np.sqrt(0.8), ground / 0.8)
        np.testing.assert_allclose(lightened, 0.8 * slowed, rtol=1e-14)


def test_at_zero_rotation_the_velocity_chooses_the_side():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    leaving = body.mechanism().angular_acceleration([0.0, 0.0], [0.4, -0.4])
    inside = body.mechanism().angular_acceleration([1e-13, -1e-13], [0.4, -0.4])
    np.testing.assert_allclose(leaving, inside, rtol=1e-11)
    found = body.contact_forces([0.0, 0.0], [0.4, -0.4], leaving)
    expected = body.contact_forces([1e-13, -1e-13], [0.4, -0.4], inside)
    np.testing.assert_allclose(found.normal, expected.normal, rtol=1e-11)
    np.testing.assert_allclose(found.tangential, expected.tangential, rtol=1e-11)


def test_angular_acceleration_mirrors():
    mechanism = Wall(1.5, 2.5, 0.4).mechanism()
    one = mechanism.angular_acceleration(0.05, 0.3, 2.0, 1.0)
    other = mechanism.angular_acceleration(-0.05, -0.3, -2.0, 1.0)
    assert one == -other


def test_what_is_not_known_is_refused():
    with pytest.raises(UnknownContacts, match="contact forces of a frame are statically indeterminate"):
        Frame(Block(3.0, 0.15), 2, 0.4).contact_forces(0.1, 0.0, 0.0)
    leaning = Block(2.0, 0.2, 0.5, one_sided=True).mechanism()
    with pytest.raises(StructureError, match="one-sided mechanism rocks to the positive side only"):
        leaning.angular_acceleration(-0.1, 0.0)
