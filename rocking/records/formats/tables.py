"""Tables of bare numbers: columns, or one series along the rows, below names, text or nothing at all.

What closed lists name is read. What is left open is asked once for all tables alike: see `layouts`.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from pathlib import PurePosixPath
from typing import Any

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import is_number
from rocking.records.claims import (
    END,
    AnswerContradictedError,
    Claim,
    Declarations,
    Where,
    agreed,
    claims_of_name,
    factor_warnings,
    meaning,
    of_another,
    point_apart,
    refuse_other_table,
    speaks_of_factor,
    warnings_of_claims,
)
from rocking.records.direction import Direction, directed, names_acceleration
from rocking.records.formats import dialect, text
from rocking.records.formats.format import Format, Options, plain
from rocking.records.formats.labels import ColumnLabel, with_units
from rocking.records.formats.layouts import (
    Above,
    AskedError,
    Column,
    LayoutAnswer,
    Layouts,
    Question,
    Signature,
    TableLayout,
)
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_EMPTY_LAST = re.compile(rb"[,;][ \t]*(?:\n|\Z)")
_EMPTY_END = re.compile(rb"(?m)(?:[ \t]*[,;])+[ \t]*$")
"""Empty cells at the end of rows, and whole rows of them below a table, as spreadsheets write them."""
_EMPTY_CELL = re.compile(rb"[,;][ \t]*(?=[,;])|(?m:^)[ \t]*[,;]")
_DECIMALS = re.compile(r"[.]?(\d*)(?:[eE][+-]?\d+)?\s*$")
_HEAD = 12
"""Lines of numbers that are looked at, at the beginning."""
_ABOVE = 80
"""Lines of text that are looked at above them."""
_LONGEST_LINE = 2000
_TAIL = 4000
"""Bytes that are looked at, at the end."""
_OTHER_FORMAT = re.compile(rb"\s*#(Earthquake Information|StationCode\s*:)")
"""CWB's headers, which look like comments above columns."""
_MARKS = "#", "%", "$", "!", "//"
"""With which a line of comment begins."""
_TOUCHING = re.compile(rb"(\.\d+)(?=[+-]\d)")
"""The end of a number that a sign parts from the next, as in columns of Fortran."""
_EXCEL = re.compile(r"sep=.?", re.I)
"""The first line by which a spreadsheet learns what separates the cells."""
_WORDS = re.compile(r"[A-Za-z=:,;()]+")
_FEWEST_ROWS = 8
"""Rows from which on it can be decided whether numbers run along rows or along columns."""
_FEWEST_OF_BOTH_SIGNS = 100
"""Samples from which on a motion has some of either sign."""
LONGEST_STEP = 1.0
"""The longest step of a record, s: what is longer is in ms, and of two numbers no step above samples."""


