"""Ties with a distance between them: the triangle that falls between two of a row, in statics, motion and check."""

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from bonded import BondedWall
from matplotlib.figure import Figure

import rocking
from rocking.assessment.assessor import Assessor
from rocking.assessment.contacts import stackable
from rocking.assessment.cracks import cracks, mechanisms_of
from rocking.assessment.evidence.walls import held_all_along
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.codes.static_check import kinematic_check
from rocking.errors import RockingError, SizeError, StructureError
from rocking.reports.drawings import bay_of
from rocking.structures import Facade, Joints, LoadedWall
from rocking.structures.held_wall import Opening
from rocking.structures.kinds import StructureKind
from tests.refusals import refused

G = 9.80665
TRIANGLE = "falls between two ties of a row"
FRONT = Facade(
    (3.2,),
    (0.4,),
    18e3,
    floor_loads=(5e3,),
    restitution=0.6,
    behind="cross_walls",
    tie_heights=(3.2,),
    tie_stiffness=2e7,
    tie_spacing=6.0,
    unit_length=0.5,
)
SPECTRUM = rocking.DesignSpectrum.ntc(0.15 * G, 2.5, 0.35, "B")


def triangle(wall):
    return next(mechanism for mechanism in wall.mechanisms() if mechanism.name == TRIANGLE)


@pytest.mark.parametrize(("behind", "stopped"), [("nothing", False), ("floors", True), ("cross_walls", True)])
def test_what_stands_behind_its_top_lets_a_triangle_fall_outwards_only(behind, stopped):
    assert triangle(replace(FRONT, behind=behind)).structure.one_sided == stopped


@pytest.mark.parametrize("foot, hold", [(0.0, 6.0), (1.0, 5.0), (0.0, 2.5)])
def test_strips_of_a_triangle_integrate_what_bends_where_the_wall_changes(foot, hold):
    """Cubics that bend at 3 m, where the wall is thinner from and a floor bears, over the height of the triangle."""
    held = {"behind": "cross_walls", "restitution": 0.5, "tie_heights": (6.0,), "tie_stiffness": 5e6}
    wall = Facade((3.0, 3.0), (0.5, 0.4), 18e3, floor_loads=(8e3, 5e3), **held).held_wall
    heights, shares = np.array(wall._strips(Opening(foot=foot, hold=hold, between=True))).T
    assert shares.sum() == pytest.approx(1.0)
    bent = max(hold - 3.0, 0.0) ** 4 / 4 / (hold - foot)
    assert shares @ np.maximum(heights - 3.0, 0.0) ** 3 == pytest.approx(bent)


@pytest.mark.parametrize(("held", "expected"), [(True, 0.268880), (False, 0.162855)])
def test_triangle_is_that_of_hand(held, expected):
    """Section 13.2: λ, u_cr and p² of a wall of 3.2 × .4 m with 5 kN/m; W and N of half a span, per metre of span."""
    t, height = 0.4, 3.2
    w, n = 18e3 * t * height / 2, 5e3
    by_hand = 1.5 * t / height * ((1 + n / w) if held else (w + n) / (w + 1.5 * n))
    assert by_hand == pytest.approx(expected, abs=5e-7)
    found = triangle(replace(FRONT, loads_held=held))
    side = found.side
    assert found.uplift_multiplier == pytest.approx(by_hand, rel=1e-12)
    assert side.uplift_multiplier == pytest.approx(by_hand, rel=1e-12)
    farthest = t / 2 * (w + n) / (w / 3 + n / 2)
    assert height * np.tan(side.critical_rotation) == pytest.approx(farthest, rel=1e-9)
    # p² = (d G/dφ at rest)/I of small turns; the thickness adds its own inertia, t²/3, to the formula's
    stiffness = (w / 3 + n / 2) * height
    inertia = (w * height**2 / 6 + w * t**2 / 3 + (0.0 if held else n * (height**2 / 3 + t**2 / 4))) / G
    slope = -side.at("gravity_slope", 0.0) * G / side.at("inertia", 0.0)
    assert slope == pytest.approx(stiffness / inertia, rel=1e-9)
    (checked,) = (
        mechanism
        for mechanism in kinematic_check(replace(FRONT, loads_held=held), SPECTRUM).mechanisms
        if mechanism.description == TRIANGLE
    )
    assert checked.onset_multiplier == pytest.approx(by_hand, rel=1e-12)
    if not held:  # one weight each of the triangle and its load, whose middles move by u/3 and u/2
        one_weight = (w / 3 + n / 2) ** 2 / ((w + n) * (w / 9 + n / 4))
        assert checked.participating_mass_ratio == pytest.approx(one_weight, rel=1e-12)


