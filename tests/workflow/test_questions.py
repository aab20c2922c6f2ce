"""The questions that the page on tables answers in one line of pandas each, against the bare CSV files."""

import csv
import math
import re
import warnings
from collections import defaultdict
from pathlib import Path

import pytest

import rocking

ROOT = Path(rocking.__file__).parents[1]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def study(finished, tmp_path_factory):
    """The small study with a record that nothing survives, and one that cannot be read."""
    study = finished.copy_to(tmp_path_factory.mktemp("questions") / "study")
    study.add("hopeless", (ROOT / "records" / "synthetic_strong_pulse.AT2").read_bytes())
    study.add("broken", b"no record")
    study.run("--keep-going")
    return study


@pytest.fixture(scope="module")
def answers(study) -> list:
    """What each line of the page gives, in their order; a warning is a trap, and an error."""
    page = (ROOT / "docs" / "pages" / "tables.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```py\n(.*?)^```$", page, re.M | re.S)
    lines = [line for line in block.splitlines() if not line.startswith("#")]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        return [eval(line, {"results": rocking.open_results(study.results)}) for line in lines]


def cells(study, name: str) -> list[dict[str, str]]:
    with (study.results / "summary" / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_what_overturns(answers, study):
    expected = defaultdict(set)
    for row in cells(study, "ensemble"):
        if row["verdict"] == "overturns":
            expected[row["structure"]].add(row["record"])
    assert expected
    assert answers[0].to_dict() == {name: len(records) for name, records in expected.items()}


def test_what_is_undecided(answers, study):
    expected = [row for row in cells(study, "ensemble") if row["verdict"] == "undecided"]
    found = answers[1].to_dict("records")
    assert [(row["record"], row["structure"]) for row in found] == [
        (row["record"], row["structure"]) for row in expected
    ]
    assert all(0 < row["overturning_probability"] < 1 for row in found)


def test_every_structure_under_every_record(answers, study):
    rows = cells(study, "ensemble")
    assert answers[2].notna().all(axis=None)
    for row in rows:
        shares = [
            float(each["overturning_probability"])
            for each in rows
            if (each["record"], each["structure"]) == (row["record"], row["structure"])
        ]
        assert answers[2].loc[row["record"], row["structure"]] == max(shares)


def test_the_worst_record_counts(answers, study):
    largest = defaultdict(float)
    for row in cells(study, "ensemble"):
        name = row["structure"]
        largest[name] = max(largest[name], float(row["nominal_rotation_ratio"]))
    assert answers[3].to_dict() == largest
    assert math.inf in largest.values()


def test_how_often_the_closed_form_is_near(answers, study):
    found = defaultdict(list)
    for row in cells(study, "comparison"):
        if row["within_factor_two"]:
            found[row["structure"]].append(row["within_factor_two"] == "true")
    for name, near in found.items():
        assert answers[4][name] == pytest.approx(sum(near) / len(near))


def test_what_failed_says_why(answers):
    (failed,) = answers[5].to_dict("records")
    assert failed["record"] == "broken" and failed["message"]
