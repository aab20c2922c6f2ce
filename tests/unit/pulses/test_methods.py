"""Pulse: the signal that stands for a record; the pulse methods: what each offers, and what is chosen of it."""

import math

import numpy as np
import pytest

from rocking.pulses import PULSE_METHODS, Pulse, extract_pulses, predicting_pulse
from rocking.pulses.velocity_pulse import largest_velocity_pulse
from rocking.signal.accelerogram import Accelerogram

TIMES = np.arange(3000) * 0.01
SHORT, LONG = (
    Pulse(amplitude=3, circular_frequency=2 * np.pi / 0.6, start_time=5),
    Pulse(amplitude=1, circular_frequency=2 * np.pi / 3, start_time=15),
)
ANALYSIS = extract_pulses(Accelerogram(SHORT.acceleration(TIMES) + LONG.acceleration(TIMES), 0.01))


def chosen(name, demand):
    return predicting_pulse(PULSE_METHODS[name].candidates(ANALYSIS), demand)


def test_by_energy_no_demand_is_asked():
    found = chosen("energy", lambda pulse: pytest.fail("asked"))
    assert found is ANALYSIS.evidence and found.pulse.period == pytest.approx(0.6, rel=1e-6)


def test_by_demand_the_pulse_of_largest_demand_is_chosen():
    found = chosen("demand", lambda p: abs(p.amplitude) * p.period**2)
    assert found.pulse.period == pytest.approx(3, rel=1e-6)


def test_of_equal_demands_the_better_ranked_is_chosen():
    assert chosen("demand", lambda pulse: 0.0) is ANALYSIS.evidence
    assert chosen("demand", lambda pulse: np.inf) is ANALYSIS.evidence


def test_by_velocity_the_sine_of_largest_velocity_is_found():
    # peak velocities 2 a/ω: 0.57 m/s of the short sine, 0.95 m/s of the long one, which carries less energy than it
    found = chosen("velocity", lambda pulse: pytest.fail("asked"))
    assert found.pulse.period == pytest.approx(3, rel=1e-6)
    assert found.pulse.amplitude == pytest.approx(1, rel=1e-6)
    assert found.gain == pytest.approx(LONG.amplitude**2 * LONG.period / 2, rel=1e-4)


@pytest.mark.parametrize(("shift", "amplitude"), [(0.6, -1.4), (-1.2, -1.4), (1.4, -1.5), (-2.0, 1.5)])
def test_by_velocity_no_sine_far_from_the_velocity_pulse_is_taken(shift, amplitude):
    """Beside a sine of more energy: T_g is T_p/1.93 within half an octave, T_p that of the largest wavelet."""
    samples = LONG.acceleration(TIMES) + Pulse(
        amplitude=amplitude, circular_frequency=2 * np.pi / 1.8, start_time=15 + shift
    ).acceleration(TIMES)
    record = Accelerogram(samples, 0.01)
    velocity_period, centre = largest_velocity_pulse(record)
    expected = velocity_period / 1.93
    # refined from the best of the octave's steps, which lie an eighth of an octave apart at most
    (sine,) = PULSE_METHODS["velocity"].candidates(extract_pulses(record))
    assert abs(math.log2(sine.pulse.period / expected)) <= 0.5 + 1 / 8
    # and begins within half a period, but for what the refinement moves it
    assert abs(sine.pulse.start_time - (centre - expected / 2)) <= 0.51 * expected


def test_one_cycle_and_nothing_outside():
    pulse = Pulse(amplitude=-2.0, circular_frequency=math.pi, start_time=1.0)
    times = np.array([0.99, 1.0, 1.5, 2.0, 2.5, 3.0, 3.01])
    assert pulse.acceleration(times) == pytest.approx([0, 0, -2, 0, 2, 0, 0], abs=1e-15)
    assert (pulse.period, pulse.end_time) == (2.0, 3.0)
