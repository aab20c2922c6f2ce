"""Quantities: the one g, the doors through which units come in, and checks at birth.

Inside, everything is SI and radians. Each check returns the value as a float or raises one clear sentence.
"""

import math
import re
from collections.abc import Sequence
from functools import lru_cache

from rocking.errors import RecordError, RockingError, StructureError

GRAVITY = 9.80665
"""scipy.constants.g, m/s². Typed here because importing scipy.constants costs every process a fifth of a second."""

UNPRINTABLE = re.compile("[\x00-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Control characters, marks that turn the direction of writing, halves of characters."""

NUMBER = r"[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?"
"""A plain finite decimal number, in heads, in rows and in settings alike."""
_NUMBER = re.compile(NUMBER)

_LONGEST_VALUE = 100
"""Characters of a value that a sentence repeats."""


def is_number(token: str) -> bool:
    """Whether `token` is a plain finite decimal number; "1_0", "nan" and "inf" are not."""
    return bool(_NUMBER.fullmatch(token))


def shown(value: object) -> str:
    """Return `value` as a sentence repeats it: of a long one only the begin, and how long it is."""
    try:
        text = repr(value)
    except ValueError:
        return "a number of thousands of digits"  # which Python does not write
    text = re.sub(r"\s*\n\s*", " ", text)  # an array's has lines
    if len(text) <= _LONGEST_VALUE:
        return text
    return f"{text[:_LONGEST_VALUE]}… ({len(text)} characters)"


def kind_of(value: object) -> str:
    """Return the type of `value` as a sentence says it: "an int"."""
    name = type(value).__name__
    return f"an {name}" if name[0] in "aeiouAEIOU" else f"a {name}"


def instance(error: type[RockingError], name: str, value: object, *kinds: type) -> None:
    """Refuse a `value` of another type than `kinds`, such as the list that `read` returns for its one component."""
    if not isinstance(value, kinds):
        hint = "; give one of its items" if isinstance(value, list | tuple) else ""
        article = "an" if kinds[0].__name__[0] in "AEIOU" else "a"
        names = " or ".join(kind.__name__ for kind in kinds)
        raise error(f"{name} is {kind_of(value)}, but must be {article} {names}{hint}.", **{name: value})


def escaped(text: str) -> str:
    """Return `text` for a terminal: what is not printable as its escape sequence; ends of lines and tabs stay."""
    return UNPRINTABLE.sub(lambda mark: mark[0] if mark[0] in "\n\t" else ascii(mark[0])[1:-1], text)


ACCELERATION_UNITS = {
    "m/s2": 1.0,
    "cm/s2": 0.01,
    "mm/s2": 0.001,
    "um/s2": 1e-6,
    "nm/s2": 1e-9,
    "gal": 0.01,
    "g": GRAVITY,
    "mg": GRAVITY / 1000,
    "%g": GRAVITY / 100,
    "g/10": GRAVITY / 10,
    "ft/s2": 0.3048,
    "in/s2": 0.0254,
}
"""Factor from each unit of acceleration to m/s²; one g = 9.80665 m/s² for units and gravity alike."""


_SPELLINGS = tuple(
    (re.compile(pattern), short)
    for pattern, short in (
        (r"[\s_]+per[\s_]+", "/"),
        (r"\s*([/%])\s*", r"\1"),
        (r"/\(([^()]*)\)?$", r"/\1"),
        ("[⁻−]", "-"),
        ("²|squared", "2"),
        ("[µμ]", "u"),
        ("centi(?=m)|с(?=м)", "c"),
        ("met(?:er|re)s?|м", "m"),
        ("cms(?=/)", "cm"),
        ("sec(?:ond)?s?|seg|sn|с(?:ек)?", "s"),
        (r"[.^*·_ ]+(?=-?2|s)|\.$", ""),
        (r"^((?:[cmun]?m)|ft|in)(?:ch)?(?:/s/?s|/?s2|s-2)$", r"\1/s2"),
        ("^(?:gals|гал|ガル|伽)$", "gal"),
        ("^(?:g'?s|gravity)$", "g"),
        ("^milli[ -]?g$", "mg"),
    )
)
"""Each pattern of a spelling in small letters, and what it becomes, one after another."""


@lru_cache(maxsize=1024)
def acceleration_unit(text: str) -> str | None:
    """Return the unit that `text` spells ("cm/sec/sec", "M/S²") as ACCELERATION_UNITS calls it; None for another."""
    name = text.strip().lower()
    for pattern, short in _SPELLINGS:
        name = pattern.sub(short, name)
    return name if name in ACCELERATION_UNITS else None


SECONDS = {
    "s": 1.0, "sec": 1.0, "secs": 1.0, "second": 1.0, "seconds": 1.0, "ms": 1e-3, "msec": 1e-3, "millisecond": 1e-3,
    "seg": 1.0, "segundos": 1.0, "sek": 1.0, "sekunden": 1.0, "sn": 1.0, "saniye": 1.0, "secondi": 1.0, "secondes": 1.0,
    "milliseconds": 1e-3, "us": 1e-6, "µs": 1e-6, "microseconds": 1e-6, "min": 60.0, "minute": 60.0, "minutes": 60.0,
    "h": 3600.0, "hour": 3600.0, "hours": 3600.0, "utc": 1.0, "gmt": 1.0, "local": 1.0, "hh:mm:ss": 1.0,
    "с": 1.0, "сек": 1.0, "мс": 1e-3, "秒": 1.0, "毫秒": 1e-3, "μs": 1e-6,
}  # fmt: skip
"""The units of time, s."""


def seconds_of(unit: str) -> float:
    """Return a unit of times, s. Raises RecordError for a word that is none."""
    if unit.lower() not in SECONDS:
        raise RecordError(
            f"the times are in {unit[:20]!r}, but must be in s, ms or min; convert them.", unit=unit
        )
    return SECONDS[unit.lower()]


VELOCITY_UNITS = {"m/s": 1.0, "cm/s": 0.01, "mm/s": 0.001}
"""Factor from each unit of velocity to m/s."""


def velocity_unit(text: str) -> str | None:
    """Return the unit that `text` spells ("cm/sec", "cm_s") as VELOCITY_UNITS calls it; None for another."""
    name = text.strip().lower().replace("sec", "s").replace("_per_", "/").replace("_s", "/s")
    return name if name in VELOCITY_UNITS else None


def acceleration_factor(unit: str) -> float:
    """Return the factor from `unit` to m/s²: of "4.71e-6 m/s2", the unit of one count, 4.71e-6.

    Raises RecordError when the unit is not known.
    """
    of_count = _OF_COUNT.fullmatch(str(unit).strip())
    count = float(of_count["number"]) if of_count else 1.0
    name = acceleration_unit(of_count["unit"] if of_count else str(unit))
    if name is None or not 0 < count < math.inf:
        raise RecordError(
            f"unit is {shown(unit)}, but must be one of {', '.join(ACCELERATION_UNITS)}, for counts behind the "
            "acceleration of one, as in 4.71e-6 m/s2.",
            unit=unit,
        )
    return count * ACCELERATION_UNITS[name]


_OF_COUNT = re.compile(r"(?P<number>\d*\.?\d+(?:[eE][-+]?\d+)?)\s+(?P<unit>\D.*)")


def finite(error: type[RockingError], field: str, value: float, unit: str = "") -> float:
    """Return `value` as a finite float, or raise `error` naming `field`."""
    if isinstance(value, bool | str | bytes):
        raise error(f"{field} is {shown(value)}, but must be a number.", **{field: value})
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        raise error(f"{field} is {shown(value)}, but must be a number.", **{field: value}) from None
    if not math.isfinite(number):
        raise error(f"{field} is {shown(value)}, but must be a finite number{_in(unit)}.", **{field: value})
    return number


def positive(error: type[RockingError], field: str, value: float, unit: str = "") -> float:
    """Return `value` as a finite float above zero, or raise `error` naming `field`."""
    number = finite(error, field, value, unit)
    if number <= 0:
        raise error(f"{field} is {shown(value)}{_in(unit)}, but must be greater than 0.", **{field: value})
    return number


def within(
    error: type[RockingError], field: str, value: float, *, low: float, high: float, unit: str = ""
) -> float:
    """Return `value` as a float in [low, high], or raise `error` naming `field`."""
    number = finite(error, field, value, unit)
    if not low <= number <= high:
        raise error(
            f"{field} is {shown(value)}{_in(unit)}, but must lie between {low:g} and {high:g}.",
            **{field: value},
        )
    return number


LENGTHS = (1e-4, 1e5)
"""Lengths that are allowed, from a tenth of a millimetre to a hundred kilometres, m."""


def whole(field: str, value: float, low: float, high: float) -> int:
    """Return a whole number from `low` to `high`, or raise StructureError naming `field`."""
    number = finite(StructureError, field, value)
    if number != int(number) or not low <= number <= high:
        raise StructureError(
            f"{field} is {number:g}, but must be a whole number from {low:g} to {high:g}.", **{field: value}
        )
    return int(number)


def four_digits(value: float, unit: str = "") -> str:
    """Return `value` to four digits with its unit, as a reader wants it."""
    return f"{value:.4g}{_in(unit)}"


def percent(share: float) -> str:
    """Return a share in percent: one digit below 10, whole from there on, 0 below 0.05 %."""
    value = 100 * share
    return f"{value:.0f}" if value >= 9.5 or value < 0.05 else f"{value:.1g}"


def percents(*shares: float) -> str:
    """Return the range of several shares, or the one that all are as printed: "11–13 %"."""
    ends = dict.fromkeys((percent(min(shares)), percent(max(shares))))
    return f"{'–'.join(ends)}\u00a0%"


def counted(number: int, name: str) -> str:
    """Return "1 impact", "2 impacts"."""
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


def listed(names: Sequence[str], most: int = 6) -> str:
    """Return the names in a row, those beyond `most` as a count.

    Semicolons stand between them where a name holds a comma.
    """
    more = len(names) - most
    between = "; " if any("," in name for name in names[:most]) else ", "
    return between.join(names[:most]) + (f" and {counted(more, 'other')}" if more > 0 else "")


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
