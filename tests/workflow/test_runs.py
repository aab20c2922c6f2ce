"""The workflow as a user meets it: a whole run, and after an edit or a record more what that alone changes."""

import csv
import hashlib
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rocking.study.outputs import STEPS
from tests.synthetic import SyntheticRecord, at2_text

OTHER = at2_text(SyntheticRecord(name="other", seed=9, pulse_period=0.7)).encode()
LONG_AGO, IN_TEN_YEARS = 1e9, time.time() + 3e8


def test_a_run_compares_every_record_with_every_structure(finished) -> None:
    with (finished.results / "summary" / "comparison.csv").open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    assert {row["record"] for row in rows} == {"good_1", "good_2", "good_3"}
    assert {row["structure"] for row in rows} == {"block", "wall"}
    assert (finished.results / "summary" / "failures.csv").read_text().count("\n") == 1, "only the head"
    assert not finished.unfinished()


def test_every_described_file_stands_and_has_the_described_columns(finished) -> None:
    folder = finished.results / "summary"
    package = json.loads((folder / "datapackage.json").read_text())
    described = {resource["path"]: resource["schema"]["fields"] for resource in package["resources"]}
    assert set(described) == {path.name for path in folder.glob("*.csv")}
    for path, fields in described.items():
        with (folder / path).open(newline="") as stream:
            assert next(csv.reader(stream)) == [field["name"] for field in fields], path


@pytest.mark.slow
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
    source = (folder / "response.py").read_bytes()
    try:
        (folder / "response.py").write_bytes(source + b"# edited\n")
        assert compiles() and not compiles()
    finally:
        (folder / "response.py").write_bytes(source)


def test_what_the_settings_ask_for_is_waited_for(finished) -> None:
    """The graph is built from the settings alone, whatever lies in the results."""
    settings = ("reports=true", "trade={in_summary: true}", "fragility={in_every_run: true}")
    told = finished.run("--dry-run", "--config", *settings)
    for rule in ("summary", "trade", "fragility"):
        assert re.search(rf"(?m)^{rule} +1 *$", told), told
    (reason,) = re.findall(r"summary: all records\nReason: (.*)", told)
    assert "results/fragility/fragility.csv" in reason, told


def test_a_record_that_changed_and_one_more_compute_their_own_jobs_only(finished, tmp_path: Path) -> None:
    """Whatever the date of the file."""
    study = finished.copy_to(tmp_path / "study")
    file, rows = study.folder / "records" / "good_1.txt", study.rows()
    file.write_bytes(OTHER)
    os.utime(file, (LONG_AGO, LONG_AGO))
    assert study.planned() == [*sorted(STEPS), "summary"]
    os.utime(file, (IN_TEN_YEARS, IN_TEN_YEARS))
    rows[0]["sha256"] = hashlib.sha256(OTHER).hexdigest()
    study.write_catalogue(rows)
    study.add_synthetic("good_4", 4)
    assert sum(map(int, re.findall(r"(?m)^read +(\d+) *$", study.run()))) == 2
    assert study.rows_of("good_1")["record.csv"] != finished.rows_of("good_1")["record.csv"]
    for name in ("good_2", "good_3"):
        assert finished.rows_of(name)["comparison.csv"] and study.rows_of(name) == finished.rows_of(name)
    assert b"good_4" in study.tables()["summary/comparison.csv"]
    assert study.planned() == [], "the second run has nothing to do, in ten years as now"


@pytest.mark.slow
def test_a_dry_run_changes_nothing(finished, tmp_path) -> None:
    study = finished.copy_to(tmp_path / "study")

    def contents() -> dict[Path, bytes]:
        """Of all but what snakemake keeps for itself."""
        own = (path for path in study.folder.rglob("*") if ".snakemake" not in path.parts)
        return {path: path.read_bytes() for path in own if path.is_file()}

    before = contents()
    study.rocking("run", str(study.folder), "--", "--dry-run")
    assert contents() == before


def test_a_date_a_comment_or_line_ends_compute_nothing_and_a_number_everything(finished, tmp_path) -> None:
    study = finished.copy_to(tmp_path / "study")
    structures = study.folder / "structures.yaml"
    structures.write_text("# the old pier\n" + structures.read_text())
    catalogue = study.folder / "records" / "catalogue.csv"
    line_ends = {study.folder / "config.yaml": b"\r\n", structures: b"\r\n", catalogue: b"\n"}
    for path, line_end in line_ends.items():
        before = path.read_bytes()
        path.write_bytes(line_end.join([*before.splitlines(), b""]))
        assert path.read_bytes() != before, "each had the other line ends"
    os.utime(structures, (IN_TEN_YEARS, IN_TEN_YEARS))
    for name in ("good_1.txt", "catalogue.csv"):
        os.utime(study.folder / "records" / name, (LONG_AGO, LONG_AGO))
    assert study.planned() == []
    structures.write_text(structures.read_text().replace("3.2", "3.3"))
    assert study.planned() == ["integrate", "predict", "report", "summary"]


@pytest.mark.slow
def test_a_study_of_broken_records_only_has_failed(start, tmp_path: Path) -> None:
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue([])
    for name in ("one", "two"):
        study.add(name, name.encode())
    told = study.rocking("run", str(study.folder), status=1).stdout
    assert "2 records failed, wholly or in part: one, two; the first: " in told
    assert (study.results / "summary" / "failures.csv").read_text().count("\n") == 3, "the tables say why"
