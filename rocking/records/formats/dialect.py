"""The dialect of a table of numbers: how its cells, exponents, decimals and times are written, by its first lines."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum, auto
from itertools import islice, pairwise

import numpy as np

_SAMPLE = 40
"""Lines that are looked at: the rest of a table is like them, or its numbers are refused one by one."""
_SAMPLE_SIZE = 400 * _SAMPLE
_QUOTED = re.compile(rb'"\s*([+-]?[\d.,]*\d[\d.,]*(?:[eE][+-]?\d+)?)\s*"')
_FORTRAN = re.compile(rb"(?<=[\d.])[dD](?=[+-]?\d)")
_DECIMAL_COMMA = re.compile(rb"(?<=\d),(?=\d)|(?<![\d,]),(?=\d)")
_NUMERIC = re.compile(r"[\d+\-.,;eE \t]+")
_WITH_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")


class Comma(Enum):
    """The meaning of a comma in a table."""

    PARTS = auto()
    """It stands between two columns, or the table has none."""
    IS_DECIMAL = auto()
    """It is the decimal sign of a number."""
    IS_EITHER = auto()
    """The table can be read both ways."""


@dataclass(frozen=True)
class Dialect:
    """The way in which the numbers of a table are written.

    is_quoted: cells stand in quotes, as a spreadsheet writes them. is_fortran: exponents begin with D. comma: what a
    comma means once the quotes are gone.
    """

    is_quoted: bool
    is_fortran: bool
    comma: Comma

    @classmethod
    def of(cls, content: bytes) -> "Dialect":
        """Return the dialect that the first lines of a table speak."""
        head = content[:_SAMPLE_SIZE]
        is_quoted = b'"' in head
        is_fortran = b"D+" in head or b"D-" in head
        # Without its quotes the sample is shorter, by less than half.
        sample = _bare(content[: 2 * _SAMPLE_SIZE], is_quoted, is_fortran)[:_SAMPLE_SIZE]
        return cls(is_quoted, is_fortran, _comma(sample))

    def plain(self, content: bytes) -> bytes | None:
        """Return `content` with its numbers as Python writes them, and times of day as seconds after the first one.

        None where a comma may be either of two things.
        """
        if self.comma is Comma.IS_EITHER:
            return None
        bare = _bare(content, self.is_quoted, self.is_fortran)
        return _in_seconds(_DECIMAL_COMMA.sub(b".", bare) if self.comma is Comma.IS_DECIMAL else bare)


def _bare(content: bytes, is_quoted: bool, is_fortran: bool) -> bytes:
    """Return `content` without the quotes of a spreadsheet, and with E for Fortran's D."""
    if is_quoted:
        content = _QUOTED.sub(_unquoted, content)
    if is_fortran:
        content = _FORTRAN.sub(b"E", content)
    return content


def _unquoted(cell: re.Match[bytes]) -> bytes:
    """Return the number of a quoted cell, in which one comma is a decimal sign; the cell where it is no number."""
    number = cell[1].replace(b",", b".") if cell[1].count(b",") == 1 else cell[1]
    return number if number.count(b".") <= 1 and b"," not in number else cell[0]


def _comma(sample: bytes) -> Comma:
    """Return what a comma means in the first lines of a table.

    It is a decimal sign where something else (a semicolon, a tab, blanks) parts the numbers and none has a point.
    """
    lines = sample.decode("latin-1").split("\n")[:-1]
    of_numbers = (line.strip() for line in lines if line.strip() and _NUMERIC.fullmatch(line))
    rows = list(islice(of_numbers, _SAMPLE))
    cells = [[cell for cell in re.split(r"[;\t ]+", row) if cell] for row in rows]
    with_comma = [cell for row in cells for cell in row if "," in cell]
    if not with_comma or any(cell.endswith(",") for cell in with_comma):
        return Comma.PARTS  # a comma beside a blank parts
    may_be_decimal = all(map(_WITH_COMMA.fullmatch, with_comma))
    if any("." in row for row in rows):
        has_semicolons = any(";" in row for row in rows)
        return Comma.IS_EITHER if may_be_decimal and has_semicolons else Comma.PARTS
    if may_be_decimal and max(map(len, cells)) > 1:
        return Comma.IS_DECIMAL
    first_line = next(line for line in lines if line.strip())
    has_names = re.search(r"[A-Za-z]", first_line) is not None
    return Comma.PARTS if has_names or _count_upwards(rows) else Comma.IS_EITHER


def _count_upwards(rows: Sequence[str]) -> bool:
    """Whether the numbers before the first comma of each row rise evenly, as times do."""
    first = [row.split(",")[0] for row in rows]
    if len(rows) < 3 or not all(map(str.isdecimal, first)):
        return False
    steps = {int(after) - int(before) for before, after in pairwise(first)}
    return len(steps) == 1 and steps.pop() > 0


_STAMP = re.compile(
    rb"(?m)^[ \t]*\"?(?:\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}[T ][ \t]*)?"
    rb"(\d{1,2}):(\d{2}):(\d{2}(?:\.\d*)?)(?:Z|[+-]\d{2}:?\d{2})?\"?(?=[ \t,;])"
)
_STAMPS_IN = 8_000
"""Bytes at the beginning of a table in which rows with times of day stand, if it has any."""
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