def test_triangle_of_a_wall_that_narrows_starts_where_limit_analysis_says():
    """A gable between ties every 6 m at half of its height: λ of its masses in motion is that of virtual work."""
    gable = replace(FRONT, narrows=True, floor_loads=(), tie_heights=(1.6,))
    found = triangle(gable)
    assert found.side.uplift_multiplier == pytest.approx(found.uplift_multiplier, rel=1e-12)
    assert found.uplift_multiplier > 1.05 * triangle(replace(gable, narrows=False)).uplift_multiplier


def turned(levels, thicknesses, loads, weight, foot, top, half):
    """λ of the prism above the line from (0, foot) to (half, top) on the outer face, by turning a cloud of points.

    In three dimensions, with Rodrigues' formula, by a turn so small that its square is rounding.
    """
    along = np.linspace(0, half, 801)[:-1] + half / 1600
    axis = np.array([half, 0.0, top - foot])
    axis /= np.linalg.norm(axis)
    if axis[0] < 0:
        axis = -axis
    lifted = pushed = 0.0

    def count(x, depth, z, weights):
        nonlocal lifted, pushed
        arms = np.column_stack([x, np.full_like(x, -depth), z - foot])
        moved = -np.cross(np.broadcast_to(axis, arms.shape), arms)
        lifted += weights @ moved[:, 2]
        pushed += weights @ moved[:, 1]

    line = foot + (top - foot) * along / half
    for (low, high), thickness in zip(pairwise(levels), thicknesses, strict=True):
        start = np.maximum(line, low)
        inside = start < high
        strip = weight * thickness * (high - start[inside]) / along.size
        count(along[inside], thickness / 2, (start[inside] + high) / 2, strip)
    for level, thickness, load in loads:
        inside = line < level
        count(
            along[inside],
            thickness / 2,
            np.full(inside.sum(), level),
            np.full(inside.sum(), load / along.size),
        )
    return lifted / pushed


@pytest.mark.parametrize("fronts", [15, pytest.param(100, marks=pytest.mark.slow)])
def test_triangle_of_drawn_fronts_is_that_of_three_dimensions(fronts):
    """Storeys of unlike thickness and floors; the weakest foot of those at which a storey stands."""
    draw = np.random.default_rng(66)
    for _ in range(fronts):
        storeys = int(draw.integers(1, 4))
        heights = draw.uniform(2.4, 4.2, storeys)
        thicknesses = np.sort(draw.uniform(0.25, 0.7, storeys))[::-1]
        floors = draw.uniform(0, 20e3, storeys)
        levels = np.array([0.0, *np.cumsum(heights)])
        tie = levels[-1] - float(draw.choice([0.0, 0.4]))
        spacing = float(draw.uniform(2, 8))
        wall = replace(
            FRONT,
            storey_heights=tuple(heights.tolist()),
            thicknesses=tuple(thicknesses.tolist()),
            floor_loads=tuple(floors.tolist()),
            tie_heights=(tie,),
            tie_spacing=spacing,
            behind=str(draw.choice(["floors", "cross_walls"])),
        )
        loads = list(zip(levels[1:], thicknesses, floors, strict=True))
        feet = [level for level in levels[:-1] if level < tie]
        expected = min(turned(levels, thicknesses, loads, 18e3, foot, tie, spacing / 2) for foot in feet)
        assert triangle(wall).uplift_multiplier == pytest.approx(expected, rel=1e-3)
        assert wall.static_multiplier <= triangle(wall).uplift_multiplier


@pytest.mark.process
@pytest.mark.parametrize(("thickness", "load"), [(0.4, 5.0), pytest.param(0.3, 12.0, marks=pytest.mark.slow)])
def test_triangle_is_on_the_safe_side_of_a_bonded_wall(thickness, load):
    """Units of 1 × .4 m, ties every 3 m that stand half a spacing from the free ends, λ between triangle and bulge."""
    wall = BondedWall(6.0, 3.2, thickness, (1.0, 0.4), 18.0, load, (1.5, 4.5))
    apart = replace(FRONT, thicknesses=(thickness,), floor_loads=(load * 1e3,), loads_held=True)
    bulge = replace(apart, held_between="floor").static_multiplier
    # the courses of .4 m place the hinge of the bulge to a few percent
    assert triangle(apart).uplift_multiplier < wall.multiplier() < bulge * 1.03
    wall.held = True
    assert wall.multiplier() == pytest.approx(bulge, rel=0.03)


