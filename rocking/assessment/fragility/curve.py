"""The fragility curve that outcomes tell: empirical and lognormal, with intervals by station."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.special import betaincinv, erfcx, ndtr, stdtrit

if TYPE_CHECKING:
    from matplotlib.axes import Axes

REPLICATES = 1000
CURVES = tuple(f"{law}{end}" for law in ("probability", "lognormal") for end in ("", "_low", "_high"))
"""What stands at every level, by the names of fields and of columns."""
DISPERSIONS = (0.02, 3.0)
"""Between which a dispersion is sought: outcomes that a level parts cleanly would fit ever smaller ones."""
_MOST_STEPS = 100
_SETTLED = 1e-9
_FARTHEST = 8.0
"""Standard deviations beyond which a probability is 0 or 1 to double precision."""


@dataclass(frozen=True, eq=False, repr=False)
class Fragility:
    """P(rotation ratio > threshold | intensity) of one structure; the threshold inf is overturning.

    measure, unit: of the intensity. levels: (k,). probability, probability_low, probability_high: (k,) the empirical
    curve, each station with the same weight, and its 90 % interval, point by point; nan where nothing was tried.
    median, interval: level at which the rising curve next to the empirical one crosses one half, and its 90 % interval;
    inf where it does not reach one half. exceedance: (r, k) share of each record's members above the threshold.
    stations: (r,) what counts as one independent record. lognormal_median, dispersion: the two parameters of the
    lognormal curve, by maximum likelihood. lognormal, lognormal_low, lognormal_high: (k,) that curve and its 90 %
    interval, which is too narrow: on real stations it covers 82 to 87 %, as fragilities are not lognormal.
    misfit: largest distance of the lognormal from the empirical curve.

    >>> records = rocking.read("records/20161113_110259_WTMC_20.V2A")[:2]
    >>> curve = rocking.fragility(records, rocking.Block(2.0, 0.2), stations=["a", "b"], levels=[0.2, 0.6, 1.0])
    >>> (curve.measure, curve.levels.tolist(), curve.probability.tolist())
    ('pgv', [0.2, 0.6, 1.0], [0.0, 0.0, 1.0])
    """

    measure: str
    unit: str
    threshold: float
    levels: np.ndarray
    probability: np.ndarray
    probability_low: np.ndarray
    probability_high: np.ndarray
    median: float
    interval: tuple[float, float]
    lognormal: np.ndarray
    lognormal_low: np.ndarray
    lognormal_high: np.ndarray
    lognormal_median: float
    dispersion: float
    misfit: float
    exceedance: np.ndarray
    stations: tuple[str, ...]

    def __repr__(self) -> str:
        low, high = self.interval
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"<Fragility: median {self.measure} {self.median:.3g}{unit} (90 %: {low:.3g} to {high:.3g}), "
            f"{len(self.stations)} records of {self.independent} stations>"
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
) -> Fragility:
    """Return the curve of outcomes at `levels` (k,) > 0, ascending.

    exceedance: (r, k) shares in [0, 1], one row a record. tried: (r, k) 1 where a record was tried, all by default.
    stations: (r,) names; the records of one are resampled together and weigh as much as one.

    >>> outcomes = np.array([[0, 0, 1, 1], [0, 1, 1, 1], [0, 0, 0, 1]])
    >>> round(fragility_of(np.array([0.1, 0.2, 0.4, 0.8]), outcomes, ["A", "B", "C"]).median, 3)
    0.283
    """
    tried = np.ones_like(exceedance, dtype=float) if tried is None else tried
    over, trials = _by_station(exceedance * tried, stations), _by_station(tried, stations)
    weights = drawn_stations(len(over))
    probability, low, high = _empirical(over, trials)
    fit = fit_lognormal(levels, over.sum(axis=0)[None], trials.sum(axis=0)[None])
    again = fit_lognormal(levels, weights @ over, weights @ trials, fit)
    deviates, resampled = (np.log(levels / f.median[:, None]) / f.dispersion[:, None] for f in (fit, again))
    lognormal_low, lognormal_high = ndtr(_quantiles(resampled, len(over)))
    lognormal = ndtr(deviates[0])
    crossings = np.array([_crossing(levels, w @ over, w @ trials) for w in weights])
    ends = _quantiles(crossings, len(over))
    return Fragility(
        measure=measure,
        unit=unit,
        threshold=threshold,
        levels=levels,
        probability=probability,
        probability_low=low,
        probability_high=high,
        median=_crossing(levels, over.sum(axis=0), trials.sum(axis=0)),
        interval=(float(ends[0]), float(ends[1])),
        lognormal=lognormal,
        lognormal_low=lognormal_low,
        lognormal_high=lognormal_high,
        lognormal_median=float(fit.median[0]),
        dispersion=float(fit.dispersion[0]),
        misfit=float(np.nanmax(np.abs(probability - lognormal))),
        exceedance=exceedance,
        stations=tuple(stations),
    )


def drawn_stations(count: int) -> np.ndarray:
    """Return how often each of `count` stations is in samples of as many, drawn anew, (REPLICATES, count)."""
    return np.random.default_rng(0).multinomial(count, np.full(count, 1 / count), REPLICATES)


def _by_station(values: np.ndarray, stations: Sequence[str]) -> np.ndarray:
    """The mean over the records of each station, (s, k)."""
    names, place, records = np.unique(np.asarray(stations), return_inverse=True, return_counts=True)
    summed = np.zeros((names.size, values.shape[1]))
    np.add.at(summed, place, values)
    return summed / records[:, None]


def _empirical(over: np.ndarray, trials: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Share and its 90 % interval after Jeffreys, for as many independent records as the scatter of stations allows."""
    total, count = trials.sum(axis=0), (trials > 0).sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.clip(over.sum(axis=0) / total, 0.0, 1.0)
        scatter = ((over - share * trials) ** 2).sum(axis=0) * count / np.maximum(count - 1, 1) / total**2
        effective = share * (1 - share) / scatter
    unanimous = ~np.isfinite(effective) | (share == 0) | (share == 1)
    effective = np.where(unanimous, count, np.clip(effective, count / 2, 2 * count))
    yes, no = share * effective + 0.5, (1 - share) * effective + 0.5
    low = np.where(share == 0, 0.0, betaincinv(yes, no, 0.05))
    return share, low, np.where(share == 1, 1.0, betaincinv(yes, no, 0.95))


