"""What a row is: a frozen dataclass whose fields carry type, unit, meaning and equation; and the text of each cell."""

import math
import re
from collections.abc import Callable, Mapping
from dataclasses import MISSING, dataclass, replace
from enum import Enum, StrEnum
from typing import Any, ClassVar, Self, TypeVar, dataclass_transform

from rocking.described import Described, described, described_values

_UNITS = {
    "rad_s": "rad/s", "m_s2": "m/s²", "m2_s3": "m²/s³", "m_s": "m/s", "rad": "rad", "hz": "Hz", "deg": "°", "s": "s",
    "m": "m",
}  # fmt: skip
"""Unit by the end of a column's name; the first that fits counts."""


@dataclass(frozen=True)
class Table:
    """A CSV table: its file name without folder, what a row is, and its columns in order."""

    name: str
    description: str
    columns: tuple[Described, ...]

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

    @classmethod
    def of(cls, *sources: object, **values: Any) -> Self:
        """Return a row of `values`; each other column is the attribute of its name of the first source that has one.

        The unit may be missing there: `peak_time_s` is the `peak_time` of a response. a_b is b of a where a source has
        no a_b itself: `elsewhere_crack` is `ensemble.elsewhere.crack`. A source is any object, or a mapping. What is
        None, or what no source has, leaves its cell empty.
        """
        for each in cls.table.columns:
            if each.name not in values:
                offers = (_offer(source, name) for source in sources for name in (each.name, each.attribute))
                values[each.name] = next((offer for offer in offers if offer is not MISSING), None)
            if values[each.name] is None:
                values[each.name] = empty(each)
        return cls(**values)


def empty(column: Described) -> Any:
    """Return what stands for no value."""
    return None if column.optional else {float: math.nan, str: "", tuple: ()}.get(column.holds)


def _offer(source: object, name: str) -> Any:
    """The value of `source` for `name`, b of its a for the name a_b; a method is none."""
    value = source.get(name, MISSING) if isinstance(source, Mapping) else getattr(source, name, MISSING)
    if value is not MISSING:
        return MISSING if callable(value) else value
    parts = name.split("_")
    for place in range(len(parts) - 1, 0, -1):
        inner = getattr(source, "_".join(parts[:place]), MISSING)
        if inner is None:
            return None
        if inner is not MISSING and (value := _offer(inner, "_".join(parts[place:]))) is not MISSING:
            return value
    return MISSING


R = TypeVar("R", bound=Row)


def column(
    meaning: str, *, equation: str = "", unit: str = "", last: bool = False, default: Any = MISSING
) -> Any:
    """Declare a field of a row. unit: where the name cannot say it. last: after the columns of the subclasses."""
    return described(default, meaning, unit, equation=equation, last=last)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(column,))
def row(name: str = "", description: str = "") -> Callable[[type[R]], type[R]]:
    """Make the decorated class a row of the table `name`; without a name, the common part of several rows.

    description: of the table, by default the first line of the docstring of the class.
    """

    def made(cls: type[R]) -> type[R]:
        row_class: Any = dataclass(frozen=True, slots=True, kw_only=True)(cls)
        columns = []
        for each in sorted(described_values(row_class).values(), key=lambda each: each.more["last"]):
            ends = (unit for end, unit in _UNITS.items() if each.name.endswith(f"_{end}"))
            columns.append(replace(each, unit=each.unit or next(ends, "")))
        summary = description or (cls.__doc__ or "").partition("\n")[0].rstrip(".")
        row_class.table = Table(name, summary, tuple(columns))
        return row_class

    return made


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
    return _CONTROL.sub(lambda mark: "\\\\" if mark[0] == "\\" else f"\\u{ord(mark[0]):04x}", text)


def unguarded(text: str) -> str:
    if "\\" in text:
        text = _ESCAPED.sub(lambda mark: mark[1] or chr(int(mark[2], 16)), text)
    return text[1:] if text[:1] == "'" and _FORMULA.match(text) else text


def value_of(each: Described, text: str) -> Any:
    """The value of a cell. Raises ValueError with the column and what is allowed."""
    holds = each.holds
    if text == "" and (each.optional or holds is float):
        return None if each.optional else math.nan
    if holds is str:
        return unguarded(text)
    if holds is tuple:
        return tuple(unguarded(text).split("; ")) if text else ()
    try:
        return {"true": True, "false": False}[text] if holds is bool else holds(text)
    except (ValueError, KeyError):
        allowed = {bool: "true or false", int: "a whole number"}.get(holds, "a number")
        if issubclass(holds, StrEnum):
            allowed = ", ".join(holds)
        raise ValueError(f"column {each.name}: {text!r} must be {allowed}") from None
