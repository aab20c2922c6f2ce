"""Jobs in processes of their own that start warm: forked from one that has imported and prepared what every job needs.

A job of one record would otherwise import libraries and load kernels for longer than it computes. The process that is
forked is the standard library's (multiprocessing, start method "forkserver").
"""

import contextlib
import importlib
import multiprocessing
import os
import signal
import sys
import threading
import traceback
from multiprocessing import forkserver
from multiprocessing.connection import wait
from pathlib import Path

from rocking.errors import LOGS, RockingError
from rocking.study.settings import Settings, commented_yaml

_ONE_AT_A_TIME = threading.Lock()
"""The lock to start a process and to end it: what multiprocessing notes of them is not made for threads."""
_THREADS = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
"""Of linear algebra: a job is one core's work, and a process with further threads must not be forked."""
PREPARED = "ROCKING_PREPARED"
"""The variable of the environment by which the process that is forked gets the settings of the study, as YAML."""


def warm_up(settings: Settings, jobs: bool = True) -> None:
    """Start the process that jobs are forked from, unless it runs; it imports and prepares itself meanwhile.

    settings: of the study in this folder, whose structures it prepares. jobs: False where one job is all that will be
    forked, as on another machine: this job imports what it needs, and no more.
    """
    # A console script, which imports its `main`, is run again as a module in each process that is started.
    script = getattr(vars(sys.modules["__main__"]).get("main"), "__module__", None)
    prepared = ["rocking.study.warm"] if jobs else []
    forkserver.set_forkserver_preload([*prepared, *([script] if script else [])])
    before = dict(os.environ)
    os.environ.update({PREPARED: commented_yaml(settings), **dict.fromkeys(_THREADS, "1")})
    try:
        forkserver.ensure_running()
    finally:
        os.environ.clear()
        os.environ.update(before)


def run_apart(settings: Settings, log: str, work: str, *arguments: object, alone: bool = False) -> None:
    """Run the function `work`, "module:name of the function", in a process of its own, and wait for its end.

    settings: of the study. log: of the job, which takes what it prints. alone: whether this process runs no other job.
    Raises RuntimeError where it did not end well.
    """
    context = multiprocessing.get_context("forkserver")
    process = context.Process(target=_work, args=(str(Path(log).absolute()), work, *arguments))
    with _ONE_AT_A_TIME:
        warm_up(settings, jobs=not alone)
        process.start()
    wait([process.sentinel])
    with _ONE_AT_A_TIME:
        process.join()
        status = process.exitcode
        process.close()
    if status is not None and status < 0:
        cause = signal.Signals(-status).name
        hint = ", as a system does that lacks memory" if status == -signal.SIGKILL else ""
        raise RuntimeError(f"its process was ended by {cause}{hint}; run the same command again.")
    if status:
        raise RuntimeError(f"its process ended with status {status}; {log} says why.")


def _work(log: str, work: str, *arguments: object) -> None:
    """Call a function by its name with its log as what it prints to; the terminal gets a sentence on what ends it."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)  # so that nothing is left half-written
    LOGS[:] = [Path(log)]
    LOGS[0].parent.mkdir(parents=True, exist_ok=True)
    LOGS[0].unlink(missing_ok=True)
    with open(log, "a", encoding="utf-8", buffering=1) as stream:
        sys.stdout = sys.stderr = stream
        module, _, function = work.partition(":")
        try:
            getattr(importlib.import_module(module), function)(*arguments)
        except BaseException as error:
            with contextlib.suppress(OSError):  # the disk that ended it takes no more of the log
                traceback.print_exc()
                stream.flush()
            said = "".join(traceback.format_exception_only(error)).strip()
            tell(str(error) if isinstance(error, RockingError) else said)
            os._exit(1)  # what would be printed later finds the log closed


def tell(line: str) -> None:
    """Print a line into the log of this job, and to whoever started it."""
    print(line, file=sys.__stderr__, flush=True)
    if sys.stderr is not sys.__stderr__:
        with contextlib.suppress(OSError):
            print(line)
