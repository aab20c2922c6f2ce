"""rocking run: snakemake in a process of its own, its log in a file, and on the terminal what one wants to know."""

import contextlib
import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import yaml

from rocking.assessment.fate import Fate
from rocking.assessment.rows.of_record import FailureRow
from rocking.errors import ConfigurationError, RockingError
from rocking.quantities import counted
from rocking.study.config_file import named_files
from rocking.study.locks import ends_with, is_locked, is_stale, mark, only_run, unmark
from rocking.study.outcome import closing_lines, paths_to_read
from rocking.study.plan import Plan, make_plan
from rocking.study.progress import NewLines, Progress, finished_rule, fitting, planned_jobs
from rocking.study.workspace import workflow_folder
from rocking.tables import read_rows, read_table

_CORES = re.compile(r"(--cores|--jobs)(=.*)?|-[cj]\d*|-[cj]all")
_ANSWERS = re.compile(
    r"(-[nhvlSDt]|--(dry-?run|help|version|list|list-rules|list-changes|lint|dag|rulegraph|filegraph|d3dag|summary|"
    r"detailed-summary|report|unlock|touch|archive|delete-all-output|print-compilation))(=.*)?"
)
"""Options with which snakemake answers a question instead of running the study: its answer is shown as it is."""
_POLL = 0.1
"""s between two looks at the logs."""


def run(folder: Path, options: Sequence[str]) -> int:
    """Run the workflow on the study in `folder`, with further options for snakemake, and return the exit status.

    The status is 0, or 1 when a record or a job failed. Raises ConfigurationError, before snakemake starts, when the
    folder holds no study or the study has defects.
    """
    plan = _planned(folder)
    command = _command(folder, options)
    if any(_ANSWERS.fullmatch(option) for option in options):
        return subprocess.run(command, check=False, env=_environment()).returncode
    target = next((option for option in options[:1] if not option.startswith("-")), None)
    return _alone(folder, plan, command, target)


def _planned(folder: Path) -> Plan:
    config = folder / "config.yaml"
    if not config.is_file():
        raise ConfigurationError(
            f"{folder} holds no config.yaml; start a study there first: rocking start {folder}"
        )
    settings = _read(config)
    catalogue = folder / named_files(settings).catalogue
    if not catalogue.is_file():
        raise ConfigurationError(
            f"{catalogue}: there is no catalogue yet; put records beside it, then: rocking catalogue {catalogue.parent}"
        )
    with contextlib.chdir(folder):
        return make_plan(settings)


def _read(config: Path) -> dict[str, object]:
    try:
        settings = yaml.safe_load(config.read_text(encoding="utf-8")) or {}
        if not isinstance(settings, dict):
            raise TypeError(f"it holds a {type(settings).__name__}")
    except (yaml.YAMLError, UnicodeDecodeError, TypeError) as error:
        reason = " ".join(str(error).split())
        raise ConfigurationError(
            f"{config}: this is no YAML mapping of settings ({reason}); mend it."
        ) from None
    return settings


def _command(folder: Path, options: Sequence[str]) -> list[str]:
    home = workflow_folder()
    cores = [] if any(_CORES.fullmatch(option) for option in options) else ["--cores", "all"]
    return [
        *(sys.executable, "-P", "-m", "snakemake", "--snakefile", str(home / "Snakefile")),
        *("--workflow-profile", str(home / "workflow" / "profiles" / "default")),
        *("--directory", str(folder), "--configfile", str(folder.resolve() / "config.yaml")),
        *cores,
        *options,
    ]


def _alone(folder: Path, plan: Plan, command: Sequence[str], target: str | None) -> int:
    with only_run(folder) as held:
        if is_locked(folder):
            if not is_stale(folder):
                raise RockingError(
                    f"{folder}: snakemake locked this study, and may still work in it; "
                    f"if it does not, take the lock away: {_again(folder)} -- --unlock"
                )
            print("A run that was killed left its lock, which is taken away.", flush=True)
            subprocess.run([*command, "--unlock"], check=True, capture_output=True, env=_environment())
        return _watched(folder, plan, command, target, held)


