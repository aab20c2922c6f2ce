"""rocking run: snakemake in this process, its log in a file, and on the terminal what one wants to know."""

import contextlib
import fcntl
import os
import re
import sys
from collections.abc import Iterator, Sequence
from importlib.util import find_spec
from pathlib import Path

from rocking.assessment.rows import FailureRow
from rocking.errors import ConfigurationError, RockingError
from rocking.progress import fitting
from rocking.quantities import counted
from rocking.study import close_doors
from rocking.study.apart import warm_up
from rocking.study.flow import SNAKEFILE, workflow_folder
from rocking.study.kept import kept_in
from rocking.study.outputs import kept_of
from rocking.study.plan import Plan, check_config_file, check_files, config_file, make_plan
from rocking.study.products import BY_NAME

_LOCK = Path(".snakemake") / "rocking_run.lock"
"""Locked by `rocking run` while it works, in the folder of the study; where nobody locks it, a run was killed."""
_ANSWERS = re.compile(
    r"(-[nhvlSDt]|--(dry-?run|help|version|list|list-rules|list-changes|lint|dag|rulegraph|filegraph|d3dag|summary|"
    r"detailed-summary|report|unlock|touch|archive|delete-all-output|print-compilation))(=.*)?"
)
"""Options with which snakemake answers a question instead of running the study: its answer is shown as it is."""
_PART = ("--until", "-U", "--omit-from", "-O")
"""Options with which snakemake makes a part of the study."""


def run(folder: Path, options: Sequence[str]) -> int:
    """Run the workflow on the study in `folder`, with further options for snakemake, and return the exit status.

    The status is 0, or 1 when a record, a product or a job failed. Raises ConfigurationError, before
    snakemake starts, when the folder holds no study, the study has defects, or its settings cannot make the product
    that is asked for; RockingError when another run works in it.
    """
    plan = _plan(folder)
    target = options[0] if options and not options[0].startswith("-") else ""
    if any(len(option) > 4 and "--trust-io-cache".startswith(option.partition("=")[0]) for option in options):
        raise ConfigurationError("--trust-io-cache would run what .snakemake/iocache holds; leave it out.")
    if target in BY_NAME and (refusal := BY_NAME[target].refusal(plan.settings)):
        raise ConfigurationError(refusal, setting=target)
    arguments = [
        *("--snakefile", SNAKEFILE, "--directory", str(folder)),
        *("--workflow-profile", str(workflow_folder() / "workflow" / "profiles" / "default")),
        *([] if target else ["results"]),
        *options,
    ]
    if any(_ANSWERS.fullmatch(option) for option in options):
        return _snakemake(arguments)
    log = folder / plan.results / "summary" / "logs" / "run.log"
    with contextlib.chdir(folder):
        warnings = plan.warnings
    print(
        *warnings,
        f"{counted(len(plan.records), 'record')}; log of the scheduler: {log}",
        "Numbers: members of the ensemble that overturn, or the largest rotation over the critical rotation.",
        sep="\n",
        flush=True,
    )
    with _alone(folder):
        with contextlib.chdir(folder):
            warm_up(plan.settings)  # before the log takes what is printed: its jobs print to the terminal
        with _logged(log):
            status = _snakemake(arguments)
    if status:
        print(f"Not finished: {_end_of(log)}\nWhat is finished stays; to go on: rocking run {folder}")
        return 1
    if target not in ("", "summary", *BY_NAME) or any(option.startswith(_PART) for option in options):
        print(f"Finished: {' '.join(options)}; what it wrote lies in {folder / plan.results}")
        return 0
    kept = kept_in(kept_of(folder / plan.results, target or "summary"), [FailureRow])
    heads = ("Open", *[""] * len(kept.opened))
    paths = (
        f"{head:<8}{folder / plan.results / name}" for head, name in zip(heads, kept.opened, strict=False)
    )
    for line in (*kept.lines, *paths):
        print(fitting(line, sys.stdout))
    return int(bool(kept.rows[FailureRow]))


def _end_of(log: Path) -> str:
    """The last lines of the scheduler's log that say something."""
    lines = [line.strip() for line in log.read_text(encoding="utf-8", errors="replace").splitlines()]
    said = [
        line for line in lines if line and not line.startswith(("Complete log", "Shutting down", "Exiting"))
    ]
    return f"{' '.join(said[-3:])} ({log} says more)"


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
            "a study runs with snakemake, which is not installed; install the extra that has it: "
            "pip install 'rocking[workflow]'"
        )
    settings = check_config_file(config)
    with contextlib.chdir(folder):
        plan = make_plan(settings)
        check_files(plan.settings)
        return plan


def _snakemake(arguments: Sequence[str]) -> int:
    from snakemake.cli import main  # takes a second, and an installation without the workflow lacks it

    try:
        main(arguments)
    except SystemExit as end:
        return int(end.code or 0)
    return 0


@contextlib.contextmanager
def _logged(log: Path) -> Iterator[None]:
    """Let this process and its children write into `log`."""
    sys.stdout.flush()
    log.parent.mkdir(parents=True, exist_ok=True)
    copies = {number: os.dup(number) for number in (1, 2)}
    with log.open("wb") as stream:
        for number in copies:
            os.dup2(stream.fileno(), number)
        try:
            yield
        finally:
            sys.stdout.flush()
            for number, copy in copies.items():
                os.dup2(copy, number)
                os.close(copy)


@contextlib.contextmanager
def _alone(folder: Path) -> Iterator[None]:
    """Lock other runs of this command out of the study in `folder`, also where it is killed.

    What snakemake has locked is unlocked where the run that had done so was killed. A file system without locks has the
    lock of snakemake alone. Raises RockingError when another run works there.
    """
    lock_file = folder / _LOCK
    lock_file.parent.mkdir(exist_ok=True)
    was_killed = lock_file.exists()
    with lock_file.open("w") as stream:
        try:
            fcntl.flock(stream, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise RockingError(
                f"{folder}: another run works in this study; wait for its end or stop it."
            ) from None
        except OSError as error:
            print(f"{folder}: not locked, {error.strerror}; start no other run there meanwhile.")
        if was_killed:
            for lock in (lock_file.parent / "locks").glob("*"):
                lock.unlink()
        yield
        lock_file.unlink()
