"""Rigid body and spire against quadrature and closed forms, and what contacts carry at rest and at φ = 0."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from rocking.quantities import GRAVITY
from rocking.structures import Block, RigidBody, Spire
from rocking.structures.linkage import MotionState


def test_momentum_balance_of_an_off_centre_body_keeps_angular_momentum_about_the_new_corner():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    for side, old, new in ((body.mechanism().positive, 0.5, 0.3), (body.mechanism().negative, 0.3, 0.5)):
        # Clockwise spin 1 about a corner `old` to the right: the mass moves right at 2.0 and up at `old`. About the
        # other corner that is spin + height × v_x − v_y × distance.
        before = 1.4 * 1.0 + 2.0 * 2.0 - new * old
        after = (1.4 + 2.0**2 + new**2) * side.restitution
        assert after == pytest.approx(before, rel=1e-14)


@pytest.mark.parametrize("plan", ["circular", "square"])
@pytest.mark.parametrize("wall, crack", [(None, 0.0), (None, 4.0), (0.3, 0.0), (0.3, 4.0), (0.3, 11.0)])
def test_spire_mass_properties_by_quadrature(plan, wall, crack):
    width, height = 3.0, 12.0

    def depth(x, half):
        """Extent across the plane of rocking at x in a section of that half width."""
        if half <= 0 or abs(x) > half:
            return 0.0
        return 2 * np.sqrt(half**2 - x**2) if plan == "circular" else 2 * half

    def integral(weight, z):
        """∫∫ weight · depth over the outer solid less the inner one; x = half · sin t takes out the edge."""
        total = 0.0
        for sign, cover in ((1, 0.0), (-1, wall)):
            if cover is None:
                continue
            top = height * (1 - 2 * cover / width)
            if crack >= top:
                continue

            def column(t, z, cover=cover):
                half = width / 2 * (1 - z / height) - cover
                return weight(half * np.sin(t), z) * depth(half * np.sin(t), half) * half * np.cos(t)

            within = crack, top, -np.pi / 2, np.pi / 2
            total += sign * dblquad(column, *within, epsabs=1e-11, epsrel=1e-11)[0]
        return total

    spire = Spire(width, height, wall, plan, crack)
    assert np.ptp(spire.outline()[0][:, 0]) == pytest.approx(width)  # at its base, whether that moves or not
    body = spire.linkages[0]
    mass = integral(lambda x, z: 1.0, 0)
    centre = integral(lambda x, z: z - crack, 0) / mass
    inertia = integral(lambda x, z: x**2 + (z - crack - centre) ** 2, 0) / mass
    assert body.rest[0].imag - crack == pytest.approx(centre, rel=1e-9)
    assert body.inertias[0] == pytest.approx(inertia, rel=1e-9)


def test_at_zero_rotation_the_velocity_chooses_the_side():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    leaving = body.mechanism().angular_acceleration([0.0, 0.0], [0.4, -0.4])
    inside = body.mechanism().angular_acceleration([1e-13, -1e-13], [0.4, -0.4])
    np.testing.assert_allclose(leaving, inside, rtol=1e-11)
    mechanism = body.mechanism()
    found = body.contact_forces(MotionState.of(mechanism, [0.0, 0.0], [0.4, -0.4], leaving))
    expected = body.contact_forces(MotionState.of(mechanism, [1e-13, -1e-13], [0.4, -0.4], inside))
    np.testing.assert_allclose(found.normal, expected.normal, rtol=1e-11)
    np.testing.assert_allclose(found.tangential, expected.tangential, rtol=1e-11)


def test_a_block_at_rest_needs_the_ground_acceleration_over_g_as_friction():
    block = Block(2.0, 0.2)
    found = block.contact_forces(MotionState.of(block.mechanism(), 0.0, 0.0, 0.0, [0.5, -1.0]))
    np.testing.assert_allclose(found.required_friction[0], np.array([0.5, 1.0]) / GRAVITY, rtol=1e-14)
