"""Layouts: what the numbers of tables are, as a person answers it ("t, NS, EW g"), asked once in layouts.csv."""

import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, replace
from functools import cache, cached_property
from pathlib import Path
from typing import Literal, get_args

from rocking.errors import CatalogueError, RecordError, UndeclaredError
from rocking.quantities import acceleration_unit, counted
from rocking.records.formats.text import is_number
from rocking.tables import edited_text, read_edited

NAME = "layouts.csv"
COLUMNS = ("answer", "holds", "file", "names", "numbers_a_line", "text_above", "folder")
_SHIPPED = Path(__file__).with_name(NAME)


Role = Literal["time", "acceleration", "other", "open"]
Above = Literal["n", "dt", "hz", "-"]
"""A number above a series: the number of samples, the time step, the rate, or what does not matter."""

_EXAMPLES = "'t, a g', 'NS, EW, UD g' or 'one series g, 5 a line, skip 2'"
_TIMES = {"s": 1.0, "ms": 1e-3, "min": 60.0}
_NAME = re.compile(r"[^\W_][\w+/-]*|[+-]?\w+")
_PLAIN = {"a", "acc", "acceleration"}
_FORTRAN = re.compile(r"(?i)(\d+)[FEGI](\d+)(?:\.\d+)?")
OPEN = "?"
"""Stands in an answer for what is still to be answered."""


@dataclass(frozen=True)
class Column:
    """What the numbers of one column are.

    name: of a component, "" where the file's own holds. unit: of acceleration, None where the file says it. seconds:
    the unit of times, s.
    """

    role: Role
    name: str = ""
    unit: str | None = None
    seconds: float = 1.0

    def __str__(self) -> str:
        if self.role in ("other", "open"):
            return "-" if self.role == "other" else OPEN
        unit = next((f" {name}" for name, each in _TIMES.items() if each == self.seconds != 1.0), "")
        if self.role == "time":
            return f"t{unit}"
        return f"{self.name or 'a'} {self.unit or OPEN}"


@dataclass(frozen=True)
class TableLayout:
    """How the numbers of a table are to be read.

    columns: in their order; of a series the one that it is. is_series: whether it runs along the rows. per_line:
    numbers on a line, 0 where nobody says it; more than there are columns: so many rows stand on a line. width:
    characters of each, 0 where blanks part them. skip: lines that are passed over. above: numbers before the first of a
    series. time_step: s, where no column holds times.
    """

    columns: tuple[Column, ...]
    is_series: bool = False
    per_line: int = 0
    width: int = 0
    skip: int = 0
    above: tuple[Above, ...] = ()
    time_step: float | None = None

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
        if not any(column.role == "acceleration" for column in layout.columns):
            raise RecordError(f"no column of {answer!r} is of acceleration; answer like {_EXAMPLES}.")
        if unit := [each for each in layout.columns if each.role == "acceleration"][-1].unit:
            is_bare = [each.role == "acceleration" and not each.unit for each in layout.columns]
            named = (
                replace(each, unit=unit) if bare else each
                for each, bare in zip(layout.columns, is_bare, strict=True)
            )
            layout = replace(layout, columns=tuple(named))
        return layout

    def proposal(self, has_step: bool) -> str:
        """Return it as an answer that a person completes; has_step: whether something else says the time step.

        Where nothing in it is open, it begins with the sign for what is: to take that away is the answer.
        """
        is_timed = any(column.role == "time" for column in self.columns) or {"dt", "hz"} & set(self.above)
        has_step = has_step or bool(self.time_step) or bool(is_timed)
        answer = str(replace(self, time_step=None)) + ("" if has_step else f", dt {OPEN}")
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
        raise RecordError(f"{item!r} stands in no answer of one series; answer like {_EXAMPLES}.")
    if item == "-":
        return replace(layout, columns=(*layout.columns, Column("other")))
    if word == "t":
        if (rest or "s") not in _TIMES:
            raise RecordError(f"the times are in {rest!r}, but must be in s, ms or min.")
        return replace(layout, columns=(*layout.columns, Column("time", seconds=_TIMES[rest or "s"])))
    name, _, unit = item.partition(" ")
    return replace(layout, columns=(*layout.columns, _acceleration(name, unit)))


def _acceleration(name: str, unit: str) -> Column:
    if not _NAME.fullmatch(name):
        raise RecordError(f"{name!r} names no component; answer like {_EXAMPLES}.")
    known = acceleration_unit(unit)
    if unit.strip() and known is None:
        raise RecordError(f"{unit.strip()!r} is no unit of acceleration; answer like {_EXAMPLES}.")
    return Column("acceleration", "" if name.lower() in _PLAIN else name, known)


