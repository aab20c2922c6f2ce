"""Whether an intensity measure suffices: does the level that overturns still depend on another figure of the record?"""

from collections.abc import Sequence

import numpy as np
from scipy.special import stdtr

from rocking.assessment.fragility.curve import drawn_stations

_LEAST = 4
"""Stations below which a slope and its scatter say nothing."""


def sufficiency(figures: np.ndarray, capacities: np.ndarray, stations: Sequence[str]) -> float:
    """Return the p-value of no linear dependence of `capacities` (r,) on `figures` (r,); nan for too few stations.

    The slope over its standard error is held against Student's law for the number of stations less two. The error is
    that of the slopes of resampled stations, so that two components of one station are no two observations.
    """
    names, place = np.unique(np.asarray(stations), return_inverse=True)
    if names.size < _LEAST or np.ptp(figures) == 0:
        return float("nan")
    slopes = _slopes(figures, capacities, drawn_stations(names.size)[:, place].astype(float))
    error = float(np.nanstd(slopes, ddof=1))
    (slope,) = _slopes(figures, capacities, np.ones((1, figures.size)))
    return float(2 * stdtr(names.size - 2, -abs(slope) / error)) if error > 0 else float(slope == 0)


def _slopes(x: np.ndarray, y: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Least-squares slopes, (b,), one for each row of weights; nan where all of the weight lies on one x."""
    share = weights / weights.sum(axis=1, keepdims=True)
    mean_x, mean_y = share @ x, share @ y
    spread = share @ x**2 - mean_x**2
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(
            np.where(spread > 1e-12 * np.ptp(x) ** 2, (share @ (x * y) - mean_x * mean_y) / spread, np.nan)
        )
