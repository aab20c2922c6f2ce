"""Arches and portals beside other chains of stones and LMGC90: what is drawn, and what the scores count."""

from dataclasses import replace
from importlib.util import find_spec

import numpy as np
import pytest

from docs.research import voussoirs
from docs.research.scores import Score
from docs.research.sites import SiteRecord
from docs.research.voussoirs import (
    DRAWN,
    CheckedTrial,
    DisagreementTrial,
    StonesTrial,
    checked_arch,
    checked_scores,
    disagreement_scores,
    drawn,
    stones_scores,
    true_stones,
)
from rocking import Accelerogram, Verdict
from rocking.quantities import GRAVITY

TIMES = np.arange(0, 2, 0.01)
SINE = Accelerogram(3.0 * np.sin(2 * np.pi * TIMES / 0.8) * (TIMES < 1.6), 0.01)
TRIAL = StonesTrial(
    record="a",
    site="a site",
    earthquake="one",
    structure="arch",
    scale_factor=1.0,
    voussoirs=None,
    fill_m=np.nan,
    multiplier=0.2,
    verdict=Verdict.STANDS,
    mechanism=Verdict.STANDS,
    stack_falls=None,
    stack_runs=None,
    true_falls=0,
    true_runs=3,
    turn_rad=0.01,
    verdict_s=1.0,
)
CHECK = CheckedTrial(
    record="a",
    site="a site",
    earthquake="one",
    structure="arch",
    scale_factor=1.0,
    voussoirs=9,
    share=0.9,
    falls=False,
    falls_in_lmgc90=False,
    turn_rad=0.1,
    turn_in_lmgc90_rad=0.11,
    run_s=0.1,
    run_in_lmgc90_s=5.0,
    reason="",
)


def value(scores: list[Score], part: str, measure: str) -> tuple[float, int]:
    (found,) = (score for score in scores if score.part == part and score.measure == measure)
    return found.value, found.cases


@pytest.mark.parametrize("kind", DRAWN)
def test_true_stones_are_not_those_that_the_package_follows(kind):
    """Of the same mass; another number of an arch that states none, and finer steps than the package takes of all."""
    structure = drawn(kind, np.random.default_rng(1))
    own = structure.stones()
    runs = list(true_stones(structure))
    assert len({step for _, step, _ in runs}) == 3 and max(step for _, step, _ in runs) < 5e-4
    states = kind == "frame of two columns" or structure.voussoirs is not None
    for stones, _, _ in runs:
        assert stones.friction == 0.6
        assert sum(one_stone.mass for one_stone in stones.stones) == pytest.approx(
            sum(stone.mass for stone in own.stones)
        )
        assert (stones.count == own.count) == states


@pytest.mark.slow
def test_a_frame_that_hardly_lifts_stands_and_so_do_its_true_stones(monkeypatch):
    component = SiteRecord("made", "a site", "made", SINE)
    monkeypatch.setattr(voussoirs, "UPLIFTS", {"frame of two columns": (1.1, 1.3)})
    one = voussoirs.stones_trial(component, "frame of two columns", 0)
    peak = one.scale_factor * SINE.peak_acceleration / (one.multiplier * GRAVITY)
    assert 1.1 <= peak <= 1.3
    assert (one.verdict, one.true_falls, one.true_runs) == (Verdict.STANDS, 0, 3)
    assert one.turn_rad > voussoirs.LIFTED


def test_one_true_run_that_falls_counts_as_a_fall():
    trials = [
        TRIAL,
        replace(TRIAL, site="another", earthquake="two", true_falls=1),
        replace(TRIAL, verdict=Verdict.PROBABLY_STANDS, turn_rad=0.0),
        replace(
            TRIAL, verdict=Verdict.OVERTURNS, mechanism=Verdict.OVERTURNS, true_falls=None, true_runs=None
        ),
        replace(TRIAL, turn_rad=0.0),
    ]
    scores = list(stones_scores(trials))
    falls = "some true stones fall"
    assert value(scores, '"stands"', falls) == (pytest.approx(1 / 3), 3)
    assert value(scores, '"stands", and its stones lift', falls) == (0.5, 2)
    assert value(scores, '"probably stands"', falls) == (0.0, 1)
    assert value(scores, '"stands" by its mechanism', falls) == (0.25, 4)
    assert value(scores, "all trials", '"stands"') == (0.6, 5)


