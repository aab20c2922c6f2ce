"""Arches, arches on piers and portals as stones: held against mechanisms, statics, energy, symmetry and momentum."""

from dataclasses import replace

import numpy as np
import pytest

from rocking import (
    Accelerogram,
    Arch,
    ArchOnPiers,
    Block,
    Frame,
    MotionError,
    StructureError,
)
from rocking.contacts.dynamics import StackResponse, follow_stack
from rocking.quantities import GRAVITY
from rocking.structures.joints import Joints
from rocking.structures.stones import MOST_VOUSSOIRS, VOUSSOIRS, Stone, Stones
from tests.refusals import refused

ARCH = Arch(10.0, 1.5, np.radians(157.5), 13)
PIERS = ArchOnPiers(4.0, 0.7, np.radians(150), 11, pier_width=1.6, pier_height=3.0)
PORTAL = Frame(Block.of_size(1.0, 8.0), 2, 0.3)
STILL = Accelerogram(np.zeros(200), 0.01)


def on_friction(structure: Arch | Frame, friction: float, voussoirs: int | None = None) -> Stones:
    return replace(structure.stones(voussoirs), friction=friction)


def shaking(peak: float, seconds: float = 6.0) -> Accelerogram:
    """Four sines of drawn phases that swell and fade."""
    chance = np.random.default_rng(4)
    times = np.arange(0, seconds, 0.01)
    waves = sum(np.sin(2 * np.pi * value * times + chance.uniform(0, 6)) for value in (0.8, 1.4, 2.3, 3.9))
    waves = waves * np.sin(np.pi * times / seconds)
    return Accelerogram(peak * waves / np.abs(waves).max(), 0.01)


def energies(stones: Stones, response: StackResponse) -> np.ndarray:
    masses = np.array([stone.mass for stone in stones.stones])
    inertias = np.array([one_stone.inertia for one_stone in stones.stones])
    places, velocities = response.places, response.velocities
    moving = masses * (velocities[..., :2] ** 2).sum(axis=-1) + inertias * velocities[..., 2] ** 2
    return (moving / 2 + masses * GRAVITY * places[..., 1]).sum(axis=1)


def test_statics_of_stones_is_that_of_the_mechanism():
    """The linear programme of forces at all joints beside the mechanism of least λ: thirty arches, and the frame."""
    chance, found = np.random.default_rng(2), []
    while len(found) < 30:
        radius, ratio, embrace = chance.uniform([3, 0.08, 100], [15, 0.2, 180])
        size = radius, ratio * radius, np.radians(embrace), int(chance.integers(5, 41))
        try:
            if len(found) % 3:
                arch = Arch(*size, fill_depth=0.3 if len(found) % 2 else None)
            else:
                arch = ArchOnPiers(*size, pier_width=0.4 * radius, pier_height=0.6 * radius)
        except StructureError:
            continue
        found.append(arch.stones().resting_multiplier / arch.onset.multiplier)
    assert found == pytest.approx([1.0] * 30, rel=1e-11)
    assert PORTAL.stones().resting_multiplier == pytest.approx(
        PORTAL.mechanism().uplift_multiplier, rel=1e-12
    )


@pytest.mark.parametrize("number", [5, 13, 21, 40, 60])
@pytest.mark.parametrize("friction", [0.3, 0.6, 5.0])
def test_stones_rest_on_still_ground(number, friction):
    arch = Arch(8.0, 1.4, np.radians(110))
    stones = on_friction(arch, friction, number)
    assert stones.count == number and stones.resting_multiplier > 0.1
    response = follow_stack(stones, STILL, history=True)
    assert (response.falls, response.unsolved_steps) == (False, 0)
    assert np.abs(response.places).max() < 2e-9


@pytest.mark.parametrize("share", [0.98, 1.03])
@pytest.mark.parametrize("structure", [ARCH, replace(ARCH, fill_depth=0.5), PIERS, PORTAL])
def test_they_open_under_a_slow_push_where_statics_has_it(structure, share):
    push = share * structure.mechanism().uplift_multiplier * GRAVITY
    steady = Accelerogram(np.concatenate([np.linspace(0, push, 2000), np.full(500, push)]), 1e-3)
    response = follow_stack(structure.stones(), steady, 1e-3)
    assert (response.largest_turns.max() > 1e-4) == (share > 1)


