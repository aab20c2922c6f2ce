"""Cracks that may form, each followed where that of statics stands, candidates over the height, and processing."""

from functools import partial

import numpy as np
import pytest

import rocking
from rocking.assessment.assess import assess_case
from rocking.assessment.component import component_of
from rocking.assessment.ensemble import ensemble
from rocking.assessment.fragility import fragility
from rocking.assessment.ground_motions import GroundMotions, processed
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.variations import candidates, cracks, ensemble_over_cracks, processed_variants
from rocking.assessment.verdict import Verdict
from rocking.motion import integrate
from rocking.motion.members import follow_factors
from rocking.pulses import Pulse
from rocking.records import Accelerogram
from rocking.structures import Arch, Block, Spire, Wall

STEP, TIMES = 0.01, np.arange(0, 4, 0.01)
SPIRE = Spire(width=3.0, height=15.0, wall_thickness=0.3)
WALL = Wall.hinged_at(6.0, 3.0, 0.4)
LOW_WALL = Wall(2.0, 2.0, 0.3)
PULSE = Pulse(2.5, 2 * np.pi / 0.9, 3.0)
SINE = Accelerogram(PULSE.acceleration(np.arange(2000) * STEP), STEP)


def record(amplitude: float, period: float = 0.9) -> Accelerogram:
    wave = np.sin(2 * np.pi * TIMES / period) * np.exp(-(((TIMES - 1.5) / 0.8) ** 2))
    return Accelerogram(amplitude * wave / np.abs(wave).max(), STEP)


@pytest.mark.parametrize(
    ("structure", "expected"), [(WALL, {Verdict.STANDS, Verdict.OVERTURNS}), (SPIRE, {Verdict.UNDECIDED})]
)
def test_stands_means_that_every_crack_stands_and_a_crack_that_does_not_is_named(structure, expected):
    """The oracle follows every crack in full; a spire, which tapers, never stands once it has lifted."""
    multiplier = structure.static_multiplier
    seen = set()
    for severity in (1.5, 2.5, 3.5, 5.0, 8.0, 14.0):
        motion = record(severity * multiplier * 9.80665)
        assessment = rocking.assess(motion, structure)
        of_statics = ensemble(cracks(structure)[0][1], GroundMotions.of(motion)).verdict
        follow = partial(ensemble, motions=GroundMotions.of(motion))
        verdicts = {description: follow(mechanism).verdict for description, mechanism in cracks(structure)}
        if of_statics is not Verdict.STANDS:
            assert assessment.verdict is of_statics
        elif set(verdicts.values()) == {Verdict.STANDS}:
            assert assessment.elsewhere is None
            if structure.tapers:
                assert assessment.verdict is Verdict.UNDECIDED
                assert assessment.why == "courses above a rocking body may be thrown"
            else:
                assert assessment.verdict is Verdict.STANDS
        else:
            assert assessment.verdict is Verdict.UNDECIDED
            assert verdicts[assessment.governing.description] is not Verdict.STANDS
            assert assessment.governing.description in repr(assessment)
        seen.add(assessment.verdict)
    assert expected <= seen


@pytest.mark.parametrize("structure", [WALL, SPIRE, Arch(5.0, 0.8, np.radians(150))])
def test_unknown_cracks_cost_at_most_two_and_a_half_ensembles(structure, monkeypatch):
    """Members that are followed, over records under which it stands, is undecided and overturns."""
    followed: list[int] = []

    def counted(reduced, forcing, factors, *others):
        followed.append(factors.size)
        return follow_factors(reduced, forcing, factors, *others)

    monkeypatch.setattr("rocking.assessment.ensemble.follow_factors", counted)
    members = {"unknown": 0, "given": 0}
    for severity in (1.5, 2.5, 3.5, 5.0, 8.0):
        motions = GroundMotions.of(record(severity * structure.static_multiplier * 9.80665))
        followed.clear()
        ensemble_over_cracks(structure, motions, AssessmentSettings())
        members["unknown"] += sum(followed)
        followed.clear()
        ensemble(cracks(structure)[0][1], motions)
        members["given"] += sum(followed)
    assert members["given"] < members["unknown"] <= 2.5 * members["given"]


def test_auto_rests_only_where_every_crack_does():
    """As typed the wall rests; the hinge that statics chooses lifts."""
    given = WALL.mechanism().uplift_multiplier
    assert WALL.static_multiplier < 0.999 * given
    motion = record(0.5 * (given + WALL.static_multiplier) * 9.80665)
    settings = AssessmentSettings(fidelity="auto")
    case = assess_case("wall", WALL, component_of(motion, settings.pulse), settings)
    assert case.answer.reason != "the ground never reaches the uplift acceleration"


def test_the_governed_fragility_is_never_below_that_of_statics():
    records = [record(1.0, period) for period in (0.5, 0.8, 1.2)]
    usual = {"levels": np.geomspace(0.2, 3.0, 8), "stations": list("abc")}
    plain, governed = (fragility(records, SPIRE, over_cracks=over, **usual) for over in (False, True))
    assert np.all(governed.probability >= plain.probability) and governed.median <= plain.median


def test_the_middle_candidate_is_the_wall_itself():
    variations = candidates(LOW_WALL, SINE, PULSE, 5, AssessmentSettings())
    middle = variations[2]
    assert middle.position == pytest.approx(2.0)
    assert middle.integrated_rotation_ratio == integrate(LOW_WALL, SINE).rotation_ratio


def test_a_higher_hinge_lifts_earlier():
    # λ = 2 tan α₁ falls as the lower block grows, so a shaking that leaves low hinges shut opens high ones.
    variations = candidates(LOW_WALL, SINE.scaled(0.8), None, 9, AssessmentSettings())
    lifted = [each.integrated_rotation_ratio > 0 for each in variations]
    assert lifted == sorted(lifted)
    assert lifted[-1]
    assert not lifted[0]


def test_processing_that_changes_nothing_changes_no_answer():
    records = processed(SINE)
    block = Block(2.0, 0.2)
    assert "unchanged" in records
    variations = processed_variants({"": block}, records, AssessmentSettings())[""]
    ratios = {each.processing: each.integrated_rotation_ratio for each in variations}
    assert ratios["unchanged"] == integrate(block, SINE).rotation_ratio
    assert ratios["high-pass 0.2 Hz"] != ratios["unchanged"]
