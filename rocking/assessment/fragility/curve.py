"""The fragility curve that outcomes tell: empirical and lognormal, with intervals by station."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.special import betaincinv, ndtr, ndtri, stdtrit

from rocking.assessment.fragility.lognormal import LognormalFits, fit_lognormal

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REPLICATES = 1000
CURVES = tuple(f"{law}{end}" for law in ("probability", "lognormal") for end in ("", "_low", "_high"))
"""What is known at every level, by the names of fields and of columns."""
_LILLIEFORS = 0.886
"""Largest distance of an empirical from a fitted normal distribution, times the root of the number of samples, that
19 in 20 samples stay below (Lilliefors 1967, 5 % level of many samples)."""


@dataclass(frozen=True, eq=False, repr=False)
class Fragility:
    """P(rotation ratio > threshold | intensity) of one structure; the threshold inf is overturning.

    measure, unit: of the intensity. levels: (k,). probability, probability_low, probability_high: (k,) the empirical
    curve and its 90 % interval, point by point; nan where nothing was tried. lognormal, lognormal_low,
    lognormal_high: (k,) the fit by maximum likelihood and its 90 % interval. median, interval: where half exceed, and
    its 90 % interval, of the lognormal where it holds, else of the empirical curve. dispersion: of the fit.
    misfit: largest distance of the two curves. exceedance: (r, k) share of each record's members above the threshold;
    of the block where the mechanism was not followed. stations: (r,) what counts as one independent record.
    lognormal_holds: whether the curves lie no farther apart than chance takes them in 19 of 20 samples; of the block's
    curves where the mechanism was followed in some cases only. mechanism_runs: None where every case was followed.
    """

    measure: str
    unit: str
    threshold: float
    levels: np.ndarray
    probability: np.ndarray
    probability_low: np.ndarray
    probability_high: np.ndarray
    lognormal: np.ndarray
    lognormal_low: np.ndarray
    lognormal_high: np.ndarray
    median: float
    interval: tuple[float, float]
    dispersion: float
    misfit: float
    exceedance: np.ndarray
    stations: tuple[str, ...]
    lognormal_holds: bool
    mechanism_runs: int | None = None

    def __repr__(self) -> str:
        low, high = self.interval
        unit = f" {self.unit}" if self.unit else ""
        law = f"dispersion {self.dispersion:.2f}" if self.lognormal_holds else "not lognormal"
        runs = "" if self.mechanism_runs is None else f", {self.mechanism_runs} runs of the mechanism"
        return (
            f"<Fragility: median {self.measure} {self.median:.3g}{unit} (90 %: {low:.3g} to {high:.3g}), {law}, "
            f"{len(self.stations)} records of {self.independent} stations{runs}>"
        )

    @property
    def independent(self) -> int:
        """Number of stations."""
        return len(set(self.stations))

    @property
    def reversals(self) -> np.ndarray:
        """How often each record, scaled up, lets stand again what it had overturned, (r,)."""
        return np.asarray((np.diff((self.exceedance > 0.5).astype(int), axis=1) < 0).sum(axis=1))

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the empirical curve with its interval and the lognormal one; return the axes."""
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)


def fragility_of(
    levels: np.ndarray,
    exceedance: np.ndarray,
    stations: Sequence[str],
    *,
    tried: np.ndarray | None = None,
    measure: str = "",
    unit: str = "",
    threshold: float = np.inf,
    sampled_of: Fragility | None = None,
) -> Fragility:
    """Return the curve of outcomes at `levels` (k,) > 0, ascending.

    exceedance: (r, k) shares in [0, 1], one row a record. tried: (r, k) 1 where a record was tried, all by default.
    stations: (r,) names; the records of one are resampled together, and half a station counts no more than one.
    sampled_of: where `exceedance` holds estimates from a sample, of any size and sign, whose mean is right: the curve
    that led it, and that says whether the lognormal holds.
    """
    tried = np.ones_like(exceedance) if tried is None else tried
    over, trials = _by_station(exceedance * tried, stations), _by_station(tried, stations)
    weights, sampled = drawn_stations(len(over)), sampled_of is not None
    found = _fitted(levels, over, trials, weights, sampled)
    chance = _LILLIEFORS / len(over) ** 0.5
    made = Fragility(
        measure=measure,
        unit=unit,
        threshold=threshold,
        levels=levels,
        **found,
        exceedance=exceedance,
        stations=tuple(stations),
        lognormal_holds=sampled_of.lognormal_holds if sampled_of else found["misfit"] <= chance,
    )
    if made.lognormal_holds or tried.min() == 0:
        return made
    return _by_crossing(made, over, trials, weights, sampled)


