"""What rests is not followed with fidelity: quick: where the ground never reaches the uplift acceleration."""

import numpy as np
import pytest
from scipy.constants import g

from rocking.assessment.inputs import CaseInputs
from rocking.assessment.methods import Method
from rocking.assessment.motions import Motion
from rocking.assessment.one_case import compute_case, stays_at_rest
from rocking.assessment.settings import AssessmentSettings
from rocking.errors import ConfigurationError
from rocking.motion.integration import integrate
from rocking.records import Accelerogram
from rocking.structures import Block, Outcome

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


def test_a_level_compares_the_methods_or_follows_the_mechanism_alone_and_nothing_that_rests():
    """Both levels agree on the rotation of the mechanism; with quick members of what rests are not followed."""
    for factor, rests in ((0.9, True), (4.0, False)):
        quick, standard = (
            compute_case(
                CaseInputs(
                    motion=Motion((record(factor),)),
                    structure=BLOCK,
                    settings=AssessmentSettings(fidelity=level),
                )
            )
            for level in ("quick", "standard")
        )
        assert set(quick.responses) == {Method.MECHANISM_ON_RECORD} < set(standard.responses)
        assert quick.integrated_rotation_ratio == standard.integrated_rotation_ratio
        assert (quick.ensembles is None) is rests and standard.ensembles is not None


@pytest.mark.parametrize(("former", "level"), [("full", "standard"), ("auto", "quick")])
def test_a_former_level_is_answered_with_the_one_to_type(former, level):
    sentence = f"fidelity is '{former}', but must be quick or standard or contact; write {level}."
    with pytest.raises(ConfigurationError) as refusal:
        AssessmentSettings(fidelity=former)
    assert str(refusal.value) == sentence
