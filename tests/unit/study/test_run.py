"""The exit status of a run, with what snakemake ends with set by hand."""

import errno
import fcntl
import os

import pytest

from rocking.assessment.rows import FailureRow
from rocking.study import run as module
from rocking.study.kept import Kept, keep
from rocking.study.outputs import kept_of
from tests.unit.assessment.made_rows import failure


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A study of one record and one structure, of which no job runs."""
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "own.txt").write_text("0.0 0.1\n")
    (tmp_path / "records" / "catalogue.csv").write_text("id,file\nown,own.txt\n")
    (tmp_path / "structures.yaml").write_text("- {name: pier, type: block, breadth_m: 1, height_m: 4}\n")
    (tmp_path / "config.yaml").write_text("")
    monkeypatch.setattr(module, "warm_up", lambda settings: None)
    return tmp_path


@pytest.mark.parametrize(
    ("ended", "options", "failures", "status"),
    [
        (0, [], 0, 0),
        (0, [], 2, 1),
        (0, ["trade"], 1, 1),
        (1, [], 0, 1),
        (3, [], 0, 1),
        (1, ["summary"], 0, 1),
        (0, ["--until", "read"], 1, 0),
    ],
)
def test_the_status_of_a_run_is_that_of_its_jobs_and_of_what_failed(
    study, monkeypatch, capsys, ended, options, failures, status
):
    monkeypatch.setattr(module, "_snakemake", lambda arguments: ended)
    made = Kept({FailureRow: [failure("")] * failures}, lines=["what came of it"], opened=["a.pdf", "b.pdf"])
    target = "trade" if options == ["trade"] else "summary"
    keep(kept_of(study / "results", target), made)
    assert module.run(study, options) == status
    told = capsys.readouterr().out
    shown = not ended and "--until" not in options
    assert ("what came of it" in told) == (f"Open    {study / 'results' / 'a.pdf'}" in told) == shown
    assert (f"--until read; what it wrote lies in {study / 'results'}" in told) == ("--until" in options)


@pytest.mark.parametrize("ended", [None, 0, 5])
def test_the_status_of_snakemake_is_handed_on(monkeypatch, ended):
    def main(arguments):
        if ended is not None:
            raise SystemExit(ended)

    monkeypatch.setattr("snakemake.cli.main", main)
    assert module._snakemake([]) == (ended or 0)


def test_two_runs_at_once_are_refused_and_what_was_killed_is_unlocked(tmp_path):
    left = tmp_path / ".snakemake" / "locks" / "0.input.lock"
    left.parent.mkdir(parents=True)
    for path in (left, tmp_path / module._LOCK):
        path.touch()
    with module._alone(tmp_path):
        assert not left.exists()
        with pytest.raises(module.RockingError, match="another run works"), module._alone(tmp_path):
            pass


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOSYS])
def test_a_file_system_without_locks_is_a_warning(study, monkeypatch, capsys, number):
    def refuse(*_):
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", refuse)
    monkeypatch.setattr(module, "_snakemake", lambda arguments: 0)
    keep(kept_of(study / "results", "summary"), Kept({FailureRow: []}))
    assert module.run(study, []) == 0
    assert f"not locked, {os.strerror(number)}" in capsys.readouterr().out