def drawn_stations(count: int) -> np.ndarray:
    """Return how often each of `count` stations is in samples of as many, drawn anew, (REPLICATES, count)."""
    return np.random.default_rng(0).multinomial(count, np.full(count, 1 / count), REPLICATES)


def _fitted(
    levels: np.ndarray, over: np.ndarray, trials: np.ndarray, weights: np.ndarray, sampled: bool
) -> dict[str, Any]:
    """Both curves with their intervals, and median, dispersion and misfit of the lognormal, by the names of fields."""
    fit = fit_lognormal(levels, over.sum(axis=0)[None], trials.sum(axis=0)[None])
    again = fit_lognormal(levels, weights @ over, weights @ trials, fit)
    empirical, lognormal = _empirical(over, trials, sampled), fit.probability(levels)[0]
    ends = ndtr(_interval(_deviates(levels, fit), _deviates(levels, again), len(over)))
    known = trials.sum(axis=0) >= 1
    return dict(zip(CURVES, (*empirical, lognormal, *ends), strict=True)) | {
        "median": float(fit.median[0]),
        "interval": _median_interval(fit.median, again.median, len(over)),
        "dispersion": float(fit.dispersion[0]),
        "misfit": float(np.abs(empirical[0] - lognormal)[known].max()),
    }


def _by_crossing(
    made: Fragility, over: np.ndarray, trials: np.ndarray, weights: np.ndarray, sampled: bool
) -> Fragility:
    """The same with the median of the empirical curve; of the rising one next to it where a sample makes it rough."""
    shares = (weights @ over) / (weights @ trials)
    level = made.probability
    if sampled:
        from scipy.optimize import isotonic_regression  # slow to import, and needed here only

        shares = np.array([isotonic_regression(share).x for share in shares])
        level = isotonic_regression(level).x
    crossings = np.array([_crossing(made.levels, share) for share in shares])
    median = _crossing(made.levels, level)
    return replace(made, median=median, interval=_median_interval(np.array([median]), crossings, len(over)))


def _by_station(values: np.ndarray, stations: Sequence[str]) -> np.ndarray:
    names, place = np.unique(np.asarray(stations), return_inverse=True)
    summed = np.zeros((names.size, values.shape[1]))
    np.add.at(summed, place, values)
    return summed


def _empirical(
    over: np.ndarray, trials: np.ndarray, sampled: bool
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Share and its 90 % interval after Jeffreys, for as many independent records as the scatter of stations allows."""
    total, count = trials.sum(axis=0), (trials > 0).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.clip(over.sum(axis=0) / total, 0.0, 1.0)
        scatter = ((over - share * trials) ** 2).sum(axis=0) * count / np.maximum(count - 1, 1) / total**2
        # An estimate may be 0 by chance, and scatter all the same: then half a record in all is taken for its share.
        inner = np.clip(share, 0.5 / count, 1 - 0.5 / count) if sampled else share
        effective = inner * (1 - inner) / scatter
    unanimous = ~np.isfinite(effective) | ((share == 0) | (share == 1)) & (not sampled)
    effective = np.where(unanimous, count, np.clip(effective, 1.0 if sampled else count / 2, total))
    yes, no = share * effective + 0.5, (1 - share) * effective + 0.5
    low = np.where(share == 0, 0.0, betaincinv(yes, no, 0.05))
    return share, low, np.where(share == 1, 1.0, betaincinv(yes, no, 0.95))


def _deviates(levels: np.ndarray, fits: LognormalFits) -> np.ndarray:
    return np.asarray(np.log(levels / fits.median[:, None]) / fits.dispersion[:, None])


def _interval(found: np.ndarray, replicates: np.ndarray, count: int) -> np.ndarray:
    """5 and 95 % quantiles of replicates, (2, k), wider by what few stations hide: Student's law for the normal."""
    wider = (count / (count - 1)) ** 0.5 * stdtrit(count - 1, 0.95) / ndtri(0.95)
    return np.asarray(found + wider * (np.quantile(replicates, [0.05, 0.95], axis=0) - found))


def _median_interval(found: np.ndarray, replicates: np.ndarray, count: int) -> tuple[float, float]:
    low, high = np.exp(_interval(np.log(found), np.log(replicates)[:, None], count))[:, 0]
    return float(low), float(high)


def _crossing(levels: np.ndarray, share: np.ndarray) -> float:
    """The level at which the share first reaches one half, linear in the logarithm; the last one if it never does."""
    above = np.flatnonzero(share >= 0.5)
    if not above.size:
        return float(levels[-1])
    k = int(above[0])
    if k == 0:
        return float(levels[0])
    logs = np.log(levels[k - 1 : k + 1])
    return float(np.exp(np.interp(0.5, share[k - 1 : k + 1], logs)))