def test_shares_are_of_arches_of_whose_runs_none_falls_or_some_do_by_friction():
    """One true chain that falls counts, and an interval is by earthquake."""
    one = DisagreementTrial(
        record="a",
        site="a site",
        earthquake="one",
        structure="arch",
        scale_factor=1.0,
        friction=0.4,
        voussoirs=None,
        multiplier=0.2,
        mechanism=Verdict.UNCERTAIN,
        member_falls=30,
        verdict=Verdict.PROBABLY_STANDS,
        stack_falls=0,
        stack_runs=18,
        true_falls=0,
        true_runs=3,
    )
    other = replace(one, site="another", earthquake="two", friction=0.6, true_falls=1)
    trials = [one, other, replace(other, stack_falls=3, true_falls=3)]
    found = {(score.subject, score.part): score for score in disagreement_scores(trials)}
    subject = "an arch that does not stand as a mechanism"
    of_all = found[subject, "none of its runs falls"]
    assert (of_all.value, of_all.cases, of_all.earthquakes) == (0.5, 2, 2)
    assert found[f"{subject}, on 0.4", "none of its runs falls"].value == 0.0
    assert found[subject, "some of its runs fall"].value == 1.0
    assert not list(disagreement_scores([]))


@pytest.mark.slow
def test_a_disagreement_is_at_a_level_at_which_the_mechanism_does_not_stand():
    component = SiteRecord("made", "a site", "made", SINE)
    found = list(voussoirs.disagreement_trials(component, 0))
    assert found
    for trial in found:
        assert trial.friction in voussoirs.FRICTIONS and trial.mechanism not in voussoirs.STANDING
        assert trial.verdict.badness >= trial.mechanism.badness
        assert trial.true_runs == 3


def test_what_lmgc90_did_not_answer_counts_for_nothing():
    checks = [
        CHECK,
        replace(CHECK, share=1.1, falls=True, falls_in_lmgc90=True, turn_in_lmgc90_rad=0.6),
        replace(CHECK, falls=True, falls_in_lmgc90=False),
        replace(CHECK, falls_in_lmgc90=None, turn_in_lmgc90_rad=np.nan, reason="It said nothing."),
    ]
    scores = list(checked_scores(checks))
    assert value(scores, "beside LMGC90", "falls or stands as in LMGC90") == (pytest.approx(2 / 3), 3)
    turns, _ = value(scores, "beside LMGC90", "largest turn in LMGC90 over that of the package")
    assert turns == pytest.approx(1.1)
    assert list(checked_scores([checks[-1]])) == []


@pytest.mark.parametrize("on_piers", [False, True])
def test_the_bodies_of_lmgc90_are_the_stones_of_the_package(on_piers):
    """Each stone is a body of that mass and centre, and touches the ones beside it along its faces."""
    of_arch = checked_arch(np.random.default_rng(3), on_piers)
    bodies = of_arch.bodies
    masses, centres, _ = bodies.properties
    moving = [place for place in range(len(masses)) if place not in bodies.driven]
    stones = of_arch.stones.stones
    assert [one_stone.mass for one_stone in stones] == pytest.approx(masses[moving])
    assert [complex(*other_stone.centre) for other_stone in stones] == pytest.approx(centres[moving])
    assert len(stones) == of_arch.voussoirs + 2 * on_piers
    for stone, place in zip(stones, moving, strict=True):
        apart = np.array(stone.corners)[:, None] - bodies.polygons[place]
        assert np.hypot(*np.moveaxis(apart, -1, 0)).min(axis=1).max() < 1e-9
    assert of_arch.stones.resting_multiplier > 0.9 * of_arch.structure.onset.multiplier


@pytest.mark.slow
@pytest.mark.skipif(not find_spec("compas_lmgc90"), reason="install the extra compare to run this test")
def test_lmgc90_sees_the_same_arch_fall():
    below, above = voussoirs.checked_trials(SiteRecord("made", "a site", "made", SINE), 0)
    assert (below.falls, below.falls_in_lmgc90) == (False, False)
    assert (above.falls, above.falls_in_lmgc90) == (True, True)
    assert below.turn_in_lmgc90_rad == pytest.approx(below.turn_rad, rel=0.3)