@dataclass(frozen=True)
class NumberTable:
    """Numbers in columns, and the text above them.

    labels: of the columns, none where no line names them. width: number of columns. start: lines above the numbers.
    comments: what lines with a mark say, without it; words: what the other lines above the names say. counts: the line
    that holds nothing but number of samples and step, and which of the two comes first; none where there is no such.
    tail: lines of text below the numbers.
    """

    labels: tuple[ColumnLabel, ...]
    width: int
    start: int
    comments: tuple[str, ...] = ()
    words: tuple[str, ...] = ()
    counts: tuple[int, tuple[Above, ...]] | None = None
    tail: tuple[str, ...] = ()

    @classmethod
    def of(cls, content: bytes) -> "NumberTable | None":
        """Return the table that a text is, None of another file."""
        lines = text.lines(content, _ABOVE + 2 * _HEAD)
        parted = [re.sub(_TOUCHING.pattern.decode(), r"\1 ", _bare(line)) for line in lines]
        cells = [_SEPARATOR.split(line) if line else [] for line in parted]
        numeric = [len(row) if row and all(map(is_number, row)) else 0 for row in cells]
        start = next(
            (at for at in range(len(lines)) if numeric[at] and _begins(lines[at:], numeric[at:])), None
        )
        if start is None or start > _ABOVE or any(len(line) > _LONGEST_LINE for line in lines[:start]):
            return None
        is_short = sum(map(bool, numeric[start:])) < _FEWEST_ROWS
        if any(count == numeric[start] or (count and is_short) for count in numeric[:start]):
            return None  # a row of another number of columns among its first ones
        row, below = cells[start], next(filter(None, cells[start + 1 :]))
        if len(row) == 2 and _counts(lines[start]) and float(row[0]) > float(below[0]):
            start += 1  # no times fall: as programs of analysis write number and step above them
        above = [(at, _bare(line)) for at, line in enumerate(lines[:start]) if _bare(line)]
        above = [(at, line) for at, line in above if not (at == above[0][0] and _EXCEL.fullmatch(line))]
        counts = next(((at, order) for at, line in reversed(above) if (order := _counts(line))), None)
        others = [line for at, line in above if counts is None or at != counts[0]]
        width = len(below)
        labels, rest = _named(others, width)
        return cls(
            labels,
            width,
            start,
            tuple(line.lstrip("#%$!/ ") for line in rest if line.startswith(_MARKS)),
            tuple(line for line in rest if not line.startswith(_MARKS)),
            counts,
        )

    def page(self, folder: str) -> Signature:
        """Return what its page has in common with tables for which the same answer holds; folder: in which it lies."""
        # The long numbers of a name that says nothing are those of a station or an event.
        shapes = (
            label.text if label.is_known else re.sub(r"\d{3,}", "#", label.text) for label in self.labels
        )
        above = dict.fromkeys(filter(None, map(meaning, (*self.comments, *self.words))))
        words = " / ".join([*(["n, dt"] if self.counts else []), *above])
        names = plain(" | ".join(shapes)).lstrip("=+-@ ")
        return Signature(names, str(self.width), plain(words), "" if names or words else folder)

    @cached_property
    def said(self) -> Declarations:
        """What the text above the numbers declares."""
        return Declarations.of((*self.comments, *self.words, *self.tail))

    @property
    def below(self) -> str:
        """The text below the numbers, without a word for their end."""
        return plain(" / ".join(line for line in self.tail if not END.fullmatch(line)))

    @property
    def is_understood(self) -> bool:
        """Whether the words above the numbers leave no doubt: a title, and lines each of which declares something.

        Of text that declares unit and step it is enough that it speaks of no factor.
        """
        said_of = ((line, {claim.what for claim in Declarations.of([line]).claims}) for line in self.words)
        undeclared = [line for line, what in said_of if what <= {"peak"}]
        is_title = len(undeclared) < 2 and not any(
            re.search(r"[:=]|^[\d\s.,;+-]+$", line) for line in undeclared
        )
        is_all_said = bool(self.said.only("unit") and (self.said.only("time_step") or self.counts))
        return (is_title or is_all_said) and not any(map(speaks_of_factor, self.words))


def _bare(line: str) -> str:
    return line.strip().rstrip(",;").rstrip()


def _begins(lines: Sequence[str], numeric: Sequence[int]) -> bool:
    """Whether rows of as many numbers as the first, blank lines among them, make the begin of a table."""
    counts = [count for line, count in zip(lines, numeric, strict=True) if line.strip()][:_HEAD]
    return len(counts) > 1 and len(set(counts[:-1])) == 1 and 0 < counts[-1] <= counts[0]


def _counts(line: str) -> tuple[Above, ...]:
    """Return in which order a line holds a number of samples and a step, and no other number; () of another line."""
    parts = _WORDS.sub(" ", line).split()
    if len(parts) != 2 or not all(map(is_number, parts)) or "/" in line:
        return ()
    orders: tuple[tuple[Above, ...], ...] = ("n", "dt"), ("dt", "n")
    for order, (samples, step) in zip(orders, (parts, parts[::-1]), strict=True):
        if samples.isdecimal() and int(samples) > 1 and "." in step and 0 < float(step) <= LONGEST_STEP:
            return order
    return ()


def _named(above: Sequence[str], width: int) -> tuple[tuple[ColumnLabel, ...], Sequence[str]]:
    """Return the labels of `width` columns in the last line above them, or the last two, and the lines above these."""
    if not above:
        return (), ()
    line = above[-1].lstrip("#%$!/ ") if above[-1].startswith(_MARKS) else above[-1]
    names = _labels(line)
    if len(names) != width and len(line.split()) == width:
        names = tuple(line.split())
    if len(names) != width:
        return (), above
    over = _labels(above[-2]) if len(above) > 1 else ()
    has_names = len(over) == width
    if (has_names or width > 1) and (whole := with_units(over if has_names else [""] * width, names)):
        return tuple(map(ColumnLabel, whole)), above[: -2 if has_names else -1]
    if width > 1 and all(name.isdigit() and len(name) == 1 for name in names[1:]):
        names = (names[0], *[""] * (width - 1))  # numbers of columns, and no azimuths
    labels = tuple(map(ColumnLabel, _without_suffixes(names)))
    if width == 1:  # a line like "Geoscope (G)" names a network, and "El Centro" an earthquake
        is_named = labels[0].is_plain_acceleration or labels[0].is_direction or bool(labels[0].other)
    else:
        is_named = bool(re.search(r"[,;\t]", line)) or any(label.is_known for label in labels)
    return (labels, above[:-1]) if is_named else ((), above)


_G_SUFFIX = re.compile(r"(?i)(.*(?<![a-z])acc(el(eration)?)?(_\w+)?)_g")


