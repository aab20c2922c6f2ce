"""rocking run: snakemake in this process, its log in a file, and on the terminal what one wants to know."""

import contextlib
import fcntl
import os
import re
import shutil
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from threading import Thread
from typing import Any, TextIO

from rocking.assessment.rows import (
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    RecordRow,
    RemarkRow,
    made_records,
)
from rocking.errors import ConfigurationError, RockingError
from rocking.quantities import counted, shown
from rocking.study import close_doors
from rocking.study.apart import warm_up
from rocking.study.flow import workflow_folder
from rocking.study.folder import REMEMBERED, locked, new_log
from rocking.study.kept import kept_conclusion, kept_rows
from rocking.study.outcomes import verdicts_of
from rocking.study.outputs import CASES, PROVENANCE, kept_of
from rocking.study.plan import JOBS, Plan, check_config_file, config_file, make_plan
from rocking.study.product import Product
from rocking.study.products import BY_NAME, PRODUCTS
from rocking.study.progress import Progress, fitting
from rocking.study.terminal import (
    check_any_read,
    closing_lines,
    conclusion_lines,
    failing_lines,
    paths_to_read,
)
from rocking.tables import read_rows, read_table, rows_of

_LOCK = REMEMBERED / "rocking_run.lock"
"""Locked by the process that schedules the jobs of a study, in the folder of the study."""
_ANSWERS = re.compile(
    r"(-[nhvlSDt]|--(dry-?run|help|version|list|list-rules|list-changes|lint|dag|rulegraph|filegraph|d3dag|summary|"
    r"detailed-summary|report|unlock|touch|archive|delete-all-output|print-compilation))(=.*)?"
)
"""Options with which snakemake answers a question instead of running the study: its answer is shown as it is."""
_REFUSED = {
    "--trust-io-cache": "would run what .snakemake/iocache holds",
    "--configfiles": "would name settings besides those of config.yaml",
}
_RAISED = re.compile(r"Error in file .*\n(?!Command )(.+)")
"""The form in which snakemake prints the error of a Snakefile."""
_EXCEPTION = re.compile(r"(?m)^[\w.]*(?:Error|Exception)\b[^\n]{,200}")
"""The end of a traceback: the name of the error and what it says."""
_RULE = re.compile(r"(?m)^rule (\w+):")
_RESEARCH = re.compile(r'(?m)^    "(\w+)": \(')
"""The declaration of a rule, and of a target of the research."""
_BETWEEN_LOOKS = 0.2
"""s; after which a process that was asked to stop looks again for jobs that started."""
_STOPS: list[int] = []
"""The signals by which somebody asked this process to stop."""


def run(folder: Path, options: Sequence[str]) -> int:
    """Run the workflow on the study in `folder`, with further options for snakemake, and return the exit status.

    The status is 0, or 1 when a record or a job failed, or 128 and the number of the signal that stopped it. Raises
    ConfigurationError, before snakemake starts, when the folder holds no study, the study has defects or the target
    is none; RockingError when another run works in it.
    """
    plan = _plan(folder)
    _check_options(options)
    home = workflow_folder()
    if options and not options[0].startswith("-"):
        _check_target(options[0], home)
    sys.path.append(str(home / "workflow" / "logger"))
    arguments = [
        *("--logger", "rocking"),  # takes all names that follow: never before the options
        *("--snakefile", str(home / "Snakefile")),
        *("--workflow-profile", str(home / "workflow" / "profiles" / "default")),
        *("--directory", str(folder)),
        *options,
    ]
    if any(_ANSWERS.fullmatch(option) for option in options):
        return _snakemake(arguments)
    hold(folder.resolve())
    results = folder / plan.settings.results
    log = results / "summary" / "logs" / "run.log"
    with contextlib.chdir(folder):
        doubts = plan.doubts
    print(
        *doubts,
        f"{counted(len(plan.records), 'record')}; log of the scheduler: {log}",
        "Numbers: members of the ensemble that overturn, or the largest rotation over the critical rotation.",
        sep="\n",
        flush=True,
    )
    # Of which snakemake itself says something in a dry run alone.
    forgotten = (
        not any((folder / REMEMBERED / "metadata").glob("*")) and (log.parents[1] / PROVENANCE).exists()
    )
    with _logged(log) as terminal:
        progress = Progress(len(plan.records), len(plan.batches), terminal)
        with progress.followed():
            with contextlib.chdir(folder):
                warm_up(plan.settings)  # while snakemake is imported; it writes where the jobs do
            status = _snakemake(arguments)
    if _STOPS:
        print(f"Stopped; what was finished stays. To go on: rocking run {folder}")
        return 128 + _STOPS[0]
    if status:
        print(f"Not finished: {_why(progress, folder, log)}\nMend that, then go on: rocking run {folder}")
        return 1
    if forgotten:
        print(
            f"{folder / REMEMBERED} was removed, and with it what the results were made from: those that were not made "
            f"again may be older than an edit. To compute everything again: rocking run {folder} -- --forceall"
        )
    if options and not options[0].startswith("-"):
        print(f"Finished: {options[0]}; what it wrote lies in {results}")
        return 0
    return _print_outcome(folder, plan)


