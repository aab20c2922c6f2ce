"""The workflow as a user meets it: a whole run, a second one, an edit, a record more."""

import csv
import json
import re
from pathlib import Path

import pytest

from rocking.assessment.rows.of_folder import PER_RECORD


def test_a_run_makes_every_table_of_every_record(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    for number in (1, 2, 3):
        done = study.rocking("tables", str(study.results), f"good_{number}")
        assert done.returncode == 0, done.stderr
        folder = study.results / f"good_{number}"
        for table in (each.table for each in PER_RECORD):
            with (folder / table.file_name).open(newline="") as stream:
                assert {row["record"] for row in csv.DictReader(stream)} <= {f"good_{number}"}
        assert (folder / "maxima.csv").read_text().count("\n") > 2
    with (finished.results / "summary" / "maxima.csv").open(newline="") as stream:
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


def test_a_second_run_does_nothing(finished) -> None:
    before = {path: path.stat().st_mtime_ns for path in finished.results.rglob("*")}
    done = finished.run()
    assert done.returncode == 0
    assert "Nothing to be done" in done.stdout
    assert before == {path: path.stat().st_mtime_ns for path in finished.results.rglob("*")}


@pytest.mark.parametrize(
    ("edited", "again"),
    [("motion/nonlinear_kernel.py", ["assess"] * 2 + ["summarise"]), ("reports/record.py", [])],
    ids=["numbers", "appearance"],
)
def test_an_edit_of_the_package_runs_again_what_depends_on_it(
    finished, edited: str, again: list[str]
) -> None:
    path = finished.tree / "rocking" / edited
    source = path.read_bytes()
    try:
        path.write_bytes(source + b"# edited\n")
        done = finished.run("--dry-run")
    finally:
        path.write_bytes(source)
    assert done.returncode == 0, done.stdout
    assert _jobs(done.stdout) == again, done.stdout


def test_a_record_more_computes_its_own_job_only(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    before = {name: study.rows_of(name) for name in ("good_1", "good_2", "good_3")}
    study.add_synthetic("good_4", 4)
    done = study.run()
    assert done.returncode == 0, done.stdout
    assert _jobs(done.stdout) == ["assess", "summarise"], done.stdout
    assert all(rows["maxima.csv"] for rows in before.values())
    assert {name: study.rows_of(name) for name in before} == before
    assert b"good_4" in study.tables()["summary/maxima.csv"]


def test_jobs_of_another_size_leave_no_row_twice(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    before = {name: study.rows_of(name) for name in ("good_1", "good_2", "good_3")}
    done = study.run("--config", "records_per_job=3")
    assert done.returncode == 0, done.stdout
    assert [path.name for path in (study.results / "summary" / "jobs").iterdir()] == ["00000_of_00001"]
    assert {name: study.rows_of(name) for name in before} == before
    for name in ("comparison.csv", "maxima.csv"):
        path = f"summary/{name}"
        assert study.tables()[path] == finished.tables()[path], "in the order of the catalogue"


def test_what_the_settings_ask_for_is_waited_for(finished) -> None:
    """The graph is built from the settings alone, whatever lies in the results."""
    settings = ("reports=true", "trade={in_summary: true}", "fragility={in_every_run: true}")
    for asked in (1, 3):
        told = finished.run("--dry-run", "--config", *settings[:asked]).stdout
        assert re.search(r"(?m)^summarise +1 *$", told), told
        for rule in ("trade", "fragility"):
            assert bool(re.search(rf"(?m)^{rule} +1 *$", told)) == (asked == 3), told
        (reason,) = re.findall(r": Summarise all records\nReason: (.*)", told)
        assert ("fragility/fragility.csv" in reason) == (asked == 3), told


def test_the_page_takes_up_fragility_where_it_was_measured(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    assert "Nothing to be done" in study.run("--dry-run").stdout
    (study.results / "fragility").mkdir()
    (study.results / "fragility" / "fragility.csv").write_text("measured since\n", encoding="utf-8")
    told = study.run("--dry-run").stdout
    assert (
        re.search(r"(?m)^summarise +1 *$", told)
        and not re.search(r"(?m)^assess", told)
        and not re.search(r"(?m)^fragility +1 *$", told)
    ), told


def _jobs(output: str) -> list[str]:
    """The kinds of jobs in the table that snakemake prints before a run, without the target."""
    table = output.partition("Job stats:")[2].partition("\ntotal ")[0]
    return sorted(re.findall(r"(?m)^(assess|summarise|report)(?:_\w+)? +\d+ *$", table))
