"""The cheapest answer: what is not integrated."""

import re
from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import g

from rocking.assessment import intensity
from rocking.assessment.assess import AssessmentSettings, Method, assess_structures
from rocking.assessment.ensemble import EnsembleSettings, GroundMotions, ensemble
from rocking.assessment.fidelity import cheapest_answer, limits_of, stays_at_rest
from rocking.assessment.intensity import Shape
from rocking.assessment.rows.of_prediction import prediction_rows
from rocking.assessment.rows.shared import Identity
from rocking.assessment.tiers import Tier, expect
from rocking.assessment.verdict import Verdict
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block, Facade
from rocking.structures.outcome import Outcome

STEP = 0.01
TIMES = np.arange(400) * STEP
BLOCK = Block(2.0, 0.2)
MECHANISM = BLOCK.mechanism()


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


def test_nothing_is_integrated_below_uplift():
    found = cheapest_answer(MECHANISM, Shape.of(record(0.99)))
    assert (found.method, found.rotation_ratio, found.outcome) == (
        Method.NOTHING_TO_INTEGRATE,
        0.0,
        Outcome.NO_UPLIFT,
    )


@pytest.mark.parametrize("peak", [1.02, 40.0])
def test_what_the_peak_velocity_settles_is_not_integrated(peak):
    found = cheapest_answer(MECHANISM, Shape.of(record(peak)))
    assert found.method is Method.PEAK_VELOCITY and found.response is None
    assert min(found.expectation.probability_high, 1 - found.expectation.probability_low) <= 0.01
    assert np.isinf(found.rotation_ratio) == np.isinf(integrate(MECHANISM, record(peak)).rotation_ratio)
    assert "1 %" in found.reason


def test_what_it_does_not_settle_is_integrated():
    for shape, settings in (
        (Shape.of(record(4.0)), {}),
        (Shape.of(record(40.0)), {"risk": 0.0}),
        (Shape.of(record(40.0)), {"vertical": Accelerogram(np.zeros(400), STEP)}),
    ):
        found = cheapest_answer(MECHANISM, shape, **settings)
        assert found.method is Method.MECHANISM_ON_RECORD
        assert found.rotation_ratio == integrate(MECHANISM, shape.accelerogram).rotation_ratio


def test_limits_are_where_the_tier_says():
    limits, block = limits_of(MECHANISM, 0.01), MECHANISM.equivalent_block("rest")
    for severity, share in ((limits.stands, 0.01), (limits.overturns, 0.99)):
        measures = intensity.of_structure(MECHANISM) | {"peak_velocity": np.log(severity)}
        found = expect(Tier.PEAK_VELOCITY, measures)
        edge = found.probability_high if share < 0.5 else found.probability_low
        # a step of the grid is 0.5 % of the severity and changes the odds by a few per cent
        assert edge == pytest.approx(share, abs=5e-4)
    assert limits.per_velocity == intensity.per_velocity(block)


def test_a_looser_risk_settles_more():
    strict, loose = limits_of(MECHANISM, 0.001), limits_of(MECHANISM, 0.1)
    assert strict.stands < loose.stands < loose.overturns < strict.overturns


def test_of_a_structure_unlike_those_of_the_calibration_nothing_is_said():
    bouncing = Block(2.0, 0.2, restitution=0.1).mechanism()
    assert cheapest_answer(bouncing, Shape.of(record(40.0))).method is Method.MECHANISM_ON_RECORD


def test_where_an_ensemble_would_follow_the_block_may_settle_it():
    """A motion that the peak velocity leaves open, far below what overturns the block at any of the five scales."""
    shape = Shape.of(record(1.1))
    assert limits_of(MECHANISM, 0.01).settle(shape.peak_velocity) is None
    assert cheapest_answer(MECHANISM, shape).method is Method.MECHANISM_ON_RECORD
    found = cheapest_answer(MECHANISM, shape, ensemble_follows=True)
    assert found.method is Method.BLOCK_ON_RECORD and found.response is None
    assert found.expectation.probability_high <= 0.01
    sure = ensemble(MECHANISM, GroundMotions.of(shape.accelerogram))
    assert sure.verdict is Verdict.STANDS and np.isfinite(found.rotation_ratio)
    (case,) = assess_structures(
        shape.accelerogram, {"block": BLOCK}, AssessmentSettings(fidelity="auto")
    ).cases
    assert case.answer.method is Method.BLOCK_ON_RECORD and case.ensemble is None


def test_a_block_unlike_its_mechanism_settles_nothing_and_gets_no_probability():
    """A wall on stiff ties: no line is near its restoring force (theory: the equivalent block)."""
    tied = Facade(
        (3.5,), (0.6,), 20e3, tie_heights=(3.4,), tie_stiffness=1e6, one_sided=True, restitution=0.5
    )
    mechanism = tied.mechanism()
    assert mechanism.block_defects.restoring > 1
    motion = record(4.0)
    strong = motion.scaled(10 * mechanism.uplift_multiplier / MECHANISM.uplift_multiplier)
    found = cheapest_answer(mechanism, Shape.of(strong), ensemble_follows=True)
    assert found.method is Method.MECHANISM_ON_RECORD
    for fidelity in ("full", "auto"):
        settings = AssessmentSettings(fidelity=fidelity, ensemble=EnsembleSettings(members=16))
        (case,) = assess_structures(strong, {"tied": tied}, settings).cases
        assert case.expectation is None
        assert re.match(
            r"no probability: its restoring defect is \d+, beyond the 0.00064 to 0.072 of the calibration",
            case.unexpected,
        )
        rows = list(prediction_rows(Identity("r", strong, ""), case, "rest"))
        closed = next(row for row in rows if row.method is Method.CLOSED_FORM)
        assert closed.in_words == case.unexpected and np.isnan(closed.overturning_probability)


def test_a_study_answers_with_the_cheapest():
    settings = AssessmentSettings(fidelity="auto", ensemble=EnsembleSettings(members=0))
    (case,) = assess_structures(record(1.5), {"block": BLOCK}, settings).cases
    assert len(case.responses) == 1
    (whole,) = assess_structures(record(1.5), {"block": BLOCK}, replace(settings, fidelity="full")).cases
    assert whole.answer.method is Method.MECHANISM_ON_RECORD
    assert case.answer.rotation_ratio == pytest.approx(whole.answer.rotation_ratio, rel=0.1)
