"""Held walls: statics, table, ensemble and code check take one list, whose least λ is that of limit analysis."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from courses import Courses

from rocking.assessment.cracks import cracks, mechanisms_of
from rocking.codes.check import CodeTerms
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.static_check import kinematic_check
from rocking.errors import DoesNotStandError, StructureError
from rocking.structures import Facade, LoadedWall

WEIGHT = 18e3
PARTS = 20
SPECTRUM = DesignSpectrum.ntc(1.5, 2.5, 0.35, "B")

ABOVE = Facade(
    (3.6,),
    (0.4,),
    WEIGHT,
    floor_loads=(3e3,),
    restitution=0.6,
    behind="cross_walls",
    tie_heights=(3.0,),
    tie_stiffness=2e7,
)


def least_of_courses(wall, thicknesses, levels, stops, loads, held, behind=()):
    """The least λ to either side of the wall laid in courses, PARTS between two `stops` [m], forces in kN.

    loads: (x, z, weight, rides). held: heights that ties hold outwards, or, where `behind` is None, both ways. behind:
    heights at which something behind holds it inwards.
    """
    joints = np.unique(
        np.concatenate([np.linspace(low, high, PARTS + 1) for low, high in pairwise([*stops, levels[-1]])])
    )
    middles = (joints[1:] + joints[:-1]) / 2
    thick = np.array(thicknesses)[np.searchsorted(levels, middles) - 1]
    courses = Courses(joints, -thick, 0 * thick, WEIGHT / 1e3 * thick * np.diff(joints), loads=loads)
    if behind is None:
        courses.stops = held
    else:
        courses.ties = [(z, np.inf) for z in held]
        courses.floors = list(joints[1:]) if behind == "everywhere" else list(behind)
    return min(courses.multiplier(direction) for direction in (1, -1))


def told(wall):
    """The least λ that statics, the table, the ensemble and the code check take."""
    checked = kinematic_check(wall, SPECTRUM, CodeTerms()).mechanisms
    return {
        "statics": wall.static_multiplier,
        "table": min(mechanism.uplift_multiplier for mechanism in mechanisms_of(wall)),
        "ensemble": min(candidate.uplift_multiplier for candidate in wall.candidates() if candidate.counts),
        "check": min(item.onset_multiplier for item in checked),
    }


def test_above_a_tie_inside_a_storey_the_wall_falls_from_the_tie_on():
    """By hand: .6 × .4 m with 3 kN/m at mid-thickness on top, about its outer edge at the tie."""
    weight = WEIGHT * 0.4 * 0.6
    by_hand = (weight + 3e3) * 0.2 / (weight * 0.3 + 3e3 * 0.6)
    assert told(ABOVE) == pytest.approx(dict.fromkeys(told(ABOVE), by_hand), rel=1e-9)
    # What the tie keeps shut for good is no crack.
    assert all(one_crack.position >= 3.0 for one_crack in cracks(ABOVE) if not one_crack.bulges)
    assert [crack.description for crack in cracks(ABOVE) if crack.bulges] == [
        "hinge at 1.996 m (bulges between foot and tie)"
    ]


@pytest.mark.parametrize("one_storey", [True, False])
@pytest.mark.parametrize("fronts", [6, pytest.param(50, marks=pytest.mark.slow)])
def test_one_list_with_a_tie_below_the_top(one_storey, fronts):
    """Drawn fronts with a tie .25 to 1.6 m below their top; joints of the courses lie a twentieth of a span apart."""
    draw = np.random.default_rng(62 + one_storey)
    governed = set()
    for _ in range(fronts):
        storeys = 1 if one_storey else 2
        heights = draw.uniform(2.8, 4.2, storeys)
        thicknesses = np.sort(draw.uniform(0.3, 0.6, storeys))[::-1]
        levels = [0.0, *np.cumsum(heights).tolist()]
        tie = levels[-1] - float(draw.uniform(0.25, 1.6))
        floors = draw.uniform(2e3, 15e3, storeys)
        behind = str(draw.choice(["floors", "cross_walls"]))
        wall = replace(
            ABOVE,
            storey_heights=tuple(heights.tolist()),
            thicknesses=tuple(thicknesses.tolist()),
            floor_loads=tuple(floors.tolist()),
            behind=behind,
            tie_heights=(tie,),
        )
        loads = [(-t / 2, z, n / 1e3, True) for t, z, n in zip(thicknesses, levels[1:], floors, strict=True)]
        stops = sorted([*levels[:-1], tie])
        inwards = "everywhere" if behind == "cross_walls" else levels[1:]
        expected = least_of_courses(wall, thicknesses, levels, stops, loads, [tie], inwards)
        found = told(wall)
        assert max(found.values()) == pytest.approx(min(found.values()), rel=1e-6)
        assert expected * 0.98 < found["statics"] < expected * (1 + 1e-7)
        governed.add(wall.mechanisms()[0].name)
    assert "above the tie" in governed


@pytest.mark.parametrize("walls", [4, pytest.param(100, marks=pytest.mark.slow)])
def test_one_list_of_walls_between_supports_whose_load_bears_off_the_middle(walls):
    """Drawn walls between supports, whose hinge may lie between the last two joints at which it is sought."""
    draw = np.random.default_rng(63)
    compared = 0
    while compared < walls:
        height, thickness = draw.uniform([2.4, 0.2], [4.0, 0.5])
        load = float(draw.uniform(0.01, 0.6)) * WEIGHT * height * thickness
        aside = float(draw.uniform(-0.4, 0.4)) * thickness
        try:
            wall = LoadedWall.of_size(
                height,
                thickness,
                WEIGHT,
                top_load=load,
                eccentricity=aside,
                restitution=0.5,
                top_friction=10.0,
            )
        except DoesNotStandError:
            continue
        loads = [(-thickness / 2 - aside, height, load / 1e3, False)]
        expected = least_of_courses(wall, [thickness], [0.0, height], [0.0], loads, [height], None)
        found = told(wall)
        assert max(found.values()) == pytest.approx(min(found.values()), rel=1e-4)
        assert expected * 0.98 < found["statics"] < expected * (1 + 1e-5)
        compared += 1


@pytest.mark.parametrize("load", [0.0, 200.0])
def test_hinge_goes_as_near_to_the_top_of_a_front_as_of_a_wall(load):
    """λ = 2t/h₁ without a load (section 12.2, n = 0): the hinge goes to .95 of the span, in both types."""
    front = replace(
        ABOVE, thicknesses=(0.35,), tie_heights=(3.6,), floor_loads=(load,) if load else (), loads_held=True
    )
    wall = LoadedWall.of_size(
        3.6, 0.35, WEIGHT, top_load=load, restitution=0.6, one_sided=True, top_friction=10.0
    )
    first = front.candidates()[0]
    assert first.position == pytest.approx(wall.crack_position, abs=0.01)
    assert told(front) == pytest.approx(told(wall), rel=1e-4)
    if not load:
        assert first.position == pytest.approx(0.95 * 3.6, rel=1e-5)
        assert first.uplift_multiplier == pytest.approx(0.7 / (0.95 * 3.6), rel=1e-5)


def test_a_wall_whose_top_slips_below_a_tie_needs_its_restitution():
    """It bulges below the tie and, to the other side, turns about its foot: no body keeps its momentum."""
    values = {"top_load": 20e3, "top_friction": 0.3, "tie_heights": (2.14,), "tie_stiffness": 2e7}
    with pytest.raises(StructureError) as refused:
        LoadedWall.of_size(3.2, 0.5, WEIGHT, **values)
    assert (refused.value.field, refused.value.value) == ("restitution", None)
    typed = LoadedWall.of_size(3.2, 0.5, WEIGHT, restitution=0.5, **values)
    assert "hinge at 1.204 m (bulges between foot and tie)" in {
        candidate.description for candidate in typed.candidates()
    }
    assert typed.restitution_of_geometry is None
