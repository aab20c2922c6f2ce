"""Does the 90 % interval of an annual rate hold the truth, how far does it reach, and how far must any reach?

Stations are drawn from populations and from real sites on which the interval was not chosen. Of a population, the
truth is the mean rate of very many stations; of real sites, that of all of them at every level, from which few are
drawn with repetition. Those drawn are followed up to the largest factor of a study, as far as a study goes: where too
few of them reach the level at which half of the rate is made, no rate is told, and the two ends are scored by
themselves.
"""

import math
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Protocol

import numpy as np
from scipy.special import ndtri

from docs.research import scores
from docs.research.fragilities import RealSites, real_sites
from docs.research.report import Target
from rocking.earthquakes.sample import ClusterSample
from rocking.fragility.hazard import AnnualRate, Hazard, annual_rate, rate_interval

SLOPES = (1.5, 2.5, 3.5)
"""Of the logarithm of the hazard over that of the level, downwards."""
STATIONS = (8, 12, 20, 35)
"""Drawn for one interval."""
TRIALS = 2000
"""Intervals of each population, slope and number of stations."""
REAL_TRIALS = 400
"""Of each structure at real sites."""
MANY = 4_000_000
"""Stations whose mean is the truth of a population."""
DISPERSIONS = (0.3, 0.4, 0.5, 0.7)
"""Of the lognormals for which the least reach is told."""


