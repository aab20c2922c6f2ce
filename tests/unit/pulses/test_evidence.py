"""Lights and the reliability table."""

import math

import pytest

from rocking.errors import PulseError, RockingError
from rocking.pulses import THRESHOLDS, Light, light
from rocking.pulses.reliability import Reliability, read_reliability, reliability_of


@pytest.mark.parametrize(
    ("explained", "ratio", "expected"),
    [
        (0.35, 1.3, Light.GREEN),
        (0.90, 5.0, Light.GREEN),
        (0.349, 1.3, Light.AMBER),
        (0.20, 1.3, Light.AMBER),
        (0.199, 9.0, Light.RED),
        (0.90, 1.299, Light.RED),
        (0.60, -1.5, Light.GREEN),  # η_a of a pulse of negative sign
    ],
)
def test_the_table_of_lights(explained, ratio, expected):
    assert light(explained, ratio) is expected


def test_more_evidence_never_makes_a_light_worse():
    order = [Light.RED, Light.AMBER, Light.GREEN]
    grid = [i / 50 for i in range(51)]
    for ratio in (0.5, 1.0, 1.3, 2.0):
        ranks = [order.index(light(share, ratio)) for share in grid]
        assert ranks == sorted(ranks)


def test_red_says_that_it_is_the_unsafe_side():
    assert "too low" in Light.RED.sentence
    assert THRESHOLDS.evidence


@pytest.mark.parametrize("numbers", [(math.nan, 2), (0.5, math.inf), ("0.5", 2)])
def test_a_light_needs_numbers(numbers):
    with pytest.raises(PulseError):
        light(*numbers)


HEADS = ",".join(Reliability.table.column_names)
ROWS = (
    "green,0,3,12,340,0.91,1.02,40,3",
    "green,3,INF,9,100,0.8,1.1,10,5",
    "red,0,INF,20,600,0.2,0.15,30,70",
)


def table(folder, *lines):
    path = folder / "reliability.csv"
    path.write_text("\n".join((HEADS, *lines)) + "\n", encoding="utf-8")
    return path


def test_the_row_that_applies_is_found(tmp_path):
    rows = read_reliability(table(tmp_path, *ROWS))
    assert reliability_of(rows, Light.GREEN, 2.999).records == 12
    assert reliability_of(rows, Light.GREEN, 3.0).overturnings_missed == 5
    assert reliability_of(rows, Light.RED, 1e6).median_ratio == 0.15
    assert reliability_of(rows, Light.AMBER, 1.0) is None


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("green,0,3,12,-1,0.91,1.02,40,3", "0 or more"),
        ("green,3,3,12,340,0.91,1.02,40,3", "must ascend"),
        ("green,0,3,12", "line 2, has 4 cells"),
    ],
)
def test_a_defective_table_is_refused(tmp_path, line, words):
    with pytest.raises(RockingError, match=words):
        read_reliability(table(tmp_path, line))