def run_product(folder: Path, product: Product) -> int:
    """Make a product over all records of the study in `folder`, print its lines, and return the status of `run`.

    Raises ConfigurationError, before a record is computed, for settings that cannot make it.
    """
    if refusal := product.refusal(_plan(folder).settings):
        raise ConfigurationError(refusal, setting=product.name)
    status = run(folder, [product.name])
    if not status:
        from rocking.study.work import work_of  # what draws takes a second to import

        results = folder / _plan(folder).settings.results
        work = work_of(product)
        kept = kept_of(results, product.name)
        rows = kept_rows(kept, (*work.shown, FailureRow))
        documents = [results / product.folder / name for name in product.files if name.endswith(".pdf")]
        failures = rows_of(FailureRow, rows)
        lines = [*work.lines(rows), *failing_lines(failures), *conclusion_lines(kept_conclusion(kept))]
        for line in (*lines, *(f"{'Open':<8}{path}" for path in documents)):
            print(fitting(line, sys.stdout))
        status = int(bool(failures))
    return status


def _check_options(options: Sequence[str]) -> None:
    """Refuse an option of snakemake that a study may not have; snakemake takes the begin of a name for the whole."""
    for name in (option.partition("=")[0] for option in options):
        for refused, why in _REFUSED.items():
            if name[:3] == refused[:3] and refused.startswith(name) and name != "--config":
                raise ConfigurationError(f"{refused} {why}; leave it out.")


def _why(progress: Progress, folder: Path, log: Path) -> str:
    """Why a run did not finish, in a sentence."""
    raised = _RAISED.findall("\n".join(progress.errors))
    reasons = progress.reasons or raised or progress.errors[-1:] or [f"see {log}"]
    return "; ".join(dict.fromkeys(_in_a_sentence(reason, folder, log) for reason in reasons))


def _print_outcome(folder: Path, plan: Plan) -> int:
    """Print what came of a whole study, and return the exit status."""
    results = folder / plan.settings.results
    made = [product for product in PRODUCTS if product.name in plan.products]
    failures = read_table(FailureRow, results / "summary")
    verdicts = verdicts_of({record: folder / path for record, path in plan.outcomes().items()})
    comparison = read_rows(ComparisonRow, results / "summary" / ComparisonRow.table.file_name)
    falls = read_table(ExpectedFallsRow, results / "summary")
    remarks = read_rows(RemarkRow, results / "summary" / RemarkRow.table.file_name)
    not_recorded = made_records(read_rows(RecordRow, results / "summary" / RecordRow.table.file_name))
    lines = [*closing_lines(verdicts, comparison, failures, falls, remarks, not_recorded)]
    for product in made:
        lines += conclusion_lines(kept_conclusion(kept_of(results, product.name)))
    opened = {
        results / product.folder / name: what for product in made for name, what in product.opened.items()
    }
    for line in (*lines, *paths_to_read(results, verdicts, plan.settings.reports, opened)):
        print(fitting(line, sys.stdout))
    return int(bool(failures))


def targets(home: Path) -> list[str]:
    """Return the names of what may be asked for; home: the folder that holds Snakefile and workflow/."""
    files = [home / "Snakefile", *(home / "workflow" / "rules").glob("*.smk")]
    names = {name for file in files for name in _RULE.findall(file.read_text(encoding="utf-8"))} | set(
        BY_NAME
    )
    research = home / "docs" / "research" / "research.smk"
    if research.is_file():
        names |= set(_RESEARCH.findall(research.read_text(encoding="utf-8")))
    return sorted(names - {"record", "batch"})


def _check_target(target: str, home: Path) -> None:
    names = targets(home)
    if target not in names and "/" not in target:
        raise ConfigurationError(
            f"target is {shown(target)}, but must be one of {', '.join(names)}, or the path of a file of the results."
        )


