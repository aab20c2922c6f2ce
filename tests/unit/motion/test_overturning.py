"""Where structures overturn: published or closed-form thresholds, and what overturning is not."""

import numpy as np
import pytest
from motion_cases import bisected, noise
from oracle import Oracle
from scipy.constants import g

from rocking.motion import integrate
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Block, EquivalentBlock, Outcome


def overturns(structure, motion, tolerance=1e-10):
    return integrate(structure, motion, tolerance).outcome is Outcome.OVERTURNS


UNIT = EquivalentBlock(
    frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=1.0, restitution=0.9
)


STANDING = Block(3 * g / 16, 0.2, restitution=0.9).mechanism()
"""The block of the same p and slenderness."""


def cosine(strength):
    times = np.linspace(0, 2, 40_001)
    return Accelerogram(strength * g * np.cos(np.pi * times), times[1])


def test_cosine_pulse_on_the_nonlinear_block():
    """p = 2, α = 15°, Housner's η, from rest: stands at 0.315 g, overturns at 0.316 g, bisected 0.315034018 g."""
    mechanism = Block(3 * g / 16, np.deg2rad(15)).mechanism()
    assert mechanism.positive.frequency_parameter == pytest.approx(2.0, rel=1e-12)
    assert not overturns(mechanism, cosine(0.315))
    assert overturns(mechanism, cosine(0.316))
    # The samples' straight lines weaken the cosine by up to (π Δt)²/8 = 3e-9.
    found = bisected(0.315, 0.316, lambda a: overturns(mechanism, cosine(a)))
    assert found == pytest.approx(0.315034018, abs=3e-9)


@pytest.mark.parametrize("structure", [UNIT, STANDING], ids=["linear", "block"])
def test_beyond_the_critical_rotation_is_not_overturning(structure):
    """A later push in the right direction brings it back: the peak exceeds φ_cr and the structure stands."""
    ratios = [
        integrate(
            structure, Pulse(amplitude=a * g * structure.uplift_multiplier, circular_frequency=10.0), 1e-9
        ).rotation_ratio
        for a in np.linspace(1.5, 7.5, 601)
    ]
    assert any(1 < ratio < np.inf for ratio in ratios)


def test_early_proof_agrees_with_an_oracle_that_follows_to_the_end():
    """From the proof on, the record is replaced by the worst it could do: its largest acceleration still to come,
    pushing back without pause. The oracle knows no proof and waits for the end of the mechanism."""
    found = 0
    for seed in range(24):
        record = noise(seed, 100, 0.02, 3 * g * STANDING.uplift_multiplier, 15)
        history = integrate(STANDING, record, 1e-9, history=True)
        proved = int(np.ceil(history.times[-1] / 0.02 - 1e-9))
        if history.outcome is not Outcome.OVERTURNS or proved >= 98:
            continue
        samples = record.acceleration.copy()
        samples[proved + 1 :] = history.peak_side * np.abs(samples[proved:]).max()
        ratio, _ = Oracle(STANDING).run(samples, 0.02, after=3.0)
        assert ratio == np.inf
        found += 1
    assert found >= 3


@pytest.mark.parametrize("speed", [-0.02, 0.02])
@pytest.mark.parametrize("share, returns", [(0.97, True), (1.03, False)])
def test_the_proof_on_the_linear_block_begins_where_the_record_can_take_no_more(speed, share, returns):
    """Pushed from beyond φ_cr, with a turn in the first sample or without: u = x − 1 + x'/p grows as u' = p (u − push).

    The push rises from 0 to c within the second sample and stays for long: it can take as much from u at the first
    sample as ∫ p push e^(−pt) dt, all of which c makes the given share of u.
    """
    p, span, step, count = UNIT.frequency_parameter, UNIT.critical_rotation, 0.05, 400
    x, w = 1.3, speed  # over φ_cr, and of p φ_cr
    u = (x - 1 + w) * np.exp(p * step)
    assert speed > 0 or (x - 1) * np.sinh(p * step) + w * np.cosh(p * step) > 0, "it turns in time"
    samples = np.ones(count)
    samples[:2] = 0.0
    times = np.linspace(0, (count - 2) * step, (count - 2) * 2000 + 1)
    can_take = np.trapezoid(p * np.minimum(times / step, 1) * np.exp(-p * times), times)
    c = u / (share * can_take) * g * UNIT.uplift_multiplier
    record = Accelerogram(c * samples, step)
    found = integrate(UNIT, record, initial_rotation=x * span, initial_velocity=w * p * span)
    assert (found.impacts > 0) is returns
    assert returns or found.outcome is Outcome.OVERTURNS
