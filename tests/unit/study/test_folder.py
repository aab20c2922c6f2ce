"""The folder of the results lies inside the study."""

import os
from pathlib import Path

import pytest

from rocking.errors import ConfigurationError, RockingError
from rocking.study.cli import main
from rocking.study.folder import results_folder
from tests.refusals import refused

PIER = "- {name: pier, type: block, breadth_m: 2.0, height_m: 9.0}\n"


@pytest.fixture
def study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A study of one record that has not been run; the test stands in it."""
    folder = tmp_path / "study"
    assert main(["start", str(folder)]) == 0
    (folder / "structures.yaml").write_text(PIER)
    (folder / "records" / "a.txt").write_text("0.0 0.1\n" * 50)
    (folder / "records" / "catalogue.csv").write_text("id,file,unit,time_step_s\na,a.txt,g,0.01\n")
    monkeypatch.chdir(folder)
    return folder


@pytest.mark.parametrize(
    "name",
    [
        "../outside", "/tmp/outside", ".", "a/../..", "results\nimport os", "res{ults}", "res;ults", "'results'",
        ".git", "-results", "records", "r" * 201,
    ],
)  # fmt: skip
def test_results_lie_in_a_plain_folder_of_their_own_inside_the_study(study: Path, name: str) -> None:
    with refused(ConfigurationError, "results"):
        results_folder(name, "records/catalogue.csv")


@pytest.mark.parametrize("name", ["results", "out/second try (2)", "Ergebnisse_für_März"])
def test_a_plain_folder_inside_is_allowed_by_whatever_path(study: Path, name: str) -> None:
    assert results_folder(name) == results_folder(str(study / name)) == Path(name)


@pytest.mark.parametrize(
    "link", [".snakemake", ".snakemake/log", "results", "results/a", "results/summary/a.csv"]
)
@pytest.mark.parametrize("target", ["folder", "file"])
def test_a_link_that_leads_out_of_the_study_is_refused_before_anything_is_written(
    study: Path, link: str, target: str, capsys: pytest.CaptureFixture[str]
) -> None:
    elsewhere = study.parent / "elsewhere"
    elsewhere.mkdir()
    (elsewhere / "mine.csv").write_bytes(b"a file of the user")
    (study / link).parent.mkdir(parents=True, exist_ok=True)
    (study / link).symlink_to(elsewhere / "mine.csv" if target == "file" else elsewhere)
    assert main(["run", str(study)]) == 2
    told = capsys.readouterr().err
    assert link in told and told.count("\n") == 1, told
    assert [path.read_bytes() for path in elsewhere.rglob("*")] == [b"a file of the user"]


def test_a_pipe_in_place_of_a_hazard_curve_keeps_nobody_waiting(tmp_path: Path) -> None:
    from rocking.fragility.hazard import Hazard

    os.mkfifo(tmp_path / "pipe")
    with refused(RockingError, "file", "pipe"):
        Hazard.read(tmp_path / "pipe")