def _without_suffixes(names: tuple[str, ...]) -> tuple[str, ...]:
    """Return names like "acc_g" with the unit in brackets where times accompany them: elsewhere "_g" may be of the
    ground."""
    if not any(ColumnLabel(name).is_time for name in names):
        return names
    return tuple(_G_SUFFIX.sub(r"\1 (g)", name) if _G_SUFFIX.fullmatch(name) else name for name in names)


_BRACKET_END = re.compile(r"[)\]]")
_WITH_UNIT = re.compile(r"[^)\]]+[)\]]")


def _labels(line: str) -> tuple[str, ...]:
    """The names in a line, parted by tabs, semicolons or commas, else by blanks; a unit in brackets stays with its."""
    if '"' in line:
        return tuple(re.findall(r'"([^"]*)"', line))
    line = re.sub(r"[,;\s]+$", "", line.lstrip("#%$!/ "))
    separator = next((mark for mark in "\t;," if mark in line), "")
    if separator:
        parts = line.split(separator)
    elif len(_BRACKET_END.findall(line)) > 1 and line.endswith((")", "]")):  # names of several words
        parts = _WITH_UNIT.findall(line)
    else:
        parts = re.split(r"\s+(?![(\[])", line.strip())
    return tuple(part.strip().strip("\"'") for part in parts)


def signature_of(content: bytes, file: str, folder: str) -> Signature | None:
    """Return the signature of the table `content` of a `file` called so in a `folder`, None of another content."""
    seen = _seen_of(content)
    return seen.signature(file, folder) if seen and seen.content else None


@dataclass(frozen=True)
class _Seen:
    """A table as it looks before anybody answers: its rows as bytes, and what its numbers are as far as they say it.

    content: with plain numbers, empty where a comma may be either of two things. notes: on how the rows end. values:
    (n,), and drawn: their layout, None where the numbers cannot be separated, as `fault` says.
    """

    table: NumberTable
    content: bytes = b""
    body: bytes = b""
    notes: tuple[RockingWarning, ...] = ()
    values: np.ndarray | None = None
    drawn: TableLayout | None = None
    fault: RecordError | None = None

    def below(self, start: int, layout: TableLayout | None = None, declared: float | None = None) -> "_Seen":
        """Return it as it looks from the line `start` on.

        layout: of its answer, by which its numbers part. declared: the time step that the caller declares, s.
        """
        try:
            table, body, notes = _plain_rows(self.table, text.after_lines(self.content, start))
            values = _values(body, table, layout)
            drawn = _drawn(table, values, b"," in body or b";" in body, declared)
        except RecordError as error:
            return replace(self, values=None, drawn=None, fault=error)
        return replace(self, table=table, body=body, notes=notes, values=values, drawn=drawn)

    def signature(self, file: str, folder: str) -> Signature:
        """Return what it has in common with tables for which the same answer holds; folder: in which `file` lies."""
        page = self.table.page(folder)
        if page.is_bare:
            page = replace(page, ending=PurePosixPath(file).suffix.lower())
        if self.drawn is None or self.values is None:
            return page
        columns = self.drawn.columns
        width = 1 if self.drawn.is_series else self.table.width
        numbers = self.values[len(self.drawn.above) :]
        rows = numbers[: numbers.size - numbers.size % width].reshape(-1, width)
        motions = [place for place, column in enumerate(columns) if column.role in ("acceleration", "open")]
        if motions and not all(columns[place].unit for place in motions):
            page = replace(page, peaks=f"{np.abs(rows[:, motions]).max(initial=0.0):.3g}")
        clocks = [rows[:, place] for place, column in enumerate(columns) if column.role == "time"]
        if page.is_bare and clocks and len(rows) > 1:
            page = replace(page, time_step_s=f"{np.median(np.diff(clocks[0])):.4g}")
        elif page.is_bare and len(named := Declarations(claims_of_name(file)).stated_steps) == 1:
            page = replace(page, time_step_s=f"{named[0]:.4g}")
        return page


@lru_cache(maxsize=2)
def _seen_of(content: bytes) -> _Seen | None:
    """Return the table that a content is as it looks before anybody answers, None of another content.

    Reading asks for it at each question anew.
    """
    if _OTHER_FORMAT.match(content) or b"\0" in content[:4096]:
        return None
    pointed = dialect.plain(content)
    table = NumberTable.of(pointed or content)
    if table is None:
        return None
    if pointed is None:
        decimals = "the commas are decimal signs or part columns; write points, or semicolons."
        return _Seen(table, fault=RecordError(decimals, decimals=","))
    return _Seen(table, pointed).below(_above(table, None, pointed)[1])


