"""Rigid body, spire and frame against quadrature and closed forms."""

import numpy as np
import pytest
from scipy.integrate import dblquad

from rocking.errors import StructureError, StructureWarning
from rocking.quantities import GRAVITY
from rocking.structures.block import Block, RigidBody
from rocking.structures.frame import Frame
from rocking.structures.spire import Spire


def test_a_rigid_body_of_a_blocks_shape_is_the_block():
    block = Block(2.0, 0.2)
    half, up = block.breadth / 2, block.height / 2
    body = RigidBody(half, half, up, 2.0**2 / 3).mechanism()
    side, expected = body.positive, block.mechanism().positive
    assert body.symmetric
    assert side.frequency_parameter == pytest.approx(expected.frequency_parameter, rel=1e-14)
    assert side.critical_rotation == pytest.approx(0.2, rel=1e-14)
    assert body.restitution == pytest.approx(block.mechanism().restitution, rel=1e-13)


def test_an_off_centre_body_has_two_different_sides():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    mechanism = body.mechanism()
    right, left = mechanism.sides
    assert (right.critical_rotation, left.critical_rotation) == pytest.approx(
        (np.arctan(0.25), np.arctan(0.15))
    )
    for side, corner in ((right, 0.5), (left, 0.3)):
        squared = GRAVITY * np.hypot(corner, 2.0) / (1.4 + corner**2 + 4.0)
        assert side.frequency_parameter == pytest.approx(np.sqrt(squared), rel=1e-14)
    assert mechanism.uplift_multiplier == pytest.approx(0.15)
    assert mechanism.equivalent_block().other_side.critical_rotation == left.critical_rotation


def test_momentum_balance_of_an_off_centre_body_keeps_angular_momentum_about_the_new_corner():
    body = RigidBody(0.3, 0.5, 2.0, 1.4)
    for side, old, new in ((body.mechanism().positive, 0.5, 0.3), (body.mechanism().negative, 0.3, 0.5)):
        # Clockwise spin 1 about a corner `old` to the right: the mass moves right at 2.0 and up at `old`.
        before = (
            1.4 * 1.0 + 2.0 * 2.0 - new * old
        )  # spin + height × v_x − v_y × distance, about the other corner
        after = (1.4 + 2.0**2 + new**2) * side.restitution
        assert after == pytest.approx(before, rel=1e-14)


def test_one_sided_is_a_property_of_single_bodies_with_its_own_restitution():
    for body in (
        Block(2.0, 0.2, 0.4, one_sided=True),
        RigidBody(0.3, 0.5, 2.0, 1.4, 0.4, one_sided=True),
        Spire(3.0, 12.0, restitution=0.4, one_sided=True),
    ):
        mechanism = body.mechanism()
        assert mechanism.one_sided
        assert len(mechanism.sides) == 1
        assert mechanism.restitution == 0.4
        assert mechanism.equivalent_block().one_sided


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

    body = Spire(width, height, wall, plan, crack).body
    mass = integral(lambda x, z: 1.0, 0)
    centre = integral(lambda x, z: z - crack, 0) / mass
    inertia = integral(lambda x, z: x**2 + (z - crack - centre) ** 2, 0) / mass
    assert body.centre_height == pytest.approx(centre, rel=1e-9)
    assert body.inertia == pytest.approx(inertia, rel=1e-9)
    assert body.left == body.right == pytest.approx(width / 2 * (1 - crack / height), rel=1e-15)


def test_a_solid_spire_is_similar_above_every_crack():
    base, cracked = Spire(3.0, 12.0).mechanism(), Spire(3.0, 12.0, crack_height=9.0).mechanism()
    assert cracked.uplift_multiplier == pytest.approx(base.uplift_multiplier, rel=1e-14)
    ratio = cracked.positive.frequency_parameter / base.positive.frequency_parameter
    assert ratio == pytest.approx(2.0, rel=1e-14)


def test_a_frame_without_a_beam_is_its_column():
    column = Block(3.0, 0.15)
    frame, alone = Frame(column, 4, 0.0).mechanism(), column.mechanism()
    assert frame.positive.frequency_parameter == pytest.approx(alone.positive.frequency_parameter, rel=1e-15)
    assert frame.restitution == pytest.approx(alone.restitution, rel=1e-14)


def test_a_squat_frame_has_no_physical_momentum_balance():
    with pytest.warns(StructureWarning, match="not physical"):
        assert Frame(Block(1.0, 0.8), 2, 5.0).mechanism().restitution == 0.0


@pytest.mark.parametrize(
    "make, message",
    [
        (lambda: RigidBody(0.3, 0.0, 2.0, 1.4), "right is"),
        (lambda: RigidBody(0.3, 0.4, 2.0, -1.4), "inertia is -1.4 m²"),
        (
            lambda: Spire(3.0, 12.0, crack_height=12.0),
            "crack_height is 12.0 m, but must lie on the spire.*12.0 m",
        ),
        (lambda: Spire(3.0, 12.0, crack_height=-1.0), "crack_height is -1.0 m"),
        (
            lambda: Spire(3.0, 12.0, 1.5),
            "wall_thickness is 1.5 m, but must be less than half the width, 1.5 m",
        ),
        (lambda: Spire(3.0, 12.0, plan="round"), "plan is"),
        (lambda: Spire(3.0, 12.0, one_sided=True), "one-sided body needs its own number"),
        (lambda: Frame(Block(1, 0.2), 1, 0.3), "columns is 1, but must be a whole number from 2 to 1000"),
        (lambda: Frame(Block(1, 0.2), 2, -0.3), "beam_mass_ratio is"),
        (lambda: Frame(2.0, 2, 0.3), "column is 2.0, but must be a Block"),
    ],
)
def test_bad_geometry_is_refused_in_one_sentence(make, message):
    with pytest.raises(StructureError, match=message):
        make()
