"""Bare numbers: columns, or one series wrapped over lines (OpenSees), below names or a title with count and step."""

import re
from itertools import pairwise
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_unit
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats import text
from rocking.records.formats.format import Format, Options
from rocking.records.instrument import other_quantity, refuse_other_quantity

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_TIME = re.compile(
    r"(?i)t\d?|(time|zeit|tiempo|temp[os]|zaman|seconds?)(?![a-z]).*|[^()\[\]]*[(\[]\s*s(ec)?\s*[)\]]"
)
_UNIT = re.compile(r"[(\[]\s*([^)\]]+?)\s*[)\]]\s*$")
_EMPTY_CELL = re.compile(rb"[,;][ \t]*(?=[,;])|(?m:^)[ \t]*[,;]")
_DECIMALS = re.compile(r"[.]?(\d*)(?:[eE][+-]?\d+)?\s*$")
_HEAD, _TAIL = 12, 4000  # lines and bytes that are looked at, of the beginning and of the end
_BLANK, _LINE_END = 32, 10
_COMMENTED_FORMAT = re.compile(rb"\s*#(Earthquake Information|StationCode\s*:)")
"""CWB's headers, which look like comments above columns."""


def _table(content: bytes) -> tuple[tuple[str, ...], int, int] | None:
    """Return names and number of columns, and of the lines above: comments, at most one row of names; or None."""
    names: tuple[str, ...] = ()
    commented = ""
    widths: list[int] = []
    start = 0
    for line in (line for line in text.lines(content, _HEAD) if len(line) < 2000):
        bare = line.strip().rstrip(",;").rstrip()
        if not bare or (bare.startswith(("#", "%")) and not widths):
            start += not widths
            commented = bare.lstrip("#% ") or commented
        elif all(map(text.is_number, _SEPARATOR.split(bare))):
            widths.append(len(_SEPARATOR.split(bare)))
        elif names or widths:
            return None
        else:
            names = _labels(line)
            start += 1
    uneven = len(set(widths[:-1])) > 1 or widths[-1:] > widths[:1]
    if len(widths) < 2 or uneven or (names and len(names) != widths[0]):
        return None
    of_comment = _labels(commented)
    if (
        not names
        and len(of_comment) == widths[0]
        and (_TIME.fullmatch(of_comment[0]) or any(map(_unit, of_comment)))
    ):
        names = of_comment
    return names, widths[0], start


def _labels(line: str) -> tuple[str, ...]:
    """The names in a line, parted by commas, semicolons or tabs, else by blanks; a unit in brackets stays with its."""
    if re.search(r"[,;\t]", line):
        parts = re.split(r"[,;\t]", line)
    elif len(_BRACKET_END.findall(line)) > 1 and line.rstrip().endswith((")", "]")):  # names of several words
        parts = _WITH_UNIT.findall(line)
    else:
        parts = re.split(r"\s+(?![(\[])", line.strip())
    return tuple(part.strip().strip("\"'") for part in parts)


_BRACKET_END = re.compile(r"[)\]]")
_WITH_UNIT = re.compile(r"[^)\]]+[)\]]")
_ABSCISSA = re.compile(r"(?i)\s*(period|freq(uency)?)\b.*")
_ORDINATE = re.compile(r"(?i)\s*(p?s[av]|sd|fas|fourier|spectr\w*)\b.*")


def _refuse_spectrum(names: tuple[str, ...]) -> None:
    """Refuse a table over period or frequency: its numbers are ordinates of a spectrum, and no motion."""
    if names and (_ABSCISSA.fullmatch(names[0]) or any(map(_ORDINATE.fullmatch, names[1:]))):
        heads = ", ".join(names[:4])
        raise RecordError(f"this is a spectrum ({heads}); use the record of acceleration against time.")


_FEWEST_ROWS = 8
"""Rows from which on it can be told whether numbers run along rows or along columns."""
_OF_CHANNELS = (3, 4, 6, 9)
"""Numbers of columns that a table of channels without names may well have."""


def _runs_along_rows(values: np.ndarray, width: int, parted: bool) -> bool:
    """Whether numbers in `width` columns without names are one series, wrapped, and not channels side by side.

    Along a series the next number is nearer than the one a row further on; of channels it is that of another channel.
    parted: whether commas or semicolons part them, as no series that is wrapped has.
    """
    rows = values.size // width
    if parted or rows < _FEWEST_ROWS:
        return not parted
    whole = values[: rows * width]
    along = float(np.abs(np.diff(whole)).mean())
    across = float(np.abs(whole[width:] - whole[:-width]).mean())
    most = 1.0 if width in _OF_CHANNELS else 1.5
    return along <= most * across


