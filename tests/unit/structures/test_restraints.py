"""What holds a wall: the force at its top and its ties by hand, and the wall whose top slips against the formulas."""

import math
from dataclasses import replace

import numpy as np
import pytest

import rocking
from rocking.quantities import GRAVITY
from rocking.structures import Facade, LoadedWall, Wall
from rocking.structures.joints import Joints
from rocking.structures.kinds import StructureKind

BY_HAND = 1e-9
HEIGHT, THICKNESS, FLOOR = 3.6, 0.35, 4e3
WALL = LoadedWall.of_size(HEIGHT, THICKNESS, 18e3, 2.4, top_load=FLOOR, restitution=0.7)
WEIGHT = 18e3 * HEIGHT * THICKNESS


def slipping(wall):
    return next(
        mechanism
        for mechanism in wall.mechanisms()
        if mechanism.name.endswith("its top slipping") and mechanism.sign > 0
    )


def needed(hinge):
    """R = (λ S_h + M_h⁻)/(H − h) with the floor in the middle, and λ = G/B, kN (theory: section 12.4)."""
    share = (HEIGHT - hinge) / HEIGHT
    ratio = hinge / (HEIGHT - hinge)
    half = THICKNESS / 2
    upper = share * WEIGHT
    inner = (upper + FLOOR) * half
    lever = upper * (HEIGHT - hinge) / 2
    outer = (WEIGHT + FLOOR) * half
    multiplier = (outer + (1 + ratio) * inner) / (WEIGHT * HEIGHT / 2 - (1 + ratio) * lever)
    return multiplier, (multiplier * lever + inner) / (HEIGHT - hinge)


def test_a_light_floor_does_not_hold_the_top():
    """By hand: R = 3.18 kN/m, .6 of a floor of 4 kN/m gives 2.4; λ of the wall that slips is (M + μ N H)/S."""
    multiplier, force = needed(2.4)
    wall = replace(WALL, crack="known")
    (top,) = wall.restraints
    assert wall.mechanism().uplift_multiplier == pytest.approx(multiplier, rel=BY_HAND)
    assert top.needed == pytest.approx(force, rel=BY_HAND)
    assert (top.gives, top.friction, top.ties) == pytest.approx((2.4e3, 2.4e3, 0), rel=BY_HAND)
    assert top.lets_go and top.warning.kind is StructureKind.TOP_SLIPS
    assert top.warning["tie_kN_m"] == pytest.approx((force - 2.4e3) / 1e3, rel=BY_HAND)
    by_hand = ((WEIGHT + FLOOR) * THICKNESS / 2 + 0.6 * FLOOR * HEIGHT) / (WEIGHT * HEIGHT / 2)
    slips = slipping(wall)
    assert slips.uplift_multiplier == pytest.approx(by_hand, rel=BY_HAND)
    assert slips.mechanism.uplift_multiplier == pytest.approx(by_hand, rel=BY_HAND)
    assert slips.mechanism.uplift_multiplier < multiplier


@pytest.mark.parametrize("slab", ["hinged", "flat"])
def test_the_top_slips_first_where_it_needs_more_than_it_gets_and_nowhere_else(slab):
    """R ≤ F if and only if λ of the bulge ≤ λ of the wall that slips, for any friction."""
    wall = replace(WALL, top_slab=slab).cracked_by_statics()
    (held,) = wall.restraints
    for friction in (0.2, 0.99 * held.needed / FLOOR, 1.01 * held.needed / FLOOR, 3.0):
        (top,) = wall.on_joints(Joints(friction)).restraints
        first, *_ = wall.on_joints(Joints(friction)).candidates()
        assert top.lets_go is (friction * FLOOR < held.needed)
        assert ("slip" in first.name or "sways" in first.name) is top.lets_go
        if top.lets_go:  # what would hold the hinges does not
            assert len(wall.on_joints(Joints(friction)).candidates()) == 1


def test_a_tie_at_the_top_holds_what_friction_does_not():
    loose = replace(WALL, one_sided=True)
    missing = loose.restraints[0].warning["tie_kN_m"] * 1e3
    for strength, holds in ((0.99 * missing, False), (1.01 * missing, True), (None, True)):
        tied = replace(loose, tie_heights=(HEIGHT,), tie_stiffness=2e7, tie_strength=strength)
        (top,) = tied.restraints
        assert top.lets_go is not holds
        assert top.gives == pytest.approx(2.4e3 + (math.inf if strength is None else strength))


def test_friction_of_the_study_counts_where_a_wall_states_none():
    assert WALL.on_joints(Joints(0.4)).restraints[0].coefficient == pytest.approx(0.4)
    assert replace(WALL, top_friction=0.9).on_joints(Joints(0.4)).restraints[0].coefficient == pytest.approx(
        0.9
    )
    assert WALL.on_joints(Joints(0.4)).description == WALL.description
    bare = replace(WALL, top_load=0.0)
    assert bare.on_joints(Joints(0.4)).restraints == bare.restraints  # what holds it is no friction


def test_a_wall_at_a_ceiling_says_the_share_of_its_weight_that_its_top_needs():
    """By hand: λ = 4 t/H and R/W = λ/8 + t/(2 H) of equal halves."""
    wall = Wall.of_size(3.2, 0.25, 1.6)
    (top,) = wall.restraints
    assert top.needed == pytest.approx(4 * 0.25 / 3.2 / 4 + 0.25 / 3.2 / 2, rel=BY_HAND)
    assert top.warning.kind is StructureKind.TOP_TAKEN_AS_HELD
    (of_stone,) = replace(wall, unit_weight=20e3).restraints
    assert of_stone.needed == pytest.approx(20e3 * 3.2 * 0.25 * top.needed, rel=BY_HAND)
    assert of_stone.warning.kind is StructureKind.TOP_MUST_BE_HELD


