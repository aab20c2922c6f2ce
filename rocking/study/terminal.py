"""What a run says: its progress, which jobs and scheduler send as JSON lines, and what came of the records."""

import json
import os
import sys
import tempfile
import time
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from threading import Thread
from typing import Any, BinaryIO, TextIO

from rocking.assessment.fate import ORDER, Fate, worst_first
from rocking.assessment.rows.of_record import FailureRow
from rocking.assessment.verdict import Verdict, rocks
from rocking.errors import RecordError
from rocking.quantities import counted
from rocking.tables import read_table

_MOST = 6
"""Rows of a list at the end; a screen should hold it beside the lines of a dozen records."""
_MARKS = {Verdict.UNDECIDED: "?", Verdict.UNKNOWN: "–"}


def record_line(verdicts: Iterable[Fate], failures: Iterable[FailureRow]) -> str:
    """Say in one line what came of a record: "overturns: pier; undecided: wall (12 of 64); stands: arch 0.31".

    The numbers are members of the ensemble that overturn, or the largest rotation over the critical one of the worst
    component. What could not be assessed comes first.
    """
    parts: dict[str, list[str]] = {word: [] for word in ("failed", *ORDER)}
    for failure in failures:
        of = f"{failure.structure}: " if failure.structure else ""
        parts["failed"].append(of + failure.message.removeprefix(f"{failure.record}: "))
    for fate in sorted(verdicts, key=lambda fate: fate.severity, reverse=True):
        number = f" {fate.rotation_ratio:.2g}" if rocks(fate.rotation_ratio) else ""
        parts[fate.verdict].append(fate.structure + (f" ({fate.leaning})" if fate.leaning else number))
    parts["failed"] = [" ".join(parts["failed"])] if parts["failed"] else []
    return "; ".join(f"{word}: {', '.join(names)}" for word, names in parts.items() if names)


def closing_lines(verdicts: Sequence[Fate], failures: Iterable[FailureRow]) -> Iterator[str]:
    """Yield a table of the structures that do not stand everywhere: two counts, and the names of the records.

    Below it stand the records that failed.
    """
    of_structure: dict[str, list[Fate]] = {}
    for fate in sorted(verdicts, key=lambda fate: fate.severity, reverse=True):
        if fate.verdict is not Verdict.STANDS:
            of_structure.setdefault(fate.structure, []).append(fate)

    def count(name: str, verdict: Verdict) -> int:
        return sum(fate.verdict is verdict for fate in of_structure[name])

    ordered = sorted(
        of_structure, key=lambda name: (-count(name, Verdict.OVERTURNS), -len(of_structure[name]))
    )
    records = counted(len({fate.record for fate in verdicts}), "record")
    if ordered:
        width = max(9, *map(len, ordered[:_MOST]))
        yield f"Of {records}:"
        yield f"  {'':<{width}}  overturns  undecided  records (?: undecided, –: unknown)"
        for name in ordered[:_MOST]:
            names = ", ".join(fate.record + _MARKS.get(fate.verdict, "") for fate in of_structure[name])
            counts = (count(name, Verdict.OVERTURNS), count(name, Verdict.UNDECIDED))
            yield f"  {name:<{width}}  {counts[0]:>9}  {counts[1]:>9}  {names}"
        if len(ordered) > _MOST:
            yield f"  and {counted(len(ordered) - _MOST, 'more structure')}, in {Fate.table.file_name}"
    elif verdicts:
        yield f"Every structure stands under {records}."
    if failed := sorted({failure.record for failure in failures}):
        yield f"{counted(len(failed), 'record')} failed, wholly or in part: {', '.join(failed)}"


def check_any_read(summary: str | Path, records: Collection[str]) -> None:
    """Raise RecordError when the summary in a folder says of each of `records` that it could not be read.

    Without a summary, as where another target was asked for, nothing is said.
    """
    if not (Path(summary) / FailureRow.table.file_name).is_file():
        return
    unread = {row.record: row for row in read_table(FailureRow, Path(summary)) if row.stage == "read"}
    if set(unread) >= set(records):
        first = next(iter(unread.values()))
        raise RecordError(
            f"none of {counted(len(records), 'record')} could be read; the first: {first.message}"
        )