def _read_columns(content: bytes, options: Options) -> list[Accelerogram]:
    seen = _seen_of(content)
    if seen is None or not seen.content:
        raise (seen and seen.fault) or RecordError("this is no table of numbers.", rows=0)
    table = seen.table
    refuse_other_table("\n".join((*table.comments, *table.words)), [label.text for label in table.labels])

    layouts = options.layouts or Layouts(options.folder)
    signature = seen.signature(options.file, layouts.place)
    answer = layouts.answer(signature)
    layout = answer.layout if answer else None
    above, start = _above(table, layout, seen.content)
    begins_by_step = options.time_step and seen.drawn and seen.drawn.is_series and not above
    if begins_by_step or (layout and (layout.skip or layout.above or layout.width)):
        seen = seen.below(start, layout, options.time_step)
    if seen.values is None or seen.drawn is None:
        raise seen.fault or RecordError("its numbers cannot be separated.")
    table, body, values, drawn = seen.table, seen.body, seen.values, seen.drawn

    has_step = bool(above or options.time_step or table.said.only("time_step"))
    steps = table.said.stated_steps or Declarations(claims_of_name(options.file)).stated_steps
    question = Question(signature, _holds(table, drawn, values), drawn.proposal(has_step, steps))
    notes = (*seen.notes, *factor_warnings((*table.comments, *table.words, *table.tail)))
    if table.below:
        notes += (RockingWarning.of(RecordKind.TAIL_PASSED_OVER, text=table.below[:80]),)
    if answer and layout:
        if not table.labels and layout.is_series != drawn.is_series:
            # Another file of its folder was answered for.
            notes += (
                RockingWarning.of(RecordKind.UNLIKE_ITS_ANSWER, answer=answer.text, holds=question.holds),
            )
        layout = _fitted(answer, layout, table, drawn)
        known = (label if label.is_known else ColumnLabel("") for label in table.labels)
        table = replace(table, labels=tuple(known))
    else:
        _ask_where_open(table, drawn, options, question, body)
        layout = drawn

    try:
        records = _channels(values, table, layout, above, options)
    except UndeclaredError as error:
        raise AskedError(error.args[0], error.field, question) from None
    except AnswerContradictedError as error:
        raise (answer.wrong(str(error)) if answer else error) from None
    if len(records) == 1:
        notes += warnings_of_claims(records[0], table.said)
    said = table.said.only("direction")
    if len(records) == 1 and said and (not records[0].component or names_acceleration(records[0].component)):
        records = [replace(records[0], **directed({"component": said}))]
    whose = f"read as {answer.text!r}, by {answer.whose}" if answer else ""
    return [
        replace(record, source=replace(record.source, answer=whose)).warned(
            *notes, *_cut_number(body), *_never_negative(record)
        )
        for record in records
    ]


def _above(table: NumberTable, layout: TableLayout | None, content: bytes) -> tuple[dict[Above, float], int]:
    """Return the numbers above a series, by what they are, and the line at which its samples begin.

    Raises RecordError where an answer names numbers above it that are not there.
    """
    if layout and layout.above:
        at, roles = layout.skip, layout.above
    elif table.counts:
        at, roles = table.counts
    else:
        return {}, max(table.start, layout.skip if layout else 0)
    lines = text.lines(content, at + _HEAD)[at:]
    found: list[str] = []
    while len(found) < len(roles) and lines:
        found += _WORDS.sub(" ", lines.pop(0)).split()
        at += 1
    if len(found) != len(roles) or not all(map(is_number, found)):
        named = ", ".join(roles)
        raise RecordError(
            f"above its samples are {' '.join(found)[:40]!r}, and not the numbers {named}.",
            above=" ".join(found),
        )
    return dict(zip(roles, map(float, found), strict=True)), max(at, table.start if table.counts else at)


_NO_VALUE = re.compile(r"(?i)[\s,;]*(?:(?:nan|inf|na|null|none|n/a|#n/a)[\s,;]*)+")
_LONGEST_TAIL = 20
"""Lines of text that may follow below the numbers."""


def _parted(below: bytes, width: int) -> tuple[bytes, tuple[str, ...]]:
    """Return the rows of `width` numbers, and the lines of text below the last of them.

    A line of text begins with no number, and is no row of missing values: those are damage.
    """
    end = below[-_TAIL:]
    lines = end.decode("latin-1").split("\n")
    if len(below) > _TAIL:
        del lines[0]  # cut
    tail: list[str] = []
    while lines and len(tail) <= _LONGEST_TAIL and not _is_row(lines[-1], width):
        tail.insert(0, lines.pop())
    text_below = [line.strip() for line in tail if line.strip()]
    if not text_below or not lines or len(tail) > _LONGEST_TAIL:
        return below, ()
    return below[: len(below) - len("\n".join(tail))], tuple(text_below)