def _watched(folder: Path, plan: Plan, command: Sequence[str], target: str | None, held: int) -> int:
    results = folder / plan.settings.results
    log = results / "summary" / "logs" / "run.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    print(
        *plan.doubts,
        f"{counted(len(plan.records), 'record')}; log of the scheduler: {log}",
        "Numbers: members of the ensemble that overturn, or the largest rotation over the critical rotation.",
        sep="\n",
        flush=True,
    )
    progress = Progress(_records_by_rule(plan), max(map(len, plan.records)))
    jobs = NewLines(log.parent, "[!r]*.log", "r[!u]*.log")
    stopped = _Stop()
    with log.open("w", encoding="utf-8") as stream, stopped.listening():
        process = subprocess.Popen(
            command,
            stdout=stream,
            stderr=subprocess.STDOUT,
            env=_environment(),
            pass_fds=[held],
            start_new_session=True,
            preexec_fn=ends_with(os.getpid()),
        )
        mark(folder, process.pid)
        _follow(process, log, jobs, progress, stopped)
    progress.close()
    unmark(folder)
    if stopped.by:
        print(f"Stopped; what was finished stays. To go on: {_again(folder)}")
        return 128 + stopped.by
    if process.returncode:
        print(f"Not finished: {_reason(log)}\nMend that, then go on: {_again(folder)}")
        return 1
    if target is not None:
        print(f"Finished: {target}; what it wrote lies in {results}")
        return 0
    summary = results / "summary"
    failures = read_table(FailureRow, summary)
    lines = closing_lines(read_rows(Fate, summary / Fate.table.file_name), failures)
    print(*map(fitting, lines), *paths_to_read(results), sep="\n", flush=True)
    return int(bool(failures))


class _Stop:
    """A request of the user or the system to stop, which the scheduler and its jobs are told of once."""

    def __init__(self) -> None:
        self.by = 0
        """Number of the signal, 0 for none."""
        self._told = False

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """Note signals instead of dying of them: the scheduler has to end in order first."""
        known = {number: signal.signal(number, self._note) for number in _STOPPING}
        try:
            yield
        finally:
            for number, handler in known.items():
                signal.signal(number, handler)

    def pass_on(self, process: subprocess.Popen[bytes]) -> None:
        """Tell the scheduler and its jobs, which stand in a process group of their own, once."""
        if self.by and not self._told:
            self._told = True
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGINT)

    def _note(self, number: int, _: object) -> None:
        self.by = self.by or number


_STOPPING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


def _environment() -> dict[str, str]:
    """That of the scheduler and its jobs: Python imports nothing from the folder it happens to stand in."""
    return os.environ | {"PYTHONSAFEPATH": "1"}


def _again(folder: Path) -> str:
    return f"rocking run {folder}"


def _records_by_rule(plan: Plan) -> dict[str, int]:
    return {f"{kind}_{job}": len(plan.jobs[job]) for job in plan.jobs for kind in ("assess", "report")}


def _follow(
    process: subprocess.Popen[bytes], log: Path, jobs: NewLines, progress: Progress, stopped: _Stop
) -> None:
    scheduler, known = NewLines(log.parent, log.name), False
    ended = False
    while not ended:
        ended = process.poll() is not None  # before the logs are read, so that their last lines are
        stopped.pass_on(process)
        for job, line in jobs:
            progress.told(job, line)
        for _, line in scheduler:
            if rule := finished_rule(line):
                progress.finished(rule)
        if not known and (planned := planned_jobs(log.read_text(encoding="utf-8", errors="replace"))):
            progress.plan(planned)
            known = True
        if not ended:
            time.sleep(_POLL)


def _reason(log: Path) -> str:
    """The sentences of this package, else the last line, in the log of a run that broke off."""
    text = log.read_text(encoding="utf-8", errors="replace")
    said = [" ".join(match[1].split()) for match in _SAID.finditer(text)]
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    return "; ".join(dict.fromkeys(said)) or (lines[-1] if lines else "snakemake gave no reason")


_SAID = re.compile(r"^[ \w.]*Error(?:: | in file .*\n)(.+)", re.MULTILINE)
"""In a traceback, and as snakemake tells what a Snakefile raised."""
