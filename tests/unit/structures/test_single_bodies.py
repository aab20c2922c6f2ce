"""Rigid body, spire and frame against quadrature and closed forms."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from rocking.structures.block import RigidBody, Spire


def test_momentum_balance_of_an_off_centre_body_keeps_angular_momentum_about_the_new_corner():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    for side, old, new in ((body.mechanism().positive, 0.5, 0.3), (body.mechanism().negative, 0.3, 0.5)):
        # Clockwise spin 1 about a corner `old` to the right: the mass moves right at 2.0 and up at `old`.
        before = (
            1.4 * 1.0 + 2.0 * 2.0 - new * old
        )  # spin + height × v_x − v_y × distance, about the other corner
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
            total += (
                sign
                * dblquad(
                    lambda t, z, cover=cover: (
                        weight((half := width / 2 * (1 - z / height) - cover) * np.sin(t), z)
                        * depth(half * np.sin(t), half)
                        * half
                        * np.cos(t)
                    ),
                    crack,
                    top,
                    -np.pi / 2,
                    np.pi / 2,
                    epsabs=1e-11,
                    epsrel=1e-11,
                )[0]
            )
        return total

    body = Spire(width, height, wall, plan, crack).linkage
    mass = integral(lambda x, z: 1.0, 0)
    centre = integral(lambda x, z: z - crack, 0) / mass
    inertia = integral(lambda x, z: x**2 + (z - crack - centre) ** 2, 0) / mass
    assert body.rest[0].imag - crack == pytest.approx(centre, rel=1e-9)
    assert body.inertias[0] == pytest.approx(inertia, rel=1e-9)
