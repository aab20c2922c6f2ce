"""Walls out of plumb: each section stands where its angle puts it, in statics, in motion and as a stack."""

from dataclasses import replace

import numpy as np
import pytest

import rocking
from rocking import Block, Facade
from rocking.errors import DoesNotStandError
from rocking.quantities import GRAVITY
from rocking.structures.building_parts import FreeWall

FRONT = Facade(
    (3.4, 3.1),
    (0.5, 0.4),
    18e3,
    floor_loads=(10e3, 6e3),
    eccentricity=0.1,
    tie_heights=(3.4, 6.2),
    tie_stiffness=2e6,
    tie_strength=9e3,
    tie_plastic_elongation=0.05,
    behind="cross_walls",
    restitution=0.7,
)


@pytest.mark.parametrize("degrees", [-1.5, 0.0, 0.5, 1.0, 2.0])
def test_a_body_that_leans_lifts_and_falls_at_what_is_left_of_its_slenderness(degrees):
    """By hand: its centre of mass, sheared by tan θ, is h/2 (tan α ∓ tan θ) from the edge."""
    lean = np.radians(degrees)
    wide, high = 0.5, 6.0
    outwards = wide / high - np.tan(lean)
    for body in (
        Block.of_size(wide, high, lean=lean),
        Facade((high,), (wide,), 18e3, lean=lean, crack_storey=1),
    ):
        sides = body.mechanism().sides
        assert sides[0].uplift_multiplier == pytest.approx(outwards, rel=1e-12)
        assert sides[0].critical_rotation == pytest.approx(np.arctan(outwards), rel=1e-9)
        assert sides[-1].uplift_multiplier == pytest.approx(wide / high + np.tan(lean), rel=1e-12)
        (course,) = (
            replace(body, crack="known").stack().courses if isinstance(body, Facade) else body.stack().courses
        )
        # p² = g R / I_O, with I_O by Gauss points over the height of the sheared section: exact for its cubic.
        level = high / 2 * (1 + np.array([-1, 1]) / np.sqrt(3))
        from_edge = level * np.tan(lean) - wide / 2
        about_edge = np.mean(from_edge**2 + level**2) + wide**2 / 12
        radius = np.hypot(from_edge.mean(), high / 2)
        assert sides[0].frequency_parameter ** 2 == pytest.approx(GRAVITY * radius / about_edge, rel=1e-12)
        across = course.bottom[1] - course.centre[0]
        assert across / course.centre[1] == pytest.approx(outwards, rel=1e-12)


def test_every_mechanism_of_a_leaning_front_starts_where_limit_analysis_has_it():
    """Two derivations: virtual work of the joints, and the linkage as it moves; between ties of a row, too."""
    apart = replace(FRONT, tie_spacing=3.0, unit_length=0.4, lean=np.radians(1.0))
    compared = []
    for opening, multiplier in apart.held_wall.family():
        # A tie that gives pulls at its yield force in statics, and from nothing on in motion.
        if opening.outwards and (opening.between or not apart.held_wall._yields(opening.kinks)):
            side = apart.opened(opening).mechanism().positive
            assert side.uplift_multiplier == pytest.approx(multiplier, rel=1e-9)
            compared.append(opening)
    assert any(opening.is_triangle for opening in compared)
    assert any(opening.hinge for opening in compared)


def test_one_that_leans_outwards_is_weaker_and_its_stack_leans_with_it():
    leaning = replace(FRONT, lean=np.radians(1.0))
    assert leaning.static_multiplier < FRONT.static_multiplier
    upright, aside = FRONT.stack(), leaning.stack()
    for straight, course in zip(upright.courses, aside.courses, strict=True):
        moved = course.centre[0] - straight.centre[0]
        assert moved == pytest.approx(np.tan(np.radians(1.0)) * course.centre[1], rel=1e-9)
    for straight, held in zip(upright.held, aside.held, strict=True):
        assert held.point[0] - straight.point[0] == pytest.approx(
            np.tan(np.radians(1.0)) * held.point[1], abs=1e-12
        )


def test_what_leans_beyond_its_foot_is_refused_and_leaves_lean_with_their_wall():
    with pytest.raises(DoesNotStandError):
        Block.of_size(0.2, 6.0, lean=np.radians(3.0))
    wall = rocking.structure_from_config(
        {"type": "free_wall", "height_m": 3.0, "thickness_m": 0.5, "leaves_m": [0.25, 0.25], "lean_deg": 1.0}
    )
    assert isinstance(wall, FreeWall)
    for _, leaf in wall.leaves_alone:
        assert leaf.mechanism().positive.uplift_multiplier == pytest.approx(
            0.25 / 3 - np.tan(np.radians(1.0))
        )
