"""Plain columns: time and acceleration, several named channels, or one series wrapped over lines (OpenSees)."""

import re
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_unit
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.sampling import even_step, resampled
from rocking.records.formats.text import after_lines, is_number, lines, numbers
from rocking.records.instrument import other_quantity, refuse_other_quantity

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_TIME = re.compile(
    r"t|(time|zeit|tiempo|temps|tempo|zaman|seconds?)\b.*|[^()\[\]]*[(\[]\s*s(ec)?\s*[)\]]", re.I
)
_UNIT = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_EMPTY_CELL = re.compile(rb"[,;][ \t]*(?=[,;])|(?m:^)[ \t]*[,;]")
_DECIMALS = re.compile(r"[.]?(\d*)(?:[eE][+-]?\d+)?\s*$")
_HEAD, _TAIL = 12, 4000
"""Lines and bytes that are looked at, of the beginning and of the end."""
_BLANK, _LINE_END = 32, 10
_COMMENTED_FORMAT = b"#Earthquake Information"
"""CWB's header, which looks like comments above columns."""


@dataclass(frozen=True)
class _Table:
    names: tuple[str, ...]
    width: int
    start: int
    """Number of lines before the first row of numbers."""


def _cells(line: str) -> list[str]:
    line = line.strip().rstrip(",;").rstrip()
    return _SEPARATOR.split(line) if line else []


def _names(line: str) -> tuple[str, ...]:
    parts = re.split(r"[,;\t]", line) if re.search(r"[,;\t]", line) else line.split()
    return tuple(part.strip().strip("\"'") for part in parts)


def _table(content: bytes) -> _Table | None:
    """Return how the columns stand, or None when the head is not comments, at most one row of names, then numbers."""
    names: tuple[str, ...] = ()
    widths: list[int] = []
    start = 0
    for line in (line for line in lines(content, _HEAD) if len(line) < 2000):
        cells = _cells(line)
        if not cells or (line.lstrip().startswith(("#", "%")) and not widths):
            start += not widths
        elif all(is_number(cell) for cell in cells):
            widths.append(len(cells))
        elif names or widths:
            return None
        else:
            names, start = _names(line), start + 1
    uneven = len(set(widths[:-1])) > 1 or widths[-1:] > widths[:1]
    if len(widths) < 2 or uneven or (names and len(names) != widths[0]):
        return None
    return _Table(names, widths[0], start)


def _recognise(content: bytes) -> bool:
    other = content.startswith(_COMMENTED_FORMAT) or b"\0" in content[:4096]
    return not other and _table(points_for_commas(content) or content) is not None


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    pointed = points_for_commas(content)
    if pointed is None:
        raise RecordError(
            "the commas may be decimal signs or part the columns; write points for decimals, or part the columns "
            "with semicolons."
        )
    content = pointed or content
    table = _table(content)
    if table is None:
        raise RecordError("the file does not hold columns of numbers below at most one row of names.")
    refuse_other_quantity(options.file, "\n".join(lines(content, _HEAD)[: table.start]))
    width = table.width
    body = after_lines(content, table.start)
    if _EMPTY_CELL.search(body):
        raise RecordError("a cell is empty; every column needs a number on every line.")
    values = numbers(body.replace(b",", b" ").replace(b";", b" "))
    cut = _cut_number(body)
    wrapped = width > 2 and not table.names and not _time_first(values, width)
    _check_rows(body, width, last_may_be_short=wrapped)
    if width == 1 or wrapped:
        label = table.names[0] if table.names else ""
        named = "" if _unit(label) else label
        found = [_channel(named, label, values, None, options, warnings=_repeats(values))]
    else:
        found = _channels(values.reshape(-1, width), table.names, options)
    return [replace(record, warnings=record.warnings + cut) for record in found]


def _cut_number(body: bytes) -> tuple[str, ...]:
    """Return a warning when the last number has fewer decimals than all above it, and no line end: the file is cut."""
    if body.endswith(b"\n"):
        return ()
    last = [_DECIMALS.search(line) for line in lines(body[-_TAIL:])[1:] if line.strip()]
    decimals = [len(found[1]) for found in last if found]
    if len(decimals) < 3 or decimals[-1] >= min(decimals[:-1]):
        return ()
    return ("The last number has fewer decimals than those above it and no line end: the file may be cut.",)


