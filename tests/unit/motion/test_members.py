"""Many responses at a call: each equals the one that `integrate` gives for the same motion."""

import numpy as np
import pytest
from motion_cases import MECHANISMS, noise, random_case, with_restitution
from scipy.constants import g

from rocking.errors import MotionError
from rocking.motion import Members, integrate, integrate_batch, integrate_members
from rocking.motion.batch import rocking_spectrum
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Block, EquivalentBlock
from tests.refusals import refused

RECORD, VERTICAL = noise(5, 600, 0.01, 4.0), noise(6, 600, 0.01, 2.0)
BLOCKS = {name: mechanism.equivalent_block() for name, mechanism in MECHANISMS.items()}
STRUCTURES = MECHANISMS | {f"{name}, linear": block for name, block in BLOCKS.items()}


def one_by_one(structure, record, members, k, vertical, tolerance):
    motion = record.scaled(float(members.scale_factor[k] * members.polarity[k]))
    lift = vertical.scaled(float(members.scale_factor[k])) if members.vertical[k] else None
    return integrate(with_restitution(structure, *members.restitution[k]), motion, tolerance, vertical=lift)


def steady(structure, record, members, k, ratio):
    """Whether a member is well conditioned: a motion 1e-9 stronger, followed to 1e-11, changes it by less than 1e-7.

    Errors of the tolerance, 1e-10, and roundings then change it by less than that on any processor.
    """
    stronger = one_by_one(structure, record.scaled(1 + 1e-9), members, k, VERTICAL.scaled(1 + 1e-9), 1e-11)
    return stronger.rotation_ratio == ratio or abs(stronger.rotation_ratio / ratio - 1) < 1e-7


