"""What is read is told by its content: every edit is seen, and nothing else computes anything again."""

import hashlib
import os
import re
import time
from pathlib import Path

from rocking.records.synthetic import SyntheticRecord, at2_text

OTHER = at2_text(SyntheticRecord("other", 9, 4.0, 0.7, 1.0, 1.0, 6.0, 0.01)).encode()
LONG_AGO, IN_TEN_YEARS = 1e9, time.time() + 3e8


def test_a_record_that_changed_and_one_more_compute_their_own_jobs_only(finished, tmp_path: Path) -> None:
    """Whatever the date of the file; and what a folder of a record copied of its old tables goes."""
    study = finished.copy_to(tmp_path / "study")
    study.rocking("tables", str(study.results), "good_1")
    file, rows = study.folder / "records" / "good_1.txt", study.rows()
    file.write_bytes(OTHER)
    os.utime(file, (LONG_AGO, LONG_AGO))
    assert study.planned() == ["assess", "summarise"]
    os.utime(file, (IN_TEN_YEARS, IN_TEN_YEARS))
    rows[0]["sha256"] = hashlib.sha256(OTHER).hexdigest()
    study.write_catalogue(rows)
    study.add_synthetic("good_4", 4)
    assert sum(map(int, re.findall(r"(?m)^assess\w* +(\d+) *$", study.run()))) == 2
    assert study.rows_of("good_1")["record.csv"] != finished.rows_of("good_1")["record.csv"]
    for name in ("good_2", "good_3"):
        assert finished.rows_of(name)["comparison.csv"] and study.rows_of(name) == finished.rows_of(name)
    assert b"good_4" in study.tables()["summary/comparison.csv"]
    assert not list((study.results / "good_1").iterdir()), "a copy of its tables would say something else"
    assert study.planned() == [], "the second run has nothing to do, in ten years as now"


def test_a_dry_run_changes_nothing_and_a_run_in_other_jobs_fills_in_the_hash(finished, tmp_path) -> None:
    """Jobs of another size leave no row twice."""
    study = finished.copy_to(tmp_path / "study")
    rows = study.rows()
    study.write_catalogue([row | {"sha256": ""} for row in rows])

    def contents() -> dict[Path, bytes]:
        """Of all but what snakemake keeps for itself."""
        own = (path for path in study.folder.rglob("*") if ".snakemake" not in path.parts)
        return {path: path.read_bytes() for path in own if path.is_file()}

    before = contents()
    study.rocking("run", str(study.folder), "--", "--dry-run")
    assert contents() == before
    study.run("--config", "records_per_job=3")
    assert study.rows() == rows
    assert [path.name for path in (study.results / "summary" / "jobs").iterdir()] == ["00000_of_00001"]
    for name in ("good_1", "good_2", "good_3"):
        assert study.rows_of(name) == finished.rows_of(name)
    path = "summary/comparison.csv"
    assert study.tables()[path] == finished.tables()[path], "in the order of the catalogue"
    assert study.planned("--config", "records_per_job=3") == []


def test_a_date_a_comment_or_other_line_ends_compute_nothing_and_a_number_everything(
    finished, tmp_path
) -> None:
    study = finished.copy_to(tmp_path / "study")
    structures = study.folder / "structures.yaml"
    structures.write_text("# the old pier\n" + structures.read_text())
    catalogue = study.folder / "records" / "catalogue.csv"
    for path in (study.folder / "config.yaml", structures, catalogue):
        lines = path.read_bytes().splitlines()
        path.write_bytes(b"\r\n".join([*lines, b""]))
    assert study.planned() == []
    catalogue.write_bytes(b"\n".join([*catalogue.read_bytes().splitlines(), b""]))
    os.utime(structures, (IN_TEN_YEARS, IN_TEN_YEARS))
    for name in ("good_1.txt", "catalogue.csv"):
        os.utime(study.folder / "records" / name, (LONG_AGO, LONG_AGO))
    assert study.planned() == []
    structures.write_text(structures.read_text().replace("3.2", "3.3"))
    assert study.planned() == ["assess"] * 2 + ["summarise"]


def test_a_study_of_broken_records_only_has_failed(start, tmp_path: Path) -> None:
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue([])
    for name in ("one", "two"):
        study.add(name, name.encode())
    assert "none of 2 records could be read" in study.run("--config", "records_per_job=2", status=1)
    assert (study.results / "summary" / "failures.csv").read_text().count("\n") == 3, "the tables say why"
