"""What a run says while it goes on. Jobs and scheduler send it, a JSON value a line, to the pipe of `rocking run`."""

import json
import os
import shutil
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any

from rocking.quantities import counted

PIPE = "ROCKING_PROGRESS"
"""The variable of the environment that names the pipe; where there is none, nothing is sent."""
_LONGEST = 1000
"""Characters of a message: what the system writes to a pipe at once, by whatever process, is at least 4096 bytes."""


def send(**told: Any) -> None:
    """Send what happened to the one who waits, if there is one."""
    text = json.dumps(
        {name: each[:_LONGEST] if isinstance(each, str) else each for name, each in told.items()}
    )
    with suppress(KeyError, OSError):  # without blocking: the one who waited may be gone
        pipe = os.open(os.environ[PIPE], os.O_WRONLY | os.O_NONBLOCK)
        try:
            os.write(pipe, text.encode() + b"\n")
        finally:
            os.close(pipe)


def line_writer(log: Path) -> Callable[[str], None]:
    """Return what adds a line to `log`, begun anew, and shows it to the one who waits."""
    log.write_text("", encoding="utf-8")

    def add(line: str) -> None:
        with log.open("a", encoding="utf-8") as stream:
            print(line, file=stream)
        send(job=log.stem, line=line)

    return add


class Progress:
    """Turns what jobs and scheduler send into lines for a person, and counts what is done.

    records: how many each job takes, by the name of its rule. width: of their longest identifier. On a terminal lines
    are cut to its width, and "12 of 44 records, about 1 min left" stands below them.
    """

    def __init__(self, records: Mapping[str, int], width: int) -> None:
        self._records, self._width = records, width
        self._terminal = sys.stdout.isatty()
        self._total = self._done = 0
        self._began = time.monotonic()
        self.errors: list[str] = []

    def __call__(self, told: Mapping[str, Any]) -> None:
        """Show what was told, if it is for a reader."""
        if "planned" in told:
            self._total = sum(self._records.get(rule, 0) for rule in told["planned"])
            self._show_so_far()
        elif told.get("begun") == "compile":
            self.say(COMPILING)
        elif "error" in told:
            self.errors.append(told["error"])
        elif told.get("job") in self._records:
            self._done += 1
            record, _, text = told["line"].partition(": ")
            self.say(f"{record:<{self._width}}  {text}")
        elif "line" in told:
            self.say(f"{told['job']}: {told['line']}")

    def say(self, line: str) -> None:
        """Show a line, and below it how far the run has come."""
        print(f"{_BACK if self._terminal else ''}{fitting(line)}", flush=True)
        self._show_so_far()

    def close(self) -> None:
        """Take away the line on how far the run has come."""
        print(_BACK if self._terminal else "", end="", flush=True)

    def _show_so_far(self) -> None:
        """Below the lines of a terminal, while records are still to come: how many are done, and the time left."""
        if not self._terminal or self._done >= self._total:
            return
        text = f"{self._done} of {counted(self._total, 'record')}"
        if self._done:
            left = (time.monotonic() - self._began) / self._done * (self._total - self._done)
            text += f", about {left / 60:.0f} min left" if left > 90 else f", about {left:.0f} s left"
        print(_BACK + fitting(text), end="", flush=True)


COMPILING = "The integration is compiled, once on this machine: about half a minute."
_BACK = "\r\x1b[K"
"""To the begin of the line on a terminal, and the line empty."""


def fitting(line: str) -> str:
    """Return `line`, cut to the width of the terminal if it is shown on one."""
    columns = shutil.get_terminal_size().columns
    return line[: columns - 1] + "…" if sys.stdout.isatty() and len(line) > columns else line
