"""The workflow as a user meets it: a whole run, a second one, an edit, a record more."""

import csv
import json
import re
import subprocess
import sys
from pathlib import Path

import pytest


def test_a_run_compares_every_record_with_every_structure(finished) -> None:
    with (finished.results / "summary" / "comparison.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert {row["record"] for row in rows} == {"good_1", "good_2", "good_3"}
    assert {row["structure"] for row in rows} == {"block", "wall"}
    assert (finished.results / "summary" / "failures.csv").read_text().count("\n") == 1, "only the head"
    assert not finished.unfinished()


def test_every_described_file_stands_and_has_the_described_columns(finished) -> None:
    for folder in (finished.results, finished.results / "summary"):
        package = json.loads((folder / "datapackage.json").read_text())
        for resource in package["resources"]:
            paths = resource["path"] if isinstance(resource["path"], list) else [resource["path"]]
            names = [field["name"] for field in resource["schema"]["fields"]]
            for path in paths:
                with (folder / path).open(newline="") as stream:
                    assert next(csv.reader(stream)) == names, path


@pytest.mark.parametrize(
    ("edited", "again"),
    [("motion/nonlinear_kernel.py", ["assess"] * 2 + ["summarise"]), ("reports/record.py", [])],
    ids=["numbers", "appearance"],
)
def test_an_edit_of_the_package_runs_again_what_depends_on_it(finished, edited, again) -> None:
    path = finished.tree / "rocking" / edited
    source = path.read_bytes()
    try:
        path.write_bytes(source + b"# edited\n")
        assert finished.planned() == again
    finally:
        path.write_bytes(source)


def test_kernels_are_compiled_once_until_their_folder_is_edited(finished) -> None:
    """Beside them stands what was compiled. The file that is edited here holds none, so that this takes seconds."""
    folder = finished.tree / "rocking" / "motion"
    (stamp,) = (folder / "__pycache__").glob("*.compiled")

    def compiles() -> bool:
        before = stamp.stat().st_mtime_ns
        call = "from rocking.assessment.compilation import compile_all; compile_all()"
        subprocess.run([sys.executable, "-c", call], check=True, **finished.surroundings)
        return stamp.stat().st_mtime_ns != before

    assert not compiles()
    source = (folder / "members.py").read_bytes()
    try:
        (folder / "members.py").write_bytes(source + b"# edited\n")
        assert compiles() and not compiles()
    finally:
        (folder / "members.py").write_bytes(source)


def test_what_the_settings_ask_for_is_waited_for(finished) -> None:
    """The graph is built from the settings alone, whatever lies in the results."""
    settings = ("reports=true", "trade={in_summary: true}", "fragility={in_every_run: true}")
    told = finished.run("--dry-run", "--config", *settings)
    for rule in ("summarise", "trade", "fragility"):
        assert re.search(rf"(?m)^{rule} +1 *$", told), told
    (reason,) = re.findall(r": Summarise all records\nReason: (.*)", told)
    assert "fragility/fragility.csv" in reason, told


def test_the_page_takes_up_fragility_where_it_was_measured(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    (study.results / "fragility").mkdir()
    (study.results / "fragility" / "fragility.csv").write_text("measured since\n", encoding="utf-8")
    assert study.planned() == ["summarise"]
