"""Do the intervals over earthquakes hold the truth, with few earthquakes and several stations of each?

Earthquakes are drawn, and stations of each: from populations whose truth is that of very many, and from real sites,
whose truth is that of all of them, each earthquake with the same weight. The interval of a median, of an annual rate,
of a share (its upper bound, by which a size is shown to hold; both, of shares over records, the trade and agreement)
and of the structures expected to fall are those of the package; beside them stands what they were when every station
counted as independent.
"""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import numpy as np
from scipy.special import ndtr, ndtri

from docs.research import scores
from docs.research.fragilities import RealSites, median_of, real_sites
from docs.research.rates import hazard_of, rate_within, rates_of_sites
from docs.research.report import Target
from rocking.assessment.rows import interval_of_mean
from rocking.earthquakes.sample import ClusterSample
from rocking.fragility.curves import crossing
from rocking.fragility.hazard import rate_interval

EARTHQUAKES = (2, 4, 8, 16)
STATIONS = (1, 3, 5)
"""Of each earthquake."""
TRIALS = 300
MEDIANS = 40
"""Of these the ones with the interval of a median, which resamples."""
SLOPE = 2.5
"""Of the logarithm of the hazard over that of the level, downwards."""
DISPERSION = 0.4
"""Of the levels at which stations overturn a structure: the standard deviation of the logarithm."""
MANY = 200_000
"""Earthquakes whose stations are the truth of a population."""
STRUCTURES = 50
"""Of a class of which some fall."""
TOLD = "rates that are told"
BOUNDS = "upper bound", "both bounds"
"""The one-sided one of 90 %, and an interval of 90 %."""
_SHARES = (0.1, 0.3)
"""Shares that fall at the level of the bounds."""

Draw = Callable[[np.random.Generator, int, int], np.ndarray]
"""Logarithms (e, m) of the levels at which m stations of each of e earthquakes overturn a structure."""


def cover_earthquakes(target: Target) -> None:
    """Score the intervals on populations and on real sites by how many earthquakes and stations are drawn."""
    rows: list[scores.Score] = []
    for name, draw in POPULATIONS.items():
        rows += made_scores(name, draw)
        target.tell(name)
    for name, pool in real_sites(target):
        rows += real_scores(name, pool)
        target.tell(name)
    subtitle = (
        f"{TRIALS} intervals each; a population with {MANY} earthquakes or the pool of sites is the truth."
    )
    target.publish("What intervals over earthquakes cover", subtitle, {scores.Score: rows})


def sample_of(earthquakes: int, stations: int, alone: bool = False) -> ClusterSample:
    """Return as many stations of each earthquake. alone: as if each station were of another one."""
    names = [f"station {place}" for place in range(earthquakes * stations)]
    events = names if alone else [f"earthquake {place // stations}" for place in range(len(names))]
    return ClusterSample(tuple(names), tuple(events))


def made_scores(name: str, draw: Draw) -> Iterator[scores.Score]:
    """Yield the coverage of each interval for draws from a population."""
    very_many = draw(np.random.default_rng(99), MANY, 2).ravel()
    at_shares = np.quantile(very_many, _SHARES)
    truths = {
        "median": float(np.exp(np.median(very_many))),
        "annual rate": float(np.exp(-SLOPE * very_many).mean()),
        **{f"share of {share:g}, {which}": share for share in _SHARES for which in BOUNDS},
        "expected falls": float(_falls(very_many).mean()),
    }
    for earthquakes in EARTHQUAKES:
        for stations in STATIONS:
            rng = np.random.default_rng([earthquakes, stations])
            drawn = [draw(rng, earthquakes, stations).ravel() for _ in range(TRIALS)]
            for alone in (False, True):
                sample = sample_of(earthquakes, stations, alone)
                held = {measure: np.full(TRIALS, np.nan) for measure in truths}
                for trial, logs in enumerate(drawn):
                    ends = {
                        "annual rate": rate_interval(np.exp(-SLOPE * logs), sample),
                        "expected falls": interval_of_mean(_falls(logs), STRUCTURES, sample),
                    }
                    if trial < MEDIANS and not alone:
                        ends["median"] = sample.interval(partial(weighted_median, np.exp(logs)))
                    for share, level in zip(_SHARES, at_shares, strict=True):
                        ends |= bounds_of(share, (logs < level).astype(float), sample)
                    for measure, (low, high) in ends.items():
                        held[measure][trial] = low <= truths[measure] <= high
                yield from _told(name, earthquakes, stations, alone, held)


def bounds_of(
    share: float, falls: np.ndarray, sample: ClusterSample, tried: np.ndarray | None = None
) -> dict[str, tuple[float, float]]:
    """Return the ends by each of BOUNDS for a share at a level, from what falls at each station, (s,)."""
    upper = sample.share_bounds(falls, 0.1, tried)[1]
    low, high = sample.share_bounds(falls, tried=tried)
    both = {BOUNDS[0]: (0.0, float(upper)), BOUNDS[1]: (float(low), float(high))}
    return {f"share of {share:g}, {which}": ends for which, ends in both.items()}


