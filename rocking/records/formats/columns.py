"""Bare numbers: columns, or one series wrapped over lines (OpenSees), below names, remarks or nothing at all."""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.direction import directed, names_acceleration
from rocking.records.formats import text
from rocking.records.formats.dialect import Dialect
from rocking.records.formats.format import Format, Options
from rocking.records.formats.labels import ColumnLabel
from rocking.records.formats.remarks import Declarations, factor_warnings, speaks_of_factor
from rocking.records.formats.titled import LONGEST_STEP, heading_of
from rocking.records.instrument import refuse_by_name, refuse_other_quantity
from rocking.remarks import Kind, Remark

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_EMPTY_LAST = re.compile(rb"[,;][ \t]*(?:\n|\Z)")
_EMPTY_END = re.compile(rb"(?m)(?:[ \t]*[,;])+[ \t]*$")
"""Empty cells at the end of rows, and whole rows of them below a table, as spreadsheets write them."""
_EMPTY_CELL = re.compile(rb"[,;][ \t]*(?=[,;])|(?m:^)[ \t]*[,;]")
_DECIMALS = re.compile(r"[.]?(\d*)(?:[eE][+-]?\d+)?\s*$")
_HEAD = 12
"""Lines of numbers that are looked at, at the beginning."""
_REMARKS = 80
"""Lines of remarks that are looked at there."""
_TAIL = 4000
"""Bytes that are looked at, at the end."""
_BLANK = 32
_LINE_END = 10
_COMMENTED_FORMAT = re.compile(rb"\s*#(Earthquake Information|StationCode\s*:)")
"""CWB's headers, which look like comments above columns."""
_MARKS = "#", "%", "$", "!", "//"
"""With which a line of remarks begins."""
_EXCEL = re.compile(r"sep=.?", re.I)
"""The first line by which a spreadsheet is told what parts the cells."""


@dataclass(frozen=True)
class _Table:
    """Columns below remarks and at most one row of names.

    labels: of the columns, none where no line names them. width: number of columns. start: lines above the numbers.
    remarks: what those lines say, one after another, without their mark.
    """

    labels: tuple[ColumnLabel, ...]
    width: int
    start: int
    remarks: tuple[str, ...] = ()


def _table(content: bytes) -> _Table | None:
    """Return what stands above and beside the numbers of a table; None of another file."""
    above: list[str] = []
    remarks: list[str] = []
    widths: list[int] = []
    start = 0
    for line in (line for line in text.lines(content, _REMARKS) if len(line) < 2000):
        bare = line.strip().rstrip(",;").rstrip()
        is_remark = bare.startswith(_MARKS) or (not (above or widths) and bool(_EXCEL.fullmatch(bare)))
        if bare and all(map(text.is_number, _SEPARATOR.split(bare))):
            widths.append(len(_SEPARATOR.split(bare)))
            if len(widths) == _HEAD:
                break
            continue
        if bare and widths:
            return None
        start += not widths
        if is_remark:
            remarks.append(bare.lstrip("#%$!/ "))
        elif bare:
            above.append(line)
    if len(widths) < 2 or len(set(widths[:-1])) > 1 or widths[-1] > widths[0]:
        return None
    width = widths[0]
    if above:
        return _below_text(above, remarks, width, start)
    if labels := _of_remark(remarks, width):
        del remarks[-1]
    return _Table(labels, width, start, tuple(remarks))


def _below_text(above: list[str], remarks: Sequence[str], width: int, start: int) -> _Table | None:
    """Return a table below lines of text, whose last is that of its names, or the units below them; None of another.

    More text than these is passed over only where nothing is left open: each column is of times, has a unit, or names a
    direction or acceleration below text that declares the unit; and the times, or that text, give the step.
    """
    names = _labels(above[-1])
    rest = above[:-1]
    if len(names) != width and len(above[-1].split()) == width:
        names = tuple(above[-1].split())
    if len(above) > 1 and len(names) == width and _are_units(names):
        names = _with_units(_labels(above[-2]), names)
        rest = above[:-2]
    elif len(names) == width > 1 and _are_units(names):
        names = _with_units(("",) * width, names)
    if len(names) != width:
        return _below_prose(above, remarks, width, start)
    labels = tuple(map(ColumnLabel, _without_suffixes(names)))
    if rest and (
        any(map(speaks_of_factor, rest)) or not _is_all_said(labels, Declarations.of((*remarks, *rest)))
    ):
        return None
    return _Table(labels, width, start, (*remarks, *rest))


