"""The shipped thresholds and reliability table: read strictly, and what they promise."""

import pytest

from rocking.errors import RockingError
from rocking.pulses import Light
from rocking.pulses.evidence import THRESHOLDS, Thresholds, read_thresholds
from rocking.pulses.reliability import Reliability, read_reliability, reliability_of, shipped_reliability


def _share_found(light):
    rows = [row for row in shipped_reliability() if row.light is light]
    found = sum(row.overturnings_found for row in rows)
    return found / (found + sum(row.overturnings_missed for row in rows))


def test_green_finds_85_percent_of_the_overturnings_and_red_does_not():
    assert _share_found(Light.GREEN) >= 0.85
    assert _share_found(Light.RED) < 0.6


def test_lights_stand_in_order():
    assert 0 < THRESHOLDS.amber_explained_energy < THRESHOLDS.green_explained_energy < 1
    assert THRESHOLDS.amplitude_ratio > 1


def test_a_class_is_closed_below_and_open_above():
    edge = shipped_reliability()[0].frequency_ratio_to
    below = reliability_of(shipped_reliability(), Light.GREEN, edge * (1 - 1e-12))
    assert below is shipped_reliability()[0]
    assert reliability_of(shipped_reliability(), Light.GREEN, edge) is not below


def test_defects_are_refused(tmp_path):
    table = tmp_path / "table.csv"
    heads = ",".join(Reliability.table.column_names)
    for content, read, said in (
        ("light,records\ngreen,1", read_reliability, "columns"),
        (f"{heads}\nblue,1,3,1,1,1,1,1,1", read_reliability, "line 2, column light: 'blue' must be green"),
        (f"{heads}\ngreen,3,1,1,1,1,1,1,1", read_reliability, "must ascend"),
        (f"{heads}\ngreen,1,3,1,1,,1,1,1", read_reliability, "finite"),
        (",".join(Thresholds.table.column_names) + "\n", read_thresholds, "one row"),
    ):
        table.write_text(content)
        with pytest.raises(RockingError, match=said):
            read(table)
