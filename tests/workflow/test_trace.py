"""The trace of the job of one record, and the way of a record through the code that CONTRIBUTING tells."""

import re
from pathlib import Path

import pytest

from tests.benchmarks.trace_record import ROOT, traced

pytestmark = pytest.mark.process


@pytest.mark.slow
def test_the_job_enters_every_file_on_the_way_of_a_record(tmp_path: Path) -> None:
    contributing = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    way = contributing.partition("the path of a record from its file to page one")[2].partition("\n* ")[0]
    named = [file.removeprefix("rocking/") for file in re.findall(r"`(?!workflow)([\w/]+\.py)`", way)]
    assert len(named) > 8
    lines = traced(tmp_path).splitlines()
    assert set(named) <= set(lines), sorted(set(named) - set(lines))
    assert "    decide" in lines
