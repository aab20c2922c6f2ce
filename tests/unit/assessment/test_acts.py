"""When the sine of a prediction acts beside the fall, and what counts as seen: not what is over before it begins."""

import math

import numpy as np
import pytest

from rocking import Accelerogram, Block, integrate
from rocking.assessment.methods import Acts, Agreement, acts
from rocking.assessment.rows import agreement_rows
from tests.unit.assessment.made_rows import compared


@pytest.mark.parametrize(
    ("fall", "expected"),
    [
        (math.nan, None),
        (0.99, Acts.AFTER),
        (1.0, Acts.DURING),
        (5.0, Acts.DURING),  # 6/p after its end
        (5.01, Acts.BEFORE),
    ],
)
def test_a_sine_acts_before_during_or_after_the_fall(fall, expected):
    assert acts(start=1.0, end=2.0, fall=fall, frequency_parameter=2.0) is expected


def test_the_fall_is_where_the_history_first_passes_the_critical_rotation():
    block = Block.of_size(0.6, 4.0)
    shape = np.sin(2 * np.pi * np.arange(300) * 0.01 / 1.2)
    record = Accelerogram(np.concatenate([np.zeros(100), 6.0 * shape]), 0.01)
    response = integrate(block, record, history=True)
    critical = block.mechanism().positive.critical_rotation
    before = response.times < response.fall_time
    assert response.rotation_ratio == math.inf and response.fall_time > 1.0
    assert np.all(np.abs(response.rotation[before]) < critical)
    assert critical * (1 - 1e-9) <= np.abs(response.rotation[~before][0])
    assert math.isnan(integrate(block, record.scaled(0.1), history=True).fall_time)


def fall(record: str, predicted: float, acting: Acts | None = Acts.DURING):
    """A case that falls under a record."""
    return compared(
        "EW",
        math.inf,
        record=record,
        predicted_rotation_ratio=predicted,
        pulse_acts=acting,
        agreement=Agreement.UNKNOWN,
    )


def test_a_fall_that_is_over_before_the_sine_begins_is_missed_and_made_records_are_counted_apart():
    cases = [
        fall("a", math.inf),
        fall("a", math.inf, Acts.BEFORE),
        fall("b", math.inf, Acts.AFTER),
        fall("b", 0.4),
        fall("sine", math.inf),
        fall("sine", math.inf),
    ]
    of_all, of_made, of_pier = agreement_rows(cases, {}, {"sine"})
    counts = [
        (row.overturning, row.overturning_hits, row.overturning_misses) for row in (of_all, of_made, of_pier)
    ]
    assert counts == [(4, 2, 2), (2, 2, 0), (4, 2, 2)]
    assert [row.made for row in (of_all, of_made, of_pier)] == [False, True, False]
    (alone, _) = agreement_rows(cases[-2:], {}, {"sine"})
    assert alone.overturning == 2 and not alone.made, "where nothing was recorded, all of it is made"