_TIME_SUFFIX = re.compile(r"(?i)(t|time|tiempo|zeit)(_s(ec)?)?")
_G_SUFFIX = re.compile(r"(?i)(.*(?<![a-z])acc(el(eration)?)?(_\w+)?)_g")


def _without_suffixes(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return names like "acc_g" with the unit in brackets where times stand beside them: elsewhere "_g" may be of the
    ground."""
    if not _TIME_SUFFIX.fullmatch(names[0]):
        return names
    return tuple(_G_SUFFIX.sub(r"\1 (g)", name) if _G_SUFFIX.fullmatch(name) else name for name in names)


def _below_prose(above: list[str], remarks: Sequence[str], width: int, start: int) -> _Table | None:
    """Return one series below text that leaves no more open than its unit and its step; None of another file.

    That is text that declares both, or a title, and lines each of which declares something.
    """
    said = Declarations.of((*remarks, *above))
    may_be_channels = width == 2 or width in _OF_CHANNELS
    if may_be_channels or any(map(speaks_of_factor, above)):
        return None
    title, *others = above
    is_title = not re.search(r"[:=]", title) or Declarations.of([title]) != Declarations()
    is_all_read = is_title and all(Declarations.of([line]) != Declarations() for line in others)
    if not is_all_read and not (said.unit and said.time_step):
        return None
    return _Table((), width, start, (*remarks, *above))


def _is_all_said(labels: Sequence[ColumnLabel], above: Declarations) -> bool:
    """Whether labels, and what the text above them declares, leave nothing open of the columns."""
    open_ones = [label for label in labels if not (label.is_time or label.unit or label.other)]
    is_motion = all(label.is_direction or label.is_plain_acceleration for label in open_ones)
    if open_ones and not (above.unit and is_motion):
        return False
    return above.time_step is not None or any(label.is_time for label in labels)


def _labels(line: str) -> tuple[str, ...]:
    """The names in a line, parted by tabs, semicolons or commas, else by blanks; a unit in brackets stays with its."""
    if '"' in line:
        return tuple(re.findall(r'"([^"]*)"', line))
    line = re.sub(r"[,;\s]+$", "", line)
    separator = next((mark for mark in "\t;," if mark in line), "")
    if separator:
        parts = line.split(separator)
    elif len(_BRACKET_END.findall(line)) > 1 and line.rstrip().endswith((")", "]")):  # names of several words
        parts = _WITH_UNIT.findall(line)
    else:
        parts = re.split(r"\s+(?![(\[])", line.strip())
    return tuple(part.strip().strip("\"'") for part in parts)


def _are_units(units: tuple[str, ...]) -> bool:
    """Whether a row of words holds units, of which one at least is of acceleration."""
    bare = [unit.strip("()[] ") for unit in units]
    given = [ColumnLabel(f"({unit})") for unit in bare]
    are_all = all(
        each.unit or each.is_time or each.other or not unit for each, unit in zip(given, bare, strict=True)
    )
    return are_all and any(each.unit for each in given)


def _with_units(names: tuple[str, ...], units: tuple[str, ...]) -> tuple[str, ...]:
    """Return names, each with the unit below it in brackets; none where they are not as many."""
    if len(names) != len(units):
        return ()
    pairs = zip(names, (unit.strip("()[] ") for unit in units), strict=True)
    return tuple(f"{name} ({unit})" if unit else name for name, unit in pairs)


def _of_remark(remarks: Sequence[str], width: int) -> tuple[ColumnLabel, ...]:
    """Return the labels in the last of the remarks, if it holds one for each column, of times, units or directions."""
    labels = tuple(map(ColumnLabel, _labels(remarks[-1]))) if remarks else ()
    are_directions = len(labels) > 1 and all(label.is_direction for label in labels)
    if len(labels) == 1 and not (labels[0].is_plain_acceleration or labels[0].is_direction):
        return ()  # a remark like "Geoscope (G)" names a network
    are_names = bool(labels) and (labels[0].is_time or any(label.unit for label in labels) or are_directions)
    return labels if are_names and len(labels) == width else ()


_BRACKET_END = re.compile(r"[)\]]")
_WITH_UNIT = re.compile(r"[^)\]]+[)\]]")
_ABSCISSA = re.compile(r"(?i)\s*(period|freq(uency)?)\b.*|f(_hz)?|.*[(\[]\s*hz\s*[)\]]")
_ORDINATE = re.compile(r"(?i)\s*(p?s[av]|sd|fas|fourier|spectr\w*)\b.*")


def _refuse_spectrum(labels: tuple[ColumnLabel, ...]) -> None:
    """Refuse a table over period or frequency: its numbers are ordinates of a spectrum, and no motion."""
    names = [label.text for label in labels]
    if names and (_ABSCISSA.fullmatch(names[0]) or any(map(_ORDINATE.fullmatch, names[1:]))):
        heads = ", ".join(names[:4])
        raise RecordError(f"this is a spectrum ({heads}); use the record of acceleration against time.")


_OTHER_TITLE = re.compile(
    r"(?i)(?<![a-z])((?:shear |axial )?strains?|(?:shear |normal )?stress(?:es)?|forces?|moments?|fourier|"
    r"(?:response |spectral |power )spectr\w*|psa|fas)(?![a-z])"
)
_SPEAKS_OF_MOTION = re.compile(r"(?i)(?<![a-z])(acc|acel|beschl|match)")


def _refuse_other_title(remarks: Sequence[str]) -> None:
    """Refuse a table below a text that speaks of another quantity, and of no acceleration."""
    above = "\n".join(remarks)
    if (word := _OTHER_TITLE.search(above)) and not _SPEAKS_OF_MOTION.search(above):
        raise RecordError(f"this is a file of {word[1].lower()}; use the acceleration of the same record.")


def _refuse_matrix(rows: np.ndarray) -> None:
    """Refuse columns without names that no motion makes: none has a number below zero, or they rise unevenly from one.

    rows: (n, columns) of a table, or one series as its rows hold it.
    """
    if rows.shape[1] < 2 or len(rows) < _FEWEST_ROWS or rows[:, 1:].min() < 0:
        return
    steps = np.diff(rows[:, 0])
    is_uneven_abscissa = steps.min() > 0 and steps.max() > 2 * steps.min()
    is_matrix = rows.shape[1] > 2 and rows.min() >= 0 and rows.size >= _FEWEST_OF_BOTH_SIGNS
    if is_uneven_abscissa or is_matrix:
        raise RecordError(
            "no number of its columns is below zero: these are spectra or peaks; use the record of acceleration "
            "against time, or name the columns if they are that."
        )


_FEWEST_ROWS = 8
"""Rows from which on it can be told whether numbers run along rows or along columns."""
_OF_CHANNELS = (3, 4, 6, 9)
"""Numbers of columns that a table of channels without names may well have."""


def _runs_along_rows(values: np.ndarray, width: int, parted: bool) -> bool:
    """Whether numbers in `width` columns without names are one series, wrapped, and not channels side by side.

    Along a series the next number is nearer than the one a row further on; of channels it is that of another channel.
    parted: whether commas or semicolons part them, which decides where the rows are too few to tell.
    """
    rows = values.size // width
    if rows < _FEWEST_ROWS:
        return not parted
    whole = values[: rows * width]
    along = float(np.abs(np.diff(whole)).mean())
    across = float(np.abs(whole[width:] - whole[:-width]).mean())
    most = 1.0 if width in _OF_CHANNELS else 1.5
    return along <= most * across


def _are_columns(content: bytes) -> bool:
    is_other = (
        bool(_COMMENTED_FORMAT.match(content)) or b"\0" in content[:4096] or heading_of(content) is not None
    )
    return not is_other and _table(_pointed(content) or content) is not None


def _pointed(content: bytes) -> bytes | None:
    """Return a table as Python writes its numbers, times of day as seconds; None where a comma may be two things."""
    plain = Dialect.of(content).plain(content)
    return None if plain is None else _in_seconds(plain)


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


def _read_columns(content: bytes, options: Options) -> list[Accelerogram]:
    pointed = _pointed(content)
    if pointed is None:
        raise RecordError("the commas are decimal signs or part columns; write points, or semicolons.")
    table = _table(pointed) or _Table((), 1, 0)  # it was recognised by that
    _refuse_spectrum(table.labels)
    refuse_other_quantity(options.file, "\n".join(table.remarks))
    _refuse_other_title(table.remarks)
    if not any(label.unit for label in table.labels):
        refuse_by_name(options.file)
    below = text.after_lines(pointed, table.start)
    unended = below[:-_TAIL] + _END.sub(b"\n", below[-_TAIL:])
    body, filled = _without_filling(unended, table)
    if _EMPTY_LAST.search(body):
        body = _EMPTY_END.sub(b"", body)
    if _EMPTY_CELL.search(body):
        raise RecordError("a cell is empty; every column needs a number on every line.")
    spaced = body.replace(b",", b" ").replace(b";", b" ")
    values = text.numbers(spaced)
    said = Declarations.of(table.remarks)
    width = 2 if _are_wrapped_pairs(values, table) else table.width
    wrapped = _is_wrapped(values, table, body)
    _check_rows(spaced, table.width, wrapped or width != table.width)
    if not table.labels:
        _refuse_matrix(values[: values.size - values.size % width].reshape(-1, width))
    if wrapped:
        _check_first_row(spaced)
    if width == 1 or wrapped:
        records = [_series(values, table, options, said)]
    else:
        rows = values.reshape(-1, width)
        records = _timed_columns(_below_count(rows, table.labels), table.labels, options, said)
    if len(records) == 1:
        records = [_pointing(records[0], said.component)]
    filled += factor_warnings(table.remarks)
    return [record.warned(*filled, *_cut_number(body), *_never_negative(record)) for record in records]


_END = re.compile(
    rb"(?i)(?:\n[ \t]*(?:(?:[#%$!]|//)[^\n]*|[a-z]\w*[ \t]*\$|end(?:[ \t]+of[ \t]+\w+)?|eof|[}\])]+;?)[ \t]*)+\s*\Z"
)
"""Remarks, or a word for the end, below the numbers."""
_FILLING = re.compile(rb"(?i)(?:[ \t]+nan)+\s*\Z")


def _without_filling(body: bytes, table: _Table) -> tuple[bytes, tuple[Remark, ...]]:
    """Return the numbers of a series on several columns without the NaN that fill its last row up, and what says so."""
    bare = body[:-_TAIL] + _FILLING.sub(b"\n", body[-_TAIL:])
    if table.labels or table.width < 3 or bare == body:
        return body, ()
    return bare, (Remark(Kind.ROW_FILLED_UP),)


def _series(values: np.ndarray, table: _Table, options: Options, said: Declarations) -> Accelerogram:
    """Return the accelerogram of a table that is one series, `said` what the text above it declares."""
    label = table.labels[0] if table.labels else ColumnLabel("")
    if label.other:
        _refuse_others([label], {0: label.other})
    values, above, notes = _without_count(values, options.time_step)
    if said.samples:
        values, more = text.whole(values, text.count("number of samples", said.samples), table.width)
        notes += more
    unit = label.unit or said.unit
    component = "" if label.unit else label.text
    return options.accelerogram(
        unit,
        values,
        above or said.time_step,
        processed=None,
        component=component,
        warnings=(*notes, *_repeats(values)),
    )


def _is_wrapped(values: np.ndarray, table: _Table, body: bytes) -> bool:
    """Whether the numbers are one series that runs along the rows."""
    if table.width <= 2 or table.labels or _time_first(values, table.width):
        return False
    parted = b"," in body[:_TAIL] or b";" in body[:_TAIL]
    return _runs_along_rows(values, table.width, parted)


def _are_wrapped_pairs(values: np.ndarray, table: _Table) -> bool:
    """Whether several pairs of time and acceleration stand on a row: each time follows from that of the pair before."""
    if table.width < 4 or table.width % 2 or table.labels or values.size < 2 * _FEWEST_ROWS:
        return False
    times = values[: values.size - values.size % 2 : 2]
    steps = np.diff(times)
    return bool(steps.min() > 0) and float(np.ptp(steps)) < 0.5 * float(np.median(steps))


def _check_rows(spaced: bytes, width: int, may_end_short: bool) -> None:
    """Raise RecordError unless every row of numbers has `width` of them; the last row of a series may be short."""
    octets = np.frombuffer(b"\n" + spaced + b"\n", dtype=np.uint8)
    begun = np.cumsum((octets[1:] > _BLANK) & (octets[:-1] <= _BLANK))  # numbers, up to each octet
    counts = np.diff(begun[octets[1:] == _LINE_END], prepend=0)
    counts = counts[counts > 0]
    if may_end_short and counts[-1] < width:
        counts = counts[:-1]
    if (counts != width).any():
        at = int(np.argmax(counts != width))
        raise RecordError(f"row {at + 1} of the samples has {counts[at]} columns, but the first has {width}.")


def _check_first_row(spaced: bytes) -> None:
    """Raise RecordError where a series of decimals begins with a row of whole numbers: these are a header's."""
    first, _, rest = spaced.lstrip().partition(b"\n")
    if b"." in first or b"." not in rest or not re.search(rb"\d\d", first):
        return
    raise RecordError(
        f"the first row of numbers, {first.decode('latin-1').strip()[:40]!r}, is of whole numbers and seems to be a "
        "header; write # before it, or cut it off."
    )


def _below_count(rows: np.ndarray, labels: tuple[ColumnLabel, ...]) -> np.ndarray:
    """Return the rows without a first one of number of rows and time step, as programs of analysis write it."""
    if labels or rows.shape[1] != 2 or len(rows) < _FEWEST_ROWS:
        return rows
    is_count = rows[0, 0] == len(rows) - 1
    is_step = abs(rows[0, 1] - (rows[2, 0] - rows[1, 0])) <= 1e-3 * abs(rows[0, 1])
    return rows[1:] if is_count and is_step else rows


_FEWEST_OF_BOTH_SIGNS = 100
"""Samples from which on a motion has some of either sign."""


def _never_negative(record: Accelerogram) -> tuple[Remark, ...]:
    """Return a warning where no number is below zero: the ground moves both ways."""
    if record.acceleration.size < _FEWEST_OF_BOTH_SIGNS or record.acceleration.min() < 0:
        return ()
    if record.peak_acceleration == 0:
        return ()
    return (Remark(Kind.NEVER_NEGATIVE, record.component or "the column"),)


def _without_count(
    values: np.ndarray, declared: float | None
) -> tuple[np.ndarray, float | None, tuple[Remark, ...]]:
    """Return the samples without what stands above them as first numbers, and the time step [s] among that.

    That is their number, their number and the time step or the rate, the number of series (1) and the time step, or
    the time step that the caller declares.
    """
    for above in (1, 2):
        if values.size > above + 2 and values[0] == values.size - above:
            second = float(values[1])
            if above == 1:
                return values[1:], None, (Remark(Kind.FIRST_IS_COUNT),)
            if 0 < second <= LONGEST_STEP:
                return values[2:], second, (Remark(Kind.FIRST_ARE_COUNT_AND_STEP),)
            if _RATES[0] <= second <= _RATES[1] and second == round(second):
                return values[2:], 1 / second, (Remark(Kind.FIRST_ARE_COUNT_AND_RATE),)
    # No motion falls so from its first sample to the next ones.
    falls = values.size > _FEWEST_ROWS and values[0] == 1 and np.abs(values[2:_FEWEST_ROWS]).max() < 0.5
    if falls and _SHORT_STEPS[0] <= values[1] <= _SHORT_STEPS[1]:
        return values[2:], float(values[1]), (Remark(Kind.FIRST_ARE_SERIES_AND_STEP),)
    if values.size > 4 and values[1] == values.size - 2 and 0 < values[0] <= LONGEST_STEP:
        return values[2:], float(values[0]), (Remark(Kind.FIRST_ARE_STEP_AND_COUNT),)
    if declared is not None and values.size > _FEWEST_ROWS and values[0] == declared:
        return values[1:], None, (Remark(Kind.FIRST_IS_STEP),)
    return values, None, ()


_SHORT_STEPS = 0.0005, 0.05
"""s; of recorders."""
_RATES = 20.0, 2000.0
"""Hz; of recorders."""


def _cut_number(body: bytes) -> tuple[Remark, ...]:
    """Return a warning when the last number has fewer decimals than all above it, and no line end: the file is cut."""
    tail = [] if body.endswith(b"\n") else text.lines(body[-_TAIL:])[1:]
    decimals = [len(match[1]) for line in tail if line.strip() and (match := _DECIMALS.search(line))]
    if len(decimals) < 3 or decimals[-1] >= min(decimals[:-1]):
        return ()
    return (Remark(Kind.NUMBER_CUT),)


def _time_first(values: np.ndarray, width: int) -> bool:
    """Whether the first of `width` columns without names counts time: evenly upwards from zero or above."""
    first = values[: values.size - values.size % width][: 50 * width : width]
    steps = np.diff(first)
    return first.size > 2 and first[0] >= 0 and steps.min() > 0 and float(np.ptp(steps)) < 0.01 * steps[0]


def _repeats(values: np.ndarray) -> tuple[Remark, ...]:
    """Return a warning when numbers without count or times come twice."""
    half, odd = divmod(values.size, 2)
    is_twice = not odd and half > 1 and np.any(values) and np.array_equal(values[:half], values[half:])
    return (Remark.of(Kind.HALF_REPEATED, samples=half),) if is_twice else ()


def _pointing(record: Accelerogram, component: str) -> Accelerogram:
    """Return the record under the name of the `component` that the text above it declares, where it has no other."""
    if not component or (record.component and not names_acceleration(record.component)):
        return record
    return replace(record, **directed({"component": component}))


def _timed_columns(
    rows: np.ndarray, labels: tuple[ColumnLabel, ...], options: Options, said: Declarations
) -> list[Accelerogram]:
    """Return the channels of a table: each column of acceleration, with the times left of it, else the first there are.

    said: by the remarks above the table.
    """
    if len(labels) > 1 and all(label.text.isdigit() and len(label.text) == 1 for label in labels[1:]):
        labels = (labels[0], *[ColumnLabel("")] * (len(labels) - 1))  # numbers of columns, and no azimuths
    if not labels:
        timed = rows.shape[1] == 2 or _time_first(rows.ravel(), rows.shape[1])
        labels = (ColumnLabel("time" if timed else ""), *[ColumnLabel("")] * (rows.shape[1] - 1))
    kinds = [_kind(label, column) for label, column in zip(labels, rows.T, strict=True)]
    if "channel" not in kinds:  # a motion that rises evenly
        kinds[1:] = ["channel"] * (len(kinds) - 1)
    repeats = () if "time" in kinds else _repeats(rows.ravel())
    every = {
        place: rows[:, place] * labels[place].seconds for place, kind in enumerate(kinds) if kind == "time"
    }
    others = _others(rows, labels, kinds)
    records = []
    for place, (label, kind, column) in enumerate(zip(labels, kinds, rows.T, strict=True)):
        if kind != "channel" or place in others:
            continue
        left = max((at for at in every if at < place), default=min(every, default=-1))
        records.append(_column(label, every.get(left), column, options, repeats, said))
    if not records:
        _refuse_others(labels, others)
    integrals = [place + 1 for place, what in others.items() if what == _INTEGRAL]
    left_out = [Remark.of(Kind.INTEGRAL_LEFT_OUT, column=place) for place in integrals]
    return [record.warned(*left_out) for record in records]


_INTEGRAL = "the integral of another column"
_ALIKE = 0.95
"""Correlation of the differences of one column with another column from which on it is its integral."""


_ACCELEROMETER = re.compile(r"(?i)a(cc(el)?)?[_ ]?[xyz]\b.*")
_GYROSCOPE = re.compile(r"(?i)(g(yro?)?|w|m(ag)?)[_ ]?[xyz]|roll|pitch|yaw")
"""The other columns of a sensor of six or nine axes."""


def _others(rows: np.ndarray, labels: Sequence[ColumnLabel], kinds: Sequence[str]) -> dict[int, str]:
    """Return what each column that holds something else than acceleration is of, by its place."""
    others: dict[int, str] = {}
    places = [place for place, kind in enumerate(kinds) if kind == "channel"]
    has_acceleration = any(label.is_plain_acceleration for label in labels)
    has_axes = any(_ACCELEROMETER.fullmatch(label.text) for label in labels)
    for place in places:
        meant = labels[place].beside_acceleration() if has_acceleration else ""
        turns = has_axes and _GYROSCOPE.fullmatch(labels[place].text)
        if what := labels[place].other or meant or ("rotation or a magnetic field" if turns else ""):
            others[place] = what
        elif not labels[place].is_direction and any(
            _is_integral(rows[:, place], rows[:, earlier]) for earlier in places if earlier < place
        ):
            others[place] = _INTEGRAL
    return others


def _is_integral(column: np.ndarray, other: np.ndarray) -> bool:
    """Whether the differences of `column` go as `other` does, as those of a velocity go as the acceleration."""
    if column.size < _FEWEST_OF_BOTH_SIGNS:
        return False
    differences = np.diff(column)
    between = (other[1:] + other[:-1]) / 2
    if not differences.std() or not between.std():
        return False
    return abs(float(np.corrcoef(differences, between)[0, 1])) > _ALIKE


def _refuse_others(labels: Sequence[ColumnLabel], others: dict[int, str]) -> None:
    """Raise RecordError where every column of a table is of something else than acceleration."""
    quantities = {what for what in others.values() if what in ("velocity", "displacement")}
    if len(quantities) == 1 == len(set(others.values())):
        raise RecordError(f"this is a file of {quantities.pop()}; use the acceleration of the same record.")
    held = "; ".join(f"{labels[place].text[:40]!r} is {what}" for place, what in others.items())
    raise RecordError(
        f"no column is of acceleration in a unit that is known: {held}; convert the column, or use another file."
    )


def _kind(label: ColumnLabel, column: np.ndarray) -> str:
    """Return "time", "count" or "channel" of a column: by its name, else by numbers that rise all the way."""
    if label.is_time:
        return "time"
    steps = np.diff(column)
    if label.unit or label.other or column.size < _FEWEST_ROWS:
        return "channel"
    if steps.min() <= 0 or float(np.ptp(steps)) > 0.01 * float(steps[0]):
        return "time" if not label.text and _is_clock(column) else "channel"
    return "count" if steps[0] == 1 or label.is_count else "time"


_ONE_WAY = 0.999
"""Correlation of a column with its place from which on it is a clock: no motion rises so, all the way."""


def _is_clock(column: np.ndarray) -> bool:
    """Whether numbers rise from zero or above and never fall, as printed times do that are uneven or rounded."""
    if column.size < _FEWEST_OF_BOTH_SIGNS or column[0] < 0 or np.diff(column).min() < 0:
        return False
    along = np.corrcoef(column, np.arange(column.size))[0, 1] if column[-1] > column[0] else 0.0
    return bool(along > _ONE_WAY)


def _column(
    label: ColumnLabel,
    times: np.ndarray | None,
    values: np.ndarray,
    options: Options,
    repeats: tuple[Remark, ...],
    said: Declarations,
) -> Accelerogram:
    """The accelerogram of one column of a table.

    times: s, None where no column is of times. said: by the remarks above the table.
    """
    step = said.time_step
    processing: tuple[str, ...] = ()
    if times is not None:
        step = text.even_step(times)
        if step is None:
            step, even, remark = text.resampled(times)
            values = np.interp(even, times, values)
            processing = (str(remark),)
            repeats = (remark,)
    facts: dict[str, Any] = {"component": label.component, "processing": processing, "warnings": repeats}
    return options.accelerogram(label.unit or said.unit, values, step, processed=None, **facts)


COLUMNS = Format(
    "columns of numbers",
    "spreadsheets, OpenSees and scripts",
    "lines that hold numbers only, below names that leave nothing open",
    _are_columns,
    _read_columns,
    yields=True,
)
