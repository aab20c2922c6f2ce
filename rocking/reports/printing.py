"""How a value of a row is printed: rounded, with a real minus, never changed otherwise."""

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from itertools import accumulate
from typing import TypeVar

Cell = str | dict[str, object]
"""A text; or a text that is strong, with another below it (layout.typ)."""
T = TypeVar("T")

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
_LARGEST_PLAIN = 1e6
"""Numbers up to here are printed without a power of ten."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value: float | None, digits: int = 3) -> str:
    """Return `value` to `digits` significant digits; ∞ for inf, a dash for nan or None."""
    if value is None or math.isnan(value):
        return NOTHING
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    if 10**digits <= abs(value) < _LARGEST_PLAIN:
        return _typeset(f"{value:.0f}")
    return _typeset(f"{value:#.{digits}g}".rstrip("."))


def to_spread(value: float, spread: float) -> str:
    """Return `value` to a tenth of the `spread` of what it was drawn from: one to three significant digits."""
    if value == 0 or not math.isfinite(value) or not 0 < spread < math.inf:
        return number(value, 2)
    leading, last = math.floor(math.log10(abs(value))), math.floor(math.log10(spread)) - 1
    return number(value, min(max(leading - last + 1, 1), 3))


def whole(value: int | None) -> str:
    """Return a whole number, or a dash."""
    return NOTHING if value is None else str(value).replace("-", "−")


def given(value: float | None) -> str:
    """Return a number that somebody chose (a factor, a tolerance) without trailing zeros."""
    return NOTHING if value is None or math.isnan(value) else _typeset(f"{value:.6g}")


def percent(share: float) -> str:
    """Return a share in percent: one digit below 10, whole from there on, 0 where it is rounding."""
    value = 100 * share
    return _typeset(f"{value:.0f}" if abs(value) >= 10 or abs(value) < 1e-6 else f"{value:.1g}")


def with_unit(text: str, unit: str) -> str:
    """Return a printed number with its unit; a dash stays a dash."""
    return text if text == NOTHING else f"{text} {unit}"


def words(text: str | Sequence[str] | None) -> str:
    """Return the text, or several in a row, as it stands; a dash for none."""
    whole_text = text if isinstance(text, str) else "; ".join(text or ())
    return whole_text.strip() or NOTHING


def ratio(value: float | None, digits: int = 3) -> str:
    """Return a rotation ratio: a number, "overturns" for inf, "no uplift" for zero, a dash for nan or None."""
    if value is not None and math.isinf(value):
        return "overturns"
    return "no uplift" if value == 0 else number(value, digits)


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


MOST_NAMED, MOST_LETTERS = 12, 300
"""Structures that the first lines name with one verdict, and their letters; the table below them holds all."""


def headlines(groups: Mapping[str, Sequence[str]]) -> list[dict[str, str]]:
    """Return the first lines of a report: each verdict with its structures, as many as there is room for."""
    return [
        {"verdict": sentence(verdict), "names": _fitting(names)} for verdict, names in groups.items() if names
    ]


def _fitting(names: Sequence[str]) -> str:
    room = sum(end <= MOST_LETTERS for end in accumulate(map(len, names)))
    return listed(names, max(1, min(MOST_NAMED, room)))


def of(part: float, whole: float) -> str:
    """Return "n of m" on one line, NOTHING where there are none."""
    return f"{int(part)}\u00a0of\u00a0{int(whole)}" if whole > 0 else NOTHING


def short(name: str, most: int = 44) -> str:
    """Return a name that stands in full in a table before, cut to `most` characters."""
    return name if len(name) <= most else f"{name[: most - 1].rstrip()}…"


def sentence(text: str) -> str:
    """Return the text with a capital first letter."""
    return text[:1].upper() + text[1:]


def table(columns: Sequence[tuple[str, str, str]], rows: Iterable[Sequence[Cell]]) -> dict[str, object]:
    """Return a table as the templates set it; a column is (heading, width, alignment)."""
    heads, widths, alignments = zip(*columns, strict=True)
    return {"heads": heads, "widths": widths, "alignments": alignments, "rows": [list(row) for row in rows]}


def table_of(rows: Iterable[T], *columns: tuple[str, str, str, Callable[[T], Cell]]) -> dict[str, object]:
    """Return a table with a line for each row; a column is (heading, width, alignment, what it shows of a row)."""
    return table([column[:3] for column in columns], [[show(row) for *_, show in columns] for row in rows])


def strong(text: str, really: bool = True, **more: object) -> Cell:
    """Return a table cell whose text is set in bold, or plain where it is not `really` meant to be."""
    return {"text": text, "strong": True, **more} if really else text


def _typeset(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    mantissa = mantissa.replace("-", "−")
    if not exponent:
        return mantissa
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}"
