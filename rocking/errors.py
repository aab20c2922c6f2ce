"""The error classes: one root, so that a caller can catch everything this package says.

A message is one sentence: what (file, field), the value, what is allowed, what to do.
"""

import traceback
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from enum import auto
from pathlib import Path
from typing import Self

from rocking.warnings import Kind, RockingWarning


class ErrorKind(Kind):
    """What there is to say of a fault in the package itself, in every language."""

    FAULT = (
        auto(),
        """a fault of rocking in what it computes or draws of {about} ({said}); please report it,
        with {log}.""",
    )


LOGS: list[Path] = []
"""The log that this process writes, if any: what holds the traceback of a fault."""


class RockingError(Exception):
    """Root of every error this package raises on purpose.

    places: the record and the file that it is about, the outer one first, where those who raised it did not know them.
    warning: the sentence as a warning, which has it in every language; None of one that no page to sign repeats.
    field, value: the parameter, key or column that was refused, and what it was; "" and None where it is not about one.

    >>> try:
    ...     rocking.Block.of_size(breadth=-1, height=3)
    ... except rocking.RockingError as error:
    ...     print(error)
    breadth is -1 m, but must be a number from 0.0001 to 100000.
    """

    places: tuple[str, ...] = ()
    warning: RockingWarning | None = None
    field: str = ""
    value: object = None

    def __init__(self, sentence: str = "", /, **refused: object) -> None:
        """Make the error of a sentence; refused: the field that it refuses, and its value, where it refuses one."""
        super().__init__(sentence)
        if refused:
            ((self.field, self.value),) = refused.items()

    @classmethod
    def saying(cls, warning: RockingWarning) -> Self:
        """Return the error whose sentence is a warning."""
        error = cls(str(warning))
        error.warning = warning
        return error

    def __str__(self) -> str:
        return self.without_place("")

    def without_place(self, place: str) -> str:
        """Return the sentence for where `place`, one of the places, already stands beside it."""
        return ": ".join((*(own for own in self.places if own != place), super().__str__()))


class FaultError(RockingError):
    """A fault of this package, which no input may cause."""


class RecordError(RockingError):
    """A file or array that cannot stand as an accelerogram."""


class UnknownFormatError(RecordError):
    """No reader recognises the file.

    Parameters
    ----------
    message : str
        What to say.
    details : tuple of str, optional
        What each reader looked for, one sentence each.
    """

    def __init__(self, message: str, /, details: tuple[str, ...] = (), **refused: object) -> None:
        super().__init__(message, **refused)
        self.details = details


class UndeclaredError(RecordError):
    """A unit or a time step that neither the file nor the caller declares; `field` is which of the two."""


class PulseError(RockingError):
    """A pulse that cannot exist, or a record that cannot be searched for one."""


class StructureError(RockingError):
    """A geometry that cannot stand, or a structure that cannot be described as asked."""


class SizeError(StructureError):
    """A size that is not allowed: its field, its value as a sentence repeats it, and what the sentence says of it."""

    def __init__(self, sentence: str, name: str = "", value: str = "", said: str = "") -> None:
        super().__init__(sentence)
        self.field = name
        self.value = value
        self.shown = value
        self.said = said

    @classmethod
    def of(cls, name: str, value: str, said: str) -> "SizeError":
        """Return the error "height is -1 m, but must be …"; said: from the unit on."""
        return cls(f"{name} is {value}{said}", name, value, said)


class DoesNotStandError(StructureError):
    """A structure that what acts on it at rest turns over."""


class MotionError(RockingError):
    """A setting of the integration, or a forcing, outside what is allowed."""


class CatalogueError(RockingError):
    """A catalogue of records with defects; all of them stand in one message."""


class ConfigurationError(RockingError):
    """A setting or a structure list with defects; all of them stand in one message."""


class StructureWarning(UserWarning):
    """A structure that can be computed, but with a value that is not physical; the message says which."""


@contextmanager
def about(what: str) -> Iterator[None]:
    """Add `what`, the name of a file or of a record, to the places of an error that is raised within."""
    try:
        yield
    except RockingError as error:
        error.places = (what, *error.places)
        raise


@contextmanager
def one_structure(name: str) -> Iterator[None]:
    """Guard what is computed or drawn for one structure: a fault within costs no other structure.

    Whatever no input may cause is written to the log of this process and raised as a FaultError that names the
    structure, which is handled as any RockingError is. What is wrong with the input or the machine passes.
    """
    try:
        yield
    except (RockingError, OSError, MemoryError):
        raise
    except Exception as fault:
        for log in LOGS:
            log_fault(fault, log)
        said = " ".join(f"{type(fault).__name__}: {fault}".split())
        where = str(LOGS[0]) if LOGS else "its traceback"
        warning = RockingWarning.of(ErrorKind.FAULT, name, said=said, log=where)
        raise FaultError.saying(warning) from fault


def fault_in_words(fault: Exception, log: Path | str, where: str = "this file") -> str:
    """Return the sentence on an error that no input may cause, of what it costs; log: what holds its traceback."""
    said = " ".join(f"{type(fault).__name__}: {fault}".split())
    return f"a fault of rocking in {where} ({said}); please report it, with {log}."


def log_fault(fault: BaseException, log: Path) -> None:
    """Add the traceback of an error to a log, where that can be written."""
    with suppress(OSError), log.open("a", encoding="utf-8") as stream:
        traceback.print_exception(fault, file=stream)
