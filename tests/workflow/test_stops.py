"""Ctrl-C, a request to end, a kill, and two runs at once: each in order, each one command away from going on."""

import os
import random
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import psutil
import pytest

from rocking.assessment.decide import ORDER

KILLS = int(os.environ.get("ROCKING_KILLS", "1"))
"""How many runs are killed; ROCKING_KILLS=20 takes some minutes."""


def _jobs_run(study) -> bool:
    return any((study.folder / ".snakemake" / "incomplete").glob("*"))


def _record_is_done(study) -> bool:
    return any(log.stat().st_size for log in study.results.glob("summary/logs/report/*.log"))


@contextmanager
def _started(study, *command: str, until: Callable[..., bool] = _jobs_run) -> Iterator[subprocess.Popen[str]]:
    """A run in a process group of its own, by `rocking run` or another command, from `until` on.

    In the end the command and all its jobs are killed, as a power cut would.
    """
    ours = (sys.executable, "-m", "rocking.study.cli", "run", str(study.folder))
    surroundings = study.surroundings | {"cwd": study.tree}
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    process = subprocess.Popen(command or ours, start_new_session=True, **streams, **surroundings)
    try:
        deadline = time.monotonic() + 300
        while not until(study):
            assert process.poll() is None, process.communicate()[0]
            assert time.monotonic() < deadline
            time.sleep(0.02)
        yield process
    finally:
        with suppress(ProcessLookupError):
            os.killpg(process.pid, signal.SIGKILL)
        process.wait(timeout=100)
        process.stdout.close()


def _is_gone(group: int) -> bool:
    """Whether no process of a group is left after a while."""
    deadline = time.monotonic() + 30
    while time.monotonic() < deadline:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


ON_DEMAND = pytest.mark.slow


@pytest.mark.parametrize(
    ("number", "everybody"),
    [
        pytest.param(signal.SIGINT, True, id="Ctrl-C"),
        pytest.param(signal.SIGTERM, False, id="request", marks=ON_DEMAND),
    ],
)
def test_a_request_to_stop_leaves_nothing_half_written_and_the_same_command_goes_on(
    finished, start, tmp_path: Path, number: int, everybody: bool
) -> None:
    study = start.copy_to(tmp_path / "study")
    with _started(study) as process:
        (os.killpg if everybody else os.kill)(process.pid, number)
        told = process.communicate(timeout=300)[0]
        assert process.returncode and f"go on: rocking run {study.folder}" in told, told
        assert not study.unfinished() and not (study.results / "summary" / "provenance.json").exists()
        assert _is_gone(process.pid), "the process that jobs are forked from ends with the scheduler"
    study.rocking("run", str(study.folder))
    assert study.tables() == finished.tables()


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_job_that_is_ended_is_named_with_its_cause_and_the_next_run_goes_on(
    finished, start, tmp_path: Path, number: int
) -> None:
    study = start.copy_to(tmp_path / "study")
    with _started(study, until=lambda study: any(study.results.glob("summary/logs/report/*.log"))) as process:
        run = psutil.Process(process.pid)
        job = next(job for child in run.children() for job in child.children())
        job.send_signal(number)
        told = process.communicate(timeout=300)[0]
    cause = "was ended by SIGKILL" if number == signal.SIGKILL else "ended with status 1"
    log = (study.results / "summary" / "logs" / "run.log").read_text()
    assert process.returncode == 1 and f"its process {cause}" in told + log, told + log
    study.rocking("run", str(study.folder))
    assert study.tables() == finished.tables() and not study.unfinished()


def test_after_a_kill_the_same_command_goes_on_to_the_same_bytes(finished, start, tmp_path: Path) -> None:
    """Killed with all its processes: the first time in the midst of the first jobs, then at random moments."""
    moment = random.Random(8)
    for number in range(KILLS):
        study = start.copy_to(tmp_path / f"study_{number}")
        with _started(study):
            time.sleep(moment.uniform(0, 5) if number else 0)
        expected = finished.tables()
        assert {path: expected[path] for path in study.tables()} == study.tables(), "half-written"
        again = study.rocking("run", str(study.folder))
        assert study.tables() == expected and not study.unfinished()
        records = [line for line in again.stdout.splitlines() if line.startswith("good_")]
        assert len(records) <= 3, "each record that was computed has a line"
        for line in records:
            assert "block" in line and "wall" in line
            assert any(f"{word}: " in line for word in ORDER)


def test_a_second_run_is_locked_out_and_harms_nothing(finished, tmp_path: Path) -> None:
    """Whether by the command or by snakemake itself."""
    study = finished.copy_to(tmp_path / "study")
    # As a run that was stopped leaves it.
    (study.results / ".kept" / "outcomes" / "good_3.json").unlink()
    (study.results / "summary" / "provenance.json").unlink()
    with _started(study) as first:
        os.killpg(first.pid, signal.SIGSTOP)  # on a slow machine it would end before the others begin
        second = study.rocking("run", str(study.folder), status=1)
        assert "another run works in this study" in second.stderr
        assert "Directory cannot be locked" in study.run(status=1)
        os.killpg(first.pid, signal.SIGCONT)
        first.communicate(timeout=600)
    assert first.returncode == 0
    assert study.tables() == finished.tables()


def _set_mode(folder: Path, mode: int) -> None:
    for path in (folder, *folder.rglob("*/")):
        path.chmod(mode)


AWAY = "records/catalogue.csv (missing locally"


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "harm", "mend", "words"),
    [
        pytest.param(
            "records",
            lambda at: at.rename(f"{at}_"),
            lambda at: Path(f"{at}_").rename(at),
            AWAY,
            id="records vanish",
        ),
        pytest.param(
            "results",
            lambda at: _set_mode(at, 0o555),
            lambda at: _set_mode(at, 0o755),
            "Permission denied",
            id="results read-only",
        ),
    ],
)
def test_after_a_folder_fails_the_same_command_goes_on(finished, start, tmp_path, name, harm, mend, words):
    study = start.copy_to(tmp_path / "study")
    command = [sys.executable, "-m", "rocking.study.cli", "run", str(study.folder)]
    if os.geteuid() == 0:  # to whom permissions mean nothing, unless that is taken from it
        if not shutil.which("setpriv"):
            pytest.skip("root writes everywhere, and setpriv is not installed to take that from it")
        command = ["setpriv", "--bounding-set=-dac_override", *command]
    with _started(study, *command, until=_record_is_done) as process:
        harm(study.folder / name)
        told = process.communicate(timeout=300)[0]
    mend(study.folder / name)
    assert process.returncode == 1 and words in told and "failed, wholly or in part" not in told, told
    study.rocking("run", str(study.folder))
    assert not study.unfinished()
    for record in ("good_1", "good_2", "good_3"):
        assert study.rows_of(record) == finished.rows_of(record)
