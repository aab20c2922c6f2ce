"""Single runs: without an ensemble the mechanisms of statics are followed beside the one described."""

import math

import numpy as np

import rocking
from rocking.assessment.assessor import Assessor
from rocking.assessment.scene import on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings
from rocking.structures import Facade

ONE_RUN = AssessmentSettings(ensemble=EnsembleSettings(members=0))
TIED = Facade(
    (3.2, 3.2), (0.4, 0.4), 19e3, floor_loads=(1e4, 1e4), behind="cross_walls", restitution=0.7, tie_heights=(6.4,),
    tie_stiffness=2e7, crack_storey=1, crack="known",
)  # fmt: skip


def sine(amplitude):
    times = np.arange(0.0, 3.0, 0.005)
    return rocking.Accelerogram(np.append(amplitude * np.sin(6 * times), np.zeros(10)), 0.005)


def test_a_bulge_of_statics_is_followed_without_an_ensemble():
    """8 sin 6t of 3 s: as one body on its tie it stands, as a wall between foot and tie it falls."""
    result = Assessor(ONE_RUN).assess("r", [sine(8.0)], on_the_ground({"front": TIED}))
    (station,) = result.periods
    assert station.rotation_ratio < 1  # the described mechanism
    fallen = [
        variation
        for variation in next(iter(station.cases.values())).variations
        if "bulges" in variation.crack
    ]
    assert [item.integrated_rotation_ratio for item in fallen] == [math.inf]
    assert station.decision.verdict is rocking.Verdict.UNCERTAIN
    assert station.decision.share == 1.0


def test_other_processings_are_followed_where_they_are_asked_for():
    for is_asked in (False, True):
        assessor = Assessor(ONE_RUN, processing_variants=is_asked)
        result = assessor.assess("r", [sine(3.0)], on_the_ground({"pier": rocking.Block(2.0, 0.2)}))
        (case,) = result.periods[0].cases.values()
        assert any(variation.processing for variation in case.variations) is is_asked
