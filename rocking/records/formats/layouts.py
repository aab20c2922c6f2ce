"""Layouts: the answers to what the columns of tables hold, in layouts.csv beside the catalogue, asked once each."""

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache, cached_property
from pathlib import Path

from rocking.errors import CatalogueError, RecordError, UndeclaredError
from rocking.quantities import counted
from rocking.records.formats.layout import OPEN, Layout
from rocking.tables import edited_text, read_edited

NAME = "layouts.csv"
COLUMNS = ("answer", "holds", "file", "names", "numbers_a_line", "text_above", "folder")
_SHIPPED = Path(__file__).with_name(NAME)


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
    def layout(self) -> Layout:
        """The layout that it says. Raises RecordError naming line, column and file where it is none."""
        try:
            return Layout.parse(self.text)
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
        other = Layouts(None, place)
        other._path = self._path
        other.__dict__["rows"] = self.rows
        return other

    @cached_property
    def rows(self) -> Sequence[tuple[int, Mapping[str, str]]]:
        """The rows of layouts.csv, none where there is none. Raises CatalogueError for what is no such table."""
        if self._path is None or not self._path.is_file():
            return ()
        return read_edited(self._path, CatalogueError, COLUMNS, COLUMNS[:1])

    @cached_property
    def _answers(self) -> Mapping[Signature, Answer]:
        return {**_shipped(), **_answers(self.rows, NAME)}

    def answer(self, signature: Signature) -> Answer | None:
        """Return the answer for tables of a signature, None where there is none yet."""
        return self._answers.get(signature)

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
