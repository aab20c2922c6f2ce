"""What the page to explore is told of one record: the numbers of its tables, rounded for JSON."""

import json
import math

import pytest

from rocking.reports.explore import record_content


def test_numbers_are_those_of_the_result_to_six_digits_and_nothing_stands_for_nan(example):
    content = record_content(example.result, example.tables, example.structures)
    json.dumps(content, allow_nan=False)
    cases = content["cases"]
    for station in example.result.worst_first:
        share = station.decision.share
        told = cases[station.structure]["severity"][1]
        assert math.isnan(share) or told == pytest.approx(share, rel=5e-6)
    assert any(case["severity"][1] > 0 for case in cases.values())
