"""Scores and the fit of probabilities: against scipy, planted truths, and what each measure names."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from docs.research import scores
from docs.research.answers import AnswerTrial, answer_scores
from docs.research.scores import HAPPENED, logistic, logit_slope
from docs.research.sites import independent
from rocking.assessment.ensemble import Ensemble
from rocking.assessment.fidelity import Answer
from rocking.assessment.settings import EnsembleSettings
from rocking.assessment.verdict import Method
from rocking.motion.response import Response
from rocking.records import Accelerogram
from rocking.structures import Outcome


def planted(many: int, sites: int = 20) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A design, outcomes of log odds 2 x − 1, and groups."""
    rng = np.random.default_rng(7)
    x = rng.normal(size=many)
    fallen = rng.random(many) < 1 / (1 + np.exp(1 - 2 * x))
    return np.column_stack([np.ones(many), x]), fallen, rng.integers(sites, size=many)


def test_the_fit_is_the_maximum_of_the_likelihood():
    """Of scipy's simplex, which knows no derivative; the penalty moves it by less than its tolerance."""
    design, fallen, groups = planted(2000)
    signs = np.where(fallen, -1, 1)
    oracle = minimize(
        lambda b: np.logaddexp(0, signs * (design @ b)).sum(),
        np.zeros(2),
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-9},
    )
    assert logistic(design, fallen, groups)[0] == pytest.approx(oracle.x, abs=1e-3)


def test_the_covariance_is_that_of_the_coefficients():
    """Of independent cases, each its own group: the spread over many samples, within what 300 of them tell (±8 %)."""
    rng = np.random.default_rng(3)
    x = rng.normal(size=400)
    design = np.column_stack([np.ones(400), x])
    odds = 1 / (1 + np.exp(-x))
    fits = [logistic(design, rng.random(400) < odds, np.arange(400)) for _ in range(300)]
    spread = np.cov(np.array([coefficients for coefficients, _ in fits]).T)
    said = np.mean([covariance for _, covariance in fits], axis=0)
    assert np.diag(said) == pytest.approx(np.diag(spread), rel=0.25)


def test_what_is_said_as_it_is_has_slope_one():
    design, fallen, _ = planted(20_000)
    odds = 2 * design[:, 1] - 1
    # the standard error of the slope is 0.02 here
    assert logit_slope(odds, fallen.astype(float)) == pytest.approx(1.0, abs=0.06)
    assert logit_slope(2 * odds, fallen.astype(float)) == pytest.approx(0.5, abs=0.03)


def test_what_stands_whatever_is_said_is_found_again():
    """The standard error of a share of 3 % among the strong half of 40 000 is 0.1 %."""
    draw = np.random.default_rng(4)
    probability = 1 / (1 + np.exp(-3 * draw.normal(size=40_000)))
    outcomes = (draw.random(40_000) < 0.97 * probability).astype(float)
    assert scores.lapse(probability, outcomes) == pytest.approx(0.03, abs=0.004)


def test_intervals_draw_whole_sites():
    """Ten cases of one site are one draw: the interval is as wide as for ten times fewer cases."""
    many = np.repeat(np.random.default_rng(2).random(40), 10)
    narrow, wide = (
        scores.interval(scores.mean(many), scores.resampled(labels, 2000))
        for labels in (np.arange(400), np.repeat(np.arange(40), 10))
    )
    assert (wide[1] - wide[0]) / (narrow[1] - narrow[0]) == pytest.approx(np.sqrt(10), rel=0.15)
    assert wide[1] - wide[0] == pytest.approx(2 * 1.645 * many.std() / np.sqrt(40), rel=0.15)


def test_reliability_counts_every_case_once():
    draw = np.random.default_rng(3)
    probability, sites = draw.random(200), [str(k // 5) for k in range(200)]
    outcomes = (draw.random(200) < probability).astype(float)
    rows = scores.reliability("a", "b", probability, outcomes, sites, (0.0, 0.2, 0.5, 1.0), 200)
    happened = [each for each in rows if each.measure == HAPPENED]
    assert sum(each.cases for each in happened) == 200
    assert sum(each.cases * each.value for each in happened) == pytest.approx(outcomes.sum())
    assert all(each.value_low <= each.value <= each.value_high for each in happened)


def test_a_site_under_two_names_counts_once():
    def record(event: str, station: str, component: str) -> Accelerogram:
        return Accelerogram(np.sin(np.arange(300) / 10), 0.01, component, event=event, station=station)

    found = independent(
        [
            ("a", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "228")),
            ("b", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "318")),
            ("c", record("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS", "228")),
            ("d", record("NORTHRIDGE EQ 1/17/94", "Rinaldi Receiving Sta", "x")),
            ("e", record("NORTHRIDGE EQ 1/17/94", "CANYON COUNTRY", "y")),
            ("f", record("Landers", "Rinaldi Receiving Sta", "y")),
        ]
    )
    assert [name for name, _, _ in found] == ["a", "b", "e", "f"]


def trial(site: str, method: Method, falls: bool, share: float) -> AnswerTrial:
    """An answer that costs a tenth of the mechanism where it settles the case, and a tenth more where it does not."""
    outcome = Outcome.OVERTURNS if share == 1 else Outcome.ROCKS
    answer = Answer(method, math.inf if share == 1 else 0.4, outcome, None)
    spent = 1.1 if method is Method.MECHANISM_ON_RECORD else 0.1
    truth = Response(math.inf, Outcome.OVERTURNS) if falls else Response(0.4, Outcome.ROCKS)
    ratios = np.where(np.arange(100) < 100 * share, np.inf, 0.4)
    whole = Ensemble(ratios, {}, EnsembleSettings())
    seconds = {"alone": spent, "beside": spent, "mechanism": 1.0, "whole": 40.0, "quick": 10.0}
    return AnswerTrial(site, answer, answer, truth, whole, whole, seconds)


def test_each_measure_of_the_cheapest_answers_counts_what_it_names():
    trials = [
        trial("a", Method.NOTHING_TO_INTEGRATE, False, 0.0),
        trial("a", Method.PEAK_VELOCITY, False, 0.0),
        trial("b", Method.BLOCK_ON_RECORD, True, 1.0),
        trial("b", Method.BLOCK_ON_RECORD, True, 0.5),
        trial("b", Method.MECHANISM_ON_RECORD, False, 0.3),
    ]
    found = answer_scores(trials, replicates=20)
    assert {(score.cases, score.sites) for score in found} == {(5, 2)}
    assert {score.measure: score.value for score in found} == pytest.approx(
        {
            "share at rest": 1 / 5,
            "share settled by the peak velocity": 1 / 5,
            "share settled by the block": 2 / 5,
            "members against the verdict of the peak velocity": 0.0,
            "members against the verdict of the block": 0.25,
            "wrong verdicts among all without an ensemble": 1 / 5,
            "wrong verdicts among those settled": 1 / 3,
            "overturnings called standing among those settled": 1 / 3,
            "opposite verdict of the ensemble among those settled": 0.0,
            "undecided in the ensemble among those settled": 1 / 3,
            "verdicts of the ensemble that its early end changes": 0.0,
            "CPU saved of the mechanism for all": 1 - 1.5 / 5,
            "CPU saved of mechanism and ensemble for all": 1 - 11.5 / 205,
        }
    )
