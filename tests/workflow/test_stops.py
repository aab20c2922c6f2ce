"""Ctrl-C, a request to end, a kill, and two runs at once: each in order, each one command away from going on."""

import os
import random
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from rocking.study.run import is_locked

KILLS = int(os.environ.get("ROCKING_KILLS", "1"))
"""How many runs are killed; ROCKING_KILLS=20 takes some minutes."""


def _started(study, *options: str) -> subprocess.Popen[str]:
    command = [sys.executable, "-m", "rocking.study.cli", "run", str(study.folder), *options]
    surroundings = study.surroundings | {"cwd": study.tree}
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    return subprocess.Popen(command, start_new_session=True, **streams, **surroundings)


def _wait(condition: Callable[[], object], process: subprocess.Popen[str]) -> None:
    deadline = time.monotonic() + 300
    while not condition():
        assert process.poll() is None, process.communicate()[0]
        assert time.monotonic() < deadline
        time.sleep(0.02)


def _jobs_run(study) -> bool:
    return any((study.folder / ".snakemake" / "incomplete").glob("*"))


def _schedulers(study) -> list[int]:
    import psutil

    here = str(study.folder)
    return [p.pid for p in psutil.process_iter(["cmdline"]) if here in (p.info["cmdline"] or [])]


def _kill_all(study, process: subprocess.Popen[str]) -> None:
    """Kill the command, its scheduler and all jobs, as a power cut would."""
    process.kill()
    for scheduler in _schedulers(study):
        if scheduler != process.pid:
            os.killpg(scheduler, signal.SIGKILL)
    process.wait(timeout=100)
    process.stdout.close()


@pytest.mark.parametrize(("number", "status"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_one_request_to_stop_ends_in_order(start, tmp_path: Path, number: int, status: int) -> None:
    study = start.copy_to(tmp_path / "study")
    process = _started(study)
    try:
        _wait(lambda: _jobs_run(study), process)
        process.send_signal(number)
        told = process.communicate(timeout=300)[0]
    finally:
        _kill_all(study, process)
    assert process.returncode == status, told
    assert f"To go on: rocking run {study.folder}" in told
    assert not is_locked(study.folder) and not study.unfinished()
    assert not _schedulers(study), "snakemake or a job is still there"


@pytest.mark.skipif(sys.platform != "linux", reason="only Linux tells a process that its parent died")
def test_the_scheduler_ends_in_order_when_the_command_alone_is_killed(start, tmp_path: Path) -> None:
    study = start.copy_to(tmp_path / "study")
    process = _started(study)
    try:
        _wait(lambda: _jobs_run(study), process)
        process.kill()
        process.wait(timeout=100)
        deadline = time.monotonic() + 300
        while _schedulers(study):
            assert time.monotonic() < deadline, "snakemake works on without its command"
            time.sleep(0.1)
    finally:
        _kill_all(study, process)
    assert not is_locked(study.folder) and not study.unfinished()
    assert not (study.results / "summary" / "provenance.json").exists(), "it took up all further jobs"


def test_after_a_kill_the_same_command_goes_on_to_the_same_bytes(finished, start, tmp_path: Path) -> None:
    """Killed with all its processes: the first time in the midst of the first jobs, then at random moments."""
    moment = random.Random(8)
    for number in range(KILLS):
        study = start.copy_to(tmp_path / f"study_{number}")
        process = _started(study)
        try:
            _wait(lambda study=study: _jobs_run(study), process)
            time.sleep(moment.uniform(0, 5) if number else 0)
        finally:
            _kill_all(study, process)
        expected, locked = finished.tables(), is_locked(study.folder)
        assert locked or number, "as a power cut leaves it"
        assert {path: expected[path] for path in study.tables()} == study.tables(), "half-written"
        again = study.rocking("run", str(study.folder))
        assert again.returncode == 0, again.stdout + again.stderr
        assert ("left its lock" in again.stdout) == locked
        assert study.tables() == expected and not study.unfinished()
        _check_verdicts(again.stdout, 0 if number else 3)


def _check_verdicts(told: str, at_least: int) -> None:
    """Each record that was computed has a line with both structures in it."""
    records = [line for line in told.splitlines() if line.startswith("good_")]
    assert at_least <= len(records) <= 3
    for line in records:
        assert "block" in line and "wall" in line
        assert any(f"{word}: " in line for word in ("overturns", "undecided", "stands"))


def test_a_second_run_is_locked_out_and_harms_nothing(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    study.forget("good_3")
    first = _started(study)
    try:
        _wait(lambda: _jobs_run(study), first)
        second = study.rocking("run", str(study.folder))
        assert second.returncode == 1
        assert "another run works in this study (process " in second.stderr
        first.communicate(timeout=600)
    finally:
        _kill_all(study, first)
    assert first.returncode == 0
    assert study.tables() == finished.tables()


def test_the_lock_of_a_scheduler_started_otherwise_is_left_alone(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    locks = study.folder / ".snakemake" / "locks"
    locks.mkdir(exist_ok=True)
    (locks / "0.input.lock").write_text("records/good_1.txt\n")
    done = study.rocking("run", str(study.folder))
    assert done.returncode == 1 and "-- --unlock" in done.stderr
    assert is_locked(study.folder)


def test_nothing_is_imported_from_the_folder_of_the_study(finished, tmp_path: Path) -> None:
    study = finished.copy_to(tmp_path / "study")
    for name in ("yaml", "psutil", "numpy"):
        (study.folder / f"{name}.py").write_text("open('imported', 'w')\nraise SystemExit(7)\n")
    study.add_synthetic("good_4", 4)
    rocking = Path(sys.executable).with_name("rocking")
    command = [str(rocking) if rocking.exists() else "rocking", "run", "."]
    done = subprocess.run(command, capture_output=True, text=True, check=False, **study.surroundings)
    assert done.returncode == 0, done.stdout + done.stderr
    assert not (study.folder / "imported").exists()
