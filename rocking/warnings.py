"""Warnings: what there is to say of a file, a record, a structure or a case.

A warning is made where the fact is known: its kind, what it is about, and its values. There its kind is declared, too,
with its sentence: `kinds.py` of each folder. Code compares kinds and reads values; the words are made where a person
reads them.
"""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from string import Formatter
from typing import TYPE_CHECKING, Any, Self

if TYPE_CHECKING:
    from pydantic_core import CoreSchema

Value = str | int | float


def values_named(text: str) -> set[str]:
    """Return the names of the values that a text holds in braces."""
    return {name for _, name, _, _ in Formatter().parse(text) if name}


class Kind(StrEnum):
    """A kind of warning: its code, which tables and results hold, and its sentence.

    Each folder declares its own kinds as members of a class of this one, a line each; a sentence that takes more lines
    is folded to one. The code is the name in small letters; no two kinds have the same.
    """

    sentence: str
    """The sentence in English, with its values in braces; {about} is what the warning is about."""
    brief: str
    """The sentence in as few words as a line of a table has room for; itself where it is short."""
    value_names: tuple[str, ...]
    """The values that the sentence names, in order of the alphabet."""
    names_subject: bool
    """Whether it also names what the warning is about."""

    def __new__(cls, code: str, sentence: str = "", short: str = "") -> "Kind":
        """Make a kind of its code, with what it says. Raises ValueError for one that says nothing."""
        if not sentence:
            raise ValueError(f"warning {code} has no sentence.")
        kind = str.__new__(cls, code)
        kind._value_ = code
        kind.sentence = re.sub(r"\s*\n\s*", " ", sentence)
        kind.brief = short or kind.sentence
        named = values_named(kind.sentence)
        kind.value_names = tuple(sorted(named - {"about"}))
        kind.names_subject = "about" in named
        return kind

    @classmethod
    def __get_pydantic_core_schema__(cls, *_: Any) -> "CoreSchema":
        """Let pydantic read a kind of whatever folder from its code, as the store of readings holds it."""
        from pydantic_core import core_schema  # of pydantic, which alone calls this

        return core_schema.no_info_plain_validator_function(kind_of)


def every_kind() -> dict[str, Kind]:
    """Return the kinds of all folders that are imported, by their codes."""
    return {kind.value: kind for folder in Kind.__subclasses__() for kind in folder}


def kind_of(code: str) -> Kind:
    """Return the kind of a code. Raises ValueError for one that no folder declares that is imported."""
    if code not in (kinds := every_kind()):
        raise ValueError(f"warning {code!r} is of no kind that is declared.")
    return kinds[code]


class Phrase(str):
    """English words with their values, which are also known by their parts, so that a page can say them in Italian.

    text: with its values in braces. values: texts, which may be phrases themselves, and numbers.
    """

    text: str
    values: Mapping[str, Value]

    def __new__(cls, text: str, /, **values: Value) -> Self:
        """Make the phrase of a text and the values that it names."""
        phrase = super().__new__(cls, text.format(**values))
        phrase.text = text
        phrase.values = values
        return phrase


@dataclass(frozen=True)
class RockingWarning:
    """One thing to say: its kind, what it is about, and its values by name, in SI units unless their names say else.

    Parameters
    ----------
    kind : Kind
        What is said.
    about : str, default ''
        The file, record or structure that it is about.
    values : tuple of tuple of (str, str, int or float), optional
        Values by name, in the order of `Kind.value_names`.

    Raises
    ------
    ValueError
        For an unknown kind, and where the values are not those that its sentence names.

    Examples
    --------
    >>> from rocking.assessment.kinds import AssessmentKind
    >>> str(rocking.RockingWarning(AssessmentKind.CONTACTS_OPEN))
    'contacts open'
    """

    kind: Kind
    about: str = ""
    values: tuple[tuple[str, Value], ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.kind, Kind):
            raise ValueError(f"warning {self.kind!r} is of no kind that is declared.")
        given = [name for name, _ in self.values]
        if given != list(self.kind.value_names):
            raise ValueError(
                f"warning {self.kind}: values {given}, but must be {list(self.kind.value_names)}."
            )
        for name, value in self.values:
            if not isinstance(value, Value):
                raise ValueError(f"warning {self.kind}: {name} is {value!r}, but must be a text or a number.")

    @classmethod
    def of(cls, kind: Kind, about: str = "", **values: Value) -> "RockingWarning":
        """Return the warning of `kind` about a file, a record or a structure, with its values by name."""
        return cls(kind, about, tuple(sorted(values.items())))

    def __getitem__(self, name: str) -> Value:
        """Return one of the values. Raises KeyError for a name that the sentence does not have."""
        return dict(self.values)[name]

    def __str__(self) -> str:
        """The warning in English; what it is about stands before a sentence that does not name it."""
        words = self.kind.sentence.format(about=self.about, **dict(self.values))
        return f"{self.about}: {words}" if self.about and not self.kind.names_subject else words

    @property
    def brief(self) -> str:
        """The warning in as few words as a line of a table has room for."""
        return self.kind.brief.format(about=self.about, **dict(self.values))