def test_triangle_joins_where_ties_stand_farther_apart_than_three_units():
    near, far = replace(FRONT, tie_spacing=1.5), replace(FRONT, tie_spacing=1.51)
    floor = replace(FRONT, held_between="floor", unit_length=None)
    assert TRIANGLE not in {one_mechanism.name for one_mechanism in (*near.mechanisms(), *floor.mechanisms())}
    assert near.static_multiplier == floor.static_multiplier == pytest.approx(0.513077, abs=5e-7)
    assert far.static_multiplier == triangle(far).uplift_multiplier
    followed = {crack.description: crack for crack in cracks(far)}
    assert followed[f"crack at 0 m ({TRIANGLE})"].bulges
    assert TRIANGLE in {mechanism.name for mechanism in mechanisms_of(far)}
    unsaid = replace(FRONT, tie_spacing=None, unit_length=None)
    kinds = [[warning.kind for warning in wall.cautions] for wall in (unsaid, near, floor)]
    assert [StructureKind.TIES_ALL_ALONG in kind for kind in kinds] == [True, False, False]


def test_the_front_between_two_ties_shows_the_triangle_and_what_stands_above_it():
    """From the foot at mid-span to each tie at 2.9 m, and all above; none where a floor holds the wall all along."""
    wall = replace(FRONT, tie_heights=(2.9,))
    bay = bay_of(wall)
    (falls,) = bay.falls
    left, right = bay.ties[:, 0]
    assert right - left == pytest.approx(6.0)
    corners = [((left + right) / 2, 0.0), (right, 2.9), (right, 3.2), (left, 3.2), (left, 2.9)]
    assert falls == pytest.approx(np.array(corners))
    assert bay.ties[:, 1].tolist() == [2.9, 2.9]
    assert bay.outline[:, 0].min() > max(path[:, 0].max() for path in wall.outline())
    assert bay_of(triangle(wall).structure).falls[0] == pytest.approx(falls)
    held = replace(wall, held_between="floor")
    assert bay_of(held) is bay_of(wall.opened(Opening(foot=0.0, hinge=1.5, hold=2.9))) is None
    for shown, crosses in (({"dimensions": True}, [bay.ties.tolist()]), ({}, [])):
        axes = wall.plot(axes=Figure().subplots(), **shown)
        assert [line.get_xydata().tolist() for line in axes.lines if line.get_marker() == "x"] == crosses
    assert not [
        line
        for line in held.plot(axes=Figure().subplots(), dimensions=True).lines
        if line.get_marker() == "x"
    ]


def test_wall_between_supports_falls_between_its_ties_as_without_them():
    values = {"top_load": 5e3, "one_sided": True, "restitution": 0.5}
    bare = LoadedWall.of_size(3.2, 0.25, 18e3, **values)
    ties = {"tie_heights": (1.6,), "tie_stiffness": 2e7, "tie_spacing": 4.0, "unit_length": 0.5}
    tied = LoadedWall.of_size(3.2, 0.25, 18e3, **values, **ties)
    first = tied.candidates()[0]
    assert first.uplift_multiplier == pytest.approx(bare.static_multiplier, rel=1e-6)
    assert first.critical_rotation == pytest.approx(bare.mechanism().critical_rotation, rel=1e-4)
    assert replace(tied, held_between="floor").static_multiplier > 2 * bare.static_multiplier