def test_they_slide_under_a_slow_push_where_statics_with_friction_has_it():
    slides_at = ARCH.on_joints(Joints(0.4)).slides_at()
    assert slides_at < 0.8 * ARCH.static_multiplier
    stones = on_friction(ARCH, 0.4)
    assert stones.resting_multiplier == pytest.approx(slides_at, rel=1e-9)
    for share in (0.97, 1.04):
        most = share * slides_at * GRAVITY
        push = np.concatenate([np.linspace(0, most, 2000), np.full(500, most)])
        response = follow_stack(stones, Accelerogram(push, 1e-3), 1e-3, history=True)
        assert (np.abs(response.places[:2500, :, :2]).max() > 1e-4) == (share > 1)


@pytest.mark.parametrize("structure", [ARCH, PIERS, PORTAL])
def test_free_motion_gains_no_energy(structure):
    """What a strong push has set in motion rocks on still ground; a step may add what it is late in an impact."""
    stones = structure.stones()
    motion = shaking(1.6 * structure.mechanism().uplift_multiplier * GRAVITY, 3.0)
    still = Accelerogram(np.append(motion.acceleration, np.zeros(600)), 0.01)
    response = follow_stack(stones, still, history=True)
    assert not response.falls
    energy = energies(stones, response)[310:]
    lifting = sum(stone.mass for stone in stones.stones) * GRAVITY * 1.0 * response.largest_turns.max()
    risen = np.maximum.accumulate(energy[::-1])[::-1] - energy
    assert response.largest_turns.max() > 1e-3
    assert risen.max() < 1e-3 * lifting
    assert energy[-1] < max(energy[0], 1e-3 * lifting)


def test_a_mirrored_motion_turns_the_mirrored_stones():
    motion = shaking(1.4 * ARCH.static_multiplier * GRAVITY, 2.0)
    one, other = (follow_stack(ARCH.stones(), motion.scaled(sign), history=True) for sign in (1, -1))
    mirrored = other.places[:, ::-1] * [-1, 1, -1]
    assert np.abs(one.places[..., 2]).max() > 1e-4
    # roundings grow from impact to impact
    assert one.places[:60] == pytest.approx(mirrored[:60], abs=1e-9)


@pytest.mark.parametrize(("breadth", "ratio"), [(1.0, 0.3), (1.5, 1.0), (0.8, 2.0)])
def test_a_portal_keeps_of_an_impact_what_the_balance_of_momentum_says(breadth, ratio):
    """Of two flights from ω each turns to cos(α − φ) − cos α ~ ω²; both columns turn about one side's corners."""
    portal = Frame(Block.of_size(breadth, 8.0), 2, ratio)
    stones = portal.stones()
    left, beam, right = (np.array(stone.centre) for stone in stones.stones)
    half = breadth / 2
    arms = left - [left[0] + half, 0], np.array([-breadth, 8.0]), right - [right[0] + half, 0]
    spin = 0.1
    turning = spin, 0.0, spin
    start = np.array(
        [[spin * up, -spin * across, turn] for (across, up), turn in zip(arms, turning, strict=True)]
    )
    response = follow_stack(
        stones, Accelerogram(np.zeros(2000), 8e-4), 2e-4, history=True, initial_velocity=start
    )
    turns = response.places[:, 0, 2]
    landing = int(np.flatnonzero(turns[1:] <= 0)[0]) + 1
    alpha = portal.column.slenderness
    risen = [np.cos(alpha - peak) - np.cos(alpha) for peak in (turns[:landing].max(), -turns[landing:].min())]
    assert np.sqrt(risen[1] / risen[0]) == pytest.approx(portal.mechanism().restitution, abs=0.005)
    assert beam[1] > 8.0


@pytest.mark.parametrize("friction", [0.05, 0.2])
def test_a_stone_that_slips_out_falls_without_turning(friction):
    """On joints of little friction the crown slides down between its neighbours, at 0.2 slowly at first."""
    stones = on_friction(ARCH, friction, 7)
    assert stones.resting_multiplier == 0 and np.isfinite(stones.at_rest.drops[1:-1]).all()
    response = follow_stack(stones, STILL)
    assert response.falls
    assert response.largest_turns.max() < stones.fallen_turn / 2


