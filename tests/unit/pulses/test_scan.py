"""The compiled scan against plain sums, a plain neighbour search and a general optimiser."""

import math

import numpy as np
import pytest
from scipy import optimize

from rocking.pulses.scan import energy_gains, local_maxima, refine

STEP = 0.02


def plain_gain(samples, step, frequency, start):
    """⟨a, s⟩²/⟨s, s⟩ by one sum over all samples."""
    times = np.arange(samples.size) * step
    phase = (times - start) * frequency
    sine = np.sin(2 * np.pi * phase) * ((phase >= 0) & (phase <= 1))
    return (samples @ sine) ** 2 / (sine @ sine) * step


@pytest.fixture
def samples():
    return np.random.default_rng(7).standard_normal(300)


@pytest.mark.parametrize(
    "energy_gains", [energy_gains, energy_gains.py_func], ids=["compiled", "interpreted"]
)
def test_the_map_is_the_plain_sum_at_every_onset(samples, energy_gains):
    frequencies = np.array([0.3, 0.71, 2.0, 4.9])
    gains = np.full((300, 4), np.nan)
    energy_gains(samples, STEP, 2 * np.pi * STEP * frequencies, 0, 300, gains)
    for i, frequency in enumerate(frequencies):
        last = 300 - 1 - math.floor(1 / frequency / STEP + 1e-9)
        expected = [plain_gain(samples, STEP, frequency, j * STEP) for j in range(last + 1)]
        # the recurrence adds one rounding a sample: 300 · 2e-16 of the largest gain
        assert gains[: last + 1, i] == pytest.approx(expected, abs=1e-12 * max(expected))
        assert np.all(gains[last + 1 :, i] == 0)


def test_a_part_of_the_map_is_renewed_alone(samples):
    angles = 2 * np.pi * STEP * np.geomspace(0.3, 4.9, 9)
    whole, part = np.zeros((300, 9)), np.full((300, 9), -1.0)
    energy_gains(samples, STEP, angles, 0, 300, whole)
    energy_gains(samples, STEP, angles, 40, 90, part)
    assert part[40:90] == pytest.approx(whole[40:90], rel=1e-9, abs=1e-12)
    assert np.all(part[:40] == -1) and np.all(part[90:] == -1)


@pytest.mark.parametrize(
    "local_maxima", [local_maxima, local_maxima.py_func], ids=["compiled", "interpreted"]
)
def test_maxima_are_those_of_a_plain_neighbour_search(local_maxima):
    gains = np.random.default_rng(3).random((40, 12))
    padded = np.pad(gains, 1, constant_values=-1)
    highest = np.max(
        [padded[1 + j : 41 + j, 1 + i : 13 + i] for j in (-1, 0, 1) for i in (-1, 0, 1) if (j, i) != (0, 0)],
        axis=0,
    )
    expected = np.argwhere((gains > highest) & (gains > 0.4))
    assert np.array_equal(local_maxima(gains, 0.4), expected)


def test_equal_neighbours_give_one_maximum():
    gains = np.zeros((6, 6))
    gains[2, 2] = gains[2, 3] = gains[3, 2] = 1.0
    assert len(local_maxima(gains, 0.0)) == 1
    assert len(local_maxima(np.zeros((6, 6)), 0.0)) == 0


@pytest.mark.parametrize("seed", range(8))
def test_refinement_reaches_the_maximum_of_a_general_optimiser(seed):
    rng = np.random.default_rng(seed)
    times = np.arange(400) * STEP
    phase = (times - 2.013) / 1.7
    samples = np.sin(2 * np.pi * phase) * ((phase > 0) & (phase < 1)) + 0.3 * rng.standard_normal(400)
    turn = 2 * math.pi * STEP
    angle, start, sine, norm = refine(samples, 101, turn / 1.65, turn * 0.2, turn * 5, 0.1)
    found = optimize.differential_evolution(
        lambda x: -plain_gain(samples, STEP, x[0], x[1]),
        [(0.55, 0.66), (1.8, 2.2)],
        seed=seed,
        tol=1e-12,
        popsize=20,
    )
    # the landscape has a kink at every sample; what the climb may miss is less than a thousandth of the gain
    assert sine**2 / norm * STEP >= -found.fun * (1 - 1e-3)
    assert sine**2 / norm * STEP == pytest.approx(
        plain_gain(samples, STEP, angle / turn, start * STEP), rel=1e-9
    )


def test_refinement_stays_within_its_limits(samples):
    turn = 2 * math.pi * STEP
    for onset in (0, 100, 240):
        angle, start, *_ = refine(samples, onset, turn * 1.0, turn * 0.98, turn * 1.02, 0.5)
        assert turn * 0.98 * (1 - 1e-12) <= angle <= turn * 1.02 * (1 + 1e-12)
        assert start >= -1e-9 and start + 2 * math.pi / angle <= 299 + 1e-9
        assert abs(start - onset) <= math.pi / 2 / angle * (1 + 1e-9)
