"""Checks at birth: each returns the value as a float or raises one clear sentence."""

import math

from rocking.errors import RockingError


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


def _number(error: type[RockingError], field: str, value: float) -> float:
    if isinstance(value, bool | str | bytes):
        raise error(f"{field} is {value!r}, but must be a number.")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise error(f"{field} is {value!r}, but must be a number.") from None


def _in(unit: str) -> str:
    return f" {unit}" if unit else ""
