"""What a sine is worth: a record that is one sine is predicted, and each outcome is counted once."""

import math

import numpy as np
import pytest

from docs.research.sites import SiteRecord
from docs.research.worth import FACTORS, Case, cases_of, worth_scores
from rocking import Accelerogram, Block, Pulse
from rocking.assessment.methods import Acts


def test_a_record_that_is_one_sine_is_explained_by_it_and_ends_as_said():
    pulse = Pulse(amplitude=3.0, circular_frequency=2 * math.pi / 0.8, start_time=0.5)
    record = Accelerogram(pulse.acceleration(np.arange(500) * 0.01), 0.01)
    cases = list(cases_of(SiteRecord("made", "site", "made", record), {"block": Block.of_size(0.6, 3.0)}))
    assert len(cases) == len(FACTORS)
    assert all(other_case.explained == pytest.approx(1.0, abs=0.01) for other_case in cases)
    assert [math.isinf(case.predicted) for case in cases] == [
        math.isinf(one_case.integrated) for one_case in cases
    ]


def test_each_class_counts_its_own_outcomes():
    """Of four falls under weak sines one is found, and one is over before; where the sine dominates, both rock."""
    cases = [
        Case("a", "A", 0.05, math.inf, math.inf),
        Case("b", "B", 0.05, math.inf, 0.3),
        Case("b", "B", 0.05, math.inf, 0.0),
        Case("b", "B", 0.05, math.inf, math.inf, Acts.AFTER),
        Case("c", "C", 0.7, 0.4, 0.2),
    ]
    found = {(row.part, row.measure): row.value for row in worth_scores(cases)}
    assert found["0 or more of the energy", "falls found"] == pytest.approx(1 / 4)
    assert found["0 or more of the energy", "same outcome"] == pytest.approx(2 / 4)
    assert found["0.5 or more of the energy", "same outcome"] == 1
