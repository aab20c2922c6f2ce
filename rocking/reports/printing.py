"""How the text of a CSV cell is printed: rounded, with a real minus, never changed otherwise."""

import math
import re
from collections.abc import Iterable, Mapping, Sequence

Row = Mapping[str, str]
Cell = str | dict[str, object]

NOTHING = "–"
"""Printed where a cell is empty."""
_WORDS = [
    "no",
    "one",
    "two",
    "three",
    "four",
    "five",
    "six",
    "seven",
    "eight",
    "nine",
    "ten",
    "eleven",
    "twelve",
]
_LENGTHS = ["diagonal", "height", "thickness", "radius", "breadth", "width", "diameter", "depth", "length"]
_UNITS = dict.fromkeys(_LENGTHS, " m") | dict.fromkeys(("slenderness", "angle"), " rad")
_LARGEST_PLAIN = 1e6
"""Numbers up to here are printed without a power of ten."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
LIGHT_SYMBOLS = {"green": "● green", "amber": "▲ amber", "red": "■ red"}


def number(text: str, digits: int = 3) -> str:
    """Return the number in `text` to `digits` significant digits; ∞ for INF, a dash for nothing."""
    if text.strip() in ("", "nan"):
        return NOTHING
    value = float(text)
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if 10**digits <= abs(value) < _LARGEST_PLAIN:
        return _typeset(f"{value:.0f}")
    return _typeset(f"{value:#.{digits}g}".rstrip("."))


def whole(text: str) -> str:
    """Return a whole number as it stands in the CSV, or a dash."""
    return text.strip().replace("-", "−") or NOTHING


def given(text: str) -> str:
    """Return a number that somebody chose (a factor, a tolerance) without trailing zeros."""
    return NOTHING if text.strip() == "" else _typeset(f"{float(text):.6g}")


def words(text: str) -> str:
    """Return the text as it stands, or a dash."""
    return text.strip() or NOTHING


def lamp(light: str) -> str:
    """Return the light as symbol and word, so that it is read without colour."""
    return LIGHT_SYMBOLS.get(light, words(light))


def ratio(text: str, digits: int = 3) -> str:
    """Return a rotation ratio: a number, "overturns" for INF, "no uplift" for zero, a dash for nothing."""
    if text.strip() in ("", "nan"):
        return NOTHING
    value = float(text)
    if math.isinf(value):
        return "overturns"
    return "no uplift" if value == 0 else number(text, digits)


def geometry(text: str) -> str:
    """Return the sizes in the description of a structure with their units; what is left at its default is left out."""
    sizes = [
        f"{name.replace('_', ' ')} {_size(value)}{_UNITS.get(name.split('_')[-1], '')}"
        for name, value in re.findall(r"(\w+)=([^,()]+)", text)
        if value not in ("None", "False") and name != "restitution"
    ]
    return ", ".join(sizes) or words(text)


def _size(text: str) -> str:
    try:
        return f"{float(text):.4g}"
    except ValueError:
        return text


def count(many: int) -> str:
    """Return a count, in words up to twelve."""
    return _WORDS[many] if many < len(_WORDS) else str(many)


def counted(many: int, noun: str) -> str:
    """Return a count with its noun in the right number."""
    return f"{count(many)} {noun}{'' if many == 1 else 's'}"


def listed(names: Sequence[str], most: int = 6) -> str:
    """Return the names in a row, those beyond `most` as a count."""
    shown = ", ".join(names[:most])
    more = len(names) - most
    return shown if more <= 0 else f"{shown} and {counted(more, 'other')}"


def sentence(text: str) -> str:
    """Return the text with a capital first letter."""
    return text[:1].upper() + text[1:]


def of_component(rows: Iterable[Row], component: str) -> list[Row]:
    """Return the rows of one component, in order."""
    return [row for row in rows if row["component"] == component]


def distinct(rows: Iterable[Row], column: str) -> list[str]:
    """Return the different values of a column in the order of their first row."""
    return list(dict.fromkeys(row[column] for row in rows))


def table(columns: Sequence[tuple[str, str, str]], rows: Iterable[Sequence[Cell]]) -> dict[str, object]:
    """Return a table as the templates set it; a column is (heading, width, alignment)."""
    heads, widths, alignments = zip(*columns, strict=True)
    return {"heads": heads, "widths": widths, "alignments": alignments, "rows": [list(row) for row in rows]}


def strong(text: str) -> dict[str, object]:
    """Return a table cell whose text is set in bold."""
    return {"text": text, "strong": True}


def _typeset(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    mantissa = mantissa.replace("-", "−")
    if not exponent:
        return mantissa
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}"