@dataclass(frozen=True)
class Signature:
    """What tables have in common that one answer holds for.

    names: of the columns. numbers_a_line: their number. text_above: the words above them that mean something. folder:
    of the files, beside the catalogue, where neither names nor words say anything; "" else, or for the folder itself.
    """

    names: str
    numbers_a_line: str
    text_above: str
    folder: str = ""

    @classmethod
    def of_row(cls, row: Mapping[str, str]) -> "Signature":
        """Return the signature that a row of layouts.csv is for."""
        return cls(*(" ".join((row.get(name) or "").split()) for name in COLUMNS[3:]))


@dataclass(frozen=True)
class Question:
    """What has to be answered of a table: its signature, what its columns hold as far as it can be seen, a proposal."""

    signature: Signature
    holds: str
    proposal: str


class AskedError(UndeclaredError):
    """A table that leaves its unit, its step or its columns open; `question`: what layouts.csv asks of it."""

    def __init__(self, message: str, field: str, question: Question) -> None:
        super().__init__(message, field)
        self.question = question


@dataclass(frozen=True)
class Answer:
    """One answer: its text, who gave it, the line it stands on and the file that it was drawn from."""

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
        return RecordError(f"{self.whose}, line {self.line}, column answer, {self.text!r}{drawn}: {why}")


class Layouts:
    """The answers that hold in a folder: those of its layouts.csv, and below them those that this package knows.

    folder: that of the catalogue, None for no file. place: where beside it the files lie that are asked about.
    """

    def __init__(self, folder: Path | None = None, place: str = "") -> None:
        self.place = "" if place == "." else place
        self._path = None if folder is None else folder / NAME

    def at(self, place: str) -> "Layouts":
        """Return the same answers for files of another folder beside the catalogue."""
        other = copy(self)  # with the rows that are read already
        other.place = "" if place == "." else place
        return other

    @cached_property
    def rows(self) -> Sequence[tuple[int, Mapping[str, str]]]:
        """The rows of layouts.csv, none where there is none. Raises CatalogueError for what is no such table."""
        if self._path is None or not self._path.is_file():
            return ()
        return read_edited(self._path, CatalogueError, COLUMNS, COLUMNS[:1])

    def check(self) -> None:
        """Raise CatalogueError where layouts.csv is no table of answers; one wrong answer costs its own files alone."""
        _ = self.rows

    @cached_property
    def _answers(self) -> Mapping[Signature, Answer]:
        return {**_shipped(), **_answers(self.rows, NAME)}

    def answer(self, signature: Signature) -> Answer | None:
        """Return the answer for tables of a signature, None where there is none yet."""
        return self._answers.get(signature)

    @property
    def are_answered(self) -> bool:
        """Whether layouts.csv answers anything."""
        return bool(_answers(self.rows, NAME))

    def text_of(self, signature: Signature | None) -> str:
        """Return the answer for tables of a signature as it is written, "" where there is none.

        It is part of the content of each file that it reads: where it is edited, the file is read again.
        """
        answer = self.answer(signature) if signature else None
        return answer.text if answer else ""

    def text(self, questions: Iterable[tuple[str, Question]]) -> str | None:
        """Return the text of layouts.csv with a row for each question that it does not hold yet; None if none is new.

        questions: with the file that each is drawn from.
        """
        held = {Signature.of_row(row) for _, row in self.rows}
        files: Counter[Signature] = Counter()
        first: dict[Signature, tuple[str, Question]] = {}
        for file, question in questions:
            if question.signature not in held:
                files[question.signature] += 1
                first.setdefault(question.signature, (file, question))
        if not first:
            return None
        new = [
            {
                "answer": question.proposal,
                "holds": f"{question.holds}; {counted(files[signature], 'file')}",
                "file": file,
                **dict(zip(COLUMNS[3:], vars(signature).values(), strict=True)),
            }
            for signature, (file, question) in first.items()
        ]
        return edited_text([*(row for _, row in self.rows), *new], COLUMNS, self._path)


def _answers(rows: Iterable[tuple[int, Mapping[str, str]]], whose: str) -> dict[Signature, Answer]:
    """Return the answers in rows, without what is still open."""
    return {
        Signature.of_row(row): Answer(row["answer"].strip(), whose, line, row.get("file") or "")
        for line, row in rows
        if row["answer"].strip() and OPEN not in row["answer"]
    }


@cache
def _shipped() -> Mapping[Signature, Answer]:
    return _answers(read_edited(_SHIPPED, CatalogueError, COLUMNS, COLUMNS[:1]), "the layouts of rocking")
