"""Remarks: what there is to say of a file, a record, a structure or a case.

A remark is made where the fact is known: its kind, what it is about, and its values. Code compares kinds and reads
values; the words are made where a person reads them, from the one catalogue of sentences that the kinds hold.
"""

from dataclasses import dataclass
from enum import StrEnum
from string import Formatter

Value = str | int | float


class Kind(StrEnum):
    """Every kind of remark: its code, which tables and results hold, and its sentence.

    A sentence names its values in braces, with their format; {about} is what the remark is about.
    """

    sentence: str

    def __new__(cls, code: str, sentence: str) -> "Kind":
        """Make a kind of its code, with the sentence beside it."""
        kind = str.__new__(cls, code)
        kind._value_ = code
        kind.sentence = sentence
        return kind

    # What one degree of freedom does not follow.
    CONTACTS_OPEN = "contacts_open", "contacts open"
    COURSES_THROWN = "courses_thrown", "courses above a rocking body may be thrown"


@dataclass(frozen=True)
class Remark:
    """One thing to say: its kind, what it is about, and its values by name, in SI units unless their names say else.

    Raises ValueError where the values are not those that the sentence of the kind names.

    >>> from rocking.remarks import Kind, Remark
    >>> str(Remark.of(Kind.CONTACTS_OPEN))
    'contacts open'
    """

    kind: Kind
    about: str = ""
    values: tuple[tuple[str, Value], ...] = ()

    def __post_init__(self) -> None:
        named = {name for _, name, _, _ in Formatter().parse(self.kind.sentence) if name} - {"about"}
        given = {name for name, _ in self.values}
        if named != given:
            raise ValueError(
                f"remark {self.kind.value}: values {sorted(given)}, but must be {sorted(named)}."
            )

    @classmethod
    def of(cls, kind: Kind, about: str = "", **values: Value) -> "Remark":
        """Return the remark of `kind` about a file, a record or a structure, with its values by name."""
        return cls(kind, about, tuple(sorted(values.items())))

    def __getitem__(self, name: str) -> Value:
        """Return one of the values. Raises KeyError for a name that the sentence does not have."""
        return dict(self.values)[name]

    def __str__(self) -> str:
        """The remark in words."""
        return self.kind.sentence.format(about=self.about, **dict(self.values))
