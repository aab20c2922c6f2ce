"""Capacity curves: static balance at every point, closed forms, participating mass by hand."""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from rocking.codes.code_capacity import CodeCapacity
from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures import Arch, ArchOnPiers, Block, Facade, LoadedWall, RigidBody, Wall
from tests.refusals import refused

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
        ground = -sign * curve.multiplier[1:] * GRAVITY
        held = mechanism.angular_acceleration(sign * curve.rotation[1:], 0.0, ground)
        scale = GRAVITY * side.at("gravity", 0.0) / side.at("inertia", 0.0)
        np.testing.assert_allclose(held, 0.0, atol=1e-12 * scale)


def test_participating_mass_of_a_facade_by_hand():
    """Weights 42, 30, 12 and 6 kN/m at 1.75, 5, 3.5 and 6.5 m, which are also their virtual displacements."""
    curve = STRUCTURES["façade"].capacity_curve()
    assert curve.multiplier.size == 41
    weights, heights = np.array([42.0, 30.0, 12.0, 6.0]), np.array([1.75, 5.0, 3.5, 6.5])
    first, second = weights @ heights, weights @ heights**2
    assert curve.participating_mass_ratio == pytest.approx(first**2 / (weights.sum() * second), rel=1e-8)
    expected = curve.displacement[1:] * second / (6.5 * first)
    np.testing.assert_allclose(curve.effective_displacement[1:], expected, rtol=1e-6)


def test_a_load_that_only_rises_takes_no_part_sideways():
    wall = LoadedWall.of_size(3.2, 0.25, 20e3, 1.9, top_load=30e3, top_slab="flat")
    assert wall.capacity_curve().participating_mass_ratio == pytest.approx(1.0, rel=1e-9)


def test_a_structure_that_rocks_to_one_side_has_the_curve_of_that_side_alone():
    both, one = (Block.of_size(0.6, 6.0, restitution=0.5, one_sided=choice) for choice in (False, True))
    assert np.array_equal(one.capacity_curve(1).multiplier, both.capacity_curve(1).multiplier)
    assert np.array_equal(both.capacity_curve(-1).multiplier, both.capacity_curve(1).multiplier)
    for structure, side in ((one, -1), (both, 0)):
        with refused(StructureError, "side", side):
            structure.capacity_curve(side)
    with refused(StructureError, "count", 1):
        both.capacity_curve(count=1)


@pytest.mark.parametrize(("heights", "elongation"), [((3.8,), 0.6), ((1.5, 3.8), 0.8), ((1.5, 3.8), 0.6)])
def test_it_collapses_where_what_does_not_break_until_then_lets_go(heights, elongation):
    """The balance of one body about its toe by hand: W R sin(α − φ) against the ties that have not broken.

    The tie of 3.8 m breaks as it has moved by its elongation and F/k. What overturns as it breaks has no more than the
    others at hand; where these hold it beyond that, it overturns later, as they let go.
    """
    weight, strength, stiffness = 36e3, 3e3, 5e6
    front = Facade(
        (4.0,),
        (0.5,),
        unit_weight=18e3,
        restitution=0.8,
        behind="cross_walls",
        tie_heights=heights,
        tie_stiffness=stiffness,
        tie_strength=strength,
        tie_plastic_elongation=elongation,
        crack="known",
        crack_storey=1,
    )
    capacity = CodeCapacity(front.candidates()[0], front.static_capacity(), confidence_factor=1.0)
    slenderness = math.atan(0.5 / 4.0)

    def without_the_upper_tie(rotation):
        lower = strength * 1.5 * math.cos(rotation) if 1.5 in heights else 0.0
        return weight * math.hypot(0.25, 2.0) * math.sin(slenderness - rotation) + lower

    rupture = math.asin((elongation + strength / stiffness) / 3.8)
    collapse = brentq(without_the_upper_tie, 0.0, 0.5, xtol=1e-15)
    assert capacity.ruptures == pytest.approx((rupture,), rel=1e-9)
    assert capacity.collapse_rotation == pytest.approx(collapse, rel=1e-9)
    assert capacity.static.side.critical_rotation == pytest.approx(max(rupture, collapse), rel=1e-9)


def test_what_stands_at_rest_by_a_tie_that_breaks_bears_nothing_without_it():
    """The thrust of 3 kN/m at 3.5 m overturns 36 kN/m on half a thickness of 0.25 m."""
    ties = {"tie_heights": (3.8,), "tie_stiffness": 5e6, "tie_strength": 6e3, "tie_pretension": 4e3}
    front = Facade((4.0,), (0.5,), 18e3, behind="cross_walls", restitution=0.8, thrust=3e3, thrust_height=3.5,
                   tie_plastic_elongation=0.6, crack="known", crack_storey=1, **ties)  # fmt: skip
    capacity = CodeCapacity(front.candidates()[0], front.static_capacity(), confidence_factor=1.0)
    assert len(capacity.ruptures) == 1 and capacity.collapse_rotation == 0.0
