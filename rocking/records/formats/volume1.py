"""Volume 1 text: 13 lines of text, 7 of integers, 7 of reals, then samples in tenths of g."""

import re
from dataclasses import dataclass

import numpy as np

from rocking.errors import RecordError
from rocking.records.formats.header import blocks, check_nothing_left, required
from rocking.records.formats.sampling import check_no_gap, even_step
from rocking.records.formats.text import count, fields, in_columns, is_number, number, whole

_HEADER, _REALS, _RATE = 27, 20, 8
_TEXT = 13
_STEP = 0.005
"""s; the even step to which film records are interpolated."""
_LONGEST_GAP = 0.25
"""s."""


@dataclass(frozen=True)
class Block:
    """One channel: its text header, the samples declared, the duration declared [s], and its rows of numbers."""

    head: str
    declared: int
    duration: float
    rows: list[str]
    rate: float | None
    """Samples per second, where the reals of the header say it."""


def channels(content: bytes, first_line: re.Pattern[str]) -> list[Block]:
    """Return the channels of a file. Raises RecordError when the header is cut or not in tenths of g."""
    return [volume1_block(lines) for lines in blocks(content, first_line)]


def volume1_block(lines: list[str]) -> Block:
    """Return one channel from its lines. Raises RecordError when the header is cut or not in tenths of g."""
    head = "\n".join(lines[:_TEXT])
    said = required(
        "points and length",
        r"NO\. OF POINTS\s*=\s*(\S+)\s+(?:DURATION|RECORD LENGTH)\s*=\s*([\d.]+)",
        head,
    )
    required("units of G/10", r"^UNITS\b.*\bG/10", head)
    body = lines[_HEADER:]
    end = next((i for i, row in enumerate(body) if row.startswith("/&")), len(body))
    check_nothing_left(body[end + 1 :])
    rows = [row for row in body[:end] if row.strip()]
    return Block(head, count("NO. OF POINTS", said[1]), number("duration", said[2]), rows, _rate(lines))


def _rate(lines: list[str]) -> float | None:
    reals = " ".join(lines[_REALS : _REALS + 2]).split()
    found = reals[_RATE] if len(reals) > _RATE and is_number(reals[_RATE]) else "0"
    return float(found) if 1 <= float(found) <= 1e4 else None


def pairs(block: Block, margin: int) -> tuple[np.ndarray, np.ndarray]:
    """Return (times, samples) of a block of five (t, a) pairs a line in columns of 7."""
    table = in_columns(fields(block.rows, 7, margin), 2)
    whole(table[:, 0], block.declared, per_line=0)
    _check_end(table[:, 0], block.duration)
    return table[:, 0], table[:, 1]


def _check_end(times: np.ndarray, duration: float) -> None:
    """Check the last time against the duration, which counts a last step or does not."""
    step = (times[-1] - times[0]) / (times.size - 1)
    if abs(duration - times[-1]) > 2 * step + 0.001:
        raise RecordError(
            f"the header declares a length of {duration:g} s, but the last sample stands at {times[-1]:g} s; "
            "the file is damaged or its header belongs to another record."
        )


def evened(times: np.ndarray, values: np.ndarray) -> tuple[float, np.ndarray, tuple[str, ...]]:
    """Return (step, samples at even times, sentences) of a trace digitised from film: linear between its points.

    Raises RecordError at a gap: points were digitised where the trace bends, a dozen to a hundred a second.
    """
    step = even_step(times)
    if step is not None:
        return step, values, ()
    check_no_gap(times, _LONGEST_GAP)
    even = np.arange(round(times[0] / _STEP), int(times[-1] / _STEP + 1e-6) + 1) * _STEP
    sentence = f"The {times.size} samples are unevenly spaced; interpolated linearly to {even.size}, {_STEP:g} s apart."
    return _STEP, np.interp(even, times, values), (sentence,)