@pytest.mark.parametrize("friction", [0.0, 0.05, 0.3])
@pytest.mark.parametrize("heights", [(1.6,), (3.2,), (1.6, 3.2)])
def test_wall_whose_top_slips_falls_between_its_ties_as_without_them(friction, heights):
    """Friction alone holds the top midway between two ties, also of a row at the top itself."""
    values = {"top_load": 5e3, "top_friction": friction, "one_sided": True, "restitution": 0.5}
    bare = LoadedWall.of_size(3.2, 0.25, 18e3, **values)
    ties = {"tie_heights": heights, "tie_stiffness": 2e7, "tie_spacing": 4.0, "unit_length": 0.5}
    tied = LoadedWall.of_size(3.2, 0.25, 18e3, **values, **ties)
    weight, load = 18e3 * 0.25 * 3.2, 5e3
    by_hand = (weight * 0.125 + load * 0.125 + friction * load * 3.2) / (weight * 1.6)
    assert bare.static_multiplier == pytest.approx(by_hand, rel=1e-6)
    assert tied.static_multiplier == pytest.approx(by_hand, rel=1e-6)
    first = tied.candidates()[0]
    assert first.critical_rotation == pytest.approx(bare.candidates()[0].critical_rotation, rel=1e-6)
    assert replace(tied, held_between="floor").static_multiplier >= tied.static_multiplier


@pytest.mark.parametrize("fronts", [4, pytest.param(200, marks=pytest.mark.slow)])
def test_closer_and_stronger_ties_are_never_worse(fronts):
    """The least λ of drawn fronts: a closer spacing, a stronger tie, more thickness."""
    draw = np.random.default_rng(67)
    compared = 0
    while compared < fronts:
        height, thickness, load = draw.uniform([2.6, 0.3, 0], [4.0, 0.6, 15e3])
        strength = float(draw.uniform(2e3, 3e4))
        try:
            wall = replace(
                FRONT,
                storey_heights=(float(height),),
                thicknesses=(float(thickness),),
                floor_loads=(float(load),),
                tie_heights=(float(height) - float(draw.choice([0.0, 0.3])),),
                tie_strength=strength,
                tie_spacing=float(draw.uniform(0.5, 6)),
            )
        except RockingError:
            continue
        compared += 1
        for better in (
            replace(wall, tie_spacing=wall.tie_spacing * float(draw.uniform(0.2, 1))),
            replace(wall, tie_strength=strength * float(draw.uniform(1, 3))),
            replace(wall, held_between="floor"),
        ):
            assert better.static_multiplier >= wall.static_multiplier * (1 - 1e-9)
        # A tie that yields holds less of a heavier wall: thickness alone is on the safe side where it does not.
        lasts = replace(wall, tie_strength=None)
        thicker = replace(lasts, thicknesses=(float(thickness) * float(draw.uniform(1, 1.3)),))
        assert thicker.static_multiplier >= lasts.static_multiplier * (1 - 1e-9)


def test_front_that_stands_held_all_along_falls_between_its_ties():
    times = np.arange(0, 6, 0.005)
    motion = rocking.Accelerogram(0.48 * G * np.sin(2 * np.pi * times) * (times < 2), 0.005)
    settings = AssessmentSettings(ensemble=EnsembleSettings(reserve=0))
    held = replace(FRONT, held_between="floor", anchor_height=1.0)
    all_along, apart = (rocking.assess(motion, front, settings=settings) for front in (held, FRONT))
    assert all_along.verdict is rocking.Verdict.STANDS
    assert apart.verdict.badness >= rocking.Verdict.PROBABLY_OVERTURNS.badness
    assert TRIANGLE in apart.crack


ALL_ALONG = replace(FRONT, tie_spacing=None, unit_length=None, held_between="floor")


def test_anchors_slide_out_at_the_load_of_hand():
    """A front of 3.2 × .4 m about its foot against μ (N + .2 w) at its top; the bulge needs 6.7 kN/m of it."""
    weight, load = 18e3 * 0.4 * 3.2, 5e3
    grip = 0.6 * (load + 0.2 * 18e3 * 0.4)
    by_hand = ((weight + load) * 0.2 + grip * 3.2) / (weight * 1.6 + load * 3.2)
    (tie,) = ALL_ALONG.restraints
    assert tie.needed > tie.grip == pytest.approx(grip)
    assert ALL_ALONG.anchors_slide_at == pytest.approx(by_hand, rel=1e-6)
    assert by_hand < 0.7 * ALL_ALONG.static_multiplier
    larger = replace(ALL_ALONG, anchor_height=1.0)
    assert larger.restraints[0].grip == pytest.approx(0.6 * (load + 18e3 * 0.4))
    assert larger.anchors_slide_at == ALL_ALONG.without_ties().anchors_slide_at == np.inf
    weak = replace(ALL_ALONG, tie_strength=grip / 2, tie_plastic_elongation=0.05)
    assert weak.anchors_slide_at == np.inf  # it yields before


