"""What the page to explore is told of one record: the numbers of its tables, rounded for JSON."""

import json
import math
import re
from pathlib import Path

import pytest

import rocking
from rocking.reports.explore import cells_of, record_content, record_script

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
