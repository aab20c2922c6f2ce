"""What is said of a structure over the periods of its support: intervals of one verdict, in their order."""

from types import SimpleNamespace

import pytest

from rocking.assessment.over_periods import over_periods
from rocking.assessment.verdict import Verdict
from rocking.structures import Block
from rocking.structures.standing import support_from_config

S, O, U, X = Verdict.STANDS, Verdict.OVERTURNS, Verdict.UNDECIDED, Verdict.UNKNOWN
BODY = Block(semi_diagonal=1.0, slenderness=0.2)


def swept(*verdicts):
    roof = {"name": "roof", "period_s": [0.1, 0.8], "participation": 1.3}
    standings = support_from_config(roof).standings("parapet")
    chosen = [standings[0], *standings[2::2]]  # the ground, 0.13, 0.219, 0.367, 0.618 s
    pairs = [
        (BODY.standing_on(each), SimpleNamespace(structure=each.name, verdict=verdict))
        for each, verdict in zip(chosen, verdicts, strict=False)
    ]
    return over_periods(reversed(pairs))


@pytest.mark.parametrize(
    ("verdicts", "sentence"),
    [
        ((S, S, S, S, S), "stands on the ground and on a building of T_b ≤ 0.617 s"),
        ((S, S, S, O, O), "stands on a building of T_b ≤ 0.218 s, overturns from 0.367 s on (tried to 0.617 s)"),
        ((S, O, O, O, O), "stands on the ground, overturns from 0.13 s on (tried to 0.617 s)"),
        ((S, S, U, O, S), "stands on a building of T_b ≤ 0.13 s, is undecided at T_b 0.218 s, overturns at "
                          "T_b 0.367 s, stands at T_b 0.617 s"),
        ((S, O, O, S, S), "stands on the ground, overturns from 0.13 to 0.218 s, stands from 0.367 s on (tried to "
                          "0.617 s)"),
        ((S, X), "stands on the ground, is unknown at T_b 0.13 s"),
        ((O, O, O, O, O), "overturns on the ground and on a building of T_b ≤ 0.617 s"),
    ],
)  # fmt: skip
def test_intervals(verdicts, sentence):
    (only,) = swept(*verdicts)
    assert only.sentence == f"parapet on roof {sentence}"
    assert only.periods == sorted(only.periods)


def test_structures_without_a_support_are_none_of_it():
    assert over_periods([(BODY, SimpleNamespace(structure="pier", verdict=O))]) == []
