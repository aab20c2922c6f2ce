"""How a value of a row is printed: rounded, with a real minus, never changed otherwise."""

import math
from collections.abc import Callable, Iterable, Sequence
from functools import partial
from typing import Any

from rocking.assessment.verdict import NEGLIGIBLE, rests
from rocking.described import Described
from rocking.quantities import counted
from rocking.tables import Row

Cell = str | dict[str, object]
"""A text; or a text that is strong, with another below it (layout.typ)."""
Column = tuple[str, str, str, Callable[[Any], Cell]]
"""Heading, width (fractions of what is left, or "auto"), alignment, and what it shows of a row."""

NOTHING = "–"
"""Printed where a cell is empty."""
_LARGEST_PLAIN = 1e6
"""Numbers up to here are printed without a power of ten."""
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
_CHOSEN = ("scale_factor", "time_step_s", "high_pass_frequency_hz")
"""Fields that somebody chose, which are printed as they were given."""


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


def given(value: float | None) -> str:
    """Return a number that somebody chose (a factor, a tolerance) or counted, without trailing zeros."""
    if value is None or math.isnan(value):
        return NOTHING
    return _typeset(str(value) if isinstance(value, int) else f"{value:.6g}")


def percent(share: float) -> str:
    """Return a share in percent: one digit below 10, whole from there on, 0 where it is rounding."""
    value = 100 * share
    return _typeset(f"{value:.0f}" if abs(value) >= 10 or abs(value) < 1e-6 else f"{value:.1g}")


def words(text: str | Sequence[str] | None) -> str:
    """Return the text, or several in a row, as it stands; a dash for none."""
    whole_text = text if isinstance(text, str) else "; ".join(text or ())
    return whole_text.strip() or NOTHING


def ratio(value: float | None, digits: int = 3) -> str:
    """Return a rotation ratio: a number, "overturns" for inf, "rests" up to a thousandth, a dash for nan or None."""
    if value is None or NEGLIGIBLE < value < math.inf:
        return number(value, digits)
    return NOTHING if math.isnan(value) else "rests" if rests(value) else "overturns"


def listed(names: Sequence[str], most: int = 6) -> str:
    """Return the names in a row, those beyond `most` as a count."""
    more = len(names) - most
    return ", ".join(names[:most]) + (f" and {counted(more, 'other')}" if more > 0 else "")


def left_out(more: int, noun: str, place: str) -> str:
    """Return the sentence that says where `more` of a thing stand, or nothing where there are none."""
    return f" Another {counted(more, noun)} in {place}." if more > 0 else ""


def of(part: float, whole: float) -> str:
    """Return "n of m" on one line, NOTHING where there are none."""
    return f"{int(part)}\u00a0of\u00a0{int(whole)}" if whole > 0 else NOTHING


def short(name: str, most: int = 44) -> str:
    """Return a name that stands in full in a table before, cut to `most` characters."""
    return name if len(name) <= most else f"{name[: most - 1].rstrip()}…"


def sentence(text: str) -> str:
    """Return the text with a capital first letter."""
    return text[:1].upper() + text[1:]


def strong(text: str, really: bool = True) -> dict[str, object]:
    """Return a table cell whose text is set in bold, where it is `really` meant to be."""
    return {"text": text, "strong": really}


def table(columns: Sequence[tuple[str, str, str]], rows: Iterable[Sequence[Cell]]) -> dict[str, object]:
    """Return a table as the templates set it; a column is (heading, width, alignment)."""
    heads, widths, alignments = zip(*columns, strict=True)
    return {"heads": heads, "widths": widths, "alignments": alignments, "rows": [list(row) for row in rows]}


def table_of(rows: Iterable[Any], *columns: Column) -> dict[str, object]:
    """Return a table with a line for each row."""
    return table([column[:3] for column in columns], [[show(row) for *_, show in columns] for row in rows])


def columns_of(kind: type[Row], fields: str, width: str = "") -> list[Column]:
    """Return columns that show fields of rows of one `kind`, with heading and unit as the row class has them.

    fields: their names, separated by spaces, each with its width where that is not that of all: "stage message=3".
    width: of all; if empty, by their type.
    """
    described = {each.name: each for each in kind.table.columns}
    columns: list[Column] = []
    for name, _, own_width in (each.partition("=") for each in fields.split()):
        numeric = described[name].holds in (float, int)
        usual, side = ("0.8", "r") if numeric else ("1", "l")
        shown = partial(field_of, name)
        columns.append((_heading(described[name]), own_width or width or usual, side, shown))
    return columns


def _heading(column: Described) -> str:
    """The name of a column in words, with its unit: "Start time [s]"."""
    unit = column.unit or ("-" if column.holds is float else "")
    name = column.attribute.replace("_", " ").replace("rotd", "RotD")
    return sentence(name) + (f" [{unit}]" if unit else "")


def field_of(name: str, row: Row | None) -> str:
    """Return the field `name` of a row as it is printed: by its type, rotation ratios in words where they are none."""
    value = getattr(row, name, None)
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float) and name not in _CHOSEN:
        return ratio(value) if name.endswith("rotation_ratio") else number(value)
    return given(value) if isinstance(value, float | int) else words(value)


def _typeset(text: str) -> str:
    mantissa, _, exponent = text.partition("e")
    mantissa = mantissa.replace("-", "−")
    return f"{mantissa}×10{str(int(exponent)).translate(_SUPERSCRIPTS)}" if exponent else mantissa