@pytest.mark.parametrize("count", [16, pytest.param(40, marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", STRUCTURES)
def test_members_equal_one_response_at_a_time(name, count):
    """At a tolerance of 1e-10, of the members that are steady. Each kind of variation occurs."""
    structure, rng = STRUCTURES[name], np.random.default_rng(3)
    lift = max(side.uplift_multiplier for side in getattr(structure, "sides", (structure,))) * g
    record = RECORD.scaled(lift / RECORD.peak_acceleration)
    members = Members(
        scale_factor=rng.uniform(0.8, 3, count),
        polarity=rng.choice([-1, 1], count),
        vertical=rng.random(count) < 0.5,
        restitution=rng.uniform(0.5, 0.9, (count, 2)),
    )
    found = integrate_members(structure, record, members, 1e-10, vertical=VERTICAL)
    alone = [one_by_one(structure, record, members, k, VERTICAL, 1e-10) for k in range(count)]
    expected = np.array([response.rotation_ratio for response in alone])
    kept = np.array([steady(structure, record, members, k, expected[k]) for k in range(count)])
    assert kept.sum() >= 0.75 * count
    assert found.rotation_ratio[kept] == pytest.approx(expected[kept], rel=1e-7)
    rocks = found.lifted & ~found.overturns & kept
    assert np.array_equal(found.peak_side[rocks], np.array([part.peak_side for part in alone])[rocks])
    assert rocks.sum() > count / 8
    assert not found.reasons


@pytest.mark.parametrize("linear", [False, True])
def test_chains_of_impacts_that_die_out_change_nothing(linear):
    """Members leave them out and `integrate` follows them: both end in the same rest, and so does what follows.

    Only cases count whose peak changes by less than a hundred times a change of the motion: roundings then stay far
    below 1e-9 on any processor.
    """
    rng, steady = np.random.default_rng(8), 0
    for _ in range(200):
        mechanism, motion = random_case(rng)
        if isinstance(motion, Pulse):
            continue
        structure = mechanism.equivalent_block() if linear else mechanism
        motions = motion, motion.scaled(1 + 1e-9)
        alone, stronger = (integrate(structure, one_motion, 1e-12).rotation_ratio for one_motion in motions)
        if np.isfinite(alone) and abs(stronger / alone - 1) < 1e-7:
            found = integrate_members(structure, motion, Members(), 1e-12).rotation_ratio[0]
            assert found == pytest.approx(alone, rel=1e-9)
            steady += 1
    assert steady > 40


def test_batch_equals_one_response_at_a_time():
    structures, factors = [*STRUCTURES.values(), Block(1.0, 0.25)], np.array([0.2, 0.5, 1.0, 1.5, 3.0])
    for vertical in (None, VERTICAL):
        ratios = integrate_batch(structures, RECORD, factors, vertical=vertical, tolerance=1e-10)
        assert ratios.shape == (len(structures), factors.size)
        for row, structure in zip(ratios, structures, strict=True):
            for ratio, factor in zip(row, factors, strict=True):
                lift = None if vertical is None else vertical.scaled(factor)
                alone = integrate(structure, RECORD.scaled(factor), 1e-10, vertical=lift)
                assert ratio == pytest.approx(alone.rotation_ratio, rel=1e-7)
    assert np.isinf(ratios).any() and (ratios == 0).any() and ((ratios > 0) & (ratios < 1)).any()


def test_batch_is_the_same_on_any_number_of_threads():
    structures, factors = list(STRUCTURES.values())[:3], np.linspace(0.5, 3, 70)
    one, three = (integrate_batch(structures, RECORD, factors, workers=n) for n in (1, 3))
    assert np.array_equal(one, three)


def test_a_structure_that_fails_is_nan_and_the_others_go_on():
    ratios = integrate_batch(["a block", MECHANISMS["block"]], RECORD, (1.0, 1.2))
    assert np.isnan(ratios[0]).all()
    assert np.isfinite(ratios[1]).all()


@pytest.mark.parametrize("mechanism", MECHANISMS.values(), ids=MECHANISMS)
def test_a_member_lifts_from_the_uplift_multiplier_on(mechanism):
    """Whether it is followed alone, without a table, or beside one that lifts."""
    peak = g * mechanism.uplift_multiplier
    record = Accelerogram(np.array([0.0, peak, 0.0, -peak, 0.0]), 0.01)
    for factors in ([1 - 1e-7], [1 + 1e-7], [1 - 1e-7, 1 + 1e-7]):
        lifted = integrate_members(mechanism, record, Members(factors)).lifted
        assert lifted.tolist() == [factor > 1 for factor in factors]


@pytest.mark.process
def test_a_member_that_fails_says_why():
    """Without loss, rattling that a push just above the uplift acceleration began goes on for a day."""
    block = Block(1.0, 0.2).mechanism()
    push = np.zeros(1_000_000)
    push[1] = 1.05 * g * block.uplift_multiplier
    found = integrate_members(block, Accelerogram(push, 0.01), Members(restitution=[1.0, 0.5]))
    assert np.isnan(found.rotation_ratio[0]) and 0 < found.rotation_ratio[1] < 1e-3
    assert "5000000 impacts before the motion ended" in found.reasons[0]


@pytest.mark.parametrize(
    "fields, value",
    [
        ({"scale_factor": [1.0, 0.0]}, 0.0),
        ({"scale_factor": [np.nan]}, np.nan),
        ({"polarity": [2]}, 2.0),
        ({"restitution": [0.5, 1.2]}, 1.2),
        ({"scale_factor": [1.0, 2.0], "polarity": [1, 1, 1]}, [1.0, 2.0]),
    ],
)
def test_members_are_checked_at_birth(fields, value):
    with refused(MotionError, next(iter(fields)), value):
        Members(**fields)


SHAKING = noise(3, 800, 0.01, 4.0)


def test_spectrum_equals_the_responses():
    """Each cell is the equivalent block of that p and λ; φ_cr itself does not matter, so 0.7 is as good as any.

    The two round 1/(gλ) differently, and by the end of the record some cells answer a change of the amplitude ten
    million times over. So the difference is held against what a change of 16 roundings does to the response itself.
    """
    frequencies, multipliers = np.linspace(0.5, 6, 7), np.linspace(0.05, 0.5, 9)
    ratios = rocking_spectrum(SHAKING, frequencies, multipliers, 0.85)
    assert ratios.shape == (7, 9)
    nudged = [SHAKING.scaled(1 + sign * 16 * np.finfo(float).eps) for sign in (-1, 1)]
    for i, p in enumerate(frequencies):
        for j, multiplier in enumerate(multipliers):
            block = EquivalentBlock(
                frequency_parameter=p,
                critical_rotation=0.7,
                acceleration_scale=0.7 / multiplier,
                restitution=0.85,
            )
            alone = integrate(block, SHAKING).rotation_ratio
            around = [integrate(block, record).rotation_ratio for record in nudged]
            spread = max(abs(item - alone) for item in around) if np.isfinite(alone) else 0.0
            assert ratios[i, j] == pytest.approx(alone, rel=1e-12, abs=spread)
    assert np.isinf(ratios).any() and (ratios == 0).any() and ((ratios > 0) & (ratios < 1)).any()


@pytest.mark.parametrize(
    "settings, field, value",
    [
        (([0.0], [0.2], 0.9), "frequency_parameters", [0.0]),
        (([[1.0]], [0.2], 0.9), "frequency_parameters", [[1.0]]),
        (([2.0], [np.nan], 0.9), "uplift_multipliers", [np.nan]),
        (([6000.0], [0.2], 0.9), "frequency_parameters", 6000.0),
    ],
)
def test_a_spectrum_refuses_what_has_none(settings, field, value):
    with refused(MotionError, field, value):
        rocking_spectrum(SHAKING, *settings)


def test_a_list_of_blocks_and_others_is_followed_as_each_of_them_alone():
    """In one call, as one worker makes it: blocks of one side and of two, and a mechanism that is no plain block."""
    structures = [BLOCKS["block"], MECHANISMS["block"], BLOCKS["two sides"], BLOCKS["one side"]]
    factors = (1.0, 1.2)
    together = integrate_batch(structures, RECORD, factors, workers=1)
    alone = [
        [integrate(structure, RECORD.scaled(k)).rotation_ratio for k in factors] for structure in structures
    ]
    assert together == pytest.approx(np.array(alone), rel=1e-9)  # the same computation up to roundings
    assert together.min() > 0
