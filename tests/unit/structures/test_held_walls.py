"""Walls held at several heights: limit analysis without a mechanism, worked examples, positions and energy."""

import pickle
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from courses import Courses
from held import opened_lagrangian

import rocking
from rocking.errors import ConfigurationError, StructureError
from rocking.quantities import GRAVITY
from rocking.structures import Facade, LoadedWall
from rocking.structures.held_wall import Chain, Opening
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import Hung, MotionState, Parts
from rocking.structures.structure import Candidate
from tests.refusals import refused

PER_STOREY = 5


def joints_of(heights):
    levels = np.concatenate([[0.0], np.cumsum(heights)])
    return np.unique(
        np.concatenate([np.linspace(low, high, PER_STOREY + 1) for low, high in pairwise(levels)])
    )


def drawn_facade(draw):
    """A façade of one to three storeys with one to three holds of any kind; its courses; its joints."""
    storeys = draw.integers(1, 4)
    heights = tuple(float(value) for value in draw.uniform(2.4, 4.2, storeys).round(2))
    thicknesses = tuple(float(other_value) for other_value in draw.uniform(0.25, 0.7, storeys).round(2))
    loads = tuple(float(one_value) for one_value in draw.uniform(2e3, 25e3, storeys).round())
    joints = joints_of(heights)
    levels = np.concatenate([[0.0], np.cumsum(heights)])
    behind = str(draw.choice(["nothing", "floors", "cross_walls"]))
    number = int(draw.integers(1, 4))
    at = draw.choice(joints[1:], number, replace=False) if draw.random() < 0.5 else draw.choice(levels[1:], 1)
    ties = tuple(sorted(float(place) for place in at))
    strength = None if draw.random() < 0.5 else float(draw.uniform(1e3, 4e4))
    eccentricity = float(draw.uniform(-0.4, 0.4) * min(thicknesses))
    facade = Facade(
        heights,
        thicknesses,
        18e3,
        floor_loads=loads,
        eccentricity=eccentricity,
        loads_held=bool(draw.random() < 0.5),
        top_slab="flat" if draw.random() < 0.3 else "hinged",
        thrust=float(draw.choice([0.0, 800.0])),
        crack_storey=1,
        crack="known",  # the family is asked for by its joints
        compressive_strength=crushes(draw),
        behind=behind,
        restitution=0.6,
        tie_heights=ties,
        tie_stiffness=2e7,
        tie_strength=strength,
    )
    courses = masonry(joints, levels, thicknesses, 18.0, facade.compressive_strength)
    rides = not facade.loads_held
    bearings = [
        (-t / 2 - eccentricity, z, load / 1e3, rides)
        for t, z, load in zip(thicknesses, levels[1:], loads, strict=True)
    ]
    if facade.top_slab == "flat":
        bearings.pop()
        courses.slab = loads[-1] / 1e3, rides
    courses.loads = bearings
    courses.ties = [(z, np.inf if strength is None else strength / 1e3) for z in ties]
    courses.floors = {"nothing": [], "floors": list(levels[1:]), "cross_walls": list(joints[1:])}[behind]
    courses.thrusts = [(levels[-1], facade.thrust / 1e3)]
    return facade, courses, joints


def drawn_wall(draw):
    """A wall between supports with ties between."""
    height = float(draw.uniform(3, 8))
    thickness = float(draw.uniform(0.2, 0.5))
    joints = np.linspace(0.0, height, 11)
    load = float(draw.uniform(1e3, 4e4))
    ties = tuple(sorted(float(z) for z in draw.choice(joints[2:-1], draw.integers(0, 3), replace=False)))
    strength = float(draw.uniform(1e3, 2e4)) if ties and draw.random() < 0.6 else None
    backed = bool(draw.random() < 0.5)
    wall = LoadedWall.of_size(
        height,
        thickness,
        19e3,
        top_load=load,
        eccentricity=float(draw.uniform(-0.3, 0.3) * thickness),
        top_slab="flat" if draw.random() < 0.4 else "hinged",
        one_sided=backed,
        restitution=0.6,
        tie_heights=ties,
        tie_stiffness=2e7 if ties else 0.0,
        tie_strength=strength,
        compressive_strength=crushes(draw),
        top_friction=None if draw.random() < 0.3 else float(draw.uniform(0.0, 0.5)),
    )
    courses = masonry(joints, (0.0, height), (thickness,), 19.0, wall.compressive_strength)
    friction = wall.joints.friction if wall.top_friction is None else wall.top_friction
    courses.friction = friction * load / 1e3
    courses.left, courses.right = courses.left + thickness / 2, courses.right + thickness / 2
    if wall.top_slab == "flat":
        courses.slab = load / 1e3, 0.0
        courses.stops = [height]
    else:
        courses.loads = [(-wall.eccentricity, height, load / 1e3, 0.0)]
        courses.stops = [height]
    courses.ties = [(z, np.inf if strength is None else strength / 1e3) for z in ties]
    courses.floors = list(joints[1:]) if backed else []
    return wall, courses, joints