def _in_a_sentence(reason: str, folder: Path, log: Path) -> str:
    """Return why a run ended as one sentence, also where it is the traceback of another program."""
    if "Traceback" not in reason:
        return " ".join(reason.split())
    *_, raised = _EXCEPTION.findall(reason) or ["an error"]
    if "MemoryError" in reason:
        return f"there was not enough memory; give more, or run fewer jobs at once: rocking run {folder} -- --cores 1"
    if "snakemake/persistence" in reason:
        return (
            f"what snakemake remembers of the study is damaged ({raised}); remove {folder / REMEMBERED}, and the "
            "results that are whole stay"
        )
    return f"snakemake ended with {raised}; {log} says more"


def _plan(folder: Path) -> Plan:
    config = None if folder.is_file() else config_file(folder)
    if config is None:
        above = next((place for place in folder.absolute().parents if config_file(place)), None)
        what = "is a file, but a study is a folder" if folder.is_file() else "holds no config.yaml"
        if (folder / "config.yml").is_file():
            hint = f"rename its config.yml: mv {folder / 'config.yml'} {folder / 'config.yaml'}"
        elif above:
            hint = f"the study is a folder above it: rocking run {above}"
        else:
            hint = f"start a study first: rocking start {folder.parent if folder.is_file() else folder}"
        raise ConfigurationError(f"{folder} {what}; {hint}")
    close_doors(folder)
    if find_spec("snakemake") is None:
        raise RockingError(
            "a study runs with snakemake, which is not installed: pip install rocking[workflow]"
        )
    settings = check_config_file(config)
    with contextlib.chdir(folder):
        return make_plan(settings)


def _snakemake(arguments: Sequence[str]) -> int:
    from snakemake.cli import main  # takes a second, and an installation without the workflow lacks it

    try:
        main(arguments)
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@contextlib.contextmanager
def _logged(log: Path) -> Iterator[TextIO]:
    """Let this process and its children write into `log`, and yield the stream that they would have written to."""
    sys.stdout.flush()
    copies = {number: os.dup(number) for number in (1, 2)}
    with new_log(log) as stream, os.fdopen(os.dup(1), "w") as terminal:
        for number in copies:
            os.dup2(stream.fileno(), number)
        try:
            yield terminal
        finally:
            for number, copy in copies.items():
                os.dup2(copy, number)
                os.close(copy)


def begin(plan: Plan, anew: bool = False) -> None:
    """Make sure that one process alone schedules the jobs of the study in this folder, and that it ends in order.

    anew: whether nothing is to be taken from what is kept of the cases of a former run.

    Waits for jobs that outlived their scheduler. When the process is asked to stop, its jobs are, and no other starts;
    asked a second time, it ends at once, and its jobs with it.
    """
    hold(Path.cwd())
    os.close(locked(JOBS, fcntl.LOCK_EX))
    if anew:
        shutil.rmtree(Path(plan.settings.results, CASES), ignore_errors=True)
    warm_up(plan.settings)
    # Of snakemake: starts no more jobs, and waits for those that work.
    graceful: Any = signal.getsignal(signal.SIGTERM)

    def end_jobs() -> None:
        import psutil  # comes with snakemake

        graceful()
        ended: set[int] = set()
        while True:  # a job that was chosen before may start after; the thread ends with the process
            for process in psutil.Process().children(recursive=True):
                with contextlib.suppress(psutil.NoSuchProcess):
                    # A shell that started one waits for it. Ended twice, a job would not end in order.
                    if not process.children() and process.pid not in ended:
                        process.terminate()
                        ended.add(process.pid)
            time.sleep(_BETWEEN_LOOKS)

    def end_at_once(number: int) -> None:
        import psutil

        for process in psutil.Process().children(recursive=True):
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()
        os._exit(128 + number)

    def stop(number: int, _: object) -> None:
        _STOPS.append(number)
        if len(_STOPS) > 1:
            end_at_once(number)
        Thread(target=end_jobs, daemon=True).start()  # the scheduler may be at its own lock

    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, stop)
    plan.fill_hashes()
    plan.contents.save()


def end(plan: Plan) -> None:
    """Keep what was found of the contents of files. Raises RecordError when no record at all could be read.

    The tables stand all the same, and say why; but a study of which nothing could be read has not succeeded.
    """
    plan.contents.save()
    check_any_read(Path(plan.settings.results) / "summary", plan.records)


@cache
def hold(folder: Path) -> int:
    """Keep every other run out of the study in `folder` until this process ends, however it ends.

    Raises RockingError when another run works there.
    """
    try:
        return locked(folder / _LOCK, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise RockingError(
            f"{folder}: another run works in this study; wait for its end or stop it."
        ) from None