def _are_columns(content: bytes) -> bool:
    is_other = (
        bool(_COMMENTED_FORMAT.match(content)) or b"\0" in content[:4096] or _heading(content) is not None
    )
    return not is_other and _table(_points_for_commas(content) or content) is not None


def _read_columns(content: bytes, options: Options) -> list[Accelerogram]:
    pointed = _points_for_commas(content)
    if pointed is None:
        raise RecordError("the commas are decimal signs or part columns; write points, or semicolons.")
    names, width, start = _table(pointed) or ((), 1, 0)  # it was recognised by that
    _refuse_spectrum(names)
    refuse_other_quantity(options.file, "\n".join(text.lines(pointed, _HEAD)[:start]))
    body = text.after_lines(pointed, start)
    if _EMPTY_CELL.search(body):
        raise RecordError("a cell is empty; every column needs a number on every line.")
    spaced = body.replace(b",", b" ").replace(b";", b" ")
    values = text.numbers(spaced)
    wrapped = False
    if width > 2 and not names and not _time_first(values, width):
        parted = b"," in body[:_TAIL] or b";" in body[:_TAIL]
        wrapped = _runs_along_rows(values, width, parted)
    octets = np.frombuffer(b"\n" + spaced + b"\n", dtype=np.uint8)
    begun = np.cumsum((octets[1:] > _BLANK) & (octets[:-1] <= _BLANK))  # numbers, up to each octet
    counts = np.diff(begun[octets[1:] == _LINE_END], prepend=0)
    counts = counts[counts > 0]
    if wrapped and counts[-1] < width:  # the last row of a series may be short
        counts = counts[:-1]
    if (counts != width).any():
        at = int(np.argmax(counts != width))
        raise RecordError(f"row {at + 1} of the samples has {counts[at]} columns, but the first has {width}.")
    if width == 1 or wrapped:
        label = names[0] if names else ""
        values, step, notes = _without_count(values)
        facts: dict[str, Any] = {
            "component": "" if _unit(label) else label,
            "warnings": (*notes, *_repeats(values)),
        }
        records = [options.accelerogram(_unit(label), values, step, processed=None, **facts)]
    else:
        records = _timed_columns(values.reshape(-1, width), names, options)
    return [record.warned(*_cut_number(body)) for record in records]


def _without_count(values: np.ndarray) -> tuple[np.ndarray, float | None, tuple[str, ...]]:
    """Return the samples without a number of samples, and a time step [s], that stand above them as first numbers."""
    for above in (1, 2):
        if values.size > above + 2 and values[0] == values.size - above:
            step = float(values[1]) if above == 2 else None
            if step is None or 0 < step <= _LONGEST_STEP:
                words = "number of samples" if above == 1 else "number of samples and the time step"
                return values[above:], step, (f"The first of the numbers is the {words}, and no sample.",)
    return values, None, ()


def _cut_number(body: bytes) -> tuple[str, ...]:
    """Return a warning when the last number has fewer decimals than all above it, and no line end: the file is cut."""
    tail = [] if body.endswith(b"\n") else text.lines(body[-_TAIL:])[1:]
    decimals = [len(match[1]) for line in tail if line.strip() and (match := _DECIMALS.search(line))]
    if len(decimals) < 3 or decimals[-1] >= min(decimals[:-1]):
        return ()
    return ("The last number has fewer decimals than those above it and no line end: the file may be cut.",)


def _time_first(values: np.ndarray, width: int) -> bool:
    """Whether the first of `width` columns without names counts time: evenly upwards from zero or above."""
    first = values[: values.size - values.size % width][: 50 * width : width]
    steps = np.diff(first)
    return first.size > 2 and first[0] >= 0 and steps.min() > 0 and float(np.ptp(steps)) < 0.01 * steps[0]


def _repeats(values: np.ndarray) -> tuple[str, ...]:
    """Return a warning when numbers without count or times come twice."""
    half, odd = divmod(values.size, 2)
    is_twice = not odd and half > 1 and np.any(values) and np.array_equal(values[:half], values[half:])
    sentence = f"The second half of the samples repeats the first, {half} numbers: the file may be appended to itself."
    return (sentence,) if is_twice else ()


