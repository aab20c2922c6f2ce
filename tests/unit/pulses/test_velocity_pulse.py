"""The velocity pulse: planted wavelets, the published indicator, and its distance from the acceleration pulse."""

import math

import numpy as np
import pytest
import pywt

from rocking.errors import PulseError, RecordError
from rocking.pulses import Pulse, velocity_pulse
from rocking.pulses.velocity_pulse import (
    _SCALING_FILTER,
    _late,
    _table,
    coefficient_at,
    coefficients,
    largest_velocity_pulse,
    pulse_indicator,
    searched_scales,
    transform,
)
from rocking.signal.accelerogram import Accelerogram
from tests.refusals import refused

STEP = 0.005
TIMES = np.arange(8000) * STEP
_, WAVELET, PLACES = pywt.Wavelet("db4").wavefun(level=10)


def test_the_wavelet_is_db4():
    """Its filter is orthonormal with four vanishing moments, and the values are those of pywavelets."""
    places, values = _table()
    assert np.array_equal(places, PLACES) and values == pytest.approx(WAVELET, abs=1e-14)
    products = [float(_SCALING_FILTER[2 * shift :] @ _SCALING_FILTER[: 8 - 2 * shift]) for shift in range(4)]
    assert products == pytest.approx([1, 0, 0, 0], abs=1e-15)
    moments = [
        float((-1.0) ** np.arange(8) * np.arange(8.0) ** power @ _SCALING_FILTER) for power in range(4)
    ]
    assert moments == pytest.approx([0, 0, 0, 0], abs=1e-13)  # of terms up to 343


def from_velocity(velocity):
    return Accelerogram(np.gradient(velocity, STEP), STEP)


@pytest.mark.parametrize("scale", [0.7, 1.6, 3.1])
@pytest.mark.parametrize("angle", [-1.0, 0.0, 0.3, 1.4, math.pi / 2])
def test_a_planted_wavelet_is_found(scale, angle):
    velocity = np.interp((TIMES - 20) / scale + 3.5, PLACES, WAVELET, left=0, right=0)
    shares = round(math.cos(angle), 12), math.sin(angle)  # along the second component the first is still
    components = (from_velocity(share * velocity) for share in shares)
    found = velocity_pulse(*components)
    # T_p = 1.4 scale; the scale is refined at the place of the coarse one, which holds it to a few per cent
    assert found.period == pytest.approx(1.4 * scale, rel=0.03)
    assert found.orientation == pytest.approx(angle, abs=1e-3)
    assert found.indicator > pulse_indicator(
        peak_ratio=0.1, energy_ratio=0.1, peak_velocity=found.peak_velocity
    )  # a tenth of peak and energy left
    assert found.pulse_like


@pytest.mark.parametrize("delay", [2.5, 7.0])
def test_the_centre_is_a_time_that_moves_with_the_motion(delay):
    """In seconds: within the wavelet where it was planted, and later by as much as the motion is."""
    first, second = (
        velocity_pulse(from_velocity(np.interp((TIMES - at) / 1.6 + 3.5, PLACES, WAVELET, left=0, right=0)))
        for at in (20.0, 20.0 + delay)
    )
    assert abs(first.centre_time - 20.0) < first.period
    assert second.centre_time - first.centre_time == pytest.approx(delay, abs=STEP)


@pytest.mark.parametrize("amplitude", [1.0, 2.0])
def test_what_the_pulse_leaves_counts_as_a_share_of_the_peak(amplitude):
    """Beside the wavelet stands a second one of 0.3 of its size: that is left, and 0.3² of 1.09 of the energy."""
    first, second = (
        np.interp((TIMES - begin) / 1.6 + 3.5, PLACES, WAVELET, left=0, right=0) for begin in (15, 30)
    )
    velocity = amplitude * (first + 0.3 * second)
    found = velocity_pulse(from_velocity(velocity), from_velocity(0 * velocity))
    expected = pulse_indicator(peak_ratio=0.3, energy_ratio=0.09 / 1.09, peak_velocity=found.peak_velocity)
    # the period found is the planted one to 0.7 %, which leaves a little of the first wavelet too
    assert found.indicator == pytest.approx(expected, rel=1e-3)