def crushes(draw):
    return None if draw.random() < 0.5 else float(draw.uniform(1e6, 5e6))


def masonry(joints, levels, thicknesses, unit_weight, strength):
    middles = (joints[1:] + joints[:-1]) / 2
    of_course = np.array(thicknesses)[np.searchsorted(levels, middles) - 1]
    weights = unit_weight * of_course * np.diff(joints)
    presses = np.inf if strength is None else strength / 1e3
    return Courses(joints, -of_course, 0 * of_course, weights, strength=presses)


@pytest.mark.process
def test_least_multiplier_is_that_of_limit_analysis_over_courses():
    draw = np.random.default_rng(52)
    least_by_name = {}
    compared = walls = 0
    while walls < 90:
        try:
            wall, courses, joints = drawn_facade(draw) if draw.random() < 0.7 else drawn_wall(draw)
        except rocking.RockingError:
            continue  # as one body already
        walls += 1
        family = wall.held_wall.family(joints[:-1])
        if family[0][1] <= 0:
            assert -np.inf in (courses.multiplier(1), courses.multiplier(-1))
            continue  # it does not stand at rest
        for direction in (1, -1):
            own = [one_member for one_member in family if one_member[0].outwards == (direction > 0)]
            expected = courses.multiplier(direction)
            found = min((member[1] for member in own), default=np.inf)
            assert found == pytest.approx(expected, rel=1e-9), (walls, direction)
            if own:
                name = wall.held_wall.name(min(own, key=lambda item: item[1])[0])
                least_by_name[name] = least_by_name.get(name, 0) + 1
                compared += 1
    assert compared > 100
    kinds = " ".join(least_by_name)
    for kind in (
        "overturns about its foot",
        "its top slipping",
        "sways under the slab",
        "above the tie",
        "bulges between",
        "bulges inwards",
        "between two ties",
    ):
        assert kind in kinds, least_by_name


TWO_STOREYS = Facade(
    (3.5, 3.0),
    (0.5, 0.4),
    18e3,
    floor_loads=(12e3, 8e3),
    behind="cross_walls",
    restitution=0.7,
    tie_heights=(3.5,),
    tie_stiffness=2e7,
)
ONE_STOREY = Facade(
    (3.6,),
    (0.35,),
    18e3,
    floor_loads=(10e3,),
    eccentricity=0.05,
    behind="cross_walls",
    restitution=0.7,
    tie_heights=(3.6,),
    tie_stiffness=2e7,
)


def named(wall):
    """The mechanism of least λ by each name."""
    return {mechanism.name: mechanism for mechanism in reversed(wall.mechanisms())}


@pytest.mark.parametrize(
    ("strength", "about_foot", "governs"),
    [
        (20e3, 0.337560, "above the tie"),
        (2e3, 0.092543, "overturns about its foot"),
        (None, None, "above the tie"),
    ],
)
def test_tie_of_two_storeys_is_that_of_hand(strength, about_foot, governs):
    """Section 12.7, example 1: Σ P δ_y = 16.795, Σ P δ_x = 257.125; above the tie 5.92/56.4."""
    family = named(replace(TWO_STOREYS, tie_strength=strength))
    assert family["above the tie"].uplift_multiplier == pytest.approx(5.92 / 56.4, rel=1e-9)
    if strength:
        by_hand = (16.795 + strength / 1e3 * 3.5) / 257.125
        assert by_hand == pytest.approx(about_foot, abs=5e-7)
        assert family["overturns about its foot"].uplift_multiplier == pytest.approx(by_hand, rel=1e-9)
    else:
        assert "overturns about its foot" not in family
    assert replace(TWO_STOREYS, tie_strength=strength).mechanisms()[0].name == governs


