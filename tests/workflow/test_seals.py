"""What was finished and then damaged is made again by the next run, byte for byte, and nothing else is."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.workflow.conftest import kinds_of_jobs


def _emptied(path: Path) -> None:
    path.write_bytes(b"")


def _cut(path: Path) -> None:
    lines = path.read_bytes().splitlines(keepends=True)
    path.write_bytes(b"".join(lines[:-1]))


def _edited(path: Path) -> None:
    """A digit, and the size stays."""
    content = path.read_bytes()
    place = max(content.rfind(digit) for digit in (b"1", b"2", b"3", b"4"))
    path.write_bytes(content[:place] + b"7" + content[place + 1 :])


def _removed(path: Path) -> None:
    path.unlink()


JOB = "summary/jobs/00000_of_00002"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "damage", "again"),
    [
        (f"{JOB}/comparison.csv", _edited, ["assess", "summarise"]),
        (f"{JOB}/seal.json", _edited, ["assess", "summarise"]),
        (f"{JOB}/seal.json", _cut, ["assess", "summarise"]),
        (f"{JOB}/record.csv", _removed, ["assess", "summarise"]),
        ("summary/verdicts.csv", _cut, ["summarise"]),
        ("summary/comparison.csv", _edited, ["summarise"]),
        ("summary/seal.json", _removed, ["summarise"]),
    ],
)
def test_what_was_damaged_is_made_again(
    finished, tmp_path: Path, file: str, damage: Callable[[Path], None], again: list[str]
) -> None:
    study = finished.copy_to(tmp_path / "study")
    jobs = sorted(path.name for path in (study.results / "summary" / "jobs").iterdir())
    path = study.results / file.replace("00000_of_00002", jobs[0])
    damage(path)
    assert kinds_of_jobs(study.run()) == again
    assert study.tables() == finished.tables()
    assert study.planned() == []


@pytest.mark.slow
def test_a_damaged_report_and_a_table_beside_it_are_made_again_and_told(start, tmp_path) -> None:
    """With every setting the same, all bytes are, whenever it is made: but for the times."""
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue(study.rows()[:1])
    (study.folder / "config.yaml").write_text("ensemble: {members: 16}\n")
    study.rocking("run", str(study.folder))

    def everything() -> dict[Path, bytes]:
        files = (path for path in study.results.rglob("*") if path.is_file() and path.name != "timings.csv")
        return {path: path.read_bytes() for path in files if not {"logs", "benchmarks"} & set(path.parts)}

    before = everything()
    assert {path.name for path in before} >= {"report.pdf", "summary.pdf", "study.html", "comparison.csv"}
    for file in ("good_1/report.pdf", "good_1/comparison.csv", "summary/summary.pdf"):
        _emptied(study.results / file)
        told = study.rocking("run", str(study.folder)).stdout
        assert f"results: results/{file} is not as it was written; it is made again.\n" in told
        after = everything()
        assert [path for path in before if after[path] != before[path]] == []
    assert "made again" not in study.rocking("run", str(study.folder)).stdout


def test_results_of_another_version_are_made_again_where_snakemake_remembers_nothing(
    finished, tmp_path
) -> None:
    study = finished.copy_to(tmp_path / "study")
    shutil.rmtree(study.folder / ".snakemake")
    assert study.planned() == []
    for path in (study.results / "summary").rglob("seal.json"):
        content = json.loads(path.read_text())
        path.write_text(json.dumps(content | {"made_from": "0" * 64}))
    table = study.results / "summary" / "verdicts.csv"
    table.write_text("record,column_of_another_version\n")
    assert kinds_of_jobs(study.run()) == ["assess"] * 2 + ["summarise"]
    assert study.tables() == finished.tables()
