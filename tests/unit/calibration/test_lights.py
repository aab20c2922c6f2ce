"""Thresholds from comparisons: the rule keeps its promise, and the shipped table is what the records give."""

import math

import pytest

from rocking.calibration.lights import (
    Comparison,
    choose_thresholds,
    compare,
    grid_of_blocks,
    reliability,
    score,
)
from rocking.errors import PulseError
from rocking.pulses import Light, light
from rocking.pulses.evidence import THRESHOLDS
from rocking.records import read


def _comparison(energy, amplitude_ratio, predicted, integrated, site="a"):
    return Comparison(
        record="r",
        site=site,
        structure="s",
        scale_factor=1.0,
        explained_energy=energy,
        amplitude_ratio=amplitude_ratio,
        frequency_ratio=5.0,
        predicted_rotation_ratio=predicted,
        pulse_rotation_ratio=predicted,
        integrated_rotation_ratio=integrated,
    )


def test_score_counts_what_it_says():
    found = score(
        [
            _comparison(0.4, 2, 0.5, 0.4),
            _comparison(0.4, 2, 0.1, 0.4, "b"),
            _comparison(0.4, 2, math.inf, math.inf),
            _comparison(0.4, 2, 0.3, math.inf),
            _comparison(0.4, 2, math.inf, 0.4),
        ]
    )
    assert (found.comparisons, found.records, found.both_rock) == (5, 2, 2)
    assert found.within_factor_2 == 0.5
    assert (found.overturnings, found.overturnings_found) == (2, 1)


def _good_above(energy):
    return [
        _comparison(e, 2.0, 0.4 if e >= energy else 0.01, 0.4, site)
        for e in (0.1, 0.2, 0.3, 0.4, 0.5)
        for site in "abc"
    ]


def test_green_begins_where_predictions_become_good():
    thresholds = choose_thresholds(_good_above(0.4))
    assert 0.3 < thresholds.green_explained_energy <= 0.4


def test_green_is_not_earned_by_one_site():
    spoiled = [c for c in _good_above(0.0) if c.site == "a"]
    with pytest.raises(PulseError, match="green"):
        choose_thresholds(spoiled)


def test_every_comparison_stands_in_one_row():
    comparisons = _good_above(0.4)
    rows = reliability(comparisons, THRESHOLDS)
    assert sum(row.comparisons for row in rows) == len(comparisons)


@pytest.mark.real_records
@pytest.mark.parametrize(
    ("file", "colour"),
    [
        ("landers1992_lucerne/RSN879_LANDERS_LCN260.AT2", Light.RED),
        ("kern1952_taft/RSN15_KERN_TAF021.AT2", Light.RED),
        ("impvall1940_elcentro/RSN6_IMPVALL.I_I-ELC180.AT2", Light.RED),
    ],
)
def test_records_without_a_dominant_pulse_are_red(real_records, file, colour):
    record = read(real_records / file)[0]
    blocks = dict(list(grid_of_blocks().items())[:4])
    found = list(compare("r", record, blocks))
    assert {light(c.explained_energy, c.amplitude_ratio) for c in found} == {colour}


@pytest.mark.real_records
def test_rinaldi_is_predicted_without_bias(real_records):
    record = read(real_records / "northridge1994_rinaldi" / "RSN1063_NORTHR_RRS228.AT2")[0]
    found = [c for c in compare("r", record, grid_of_blocks()) if c.amplitude_ratio >= 1.3]
    assert 0.7 <= score(found).median_ratio <= 1.2