def test_the_word_is_that_of_the_wall_that_slips():
    """Under a long pulse just above λ of the wall that slips, and far below that of the held one, which rests."""
    wall = replace(WALL, top_friction=0.3)
    slips = slipping(wall)
    held = wall.mechanism().uplift_multiplier
    pulse = rocking.Pulse(
        amplitude=1.6 * slips.mechanism.uplift_multiplier * GRAVITY, circular_frequency=2.0, start_time=0.2
    )
    assert 1.6 * slips.mechanism.uplift_multiplier < held
    record = rocking.Accelerogram(pulse.acceleration(np.arange(900) * 0.01), 0.01)
    falls = rocking.assess(record, wall.cracked_by_statics())
    assert falls.verdict is rocking.Verdict.OVERTURNS
    assert "its top slips: it needs " in falls.why
    assert rocking.assess(record, replace(wall, top_friction=5.0)).verdict is rocking.Verdict.STANDS


def test_ties_say_what_they_bear_and_what_they_give():
    """Section 12.7: R = 8.858030 kN/m with the hinge where λ is least."""
    facade = Facade(
        (3.6,), (0.35,), 18e3, floor_loads=(10e3,), eccentricity=0.05, behind="cross_walls", restitution=0.7,
        tie_heights=(3.6,), tie_stiffness=2e7,
    )  # fmt: skip
    kinds = {None: StructureKind.TIE_MUST_BEAR, 30e3: StructureKind.TIE_BEARS, 6e3: StructureKind.TIE_YIELDS}
    for strength, kind in kinds.items():
        (tie,) = replace(facade, tie_strength=strength).restraints
        assert tie.needed == pytest.approx(8.858030e3, abs=5e-3)
        assert tie.warning.kind is kind


@pytest.mark.parametrize("friction", [0.05, 0.3, 5.0])
def test_beside_a_known_crack_a_top_that_friction_holds_may_slip(friction):
    """Between two supports the known crack is the only bulge: what a top on friction adds is that it slips."""
    wall = replace(WALL, top_friction=friction, crack="known")
    own, others = [], []
    for one_mechanism in wall.mechanisms():
        opening = one_mechanism.structure.opening
        (others if opening is not None and wall.held_wall.slip(opening) else own).append(one_mechanism)
    assert len(own) == 1 and own[0].structure == wall
    assert others, "it slips, however rough the top is"
    assert min(others, key=lambda item: item.uplift_multiplier).uplift_multiplier > 0
    held = replace(WALL, top_load=0.0, crack="known")
    assert not held.held_wall.top_may_slip
    assert [mechanism.structure for mechanism in held.mechanisms()] == [held]


@pytest.mark.parametrize(
    ("friction", "grip", "slides_at"), [(0.2, 1400, 0.117), (0.6, 4200, 0.196), (0.9, 6300, 0.256)]
)
def test_an_anchor_grips_by_the_friction_of_the_joints(friction, grip, slides_at):
    """By hand: μ of the half metre above the tie and of the course of .2 m that its anchor grips."""
    front = Facade(
        (3.5, 3.0), (0.5, 0.5), 20e3, behind="cross_walls", restitution=0.5, tie_heights=(6.0,), tie_stiffness=2e7,
        joints=Joints(friction),
    )  # fmt: skip
    (tie,) = [restraint for restraint in front.restraints if restraint.kind == "tie"]
    assert tie.grip == pytest.approx(grip, rel=BY_HAND)
    assert front.anchors_slide_at == pytest.approx(slides_at, abs=5e-4)
    assert tie.slides_out["friction"] == friction


@pytest.mark.parametrize("below", [0.0, 1.2])
def test_a_tie_gets_no_more_than_the_wall_around_its_anchor_gives(below):
    """Section 13.3, by hand: .6 (what lies above and a course of .2 m); less than 2.8 R, or than the tie's force."""
    values = {"behind": "cross_walls", "restitution": 0.7, "floor_loads": (4e3,), "tie_stiffness": 2e7}
    front = Facade((HEIGHT,), (THICKNESS,), 18e3, tie_heights=(HEIGHT - below,), **values)
    (tie,) = front.restraints
    by_hand = 0.6 * (4e3 + 18e3 * THICKNESS * (below + 0.2))
    assert tie.grip == pytest.approx(by_hand, rel=1e-9)
    assert (tie.slides_out is not None) is (2.8 * tie.needed > by_hand)
    for factor in (0.9, 1.1):
        (weak,) = replace(front, tie_strength=factor * by_hand).restraints
        said = weak.slides_out
        assert (said is not None) is (factor > 1)
        assert said is None or said["grip_kN_m"] == pytest.approx(by_hand / 1e3, rel=1e-9)
    (top,) = WALL.restraints
    assert top.grip == math.inf and top.slides_out is None


@pytest.mark.parametrize("courses", [2, 12])
def test_a_floor_throws_a_storey_back_with_the_restitution_of_the_wall(courses):
    """A mass on a spring and a dashpot keeps e^(−πζ/√(1−ζ²)) of its velocity, with c = 2 ζ √(k m)."""
    wall = Facade((3.0, 4.0), (0.5, 0.4), 18e3, floor_loads=(20e3, 20e3), behind="floors", restitution=0.6)
    stack = wall.stack(courses)
    storey = sum(course.mass for course in stack.courses) / 2
    for floor in stack.held[-2:]:
        damping = floor.stop.damping / math.sqrt(floor.stop.stiffness * storey) / 2
        assert math.exp(-math.pi * damping / math.sqrt(1 - damping**2)) == pytest.approx(0.6, rel=BY_HAND)
