"""The annual rate of overturning, where a hazard curve is known."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import numpy as np

from rocking.assessment.fragility.curve import Fragility
from rocking.errors import ConfigurationError
from rocking.tables import Row, column, read_rows, row

_STEPS = 400
"""Steps of the integral over the hazard curve, in equal parts of the logarithm of the level."""


@row("hazard", "One row per level of the intensity measure, ascending")
class HazardRow(Row):
    """One point of a hazard curve."""

    intensity: float = column("Level, in the unit of the intensity measure")
    annual_rate: float = column("Annual rate at which it is exceeded", unit="1/year")


@dataclass(frozen=True)
class AnnualRate:
    """Annual rate of exceedance, 1/year. low, high: from the ends of the curve's 90 % interval at every level at once,
    which is wider than 90 % of the rate. left_out: most that the rate may lack, because the curve ends below a
    probability of 1, or has not fallen to 0 where the hazard curve begins."""

    rate: float
    low: float
    high: float
    left_out: float


def read_hazard(path: Path) -> list[HazardRow]:
    """Return the points of a hazard curve from a CSV with the columns intensity and annual_rate.

    Raises ConfigurationError for fewer than two points, levels that do not ascend, or a rate that rises.
    """
    points = list(read_rows(HazardRow, path))
    check_hazard(points, str(path))
    return points


def check_hazard(points: Sequence[HazardRow], where: str = "the hazard curve") -> None:
    """Raise ConfigurationError unless the levels ascend and the rates fall."""
    if len(points) < 2:
        raise ConfigurationError(f"{where} holds {len(points)} points, but must hold at least 2.")
    for point in points:
        if not (point.intensity > 0 and point.annual_rate > 0):
            raise ConfigurationError(
                f"{where} holds {point.intensity:g} at {point.annual_rate:g} a year, but both must be above 0."
            )
    for before, after in pairwise(points):
        if after.intensity <= before.intensity:
            raise ConfigurationError(
                f"{where} holds {after.intensity:g} after {before.intensity:g}, but intensity must ascend; sort it."
            )
        if after.annual_rate > before.annual_rate:
            raise ConfigurationError(
                f"{where} says {after.annual_rate:g} a year at {after.intensity:g}, more than "
                f"{before.annual_rate:g} at {before.intensity:g}, but annual_rate must not rise."
            )


def annual_rate(fragility: Fragility, points: Sequence[HazardRow]) -> AnnualRate:
    """Return ∫ P dν over the hazard curve ν, both linear in the logarithm of the level between their points.

    Below its levels the fragility counts as 0, above them as its last value; beyond the last point of the hazard curve
    all is counted there. Levels below the first point of the hazard curve are left out, as their rates are not given:
    left_out counts them as often as the hazard curve, continued by its first slope, says. Raises ConfigurationError.
    """
    check_hazard(points)
    levels, probability = np.log(fragility.levels), fragility.probability
    logs, log_rates = np.log([[point.intensity, point.annual_rate] for point in points]).T
    edges = np.linspace(logs[0], logs[-1], _STEPS + 1)
    rates = np.exp(np.interp(edges, logs, log_rates))
    occurring = np.append(rates[:-1] - rates[1:], rates[-1])
    middles = np.append((edges[1:] + edges[:-1]) / 2, edges[-1])

    def total(curve: np.ndarray) -> float:
        return float(np.interp(middles, levels, curve, left=0.0) @ occurring)

    above = (1 - probability[-1]) * occurring[middles > levels[-1]].sum()
    slope = (log_rates[0] - log_rates[1]) / (logs[1] - logs[0])
    lower = np.linspace(min(levels[0], logs[0]), logs[0], _STEPS + 1)
    continued = np.exp(log_rates[0] + slope * (logs[0] - lower))
    below = np.interp((lower[1:] + lower[:-1]) / 2, levels, probability, left=0.0) @ -np.diff(continued)
    return AnnualRate(
        total(probability),
        total(fragility.probability_low),
        total(fragility.probability_high),
        float(above + below),
    )
