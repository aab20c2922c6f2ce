"""The pulse spectrum against the prediction, cell by cell."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking.errors import PulseError, StructureError
from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import Regime, predict_maximum, pulse_spectrum
from rocking.structures.mechanism import EquivalentBlock


@pytest.mark.parametrize("eta", [0.0, 0.6, 0.9])
def test_every_cell_is_the_prediction(eta: float) -> None:
    """λ = p = 1/g and amplitude = a exactly, so that both see the same a and ω; 1e-12 allows for another summation."""
    block = EquivalentBlock(1.0, 1.0, g, eta)
    assert block.uplift_multiplier * g == 1.0
    omegas, amplitudes = np.geomspace(0.05, 60, 61), np.concatenate([[0.0, 1.0], np.geomspace(1.001, 60, 57)])
    ratios, regimes = pulse_spectrum(omegas, amplitudes, eta), set()
    for i, omega in enumerate(omegas):
        for j, a in enumerate(amplitudes):
            found = predict_maximum(block, Pulse(a, omega))
            regimes.add(found.regime)
            assert ratios[i, j] == pytest.approx(found.rotation_ratio, rel=1e-12), (omega, a)
    assert len(regimes) >= 4
    assert Regime.CONTACT_DURING_PULSE in regimes


def test_safe_island_between_two_overturning_regions() -> None:
    """η = 0.9, ω = 5: falls from 3.02, stands again from 6.32 to 7.16, falls from 7.17."""
    amplitudes = np.array([3.01, 3.02, 6.31, 6.32, 7.16, 7.17])
    falls = np.isinf(pulse_spectrum(np.array([5.0]), amplitudes, 0.9)[0])
    assert falls.tolist() == [False, True, True, False, False, True]


def test_very_slow_and_very_fast_pulses_give_no_nan() -> None:
    ratios = pulse_spectrum(np.geomspace(1e-3, 1e6, 19), 1 + np.geomspace(1e-12, 1e6, 19), 0.7)
    assert not np.isnan(ratios).any()
    assert (ratios >= 0).all()


@pytest.mark.parametrize(
    ("frequencies", "amplitudes", "message"),
    [
        (
            [1.0, 0.0],
            [2.0],
            r"frequency_ratios holds 0\.0, but every value must lie between 1e-12 and 1e.12",
        ),
        ([1.0], [2.0, -1.0], r"amplitude_ratios holds -1\.0, but every value must lie between 0 and 1e.12"),
        ([1.0], [math.nan], "amplitude_ratios holds nan"),
        ([[1.0]], [1.0], r"frequency_ratios has the shape \(1, 1\)"),
        ([], [1.0], r"frequency_ratios has the shape \(0,\)"),
    ],
)
def test_bad_axes_are_refused_in_words(frequencies: list, amplitudes: list, message: str) -> None:
    with pytest.raises(PulseError, match=message):
        pulse_spectrum(np.array(frequencies), np.array(amplitudes), 0.9)


def test_bad_restitution_is_refused_in_words() -> None:
    with pytest.raises(StructureError, match=r"restitution is 1\.5"):
        pulse_spectrum(np.array([1.0]), np.array([2.0]), 1.5)
