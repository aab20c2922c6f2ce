"""Separators: what parts the numbers of a plain table, and whether a comma is one of them or a decimal sign."""

import re
from itertools import pairwise

_DECIMAL = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
_NUMERIC = re.compile(r"[\d+\-.,;eE \t]+")
_SAMPLE = 40
"""Lines that are looked at: the rest of a table is like them, or its numbers are refused one by one."""


def points_for_commas(content: bytes) -> bytes | None:
    """Return `content` with points for its decimal commas; unchanged where commas part numbers or there are none.

    A comma is a decimal sign where something else (a semicolon, a tab, blanks) parts the numbers and none has a point.
    None where both readings are possible.
    """
    head = content[: 400 * _SAMPLE].decode("latin-1").replace("\r", "\n").split("\n")[:-1]
    rows = [line.strip() for line in head if line.strip() and _NUMERIC.fullmatch(line)][:_SAMPLE]
    if not any("," in row for row in rows):
        return content
    cells = [[cell for cell in re.split(r"[;\t ]+", row) if cell] for row in rows]
    if any((cell.startswith(",") and len(cell) == 1) or cell.endswith(",") for row in cells for cell in row):
        return content  # a comma beside a blank parts
    with_comma = [cell for row in cells for cell in row if "," in cell]
    decimal = all(_DECIMAL.fullmatch(cell) for cell in with_comma)
    if any("." in row for row in rows):
        return None if decimal and any(";" in row for row in rows) else content
    if decimal and max(map(len, cells)) > 1:
        return re.sub(rb"(?<=\d),(?=\d)|(?<![\d,]),(?=\d)", b".", content)
    named = re.search(r"[A-Za-z]", next(line for line in head if line.strip()))
    return content if named or _counts(rows) else None


def _counts(rows: list[str]) -> bool:
    """Whether the first numbers count evenly upwards, as times do."""
    first = [row.split(",")[0] for row in rows]
    if not all(cell.isdecimal() for cell in first):
        return False
    steps = {int(b) - int(a) for a, b in pairwise(first)}
    return len(rows) > 2 and len(steps) == 1 and steps.pop() > 0