def slipped(weak: float, friction: float = 0.35) -> tuple[Stones, Accelerogram]:
    """A pulse under which joints slide, 4 s of still ground, 4 s of a sine of `weak` times what moves them first."""
    stones = on_friction(ARCH, friction)
    moves = stones.resting_multiplier * GRAVITY
    times = np.arange(0, 4, 0.005)
    pulse = 3 * moves * np.sin(2 * np.pi * times[:120] / 0.6)
    return stones, Accelerogram(
        np.concatenate([pulse, np.zeros(800), weak * moves * np.sin(2 * np.pi * times / 0.5)]), 0.005
    )


def test_what_slipped_rests_with_open_joints_under_weak_motion():
    """It lies still to the last bit where nothing opens, and does not creep by what its contacts give."""
    response = follow_stack(*slipped(0.02), history=True)
    assert not response.falls and response.largest_turns.max() > 0.03
    resting = response.times > 3.6
    assert np.abs(np.diff(response.turns)).max() > 0.01
    assert np.abs(response.velocities[resting]).max() == 0


def test_what_slipped_is_followed_as_long_as_the_ground_may_move_it_again():
    """It stands elsewhere, so that less than half of what moved it at first, for which it is watched no more, does."""
    stones, motion = slipped(0.45)
    before = follow_stack(*slipped(0.0)).largest_turns.max()
    again = follow_stack(stones, motion)
    assert again.largest_turns.max() > 1.02 * before
    intact = follow_stack(stones, motion.scaled(0.2))
    assert again.steps * 5e-4 > motion.duration > 2 * intact.steps * 5e-4


def test_hardly_any_step_has_its_impulses_found_one_after_the_other():
    steps = unsolved = 0
    for structure, friction in ((ARCH, 0.6), (replace(ARCH, voussoirs=27), 5.0), (PIERS, 0.6)):
        motion = shaking(2 * structure.static_multiplier * GRAVITY, 4.0)
        response = follow_stack(on_friction(structure, friction), motion)
        assert response.largest_turns.max() > 1e-3
        steps += response.steps
        unsolved += response.unsolved_steps
    assert unsolved < 1e-3 * steps


def test_an_arch_has_the_voussoirs_that_it_states():
    assert ARCH.stones().count == 13
    assert replace(ARCH, voussoirs=None).stones().count == VOUSSOIRS
    assert replace(ARCH, voussoirs=400).stones().count == MOST_VOUSSOIRS
    assert ARCH.stones(7).count == 7
    assert PIERS.stones().count == 13
    whole = sum(stone.mass for stone in replace(PIERS, fill_depth=0.4).stones(9).stones)
    assert whole == pytest.approx(replace(PIERS, fill_depth=0.4).ring.mass)


BODY = Stone(((0, 0), (1, 0), (1, 1), (0, 1)), 1.0, (0.5, 0.5), 0.2)


def test_the_faces_of_a_stone_are_its_first_and_its_last_edge():
    """5 m from (1, 1) to (4, 5), and 13 m from (9, 2) to (14, 14)."""
    stone = replace(BODY, corners=((1, 1), (4, 5), (14, 14), (9, 2)))
    assert stone.faces == pytest.approx((5.0, 13.0))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: ARCH.stones(2), "voussoirs is 2, but must be"),
        (lambda: ARCH.stones(61), "voussoirs is 61, but must be"),
        (lambda: replace(PORTAL, columns=3).stones(), "only two columns below a beam"),
        (lambda: PORTAL.stones(5), "has no voussoirs"),
        (lambda: Block(2.0, 0.2).stones(), "is not a chain of stones"),
        (lambda: replace(BODY, mass=0.0), "a stone has the corners"),
        (lambda: replace(BODY, corners=((0, 0), (1, 0), (1, 1))), "must have four corners"),
        (lambda: Stones((BODY,)), "must have 2 to"),
        (lambda: Stones((BODY, BODY)), "faces must meet"),
        (lambda: on_friction(ARCH, -0.1), "friction is -0.1"),
    ],
)
def test_what_is_no_chain_is_refused_in_one_sentence(make, words):
    with pytest.raises(StructureError, match=words):
        make()


def test_a_step_that_is_too_long_is_refused_in_one_sentence():
    with refused(MotionError, "step", 0.05):
        follow_stack(ARCH.stones(), STILL, 0.05)