def test_bulge_of_one_storey_is_that_of_hand():
    """Section 12.7, example 2: the hinge at 2.40 m 13.938/27.216, free at 2.705582 m .496042."""
    wall = replace(ONE_STOREY, tie_strength=30e3)
    at_hinge = wall.held_wall.multiplier(Opening(foot=0.0, hinge=2.4, hold=3.6))
    assert at_hinge == pytest.approx(13.938 / 27.216, rel=1e-9)
    bulge = named(wall)["bulges between foot and tie"]
    assert bulge.uplift_multiplier == pytest.approx(0.496042, abs=5e-7)
    assert bulge.position == pytest.approx(2.705582, abs=1e-5)
    assert bulge.uplift_multiplier == pytest.approx(bulge.mechanism.uplift_multiplier, rel=1e-12)
    for strength, expected in ((6e3, 0.362113), (9.201252e3, 0.512125), (30e3, 1.486762)):
        past = replace(wall, tie_strength=strength).held_wall.multiplier(Opening(foot=0.0))
        assert past == pytest.approx(expected, abs=5e-7)


def test_hinge_of_a_uniform_wall_is_where_its_formula_says():
    """h₁/H = 1 + n − √(n(1 + n)), λ = (2t/h₁)(1 + N H/(W h₂)) under a slab of N = n W that stays flat."""
    height, thickness, weight = 3.6, 0.35, 18e3 * 0.35 * 3.6
    for n in (0.1, 0.5, 2.0):
        wall = LoadedWall.of_size(
            height, thickness, 18e3, top_load=n * weight, top_slab="flat", restitution=0.5
        )
        lower = height * (1 + n - np.sqrt(n * (1 + n)))
        least = 2 * thickness / lower * (1 + n * height / (height - lower))
        bulge = named(wall)["bulges between foot and top"]
        assert bulge.position == pytest.approx(lower, rel=1e-4)
        assert bulge.uplift_multiplier == pytest.approx(least, rel=1e-8)


THREE = Facade(
    (3.4, 3.0, 2.6),
    (0.5, 0.4, 0.3),
    18e3,
    floor_loads=(12e3, 9e3, 5e3),
    eccentricity=0.04,
    tie_heights=(2.0, 6.4),
    tie_stiffness=3e5,
)
OPENINGS = {
    "bulge past a tie, the top turning back": (THREE, Opening(foot=0.0, hinge=3.9, hold=6.4)),
    "bulge past a tie, the top upright": (THREE, Opening(foot=0.0, hinge=3.9, hold=6.4, upright=True)),
    "kick back": (THREE, Opening(foot=4.0, hinge=5.2, hold=6.4, forwards=False)),
    "loads held": (replace(THREE, loads_held=True), Opening(foot=0.5, hinge=3.9, hold=6.4)),
    "flat slab": (replace(THREE, top_slab="flat"), Opening(foot=0.5, hinge=3.9, hold=6.4)),
    "flat slab on what stays upright": (
        replace(THREE, top_slab="flat"),
        Opening(foot=0.5, hinge=3.9, hold=6.4, upright=True),
    ),
}


@pytest.mark.parametrize("case", OPENINGS)
def test_acceleration_of_a_chain_is_that_of_positions_and_energy(case):
    """I, J, G and B together, from φ'' in a state in which each counts; derivatives of 30 digits."""
    wall, opening = OPENINGS[case]
    opened = wall.opened(opening)
    side = opened.linkages[0].side(0.5)
    phi, velocity, ground = 0.6 * min(side.critical_rotation, 0.15), -0.8, -2.5
    expected = opened_lagrangian(wall, opening).acceleration(phi, velocity, ground, GRAVITY)
    pull = side.at("inertia_slope", phi) / 2 * velocity**2 + side.at("gravity", phi) * GRAVITY
    found = -(pull + side.at("ground", phi) * ground) / side.at("inertia", phi)
    assert found == pytest.approx(expected, rel=1e-8)