def real_scores(name: str, pool: RealSites) -> Iterator[scores.Score]:
    """Yield the coverage of each interval for draws from real sites, as far as a study follows them.

    A rate that is not told has the two ends beside it, which are scored by themselves. Shares are those at the levels
    at which so many fall, and the class is of the one structure in strengths that scatter, at the second of them.
    """
    of_station = pool.sample.of_station
    of_events = [np.flatnonzero(of_station == event) for event in range(pool.sample.earthquakes)]
    curve = np.mean([pool.curves[members].mean(axis=0) for members in of_events], axis=0)
    rates = rates_of_sites(pool.levels, pool.curves, SLOPE)
    median = median_of(pool.levels, curve[None])
    rate = float(np.mean([rates[members].mean() for members in of_events]))
    hazard = hazard_of(pool.levels, SLOPE)
    at_shares = {share: int(np.flatnonzero(curve >= share)[0]) for share in _SHARES}
    falls = _falls_of_class(pool, at_shares[_SHARES[-1]])
    mean_falls = float(np.mean([falls[members].mean() for members in of_events]))
    for earthquakes in EARTHQUAKES:
        for stations in STATIONS:
            rng = np.random.default_rng([earthquakes, stations])
            draws = []
            for _ in range(TRIALS):
                again = rng.integers(0, len(of_events), earthquakes)
                draws.append(np.concatenate([rng.choice(of_events[event], stations) for event in again]))
            for alone in (False, True):
                sample = sample_of(earthquakes, stations, alone)
                held = {
                    measure: np.full(TRIALS, np.nan)
                    for measure in (
                        *("median", "annual rate", "ends of a rate that is not told", TOLD),
                        *(f"share of {share:g}, {which}" for share in _SHARES for which in BOUNDS),
                        "expected falls",
                    )
                }
                for trial, places in enumerate(draws):
                    told = rate_within(pool, places, sample, hazard)
                    measure = "annual rate" if told.is_stated else "ends of a rate that is not told"
                    held[TOLD][trial] = told.is_stated
                    held[measure][trial] = told.low <= rate <= told.high
                    for share, level in at_shares.items():
                        own = pool.curves[places, level]
                        for which, (low, high) in bounds_of(share, own, sample).items():
                            held[which][trial] = low <= curve[level] <= high
                    low, high = interval_of_mean(falls[places], STRUCTURES, sample)
                    held["expected falls"][trial] = low <= mean_falls <= high
                    if trial < MEDIANS and not alone:
                        low, high = sample.interval(
                            partial(_weighted_crossing, pool.levels, pool.within[places])
                        )
                        held["median"][trial] = low <= median <= high
                yield from _told(f"{name}, real sites", earthquakes, stations, alone, held)


def weighted_median(values: np.ndarray, weights: np.ndarray) -> float:
    """Return the median of values (n,) above 0 with weights (n,), linear in the logarithm between those beside it."""
    order = np.argsort(values)
    kept = order[weights[order] > 0]
    places = np.cumsum(weights[kept]) - weights[kept] / 2
    return float(np.exp(np.interp(weights[kept].sum() / 2, places, np.log(values[kept]))))


def _weighted_crossing(levels: np.ndarray, curves: np.ndarray, weights: np.ndarray) -> float:
    tried = np.isfinite(curves)
    return crossing(levels, weights @ np.where(tried, curves, 0.0), weights @ tried)


def _falls(logs: np.ndarray) -> np.ndarray:
    """How many structures of a class fall at each station, whose strengths scatter about a level a little stronger."""
    falls: np.ndarray = STRUCTURES * ndtr((-logs - 0.3) / 0.3)
    return falls


def _falls_of_class(pool: RealSites, level: int) -> np.ndarray:
    """How many structures of a class fall at each real site, (s,), where the one of middle strength meets a level."""
    strengths = np.exp(0.3 * ndtri((np.arange(STRUCTURES) + 0.5) / STRUCTURES))
    met = np.log(pool.levels[level] / strengths)
    curves = [np.interp(met, np.log(pool.levels), own, left=0.0) for own in pool.curves]
    falls: np.ndarray = np.sum(curves, axis=1)
    return falls


def _told(
    name: str, earthquakes: int, stations: int, alone: bool, held: Mapping[str, np.ndarray]
) -> Iterator[scores.Score]:
    which = ", stations as if independent" if alone else ""
    part = f"{earthquakes} earthquakes, {stations} stations each{which}"
    measures = {
        measure if measure == TOLD else f"{measure}: intervals that hold it": values
        for measure, values in held.items()
        if not np.isnan(values).all()
    }
    yield from scores.scored(name, part, measures, range(TRIALS), 200)


def _correlated(alike: float, rng: np.random.Generator, earthquakes: int, stations: int) -> np.ndarray:
    """Normal logarithms, of whose variance the part `alike` is that between earthquakes."""
    between = rng.standard_normal((earthquakes, 1))
    within = rng.standard_normal((earthquakes, stations))
    logs: np.ndarray = DISPERSION * (np.sqrt(alike) * between + np.sqrt(1 - alike) * within)
    return logs


def _two_kinds(rng: np.random.Generator, earthquakes: int, stations: int) -> np.ndarray:
    """Three in ten earthquakes need far stronger shaking."""
    stronger = rng.random((earthquakes, 1)) < 0.3
    logs: np.ndarray = np.where(stronger, 0.8, 0.0) + _correlated(0.3, rng, earthquakes, stations)
    return logs


def _weak_side(rng: np.random.Generator, earthquakes: int, stations: int) -> np.ndarray:
    """Earthquakes with a tail to the weak side."""
    between = np.log(rng.gamma(9.0, size=(earthquakes, 1)) / 9.0)
    logs: np.ndarray = 0.7 * between + 0.3 * rng.standard_normal((earthquakes, stations))
    return logs


POPULATIONS: Mapping[str, Draw] = {
    "normal, a fifth between earthquakes": partial(_correlated, 0.2),
    "normal, half between earthquakes": partial(_correlated, 0.5),
    "two kinds of earthquakes": _two_kinds,
    "a tail to the weak side": _weak_side,
}
