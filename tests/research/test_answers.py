"""Each measure of the cheapest answers counts what it names, on trials whose answer is known."""

import math

import pytest

from docs.research.answers import AnswerTrial, answer_scores
from rocking.assessment.fidelity import Answer
from rocking.assessment.method import Method
from rocking.assessment.verdict import Verdict
from rocking.structures import Outcome


def trial(site: str, method: Method, said: bool, falls: bool, share: float, verdict: Verdict) -> AnswerTrial:
    """An answer that costs a tenth of the mechanism where it settles the case, and a tenth more where it does not."""
    outcome = Outcome.OVERTURNS if said else Outcome.ROCKS
    answer = Answer(method, math.inf if said else 0.4, outcome, None)
    spent = 1.1 if method is Method.MECHANISM_ON_RECORD else 0.1
    return AnswerTrial(site, answer, answer, falls, share, verdict, verdict, spent, spent, 1.0, 40.0, 10.0)


TRIALS = [
    trial("a", Method.NOTHING_TO_INTEGRATE, False, False, 0.0, Verdict.STANDS),
    trial("a", Method.PEAK_VELOCITY, False, False, 0.02, Verdict.STANDS),
    trial("b", Method.BLOCK_ON_RECORD, True, True, 1.0, Verdict.OVERTURNS),
    trial("b", Method.BLOCK_ON_RECORD, False, True, 0.5, Verdict.UNDECIDED),
    trial("b", Method.MECHANISM_ON_RECORD, False, False, 0.3, Verdict.UNDECIDED),
]


@pytest.mark.parametrize(
    ("measure", "value"),
    [
        ("share at rest", 1 / 5),
        ("share settled by the peak velocity", 1 / 5),
        ("share settled by the block", 2 / 5),
        ("members against the verdict of the peak velocity", 0.02),
        ("members against the verdict of the block", 0.25),
        ("wrong verdicts among all without an ensemble", 1 / 5),
        ("wrong verdicts among those settled", 1 / 3),
        ("overturnings called standing among those settled", 1 / 3),
        ("opposite verdict of the ensemble among those settled", 0.0),
        ("undecided in the ensemble among those settled", 1 / 3),
        ("verdicts of the ensemble that its early end changes", 0.0),
        ("CPU saved of the mechanism for all", 1 - 1.5 / 5),
        ("CPU saved of mechanism and ensemble for all", 1 - 11.5 / 205),
    ],
)
def test_a_measure_counts_what_it_names(measure, value):
    scores = {score.measure: score for score in answer_scores(TRIALS, replicates=20)}
    assert scores[measure].value == pytest.approx(value)
    assert (scores[measure].cases, scores[measure].sites) == (5, 2)
