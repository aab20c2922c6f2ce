"""Layouts: what the numbers of tables are, as a person answers it ("t, NS, EW g"), asked once in layouts.csv."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence
from contextlib import suppress
from copy import copy
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from types import MappingProxyType
from typing import Literal, get_args

from rocking.errors import CatalogueError, RecordError, UndeclaredError
from rocking.quantities import acceleration_factor, acceleration_unit, counted, is_number, seconds_of
from rocking.records.claims import other_quantity
from rocking.tables import edited_text, read_edited

NAME = "layouts.csv"
COLUMNS = (
    "answer", "holds", "file", "names", "numbers_a_line", "text_above", "folder", "ending", "time_step_s", "peaks",
    "tried",
)  # fmt: skip
_OF_SIGNATURE = COLUMNS[3:-1]
_SHIPPED = Path(__file__).with_name(NAME)


Role = Literal["time", "acceleration", "other", "open"]
Above = Literal["n", "dt", "hz", "-"]
"""A number above a series: the number of samples, the time step, the rate, or what does not matter."""

_EXAMPLES = "'t, a g', 'NS, EW, UD g' or 'one series g, 5 a line, skip 2'"
_TIME_WORDS = "t", "time", "times"
_NAME = re.compile(r"[^\W_][\w+/-]*|[+-]?\w+")
_PLAIN = {"a", "acc", "acceleration"}
_FORTRAN = re.compile(r"(?i)(\d+)[FEGI](\d+)(?:\.\d+)?")
OPEN = "?"
"""Stands in an answer for what is still to be answered."""


@dataclass(frozen=True)
class Column:
    """What the numbers of one column are.

    name: of a component, "" where the file's own holds. unit: of acceleration, None where the file says it; of an open
    column what the file says. seconds: the unit of times, s.
    """

    role: Role
    name: str = ""
    unit: str | None = None
    seconds: float = 1.0

    def __str__(self) -> str:
        if self.role == "other":
            return "-"
        if self.role == "open":
            return f"{OPEN} {self.unit}" if self.unit else OPEN
        if self.role == "time":
            return "t" + next(
                (f" {unit}" for unit in ("ms", "min", "h", "us") if seconds_of(unit) == self.seconds), ""
            )
        return f"{self.name or 'a'} {self.unit or OPEN}"


@dataclass(frozen=True)
class TableLayout:
    """How the numbers of a table are to be read.

    columns: in their order; of a series the one that it is. is_series: whether it runs along the rows. per_line:
    numbers on a line, 0 where nobody says it; more than there are columns: so many rows are on a line. width:
    characters of each, 0 where blanks part them. skip: lines that are passed over. above: numbers before the first of a
    series. time_step: s, where no column holds times. is_answer: whether a person gave it.
    """

    columns: tuple[Column, ...]
    is_series: bool = False
    per_line: int = 0
    width: int = 0
    skip: int = 0
    above: tuple[Above, ...] = ()
    time_step: float | None = None
    is_answer: bool = False

    @classmethod
    def parse(cls, answer: str) -> "TableLayout":
        """Return the layout that an answer says. Raises RecordError at the first word that is none of an answer's.

        >>> from rocking.records.formats.layouts import TableLayout
        >>> str(TableLayout.parse("t, NS, ew gal"))
        't, NS gal, ew gal'
        """
        items = [item.strip() for item in answer.split(",") if item.strip()]
        is_series = any(item.lower().startswith("one series") for item in items)
        layout = cls((), is_series)
        for item in items:
            layout = _with_item(layout, item)
        units = [column.unit for column in layout.columns if column.role == "acceleration"]
        if not units:
            raise RecordError(
                f"no column of {answer!r} is of acceleration; answer like {_EXAMPLES}.", answer=answer
            )
        columns = (
            replace(column, unit=column.unit or units[-1]) if column.role == "acceleration" else column
            for column in layout.columns
        )
        return replace(layout, columns=tuple(columns))

    def proposal(self, has_step: bool, steps: Sequence[float] = ()) -> str:
        """Return it as an answer that a person completes; has_step: whether something else says the time step.

        steps: the steps [s] that the text of the file speaks of, of which the only one is proposed. Where nothing in it
        is open, it begins with the sign for what is: to take that away is the answer.
        """
        is_timed = any(column.role == "time" for column in self.columns) or {"dt", "hz"} & set(self.above)
        has_step = has_step or bool(self.time_step) or bool(is_timed)
        step = f", dt {steps[0]:g}" if len(steps) == 1 else f", dt {OPEN}"
        answer = str(replace(self, time_step=None)) + ("" if has_step else step)
        return answer if OPEN in answer else f"{OPEN} {answer}"

    def __str__(self) -> str:
        columns = ", ".join(map(str, self.columns))
        if self.is_series:
            columns = f"one series {self.columns[0].unit or OPEN}"
        return ", ".join(
            [
                *([f"skip {self.skip}"] if self.skip else []),
                *self.above,
                columns,
                *([f"{self.per_line}F{self.width}"] if self.width else []),
                *([f"{self.per_line} a line"] if self.per_line and not self.width else []),
                *([f"dt {self.time_step:g}"] if self.time_step else []),
            ]
        )


def _with_item(layout: TableLayout, item: str) -> TableLayout:
    """Return a layout with what one item of an answer adds to it."""
    word, _, rest = item.lower().partition(" ")
    if fortran := _FORTRAN.fullmatch(item):
        return replace(layout, per_line=int(fortran[1]), width=int(fortran[2]))
    if word == "skip" and rest.isdecimal():
        return replace(layout, skip=int(rest))
    if word.isdecimal() and rest in ("a line", "per line"):
        return replace(layout, per_line=int(word))
    if word == "dt" and is_number(rest.removesuffix("s").strip()):
        return replace(layout, time_step=float(rest.removesuffix("s")))
    if layout.is_series and not layout.columns:
        for role in get_args(Above):
            if item.lower() == role:
                return replace(layout, above=(*layout.above, role))
    if word == "one" and rest.split(" ")[0] == "series":
        return replace(layout, columns=(_acceleration("a", rest.partition(" ")[2]),))
    if layout.is_series:
        raise RecordError(
            f"{item!r} is no part of an answer of one series; answer like {_EXAMPLES}.", answer=item
        )
    if item == "-":
        return replace(layout, columns=(*layout.columns, Column("other")))
    if word in _TIME_WORDS:
        return replace(layout, columns=(*layout.columns, Column("time", seconds=seconds_of(rest or "s"))))
    if unit_alone := acceleration_unit(item):
        return replace(layout, columns=(*layout.columns, Column("acceleration", unit=unit_alone)))
    name, _, unit = item.partition(" ")
    return replace(layout, columns=(*layout.columns, _acceleration(name, unit)))


def _acceleration(name: str, unit: str) -> Column:
    if not _NAME.fullmatch(name):
        raise RecordError(f"{name!r} names no component; answer like {_EXAMPLES}.", answer=name)
    if quantity := other_quantity(name):
        raise RecordError(
            f"{name!r} is {quantity}; write - for a column that is no acceleration.", answer=name
        )
    known = acceleration_unit(unit)
    if unit.strip() and known is None:
        raise RecordError(
            f"{unit.strip()!r} is no unit of acceleration; answer like {_EXAMPLES}.", answer=unit.strip()
        )
    return Column("acceleration", "" if name.lower() in _PLAIN else name, known)


_APART = 3.0
"""The factor between the least and the largest peak of files of one question: g and m/s² are 9.81 apart."""


@dataclass(frozen=True)
class Signature:
    """What tables have in common that one answer holds for.

    names: of the columns. numbers_a_line: their number. text_above: the words above them that mean something. folder:
    of the files, next to the catalogue, where neither names nor words say anything; "" else, or for the folder itself.
    ending: of the name of a file, and time_step_s: of its times, where neither says anything. peaks: the largest number
    of a file whose page states no unit, or the range of those of the files that a question was drawn from, "0.35..3.1".
    """

    names: str
    numbers_a_line: str
    text_above: str
    folder: str = ""
    ending: str = ""
    time_step_s: str = ""
    peaks: str = ""

    @classmethod
    def of_row(cls, row: Mapping[str, str]) -> "Signature":
        """Return the signature that a row of layouts.csv is for."""
        cells = {name: " ".join((row.get(name) or "").split()) for name in _OF_SIGNATURE}
        return cls(**cells | {"time_step_s": cells["time_step_s"].replace(",", ".")})

    @property
    def cells(self) -> tuple[str, ...]:
        """It as the cells of a row of layouts.csv."""
        return tuple(getattr(self, name) for name in _OF_SIGNATURE)

    @property
    def page(self) -> tuple[str, ...]:
        """What the page of a table says, and where it lies if it says nothing."""
        return self.names, self.numbers_a_line, self.text_above, self.folder

    @property
    def is_bare(self) -> bool:
        """Whether the page says nothing, neither by names nor by words: then the numbers alone speak."""
        return not (self.names or self.text_above)

    @property
    def peak(self) -> float:
        """The largest number of a file, 0 where it does not count."""
        return self._range[1]

    @cached_property
    def _range(self) -> tuple[float, float]:
        ends = [end.strip().replace(",", ".") for end in self.peaks.split("..")]
        if not 1 <= len(ends) <= 2 or not all(map(is_number, ends)):
            return 0.0, 0.0
        return float(ends[0]), float(ends[-1])

    def distance(self, file: "Signature") -> float | None:
        """Return how far the numbers of a `file` lie from those that this row was drawn from, None where it is unlike.

        0: among them. Above: the factor by which the peak is off the middle of their peaks, within the root of three.
        An empty cell of a row holds for every file, but where the page says nothing.
        """
        if self.page != file.page:
            return None
        pairs = (self.ending, file.ending), (self.time_step_s, file.time_step_s)
        if any(own != other and (own or self.is_bare) for own, other in pairs):
            return None
        if not self.peaks and not (self.is_bare and file.peaks):
            return 0.0
        low, high = self._range
        if self.peaks == file.peaks or (self.peaks and low <= file.peak <= high):
            return 0.0
        if not (low > 0 and file.peak > 0):
            return None
        off = abs(math.log(file.peak / math.sqrt(low * high)))
        return math.exp(off) if off <= math.log(_APART) / 2 else None


@dataclass(frozen=True)
class Question:
    """What has to be answered of a table: its signature, what its columns hold as far as it can be seen, a proposal."""

    signature: Signature
    holds: str
    proposal: str


@dataclass(frozen=True)
class Family:
    """Files for which one answer holds, and the question that they ask together."""

    files: tuple[str, ...]
    question: Question


def families(questions: Iterable[tuple[str, Question]]) -> list[Family]:
    """Return the files that ask, in families: alike by their pages, and with peaks within a factor of three.

    questions: with the file that each is drawn from. Each family says how its files, and the others of one page, peak.
    """
    pages: dict[Signature, list[tuple[str, Question]]] = {}
    for file, question in questions:
        pages.setdefault(replace(question.signature, peaks=""), []).append((file, question))
    found = []
    of_page: dict[tuple[str, ...], list[list[tuple[str, Question]]]] = {}
    for signature, asking in pages.items():
        of_page.setdefault(signature.page, []).extend(_alike(asking))
    for groups in of_page.values():
        for group in groups:
            file, first = group[0]
            peaks = _range_of(group)
            signature = replace(first.signature, peaks=peaks)
            holds = first.holds + "; " + _counts(group, [other for other in groups if other is not group])
            found.append(Family(tuple(name for name, _ in group), Question(signature, holds, first.proposal)))
    return found


def _alike(asking: Sequence[tuple[str, Question]]) -> list[list[tuple[str, Question]]]:
    """Return the files of one page, parted so that the peaks of each part lie within a factor of its least one."""
    parts: list[list[int]] = []
    lowest = 0.0
    peaks = [question.signature.peak for _, question in asking]
    for place in sorted(range(len(asking)), key=peaks.__getitem__):
        if not parts or peaks[place] > _APART * lowest:
            parts.append([])
            lowest = peaks[place]
        parts[-1].append(place)
    return [[asking[place] for place in sorted(part)] for part in sorted(map(sorted, parts))]


def _range_of(group: Sequence[tuple[str, Question]]) -> str:
    """Return the peaks of a family as a row of layouts.csv writes them, "" where they do not count."""
    of = sorted({question.signature.peaks for _, question in group}, key=lambda peak: float(peak or 0))
    return "..".join(dict.fromkeys((of[0], of[-1])))


def _counts(group: Sequence[tuple[str, Question]], others: Sequence[Sequence[tuple[str, Question]]]) -> str:
    """Return how many files there are of a family, and how their peaks compare with those of the other families."""
    count = sum(map(len, others)) + len(group)
    how_many = counted(count, "file") if not others else f"{len(group)} of {count} files"
    if peaks := _range_of(group):
        how_many += f" with peaks {peaks.replace('..', '–')}"
    rest = [f"{len(other)} of {peaks.replace('..', '–')}" for other in others if (peaks := _range_of(other))]
    return how_many + (f" (the others: {', '.join(rest)})" if rest else "")


class AskedError(UndeclaredError):
    """A table that leaves its unit, its step or its columns open; `question`: what layouts.csv asks of it."""

    def __init__(self, message: str, field: str, question: Question) -> None:
        super().__init__(message, **{field: None})
        self.question = question


@dataclass(frozen=True, kw_only=True)
class LayoutAnswer:
    """One answer: its text, who gave it, its line and the file that it was drawn from."""

    text: str
    whose: str
    line: int
    file: str

    @cached_property
    def layout(self) -> TableLayout:
        """The layout that it says. Raises RecordError naming line, column and file where it is none."""
        try:
            return TableLayout.parse(self.text)
        except RecordError as error:
            raise self.wrong(str(error)) from None

    def wrong(self, why: str) -> RecordError:
        """Return the error that says why it cannot hold."""
        drawn = f", drawn from {self.file}" if self.file else ""
        place = f"{self.whose}, line {self.line}, column answer, {self.text!r}{drawn}"
        return RecordError(f"{place}: {why}", answer=self.text)


class Layouts:
    """The answers that hold in a folder: those of its layouts.csv, and below them those that this package knows.

    folder: that of the catalogue, None for no file. place: where next to it the files lie that are asked about.
    """

    def __init__(self, folder: Path | None = None, place: str = "") -> None:
        self.place = "" if place == "." else place
        self._path = None if folder is None else folder / NAME

    def at(self, place: str) -> "Layouts":
        """Return the same answers for files of another folder next to the catalogue."""
        other = copy(self)  # with the rows that are read already
        other.place = "" if place == "." else place
        return other

    @cached_property
    def rows(self) -> Sequence[tuple[int, Mapping[str, str]]]:
        """The rows of layouts.csv, none where there is none. Raises CatalogueError for what is no such table."""
        if self._path is None or not self._path.is_file():
            return ()
        return read_edited(self._path, CatalogueError, COLUMNS, COLUMNS[:1])

    @cached_property
    def _answers(self) -> Sequence[tuple[Signature, LayoutAnswer]]:
        return _answers(self.rows, NAME)

    def _matching(self, signature: Signature | None) -> list[LayoutAnswer]:
        """Return the answers that hold for tables of a signature: those drawn from files that are nearest to it."""
        for answers in (self._answers, _shipped()):
            offs = ((row.distance(signature) if signature else None, answer) for row, answer in answers)
            found = [(off, answer) for off, answer in offs if off is not None]
            if found:
                nearest = min(off for off, _ in found)
                return [answer for off, answer in found if off == nearest]
        return []

    def answer(self, signature: Signature) -> LayoutAnswer | None:
        """Return the answer for tables of a signature, None where there is none yet.

        Raises RecordError where two lines answer otherwise.
        """
        found = {answer.text: answer for answer in self._matching(signature)}
        if len(found) > 1:
            first, second = list(found.values())[:2]
            raise RecordError(
                f"{first.whose}, lines {first.line} and {second.line}, column answer, hold for this file both, and say "
                f"{first.text!r} and {second.text!r}; remove one of them.",
                answer=(first.text, second.text),
            )
        return next(iter(found.values()), None)

    def text_of(self, signature: Signature | None) -> str:
        """Return the answer for tables of a signature as it is written, "" where there is none.

        It is part of the content of each file that it reads: where it is edited, the file is read again.
        """
        return "; ".join(answer.text for answer in self._matching(signature))

    def own(self, signature: Signature | None) -> tuple[int, float]:
        """Return the line of layouts.csv that alone answers for tables of a signature, 0 where there is none.

        And the peak that such a table has by it, m/s²; 0 where the unit of its numbers follows from something else.
        """
        own = [answer for answer in self._matching(signature) if answer.whose == NAME]
        if signature is None or len(own) != 1:
            return 0, 0.0
        units: list[str | None] = []
        with suppress(RecordError):  # of an answer that is none, which its files say
            units = [column.unit for column in own[0].layout.columns if column.role == "acceleration"]
        return own[0].line, signature.peak * acceleration_factor(units[0]) if units and units[0] else 0.0

    def insists(self, line: int, why: str) -> bool:
        """Whether a person left an answer although its row says why it cannot hold: then it counts."""
        return any(at == line and why in (row.get("tried") or "") for at, row in self.rows)

    def idle(self, signatures: Iterable[Signature]) -> list[LayoutAnswer]:
        """Return the answers in layouts.csv that hold for no table of these signatures."""
        used = {answer.line for signature in signatures for answer in self._matching(signature)}
        return [answer for _, answer in self._answers if answer.line not in used]

    def text(
        self, questions: Iterable[tuple[str, Question]], tried: Mapping[int, "Trial"] = MappingProxyType({})
    ) -> str | None:
        """Return the text of layouts.csv with a row for each question that it does not hold yet; None if none is new.

        questions: with the file that each is drawn from. tried: what came of each answer on its files, by its line; one
        that cannot hold is open again.
        """
        present = [Signature.of_row(row) for _, row in self.rows]
        new = [
            {
                "answer": family.question.proposal,
                "holds": family.question.holds,
                "file": family.files[0],
                **dict(zip(_OF_SIGNATURE, family.question.signature.cells, strict=True)),
            }
            for family in families(
                (file, question)
                for file, question in questions
                if all(row.distance(question.signature) is None for row in present)
            )
        ]
        old = [dict(row) for _, row in self.rows]
        for (line, _), row in zip(self.rows, old, strict=True):
            if line in tried:
                row["answer"] = row["answer"] if tried[line].may_hold else f"{OPEN} {row['answer']}"
                row["tried"] = tried[line].words
        if not new and old == [dict(row) for _, row in self.rows]:
            return None
        return edited_text([*old, *new], COLUMNS, self._path)


@dataclass(frozen=True)
class Trial:
    """What came of an answer on all files that it is for, in words, and whether it may hold."""

    words: str
    may_hold: bool


def _answers(
    rows: Iterable[tuple[int, Mapping[str, str]]], whose: str
) -> list[tuple[Signature, LayoutAnswer]]:
    """Return the answers in rows, without what is still open."""
    return [
        (
            Signature.of_row(row),
            LayoutAnswer(text=row["answer"].strip(), whose=whose, line=line, file=row.get("file") or ""),
        )
        for line, row in rows
        if row["answer"].strip() and OPEN not in row["answer"]
    ]


@cache
def _shipped() -> list[tuple[Signature, LayoutAnswer]]:
    return _answers(read_edited(_SHIPPED, CatalogueError, COLUMNS, COLUMNS[:1]), "the layouts of rocking")
