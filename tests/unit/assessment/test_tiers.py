"""What cheap figures say of overturning: the shipped tiers, their words, and how they are read."""

import math

import numpy as np
import pytest

from rocking.assessment import intensity
from rocking.assessment.intensity import NUDGES, Shape
from rocking.assessment.tiers import (
    STRUCTURE,
    Tier,
    expect,
    shipped_tiers,
)
from rocking.assessment.tiers.expectation import band_in_words, probability_in_words
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Block

STEP = 0.01
BLOCK = Block(2.0, 0.2)
MECHANISM = BLOCK.mechanism()
EQUIVALENT = MECHANISM.equivalent_block("rest")
PULSE = Pulse(3.0, 2 * np.pi / 0.8, 2.0)


def record(factor: float = 1.0) -> Accelerogram:
    return Accelerogram(factor * PULSE.acceleration(np.arange(1000) * STEP), STEP)


def measured(factor: float = 1.0) -> dict[str, float]:
    shape = Shape.of(record(factor))
    ratios = np.array([integrate(EQUIVALENT, record(factor * nudge)).rotation_ratio for nudge in NUDGES])
    return (
        intensity.of_structure(MECHANISM)
        | intensity.of_peaks(shape, EQUIVALENT)
        | intensity.of_pulse(
            PULSE if factor == 1 else Pulse(factor * 3.0, PULSE.circular_frequency), EQUIVALENT
        )
        | intensity.of_sines(shape, EQUIVALENT)
        | intensity.of_pushes(shape, EQUIVALENT)
        | intensity.from_nudged(ratios)
    )


def test_the_peaks_are_those_of_a_sine():
    """A sine cycle of amplitude a has the peak velocity 2a/ω."""
    found = measured()
    uplift = GRAVITY * EQUIVALENT.uplift_multiplier
    velocity = 2 * 3.0 / PULSE.circular_frequency
    # trapezoids over 80 steps a period lose (π/80)²/3, the peak between samples nothing here
    assert found["peak_velocity"] == pytest.approx(
        math.log(EQUIVALENT.frequency_parameter * velocity / uplift), abs=1e-3
    )
    assert found["peak_acceleration"] == pytest.approx(math.log(3.0 / uplift), abs=1e-3)


def test_the_pulse_at_its_threshold_measures_zero():
    margin = math.exp(measured()["pulse"])
    for factor, overturns in ((0.999 / margin, False), (1.001 / margin, True)):
        pulse = Pulse(3.0 * factor, PULSE.circular_frequency)
        assert math.isinf(predict_maximum(EQUIVALENT, pulse).rotation_ratio) is overturns


def test_a_record_that_is_a_sine_matches_itself():
    """The most dangerous sine is at least as dangerous as the record's own, up to the steps of the periods (9 %)."""
    found = measured()
    assert found["sine"] > found["pulse"] - 0.1


def test_a_push_just_above_one_overturns_without_an_impact():
    """A constant push from rest: x'' = p² (x − 1 + a), so it overturns where ∫ p a e^(−pt) dt exceeds 1."""
    p, uplift = EQUIVALENT.frequency_parameter, GRAVITY * EQUIVALENT.uplift_multiplier
    step = 5e-4
    lasting = round(0.5 / (p * step)) * step
    for factor, overturns in ((0.99, False), (1.01, True)):
        level = factor * uplift / (1 - math.exp(-p * lasting))
        samples = np.zeros(20000)
        samples[1 : 1 + round(lasting / step)] = -level
        motion = Accelerogram(samples, step)
        found = intensity.of_pushes(Shape.of(motion), EQUIVALENT)["push"]
        # the ramps of one step at both ends: p · step = 1e-3
        assert found == pytest.approx(math.log(factor), abs=1e-3)
        assert math.isinf(integrate(EQUIVALENT, motion).rotation_ratio) is overturns


def test_a_scaled_motion_moves_the_measures_that_scale():
    """The oracle measures the scaled record itself."""
    known = {name: value for name, value in measured().items() if not name.startswith("block")}
    again = {name: value for name, value in measured(1.7).items() if not name.startswith("block")}
    assert intensity.scaled(known, 1.7) == pytest.approx(again, abs=1e-9)


@pytest.mark.parametrize("tier", Tier)
def test_a_probability_grows_with_the_motion_and_lies_in_its_interval(tier):
    found = [expect(tier, measured(factor)) for factor in (0.5, 1.0, 3.0)]
    assert all(each.probability_low <= each.probability <= each.probability_high for each in found)
    assert all(each.rotation_low <= each.rotation_median <= each.rotation_high for each in found)
    assert found[0].probability < found[1].probability < found[2].probability


def test_nothing_is_said_of_a_structure_unlike_those_behind_it():
    odd = measured() | {"forcing_defect": 2.0}
    assert expect(Tier.PEAK_VELOCITY, odd) is None
    assert set(STRUCTURE) < set(odd)


def test_every_tier_is_shipped_with_its_terms():
    assert list(shipped_tiers()) == list(Tier)
    for tier, fit in shipped_tiers().items():
        assert fit.coefficients.size == len(tier.terms) + 1
        assert np.linalg.eigvalsh(fit.covariance).min() > -1e-9
        assert np.all(np.diff(fit.edges) > 0)


@pytest.mark.parametrize(
    "numbers, words",
    [
        ((0.3, 0.18, 0.45), "overturns with 30 % (18–45)"),
        ((0.004, 0.001, 0.02), "overturns with less than 1 %"),
        ((0.999, 0.99, 1.0), "overturns with more than 99 %"),
    ],
)
def test_probabilities_in_words(numbers, words):
    assert probability_in_words(*numbers) == words


@pytest.mark.parametrize(
    "low, high, words",
    [
        (0.051, 0.39, "between 0.05 and 0.4 φ_cr"),
        (0.31, 0.33, "between 0.31 and 0.33 φ_cr"),
        (0.0, 0.39, "at most 0.4 φ_cr"),
        (0.21, math.inf, "at least 0.2 φ_cr, or overturns"),
        (0.0, math.inf, "anything from rest to overturning"),
        (math.inf, math.inf, "overturns"),
        (0.0, 0.0005, "at rest"),
    ],
)
def test_bands_in_words(low, high, words):
    assert band_in_words(low, high) == words
