"""What cheap figures say of overturning: the shipped tiers, and how they are read."""

import math

import numpy as np
import pytest

from rocking.assessment import fidelity
from rocking.assessment.fidelity import NUDGES, Tier, read_tiers
from rocking.motion import integrate
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block

STEP = 0.01
MECHANISM = Block(2.0, 0.2).mechanism()
EQUIVALENT = MECHANISM.equivalent_block("rest")
PULSE = Pulse(3.0, 2 * np.pi / 0.8, 2.0)


def record(factor: float = 1.0) -> Accelerogram:
    return Accelerogram(factor * PULSE.acceleration(np.arange(1000) * STEP), STEP)


def measured(factor: float = 1.0) -> dict[str, float]:
    ratios = np.array([integrate(EQUIVALENT, record(factor * nudge)).rotation_ratio for nudge in NUDGES])
    return (
        fidelity.of_structure(MECHANISM)
        | fidelity.of_velocity(record(factor), EQUIVALENT)
        | fidelity.from_nudged(ratios)
    )


def test_the_peak_velocity_is_that_of_a_sine():
    """A sine cycle of amplitude a has the peak velocity 2a/ω."""
    severity = (
        EQUIVALENT.frequency_parameter
        * (2 * 3.0 / PULSE.circular_frequency)
        / (GRAVITY * EQUIVALENT.uplift_multiplier)
    )
    # trapezoids over 80 steps a period lose (π/80)²/3
    assert measured()["peak_velocity"] == pytest.approx(math.log(severity), abs=1e-3)


@pytest.mark.parametrize("tier", Tier)
def test_an_estimate_grows_with_the_motion_and_lies_in_its_interval(tier):
    estimates = [read_tiers()[tier].estimate(measured(factor)) for factor in (0.5, 1.0, 3.0)]
    assert all(each.low <= each.share <= each.high for each in estimates)
    assert estimates[0].share < estimates[1].share < estimates[2].share


@pytest.mark.parametrize("odd", [{"forcing_defect": 2.0}, {"frequency_parameter": 6.0}, {"restitution": 0.1}])
def test_nothing_is_said_of_a_structure_unlike_those_behind_it(odd):
    fit = read_tiers()[Tier.PEAK_VELOCITY]
    assert fit.estimate(measured()) is not None and fit.estimate(measured() | odd) is None
    assert fit.unlike(measured() | odd)


@pytest.mark.parametrize("share, beyond", [(0.04, False), (0.06, True)])
@pytest.mark.parametrize("name", ["restitution", "restoring_defect", "forcing_defect", "frequency_parameter"])
def test_a_structure_is_like_those_behind_it_within_a_twentieth_of_their_range(name, share, beyond):
    fit = read_tiers()[Tier.PEAK_VELOCITY]
    measures = {each: sum(ends) / 2 for each, ends in fit.ranges.items()}
    assert not fit.unlike(measures)
    least, largest = fit.ranges[name]
    for outside in (least - share * (largest - least), largest + share * (largest - least)):
        assert fit.unlike(measures | {name: outside}) is beyond


def test_a_block_that_stays_up_counts_as_turned_to_twice_its_critical_rotation_at_most():
    at, beyond = (fidelity.from_nudged(np.array([0.1, 0.2, each, 0.3, each])) for each in (2.0, 2.5))
    assert at == beyond and at["block"] == at["block_high"] == pytest.approx(math.log(2.0), rel=1e-12)
