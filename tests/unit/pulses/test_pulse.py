"""Pulse: the signal that stands for a record."""

import math

import numpy as np
import pytest

from rocking.errors import PulseError
from rocking.pulses import Pulse


def test_one_cycle_and_nothing_outside():
    pulse = Pulse(-2.0, math.pi, 1.0)
    times = np.array([0.99, 1.0, 1.5, 2.0, 2.5, 3.0, 3.01])
    assert pulse.acceleration(times) == pytest.approx([0, 0, -2, 0, 2, 0, 0], abs=1e-15)
    assert (pulse.period, pulse.end_time) == (2.0, 3.0)


def test_velocity_returns_to_zero_and_the_half_cycle_carries_all_of_it():
    pulse = Pulse(3.0, 2 * math.pi / 0.8, 0.1)
    times = np.linspace(0, 1, 100_001)
    velocity = np.cumsum(pulse.acceleration(times)) * (times[1] - times[0])
    assert velocity[-1] == pytest.approx(0, abs=1e-6)
    # ∫ over half a cycle of a sine: a T / π; the rectangle rule errs by about (ω dt)²
    assert velocity.max() == pytest.approx(3.0 * 0.8 / math.pi, rel=1e-6)


@pytest.mark.parametrize(
    ("values", "words"),
    [((math.nan, 1, 0), "amplitude"), ((1, 0, 0), "circular_frequency"), ((1, 1, math.inf), "start_time")],
)
def test_impossible_pulses_are_refused(values, words):
    with pytest.raises(PulseError, match=words):
        Pulse(*values)
