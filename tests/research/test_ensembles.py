"""Ensembles held against draws: trials are what they say, and a measure counts what it names."""

import math
from dataclasses import replace

import numpy as np
import pytest

from docs.research import ensembles
from docs.research.ensembles import CHOSEN, LEFT_OUT, PAIRS, EnsembleTrial, ScreeningTrial, try_ensembles
from docs.research.sites import SiteRecord
from rocking.assessment.decide import Verdict
from rocking.records import Accelerogram
from rocking.structures import Block, Spire, Wall

TIMES = np.arange(0, 6, 0.01)
RECORDS = [
    (f"made {k}", Accelerogram(samples * np.exp(-((TIMES - 2) ** 2)), 0.01, event="made", station=f"{k}"))
    for k, samples in enumerate(np.sin(2 * np.pi * TIMES / period) for period in (0.5, 0.8, 1.1, 1.6))
]
STRUCTURES = {"slender": Block(2.0, 0.15), "stout": Block(3.0, 0.3)}


@pytest.fixture(autouse=True)
def few_draws(monkeypatch):
    """400 random draws of each case."""
    monkeypatch.setattr(ensembles, "DRAWS", 400)


def test_trials_are_the_same_at_every_call_and_scatter_about_the_draws():
    trials = list(try_ensembles(RECORDS, [], STRUCTURES))
    again = try_ensembles(RECORDS, [], STRUCTURES)
    assert [repr(trial) for trial in again] == [repr(trial) for trial in trials]
    assert len(trials) == 3 * len(RECORDS) and {trial.draws for trial in trials} == {400}
    for trial in trials:
        spread = 4 * math.sqrt(0.25 / 400)
        assert abs(trial.share_256 - trial.share_drawn) < spread, "four standard errors of the draws"


def test_two_components_of_a_site_are_tried_as_a_pair_too():
    pair = [(name, replace(record, component=name, station="0")) for name, record in RECORDS[:2]]
    trials = list(try_ensembles([], pair, STRUCTURES))
    assert [trial.half for trial in trials] == [LEFT_OUT] * 6 + [PAIRS] * 3
    assert [trial.record for trial in trials[::3]] == ["made 0", "made 1", "made 0"]


def test_each_measure_counts_what_it_names():
    shares = {f"share{which}": 0.5 for which in ("", "_64", "_256", "_drawn")}
    names = {
        "record": "a",
        "site": "s",
        "earthquake": "e",
        "half": CHOSEN,
        "structure": "b",
        "verdict": Verdict.UNCERTAIN,
    }
    first = EnsembleTrial(scale_factor=1.0, members=64, draws=4000, inside_band=0.9, **names, **shares)
    wrong = replace(first, share_64=0.6, share_256=0.54, site="t")
    sure = replace(first, verdict=Verdict.STANDS, share=0.0, share_drawn=0.09, site="u")
    values = {row.measure: row.value for row in ensembles.ensemble_scores([first, wrong, sure])}
    assert values["share within 0.07 with 64 members (0.95 is asked)"] == pytest.approx(1 / 3)
    assert values["share within 0.035 with 256 members (0.95 is asked)"] == pytest.approx(1 / 3)
    assert values["share of verdicts beyond their risk by more than 0.03 (0 is asked)"] == 1
    assert values["verdicts"] == 1


def test_each_measure_of_the_screen_counts_what_it_names():
    stands, overturns, uncertain = Verdict.STANDS, Verdict.OVERTURNS, Verdict.UNCERTAIN
    cases = [
        (stands, stands, 0.06, 0.0, 0.0),
        (stands, stands, 0.04, 0.0, 0.6),
        (stands, overturns, np.nan, 0.02, 0.04),
        (uncertain, stands, 0.01, 0.5, 0.6),
        (overturns, overturns, np.nan, 0.9, 1.0),
    ]
    about = {"record": "r", "structure": "wall", "scale_factor": 1.0}
    trials = [
        ScreeningTrial(
            verdict=verdict,
            exhaustive=exhaustive,
            fresh_share=fresh,
            share=share,
            largest_share=largest,
            site=f"{k}",
            earthquake=f"{k}",
            **about,
        )
        for k, (verdict, exhaustive, fresh, share, largest) in enumerate(cases)
    ]
    values = [row.value for row in ensembles.screening_scores(trials) if row.part == "wall"]
    assert values == pytest.approx([3 / 5, 1 / 3, 1 / 3, 2 / 5, 2 / 4, 1 / 2])


def test_a_crack_that_is_given_is_no_trial_of_the_screen():
    motion = Accelerogram(3 * np.sin(2 * np.pi * TIMES / 1.5) * (TIMES < 1.5), 0.01)
    given = {"spire": Spire(3.0, 15.0, 0.25, crack_height=5.0, crack="known")}
    assert list(ensembles.screening_trials(SiteRecord("r", "s", "e", motion), given)) == []


def test_the_verdict_over_all_cracks_is_that_of_the_ensembles_of_all():
    """Of a wall that may crack anywhere; a block has one mechanism and is no trial."""
    motion = Accelerogram(3 * np.sin(2 * np.pi * TIMES / 1.5) * (TIMES < 1.5), 0.01)
    made = {"wall": Wall.of_size(3.2, 0.25), "block": Block(2.0, 0.2)}
    trials = list(ensembles.screening_trials(SiteRecord("r", "s", "e", motion), made))
    assert [(trial.structure, trial.verdict) for trial in trials] == [("wall", e.exhaustive) for e in trials]
    assert all(one_trial.share <= one_trial.largest_share for one_trial in trials)
    values = {
        score.measure: score.value for score in ensembles.screening_scores(trials) if score.part == "wall"
    }
    assert values["other verdict than that of all cracks"] == 0
    assert values['share of "stands"'] == float(trials[0].verdict is Verdict.STANDS)


def test_a_site_counts_once_and_what_came_later_is_left_out():
    half = len(RECORDS) // 2
    trials = list(try_ensembles(RECORDS[:half], RECORDS, STRUCTURES))
    assert [trial.record for trial in trials[::3]] == [name for name, _ in RECORDS]
    assert {trial.half for trial in trials[3 * half :]} == {LEFT_OUT}
    assert {trial.half for trial in try_ensembles(RECORDS, [], STRUCTURES)} == {CHOSEN}
