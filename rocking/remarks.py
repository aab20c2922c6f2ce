"""Remarks: what there is to say of a file, a record, a structure or a case.

A remark is made where the fact is known: its kind, what it is about, and its values. Code compares kinds and reads
values; the words are made where a person reads them, from the one catalogue of sentences that the kinds hold. A new
remark is one line of that catalogue.
"""

from dataclasses import dataclass
from enum import StrEnum, auto
from string import Formatter

Value = str | int | float


class Kind(StrEnum):
    """Every kind of remark: its code, which tables and results hold, and its sentence.

    A sentence names its values in braces, with their format; {about} is what the remark is about. The code is the name
    in small letters.
    """

    sentence: str
    value_names: tuple[str, ...]
    """The values that the sentence names, in order of the alphabet."""

    def __new__(cls, code: str, sentence: str) -> "Kind":
        """Make a kind of its code, with the sentence beside it."""
        kind = str.__new__(cls, code)
        kind._value_ = code
        kind.sentence = sentence
        named = {name for _, name, _, _ in Formatter().parse(sentence) if name}
        kind.value_names = tuple(sorted(named - {"about"}))
        return kind

    # What one degree of freedom does not follow.
    CONTACTS_OPEN = auto(), "contacts open"
    COURSES_THROWN = auto(), "courses above a rocking body may be thrown"

    # What else makes a decision doubtful.
    COMPONENT_MISSING = auto(), "a component gave no result"
    OTHER_CRACK_WORSE = auto(), "another crack than the one given is worse"
    MEMBERS_FAILED = auto(), "members could not be followed"
    HELD_BEYOND = auto(), "a held wall turns so far that its mechanism may say too little"

    # What would tell more of a decision.
    TIE_STRENGTH = auto(), "the strength of the ties"
    FRICTION = auto(), "the friction of the joint"
    INPUT = auto(), "a record or settings that can be followed"
    ENSEMBLE = auto(), "an ensemble of members"
    TOLERANCE = auto(), "a restitution below 1, or another tolerance"
    CRACK = auto(), "where it cracks"
    RESTITUTION = auto(), "the restitution"
    PROCESSING = auto(), "a processed record of the network"
    CONTACT_DYNAMICS = auto(), "contact dynamics"
    COMPONENT = auto(), "the component that gave no result"


@dataclass(frozen=True)
class Remark:
    """One thing to say: its kind, what it is about, and its values by name, in SI units unless their names say else.

    values: in the order of `Kind.value_names`. Raises ValueError for an unknown kind, and where the values are not
    those that its sentence names.

    >>> from rocking.remarks import Kind
    >>> str(rocking.Remark(Kind.CONTACTS_OPEN))
    'contacts open'
    """

    kind: Kind
    about: str = ""
    values: tuple[tuple[str, Value], ...] = ()

    def __post_init__(self) -> None:
        if not isinstance(self.kind, Kind):
            raise ValueError(f"remark {self.kind!r} is of no kind of the catalogue.")
        given = [name for name, _ in self.values]
        if given != list(self.kind.value_names):
            raise ValueError(
                f"remark {self.kind}: values {given}, but must be {list(self.kind.value_names)}."
            )
        for name, value in self.values:
            if not isinstance(value, Value):
                raise ValueError(f"remark {self.kind}: {name} is {value!r}, but must be a text or a number.")

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
