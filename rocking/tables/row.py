"""What a row is: a frozen dataclass whose fields carry type, unit, meaning and equation; and the text of each cell."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, field, fields
from enum import Enum, StrEnum
from types import NoneType
from typing import Any, ClassVar, TypeVar, dataclass_transform, get_args, get_type_hints

_UNITS = {
    "rad_s": "rad/s",
    "m_s2": "m/s²",
    "m2_s3": "m²/s³",
    "m_s": "m/s",
    "rad": "rad",
    "hz": "Hz",
    "s": "s",
    "m": "m",
}
"""Unit by the end of a column's name; the first that fits counts."""
_TYPES = {float: "number", int: "integer", bool: "boolean"}
"""Frictionless types; every other is a string."""


@dataclass(frozen=True)
class Column:
    """One column: name (ending in its unit), Frictionless type, meaning, the equation it comes from, and its unit.

    holds: the type of a value. optional: whether it may be None.
    """

    name: str
    type: str
    description: str
    equation: str = ""
    unit: str = ""
    holds: Any = str
    optional: bool = False


@dataclass(frozen=True)
class Table:
    """A CSV table: its file name without folder, what a row is, and its columns in order."""

    name: str
    description: str
    columns: tuple[Column, ...]

    @property
    def file_name(self) -> str:
        """Name of the CSV file."""
        return f"{self.name}.csv"

    @property
    def column_names(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(column.name for column in self.columns)


class Row:
    """Root of every row class; `table` describes the file that holds its rows."""

    __slots__ = ()
    table: ClassVar[Table]


R = TypeVar("R", bound=Row)


def column(
    meaning: str, *, equation: str = "", unit: str = "", last: bool = False, default: Any = MISSING
) -> Any:
    """Declare a field of a row. unit: where the name cannot say it. last: after the columns of the subclasses."""
    known = {"meaning": meaning, "equation": equation, "unit": unit, "last": last}
    return field(default=default, metadata=known)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(column,))
def row(name: str = "", description: str = "") -> Callable[[type[R]], type[R]]:
    """Make the decorated class a row of the table `name`; without a name, the common part of several rows."""

    def made(cls: type[R]) -> type[R]:
        row_class: Any = dataclass(frozen=True, slots=True, kw_only=True)(cls)
        hints = get_type_hints(row_class)
        declared = sorted(fields(row_class), key=lambda each: each.metadata["last"])
        row_class.table = Table(
            name, description, tuple(_column(f.name, hints[f.name], f.metadata) for f in declared)
        )
        return row_class

    return made


def _column(name: str, hint: Any, known: Mapping[str, Any]) -> Column:
    parts = [part for part in get_args(hint) if part is not NoneType] or [hint]
    holds = tuple if hint == tuple[str, ...] else parts[0]
    unit = known["unit"] or next((unit for end, unit in _UNITS.items() if name.endswith(f"_{end}")), "")
    optional = NoneType in get_args(hint)
    return Column(
        name, _TYPES.get(holds, "string"), known["meaning"], known["equation"], unit, holds, optional
    )


_FORMULA = re.compile(r"'*[=+\-@\t\r]")
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\\]")
_ESCAPED = re.compile(r"\\(?:(\\)|u([0-9a-f]{4}))")


def cell(value: object) -> str:
    """Return the text that stands for `value` in a CSV file."""
    if isinstance(value, float):
        return "" if value != value else repr(float(value)).replace("inf", "INF")
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, str):
        return _guarded(value)
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple | list):
        return _guarded("; ".join(str(item) for item in value))
    return str(value)


def _guarded(text: str) -> str:
    if text.isalnum():
        return text
    text = "'" + text if _FORMULA.match(text) else text
    return _CONTROL.sub(lambda found: "\\\\" if found[0] == "\\" else f"\\u{ord(found[0]):04x}", text)


def unguarded(text: str) -> str:
    if "\\" in text:
        text = _ESCAPED.sub(lambda found: found[1] or chr(int(found[2], 16)), text)
    return text[1:] if text[:1] == "'" and _FORMULA.match(text) else text


def value_of(described: Column, text: str) -> Any:
    """The value of a cell. Raises ValueError with the column and what is allowed."""
    holds = described.holds
    if text == "" and (described.optional or holds is float):
        return None if described.optional else math.nan
    if holds is str:
        return unguarded(text)
    if holds is tuple:
        return tuple(unguarded(text).split("; ")) if text else ()
    try:
        return {"true": True, "false": False}[text] if holds is bool else holds(text)
    except (ValueError, KeyError):
        allowed = (
            ", ".join(holds)
            if issubclass(holds, StrEnum)
            else {bool: "true or false", int: "a whole number"}.get(holds, "a number")
        )
        raise ValueError(f"column {described.name}: {text!r} must be {allowed}") from None
