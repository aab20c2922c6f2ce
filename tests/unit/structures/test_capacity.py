"""Capacity curves: static balance at every point, closed forms, participating mass by hand."""

import numpy as np
import pytest

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures import Arch, ArchOnPiers, Block, Facade, LoadedWall, RigidBody, Wall

STRUCTURES = {
    "block": Block.of_size(0.6, 6.0),
    "body": RigidBody(0.4, 0.6, 2.0, 1.5),
    "wall": Wall(1.5, 2.5, 0.4),
    "loaded wall": LoadedWall(2.0, 1.4, 0.3, 19e3, top_load=9e3, eccentricity=0.08),
    "arch": Arch(5.0, 1.0, np.radians(165)),
    "arch on piers": ArchOnPiers(5.0, 0.8, np.radians(150), pier_width=2.2, pier_height=4.0),
    "façade": Facade((3.5, 3.0), (0.6, 0.5), 20e3, floor_loads=(12e3, 6e3), thrust=1e3),
}


@pytest.mark.parametrize("name", STRUCTURES)
def test_the_multiplier_just_holds_the_structure_at_every_rotation(name):
    """A ground acceleration of −s λ g leaves a structure at rest at φ where it is; it ends where nothing is needed."""
    structure = STRUCTURES[name]
    mechanism = structure.mechanism()
    for sign, side in zip((1, -1), mechanism.sides, strict=False):
        curve = structure.capacity_curve(sign, 9)
        assert curve.multiplier[0] == pytest.approx(side.uplift_multiplier, rel=1e-13)
        assert curve.multiplier[-1] == pytest.approx(0.0, abs=1e-12)
        assert curve.displacement[0] == 0 and (np.diff(curve.displacement) > 0).all()
        held = mechanism.angular_acceleration(
            sign * curve.rotation[1:], 0.0, -sign * curve.multiplier[1:] * GRAVITY
        )
        scale = GRAVITY * side.at("gravity", 0.0) / side.at("inertia", 0.0)
        np.testing.assert_allclose(held, 0.0, atol=1e-12 * scale)


def test_a_block_has_its_closed_form():
    """λ = tan(α − φ); the top inner corner leads; all mass takes part, at half the height."""
    block = STRUCTURES["block"]
    curve = block.capacity_curve(count=5)
    np.testing.assert_allclose(curve.multiplier, np.tan(block.slenderness - curve.rotation), atol=1e-15)
    across, up = 0.6, 6.0
    corners = [
        -across * np.cos(curve.rotation) + up * np.sin(curve.rotation) + across,
        up * np.sin(curve.rotation),
    ]
    assert any(np.allclose(curve.displacement, each, rtol=1e-12) for each in corners)
    assert curve.control_point[1] == 6.0
    assert curve.participating_mass_ratio == pytest.approx(1.0, rel=1e-9)
    np.testing.assert_allclose(curve.effective_displacement, curve.displacement / 2, rtol=1e-6)


def test_participating_mass_of_a_facade_by_hand():
    """Weights 42, 30, 12 and 6 kN/m at 1.75, 5, 3.5 and 6.5 m, which are also their virtual displacements."""
    curve = STRUCTURES["façade"].capacity_curve()
    weights, heights = np.array([42.0, 30.0, 12.0, 6.0]), np.array([1.75, 5.0, 3.5, 6.5])
    first, second = weights @ heights, weights @ heights**2
    assert curve.participating_mass_ratio == pytest.approx(first**2 / (weights.sum() * second), rel=1e-8)
    expected = curve.displacement[1:] * second / (6.5 * first)
    np.testing.assert_allclose(curve.effective_displacement[1:], expected, rtol=1e-6)


def test_the_control_point_of_a_wall_is_at_its_hinge():
    curve = STRUCTURES["wall"].capacity_curve()
    assert curve.control_point[1] == pytest.approx(1.5)


def test_a_side_that_is_not_there_is_refused():
    with pytest.raises(StructureError, match="side is -1, but must be 1, or -1 where the structure rocks"):
        Block(2.0, 0.2, 0.5, one_sided=True).capacity_curve(-1)
    with pytest.raises(StructureError, match="count is 1, but must be 2 or more"):
        STRUCTURES["block"].capacity_curve(count=1)
