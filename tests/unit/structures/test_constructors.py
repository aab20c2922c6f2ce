"""The constructors of structures: what they refuse, and what they tell."""

import numpy as np
import pytest

import rocking
from rocking.errors import RockingError, StructureError
from rocking.structures.kinds import StructureKind
from tests.refusals import refused

TIED = {"tie_heights": (1.6,), "tie_strength": 4e3}


@pytest.mark.parametrize(
    ("make", "field"),
    [
        (lambda: rocking.LoadedWall(1.6, 1.6, 0.25, 20e3, tie_stiffness=5e-324, **TIED), "tie_stiffness"),
        (lambda: rocking.LoadedWall(1.6, 1.6, 0.25, 20e3, tie_stiffness=1e308, **TIED), "tie_stiffness"),
        (lambda: rocking.Facade((3.5,), (0.6,), 1e308), "unit_weight"),
        (lambda: rocking.structure_from_config({"type": "x" * 3_000_000}), "type"),
        (lambda: rocking.structure_from_config({"type": "wall", "h" * 3_000_000: 1}), "h" * 3_000_000),
        (lambda: rocking.plot(3), "thing"),
    ],
)
def test_extreme_values_are_refused_in_one_short_sentence(make, field):
    with refused(RockingError, field) as caught:
        make()
    assert str(caught.value).endswith((".", ")")) and "\n" not in str(caught.value)
    assert len(str(caught.value)) < 600


def test_a_pier_of_no_density_of_masonry_is_refused():
    piers = {"type": "arch_on_piers", "radius_m": 5, "thickness_m": 0.8, "embrace_angle_deg": 150}
    piers |= {"pier_width_m": 2.0, "pier_height_m": 3.0}
    rocking.structure_from_config(piers)
    with refused(StructureError, "pier_density_ratio", "1e+308"):
        rocking.structure_from_config(piers | {"pier_density_ratio": 1e308})


def test_a_very_stiff_tie_is_taken_with_the_same_warning_by_facade_and_wall():
    """An elastic tie never lets go: the wall reaches no balance, the façade none before it lies on the ground."""
    ties = {"unit_weight": 18e3, "tie_heights": (2.8,), "tie_stiffness": 1e9}
    facade = rocking.Facade(
        (3.0,), (0.4,), floor_loads=(10e3,), **ties, behind="cross_walls", restitution=0.9
    )
    wall = rocking.LoadedWall.of_size(3.0, 0.4, hinge_height=1.5, **ties, one_sided=True, restitution=0.9)
    assert not wall.mechanism().can_overturn
    assert facade.mechanism().critical_rotation == pytest.approx(np.pi / 2, abs=1e-3)
    for structure in (facade, wall):
        unusual = structure.described.warnings[0]
        assert (unusual.kind, unusual.about) == (StructureKind.SIZE_UNUSUAL, "tie_stiffness_kN_m2")
        assert (unusual["value"], unusual["unit"]) == (pytest.approx(1e6), " kN/m²")


def test_a_structure_tells_what_is_unusual_about_it():
    assert repr(rocking.Wall.of_size(5, 0.5, 2.5)) == "Wall(height 5 m, thickness 0.5 m, hinge height 2.5 m)"
    assert "height_m is 500 m, but is usually between 0.5 and 60 m" in repr(rocking.Wall.of_size(500, 5, 250))
