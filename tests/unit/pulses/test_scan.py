"""The compiled scan against plain sums and a plain neighbour search."""

import math

import numpy as np
import pytest
from scipy import ndimage

from rocking.pulses.scan import energy_gains, envelope_phase, local_maxima

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


def test_the_map_is_the_plain_sum_at_every_onset(samples):
    frequencies = np.array([0.3, 0.71, 2.0, 4.9])
    gains = energy_gains(samples[np.newaxis], STEP, 2 * np.pi * STEP * frequencies)
    for i, frequency in enumerate(frequencies):
        last = 300 - 1 - math.ceil(1 / frequency / STEP - 1e-9)  # the whole cycle lies in the record
        expected = [plain_gain(samples, STEP, frequency, j * STEP) for j in range(last + 1)]
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
