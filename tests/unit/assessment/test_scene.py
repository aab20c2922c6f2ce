"""What is said of a structure over the periods of its support: intervals of one verdict, in their order."""

import pytest

from rocking.assessment.decide import Verdict
from rocking.assessment.scene import periods_in_words, placed

S, O, U, X = Verdict.STANDS, Verdict.OVERTURNS, Verdict.UNCERTAIN, Verdict.CANNOT_BE_TOLD
PERIODS = (0.0, 0.13, 0.218, 0.367, 0.617)


@pytest.mark.parametrize(
    ("verdicts", "sentence"),
    [
        ((S, S, S, S, S), "stands on the ground and on a building of T_b ≤ 0.617 s"),
        ((S, S, S, O, O), "stands on a building of T_b ≤ 0.218 s, overturns from 0.367 s on (tried to 0.617 s)"),
        ((S, O, O, O, O), "stands on the ground, overturns from 0.13 s on (tried to 0.617 s)"),
        ((S, S, U, O, S), "stands on a building of T_b ≤ 0.13 s, is uncertain at T_b 0.218 s, overturns at "
                          "T_b 0.367 s, stands at T_b 0.617 s"),
        ((S, O, O, S, S), "stands on the ground, overturns from 0.13 to 0.218 s, stands from 0.367 s on (tried to "
                          "0.617 s)"),
        ((S, X), "stands on the ground, cannot be told at T_b 0.13 s"),
        ((O, O, O, O, O), "overturns on the ground and on a building of T_b ≤ 0.617 s"),
    ],
)  # fmt: skip
def test_intervals(verdicts, sentence):
    pairs = list(zip(PERIODS, verdicts, strict=False))
    assert periods_in_words(dict(reversed(pairs))) == sentence


def test_a_structure_is_called_with_the_period_where_it_has_one():
    assert placed("pier", None) == placed("pier", float("nan")) == "pier"
    assert placed("parapet", 0.0) == "parapet, on the ground"
    assert placed("parapet", 0.25) == "parapet, T_b 0.25 s"
