"""Where a value stands on an axis, linear or logarithmic, and which values are named there."""

import math
from dataclasses import dataclass

import numpy as np

_SPREADS = ((1, 2, 3, 5, 7), (1, 2, 5), (1, 3), (1,))
"""Values of a decade that a logarithmic axis names, as many as have room."""
_STEPS = (1.0, 2.0, 2.5, 5.0, 10.0)


@dataclass(frozen=True)
class Scale:
    """An axis from `low` to `high`."""

    low: float
    high: float
    logarithmic: bool = False

    def __post_init__(self) -> None:
        if not (self.high > self.low and (self.low > 0 or not self.logarithmic)):
            raise ValueError(f"an axis from {self.low} to {self.high} has no room.")

    def shares(self, values: np.ndarray | float) -> np.ndarray:
        """Return where `values` stand, 0 at the low end and 1 at the high one; nan where they stand nowhere."""
        values = np.asarray(values, dtype=float)
        if not self.logarithmic:
            return (values - self.low) / (self.high - self.low)
        positive = np.where(values > 0, values, np.nan)
        return np.log(positive / self.low) / math.log(self.high / self.low)

    def ticks(self, most: int) -> list[float]:
        """Return round values within the axis, at most `most` of them and at least one."""
        return (
            _logarithmic(self.low, self.high, most)
            if self.logarithmic
            else _linear(self.low, self.high, most)
        )


def spanning(*series: np.ndarray, margin: float = 0.05) -> Scale:
    """Return the linear axis that holds all of `series`, with a margin at both ends; of ±1 about a single value."""
    low = min(float(np.min(values)) for values in series)
    high = max(float(np.max(values)) for values in series)
    air = margin * (high - low) if high > low else 1.0
    return Scale(low - air, high + air)


def _linear(low: float, high: float, most: int) -> list[float]:
    power = 10.0 ** math.floor(math.log10((high - low) / max(most, 1)))
    for step in (power * each for each in (*_STEPS, *(10 * each for each in _STEPS))):
        first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
        if last - first < most:
            return [round(place * step, 12) for place in range(first, last + 1)] or [low]
    raise AssertionError("a step of a hundred times the least always has room")


def _logarithmic(low: float, high: float, most: int) -> list[float]:
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    found: list[float] = []
    for spread in _SPREADS:
        found = [float(f"{each}e{decade}") for decade in decades for each in spread]
        found = [value for value in found if low * (1 - 1e-9) <= value <= high * (1 + 1e-9)]
        # values of a decade stand unevenly, the nearest ones half as far apart as on average
        if len(found) <= (most if len(spread) == 1 else 0.7 * most):
            break
    stride = math.ceil(len(found) / max(most, 1)) or 1
    return found[::stride] or [low]


def tick_label(value: float) -> str:
    """Return a value as an axis names it, with a real minus."""
    return f"{value:g}".replace("-", "−")