@pytest.mark.parametrize("slab", ["hinged", "flat"])
def test_chain_under_a_held_top_is_a_loaded_wall(slab):
    """Two ways to the same wall, to rounding."""
    draw = np.random.default_rng(3)
    for _ in range(20):
        lower, upper, t, load = draw.uniform([1.5, 1.5, 0.15, 0], [3, 3, 0.3, 1e4])
        wall = LoadedWall(lower, upper, t, 19e3, top_load=load, top_slab=slab, crack="known")
        chain = wall.opened(Opening(foot=0.0, hinge=lower, hold=wall.height)).mechanism()
        expected = wall.mechanism()
        at = np.linspace(0, 1, 7) * expected.critical_rotation
        for name in ("inertia", "inertia_slope", "gravity", "gravity_slope", "ground"):
            values, bare = getattr(chain.positive, name)(at), getattr(expected.positive, name)(at)
            # of another unit: the load belongs to it
            unit = bare[0] / values[0] if values[0] else 1 + load / (19e3 * wall.height * t)
            np.testing.assert_allclose(unit * values, bare, rtol=0, atol=3e-13 * np.abs(bare).max())
        for name in (
            "uplift_multiplier",
            "critical_rotation",
            "frequency_parameter",
            "restitution",
            "end_rotation",
        ):
            assert getattr(chain.positive, name) == pytest.approx(getattr(expected.positive, name), rel=1e-11)


def test_contacts_of_a_chain_are_those_of_a_loaded_wall():
    wall = LoadedWall(1.9, 1.3, 0.3, 19e3, top_load=9e3, eccentricity=0.05, crack="known")
    chain = wall.opened(Opening(foot=0.0, hinge=1.9, hold=wall.height))
    states = [0.01, 0.05, -0.03], [0.2, -0.3, 0.1], None, [1.0, -2.0, 0.5]
    found, expected = (
        body.contact_forces(MotionState.of(body.mechanism(), *states)) for body in (chain, wall)
    )
    np.testing.assert_allclose(found.normal, expected.normal, rtol=1e-11)
    np.testing.assert_allclose(found.tangential, expected.tangential, rtol=1e-10)


def test_restitution_between_equal_blocks_is_that_of_the_formula():
    """(1 − 4.5 sin²α)/(1 + 3 sin²α), section 4."""
    chain = Chain(
        (0j, -0.2 + 1.6j), 3.2j, Parts([1, 1], [-0.1 + 0.8j, -0.1 + 2.4j], [(1.6**2 + 0.2**2) / 12] * 2)
    )
    facade = Facade(
        (3.2,), (0.2,), 18e3, behind="floors", restitution=0.5, tie_heights=(3.2,), tie_stiffness=1e7
    )
    opened = facade.opened(Opening(foot=0.0, hinge=1.6, hold=3.2)).mechanism()
    s = np.sin(np.arctan2(0.2, 1.6)) ** 2
    assert opened.restitution == pytest.approx((1 - 4.5 * s) / (1 + 3 * s), rel=1e-12)
    assert opened.positive.at("inertia", 0.0) == pytest.approx(float(chain.inertia(0.0)), rel=1e-12)


PLAIN = Facade((3.2, 2.8), (0.4, 0.4), 18e3, behind="floors", restitution=0.6)


@pytest.mark.filterwarnings("ignore:restitution by momentum balance")
def test_what_stops_one_side_alone_leaves_the_whole_wall_to_the_other():
    """A tie pulls and a floor pushes: the other way the wall rocks about its edge as a block does, φ_cr = atan(t/h)."""
    tied = Facade((3.2,), (0.4,), 18e3, tie_heights=(2.4,), tie_stiffness=2e7, restitution=0.8)
    inwards = tied.opened(Opening(foot=0.0, hinge=1.2, hold=2.4)).mechanism().negative
    assert inwards.critical_rotation == pytest.approx(np.arctan(0.4 / 3.2), rel=1e-12)
    outwards = (
        PLAIN.opened(Opening(foot=0.0, hinge=1.2, hold=3.2, upright=True, outwards=False))
        .mechanism()
        .positive
    )
    assert outwards.critical_rotation == pytest.approx(np.arctan(0.4 / 6.0), rel=1e-12)


def test_critical_rotation_of_a_candidate():
    """A block's, from its crack upwards; not a number where nothing can be followed."""
    bodies = named(replace(PLAIN, crack=None))
    for name, height in (("overturns about its foot", 6.0), ("upper storey alone", 2.8)):
        assert bodies[name].critical_rotation == pytest.approx(np.arctan(0.4 / height), rel=1e-12)
    pushed = Candidate("", 0.0, PLAIN.opened(Opening(foot=0.0, hinge=1.2, hold=3.2, outwards=False)))
    assert "must be positive" in pushed.refusal and np.isnan(pushed.critical_rotation)
    assert not pushed.is_own_of(PLAIN)


