"""The folder of a study: nothing that a run writes, locks or deletes leads out of it, and nothing keeps it waiting."""

import fcntl
import os
from pathlib import Path

import pytest

from rocking.errors import ConfigurationError, RockingError
from rocking.study.cli import main
from rocking.study.contents import ContentHashes
from rocking.study.folder import check_own, locked, new_log, results_folder
from tests.refusals import refused

PIER = "- {name: pier, type: block, breadth_m: 2.0, height_m: 9.0}\n"
MINE = b"a file of the user\n"


@pytest.fixture
def study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A study of one record that has not been run, beside a folder of the user with one file; the test stands in it."""
    folder = tmp_path / "study"
    assert main(["start", str(folder)]) == 0
    (folder / "structures.yaml").write_text(PIER)
    (folder / "records" / "a.txt").write_text("0.0 0.1\n" * 50)
    (folder / "records" / "catalogue.csv").write_text("id,file,unit,time_step_s\na,a.txt,g,0.01\n")
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "mine.csv").write_bytes(MINE)
    monkeypatch.chdir(folder)
    return folder


def _everything(folder: Path) -> dict[Path, bytes]:
    return {path: path.read_bytes() for path in folder.rglob("*") if path.is_file()}


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
    "link",
    [
        ".snakemake", ".snakemake/rocking_run.lock", ".snakemake/rocking_jobs.lock", ".snakemake/log",
        "results", "results/a", "results/summary", "results/.kept", "results/.kept/contents.json",
        "results/summary/logs/run.log", "results/summary/benchmarks/assess_00000_of_00001.tsv",
        "results/summary/record.csv",
    ],
)  # fmt: skip
@pytest.mark.parametrize("target", ["folder", "file", "pipe"])
def test_a_link_or_a_pipe_is_refused_before_anything_is_written(
    study: Path, link: str, target: str, capsys: pytest.CaptureFixture[str]
) -> None:
    elsewhere = study.parent / "elsewhere"
    (study / link).parent.mkdir(parents=True, exist_ok=True)
    if target == "pipe":
        os.mkfifo(study / link)
    else:
        (study / link).symlink_to(elsewhere / "mine.csv" if target == "file" else elsewhere)
    before = _everything(study.parent)
    assert main(["run", str(study)]) == 2
    told = capsys.readouterr().err
    assert link in told and told.count("\n") == 1, told
    assert _everything(study.parent) == before


def test_a_log_replaces_what_stood_there_and_writes_through_no_link(tmp_path: Path) -> None:
    (tmp_path / "mine").write_bytes(MINE)
    for link in (os.symlink, os.link):
        (tmp_path / "run.log").unlink(missing_ok=True)
        link(tmp_path / "mine", tmp_path / "run.log")
        with new_log(tmp_path / "run.log") as stream:
            stream.write(b"begun")
        assert (tmp_path / "mine").read_bytes() == MINE and (tmp_path / "run.log").read_bytes() == b"begun"


def test_a_lock_is_a_file_of_its_own(tmp_path: Path) -> None:
    lock = tmp_path / "rocking_run.lock"
    handle = locked(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    with pytest.raises(BlockingIOError):
        locked(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    os.close(handle)
    os.close(locked(lock, fcntl.LOCK_EX | fcntl.LOCK_NB))
    lock.unlink()
    os.mkfifo(lock)
    with refused(ConfigurationError, "file", "rocking_run.lock"):
        locked(lock, fcntl.LOCK_SH)


def test_a_pipe_in_place_of_hashes_or_of_a_hazard_curve_keeps_nobody_waiting(tmp_path: Path) -> None:
    from rocking.fragility.hazard import Hazard

    os.mkfifo(tmp_path / "pipe")
    assert ContentHashes(tmp_path / "pipe").of(tmp_path / "pipe") == ""
    with refused(RockingError, "file", "pipe"):
        Hazard.read(tmp_path / "pipe")


def test_results_of_a_study_may_be_looked_through(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "results" / "summary").mkdir(parents=True)
    table = tmp_path / "results" / "summary" / "record.csv"
    table.touch()
    check_own(Path("results"))
    assert table.is_file()
    (table.parent / "linked.csv").symlink_to(table)
    with refused(ConfigurationError, "path", str(Path("results") / "summary" / "linked.csv")):
        check_own(Path("results"))
