"""The progress of a run: what its jobs report as JSON lines in a pipe, and the lines and the bar that show it."""

import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from types import TracebackType
from typing import BinaryIO, TextIO, TypeVar

from tqdm import tqdm

from rocking.errors import LOGS, RockingError, log_fault
from rocking.quantities import escaped
from rocking.study.folder import new_log

T = TypeVar("T")

_PIPE = "ROCKING_PROGRESS"
"""The variable of the environment that names the pipe from the jobs to the one who waits."""
_LONGEST = 1000
"""Characters of a line: what the system writes to a pipe at once, by whatever process, is at least 4096 bytes."""
_COMPILATION = "compile"
"""What a job is called that compiles before it begins."""


def bar(things: Iterable[T], what: str, total: int | None = None) -> "tqdm[T]":
    """Return `things`, which show a bar with the time that remains while they are gone through, on a terminal alone.

    what: one of them, "file". total: how many there are; None asks `things`. The bar is gone at the end.
    """
    tqdm.monitor_interval = 0  # no thread of its own
    shape = f"{{n:.0f}} of {{total:.0f}} {what}s {{bar}} {{remaining}} left"
    # None: not where nobody looks. The stream itself, for that of the command writes no control characters.
    return tqdm(
        things,
        total=total,
        disable=None,
        leave=False,
        file=sys.__stderr__,
        bar_format=shape,
        dynamic_ncols=True,
        smoothing=0,
    )


class Progress:
    """Turns what jobs and scheduler report into lines for a person, and counts what is done.

    records: of the study. On a terminal, lines are cut to its width, and below them stands a bar with the time that
    remains. It alone writes there, whatever number of jobs report something.
    """

    in_this_process: "Progress | None" = None

    def __init__(self, records: int, batches: int, stream: TextIO) -> None:
        self._of_a_job = {"record": 1.0, "batch": records / max(1, batches)}
        self._stream = stream
        self._back = "\r\x1b[K" if stream.isatty() else ""  # to the begin of the line, and the line empty
        self._what = "record"
        self._total = 0
        self._done = 0
        self._began = time.monotonic()
        self._moving = ""
        self.errors: list[str] = []
        self.reasons: list[str] = []

    @contextmanager
    def followed(self) -> Iterator[None]:
        """Show what is reported meanwhile, all of it before the end."""
        Progress.in_this_process = self
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.environ[_PIPE] = str(Path(folder) / "progress")
            os.mkfifo(pipe)
            with os.fdopen(os.open(pipe, os.O_RDWR), "rb") as lines:
                reader = Thread(target=self._follow, args=(lines,))
                reader.start()
                try:
                    yield
                finally:
                    os.write(lines.fileno(), b"\n")
                    reader.join()
                    del os.environ[_PIPE]
                    Progress.in_this_process = None
        print(self._back, end="", file=self._stream, flush=True)

    def _follow(self, lines: BinaryIO) -> None:
        for line in iter(lines.readline, b"\n"):
            self.show_line(*json.loads(line))

    def count_jobs(self, jobs: Mapping[str, int]) -> None:
        """Take up how many jobs of each rule will run."""
        self._total = round(sum(self._of_a_job.get(rule, 0) * number for rule, number in jobs.items()))
        self._show()

    def show_line(self, rule: str, line: str, done: int = 0, total: int = 0) -> None:
        """Show a line of a job; those that assess send one for each record. Keep the reason why one failed.

        done, total: what a job that is waited for counts itself; 0 where it counts nothing.
        """
        if rule == "error":
            self.reasons.append(line)
            return
        if rule == _COMPILATION:
            self._move(line, is_last=done == total)
            return
        of_a_record = rule in ("record", "batch")
        self._done += of_a_record
        if total and not self._total:
            self._what = "part"
        if total and self._what == "part":
            self._done, self._total = done, total
        self._show(line if of_a_record else f"{rule}: {line}")

    def _move(self, line: str, is_last: bool) -> None:
        """Show a line in place of the one before it, in that of the bar; without a terminal the first and the last."""
        began, self._moving = self._moving, "" if is_last else line
        if is_last or not (began or self._back):
            self._show(line)
        elif self._back:
            print(self._back + fitting(line, self._stream), end="", file=self._stream, flush=True)

    def _show(self, *lines: str) -> None:
        for line in lines:
            text = fitting(escaped(line), self._stream)
            print(self._back + text, file=self._stream, flush=True)
        if self._back and self._done < self._total:
            shown = tqdm.format_meter(
                self._done,
                self._total,
                time.monotonic() - self._began,
                ncols=max(columns_of(self._stream) - 1, 0) or None,
                bar_format=f"{{n}} of {{total}} {self._what}s {{bar}} {{remaining}} left",
            )
            print(self._back + shown, end="", file=self._stream, flush=True)


def send_line(job: str, line: str, done: int = 0, total: int = 0) -> None:
    """Tell the one who waits for a job, another process, or else the terminal."""
    try:
        pipe = os.open(os.environ[_PIPE], os.O_WRONLY | os.O_NONBLOCK)  # who waited may be gone
    except (KeyError, OSError):
        print(line, file=sys.stderr, flush=True)
        return
    with os.fdopen(pipe, "wb", buffering=0) as stream:
        stream.write(json.dumps([job, line[:_LONGEST], done, total], ensure_ascii=False).encode() + b"\n")


def send_compilation(line: str, is_last: bool) -> None:
    """Tell how long a job has been compiling, in a line that stands for the one before it, or that it has done so."""
    send_line(_COMPILATION, line, int(is_last), 1)


def line_writer(log: Path, rule: str) -> Callable[..., None]:
    """Return what adds a line to a new `log`, and sends it as one of a job of this `rule`, with what it counts."""
    new_log(log).close()
    LOGS[:] = [log]

    def add(line: str, done: int = 0, total: int = 0) -> None:
        with log.open("a", encoding="utf-8") as stream:
            print(line, file=stream)
        send_line(rule, line, done, total)

    return add


def send_error(kind: type[BaseException], error: BaseException, trace: TracebackType | None) -> None:
    """Tell why this process fails, before Python does: in place of sys.excepthook."""
    if isinstance(error, RockingError | OSError):
        place = f"{getattr(error, 'filename', None) or 'a file'}: " * isinstance(error, OSError)
        send_line("error", place + (getattr(error, "strerror", None) or str(error)))
    elif isinstance(error, MemoryError):
        send_line("error", "a job had not enough memory; give more, or run fewer jobs at once: -- --cores 1")
    elif isinstance(error, Exception):
        send_line(
            "error", f"a job ended with {kind.__name__}: {' '.join(str(error).split())}; its log says where"
        )
    log_error(error)
    sys.__excepthook__(kind, error, trace)


def log_error(error: BaseException) -> None:
    """Add the traceback of an error to the log that this process has begun, if any."""
    for log in LOGS:
        log_fault(error, log)


def columns_of(stream: TextIO) -> int:
    """Return the width of the terminal, if `stream` is one, else 0."""
    return os.get_terminal_size(stream.fileno()).columns if stream.isatty() else 0


def fitting(line: str, stream: TextIO) -> str:
    """Return `line`, cut to the width of the terminal if `stream` is one."""
    columns = columns_of(stream)
    return line[: columns - 1] + "…" if 0 < columns < len(line) else line