def test_floors_and_cross_walls_stop_the_wall_inwards():
    free = replace(THREE, behind="nothing")
    floors = replace(THREE, behind="floors", restitution=0.6)
    walls = replace(THREE, behind="cross_walls", restitution=0.6)
    assert [any(mechanism.sign < 0 for mechanism in wall.mechanisms()) for wall in (free, floors, walls)] == [
        True,
        True,
        False,
    ]
    assert "overturns inwards about its foot" in named(free)
    assert not any("overturns inwards" in name for name in named(floors))
    assert walls.mechanism().one_sided and floors.mechanism().one_sided and not free.mechanism().one_sided
    above = Facade((3.4, 3.0), (0.5, 0.4), 18e3, floor_loads=(9e3, 0.0), behind="floors", restitution=0.6)
    assert not above.cracked_at(3.4).mechanism().one_sided
    # there it hits no floor: η is that of its geometry
    assert above.cracked_at(3.4).mechanism().restitution > 0.9


@pytest.mark.parametrize(
    ("values", "field", "value"),
    [
        ({"behind": "floors"}, "restitution", "missing"),
        ({"behind": "cross_walls", "restitution": "momentum"}, "restitution", "'momentum'"),
        ({"behind": "floor", "restitution": 0.6}, "behind", "'floor'"),
    ],
)
def test_what_stands_behind_needs_the_restitution_of_the_impact_on_it(values, field, value):
    with refused(StructureError, field, value):
        replace(THREE, **values)


def test_a_facade_has_one_key_for_what_stands_behind():
    with pytest.raises(TypeError):
        replace(THREE, one_sided=True)
    entry = THREE.described.entry
    assert "one_sided" not in entry
    with pytest.raises(ConfigurationError):
        rocking.structure_from_config(entry | {"one_sided": True})


FRONT = rocking.Facade(
    (3.2, 3.2),
    (0.4, 0.4),
    19e3,
    floor_loads=(1e4, 1e4),
    behind="cross_walls",
    restitution=0.7,
    tie_heights=(6.4,),
    tie_stiffness=2e7,
)


@pytest.mark.parametrize("crack", ["known", None])
def test_the_bulge_of_least_multiplier_counts_wherever_the_wall_is_cracked(crack):
    """By hand, floors at mid-thickness that ride: foot 0, hinge h, tie 6.4 m, of which the least over h."""
    t, top, w, n = 0.4, 6.4, 0.4 * 19e3, 1e4
    hinges = np.linspace(3.2, 6.39, 20_001)
    part = hinges / (top - hinges)  # all above turns back by ψ
    up = w * top + 2 * n
    above = w * (top - hinges) + n
    rises = up * t / 2 + (1 + part) * above * t / 2
    pushed = (
        w * top**2 / 2 + n * (3.2 + 6.4) - (1 + part) * (w * (top - hinges) ** 2 / 2 + n * (top - hinges))
    )
    by_hand = rises / pushed
    first, *others = replace(FRONT, crack_storey=1, crack=crack).candidates()
    assert first.uplift_multiplier == pytest.approx(by_hand.min(), rel=1e-6)
    assert first.position == pytest.approx(hinges[by_hand.argmin()], abs=2e-3)
    assert first.name == "bulges between foot and tie"
    # Its tie keeps every crack shut: the one that is known is followed beside the bulge, and no other.
    counting = [other.name for other in others if other.counts]
    assert counting == ([] if crack is None else [FRONT.does])
    assert replace(FRONT, crack_storey=1, crack=crack).static_multiplier == first.uplift_multiplier


def test_a_tie_that_yields_first_leaves_the_wall_to_overturn():
    """R ≤ F if and only if the bulge is the weaker one (theory: section 12.7)."""
    bulge = FRONT.candidates()[0]
    force = bulge.structure.reactions()[0].force[0]
    for factor, name in ((0.99, FRONT.does), (1.01, "bulges between foot and tie")):
        wall = replace(FRONT, tie_strength=force * factor, tie_plastic_elongation=0.05)
        assert wall.candidates()[0].name == name


def test_warning_on_floors_behind_ends_where_it_is_said_what_stands_there():
    assert StructureKind.FLOORS_BEHIND in {warning.kind for warning in THREE.cautions}
    assert StructureKind.FLOORS_BEHIND not in {
        one_warning.kind for one_warning in replace(THREE, behind="nothing").cautions
    }


