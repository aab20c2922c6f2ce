"""Each measure of the cheapest answers counts what it names, on trials whose answer is known."""

import math
from dataclasses import replace

import pytest

from docs.research.answers import AnswerTrial, answer_scores
from rocking.assessment.fidelity import Answer
from rocking.assessment.method import Method
from rocking.assessment.verdict import Verdict
from rocking.structures.outcome import Outcome


def answer(method: Method, rotation_ratio: float) -> Answer:
    return Answer(method, rotation_ratio, Outcome.ROCKS, None)


def trial(
    site: str, method: Method, said: float, truth: float, share: float, verdict: Verdict
) -> AnswerTrial:
    """An answer that costs a tenth of the mechanism where it settles the case, and a tenth more where it does not."""
    integrated = method is Method.MECHANISM_ON_RECORD
    spent = 1.1 if integrated else 0.1
    return AnswerTrial(
        site,
        answer(method, said),
        answer(method, said),
        truth,
        share,
        verdict,
        verdict,
        spent,
        spent,
        1.0,
        40.0,
        10.0,
    )


TRIALS = [
    trial("a", Method.NOTHING_TO_INTEGRATE, 0.0, 0.0, 0.0, Verdict.STANDS),
    trial("a", Method.PEAK_VELOCITY, 0.2, 0.3, 0.02, Verdict.STANDS),
    trial("b", Method.BLOCK_ON_RECORD, math.inf, math.inf, 1.0, Verdict.OVERTURNS),
    trial("b", Method.BLOCK_ON_RECORD, 0.4, math.inf, 0.5, Verdict.UNDECIDED),
    trial("b", Method.MECHANISM_ON_RECORD, 0.4, 0.4, 0.3, Verdict.UNDECIDED),
]


@pytest.mark.parametrize(
    ("measure", "value"),
    [
        (f"share answered by {Method.NOTHING_TO_INTEGRATE}", 1 / 5),
        (f"share answered by {Method.PEAK_VELOCITY}", 1 / 5),
        (f"share answered by {Method.BLOCK_ON_RECORD}", 2 / 5),
        (f"members against the verdict of {Method.PEAK_VELOCITY}", 0.02),
        (f"members against the verdict of {Method.BLOCK_ON_RECORD}", 0.25),
        ("wrong verdicts among those settled", 1 / 3),
        ("overturnings called standing among those settled", 1 / 3),
        ("opposite verdict of the ensemble among those settled", 0.0),
        ("undecided in the ensemble among those settled", 1 / 3),
        ("CPU saved of the mechanism for all", 1 - 1.5 / 5),
        ("CPU saved of mechanism and ensemble for all", 1 - 11.5 / 205),
    ],
)
def test_a_measure_counts_what_it_names(measure, value):
    scores = {score.measure: score for score in answer_scores(TRIALS, replicates=20)}
    assert scores[measure].value == pytest.approx(value)
    assert (scores[measure].cases, scores[measure].sites) == (5, 2)


def test_a_verdict_that_turns_is_counted_once():
    turned = [
        replace(each, truth=math.inf if each.truth < 1 else 0.1, quick_verdict=Verdict.UNKNOWN)
        for each in TRIALS
    ]
    scores = {score.measure: score.value for score in answer_scores(turned, replicates=20)}
    assert scores["wrong verdicts among all without an ensemble"] == pytest.approx(1 - 1 / 5)
    assert scores["verdicts of the ensemble that its early end changes"] == 1