def _is_row(line: str, width: int) -> bool:
    """Whether a line begins as a row of numbers does, is one of missing values, or one of which a number is damaged."""
    bare = line.strip()
    cells = [cell for cell in _SEPARATOR.split(bare) if cell]
    if not cells or bool(_NO_VALUE.fullmatch(bare)) or bare[0] in ',;"':
        return bool(bare)
    if re.match(r"[+-]?\.?\d", bare):
        return True
    is_like_one = len(cells) == width and 2 * sum(map(is_number, cells)) >= width
    return is_like_one or (width == 1 == len(cells) and bool(re.search(r"\d", bare)))


def _plain_rows(table: NumberTable, below: bytes) -> tuple[NumberTable, bytes, tuple[RockingWarning, ...]]:
    """Return a table with its tail, its rows of numbers without the empty cells behind them, and what there is to say.

    NaN may fill up the last row of a series, or be all that the last row of columns holds next to its time. Raises
    RecordError where a cell is empty.
    """
    body, tail = _parted(below, table.width)
    bare, notes = text.without_filling(body) if table.width > 2 or table.labels else (body, ())
    if notes and table.labels:
        last = body[body.rstrip().rfind(b"\n") + 1 :]
        cells = [cell for cell in _SEPARATOR.split(last.decode("latin-1").strip().lower()) if cell]
        values = cells[1:] if table.labels[0].is_time else cells
        bare = body.removesuffix(last)
        if len(cells) != table.width or {*values} != {"nan"}:
            bare, notes = body, ()
    if _EMPTY_LAST.search(bare):
        bare = _EMPTY_END.sub(b"", bare)
    if _EMPTY_CELL.search(bare):
        raise RecordError("a cell is empty; every column needs a number on every line.", cell="")
    return replace(table, tail=tail), bare, notes


def _drawn(table: NumberTable, values: np.ndarray, is_parted: bool, declared: float | None) -> TableLayout:
    """Return the layout of a table as far as its names, and its numbers where it has none, say it; the rest is open.

    is_parted: whether commas or semicolons part its numbers. declared: the time step that the caller declares, s.
    """
    said = table.said
    width = table.width
    labels = table.labels or (ColumnLabel(""),) * width
    if width == 1 or (width > 2 and not table.labels and _runs_along_rows(values, width, is_parted)):
        series = Column("acceleration", unit=labels[0].unit or said.only("unit"))
        above = () if table.counts else _first_numbers(values, declared)
        a_line = width if width > 1 else 0
        return TableLayout((series,), True, per_line=a_line, above=above, time_step=said.only("time_step"))
    rows = values[: values.size - values.size % width].reshape(-1, width)
    columns = [_column(label, column, said) for label, column in zip(labels, rows.T, strict=True)]
    times = [label.is_time for label in labels]
    for place, label in enumerate(labels):
        if label.text == "T" and sum(times) > 1 and not _is_clock(rows[1:, place]):
            columns[place] = Column("acceleration", unit=said.only("unit"))  # transverse
        if columns[place].role == "time":
            continue
        if _LETTER.fullmatch(label.text) and any(other.is_plain_acceleration for other in labels):
            columns[place] = Column(
                "open", unit=said.only("unit")
            )  # v and u next to "a" are of velocity and displacement
    if not table.labels and {column.role for column in columns} <= {"time", "other"}:
        columns[1:] = [Column("open", unit=said.only("unit"))] * (width - 1)  # a motion that rises evenly
    return TableLayout(tuple(columns), time_step=said.only("time_step"))


def _column(label: ColumnLabel, numbers: np.ndarray, said: Declarations) -> Column:
    """Return what a column holds by its name, or by numbers that rise all the way; open where neither says it."""
    if label.other or label.is_time:
        return Column("other") if label.other else Column("time", seconds=label.seconds or 1.0)
    says_where = Direction.of(label.component).is_known
    is_open = label.is_count or not label.text or (_climbs_evenly(numbers) and not says_where)
    if not label.unit and is_open and _is_clock(numbers[1:]):
        is_count = label.is_count or (numbers.size >= _FEWEST_ROWS and bool((np.diff(numbers) == 1).all()))
        return Column("other") if is_count else Column("time", seconds=label.seconds or 1.0)
    is_named = bool(label.unit) or label.is_direction or label.is_plain_acceleration
    is_motion = is_named and not _climbs_evenly(numbers)  # or its name and its numbers say two things
    return Column("acceleration" if is_motion else "open", unit=label.unit or said.only("unit"))


_LETTER = re.compile(r"(?i)[vdux]")


def _is_clock(numbers: np.ndarray) -> bool:
    """Whether numbers from zero or above rise with their place, as times do that are uneven, rounded or have a gap."""
    if numbers.size < 2 or numbers[0] < 0 or not numbers[-1] > numbers[0]:
        return False
    return bool(np.corrcoef(numbers, np.arange(numbers.size))[0, 1] > _ONE_WAY)