def _time_first(values: np.ndarray, width: int) -> bool:
    """Whether the first of `width` columns without names counts time: evenly upwards from zero or above."""
    first = values[: values.size - values.size % width][: 50 * width : width]
    steps = np.diff(first)
    return first.size > 2 and first[0] >= 0 and steps.min() > 0 and float(np.ptp(steps)) < 0.01 * steps[0]


def _check_rows(body: bytes, width: int, last_may_be_short: bool) -> None:
    """Check that each row holds `width` numbers. Raises RecordError naming the first that does not."""
    octets = np.frombuffer(body + b"\n", dtype=np.uint8)
    apart = (octets <= _BLANK) | (octets == ord(",")) | (octets == ord(";"))
    first = np.flatnonzero(~apart & np.concatenate([[True], apart[:-1]]))
    ends = np.flatnonzero(octets == _LINE_END)
    filled = np.diff(np.searchsorted(first, ends), prepend=0)
    rows = filled[filled != 0]
    wrong = np.flatnonzero(rows != width)
    if last_may_be_short and wrong.size == 1 and wrong[0] == rows.size - 1 and rows[-1] < width:
        return
    if wrong.size:
        raise RecordError(
            f"row {wrong[0] + 1} of the samples has {rows[wrong[0]]} columns, but the first has {width}."
        )


def _repeats(values: np.ndarray) -> tuple[str, ...]:
    """Return a warning when numbers without count or times come twice."""
    half, odd = divmod(values.size, 2)
    if odd or half < 2 or not np.any(values) or not np.array_equal(values[:half], values[half:]):
        return ()
    return (
        f"The second half of the samples repeats the first, {half} numbers: the file may be appended to itself.",
    )


def _channels(rows: np.ndarray, names: tuple[str, ...], options: Options) -> list[Accelerogram]:
    labels = names or ("time", *[""] * (rows.shape[1] - 1))
    timed = bool(_TIME.fullmatch(labels[0]))
    told: tuple[str, ...] = ()
    step, warnings = options.time_step, _repeats(rows.ravel())
    if timed:
        step, rows, told = _evened(rows)
        warnings = told
    return [
        _channel(_component(label), label, rows[:, i], step, options, processing=told, warnings=warnings)
        for i, label in enumerate(labels)
        if i >= timed and other_quantity(label) is None
    ]


def _evened(rows: np.ndarray) -> tuple[float, np.ndarray, tuple[str, ...]]:
    """Return (step, rows at even times, sentences) of rows that begin with their time."""
    step = even_step(rows[:, 0])
    if step is not None:
        return step, rows, ()
    step, at, sentence = resampled(rows[:, 0])
    return step, np.stack([np.interp(at, rows[:, 0], column) for column in rows.T], axis=1), (sentence,)


def _channel(
    component: str, label: str, values: np.ndarray, step: float | None, options: Options, **fields
) -> Accelerogram:
    return options.accelerogram(_unit(label), values, step, component=component, processed=None, **fields)


def _unit(label: str) -> str | None:
    found = _UNIT.search(label)
    return acceleration_unit(found[1]) if found else None


def _component(label: str) -> str:
    return re.sub(r"^(acc|acceleration|a)[_\s-]+", "", _UNIT.sub("", label).strip(), flags=re.I)


_WITH_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
_NUMERIC = re.compile(r"[\d+\-.,;eE \t]+")
_SAMPLE = 40
"""Lines that are looked at: the rest of a table is like them, or its numbers are refused one by one."""


def points_for_commas(content: bytes) -> bytes | None:
    """Return `content` with points for its decimal commas; unchanged where commas part numbers or there are none.

    A comma is a decimal sign where something else (a semicolon, a tab, blanks) parts the numbers and none has a point.
    None where both readings are possible.
    """
    head = content[: 400 * _SAMPLE].decode("latin-1").split("\n")[:-1]
    rows = [line.strip() for line in head if line.strip() and _NUMERIC.fullmatch(line)][:_SAMPLE]
    if not any("," in row for row in rows):
        return content
    cells = [[cell for cell in re.split(r"[;\t ]+", row) if cell] for row in rows]
    if any((cell.startswith(",") and len(cell) == 1) or cell.endswith(",") for row in cells for cell in row):
        return content  # a comma beside a blank parts
    with_comma = [cell for row in cells for cell in row if "," in cell]
    decimal = all(_WITH_COMMA.fullmatch(cell) for cell in with_comma)
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


COLUMNS = Format("columns of numbers", "spreadsheets, OpenSees and scripts",
    "lines that hold numbers only, below at most one row of names", _recognise, _read)  # fmt: skip
