"""What is read is told by its content: every edit is seen, and nothing else computes anything again."""

import hashlib
import os
import re
import time
from pathlib import Path

from rocking.records.synthetic import SyntheticRecord, at2_text

OTHER = at2_text(SyntheticRecord("other", 9, 4.0, 0.7, 1.0, 1.0, 6.0, 0.01)).encode()
LONG_AGO, IN_TEN_YEARS = 1e9, time.time() + 3e8


def _planned(study, *options: str) -> list[str]:
    done = study.run("--dry-run", *options)
    assert done.returncode == 0, done.stdout
    table = done.stdout.partition("Job stats:")[2].partition("\ntotal ")[0]
    return sorted(re.findall(r"(?m)^(assess|summarise|report)(?:_\w+)? +\d+ *$", table))


def test_a_record_that_changed_and_one_more_compute_their_own_jobs_only(finished, tmp_path: Path) -> None:
    """Whatever the date of the file; and what a folder of a record copied of its old tables goes."""
    study = finished.copy_to(tmp_path / "study")
    assert study.rocking("tables", str(study.results), "good_1").returncode == 0
    file, rows = study.folder / "records" / "good_1.txt", study.rows()
    file.write_bytes(OTHER)
    os.utime(file, (LONG_AGO, LONG_AGO))
    assert _planned(study) == ["assess", "summarise"]
    os.utime(file, (IN_TEN_YEARS, IN_TEN_YEARS))
    rows[0]["sha256"] = hashlib.sha256(OTHER).hexdigest()
    study.write_catalogue(rows)
    study.add_synthetic("good_4", 4)
    done = study.run()
    assert done.returncode == 0, done.stdout
    assert sum(map(int, re.findall(r"(?m)^assess\w* +(\d+) *$", done.stdout))) == 2, done.stdout
    assert study.rows_of("good_1")["record.csv"] != finished.rows_of("good_1")["record.csv"]
    for name in ("good_2", "good_3"):
        assert finished.rows_of(name)["comparison.csv"] and study.rows_of(name) == finished.rows_of(name)
    assert b"good_4" in study.tables()["summary/comparison.csv"]
    assert not list((study.results / "good_1").iterdir()), "a copy of its tables would say something else"
    assert _planned(study) == [], "the second run has nothing to do, in ten years as now"


def test_a_dry_run_changes_nothing_and_a_run_in_other_jobs_fills_in_the_hash(
    finished, tmp_path: Path
) -> None:
    """Jobs of another size leave no row twice."""
    study = finished.copy_to(tmp_path / "study")
    rows = study.rows()
    study.write_catalogue([row | {"sha256": ""} for row in rows])

    def contents() -> dict[Path, bytes]:
        """Of all but what snakemake keeps for itself."""
        own = (path for path in study.folder.rglob("*") if ".snakemake" not in path.parts)
        return {path: path.read_bytes() for path in own if path.is_file()}

    before = contents()
    told = study.rocking("run", str(study.folder), "--", "--dry-run")
    assert told.returncode == 0, told.stderr
    assert contents() == before
    done = study.run("--config", "records_per_job=3")
    assert done.returncode == 0, done.stdout
    assert study.rows() == rows
    assert [path.name for path in (study.results / "summary" / "jobs").iterdir()] == ["00000_of_00001"]
    for name in ("good_1", "good_2", "good_3"):
        assert study.rows_of(name) == finished.rows_of(name)
    path = "summary/comparison.csv"
    assert study.tables()[path] == finished.tables()[path], "in the order of the catalogue"
    assert _planned(study, "--config", "records_per_job=3") == []


def test_a_date_a_comment_or_other_line_ends_compute_nothing_and_a_number_everything(
    finished, tmp_path: Path
) -> None:
    study = finished.copy_to(tmp_path / "study")
    structures = study.folder / "structures.yaml"
    structures.write_text("# the old pier\n" + structures.read_text())
    catalogue = study.folder / "records" / "catalogue.csv"
    for path in (study.folder / "config.yaml", structures, catalogue):
        lines = path.read_bytes().splitlines()
        path.write_bytes(b"\r\n".join([*lines, b""]))
    assert _planned(study) == []
    catalogue.write_bytes(b"\n".join([*catalogue.read_bytes().splitlines(), b""]))
    os.utime(structures, (IN_TEN_YEARS, IN_TEN_YEARS))
    for name in ("good_1.txt", "catalogue.csv"):
        os.utime(study.folder / "records" / name, (LONG_AGO, LONG_AGO))
    assert _planned(study) == []
    structures.write_text(structures.read_text().replace("3.2", "3.3"))
    assert _planned(study) == ["assess"] * 2 + ["summarise"]


def test_a_list_of_structures_edited_while_a_study_runs_stops_it(finished, tmp_path: Path) -> None:
    """The job looks again, so that no two lists mix under one hash."""
    study = finished.copy_to(tmp_path / "study")
    study.add_synthetic("good_4", 4)
    structures = study.folder / "structures.yaml"
    script = study.tree / "workflow" / "scripts" / "assess.py"
    source, status = script.read_text(), script.stat()
    edit = "from pathlib import Path\np = Path('structures.yaml')\np.write_text(p.read_text().replace('3.2', '3.3'))\n"
    try:
        script.write_text(edit + source)
        done = study.run("--rerun-triggers", "params")
    finally:
        script.write_text(source)
        os.utime(script, ns=(status.st_atime_ns, status.st_mtime_ns))
    assert done.returncode != 0
    assert "structures.yaml: the file changed while the study ran" in done.stdout
    assert "3.3" in structures.read_text()
    assert study.tables() == finished.tables()


def test_a_study_of_broken_records_only_has_failed(start, tmp_path: Path) -> None:
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue([])
    for name in ("one", "two"):
        study.add(name, name.encode())
    done = study.run("--config", "records_per_job=2")
    assert done.returncode == 1
    assert "none of 2 records could be read" in done.stdout
    assert (study.results / "summary" / "failures.csv").read_text().count("\n") == 3, "the tables say why"
