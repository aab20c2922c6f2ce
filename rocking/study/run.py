"""rocking run: snakemake in a process of its own, its log in a file, and on the terminal what one wants to know."""

import contextlib
import ctypes
import fcntl
import json
import os
import re
import signal
import socket
import subprocess
import sys
import tempfile
from collections.abc import Callable, Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path
from threading import Thread
from typing import BinaryIO

from rocking.assessment.fate import Fate
from rocking.assessment.rows.of_record import FailureRow
from rocking.errors import ConfigurationError, RockingError
from rocking.quantities import counted
from rocking.study.doors import close_doors
from rocking.study.outcome import closing_lines, paths_to_read
from rocking.study.plan import JOBS, Plan, check_config_file, make_plan
from rocking.study.progress import PIPE, Progress, fitting
from rocking.study.settings import named_files
from rocking.study.workspace import workflow_folder
from rocking.tables import read_table

_WIDEST = 24
"""Columns for the name of a record; after a longer one its verdict follows at once."""
_CORES = re.compile(r"(--cores|--jobs)(=.*)?|-[cj]\d*|-[cj]all")
_ANSWERS = re.compile(
    r"(-[nhvlSDt]|--(dry-?run|help|version|list|list-rules|list-changes|lint|dag|rulegraph|filegraph|d3dag|summary|"
    r"detailed-summary|report|unlock|touch|archive|delete-all-output|print-compilation))(=.*)?"
)
"""Options with which snakemake answers a question instead of running the study: its answer is shown as it is."""


def run(folder: Path, options: Sequence[str]) -> int:
    """Run the workflow on the study in `folder`, with further options for snakemake, and return the exit status.

    The status is 0, or 1 when a record or a job failed. Raises ConfigurationError, before snakemake starts, when the
    folder holds no study or the study has defects.
    """
    config = _config(folder)
    plan = _planned(folder, config)
    command = _command(folder, config, options)
    if any(_ANSWERS.fullmatch(option) for option in options):
        return subprocess.run(command, check=False, env=_environment()).returncode
    target = next((option for option in options[:1] if not option.startswith("-")), None)
    return _alone(folder, plan, command, target)


def _config(folder: Path) -> Path:
    """The settings of the study in `folder`; in the clone those of the shipped example."""
    own, shipped = folder / "config.yaml", folder / "workflow" / "config.yaml"
    if config := next((path for path in (own, shipped) if os.path.lexists(path)), None):
        return config
    raise ConfigurationError(
        f"{folder} holds no config.yaml; start a study there first: rocking start {folder}"
    )


def _planned(folder: Path, config: Path) -> Plan:
    close_doors(folder)
    if find_spec("snakemake") is None:
        raise RockingError(
            "a study runs with snakemake, which is not installed: pip install rocking[workflow]"
        )
    settings = check_config_file(config)
    catalogue = folder / named_files(settings).catalogue
    if not catalogue.is_file():
        raise ConfigurationError(
            f"{catalogue}: there is no catalogue yet; put records beside it, then: rocking catalogue {catalogue.parent}"
        )
    with contextlib.chdir(folder):
        return make_plan(settings)


def _command(folder: Path, config: Path, options: Sequence[str]) -> list[str]:
    home = workflow_folder()
    cores = [] if any(_CORES.fullmatch(option) for option in options) else ["--cores", "all"]
    return [
        *(sys.executable, "-P", "-m", "snakemake", "--snakefile", str(home / "Snakefile")),
        *("--workflow-profile", str(home / "workflow" / "profiles" / "default")),
        *("--directory", str(folder), "--configfile", str(config.resolve())),
        *("--logger", "rocking"),
        *cores,
        *options,
    ]


def _alone(folder: Path, plan: Plan, command: Sequence[str], target: str | None) -> int:
    with _only_run(folder) as held:
        if is_locked(folder):
            if not _is_stale(folder):
                raise RockingError(
                    f"{folder}: snakemake locked this study, and may still work in it; "
                    f"if it does not, take the lock away: {_again(folder)} -- --unlock"
                )
            print("A run that was killed left its lock, which is taken away.", flush=True)
            subprocess.run([*command, "--unlock"], check=True, capture_output=True, env=_environment())
        return _watched(folder, plan, command, target, held)


def _watched(folder: Path, plan: Plan, command: Sequence[str], target: str | None, held: int) -> int:
    with contextlib.chdir(folder):
        doubts = plan.doubts
    results = folder / plan.settings.results
    log = results / "summary" / "logs" / "run.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    print(
        *doubts,
        f"{counted(len(plan.records), 'record')}; log of the scheduler: {log}",
        "Numbers: members of the ensemble that overturn, or the largest rotation over the critical rotation.",
        sep="\n",
        flush=True,
    )
    progress = Progress(
        {f"assess_{job}": len(records) for job, records in plan.jobs.items()},
        min(_WIDEST, max(map(len, plan.records))),
    )
    with tempfile.TemporaryDirectory() as own, log.open("w", encoding="utf-8") as stream:
        pipe = Path(own) / "progress"
        os.mkfifo(pipe)
        with pipe.open("r+b", buffering=0) as told:  # written too: else it would end whenever nobody writes
            process = subprocess.Popen(
                command,
                stdout=stream,
                stderr=subprocess.STDOUT,
                env=_environment() | {PIPE: str(pipe)},
                pass_fds=[held],
                start_new_session=True,
                preexec_fn=_ends_with(os.getpid()),
            )
            _mark(folder, process.pid)
            with _stoppable(process) as stopped:
                _follow(process, told, progress)
    progress.close()
    _unmark(folder)
    if stopped:
        print(f"Stopped; what was finished stays. To go on: {_again(folder)}")
        return 128 + stopped[0]
    if process.returncode:
        print(f"Not finished: {_reason(progress.errors, log)}\nMend that, then go on: {_again(folder)}")
        return 1
    if target is not None:
        print(f"Finished: {target}; what it wrote lies in {results}")
        return 0
    summary = results / "summary"
    failures, verdicts = read_table(FailureRow, summary), read_table(Fate, summary)
    lines = (*closing_lines(verdicts, failures), *paths_to_read(results, verdicts))
    print(*map(fitting, lines), sep="\n", flush=True)
    return int(bool(failures))


