"""One run at a time in a study: who works there, and whether a lock was left by a run that is no more."""

import ctypes
import fcntl
import json
import os
import signal
import socket
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from rocking.errors import RockingError

_POLL = 0.2
"""s between two looks at processes that end by themselves."""


@contextmanager
def only_run(folder: Path) -> Iterator[int]:
    """Hold the study in `folder` for one run, and yield the file number that its scheduler must inherit.

    The system lets go of it when the last process that holds it is gone, however it ended. Raises RockingError when
    another run works here.
    """
    path = _mark(folder)
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


def is_stale(folder: Path) -> bool:
    """Whether that lock was left by a run of ours that was killed on this machine; to be called within only_run.

    Waits for jobs that outlived their scheduler: they would write beside those of the next one.
    """
    if _marked(folder).get("host") != socket.gethostname() or any(_working(folder, _is_scheduler)):
        return False
    while any(_working(folder, _is_job)):
        time.sleep(_POLL)
    return True


def ends_with(parent: int) -> Callable[[], None]:
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


def mark(folder: Path, scheduler: int) -> None:
    """Leave a mark that the lock which snakemake takes from now on is that of our process `scheduler`."""
    known = {"host": socket.gethostname(), "process": scheduler}
    _mark(folder).write_text(json.dumps(known), encoding="utf-8")


def unmark(folder: Path) -> None:
    """Take the mark away, unless a lock is still there: then its owner was killed, and the next run may say so."""
    if not is_locked(folder):
        _mark(folder).write_text("", encoding="utf-8")


def _mark(folder: Path) -> Path:
    return folder / ".snakemake" / "rocking_run.lock"


def _marked(folder: Path) -> dict[str, object]:
    with suppress(OSError, ValueError):
        found = json.loads(_mark(folder).read_text(encoding="utf-8"))
        return found if isinstance(found, dict) else {}
    return {}


def _owner(folder: Path) -> str:
    found = _marked(folder)
    return f" (process {found['process']} on {found['host']})" if found else ""


def _is_scheduler(part: str) -> bool:
    return part.endswith(("/snakemake", "snakemake/__main__.py")) or part == "snakemake"


def _is_job(part: str) -> bool:
    return "/.snakemake/scripts/" in part


def _working(folder: Path, wanted: Callable[[str], bool]) -> Iterator[int]:
    """The processes on this machine that stand in `folder` and have a wanted part in their command line."""
    import psutil  # comes with snakemake

    place = str(folder.resolve())
    for process in psutil.process_iter():
        with suppress(psutil.Error):
            if process.cwd() == place and any(map(wanted, process.cmdline())):
                yield process.pid
