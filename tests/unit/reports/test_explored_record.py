"""What the page to explore is told of one record: the numbers of its tables, rounded for JSON."""

import base64
import json
import math
import re
from pathlib import Path

import numpy as np
import pytest
from scipy.signal import detrend

import rocking
from rocking.reports.explore import cells_of, extremes, record_content, record_script
from rocking.signal.processing import displacement

SCRIPT = (Path(rocking.__file__).parent / "reports" / "explore.js").read_text(encoding="utf-8")


def test_numbers_are_those_of_the_result_to_six_digits_and_nothing_stands_for_nan(example):
    content = record_content(example.result, example.tables, example.structures)
    json.dumps(content, allow_nan=False)
    cases = content["cases"]
    for station in example.result.worst_first:
        share = station.decision.share
        told = cases[station.structure]["severity"][1]
        assert math.isnan(share) or told == pytest.approx(share, rel=5e-6)
    assert any(case["severity"][1] > 0 for case in cases.values())
    more = record_content(
        example.result, example.tables, {**example.structures, "new": example.structures["block 1 m"]}
    )
    unknown = {
        "verdict": "cannot be told",
        "cell": "?",
        "text": "no result.",
        "severity": [-9.0, 0.0, 0.0, 0.0],
    }
    assert more["cases"] == {**cases, "new": unknown}


def test_the_motion_is_the_record_its_displacement_less_a_line_and_its_sine(example):
    content = record_content(example.result, example.tables, example.structures)
    (record,), (motion,) = example.result.accelerograms, content["motions"].values()
    assert content["pga"] == pytest.approx(record.peak_acceleration / 9.80665, rel=5e-6)
    assert content["pgv"] == pytest.approx(record.measures.peak_velocity, rel=5e-6)
    sine, times = example.motion.pulses[0], record.times
    cycle = np.linspace(sine.start_time, sine.end_time, 60)
    drawn = {
        "acceleration": extremes(times, record.acceleration, 0.0, times[-1], 2400),
        "displacement": extremes(times, detrend(displacement(record)), 0.0, times[-1], 600),
        "pulse": extremes(cycle, sine.acceleration(cycle), *cycle[[0, -1]], 60),
    }
    assert motion["duration"] == times[-1] and set(motion) == {"duration", "facts", *drawn}
    for name, values in drawn.items():
        packed = np.frombuffer(base64.b64decode(motion[name]["data"]), "<i2") * motion[name]["scale"]
        assert packed == pytest.approx(values, abs=np.abs(values).max() / 32767)


def test_a_page_holds_of_a_record_what_its_cells_show_and_its_file_the_rest(example):
    content = record_content(example.result, example.tables, example.structures)
    cells = cells_of(content)
    assert max(len(json.dumps(case)) for case in cells["cases"].values()) < 200, "10 MB hold 50 000 cases"
    assert {name for name, case in cells["cases"].items() if case["moves"]} == {
        name for name, case in content["cases"].items() if "history" in case
    }
    script = record_script(content).decode()
    assert json.loads(script.removeprefix("rockingRecord(").removesuffix(");\n")) == content


def _keys(content, above=""):
    """Every key of a nested content but those that are names of records, structures and components."""
    if isinstance(content, list):
        for part in content:
            yield from _keys(part, above)
    if isinstance(content, dict):
        for key, part in content.items():
            if above not in ("cases", "motions"):
                yield key
            yield from _keys(part, key)


def test_the_script_reads_every_key_by_its_name(example):
    keys = set(_keys(record_content(example.result, example.tables, example.structures)))
    assert len(keys) > 20
    assert {key for key in keys if not re.search(rf"\b{key}\b", SCRIPT)} == set()