@pytest.mark.parametrize("spacing", [1.0, 2.0, 8.0])
def test_each_anchor_gives_the_friction_of_what_it_grips_and_needs_the_force_of_its_spacing(spacing):
    """By hand: μ (what lies above + what it grips) × width against R × spacing; a wider anchor gives more."""
    along = replace(
        ALL_ALONG.on_joints(Joints(friction=0.4)), tie_spacing=spacing, unit_length=0.5, held_between=None
    )
    (per_metre,) = ALL_ALONG.on_joints(Joints(friction=0.4)).restraints
    for width in (None, 0.25, 0.5, 20.0):
        (tie,) = replace(along, anchor_width=width).restraints
        assert tie.grip * spacing == pytest.approx(per_metre.grip * min(width or 0.5, spacing))
        assert tie.warnings[1]["needed_kN"] == pytest.approx(per_metre.needed * spacing / 1e3)
        assert tie.warnings[1]["grip_kN"] == pytest.approx(tie.grip * spacing / 1e3)
    (held,) = replace(along, held_between="floor").restraints
    assert held.grip == per_metre.grip
    assert replace(along, anchor_width=0.25).anchors_slide_at <= along.anchors_slide_at
    with refused(SizeError, "tie_spacing"):
        replace(ALL_ALONG, anchor_width=0.3)


def test_an_anchor_grips_no_more_than_the_wall():
    with refused(StructureError, "anchor_height", repr(ALL_ALONG.height + 0.1)):
        replace(ALL_ALONG, anchor_height=ALL_ALONG.height + 0.1)


def shaken(wall, peak, period, fidelity="standard"):
    times = np.arange(0, 4, 0.005)
    sine = peak * G * np.sin(2 * np.pi * times / period) * (times < max(0.5, period))
    reserve = 3 if fidelity == "quick" else 0
    assessor = Assessor(AssessmentSettings(fidelity=fidelity, ensemble=EnsembleSettings(reserve=reserve)))
    (shaken_once,) = assessor.assess(
        "", [rocking.Accelerogram(sine, 0.005)], on_the_ground({"": wall})
    ).periods
    return shaken_once


def test_what_stands_but_for_its_anchors_stands_where_no_stack_whose_ties_they_hold_falls():
    """By 64 of them; by fewer it only probably stands, but for larger anchors and below the sliding load."""
    for peak in (0.4, 0.55):  # at the first nothing lifts by its mechanisms
        doubted = shaken(ALL_ALONG, peak, 0.25, "quick")
        assert doubted.verdict is rocking.Verdict.PROBABLY_STANDS
        assert AssessmentKind.ANCHOR_GIVES in {warning.kind for warning in doubted.decision.warnings}
        assert AssessmentKind.ANCHORS in {warning.kind for warning in doubted.decision.would_settle}
        some = shaken(ALL_ALONG, peak, 0.25)
        assert some.verdict is rocking.Verdict.PROBABLY_STANDS
        assert some.stacks.runs <= 24
        followed = shaken(ALL_ALONG, peak, 0.25, "contact")
        assert followed.verdict is rocking.Verdict.STANDS
        assert (followed.stacks.falls, followed.stacks.runs) == (0, 64)
        assert shaken(replace(ALL_ALONG, anchor_height=1.0), peak, 0.25, "quick").verdict.stays_up
    below = shaken(ALL_ALONG, 0.2, 0.25, "quick")
    assert below.verdict.stays_up
    # At a larger factor its anchors slide out, of which the reserve knows nothing; larger ones never do.
    assert AssessmentKind.ANCHOR_GIVES in {warning.kind for warning in below.reserve_warnings}
    firm = shaken(replace(ALL_ALONG, anchor_height=1.0), 0.2, 0.25, "quick")
    assert AssessmentKind.ANCHOR_GIVES not in {warning.kind for warning in firm.reserve_warnings}


def test_light_anchors_at_a_spacing_fall_where_the_ties_alone_stand():
    """Also where it may fall between its ties, which a plane stack says nothing of and its mechanisms do."""
    light = replace(ALL_ALONG, tie_spacing=2.0, anchor_width=0.1)
    held = replace(light, anchor_width=2.0, anchor_height=3.2)
    apart = replace(light, held_between=None, unit_length=0.4)
    assert held_all_along(apart).static_multiplier == light.static_multiplier
    assert shaken(held, 0.4, 0.8).verdict is rocking.Verdict.STANDS
    for wall in (light, apart):
        assert shaken(wall, 0.4, 0.8).verdict.badness >= rocking.Verdict.UNCERTAIN.badness


