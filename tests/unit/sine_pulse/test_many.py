"""Many blocks and pulses at a call: each as one at a time, and the amplitudes that overturn."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import g

from rocking.pulses.pulse import Pulse
from rocking.sine_pulse import (
    Regime,
    overturning_amplitudes,
    overturning_margins,
    predict_maxima,
    predict_maximum,
    pulse_spectrum,
)
from rocking.structures import Arch, Block, EquivalentBlock, Mechanism, Outcome, Wall

WALL, OTHER = Wall(1.5, 1.5, 0.4).mechanism(), Wall(1.0, 2.0, 0.3).mechanism()
KINDS = {
    "symmetric": EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.25, acceleration_scale=0.8, restitution=0.9
    ),
    "two sides": EquivalentBlock(
        frequency_parameter=1.7,
        critical_rotation=0.30,
        acceleration_scale=0.9,
        restitution=0.85,
        other_side=EquivalentBlock(
            frequency_parameter=2.4, critical_rotation=0.18, acceleration_scale=0.7, restitution=0.95
        ),
    ),
    "one side": EquivalentBlock(
        frequency_parameter=2.2,
        critical_rotation=0.2,
        acceleration_scale=1.1,
        restitution=0.7,
        one_sided=True,
    ),
    "arch": Arch(10.0, 1.5, math.radians(157.5), restitution=0.9).mechanism().equivalent_block(),
    "two unlike walls": Mechanism(WALL.positive, OTHER.positive).equivalent_block(),
    "facade": Block(3.0, 0.1, restitution=0.5, one_sided=True).mechanism().equivalent_block(),
}


def test_many_equal_one_at_a_time() -> None:
    blocks = list(KINDS.values())
    sizes = (1.0, 2.5, 4.0, 9.0, 30.0)
    pulses = [
        Pulse(amplitude=sign * a, circular_frequency=omega)
        for sign in (1, -1)
        for a in sizes
        for omega in (3.0, 8.0, 20.0)
    ]
    ratios, margins = predict_maxima(blocks, pulses), overturning_margins(blocks, pulses)
    assert ratios.shape == margins.shape == (len(blocks), len(pulses))
    for i, block in enumerate(blocks):
        for j, pulse in enumerate(pulses):
            alone = predict_maximum(block, pulse)
            assert ratios[i, j] == pytest.approx(alone.rotation_ratio, rel=1e-13)
            assert margins[i, j] == pytest.approx(alone.overturning_margin, rel=1e-12)
            assert (margins[i, j] < 0) == (alone.outcome is Outcome.OVERTURNS)
    assert np.isinf(ratios).any() and (ratios == 0).any() and ((ratios > 0) & (ratios < 1)).any()


@pytest.mark.parametrize("polarity", [1, -1])
def test_amplitudes_that_overturn(polarity: int) -> None:
    """Just below, the block stands; just above, it does not. A façade needs the half that pushes it off its wall."""
    frequencies = np.array([1.0, 6.0, 15.0])
    amplitudes = overturning_amplitudes(list(KINDS.values()), frequencies, polarity)
    for block, row in zip(KINDS.values(), amplitudes, strict=True):
        for frequency, amplitude in zip(frequencies, row, strict=True):
            for factor, outcome in ((1 - 1e-8, Outcome.ROCKS), (1 + 1e-8, Outcome.OVERTURNS)):
                pulse = Pulse(amplitude=polarity * amplitude * factor, circular_frequency=float(frequency))
                assert predict_maximum(block, pulse).outcome is outcome


@pytest.mark.parametrize("eta", [0.0, 0.6, 0.9])
def test_every_cell_is_the_prediction(eta: float) -> None:
    """λ = p = 1/g and amplitude = a exactly, so that both see the same a and ω; 1e-12 allows for another summation."""
    block = EquivalentBlock(
        frequency_parameter=1.0, critical_rotation=1.0, acceleration_scale=g, restitution=eta
    )
    assert block.uplift_multiplier * g == 1.0
    omegas, amplitudes = np.geomspace(0.05, 60, 61), np.concatenate([[0.0, 1.0], np.geomspace(1.001, 60, 57)])
    ratios, regimes = pulse_spectrum(omegas, amplitudes, eta), set()
    for i, omega in enumerate(omegas):
        for j, a in enumerate(amplitudes):
            found = predict_maximum(block, Pulse(amplitude=a, circular_frequency=omega))
            regimes.add(found.regime)
            assert ratios[i, j] == pytest.approx(found.rotation_ratio, rel=1e-12), (omega, a)
    assert len(regimes) >= 4
    assert Regime.CONTACT_DURING_PULSE in regimes


@pytest.mark.parametrize("polarity", [1, -1])
def test_a_long_pulse_overturns_at_the_acceleration_that_lifts(polarity: int) -> None:
    """Its limit for ω → 0, where the ground stands still on the scale of the block; ω/p is 0.005 and enters squared."""
    weak, strong = (
        EquivalentBlock(
            frequency_parameter=20.0, critical_rotation=0.02, acceleration_scale=coefficient, restitution=0.9
        )
        for coefficient in (0.4, 0.05)
    )
    assert weak.uplift_multiplier == pytest.approx(0.05)  # 0.5 m/s², below every other figure of the block
    pairs = replace(weak, other_side=strong), replace(strong, other_side=weak)
    for block in (weak, strong, replace(weak, one_sided=True), *pairs):
        ((amplitude,),) = overturning_amplitudes([block], [0.1], polarity)
        least = min(side.uplift_multiplier for side in (block, block.other_side) if side)
        assert amplitude == pytest.approx(least * g, rel=1e-4)
