"""How well an intensity measure explains what overturns, and whether another figure of the record says more."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import expit, ndtr, stdtr, stdtrit

_LEAST = 4
"""Stations below which a slope and its scatter say nothing."""
_RIDGE = 1e-5
"""Penalty on standardised coefficients per case: keeps those finite that no case contradicts."""
_LOGISTIC = np.pi / 3**0.5
"""Standard deviation of the logistic distribution of scale 1."""


@dataclass(frozen=True)
class Dependence:
    """How the level that overturns depends on another figure of the record, at equal intensity.

    slope: change of the logarithm of the level for one standard deviation of the figure. p_value: of no slope.
    power: share of samples of as many stations that would show a slope of this size at 5 %.
    """

    slope: float
    p_value: float
    power: float


_UNKNOWN = Dependence(float("nan"), float("nan"), float("nan"))


def efficiency(log_levels: np.ndarray, exceedance: np.ndarray, stations: Sequence[str]) -> float:
    """Return the scatter of the logarithm of the level that overturns; less is better.

    log_levels, exceedance: (r, k) of each record at each of its levels. Every outcome counts, also of records that
    never overturn or that stand again above the level that overturned them.
    """
    (_, slope), _ = _logistic([log_levels], exceedance, stations)
    return float(_LOGISTIC / slope) if slope > 0 else float("nan")


def dependence(
    log_levels: np.ndarray, exceedance: np.ndarray, figures: np.ndarray, stations: Sequence[str]
) -> Dependence:
    """Return how the outcomes (r, k) depend on `figures` (r,) beside the levels (r, k); nan for too few stations.

    The error of the slope is that between stations, so that two components of one are no two observations, and the
    slope over it is held against Student's law for the number of stations less three.
    """
    many = len(set(stations))
    if many < _LEAST or np.ptp(figures) == 0:
        return _UNKNOWN
    scaled = (figures - figures.mean()) / figures.std()
    beside = np.broadcast_to(scaled[:, None], log_levels.shape)
    (_, level, figure), error = _logistic([log_levels, beside], exceedance, stations)
    freedom, t = many - 3, abs(figure) / error[2]
    limit = stdtrit(freedom, 0.975)
    power = ndtr(t - limit) + ndtr(-t - limit)
    return Dependence(float(-figure / level), float(2 * stdtr(freedom, -t)), float(power))


def _logistic(
    terms: Sequence[np.ndarray], outcomes: np.ndarray, stations: Sequence[str]
) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of a logistic regression of shares (r, k) on an intercept and terms (r, k), each station with the
    same weight; their errors by the scatter between stations (Liang & Zeger 1986).
    """
    names, place, records = np.unique(np.asarray(stations), return_inverse=True, return_counts=True)
    design = np.stack([np.ones(outcomes.shape), *terms], axis=-1)
    kept = np.isfinite(outcomes)
    rows, shares = design[kept], outcomes[kept]
    station = np.broadcast_to(place[:, None], outcomes.shape)[kept]
    weight = (1 / records[place])[:, None].repeat(outcomes.shape[1], axis=1)[kept]
    centre, spread = rows[:, 1:].mean(axis=0), rows[:, 1:].std(axis=0)
    rows = np.column_stack([rows[:, 0], (rows[:, 1:] - centre) / np.where(spread > 0, spread, 1.0)])
    penalty = _RIDGE * weight.sum() * np.diag([0.0, *np.ones(len(terms))])
    found = np.zeros(rows.shape[1])
    for _ in range(100):
        said = expit(rows @ found)
        curvature = (rows * (weight * np.maximum(said * (1 - said), 1e-12))[:, None]).T @ rows + penalty
        step = np.linalg.solve(curvature, rows.T @ (weight * (shares - said)) - penalty @ found)
        found = found + step * min(1.0, 4.0 / max(np.abs(step).max(), 1e-300))
        if np.abs(step).max() < 1e-10:
            break
    inverse = np.linalg.inv(curvature)
    scores = np.zeros((names.size, rows.shape[1]))
    np.add.at(scores, station, rows * (weight * (shares - said))[:, None])
    covariance = inverse @ (scores.T @ scores) @ inverse * names.size / max(names.size - rows.shape[1], 1)
    scale = np.concatenate([[1.0], spread])
    return found / scale, np.sqrt(np.diag(covariance)) / scale
