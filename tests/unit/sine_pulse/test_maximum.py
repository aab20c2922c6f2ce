"""The limits of the exact maximum under one sine pulse: no uplift, what cannot be followed, and what is refused."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking.errors import PulseError, StructureError
from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import (
    Maximum,
    Regime,
    kernel,
    overturning_amplitudes,
    predict_maxima,
    predict_maximum,
    pulse_end_energy,
    pulse_spectrum,
)
from rocking.structures import Outcome
from rocking.structures.mechanism import EquivalentBlock
from tests.refusals import ANY, refused

BLOCK = EquivalentBlock(
    frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=0.9
)


def pulse_on(block: EquivalentBlock, a: float, omega: float) -> Pulse:
    """The pulse of amplitude ratio a and frequency ratio ω."""
    return Pulse(
        amplitude=a * g * block.uplift_multiplier, circular_frequency=omega * block.frequency_parameter
    )


@pytest.mark.parametrize("a", [0.0, 0.5, 1.0, 1 - 1e-12])
def test_no_uplift_at_or_below_the_uplift_acceleration(a: float) -> None:
    maximum = predict_maximum(BLOCK, pulse_on(BLOCK, a, 3.0))
    assert maximum == Maximum(
        rotation_ratio=0.0,
        outcome=Outcome.NO_UPLIFT,
        regime=Regime.NO_UPLIFT,
        impacts=0,
        peak_side=0,
        overturning_margin=1.0,
    )


def test_a_restitution_too_close_to_one_for_a_slow_pulse_is_named_and_not_guessed() -> None:
    block = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=1.0
    )
    maximum = predict_maximum(block, pulse_on(block, 1.0000001, 1e-3))
    assert (maximum.outcome, maximum.regime) == (Outcome.FAILED, Regime.UNRESOLVED)
    assert math.isnan(maximum.rotation_ratio)
    assert f"{kernel.MOST_IMPACTS} impacts" in maximum.regime.sentence


@pytest.mark.parametrize("eta", [0.0, 1e-9, 0.9, 0.999])
def test_every_ratio_within_the_bounds_has_an_answer(eta: float) -> None:
    block = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=eta
    )
    for omega in (1e-11, 1e-6, 1e-3, 1.0, 1e3, 1e6, 1e11):
        for a in (1 + 3e-16, 1 + 1e-12, 1 + 1e-6, 1.3, 10.0, 1e6, 1e11):
            maximum = predict_maximum(block, pulse_on(block, a, omega))
            assert maximum.rotation_ratio >= 0, (a, omega)
            assert maximum.outcome is not Outcome.FAILED, (a, omega)


def spectrum(frequencies: list, amplitudes: list, restitution: float = 0.9) -> np.ndarray:
    return pulse_spectrum(np.array(frequencies), np.array(amplitudes), restitution)


@pytest.mark.parametrize(
    ("call", "field", "value"),
    [
        (
            lambda: predict_maximum(BLOCK, Pulse(amplitude=10.0, circular_frequency=1e15)),
            "frequency_ratio",
            1e15 / BLOCK.frequency_parameter,
        ),
        (
            lambda: predict_maximum(BLOCK, Pulse(amplitude=1e200, circular_frequency=1.0)),
            "amplitude_ratio",
            ANY,
        ),
        (
            lambda: predict_maxima([BLOCK], [Pulse(amplitude=1.0, circular_frequency=1e14)]),
            "frequency_ratio",
            ANY,
        ),
        (
            lambda: predict_maxima([BLOCK], [Pulse(amplitude=1e15, circular_frequency=1.0)]),
            "amplitude_ratio",
            ANY,
        ),
        (lambda: overturning_amplitudes([BLOCK], [1.0], 2), "polarity", 2),
        (lambda: overturning_amplitudes([BLOCK], [0.0]), "circular_frequencies", [0.0]),
        (lambda: spectrum([1.0, 0.0], [2.0]), "frequency_ratios", 0.0),
        (lambda: spectrum([1.0], [2.0, -1.0]), "amplitude_ratios", -1.0),
        (lambda: spectrum([[1.0]], [1.0]), "frequency_ratios", [[1.0]]),
        (lambda: pulse_end_energy(frequency_ratio=0.0, amplitude_ratio=2.0), "frequency_ratio", 0.0),
        (
            lambda: pulse_end_energy(frequency_ratio=math.nan, amplitude_ratio=2.0),
            "frequency_ratio",
            math.nan,
        ),
        (lambda: pulse_end_energy(frequency_ratio="1", amplitude_ratio=2.0), "frequency_ratio", "1"),
        (lambda: pulse_end_energy(frequency_ratio=1.0, amplitude_ratio=1.0), "amplitude_ratio", 1.0),
        (
            lambda: pulse_end_energy(frequency_ratio=1.0, amplitude_ratio=math.inf),
            "amplitude_ratio",
            math.inf,
        ),
    ],
)
def test_what_no_structure_has_is_refused(call, field: str, value: object) -> None:
    with refused((PulseError, StructureError), field, value):
        call()
