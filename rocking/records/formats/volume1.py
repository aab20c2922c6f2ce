"""Volume 1 text: 13 lines of text, 7 of integers, 7 of reals, then samples in tenths of g."""

import re
from dataclasses import dataclass

import numpy as np

from rocking.errors import RecordError
from rocking.records.formats.header import blocks, required
from rocking.records.formats.text import count, fields, number, whole

_HEADER = 27
_TEXT = 13


@dataclass(frozen=True)
class Block:
    """One channel: its text header, the samples declared, the duration declared [s], and its rows of numbers."""

    head: str
    declared: int
    duration: float
    rows: list[str]


def channels(content: bytes, first_line: re.Pattern[str], name: str) -> list[Block]:
    """Return the channels of a file. Raises RecordError when the header is cut or not in tenths of g."""
    return [_block(lines, name) for lines in blocks(content, first_line)]


def _block(lines: list[str], name: str) -> Block:
    head = "\n".join(lines[:_TEXT])
    said = required(
        name,
        "points and length",
        r"NO\. OF POINTS\s*=\s*(\S+)\s+(?:DURATION|RECORD LENGTH)\s*=\s*([\d.]+)",
        head,
    )
    required(name, "units of G/10", r"^UNITS\b.*\bG/10", head)
    rows = [row for row in lines[_HEADER:] if row.strip()]
    if rows and rows[-1].startswith("/&"):
        rows = rows[:-1]
    return Block(head, count(name, "NO. OF POINTS", said[1]), number(name, "duration", said[2]), rows)


def pairs(block: Block, name: str, margin: int) -> tuple[np.ndarray, np.ndarray]:
    """Return (times, samples) of a block of five (t, a) pairs a line in columns of 7."""
    values = fields(name, block.rows, 7, margin)
    if values.size % 2:
        raise RecordError(
            f"{name}: the block holds {values.size} numbers, but (time, sample) pairs need an even number."
        )
    table = values.reshape(-1, 2)
    whole(name, table[:, 0], block.declared, per_line=0)
    return table[:, 0], table[:, 1]