def test_a_tie_in_a_stack_pulls_no_more_than_its_anchor_gives():
    """By hand: .6 (5 kN + .2 m of 7.2 kN/m), until it has slid out by half of .4 m; a weaker tie as described."""
    (tie,) = (held.tie for held in ALL_ALONG.stack().held if held.tie)
    assert (tie.strength, tie.plastic_elongation) == pytest.approx((0.6 * (5e3 + 0.2 * 7.2e3), 0.2))
    weak = replace(ALL_ALONG, tie_strength=2e3, tie_plastic_elongation=0.05)
    (tie,) = (held.tie for held in weak.stack().held if held.tie)
    assert (tie.strength, tie.plastic_elongation) == (2e3, 0.05)


@pytest.mark.parametrize(
    "wall", [FRONT, LoadedWall.of_size(3.2, 0.3, 18e3, tie_heights=(1.6,), tie_stiffness=1e7)]
)
def test_a_plane_stack_says_nothing_of_a_wall_between_its_ties(wall):
    """It would hold it all along: neither are its runs asked for, nor do they lift what limits the word."""
    apart = replace(wall, tie_spacing=3.0, unit_length=0.5)
    assert not stackable(apart) and stackable(replace(apart, held_between="floor"))
    with refused(StructureError, "tie_spacing", 3.0):
        apart.stack()


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ({"unit_length": None}, ("unit_length", "missing")),
        ({"tie_spacing": None}, ("tie_spacing", "missing")),
        ({"tie_spacing": 0.0}, ("tie_spacing", "0.0")),
        ({"held_between": "beam"}, ("held_between", "'beam'")),
        (
            {"tie_heights": (), "tie_stiffness": 0.0, "unit_length": None},
            ("tie_spacing", "6.0"),
        ),
    ],
)
def test_what_is_said_of_a_spacing_hangs_together(values, named):
    with refused(StructureError, *named):
        replace(FRONT, **values)


RODS = {"rod_diameter": 0.024, "rod_length": 6.0, "rod_yield_stress": 235e6}


def test_rods_are_spread_over_the_metre():
    """24 mm every 2 m, 6 m long: A = 452.389 mm², E A/(L s) is 7 540 kN/m², f_y A/s is 53.16 kN/m, T/s is 5 kN/m."""
    rods = replace(
        FRONT,
        tie_stiffness=0.0,
        tie_spacing=2.0,
        held_between="floor",
        **RODS,
        rod_pretension=10e3,
    )
    area = np.pi * 0.024**2 / 4
    assert area == pytest.approx(452.389e-6, rel=1e-5)
    assert rods.tie_stiffness == pytest.approx(200e9 * area / 12, rel=1e-12)
    assert rods.tie_strength == pytest.approx(235e6 * area / 2, rel=1e-12)
    assert rods.tie_pretension == 5e3
    spread = replace(
        FRONT,
        tie_spacing=2.0,
        held_between="floor",
        tie_stiffness=rods.tie_stiffness,
        tie_strength=rods.tie_strength,
        tie_pretension=5e3,
    )
    assert rods.static_multiplier == spread.static_multiplier
    (said,) = (warning for warning in rods.assumptions if warning.kind is StructureKind.RODS_SPREAD)
    assert said["stiffness_kN_m2"] == pytest.approx(7540, rel=1e-3)
    assert replace(rods, floor_loads=(6e3,)).tie_stiffness == rods.tie_stiffness


@pytest.mark.parametrize(
    ("values", "named"),
    [
        ({"rod_length": None}, ("rod_length", "missing")),
        ({"rod_diameter": None}, ("rod_diameter", "missing")),
        ({"tie_spacing": None, "unit_length": None}, ("tie_spacing", "missing")),
        ({"tie_stiffness": 2e7}, ("tie_stiffness", "20000000.0")),
        ({"tie_strength": 2e4}, ("tie_strength", "20000.0")),
    ],
)
def test_rods_are_described_once_and_whole(values, named):
    with refused(StructureError, *named):
        replace(FRONT, **({"tie_stiffness": 0.0} | RODS | values))