def paths_to_read(results: Path, verdicts: Iterable[Fate]) -> Iterator[str]:
    """Yield a line for each of the files that come next for a reader, the report of the worst record among them."""
    summary = results / "summary"
    yield from (f"Page to explore: {page}" for page in sorted(summary.glob("*.html")))
    yield f"Summary: {report if (report := summary / 'summary.pdf').is_file() else summary}"
    records = worst_first((fate.record, fate) for fate in verdicts)
    if records and (report := results / records[0] / "report.pdf").is_file():
        yield f"Report of the worst record: {report}"


PIPE = "ROCKING_PROGRESS"
"""The variable of the environment that names the pipe; where there is none, nothing is sent."""
_LONGEST = 1000
"""Characters of a message: what the system writes to a pipe at once, by whatever process, is at least 4096 bytes."""


def send(**event: Any) -> None:
    """Send what happened to the one who waits, if there is one."""
    text = json.dumps(
        {name: each[:_LONGEST] if isinstance(each, str) else each for name, each in event.items()}
    )
    with suppress(KeyError, OSError):  # without blocking: the one who waited may be gone
        pipe = os.open(os.environ[PIPE], os.O_WRONLY | os.O_NONBLOCK)
        try:
            os.write(pipe, text.encode() + b"\n")
        finally:
            os.close(pipe)


def line_writer(log: Path) -> Callable[[str], None]:
    """Return what adds a line to `log`, begun anew, and shows it to the one who waits, or else on the terminal."""
    log.write_text("", encoding="utf-8")

    def add(line: str) -> None:
        with log.open("a", encoding="utf-8") as stream:
            print(line, file=stream)
        if PIPE in os.environ:
            send(job=log.stem, line=line)
        else:
            print(line, file=sys.stderr, flush=True)

    return add


class Progress:
    """Turns what jobs and scheduler send into lines for a person, and counts what is done.

    records: how many each job takes, by the name of its rule. width: of their longest identifier. On a terminal, lines
    are cut to its width, and "12 of 44 records, about 1 min left" stands below them.
    """

    def __init__(self, records: Mapping[str, int], width: int, stream: TextIO) -> None:
        self._records = records
        self._width = width
        self.stream = stream
        self._back = "\r\x1b[K" if stream.isatty() else ""  # to the begin of the line, and the line empty
        self._total = 0
        self._done = 0
        self._began = time.monotonic()
        self.errors: list[str] = []

    @contextmanager
    def followed(self) -> Iterator[None]:
        """Show what is sent meanwhile, all of it before the end."""
        with tempfile.TemporaryDirectory() as folder:
            pipe = os.environ[PIPE] = str(Path(folder) / "progress")
            os.mkfifo(pipe)
            with os.fdopen(os.open(pipe, os.O_RDWR), "rb") as lines:
                reader = Thread(target=self._follow, args=(lines,))
                reader.start()
                try:
                    yield
                finally:
                    os.write(lines.fileno(), b"\n")
                    reader.join()
                    del os.environ[PIPE]
        print(self._back, end="", file=self.stream, flush=True)

    def _follow(self, lines: BinaryIO) -> None:
        for line in iter(lines.readline, b"\n"):
            self.tell(json.loads(line))

    def tell(self, event: Mapping[str, Any]) -> None:
        """Show an event, if it is for a reader."""
        if "planned" in event:
            self._total = sum(self._records.get(rule, 0) for rule in event["planned"])
        elif event.get("begun") == "compile":
            self._show("The integration is compiled, once on this machine: about half a minute.")
        elif "error" in event:
            self.errors.append(event["error"])
        elif event.get("job") in self._records:
            self._done += 1
            record, _, text = event["line"].partition(": ")
            self._show(f"{record:<{self._width}}  {text}")
        elif "line" in event:
            self._show(f"{event['job']}: {event['line']}")
        if self._back and self._done < self._total:
            text = f"{self._done} of {counted(self._total, 'record')}"
            if self._done:
                left = (time.monotonic() - self._began) / self._done * (self._total - self._done)
                text += f", about {left / 60:.0f} min left" if left > 90 else f", about {left:.0f} s left"
            print(self._back + fitting(text, self.stream), end="", file=self.stream, flush=True)

    def _show(self, line: str) -> None:
        print(self._back + fitting(line, self.stream), file=self.stream, flush=True)


def fitting(line: str, stream: TextIO) -> str:
    """Return `line`, cut to the width of the terminal if `stream` is one."""
    columns = os.get_terminal_size(stream.fileno()).columns if stream.isatty() else 0
    return line[: columns - 1] + "…" if 0 < columns < len(line) else line
