"""The wavelet's coefficients against plain sums, and the search on means against one over every sample and scale."""

import numpy as np
import pytest
import pywt

from rocking.pulses.velocity_pulse import (
    coefficient_at,
    coefficients,
    largest_velocity_pulse,
    searched_scales,
    transform,
)
from rocking.records.accelerogram import Accelerogram


def plain(velocities, scale):
    """Σ v_k ψ((k − j)/s)/√s at every sample j, by one sum for each."""
    _, wavelet, places = pywt.Wavelet("db4").wavefun(level=10)
    half = int(3.5 * scale)
    offsets = np.arange(-half, half + 1)
    stretched = np.interp(offsets / scale + 3.5, places, wavelet) / np.sqrt(scale)
    padded = np.pad(velocities, half)
    return np.array([(padded[j : j + offsets.size] * stretched).sum() for j in range(velocities.size)])


@pytest.mark.parametrize("scale", [4, 17, 90])
@pytest.mark.parametrize("imaginary", [0.0, 1.0])
def test_the_transform_is_a_plain_sum_at_every_sample(scale, imaginary):
    rng = np.random.default_rng(scale)
    velocities = rng.standard_normal(400)
    if imaginary:
        velocities = velocities + 1j * rng.standard_normal(400)
    expected = plain(velocities, scale)
    assert transform(velocities, scale) == pytest.approx(expected, abs=1e-12)
    assert coefficients(velocities, scale, 150, 211) == pytest.approx(expected[150:211], abs=1e-12)
    if not imaginary:
        assert [coefficient_at(velocities, scale, j) for j in (0, 199, 399)] == pytest.approx(
            expected[[0, 199, 399]], abs=1e-12
        )


@pytest.mark.parametrize("seed", range(4))
def test_the_largest_coefficient_on_means_is_that_of_every_sample(seed):
    # a wavelet of T_p = 1.4 · 0.9 s in coloured noise; at 400 Hz the search averages over up to 66 samples
    step, rng = 0.0025, np.random.default_rng(seed)
    _, wavelet, places = pywt.Wavelet("db4").wavefun(level=10)
    times = np.arange(6000) * step
    middle = rng.uniform(5, 10)
    velocity = np.interp((times - middle) / 0.9 + 3.5, places, wavelet, left=0, right=0)
    velocity += 0.1 * np.convolve(rng.standard_normal(6000), np.ones(40) / 40, "same") * np.hanning(6000)
    velocity -= velocity[0]
    record = Accelerogram(np.gradient(velocity, step), step)
    found = np.concatenate(([0], np.cumsum((record.acceleration[1:] + record.acceleration[:-1]) / 2))) * step
    period, centre = largest_velocity_pulse(record)
    scales = searched_scales(step, found.size)
    sizes = np.array([np.abs(transform(found, int(scale))) for scale in scales])
    row, column = np.unravel_index(sizes.argmax(), sizes.shape)
    finer = range(scales[row - 1], scales[row + 1] + 1)
    best = max(finer, key=lambda scale: abs(coefficient_at(found, scale, column)))
    assert centre == pytest.approx(column * step)
    assert period == pytest.approx(1.4 * best * step)
