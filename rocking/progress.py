"""What a terminal shows of a command that takes a while: a bar, and lines that fit."""

import os
import sys
from collections.abc import Iterable
from typing import TextIO, TypeVar

from tqdm import tqdm

T = TypeVar("T")


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


def columns_of(stream: TextIO) -> int:
    """Return the width of the terminal, if `stream` is one, else 0."""
    return os.get_terminal_size(stream.fileno()).columns if stream.isatty() else 0


def fitting(line: str, stream: TextIO) -> str:
    """Return `line`, cut to the width of the terminal if `stream` is one."""
    columns = columns_of(stream)
    return line[: columns - 1] + "…" if 0 < columns < len(line) else line