class Draw(Protocol):
    """Rates (n,) of so many stations under a hazard of a slope that is 1 at the level 1."""

    def __call__(self, rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
        """Return the rates (count,)."""


def cover_rate(target: Target) -> None:
    """Score the interval of the rate on populations and on real sites that no part of it was chosen on."""
    rows: list[scores.Score] = list(bounds())
    for name, draw in POPULATIONS.items():
        rng = np.random.default_rng(17)
        for slope in SLOPES:
            rows += interval_scores(name, slope, draw(rng, MANY, slope).mean(), partial(draw, slope=slope))
        target.tell(name)
    for name, pool in real_sites(target):
        for slope in SLOPES:
            rows += study_scores(f"{name}, {pool.sample.count} real sites", slope, pool)
        target.tell(name)
    subtitle = f"{TRIALS} intervals each, {REAL_TRIALS} of real sites; slope: of the logarithm of the hazard."
    target.publish("What the interval of an annual rate covers", subtitle, {scores.Score: rows})


def interval_scores(
    subject: str, slope: float, truth: float, draw: Callable[[np.random.Generator, int], np.ndarray]
) -> Iterator[scores.Score]:
    """Yield coverage, misses to either side and reach at each number of stations. truth: rate of all stations."""
    for count in STATIONS:
        rng = np.random.default_rng(count)
        drawn = [draw(rng, count) for _ in range(TRIALS)]
        sample = ClusterSample.scattered(list(map(str, range(count))))
        low, high = np.array([rate_interval(row, sample) for row in drawn]).T
        rate = np.array([row.mean() for row in drawn])
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.where(rate > 0, np.maximum(high, rate) / rate, np.nan)
        measures: dict[str, scores.Measured] = {
            "intervals that hold the rate": (low <= truth) & (truth <= high),
            "rate above the interval": truth > high,
            "rate below the interval": truth < low,
            "high end over rate": scores.mean(reach, np.median),
        }
        yield from scores.scored(subject, f"slope {slope:g}, {count} stations", measures, range(TRIALS), 200)


def study_scores(subject: str, slope: float, pool: RealSites) -> Iterator[scores.Score]:
    """Yield how often a rate is told at each number of real sites, and what the intervals and the two ends hold."""
    hazard = hazard_of(pool.levels, slope)
    truth = float(rates_of_sites(pool.levels, pool.curves, slope).mean())
    for count in STATIONS:
        rng = np.random.default_rng(count)
        sample = ClusterSample.scattered(list(map(str, range(count))))
        of_draws = [
            rate_within(pool, rng.integers(0, pool.sample.count, count), sample, hazard)
            for _ in range(REAL_TRIALS)
        ]
        is_stated = np.array([fragility_rate.is_stated for fragility_rate in of_draws])
        holds = np.array(
            [fragility_rate.low <= truth <= fragility_rate.high for fragility_rate in of_draws], dtype=float
        )
        reach = np.array([fragility_rate.high / fragility_rate.value for fragility_rate in of_draws])
        measures: dict[str, scores.Measured] = {
            "rates that are told": is_stated,
            "intervals that hold the rate": np.where(is_stated, holds, np.nan),
            "ends that hold the rate where it is not told": np.where(is_stated, np.nan, holds),
            "high end over rate": scores.mean(reach, np.median),
        }
        yield from scores.scored(
            subject, f"slope {slope:g}, {count} stations", measures, range(REAL_TRIALS), 200
        )


def rate_within(pool: RealSites, places: np.ndarray, sample: ClusterSample, hazard: Hazard) -> AnnualRate:
    """Return the rate that a study tells by the real sites at `places` (n,), which are the stations of a sample."""
    curves = pool.within[places]
    tried = np.isfinite(curves)
    with np.errstate(invalid="ignore"):
        probability = np.nansum(curves, axis=0) / tried.sum(axis=0)
    return annual_rate(pool.levels, probability, curves, sample, hazard)


def hazard_of(levels: np.ndarray, slope: float) -> Hazard:
    """Return the hazard of one slope, from half of the first level to twice the last."""
    ends = levels[[0, -1]] * np.array([0.5, 2.0])
    return Hazard(ends, (ends / ends[0]) ** -slope)


def bounds() -> Iterator[scores.Score]:
    """Yield the least reach of any interval, at each number of stations of lognormals."""
    for dispersion in DISPERSIONS:
        for slope in SLOPES:
            for count in STATIONS:
                for known in (False, True):
                    reach = least_reach(slope, dispersion, count, dispersion_is_known=known)
                    words = "known" if known else "unknown"
                    yield scores.Score(
                        subject=f"lognormal, β {dispersion:g}",
                        part=f"slope {slope:g}, {count} stations",
                        measure=f"least high end over rate, β {words}",
                        value=reach,
                        value_low=reach,
                        value_high=reach,
                        sites=count,
                        earthquakes=count,
                        cases=count,
                    )


def least_reach(
    slope: float, dispersion: float, stations: int, *, dispersion_is_known: bool = False
) -> float:
    """Return high end over rate of an interval of 90 % with equal tails that loses no information.

    Levels are lognormal with σ = dispersion, and each station tells its own. The logarithm of the rate is
    −kμ + k²σ²/2, and the information of n stations on (μ, σ²) is n/σ² and n/(2σ⁴), so that no unbiased estimate of it
    varies by less than (k²σ² + k⁴σ⁴/2)/n (Cramér and Rao), and by less than k²σ²/n where σ is known. What is valid for
    more than lognormals is valid for them, and so does not reach less.
    """
    scatter = (slope * dispersion) ** 2
    variance = scatter if dispersion_is_known else scatter + scatter**2 / 2
    return math.exp(float(ndtri(0.95)) * math.sqrt(variance / stations))


def rates_of_sites(levels: np.ndarray, curves: np.ndarray, slope: float) -> np.ndarray:
    """Return the annual rate (n,) of each site by its curve, (n, k), under a hazard of one slope."""
    hazard = hazard_of(levels, slope)
    alone = ClusterSample.scattered(["alone"])
    return np.array([annual_rate(levels, own, own[None], alone, hazard).value for own in curves])


def _lognormal(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    return (3.0 * np.exp(0.4 * rng.standard_normal(count))) ** -slope


def _gamma(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    """Levels with a tail to the weak side: some stations overturn far below the median."""
    return rng.gamma(9.0, size=count) ** -slope


def _log_logistic(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    """Levels with heavy tails to both sides."""
    return np.exp(-0.2 * slope * rng.logistic(size=count))


def _one_in_three_stronger(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    stronger = rng.random(count) < 1 / 3
    return (np.where(stronger, 2.0, 1.0) * np.exp(0.25 * rng.standard_normal(count))) ** -slope


def _one_in_ten_weaker(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    weaker = rng.random(count) < 0.1
    return (np.where(weaker, 0.6, 1.0) * np.exp(0.4 * rng.standard_normal(count))) ** -slope


def _plateau(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    """Three in five stations never overturn."""
    ever = rng.random(count) < 0.4
    return ever * np.exp(0.5 * rng.standard_normal(count)) ** -slope


def _log_uniform(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    """Levels from one half to two, and none beyond."""
    rates: np.ndarray = np.exp(-slope * np.log(2.0) * rng.uniform(-1.0, 1.0, count))
    return rates


def _dip(rng: np.random.Generator, count: int, slope: float) -> np.ndarray:
    """Every second station lets stand again, over a range of levels, what it had overturned."""
    first = 1.5 * np.exp(0.4 * rng.standard_normal(count))
    stands = first * np.exp(rng.uniform(0.05, 0.3, count))
    again = stands * np.exp(rng.uniform(0.2, 0.9, count))
    back = rng.random(count) < 0.5
    return first**-slope - back * (stands**-slope - again**-slope)


POPULATIONS: Mapping[str, Draw] = {
    "lognormal, β 0.4": _lognormal,
    "tail to the weak side": _gamma,
    "heavy tails": _log_logistic,
    "one in three stronger": _one_in_three_stronger,
    "one in ten weaker": _one_in_ten_weaker,
    "a plateau of 0.4": _plateau,
    "none beyond a range": _log_uniform,
    "a dip in every second": _dip,
}
"""None of them was looked at when the interval was chosen."""
