"""Quantities: the one g, the doors through which units come in, and checks at birth.

Inside, everything is SI and radians. Each check returns the value as a float or raises one clear sentence.
"""

import math
from collections.abc import Mapping
from dataclasses import Field, field, fields
from functools import cache
from types import NoneType
from typing import Any, Literal, get_args, get_origin, get_type_hints

from rocking.errors import RecordError, RockingError, StructureError

GRAVITY = 9.80665
"""scipy.constants.g, m/s². Typed here because importing scipy.constants costs every process a fifth of a second."""

ACCELERATION_UNITS = {
    "m/s2": 1.0,
    "cm/s2": 0.01,
    "mm/s2": 0.001,
    "gal": 0.01,
    "g": GRAVITY,
    "mg": GRAVITY / 1000,
    "g/10": GRAVITY / 10,
}
"""Factor from each unit of acceleration to m/s²; one g = 9.80665 m/s² for units and gravity alike."""


def acceleration_unit(text: str) -> str | None:
    """Return the unit that `text` spells ("cm/sec/sec", "M/S²") as ACCELERATION_UNITS calls it; None for another."""
    name = str(text).strip().lower()
    for spelt, short in (("sec", "s"), ("²", "2"), ("^2", "2"), ("**2", "2"), ("/s/s", "/s2")):
        name = name.replace(spelt, short)
    return name if name in ACCELERATION_UNITS else None


def acceleration_factor(unit: str) -> float:
    """Return the factor from `unit` to m/s². Raises RecordError when the unit is not known."""
    name = acceleration_unit(unit)
    if name is None:
        raise RecordError(f"unit is {unit!r}, but must be one of {', '.join(ACCELERATION_UNITS)}.")
    return ACCELERATION_UNITS[name]


def finite(error: type[RockingError], field: str, value: float, unit: str = "") -> float:
    """Return `value` as a finite float, or raise `error` naming `field`."""
    number = _number(error, field, value)
    if not math.isfinite(number):
        raise error(f"{field} is {value!r}, but must be a finite number{_in(unit)}.")
    return number


def positive(error: type[RockingError], field: str, value: float, unit: str = "") -> float:
    """Return `value` as a finite float above zero, or raise `error` naming `field`."""
    number = finite(error, field, value, unit)
    if number <= 0:
        raise error(f"{field} is {value!r}{_in(unit)}, but must be greater than 0.")
    return number


def within(
    error: type[RockingError], field: str, value: float, low: float, high: float, unit: str = ""
) -> float:
    """Return `value` as a float in [low, high], or raise `error` naming `field`."""
    number = finite(error, field, value, unit)
    if not low <= number <= high:
        raise error(f"{field} is {value!r}{_in(unit)}, but must lie between {low:g} and {high:g}.")
    return number


LENGTHS = (1e-4, 1e5)
"""Lengths that are allowed, from a tenth of a millimetre to a hundred kilometres, m."""


def length(field: str, value: float) -> float:
    """Return `value` as a length in m, or raise StructureError naming `field` and the bounds."""
    return within(StructureError, field, positive(StructureError, field, value, "m"), *LENGTHS, "m")


def not_negative(field: str, value: float, unit: str) -> float:
    """Return a finite number of 0 or more, or raise StructureError naming `field`."""
    number = finite(StructureError, field, value, unit)
    if number < 0:
        raise StructureError(f"{field} is {value!r}{_in(unit)}, but must be 0 or more.")
    return number


def whole(field: str, value: float, low: float, high: float) -> int:
    """Return a whole number from `low` to `high`, or raise StructureError naming `field`."""
    number = finite(StructureError, field, value)
    if number != int(number) or not low <= number <= high:
        raise StructureError(f"{field} is {number:g}, but must be a whole number from {low:g} to {high:g}.")
    return int(number)


def shown(value: float, unit: str = "") -> str:
    """Return `value` to four digits with its unit, as a reader wants it."""
    return f"{value:.4g}{_in(unit)}"


def counted(number: int, name: str) -> str:
    """Return "1 impact", "2 impacts"."""
    return f"{number} {name}" if number == 1 else f"{number} {name}s"