def _quantiles(replicates: np.ndarray, count: int) -> np.ndarray:
    """The ends of a 90 % interval from replicates (b, ...) over `count` stations.

    The quantiles lie farther out than 5 and 95 %, by what the scatter of few stations hides: the expanded percentile
    interval of Hesterberg (2015), What teachers should know about the bootstrap, Am. Stat. 69, 371-386.
    """
    tail = ndtr(-((count / (count - 1)) ** 0.5) * stdtrit(count - 1, 0.95))
    ordered = np.sort(replicates, axis=0)
    outer = int(np.floor(tail * (len(ordered) - 1)))
    return ordered[[outer, -1 - outer]]


def _crossing(levels: np.ndarray, over: np.ndarray, trials: np.ndarray) -> float:
    """The level at which the rising curve nearest to over/trials (k,) crosses one half, linear in the logarithm.

    Where the curve is one half over a range, the middle of it; the first level where all lie above, inf where all lie
    below.
    """
    known = trials > 0
    # The isotonic fit exceeds one half beyond the minimum of the running sum of what it exceeds it by.
    below = np.concatenate([[0.0], np.cumsum((over - 0.5 * trials)[known])])
    least = np.flatnonzero(below <= below.min() + 1e-12 * np.abs(below).max())
    places = np.array([_between(levels[known], over[known], trials[known], int(k)) for k in least[[0, -1]]])
    return float(np.exp(places.mean()))


def _between(levels: np.ndarray, over: np.ndarray, trials: np.ndarray, first: int) -> float:
    """Logarithm of the level at which the rising curve passes one half before the place `first`."""
    if first == 0:
        return float(np.log(levels[0]))
    if first == levels.size:
        return float("inf")
    ahead = np.cumsum(over[first:]) / np.cumsum(trials[first:])
    behind = np.cumsum(over[first - 1 :: -1]) / np.cumsum(trials[first - 1 :: -1])
    above, below = float(ahead.min()), float(behind.max())
    share = (0.5 - below) / (above - below) if above > below else 0.5
    low, high = np.log(levels[first - 1 : first + 1])
    return float(low + share * (high - low))


class LognormalFits(NamedTuple):
    """P = Φ(ln(IM/median)/dispersion). median, dispersion: (b,)."""

    median: np.ndarray
    dispersion: np.ndarray


def fit_lognormal(
    levels: np.ndarray, overturned: np.ndarray, tried: np.ndarray, near: LognormalFits | None = None
) -> LognormalFits:
    """Fit b lognormal curves at once by maximum likelihood, with Fisher scoring.

    levels: (k,) > 0, at least two. overturned, tried: (b, k) how many overturned, fractions allowed, of how many tried
    at each level. near: one fit that all will be near to, which saves steps. Where all or none overturn the median lies
    at the edge of what the levels can tell.
    """
    logs = np.log(levels)
    middle, spread = float(logs.mean()), float(logs.std())
    z = (logs - middle) / spread
    steepest, flattest = spread / DISPERSIONS[0], spread / DISPERSIONS[1]
    a, b = np.zeros(len(tried)), np.ones(len(tried))
    if near is not None:
        b = np.clip(spread / np.broadcast_to(near.dispersion, len(tried)), flattest, steepest)
        a = (middle - np.log(near.median)) / spread * b
    moving = np.arange(len(tried))
    for _ in range(_MOST_STEPS):
        step_a, step_b = _step(z, overturned[moving], tried[moving], a[moving], b[moving])
        size = np.abs(step_a) + np.abs(step_b)
        short = np.minimum(1.0, 2.0 / np.maximum(size, 1e-300))  # two deviations at a time, lest it overshoot
        b[moving] = np.clip(b[moving] + short * step_b, flattest, steepest)
        most = _FARTHEST * np.maximum(b[moving], 1)
        a[moving] = np.clip(a[moving] + short * step_a, -most, most)
        moving = moving[size > _SETTLED]
        if not moving.size:
            break
    dispersion = spread / b
    return LognormalFits(np.exp(middle - a * dispersion), dispersion)


def _step(
    z: np.ndarray, overturned: np.ndarray, tried: np.ndarray, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    eta = np.clip(a[:, None] + b[:, None] * z, -_FARTHEST, _FARTHEST)
    # The normal density over Φ(η) and over Φ(−η).
    above, below = (np.sqrt(2 / np.pi) / erfcx(sign * eta / np.sqrt(2)) for sign in (-1, 1))
    slope = overturned * above - (tried - overturned) * below
    weight = tried * above * below
    g0, g1 = slope.sum(axis=1), (slope * z).sum(axis=1)
    tiny = 1e-9 * np.maximum(tried.sum(axis=1), 1.0)
    h00, h01, h11 = weight.sum(axis=1) + tiny, (weight * z).sum(axis=1), (weight * z**2).sum(axis=1) + tiny
    determinant = h00 * h11 - h01**2
    return (h11 * g0 - h01 * g1) / determinant, (h00 * g1 - h01 * g0) / determinant
