"""What was edited or damaged is computed again by the next run, byte for byte, and nothing else is."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

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


FIRST = ".made_from/outcomes/good_1.json"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("file", "damage", "again"),
    [
        (FIRST, _edited, ["batch", "summary"]),
        (FIRST, _cut, ["batch", "summary"]),
        (".made_from/batches/*.json", _emptied, ["batch", "batch", "summary"]),
        ("summary/verdicts.csv", _cut, ["summary"]),
        ("summary/comparison.csv", _edited, ["summary"]),
        (".made_from/summary.json", _removed, ["summary"]),
    ],
)
def test_what_was_damaged_is_computed_again(
    finished, tmp_path: Path, file: str, damage: Callable[[Path], None], again: list[str]
) -> None:
    study = finished.copy_to(tmp_path / "study")
    paths = list(study.results.glob(file))
    assert paths
    for path in paths:
        damage(path)
    before = {path: path.read_bytes() for path in study.results.rglob("*") if path.is_file()}
    told = study.run("--dry-run")
    assert kinds_of_jobs(told) == sorted(set(again)) and study.planned() == sorted(set(again)), (
        "a dry run is true"
    )
    assert {path: path.read_bytes() for path in before} == before, "and writes nothing"
    study.run()
    assert study.tables() == finished.tables()
    assert study.planned() == []


@pytest.fixture(scope="module")
def with_reports(start, tmp_path_factory):
    """A study of two records with reports, checks at a design level by its points, and the fragility, after its run."""
    study = start.copy_to(tmp_path_factory.mktemp("reports") / "study")
    study.write_catalogue(study.rows()[:2])
    folder = study.folder
    (folder / "design.csv").write_text(DESIGN)
    (folder / "hazard.csv").write_text("intensity,annual_rate\n0.01,0.1\n10,0.00001\n")
    settings = {
        "ensemble": {"members": 16, "reserve": 0},
        "design_spectrum": {"points": "design.csv", "stations": 1},
        "fragility": {"in_every_run": True, "hazard": "hazard.csv", "members": False},
    }
    (folder / "config.yaml").write_text(yaml.safe_dump(settings))
    study.run()
    return study


DESIGN = "period_s,acceleration_g\n0,0.2\n0.1,0.5\n0.5,0.5\n4,0.06\n"


def _everything(study) -> dict[str, bytes]:
    """The bytes of all that a study wrote, but for what is measured and what is remembered."""
    measured = {".made_from", "logs", "benchmarks"}
    files = (path for path in study.results.rglob("*") if path.is_file() and path.name != "timings.csv")
    found = {path.relative_to(study.results).as_posix(): path.read_bytes() for path in files}
    return {name: content for name, content in found.items() if not measured & set(name.split("/"))}


def _file(name: str, old: str, new: str) -> Callable:
    def edit(study) -> None:
        path = study.folder / name
        before = path.read_text()
        assert old in before
        path.write_text(before.replace(old, new))

    return edit


def _damaged(name: str) -> Callable:
    return lambda study: (study.results / name).write_bytes((study.results / name).read_bytes()[:-1])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("edit", "again"),
    [
        (_file("config.yaml", "ensemble:", "study: A town\nensemble:"), "checks record summary"),
        (_file("config.yaml", "stations: 1", "seed: 2\n  stations: 1"), "checks summary"),
        (_file("design.csv", "0.06", "0.05"), "checks record summary"),
        (_file("hazard.csv", "0.00001", "0.00002"), "fragility summary"),
        (_file("structures.yaml", "3.2", "3.3"), "checks fragility record summary"),
        (_damaged("summary/structures.pdf"), "checks summary"),
        (_damaged("good_1/comparison.csv"), "checks record summary"),
        (_damaged("fragility/fragility.csv"), "fragility summary"),
    ],
    ids=[
        "title",
        "seed of the sets",
        "design level",
        "hazard",
        "structure",
        "page to sign",
        "table",
        "curves",
    ],
)
def test_the_run_after_an_edit_equals_a_run_from_scratch(with_reports, tmp_path: Path, edit, again) -> None:
    study = with_reports.copy_to(tmp_path / "study")
    edit(study)
    assert " ".join(study.planned()) == again
    study.run()
    assert study.planned() == []
    scratch = study.copy_to(tmp_path / "scratch")
    shutil.rmtree(scratch.results)
    shutil.rmtree(scratch.folder / ".snakemake")
    scratch.run()
    assert _everything(study) == _everything(scratch)


@pytest.mark.slow
def test_a_damaged_report_and_a_table_beside_it_are_computed_again_and_told(with_reports, tmp_path) -> None:
    """With every setting the same, all bytes are, whenever it is written: but for the times."""
    study = with_reports.copy_to(tmp_path / "study")
    before = _everything(study)
    assert {path.rpartition("/")[2] for path in before} >= {"report.pdf", "summary.pdf", "study.html"}
    for file in ("good_1/report.pdf", "good_1/comparison.csv", "summary/summary.pdf"):
        _emptied(study.results / file)
        study.rocking("run", str(study.folder))
        log = (study.results / "summary" / "logs" / "run.log").read_text()
        assert f"results/{file} is not as it was written." in log
        assert _everything(study) == before


def test_a_file_of_one_record_is_made_when_it_is_asked_for_by_its_name(finished, tmp_path) -> None:
    """Also where the study makes no reports; and a name that is no record's is refused."""
    study = finished.copy_to(tmp_path / "study")
    told = study.run("results/good_2/comparison.csv")
    assert kinds_of_jobs(told) == ["record"]
    lines = (study.results / "good_2" / "comparison.csv").read_bytes().splitlines()[1:]
    assert lines == finished.rows_of("good_2")["comparison.csv"]
    assert study.planned("results/good_2/comparison.csv") == []
    _cut(study.results / "good_2" / "comparison.csv")
    assert study.planned("results/good_2/comparison.csv") == ["record"]
    assert "MissingRuleException" in study.run("--dry-run", "results/good_9/comparison.csv", status=1)


def test_results_of_another_version_are_computed_again_where_snakemake_remembers_nothing(
    finished, tmp_path
) -> None:
    study = finished.copy_to(tmp_path / "study")
    shutil.rmtree(study.folder / ".snakemake")
    assert study.planned() == []
    for path in (study.results / ".made_from").glob("[bs]*/*.json"):
        content = json.loads(path.read_text())
        path.write_text(json.dumps(content | {"made_from": {"the package": "0" * 64}}))
    table = study.results / "summary" / "verdicts.csv"
    table.write_text("record,column_of_another_version\n")
    study.run()
    assert study.tables() == finished.tables()