def setting(
    default: Any, meaning: str, unit: str = "", *, one_of: tuple[str, ...] = (), **bounds: float
) -> Any:
    """Return a dataclass field that says all there is to say of one setting.

    one_of: names, where a registry rather than the type gives them. bounds: any of gt, ge, lt, le.
    check_settings holds the value against its type and its bounds; the settings of a study, their JSON schema, the
    shipped config.yaml and its table in the documentation are made from the same field.
    """
    return field(
        default=default, metadata={"meaning": meaning, "unit": unit, "one_of": one_of, "bounds": bounds}
    )


def check_settings(error: type[RockingError], made: Any) -> None:
    """Hold every setting of the frozen dataclass `made` against its type and bounds; whole numbers become floats.

    Raises `error` naming the first field that is wrong.
    """
    hints = _type_hints(made.__class__)
    for each in (each for each in fields(made) if "bounds" in each.metadata):
        value = getattr(made, each.name)
        if not is_allowed(hints[each.name], each, value):
            unit = _in(each.metadata["unit"]) if isinstance(value, int | float) else ""
            must = allowed(hints[each.name], each)
            raise error(f"{each.name} is {value!r}{unit}, but must be {must}.")
        object.__setattr__(made, each.name, as_typed(hints[each.name], value))


@cache
def _type_hints(kind: Any) -> dict[str, Any]:
    """Of a class: compiled from their texts, which takes longer than all that is done with them."""
    return get_type_hints(kind)


def is_allowed(kind: Any, described: Field[Any], value: object) -> bool:
    """Whether `value` is of the type `kind` and within the bounds of the setting that `described` describes."""
    options = choices(kind, described)
    if value is None or isinstance(value, str | bool):
        return value in options or (type(value) in options and value != "")
    if not isinstance(value, int | float) or not {type(value), float} & set(options):
        return False
    bounds = described.metadata["bounds"]
    return math.isfinite(value) and all(_COMPARED[name](value, bound) for name, bound in bounds.items())


def allowed(kind: Any, described: Field[Any]) -> str:
    """Say what is_allowed accepts: "a number above 0 and up to 0.5, or null"."""
    bounds: Mapping[str, float] = described.metadata["bounds"]
    limits = " and ".join(f"{_BOUND_WORDS[name]} {bound:g}" for name, bound in bounds.items())
    if set(bounds) == {"ge", "le"}:
        limits = f"from {bounds['ge']:g} to {bounds['le']:g}"
    words = {
        int: f"a whole number {limits}",
        float: f"a number {limits}",
        bool: "true or false",
        str: "a text that is not empty",
    }
    return " or ".join(
        words[choice].strip() if choice in words else str(choice or "null")
        for choice in choices(kind, described)
    )


def as_typed(kind: Any, value: Any) -> Any:
    """Return an allowed value with the type of its setting: 1 as 1.0 where a number is asked for."""
    is_whole = isinstance(value, int) and not isinstance(value, bool)
    return float(value) if is_whole and float in _flat(kind) else value


_COMPARED = {
    "gt": lambda value, bound: value > bound,
    "ge": lambda value, bound: value >= bound,
    "lt": lambda value, bound: value < bound,
    "le": lambda value, bound: value <= bound,
}
_BOUND_WORDS = {"gt": "above", "ge": "of at least", "lt": "below", "le": "up to"}


def choices(kind: Any, described: Field[Any]) -> list[Any]:
    """The types and values that a setting allows, in their order: float | None is [float, None]."""
    return [*described.metadata["one_of"]] or _flat(kind)


def _flat(kind: Any) -> list[Any]:
    if get_origin(kind) is Literal:
        return list(get_args(kind))
    flat = [choice for part in get_args(kind) for choice in _flat(part)]
    return flat or [None if kind is NoneType else kind]


def _number(error: type[RockingError], field: str, value: float) -> float:
    if isinstance(value, bool | str | bytes):
        raise error(f"{field} is {value!r}, but must be a number.")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise error(f"{field} is {value!r}, but must be a number.") from None


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