def _timed_columns(rows: np.ndarray, names: tuple[str, ...], options: Options) -> list[Accelerogram]:
    """Return the channels of a table: each column that is neither a time nor a count, with the times left of it."""
    timed_unnamed = rows.shape[1] == 2 or _time_first(rows.ravel(), rows.shape[1])
    labels = names or ("time" if timed_unnamed else "", *[""] * (rows.shape[1] - 1))
    kinds = [_kind(label, column) for label, column in zip(labels, rows.T, strict=True)]
    if "channel" not in kinds:  # a motion that rises evenly
        kinds[1:] = ["channel"] * (len(kinds) - 1)
    repeats = () if "time" in kinds else _repeats(rows.ravel())
    times: np.ndarray | None = None
    records = []
    for label, kind, column in zip(labels, kinds, rows.T, strict=True):
        if kind == "time":
            times = column * _seconds(label)
        elif kind == "channel" and other_quantity(label) is None:
            records.append(_column(label, times, column, options, repeats))
    return records


_COUNT = re.compile(
    r"(?i)(no|nr|n|i|id|#|index|count|counter|sample|samples|point|points|step|row|line)\b\.?.*"
)


def _kind(label: str, column: np.ndarray) -> str:
    """Return "time", "count" or "channel" of a column: by its name, else by numbers that rise evenly all the way."""
    if _TIME.fullmatch(label):
        return "time"
    steps = np.diff(column)
    if (
        _unit(label)
        or column.size < _FEWEST_ROWS
        or steps.min() <= 0
        or float(np.ptp(steps)) > 0.01 * float(steps[0])
    ):
        return "channel"
    return "count" if steps[0] == 1 or _COUNT.fullmatch(label) else "time"


def _column(
    label: str, times: np.ndarray | None, values: np.ndarray, options: Options, repeats: tuple[str, ...]
) -> Accelerogram:
    """The accelerogram of one column of a table; times: s, None where no column is of times."""
    step = options.time_step
    processing: tuple[str, ...] = ()
    if times is not None:
        step = text.even_step(times)
        if step is None:
            step, even, sentence = text.resampled(times)
            values = np.interp(even, times, values)
            processing = repeats = (sentence,)
    name = re.sub(r"^(acc|acceleration|a)[_\s-]+", "", _UNIT.sub("", label).strip(), flags=re.I)
    facts: dict[str, Any] = {"component": name, "processing": processing, "warnings": repeats}
    return options.accelerogram(_unit(label), values, step, processed=None, **facts)


_TIMES = {
    "s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "millisecond": 1e-3,
    "milliseconds": 1e-3, "us": 1e-6, "µs": 1e-6, "microseconds": 1e-6, "min": 60.0, "minute": 60.0, "minutes": 60.0,
    "h": 3600.0, "hour": 3600.0, "hours": 3600.0,
}  # fmt: skip
_TIME_UNIT = re.compile(r"[(\[]\s*([^)\]]*?)\s*[)\]]\s*$|[\s,_]([A-Za-z]+)\s*$")
"""The unit of times, in brackets or as the last word."""


def _seconds(label: str) -> float:
    """Return the unit of a column of times, s. Raises RecordError where it is in brackets and unknown."""
    match = _TIME_UNIT.search(label)
    if match is None:
        return 1.0
    if match[1] and match[1].lower() not in _TIMES:
        raise RecordError(f"the times are in {match[1][:20]!r}, but must be in s, ms or min; convert them.")
    return _TIMES.get((match[1] or match[2] or "s").lower(), 1.0)


def _unit(label: str) -> str | None:
    match = _UNIT.search(label)
    return acceleration_unit(match[1]) if match else None


_WITH_COMMA = re.compile(r"[+-]?\d*,\d+([eE][+-]?\d+)?")
_NUMERIC = re.compile(r"[\d+\-.,;eE \t]+")
_SAMPLE = 40
"""Lines that are looked at: the rest of a table is like them, or its numbers are refused one by one."""


