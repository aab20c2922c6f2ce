"""Ctrl-C, a request to end, a kill, and two runs at once: each in order, each one command away from going on."""

import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time
import zipfile
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
    return any(log.stat().st_size for log in study.results.glob("summary/logs/batch/*.log"))


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
        pytest.param(signal.SIGTERM, False, id="request"),
        pytest.param(signal.SIGINT, False, id="interrupt", marks=ON_DEMAND),
        pytest.param(signal.SIGHUP, True, id="terminal closed", marks=ON_DEMAND),
    ],
)
def test_one_request_to_stop_ends_in_order(start, tmp_path: Path, number: int, everybody: bool) -> None:
    study = start.copy_to(tmp_path / "study")
    with _started(study) as process:
        (os.killpg if everybody else os.kill)(process.pid, number)
        told = process.communicate(timeout=300)[0]
        assert process.returncode == 128 + number, told
        assert f"To go on: rocking run {study.folder}" in told
        assert not study.unfinished() and not (study.results / "summary" / "provenance.json").exists()
        assert _is_gone(process.pid), "the process that jobs are forked from ends with the scheduler"


def test_a_second_request_to_stop_is_final(start, tmp_path: Path) -> None:
    """Also for jobs that cannot end in order: here they stand still. It leaves what a kill leaves, see below."""
    study = start.copy_to(tmp_path / "study")
    with _started(study, until=lambda study: any(study.results.glob("summary/logs/batch/*.log"))) as process:
        run = psutil.Process(process.pid)
        jobs = [
            each for child in run.children() for each in child.children()
        ]  # forks of the one beside the run
        assert jobs
        for each in jobs:
            each.suspend()
        os.kill(process.pid, signal.SIGINT)
        with pytest.raises(subprocess.TimeoutExpired):
            process.wait(timeout=2)
        everyone = run.children(recursive=True)
        os.kill(process.pid, signal.SIGINT)
        process.communicate(timeout=60)
        assert process.returncode == 128 + signal.SIGINT
        _, alive = psutil.wait_procs(everyone, timeout=20)
        assert not [each for each in alive if each.status() != psutil.STATUS_ZOMBIE], "killed with it"


@pytest.mark.parametrize("number", [signal.SIGKILL, pytest.param(signal.SIGTERM, marks=ON_DEMAND)])
def test_a_job_that_is_ended_is_named_with_its_cause_and_the_next_run_goes_on(
    finished, start, tmp_path: Path, number: int
) -> None:
    study = start.copy_to(tmp_path / "study")
    with _started(study, until=lambda study: any(study.results.glob("summary/logs/batch/*.log"))) as process:
        run = psutil.Process(process.pid)
        job = next(each for child in run.children() for each in child.children())
        job.send_signal(number)
        told = process.communicate(timeout=300)[0]
    cause = "was ended by SIGKILL" if number == signal.SIGKILL else "ended with status 1"
    log = (study.results / "summary" / "logs" / "run.log").read_text()
    assert process.returncode == 1 and re.search(rf"batch/\d+_of_\d+: its process {cause}", told + log), (
        told + log
    )
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
        assert (0 if number else 3) <= len(records) <= 3, "each record that was computed has a line"
        for line in records:
            assert "block" in line and "wall" in line
            assert any(f"{word}: " in line for word in ORDER)


def test_a_run_waits_for_the_jobs_of_one_whose_scheduler_alone_was_killed(start, tmp_path: Path) -> None:
    """Of one record, whose job alone is waited for."""
    study = start.copy_to(tmp_path / "study")
    study.write_catalogue(study.rows()[:1])
    with _started(study) as process:
        process.kill()
        study.rocking("run", str(study.folder))
    assert not study.unfinished()


@pytest.mark.parametrize(
    "otherwise", [False, pytest.param(True, marks=ON_DEMAND)], ids=["rocking run", "snakemake"]
)
def test_a_second_run_is_locked_out_and_harms_nothing(finished, tmp_path: Path, otherwise: bool) -> None:
    study = finished.copy_to(tmp_path / "study")
    # As a run that was stopped leaves it.
    batches = study.results.glob(".kept/outcomes/*.zip")
    (path,) = [path for path in batches if "good_3" in zipfile.ZipFile(path).namelist()]
    path.unlink()
    (study.results / "summary" / "provenance.json").unlink()
    with _started(study, *(study.command() if otherwise else ())) as first:
        os.killpg(first.pid, signal.SIGSTOP)  # on a slow machine it would end before the others begin
        second = study.rocking("run", str(study.folder), status=1)
        assert "another run works in this study" in second.stderr
        assert "another run works in this study" in study.run(status=1)
        os.killpg(first.pid, signal.SIGCONT)
        first.communicate(timeout=600)
    assert first.returncode == 0
    assert study.tables() == finished.tables()


def _set_mode(folder: Path, mode: int) -> None:
    for path in (folder, *folder.rglob("*/")):
        path.chmod(mode)


JUNK = {
    "metadata is a file": lambda folder: (shutil.rmtree(folder / "metadata"), (folder / "metadata").touch()),
    "no JSON": lambda folder: [
        each.write_bytes(b"\xff\xfe junk") for each in (folder / "metadata").iterdir()
    ],
    "another JSON": lambda folder: [each.write_text("[1, 2]") for each in (folder / "metadata").iterdir()],
}


@pytest.mark.slow
@pytest.mark.parametrize("junk", JUNK)
def test_a_damaged_memory_of_snakemake_is_told_in_a_sentence(finished, tmp_path, junk: str) -> None:
    """Without it, what was finished stays."""
    study = finished.copy_to(tmp_path / "study")
    JUNK[junk](study.folder / ".snakemake")
    told = study.rocking("run", str(study.folder), status=1).stdout
    assert "what snakemake remembers of the study is damaged" in told and "Traceback" not in told
    shutil.rmtree(study.folder / ".snakemake")
    assert study.planned() == []


AWAY = "records/catalogue.csv: the file cannot be opened"


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
            marks=pytest.mark.slow,
        ),
    ],
)
def test_after_a_folder_fails_the_same_command_goes_on(finished, start, tmp_path, name, harm, mend, words):
    """In the midst of a batch of three records, of which none is then taken for one that cannot be read."""
    study = start.copy_to(tmp_path / "study")
    config = study.folder / "config.yaml"
    config.write_text(config.read_text().replace("records_per_job: 1", "records_per_job: 3"))
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
