"""One cell: the text that stands for a value, and the value that a text stands for."""

import math
import re
from enum import Enum, StrEnum
from typing import Any

from rocking.tables.row import Column

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
