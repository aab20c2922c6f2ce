"""The questions that the page on tables answers in one line of pandas each, against the bare CSV files."""

import ast
import csv
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


def cells(study, name: str) -> list[dict[str, str]]:
    with (study.results / "summary" / f"{name}.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_every_line_of_the_page_answers_its_question(study):
    """A warning is an error; what overturns, what is uncertain and what failed are counted again in the bare files."""
    page = (ROOT / "docs" / "pages" / "tables.md").read_text(encoding="utf-8")
    (block,) = re.findall(r"^```py\n(.*?)^```$", page, re.M | re.S)
    lines = map(ast.unparse, ast.parse(block).body)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        answers = [eval(line, {"results": rocking.open_results(study.results)}) for line in lines]
    falls = defaultdict(set)
    for row in cells(study, "verdicts"):
        if row["verdict"] == "overturns":
            falls[row["structure"]].add(row["record"])
    assert falls and answers[0].to_dict() == {name: len(records) for name, records in falls.items()}
    uncertain = [row["record"] for row in cells(study, "verdicts") if row["verdict"] == "uncertain"]
    assert list(answers[1]["record"]) == uncertain
    assert answers[2].notna().all(axis=None)
    (failure,) = answers[-1].to_dict("records")
    assert failure["record"] == "broken" and failure["message"]