def _climbs_evenly(numbers: np.ndarray) -> bool:
    """Whether numbers climb by even steps from the first to the last, as times do, whatever they are called."""
    steps = np.diff(numbers)
    return (
        numbers.size >= _FEWEST_ROWS and steps.min() > 0 and float(np.ptp(steps)) < 0.5 * float(steps.mean())
    )


_ONE_WAY = 0.98
"""Correlation of a column with its place from which on it is a clock: no motion rises so, all the way."""
_OF_CHANNELS = (3, 4, 6, 9)
"""Numbers of columns that a table of channels without names may well have."""


def _runs_along_rows(values: np.ndarray, width: int, is_parted: bool) -> bool:
    """Whether numbers in `width` columns without names are one series, wrapped, and not channels side by side.

    Along a series the next number is nearer than the one a row further on; of channels it is that of another channel.
    Where the rows are too few to tell, commas or semicolons part channels.
    """
    rows = values.size // width
    if rows < _FEWEST_ROWS:
        return not is_parted
    whole = values[: rows * width]
    first = whole[: 50 * width : width]
    if first[0] >= 0 and np.diff(first).min() > 0 and np.ptp(np.diff(first)) < 0.01 * (first[1] - first[0]):
        return False  # it counts time
    along = float(np.abs(np.diff(whole)).mean())
    across = float(np.abs(whole[width:] - whole[:-width]).mean())
    return along <= (1.0 if width in _OF_CHANNELS else 1.5) * across


def _holds(table: NumberTable, drawn: TableLayout, values: np.ndarray) -> str:
    """Return what a table holds as far as it can be seen, for a person who knows the rest."""
    rows = values.size // table.width
    size = f"{rows:,} rows".replace(",", " ")
    if table.below:
        size += f"; below them {table.below[:60]!r}"
    if drawn.is_series:
        return f"one series in {drawn.columns[0].unit or '?'}, {table.width} a line; {size}"
    contents = []
    for place, column in enumerate(drawn.columns):
        name = f" ({table.labels[place].text})" if table.labels and table.labels[place].text else ""
        first = values[place :: table.width][:_HEAD] * column.seconds
        step = float(np.median(np.diff(first))) if first.size > 1 else 0.0
        kinds = {
            "time": f"times of {step:.4g} s",
            "other": "no acceleration",
            "open": f"? in {column.unit}" if column.unit else "?",
        }
        what = kinds.get(column.role, f"acceleration in {column.unit or '?'}")
        contents.append(f"column {place + 1}{name}: {what}")
    return "; ".join([*contents, size])


def _ask_where_open(
    table: NumberTable, drawn: TableLayout, options: Options, question: Question, body: bytes
) -> None:
    """Raise AskedError where a table leaves open what it holds, but for the unit and the step of one series.

    One column without a name next to times is that series, and so is one with a strange name whose unit is declared.
    """
    open_ones = [place for place, column in enumerate(drawn.columns) if column.role == "open"]
    accelerations = [column for column in drawn.columns if column.role == "acceleration"]
    has_step = bool(drawn.time_step or table.counts) or any(column.role == "time" for column in drawn.columns)
    is_complete = (
        not open_ones and has_step and bool(table.labels) and all(column.unit for column in accelerations)
    )
    names = [table.labels[at] for at in open_ones if table.labels and table.labels[at].text]
    is_strange = any(name.is_strange or not options.unit for name in names)
    if len(open_ones) + bool(open_ones and accelerations) > 1 or is_strange:
        why = "what its columns hold is not known"
    elif not table.is_understood and (not is_complete or any(map(speaks_of_factor, table.words))):
        why = "what the text above its numbers says is not known"
    elif drawn.is_series and table.width > 1 and (first := _whole_numbers(body)):
        why = f"the first row of numbers, {first!r}, is of whole numbers and seems to be a header"
    else:
        return
    # Nobody is asked about a file that is called velocity.
    if not any(column.unit for column in drawn.columns):
        agreed("unit", claims_of_name(options.file))
    raise AskedError(f"{why} ({question.holds}); {_ANSWER_IT}", "layout", question)


_ANSWER_IT = "answer it once in layouts.csv, of which rocking catalogue writes the line."


