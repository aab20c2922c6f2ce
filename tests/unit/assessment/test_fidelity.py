"""The cheapest answer: what is not integrated, and what cheap figures say of overturning."""

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import g

from rocking.assessment import fidelity
from rocking.assessment.fidelity import (
    TERMS,
    EstimateFit,
    cheapest_answer,
    estimated,
    read_fit,
    stays_at_rest,
)
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.methods import Method
from rocking.assessment.motions import Motion
from rocking.assessment.one_case import compute_case
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.motion.integration import integrate
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Block, EquivalentBlock, Facade, Outcome

STEP = 0.01
TIMES = np.arange(400) * STEP
BLOCK = Block(2.0, 0.2)
MECHANISM = BLOCK.mechanism()
EQUIVALENT = MECHANISM.equivalent_block("exact_at_rest")
PULSE = Pulse(amplitude=3.0, circular_frequency=2 * np.pi / 0.8, start_time=2.0)


def record(peak: float) -> Accelerogram:
    """A sine of 0.8 s that swells and fades; `peak` in units of λ g."""
    shape = np.sin(2 * np.pi * TIMES / 0.8) * np.sin(np.pi * TIMES / TIMES[-1]) ** 2
    return Accelerogram(shape / np.abs(shape).max() * peak * MECHANISM.uplift_multiplier * g, STEP)


@pytest.mark.parametrize("excess, rests", [(-1e-9, True), (1e-9, False)])
def test_rest_ends_at_the_uplift_acceleration(excess, rests):
    level = np.full(50, (1 + excess) * MECHANISM.uplift_multiplier * g)
    assert stays_at_rest(MECHANISM, Accelerogram(level, STEP)) is rests
    assert (integrate(MECHANISM, Accelerogram(level, STEP)).outcome is Outcome.NO_UPLIFT) is rests


def test_vertical_acceleration_can_end_the_rest():
    """0.9 λ g lifts where gravity is 0.8 g."""
    still = record(0.9)
    assert stays_at_rest(MECHANISM, still)
    assert not stays_at_rest(MECHANISM, still, Accelerogram(np.full(400, -0.2 * g), STEP))


def test_where_the_peak_velocity_says_that_it_stands_nothing_is_integrated():
    answer = cheapest_answer(MECHANISM, record(1.02))
    assert answer.method is Method.PEAK_VELOCITY and answer.response is None
    assert answer.outcome is Outcome.ROCKS
    assert np.isfinite(integrate(MECHANISM, record(1.02)).rotation_ratio)
    assert "1 %" in answer.reason


def test_what_it_does_not_settle_is_integrated():
    for motion, settings in (
        (record(4.0), {}),
        (record(40.0), {}),  # it overturns, which the peak velocity alone may not say
        (record(1.02), {"risk": 0.0}),
        (record(1.02), {"vertical": Accelerogram(np.zeros(400), STEP)}),
    ):
        answer = cheapest_answer(MECHANISM, motion, **settings)
        assert answer.method is Method.MECHANISM_ON_RECORD
        assert answer.response.rotation_ratio == integrate(MECHANISM, motion).rotation_ratio


def test_an_estimate_settles_up_to_the_risk():
    """The upper end of the estimate is the risk at which it begins to settle that the structure stands."""
    motion = record(1.1)
    high = estimated(MECHANISM, motion).high
    for risk, method in ((high, Method.PEAK_VELOCITY), (0.99 * high, Method.MECHANISM_ON_RECORD)):
        assert cheapest_answer(MECHANISM, motion, risk=risk).method is method


def test_a_block_unlike_its_mechanism_settles_nothing_and_gets_no_estimate():
    """A wall on stiff ties: no line is near its restoring force (theory: the equivalent block)."""
    tie = {"tie_heights": (3.4,), "tie_stiffness": 1e6}
    tied = Facade((3.5,), (0.6,), 20e3, **tie, behind="cross_walls", restitution=0.5)
    mechanism = tied.mechanism()
    assert mechanism.block_defects.restoring > 1
    strong = record(40.0 * mechanism.uplift_multiplier / MECHANISM.uplift_multiplier)
    answer = cheapest_answer(mechanism, strong)
    assert answer.method is Method.MECHANISM_ON_RECORD
    settings = AssessmentSettings(fidelity="auto", ensemble=EnsembleSettings(members=0))
    case = compute_case(CaseInputs(motion=Motion((strong,)), structure=tied, settings=settings))
    assert case.overturning_estimate is None