@contextlib.contextmanager
def _stoppable(process: subprocess.Popen[bytes]) -> Iterator[list[int]]:
    """Yield the signals by which the user or the system asks to stop, of which scheduler and jobs are told once.

    They stand in a process group of their own: the scheduler has to end in order first.
    """
    asked: list[int] = []

    def tell(number: int, _: object) -> None:
        if not asked:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)
        asked.append(number)

    known = {number: signal.signal(number, tell) for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
    try:
        yield asked
    finally:
        for number, handler in known.items():
            signal.signal(number, handler)


def _follow(process: subprocess.Popen[bytes], told: BinaryIO, progress: Progress) -> None:
    """Show what is sent until the process ends."""
    waiter = Thread(target=lambda: (process.wait(), told.write(b"\n")))
    waiter.start()
    rest = b""
    while True:
        *lines, rest = (rest + told.read(65536)).split(b"\n")
        for line in filter(None, lines):
            progress(json.loads(line))
        if b"" in lines:
            break
    waiter.join()


def _environment() -> dict[str, str]:
    """That of the scheduler and its jobs, with the plug-in by which they tell what they do."""
    plugins = [str(workflow_folder() / "workflow" / "logger"), os.environ.get("PYTHONPATH", "")]
    return os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, plugins))}


def _again(folder: Path) -> str:
    return f"rocking run {folder}"


def _reason(errors: Sequence[str], log: Path) -> str:
    """The sentences of this package in the errors and the log of a run that broke off, else what snakemake said."""
    text = log.read_text(encoding="utf-8", errors="replace")
    said = [" ".join(match[1].split()) for match in _SAID.finditer(text)]
    last = errors[-1].strip().splitlines() if errors else text.strip().splitlines()[-1:]
    return "; ".join(dict.fromkeys(said)) or " ".join(last) or "snakemake gave no reason"


_SAID = re.compile(r"^[ \w.]*Error(?:: | in file .*\n)(.+)", re.MULTILINE)
"""In a traceback, and as snakemake tells what a Snakefile raised."""


@contextlib.contextmanager
def _only_run(folder: Path) -> Iterator[int]:
    """Hold the study in `folder` for one run, and yield the file number that its scheduler must inherit.

    The system lets go of it when the last process that holds it is gone, however it ended. Raises RockingError when
    another run works here.
    """
    path = _mark_of(folder)
    path.parent.mkdir(exist_ok=True)
    with path.open("a", encoding="utf-8") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RockingError(
                f"{folder}: another run works in this study{_owner(folder)}; wait for its end or stop it."
            ) from None
        yield stream.fileno()


def is_locked(folder: Path) -> bool:
    """Whether snakemake locked the study in `folder`."""
    return any((folder / ".snakemake" / "locks").glob("*"))


def _is_stale(folder: Path) -> bool:
    """Whether that lock was left by a run of ours that was killed on this machine; to be called within _only_run.

    Waits for jobs that outlived their scheduler: they would write beside those of the next one.
    """
    if _marked(folder).get("host") != socket.gethostname():
        return False
    with (folder / JOBS).open("a", encoding="utf-8") as jobs:
        fcntl.flock(jobs, fcntl.LOCK_EX)
    return True


def _ends_with(parent: int) -> Callable[[], None]:
    """Return what a process calls at birth to be asked to end when `parent`, which starts it, dies of whatever cause.

    Linux tells it by a signal; elsewhere it does not learn of it, and works to its end.
    """
    tell = getattr(ctypes.CDLL(None), "prctl", None) if sys.platform == "linux" else None

    def ask() -> None:
        if tell is not None:
            tell(_PR_SET_PDEATHSIG, signal.SIGTERM)
            if os.getppid() != parent:  # it died before
                os.kill(os.getpid(), signal.SIGTERM)

    return ask


_PR_SET_PDEATHSIG = 1


def _mark(folder: Path, scheduler: int) -> None:
    """Leave a mark that the lock which snakemake takes from now on is that of our process `scheduler`."""
    known = {"host": socket.gethostname(), "process": scheduler}
    _mark_of(folder).write_text(json.dumps(known), encoding="utf-8")


def _unmark(folder: Path) -> None:
    """Take the mark away, unless a lock is still there: then its owner was killed, and the next run may say so."""
    if not is_locked(folder):
        _mark_of(folder).write_text("", encoding="utf-8")


def _mark_of(folder: Path) -> Path:
    return folder / ".snakemake" / "rocking_run.lock"


def _marked(folder: Path) -> dict[str, object]:
    with contextlib.suppress(OSError, ValueError):
        found = json.loads(_mark_of(folder).read_text(encoding="utf-8"))
        return found if isinstance(found, dict) else {}
    return {}


def _owner(folder: Path) -> str:
    found = _marked(folder)
    return f" (process {found['process']} on {found['host']})" if found else ""
