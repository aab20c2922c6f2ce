"""The compiled scan against plain sums and a plain neighbour search, its refinement against a general optimiser."""

import itertools
import math

import numpy as np
import pytest
from scipy import ndimage, optimize

from rocking.pulses import scan
from rocking.pulses.scan import PROBES, apart, energy_gains, envelope_phase, local_maxima, refine
from tests.parts import callable_parts

STEP = 0.02


def plain_gain(samples, frequency, start):
    """⟨a, s⟩²/⟨s, s⟩ by one sum over all samples."""
    phase = (np.arange(samples.size) * STEP - start) * frequency
    sine = np.sin(2 * np.pi * phase) * ((phase >= 0) & (phase <= 1))
    return (samples @ sine) ** 2 / (sine @ sine) * STEP


@pytest.fixture
def samples():
    return np.random.default_rng(7).standard_normal(300)


def test_the_map_is_the_plain_sum_at_every_onset(samples):
    frequencies = np.array([0.3, 0.71, 2.0, 4.9])
    gains = energy_gains(samples[np.newaxis], STEP, 2 * np.pi * STEP * frequencies)
    for i, frequency in enumerate(frequencies):
        last = 300 - 1 - math.ceil(1 / frequency / STEP - 1e-9)  # the whole cycle lies in the record
        expected = [plain_gain(samples, frequency, j * STEP) for j in range(last + 1)]
        # the recurrence adds one rounding a sample: 300 · 2e-16 of the largest gain
        assert gains[: last + 1, i] == pytest.approx(expected, abs=1e-12 * max(expected))
        assert np.all(gains[last + 1 :, i] == 0)


def plain_maxima(gains):
    """(onset, column) of the cells above their eight neighbours, by a filter."""
    neighbours = np.ones((3, 3), bool)
    neighbours[1, 1] = False
    highest = ndimage.maximum_filter(gains, footprint=neighbours, mode="constant", cval=0)
    return np.argwhere(gains > highest)


@pytest.mark.parametrize(("first", "last"), [(0, 300), (0, 120), (41, 90), (250, 300), (63, 193)])
def test_maxima_are_those_of_a_plain_neighbour_search(samples, first, last):
    angles = 2 * np.pi * STEP * np.geomspace(0.3, 4.9, 30)
    places, gains = local_maxima(samples[np.newaxis], STEP, angles, first, last, 0.0)
    whole = energy_gains(samples[np.newaxis], STEP, angles)
    expected = [place for place in plain_maxima(whole).tolist() if first <= place[0] < last]
    assert places.tolist() == expected
    assert gains == pytest.approx(whole[tuple(places.T)], rel=1e-9, abs=1e-12)


def test_of_spans_that_share_their_time_the_largest_are_chosen():
    rng = np.random.default_rng(3)
    starts = rng.uniform(0, 10, 200)
    ends = starts + rng.uniform(0.3, 3, 200)
    gains = rng.uniform(0.5, 1, 200).round(2)
    left = sorted(range(200), key=lambda i: -gains[i])
    expected = []
    while left:
        best = left[0]
        expected.append(best)
        joint = [max(ends[i], ends[best]) - min(starts[i], starts[best]) for i in left]
        common = [min(ends[i], ends[best]) - max(starts[i], starts[best]) for i in left]
        left = [i for i, a, b in zip(left, common, joint, strict=True) if a / b < 0.4]
    assert apart(starts, ends, gains, 6, 0.4).tolist() == expected[:6]
    assert apart(starts, ends, gains, 200, 0.4).tolist() == expected, "fewer where no more are left"


@pytest.mark.parametrize("onset", [0, 15, 60, 150, 250, 290])
def test_the_phase_is_that_of_the_largest_envelope_within_half_a_cycle(samples, onset):
    length = 40.5
    turned = np.exp(2j * np.pi / length * np.arange(41))
    sums = np.array([samples[j : j + 41] @ turned for j in range(300 - 41 + 1)])
    near = np.flatnonzero(np.abs(np.arange(sums.size) - onset) <= length / 2)
    near = near if near.size else np.array([sums.size - 1])  # the last cycle that fits
    best = sums[near[np.argmax(np.abs(sums[near]))]]
    phase = envelope_phase(samples, onset, 2 * np.pi / length)
    assert phase == pytest.approx(math.atan2(best.real, best.imag), abs=1e-9)


def noisy_pulse(seed):
    phase = (np.arange(400) * STEP - 2.013) / 1.7
    clean = np.sin(2 * np.pi * phase) * ((phase > 0) & (phase < 1))
    return clean + 0.3 * np.random.default_rng(seed).standard_normal(400)


@pytest.mark.parametrize("seed", range(8))
def test_refinement_reaches_the_maximum_of_a_general_optimiser(seed):
    samples, turn = noisy_pulse(seed), 2 * math.pi * STEP
    angle, start, sine, norm = refine(samples, 101, turn / 1.65, turn * 0.2, turn * 5, 0.1)
    bounds, accuracy = [(0.55, 0.66), (1.8, 2.2)], {"tol": 1e-12, "popsize": 20}
    found = optimize.differential_evolution(lambda x: -plain_gain(samples, *x), bounds, seed=seed, **accuracy)
    gain = sine**2 / norm * STEP
    # the landscape has a kink at every sample; what the climb may miss is less than a thousandth of the gain
    assert gain >= -found.fun * (1 - 1e-3)
    assert gain == pytest.approx(plain_gain(samples, angle / turn, start * STEP), rel=1e-9)


@pytest.mark.parametrize("seed", range(20))
def test_no_allowed_cycle_a_sample_away_gains_more(seed):
    # the climb stops at a kink where a sample enters or leaves; the probes about it, within 0.3 of the scanned
    # frequency and a quarter cycle of the scanned onset, must not gain
    samples, turn = np.random.default_rng(seed).standard_normal(400), 2 * math.pi * STEP
    angle, begin, *_ = refine(samples, 101, turn / 1.65, turn * 0.2, turn * 5, 0.3)
    gain, end, inside = plain_gain(samples, angle / turn, begin * STEP), begin + 2 * math.pi / angle, 0
    for size, early, late in itertools.product(PROBES, (-1, 0, 1), (-1, 0, 1)):
        start, length = begin + size * early, end - begin + size * (late - early)
        if abs(math.log(length * STEP / 1.65)) < 0.3 and abs(start - 101) < length / 4:
            inside += 1
            # a climb goes on for 1e-9 of the gain; as much again for rounding
            assert plain_gain(samples, 1 / (length * STEP), start * STEP) <= gain * (1 + 2e-9)
    assert inside >= 3


@pytest.mark.parametrize("period", [1.6, 1.65, 1.75, 1.8])
@pytest.mark.parametrize("start", [-0.2, 0.0, 0.2])
def test_a_climb_ends_only_where_newton_has_settled(period, start):
    # without noise a cycle has no kink at its own period and onset, and there the last step is below 1e-7
    phase = (np.arange(400) * STEP - 2.013) / 1.7
    samples = np.sin(2 * np.pi * phase) * ((phase > 0) & (phase < 1))
    u = math.log(2 * math.pi * STEP / period)
    found_u, found_v, _ = callable_parts(scan)._climbed(samples, 101, u, start, (u - 0.3, u + 0.3))
    assert math.exp(-found_u) * 2 * math.pi * STEP == pytest.approx(1.7, abs=1e-8)
    assert (101 + found_v / math.exp(found_u)) * STEP == pytest.approx(2.013, abs=1e-8)