def pulse_record(factor: float) -> Accelerogram:
    return Accelerogram(factor * PULSE.acceleration(np.arange(1000) * STEP), STEP)


def measured(factor: float = 1.0) -> dict[str, float]:
    return fidelity.of_structure(MECHANISM) | fidelity.of_velocity(pulse_record(factor), EQUIVALENT)


def test_the_peak_velocity_is_that_of_a_sine():
    """A sine cycle of amplitude a has the peak velocity 2a/ω."""
    velocity = 2 * 3.0 / PULSE.circular_frequency
    severity = EQUIVALENT.frequency_parameter * velocity / (g * EQUIVALENT.uplift_multiplier)
    # trapezoids over 80 steps a period lose (π/80)²/3
    assert measured()["peak_velocity"] == pytest.approx(math.log(severity), abs=1e-3)


def test_an_estimate_grows_with_the_motion_and_lies_in_its_interval():
    estimates = [read_fit().estimate(measured(factor)) for factor in (0.5, 1.0, 3.0)]
    assert all(each.low <= each.share <= each.high for each in estimates)
    assert estimates[0].share < estimates[1].share < estimates[2].share


@pytest.mark.parametrize("odd", [{"forcing_defect": 2.0}, {"frequency_parameter": 6.0}, {"restitution": 0.1}])
def test_nothing_is_said_of_a_structure_unlike_those_behind_it(odd):
    fit = read_fit()
    assert fit.estimate(measured()) is not None and fit.estimate(measured() | odd) is None
    assert fit.unlike(measured() | odd)


@pytest.mark.parametrize("share, beyond", [(0.04, False), (0.06, True)])
@pytest.mark.parametrize("name", ["restitution", "restoring_defect", "forcing_defect", "frequency_parameter"])
def test_a_structure_is_like_those_behind_it_within_a_twentieth_of_their_range(name, share, beyond):
    fit = read_fit()
    measures = {each: sum(ends) / 2 for each, ends in fit.ranges.items()}
    assert not fit.unlike(measures)
    least, largest = fit.ranges[name]
    for outside in (least - share * (largest - least), largest + share * (largest - least)):
        assert fit.unlike(measures | {name: outside}) is beyond


def test_an_estimate_is_the_logistic_curve_with_its_ends_on_either_side():
    """By hand: log odds 0.4 + 1.5 (3 − 2)/0.5 = 3.4, of which the variance is 0.04 + 2 · 2 · 0.01 + 4 · 0.09 = 0.44."""
    terms = len(TERMS)
    centre, spread = np.full(terms, 2.0), np.full(terms, 0.5)
    slopes, covariance = np.zeros(terms + 1), np.zeros((terms + 1, terms + 1))
    slopes[:2] = 0.4, 1.5
    covariance[:2, :2] = [[0.04, 0.01], [0.01, 0.09]]
    fit = EstimateFit(centre, spread, slopes, covariance, {}, lapse=0.1)
    measures = dict.fromkeys(TERMS, 2.0) | {TERMS[0]: 3.0}
    found = fit.estimate(measures)
    reach = 1.6448536269514722 * math.sqrt(0.44)
    share, low, high = (1 / (1 + math.exp(-(3.4 + side * reach))) for side in (0, -1, 1))
    assert found.share == pytest.approx(0.9 * share, rel=1e-12)
    # The quantile of the normal distribution has five digits.
    assert (found.low, found.high) == pytest.approx((0.9 * low, high), rel=1e-5)
    outside = EstimateFit(centre, spread, slopes, covariance, {TERMS[0]: (1.0, 1.5)})
    assert outside.estimate(measures) is None


def test_the_velocity_counts_against_the_side_that_lifts_first():
    """Of unlike sides the weaker one: p PGV/(gλ) with the smaller λ, in whatever order they stand."""
    strong = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.2, acceleration_scale=0.5, restitution=0.9
    )
    weak = EquivalentBlock(
        frequency_parameter=2.0, critical_rotation=0.1, acceleration_scale=0.5, restitution=0.9
    )
    assert (strong.uplift_multiplier, weak.uplift_multiplier) == (0.4, 0.2)
    for block in (replace(strong, other_side=weak), replace(weak, other_side=strong)):
        assert fidelity.per_velocity(block) == pytest.approx(2.0 / (9.80665 * 0.2), rel=1e-12)