def _fitted(answer: LayoutAnswer, layout: TableLayout, table: NumberTable, drawn: TableLayout) -> TableLayout:
    """Return the layout of an answer for one table. Raises RecordError where it contradicts the page or the numbers."""
    a_line = layout.per_line or (table.width if layout.is_series else len(layout.columns))
    if a_line != table.width and not layout.width:
        raise answer.wrong(f"it has {a_line} numbers a line, but this file has {table.width}.")
    said = table.said
    labels = (
        table.labels if len(table.labels) == len(layout.columns) else (ColumnLabel(""),) * len(layout.columns)
    )
    of_numbers = drawn.columns if len(drawn.columns) == len(layout.columns) else layout.columns
    for place, (column, label, theirs) in enumerate(zip(layout.columns, labels, of_numbers, strict=True), 1):
        if column.role == theirs.role == "time" and label.seconds not in (None, column.seconds):
            raise answer.wrong(
                f"column {place} of this file is in another unit of time by its name, {label.text!r}."
            )
        if column.role != "acceleration":
            continue
        if theirs.role == "time" and not layout.is_series:
            raise answer.wrong(f"column {place} of this file holds times.")
        if label.other:
            raise answer.wrong(f"column {place} of this file is {label.other} by its name, {label.text!r}.")
        component = (
            label.component
            if label.is_direction
            else (said.only("direction") or "")
            if len(labels) < 3
            else ""
        )
        if point_apart(component, column.name):
            raise answer.wrong(f"column {place} of this file is {component!r} by its own words.")
    return replace(layout, is_answer=True)


_MEANT = {"n": "the number of samples", "dt": "the time step", "hz": "the rate", "-": "the number of series"}


def _first_numbers(values: np.ndarray, declared: float | None) -> tuple[Above, ...]:
    """Return what the first numbers of a series are that are no samples, as programs of analysis write them there.

    declared: the time step that the caller declares, s.
    """
    if values.size < _FEWEST_ROWS:
        return ()
    first, second = values[:2].tolist()
    rest = values.size - 2
    if first == rest + 1:
        return ("n",)
    if first == rest and (0 < second <= LONGEST_STEP or (20 <= second <= 2000 and second == round(second))):
        return ("n", "dt" if second <= LONGEST_STEP else "hz")
    if second == rest and 0 < first <= LONGEST_STEP:
        return ("dt", "n")
    # No motion falls so from its first sample to the next ones.
    if first == 1 and 0.0005 <= second <= 0.05 and np.abs(values[2:_FEWEST_ROWS]).max() < 0.5:
        return ("-", "dt")
    return ("dt",) if declared is not None and first == declared else ()


def _values(body: bytes, table: NumberTable, layout: TableLayout | None) -> np.ndarray:
    """Return the numbers of rows, of the width that an answer says where they touch. Raises RecordError for others."""
    if layout and layout.width:
        values = text.fields(text.lines(body), layout.width)
    else:
        spaced = _TOUCHING.sub(rb"\1 ", body).replace(b",", b" ").replace(b";", b" ")
        values = text.numbers(spaced)
        _check_rows(spaced, table.width, may_end_short=not table.labels)
    if values.size < 2:
        raise RecordError(
            f"{values.size} numbers follow what is passed over, but at least 2 are needed.",
            samples=int(values.size),
        )
    return values


def _check_rows(spaced: bytes, width: int, may_end_short: bool) -> None:
    """Raise RecordError unless every row of numbers has `width` of them; the last row of a series may be short."""
    counts = list(filter(None, map(len, map(bytes.split, spaced.split(b"\n")))))
    if may_end_short and counts and counts[-1] < width:
        del counts[-1]
    for at, count in enumerate(counts, 1):
        if count != width:
            raise RecordError(
                f"row {at} of the samples has {count} columns, but the first has {width}.", columns=count
            )


def _whole_numbers(body: bytes) -> str:
    """Return the first row of a series of decimals where it is of whole numbers, "" else: these are a header's."""
    first, _, rest = body.lstrip().partition(b"\n")
    if b"." in first or b"." not in rest or not re.search(rb"\d\d", first):
        return ""
    return first.decode("latin-1").strip()[:40]


