"""The dialect of a table of numbers: how its cells, exponents, decimals and times are written, by its first lines."""

import re
from itertools import islice

import numpy as np

_SAMPLE = 40
"""Lines that are looked at: the rest of a table is like them, or its numbers are refused one by one."""
_SAMPLE_SIZE = 400 * _SAMPLE
_QUOTED = re.compile(rb'"\s*([+-]?[\d.,]*\d[\d.,]*(?:[eE][+-]?\d+)?)\s*"')
_FORTRAN = re.compile(rb"(?<=[\d.])[dD](?=[+-]?\d)")
_DECIMAL_COMMA = re.compile(rb"(?<=\d),(?=\d)|(?<![\d,]),(?=\d)")
_NUMERIC = re.compile(r"[\d+\-.,;eE \t]+")
_WITH_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")


def plain(content: bytes) -> bytes | None:
    """Return a table with its numbers as Python writes them, and times of day as seconds after the first one.

    Cells may be in quotes, as a spreadsheet writes them, and exponents begin with D, as Fortran's do. None where a
    comma may be either of two things.
    """
    head = content[:_SAMPLE_SIZE]
    if b'"' in head:
        content = _QUOTED.sub(_unquoted, content)
    if b"D+" in head or b"D-" in head:
        content = _FORTRAN.sub(b"E", content)
    is_decimal = _is_decimal_sign(content[:_SAMPLE_SIZE])
    if is_decimal is None:
        return None
    return _in_seconds(_DECIMAL_COMMA.sub(b".", content) if is_decimal else content)


def _unquoted(cell: re.Match[bytes]) -> bytes:
    """Return the number of a quoted cell, in which one comma is a decimal sign; the cell where it is no number."""
    number = cell[1].replace(b",", b".") if cell[1].count(b",") == 1 else cell[1]
    return number if number.count(b".") <= 1 and b"," not in number else cell[0]


def _is_decimal_sign(sample: bytes) -> bool | None:
    """Whether a comma in the first lines of a table is a decimal sign, and parts no columns; None where it may be both.

    It is where something else (a semicolon, a tab, blanks) parts the numbers and none has a point.
    """
    lines = sample.decode("latin-1").split("\n")[:-1]
    of_numbers = (line.strip() for line in lines if line.strip() and _NUMERIC.fullmatch(line))
    rows = list(islice(of_numbers, _SAMPLE))
    cells = [[cell for cell in re.split(r"[;\t ]+", row) if cell] for row in rows]
    with_comma = [cell for row in cells for cell in row if "," in cell]
    if not with_comma or any(cell.endswith(",") for cell in with_comma):
        return False  # a comma next to a blank separates
    may_be = all(map(_WITH_COMMA.fullmatch, with_comma))
    if any("." in row for row in rows):
        return None if may_be and any(";" in row for row in rows) else False
    if may_be and max(map(len, cells)) > 1:
        return True
    first_line = next(line for line in lines if line.strip())
    counts = [row.split(",")[0] for row in rows]
    rise = (
        np.diff([int(count) for count in counts])
        if len(rows) > 2 and all(map(str.isdecimal, counts))
        else [0]
    )
    rises_evenly = rise[0] > 0 and len(set(rise)) == 1  # as times do
    return False if rises_evenly or re.search(r"[A-Za-z]", first_line) else None


_STAMP = re.compile(
    rb"(?m)^[ \t]*\"?(?:\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}[T ][ \t]*)?"
    rb"(\d{1,2}):(\d{2}):(\d{2}(?:\.\d*)?)(?:Z|[+-]\d{2}:?\d{2})?\"?(?=[ \t,;])"
)
_STAMPS_IN = 8_000
"""Bytes at the beginning of a table in which rows begin with times of day, if any do."""
_FEWEST_STAMPS = 12
"""Stamped rows from which on they are rows of a table, and no dates of a header."""
_DAY = 86_400.0
"""s."""


def _in_seconds(content: bytes) -> bytes:
    """Return a table whose rows begin with times of day with seconds after the first in their place, else `content`."""
    if len(_STAMP.findall(content[:_STAMPS_IN])) < _FEWEST_STAMPS:
        return content
    stamps = np.array(_STAMP.findall(content)).astype(float)
    seconds = stamps @ np.array([3600.0, 60.0, 1.0])
    seconds += _DAY * np.cumsum(np.diff(seconds, prepend=seconds[0]) < -_DAY / 2)  # past midnight
    written = iter(np.round(seconds - seconds[0], 6).tolist())
    return _STAMP.sub(lambda _: b"%.6f" % next(written), content)
