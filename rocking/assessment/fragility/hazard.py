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
    which is wider than 90 % of the rate."""

    rate: float
    low: float
    high: float


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

    Below its levels the fragility counts as 0, above them as its last value. Raises ConfigurationError.
    """
    check_hazard(points)
    logs = np.log([point.intensity for point in points])
    edges = np.linspace(logs[0], logs[-1], _STEPS + 1)
    rates = np.exp(np.interp(edges, logs, np.log([point.annual_rate for point in points])))
    occurring = np.append(rates[:-1] - rates[1:], rates[-1])
    middles = np.append((edges[1:] + edges[:-1]) / 2, edges[-1])
    levels = np.log(fragility.levels)

    def total(curve: np.ndarray) -> float:
        return float(np.interp(middles, levels, curve, left=0.0) @ occurring)

    curves = fragility.probability, fragility.probability_low, fragility.probability_high
    return AnnualRate(*map(total, curves))