def test_a_known_crack_leaves_the_bulges_alone():
    """It says where the wall is cracked: what holds the wall lets it bulge all the same."""
    known = replace(THREE, crack="known", crack_storey=2)
    bulges = [
        other_mechanism
        for other_mechanism in replace(known, crack=None).mechanisms()
        if other_mechanism.structure.opening
    ]
    assert {mechanism.name for mechanism in known.mechanisms()} == {
        known.does,
        *(bulge.name for bulge in bulges),
    }
    untied = replace(known, tie_heights=(), tie_stiffness=0.0)
    assert [one_mechanism.structure for one_mechanism in untied.mechanisms()] == [untied]
    assert rocking.Block(2.0, 0.2).mechanisms()[0].uplift_multiplier == pytest.approx(np.tan(0.2))


def test_chain_keeps_its_held_point_and_hung_points_on_their_bodies():
    hung = [Hung("load", -0.15 + 3.0j, 1, mass=0.4)]
    parts = Parts([1, 0.8, 0.5], [-0.15 + 0.85j, -0.15 + 2.3j, -0.15 + 3.5j], [0.3, 0.2, 0.1])
    chain = Chain((0j, -0.3 + 1.7j), 3.0j, parts, hung, bodies=(0, 1, 2))
    at = np.linspace(0, 0.2, 9)
    held = chain.point(1, 3.0j, at)
    np.testing.assert_allclose(held.moved.real, 0, atol=1e-15)
    upright = chain.point(2, -0.15 + 4.0j, at)
    np.testing.assert_allclose(upright.moved, 1j * held.moved.imag, atol=1e-15)
    load = chain.point(1, hung[0].start, at)
    np.testing.assert_allclose(chain.motion(at).centroids[-1] - hung[0].start, load.moved, atol=1e-15)


@pytest.mark.parametrize(
    ("slab", "strength", "expected"),
    [
        ("hinged", None, 11.927222),
        ("hinged", 1.5e6, 10.604435),
        ("flat", None, 19.705000),
        ("flat", 1.5e6, 17.685045),
    ],
)
def test_reaction_at_the_top_at_rest_is_that_of_hand(slab, strength, expected):
    """Section 12.8, six digits."""
    values = {"top_load": 40e3, "top_slab": slab, "restitution": 0.5, "crack": "known"}
    (top,) = LoadedWall(2.4, 1.2, 0.35, 18e3, **values, compressive_strength=strength).reactions()
    assert top.force[0] / 1e3 == pytest.approx(expected, abs=5e-7)


def test_reaction_of_a_tie_at_rest_is_the_strength_at_which_it_yields_as_it_bulges():
    """Section 12.7: R = 9.201252 kN/m with the hinge at 2.40 m; R ≤ F where λ of the bulge ≤ λ past the tie."""
    wall = ONE_STOREY.opened(Opening(foot=0.0, hinge=2.4, hold=3.6))
    (tie,) = wall.reactions()
    assert tie.kind == "tie" and tie.force[0] == pytest.approx(9201.252, abs=5e-4)
    yields = replace(ONE_STOREY, tie_strength=float(tie.force[0]))
    assert yields.held_wall.multiplier(Opening(foot=0.0)) == pytest.approx(
        wall.mechanism().uplift_multiplier, rel=1e-12
    )


def held_forces(wall, opening, state):
    """What the hold and the foot give together, from how all masses are accelerated: differences of their places.

    The moment of all about the foot, and the sum of the forces sideways.
    """
    phi, velocity, acceleration, ground = state
    linkage = wall.opened(opening).linkages[0]
    step = 2e-4
    times = np.array([-2, -1, 0, 1, 2]) * step
    motion = linkage.motion(phi + velocity * times + acceleration * times**2 / 2)
    second = np.array([-1, 16, -30, 16, -1]) / (12 * step**2)
    places, spin = motion.centroids @ second, motion.angles @ second
    at = motion.centroids[:, 2] - motion.hinges[0, 2]
    forces = linkage.masses * -(places + ground + 1j * GRAVITY)
    moment = (at.real * forces.imag - at.imag * forces.real - linkage.inertias * spin).sum()
    return moment / GRAVITY, forces.real.sum() / GRAVITY