def _points_for_commas(content: bytes) -> bytes | None:
    """Return `content` with points for its decimal commas, if it has such; None where a comma may be either.

    A comma is a decimal sign where something else (a semicolon, a tab, blanks) parts the numbers and none has a point.
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
    has_names = re.search(r"[A-Za-z]", next(line for line in head if line.strip()))
    first = [row.split(",")[0] for row in rows]
    steps = {int(b) - int(a) for a, b in pairwise(first)} if all(map(str.isdecimal, first)) else set()
    counts = len(rows) > 2 and len(steps) == 1 and steps.pop() > 0  # evenly upwards, as times do
    return content if has_names or counts else None


_WORDS = re.compile(r"[A-Za-z=:,;()]+")
_UNIT_IN_WORDS = re.compile(r"(?:\b(?:in|units?(?: of| are|:)?)\s+|[(\[]\s*)([A-Za-z][\w/^*²]*)", re.I)
"""The unit follows the word "in" or "units", or stands in brackets."""
_LONGEST_STEP = 1.0  # s; of a record, so that a line of two numbers is known for samples and step


def _title(content: bytes) -> tuple[str, str] | None:
    """Return (samples, step) of a title and a line of these two and words above numbers, None of another file."""
    head = [line for line in text.lines(content, _HEAD) if len(line) < 2000]
    if len(head) < 4 or all(map(text.is_number, head[0].split())):
        return None
    rows = [row.split() for row in head[2:-1] if row.strip()]
    if {len(row) for row in rows} == {2} and len(head[0].split()) == 2:
        return None  # two columns below their names
    parts = _WORDS.sub(" ", head[1]).split()
    if not rows or len(parts) != 2 or not all(map(text.is_number, sum(rows, parts))):
        return None
    for samples, step in (parts, parts[::-1]):
        if samples.isdecimal() and int(samples) > 1 and "." in step and 0 < float(step) <= _LONGEST_STEP:
            return samples, step
    return None


def _heading(content: bytes) -> tuple[str, str] | None:
    """Return (samples, step) of a first line of these two, with or without words, above as many numbers, or None."""
    if b"\0" in content[:4096]:
        return None
    head = [line for line in text.lines(content, _HEAD) if len(line) < 2000]
    if len(head) < 4 or "NPTS" in head[0].upper():  # which is PEER's
        return None
    parts = _WORDS.sub(" ", head[0]).split()
    rows = [row.split() for row in head[1:-1] if row.strip()]
    if not rows or len(parts) != 2 or not all(map(text.is_number, sum(rows, parts))):
        return None
    found = len(text.after_lines(content, 1).split())
    for samples, step in (parts, parts[::-1]):
        is_count = samples.isdecimal() and int(samples) > 1
        if (
            is_count
            and "." in step
            and 0 < float(step) <= _LONGEST_STEP
            and int(samples) in (found, found - 1)
        ):
            return samples, step
    return None


def _read_titled(content: bytes, options: Options) -> list[Accelerogram]:
    if heading := _heading(content):
        return _below_title(b"\n" + content, options, *heading)
    samples, step = _title(content) or ("", "")
    return _below_title(content, options, samples, step, event=text.lines(content, 1)[0].strip()[:60])


def _below_title(content: bytes, options: Options, size: str, step: str, **names: str) -> list[Accelerogram]:
    title, second, *rows = text.lines(content, _HEAD)
    refuse_other_quantity(options.file, f"{title}\n{second}")
    words = (match[1] for match in _UNIT_IN_WORDS.finditer(f"{title}\n{second}"))
    unit = next(filter(None, map(acceleration_unit, words)), None)
    per_line = max(len(row.split()) for row in rows)
    samples = text.count("number of samples", size)
    values, notes = text.whole(text.numbers(text.after_lines(content, 2)), samples, per_line)
    seconds = text.number("time step", step)
    return [options.accelerogram(unit, values, seconds, warnings=notes, processed=None, **names)]


_EMOD3D = re.compile(
    r"[ \t]*\S+[ \t]+\S.*\n[ \t]*(\d+)[ \t]+(\d\.\d+e[-+]\d\d)([ \t]+-?\d+){2}([ \t]+-?\d\.\d+e[-+]\d\d){4}[ \t]*\n",
    re.I)  # fmt: skip
"""Station and component above number of samples, step, hours and minutes, and four reals."""


def _read_emod3d(content: bytes, options: Options) -> list[Accelerogram]:
    title, second = text.lines(content, 2)
    station, component = title.split()[:2]
    return _below_title(content, options, *second.split()[:2], station=station, component=component)


COLUMNS = Format(
    "columns of numbers",
    "spreadsheets, OpenSees and scripts",
    "lines that hold numbers only, below at most one row of names",
    _are_columns,
    _read_columns,
)
TITLED = Format(
    "titled column",
    "programs of analysis, files like KOBE.000",
    "line with number of samples and step, below a title or first, then numbers",
    lambda content: _heading(content) is not None or _title(content) is not None,
    _read_titled,
)
EMOD3D = Format(
    "EMOD3D text",
    "EMOD3D and ucgmsim, simulated and observed motion",
    "station and component above samples, step and six more numbers",
    _EMOD3D,
    _read_emod3d,
)