def test_the_period_is_not_that_of_the_acceleration_pulse():
    motion = Pulse(amplitude=3.0, circular_frequency=math.pi, start_time=10.0).acceleration(TIMES)
    found = velocity_pulse(Accelerogram(motion, STEP), Accelerogram(0 * motion, STEP))
    assert found == velocity_pulse(Accelerogram(motion, STEP))
    # T_p / T_g of a pure sine, computed with the same two methods by other code: 1.93
    assert found.period / 2.0 == pytest.approx(1.93, rel=0.01)
    assert not found.is_unlike(Pulse(amplitude=3.0, circular_frequency=math.pi, start_time=10.0))
    assert all(
        found.is_unlike(Pulse(amplitude=3.0, circular_frequency=factor * math.pi, start_time=10.0))
        for factor in (1.1, 0.12)
    )


@pytest.mark.parametrize("component", [0.2, 0.5, 0.8, 1.0])
@pytest.mark.parametrize("peak", [0.2, 0.5, 1.0, 1.5])
def test_the_indicator_is_the_printed_one(component, peak):
    # Shahi & Baker (2014), printed with rounded coefficients in cm/s:
    # PI = 9.384 (0.76 − PC − 0.0616 PGV)(PC + 6.914e-4 PGV − 1.072) − 6.179
    v = 100 * peak
    printed = 9.384 * (0.76 - component - 0.0616 * v) * (component + 6.914e-4 * v - 1.072) - 6.179
    # 0.0616 and 6.914e-4 carry three and four digits: PI moves by up to 0.8 % of PGV in m/s
    assert pulse_indicator(
        peak_ratio=component / 0.63, energy_ratio=0.0, peak_velocity=peak
    ) == pytest.approx(printed, abs=0.008 * v)


def test_what_cannot_hold_a_velocity_pulse_is_refused():
    zero = np.zeros(3000)
    cases = (
        (zero, "acceleration", 0.0),
        (np.ones(2_000_001), "samples", 2_000_001),
        (np.ones(100), "samples", 100),
    )
    for samples, field, value in cases:
        with refused(PulseError, field, value):
            velocity_pulse(Accelerogram(samples, STEP), Accelerogram(samples, STEP))
    with refused(RecordError, "time_step", (0.005, 0.01)):
        velocity_pulse(Accelerogram(zero, STEP), Accelerogram(zero, 2 * STEP))


@pytest.mark.parametrize(("share", "late"), [(0.11, False), (0.14, True)])
@pytest.mark.parametrize("unit", [1.0, 100.0])
def test_a_pulse_is_late_by_the_energy_that_went_before(share, late, unit):
    # with `share` of the energy in a ripple before it, the record has spent share + 5 % of the rest when the pulse
    # has spent 5 %: 17 % at share = 0.126, in m/s as in cm/s
    pulse = np.sin(2 * np.pi * TIMES / 2) * (np.abs(TIMES - 21) < 1)
    ripple = np.sin(2 * np.pi * TIMES / 0.2) * (np.abs(TIMES - 10) < 1)
    ripple *= math.sqrt(share / (1 - share) * (pulse @ pulse) / (ripple @ ripple))
    assert _late(unit * (ripple + pulse), unit * pulse) is late


def plain(velocities, scale):
    """Σ v_k ψ((k − j)/s)/√s at every sample j, by one sum for each."""
    half = int(3.5 * scale)
    offsets = np.arange(-half, half + 1)
    stretched = np.interp(offsets / scale + 3.5, PLACES, WAVELET) / np.sqrt(scale)
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
        for j in (0, 199, 399):
            assert coefficient_at(velocities, scale, j) == pytest.approx(expected[j], abs=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_the_largest_coefficient_on_means_is_that_of_every_sample(seed):
    # a wavelet of T_p = 1.4 · 0.9 s in coloured noise; at 400 Hz the search averages over up to 66 samples
    step, rng = 0.0025, np.random.default_rng(seed)
    times = np.arange(6000) * step
    middle = rng.uniform(5, 10)
    velocity = np.interp((times - middle) / 0.9 + 3.5, PLACES, WAVELET, left=0, right=0)
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


def test_a_record_as_long_as_the_shortest_pulse_is_searched():
    """At 50 Hz a wavelet of T_p = 0.25 s is 8 samples a scale, of which its support of 7 scales takes 56."""
    assert searched_scales(0.02, 56)[0] == 8
    with refused(PulseError, "samples", 55):
        searched_scales(0.02, 55)