def _channels(
    values: np.ndarray, table: NumberTable, layout: TableLayout, above: dict[Above, float], options: Options
) -> list[Accelerogram]:
    """Return the channels of a table: each column of acceleration, with the times left of it, else the first ones.

    A series along the rows is one column. above: its numbers in the lines above, where they are no rows.
    """
    columns = layout.columns
    notes: tuple[RockingWarning, ...] = ()
    if layout.is_series and not above and (roles := _first_numbers(values, options.time_step)):
        above = dict(zip(roles, values.tolist(), strict=False))
        notes = (RockingWarning.of(RecordKind.FIRST_NUMBERS, what=", ".join(_MEANT[role] for role in roles)),)
        values = values[len(roles) :]
    if values.size % len(columns):
        raise RecordError(
            f"the last row of the samples has {values.size % len(columns)} of {len(columns)} columns.",
            columns=values.size % len(columns),
        )
    rows = values.reshape(-1, len(columns))
    labels = table.labels[:1] if layout.is_series else table.labels
    if len(labels) != len(columns):
        labels = (ColumnLabel(""),) * len(columns)
    if declared := f"{above['n']:g}" if "n" in above and not notes else table.said.count(len(rows)):
        surplus = table.width if layout.is_series else int("n" not in above)
        notes += text.whole(rows[:, 0], text.count("number of samples", declared), surplus)[1]
    every = {at: rows[:, at] * column.seconds for at, column in enumerate(columns) if column.role == "time"}
    notes += () if every else _repeats(values)
    stated = above.get("dt") or (1 / above["hz"] if above.get("hz") else None)
    held = replace(options, unit=None, time_step=None, file="")
    records = []
    for place, (column, label) in enumerate(zip(columns, labels, strict=True)):
        if column.role not in ("acceleration", "open") or (layout.is_series and label.other):
            continue
        left = max((at for at in every if at < place), default=min(every, default=-1))
        step, numbers = stated, rows[:, place]
        uneven: tuple[RockingWarning, ...] = ()
        if (times := every.get(left)) is not None and (step := text.even_step(times)) is None:
            step, even, warning = text.resampled(times)
            numbers = np.interp(even, times, numbers)
            uneven = (warning,)
        name = label.component if not layout.is_series else "" if label.unit else label.text
        facts: dict[str, Any] = {"component": column.name or name, "warnings": (*notes, *uneven)}
        facts["processing"] = tuple(map(str, uneven))
        if layout.is_series and table.counts and len(table.words) == 1:
            facts["event"] = table.words[0][:60]  # a title
        claims = (
            Claim("unit", column.unit if layout.is_answer else None, Where.ANSWER),
            Claim("unit", label.unit, Where.COLUMN, label.text),
            Claim("time_step", layout.time_step if layout.is_answer else None, Where.ANSWER),
            Claim("time_step", step, Where.SAMPLES),
            *(claim for claim in table.said.claims if claim.where == Where.HEAD or not options.is_stand_in),
            *options.said,
        )
        unit, agreed_step = agreed("unit", claims), agreed("time_step", claims)
        if agreed_step and agreed_step > LONGEST_STEP:
            must = f"time_step is {agreed_step!r} s, but must be at most {LONGEST_STEP:g} s; convert what is in ms."
            raise UndeclaredError(must, time_step=agreed_step)  # as what is in ms is asked with the rest
        records.append(held.accelerogram(unit, numbers, agreed_step, processed=None, **facts))
    if not records:
        _refuse_all(labels)
    return records


def _refuse_all(labels: Sequence[ColumnLabel]) -> None:
    """Raise RecordError: every column of a table is of something else than acceleration."""
    others = {label.text: label.other for label in labels if label.other}
    if len(set(others.values())) == 1 and (quantity := next(iter(others.values()))) in (
        "velocity",
        "displacement",
    ):
        raise of_another(quantity)
    contents = "; ".join(f"{name[:40]!r} is {what}" for name, what in others.items())
    raise RecordError(
        f"no column is of acceleration in a unit that is known: {contents}; convert the column, or use another file.",
        columns=others,
    )


def _never_negative(record: Accelerogram) -> tuple[RockingWarning, ...]:
    """Return a warning where no number is below zero: the ground moves both ways."""
    is_moving = record.acceleration.size >= _FEWEST_OF_BOTH_SIGNS and record.peak_acceleration > 0
    if not is_moving or record.acceleration.min() < 0:
        return ()
    return (RockingWarning(RecordKind.NEVER_NEGATIVE, record.component or "the column"),)


def _cut_number(body: bytes) -> tuple[RockingWarning, ...]:
    """Return a warning when the last number has fewer decimals than all above it, and no line end: the file is cut."""
    tail = [] if body.endswith(b"\n") else text.lines(body[-_TAIL:])[1:]
    decimals = [len(match[1]) for line in tail if line.strip() and (match := _DECIMALS.search(line))]
    if len(decimals) < 3 or decimals[-1] >= min(decimals[:-1]):
        return ()
    return (RockingWarning(RecordKind.NUMBER_CUT),)


def _repeats(values: np.ndarray) -> tuple[RockingWarning, ...]:
    """Return a warning when numbers without count or times come twice."""
    half, odd = divmod(values.size, 2)
    is_twice = not odd and half > 1 and np.any(values) and np.array_equal(values[:half], values[half:])
    return (RockingWarning.of(RecordKind.HALF_REPEATED, samples=half),) if is_twice else ()


COLUMNS = Format(
    "columns of numbers",
    "spreadsheets, OpenSees and scripts",
    "lines that hold numbers only, below names that leave nothing open",
    lambda content: _seen_of(content) is not None,
    _read_columns,
    yields=True,
)