@pytest.mark.parametrize("upright", [False, True])
def test_reaction_in_motion_balances_all_masses_about_the_foot(upright):
    """Differences of places are right to 1e-7."""
    wall = replace(THREE, tie_heights=(6.4, 9.0) if upright else (6.4,), loads_held=False)
    opening = Opening(foot=0.0, hinge=3.9, hold=6.4, upright=upright)
    opened = wall.opened(opening)
    for phi, velocity, ground in ((0.02, 0.3, -1.5), (0.05, -0.4, 2.0), (0.08, 0.1, 0.3)):
        acceleration = float(opened.mechanism().angular_acceleration(phi, velocity, ground))
        state = MotionState.of(opened.mechanism(), phi, velocity, ground=ground)
        found = opened.reactions(state)
        contacts = opened.contact_forces(state)
        moment, sideways = held_forces(wall, opening, (phi, velocity, acceleration, ground))
        held = opened.linkages[0].motion(phi).hinges[2].imag
        heights = [held if one_item.height == 6.4 else one_item.height for one_item in found]
        by_holds = sum(
            float(other_item.force[0]) * height for other_item, height in zip(found, heights, strict=True)
        )
        assert by_holds == pytest.approx(-moment, rel=1e-6)
        # tangential forces are those of the wall on its joint
        at_foot = float(contacts.tangential[0, 0]) * opened.linkages[0].unit / GRAVITY
        together = sum(float(item.force[0]) for item in found)
        assert together == pytest.approx(sideways - at_foot, rel=1e-6)


def test_tie_past_which_a_facade_turns_pulls_as_its_law_says():
    facade = Facade(
        (6.0,), (0.5,), 18e3, tie_heights=(5.0,), tie_stiffness=4e4, behind="cross_walls", restitution=0.6
    )
    state = MotionState.of(facade.mechanism(), [0.02, 0.05], [0.1, 0.0], ground=[0.0, 1.0])
    (tie,) = facade.reactions(state)
    np.testing.assert_allclose(tie.force, 4e4 * 5.0 * np.sin([0.02, 0.05]), rtol=1e-12)
    assert facade.reactions()[0].force[0] == 0
    # two at one height are two
    twice = replace(facade, tie_heights=(5.0, 5.0))
    assert twice.mechanism().positive.at("gravity", 0.02) > facade.mechanism().positive.at("gravity", 0.02)
    np.testing.assert_allclose(twice.reactions(state)[0].force, 2 * tie.force)
    foot = Opening(foot=0.0)
    both, one = (replace(case, tie_strength=3e3).held_wall.multiplier(foot) for case in (twice, facade))
    assert both - one == pytest.approx(one - facade.mechanism().uplift_multiplier, rel=1e-9)


def test_facade_that_a_tie_holds_at_the_top_falls_as_it_bulges():
    """Under 8 sin 6t m/s² of 3 s it stands as one body about its toe, and falls as a wall between foot and tie."""
    facade = Facade(
        (3.2, 3.2),
        (0.4, 0.4),
        19e3,
        floor_loads=(1e4, 1e4),
        behind="cross_walls",
        restitution=0.7,
        tie_heights=(6.4,),
        tie_stiffness=2e7,
    )
    time = np.arange(0, 3.0, 0.005)
    motion = rocking.Accelerogram(8 * np.sin(6 * time), 0.005)
    whole = rocking.integrate(facade, motion)
    bulge = facade.mechanisms()[0]
    assert bulge.name == "bulges between foot and tie"
    # in another process it is the same wall
    copied = pickle.loads(pickle.dumps(bulge.structure))
    for wall in (bulge.structure, copied):
        assert rocking.integrate(wall, motion).outcome is rocking.Outcome.OVERTURNS
    assert whole.outcome is rocking.Outcome.ROCKS


def test_no_arm_lies_flat_before_the_end_of_the_rotation():
    """A squat lower body starts flatter than its margin, and its chain may not be followed beyond where it locks."""
    front = Facade(
        (3.36, 3.03), (0.6, 0.5), 18e3, floor_loads=(12e3, 6e3), tie_heights=(3.56,), tie_stiffness=6e6
    )
    chains = [
        chain
        for listed in front.mechanisms()
        if not listed.refusal
        for chain in listed.structure.linkages
        if isinstance(chain, Chain) and chain._is_held
    ]
    assert len(chains) > 2
    for chain in chains:
        turned = chain._lower * np.exp(1j * chain._turn * chain.end_rotation)
        across = chain._upper.real + (chain._lower - turned).real
        assert abs(across) <= 0.9 * abs(chain._upper) * (1 + 1e-9)
    for listed in front.candidates():
        _ = listed.side.arc
