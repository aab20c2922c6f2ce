"""The cheapest answer: what is not integrated."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.constants import g

from rocking.assessment.assess import AssessmentSettings, Method, assess_structures
from rocking.assessment.fidelity import cheapest_answer, stays_at_rest
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block
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
    found = cheapest_answer(MECHANISM, record(0.99))
    assert (found.method, found.rotation_ratio, found.outcome) == (
        Method.NOTHING_TO_INTEGRATE,
        0.0,
        Outcome.NO_UPLIFT,
    )


def test_a_study_answers_with_the_cheapest():
    settings = AssessmentSettings(fidelity="auto")
    (case,) = assess_structures(record(1.5), {"block": BLOCK}, settings).cases
    assert len(case.responses) == 1
    (whole,) = assess_structures(record(1.5), {"block": BLOCK}, replace(settings, fidelity="full")).cases
    assert whole.answer.method is Method.MECHANISM_ON_RECORD
    assert case.answer.rotation_ratio == pytest.approx(whole.answer.rotation_ratio, rel=0.1)
