"""Whether the 90 % interval of a fragility's median holds the truth.

Intervals are drawn from real stations, whose truth is the curve of all of them, from which few are drawn with
repetition; and from populations that are no lognormals (two apart, a dip, a plateau below one), whose truth is the
curve of very many.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np

from docs.research import scores, sites
from docs.research.report import Target
from rocking import Block
from rocking.earthquakes.sample import ClusterSample
from rocking.fragility.curves import (
    LARGEST_FACTOR,
    Fragility,
    IncrementalDynamicAnalysis,
    crossing,
    fragility,
    fragility_of,
)

ALL_LEVELS: dict[str, Any] = {"over_cracks": False, "largest_factor": np.inf}
"""Every record at every level with one mechanism, so that truths are known."""
STATIONS = (8, 20, 35)
"""Drawn for one interval."""
TRIALS = 300
"""With an interval."""
ESTIMATES = 20_000
"""Of the median alone, for its bias."""
LEVELS = np.geomspace(0.1, 8.0, 80)
MANY = 2_000_000
"""Stations whose curve is the truth of a population."""
TRIED = ("block R 2 m, 0.12 rad", "wall 1.5 + 1.5 m, 0.4 m", "arch 140°, t/r 0.15")
POPULATIONS = ("lognormal", "two populations", "dip", "plateau of 0.8")
Draw = Callable[[np.random.Generator, int], np.ndarray]
"""Shares that overturn of so many stations at each level, (n, k)."""


def responses_behind(curve: Fragility) -> IncrementalDynamicAnalysis:
    """Return the responses of a curve that `fragility` made, which has them."""
    assert curve.analysis is not None
    return curve.analysis


def median_of(levels: np.ndarray, shares: np.ndarray) -> float:
    """Return the median of a fragility whose stations overturn by `shares` (n, k) at `levels` (k,), nan: not tried."""
    return crossing(levels, np.nansum(shares, axis=0), np.isfinite(shares).sum(axis=0).astype(float))


def cover(target: Target) -> None:
    """Score the median of fragilities whose truth is known: the curve of all real stations, or of a population."""
    rows: list[scores.Score] = []
    for name, pool in real_sites(target):
        whence = f"of {pool.sample.count} real ones"
        truth = pool.curves.mean(axis=0)
        rows += _scores(name, whence, pool.levels, truth, scores.drawn_from(pool.within))
        target.tell(name)
    for name in POPULATIONS:
        rows += population_scores(name)
        target.tell(name)
    subtitle = f"{TRIALS} intervals and {ESTIMATES} medians of each; of real stations the pool is the truth."
    target.publish("What the interval of a fragility's median covers", subtitle, {scores.Score: rows})


@dataclass(frozen=True, eq=False)
class RealSites:
    """A structure at real sites.

    levels: (k,). curves: (s, k) shares that overturn at each site, which are the truth. within: (s, k) the same as far
    as a study takes records, up to LARGEST_FACTOR, and nan beyond. sample: of the sites.
    """

    levels: np.ndarray
    curves: np.ndarray
    within: np.ndarray
    sample: ClusterSample


def real_sites(target: Target) -> Iterator[tuple[str, RealSites]]:
    """Yield the name of each structure tried, and what becomes of it at the real sites."""
    components = list(sites.independent(target.records))
    labels = [component.site for component in components]
    motions = [component.accelerogram for component in components]
    tried = {name: structure for name, structure in sites.structures_tried().items() if name in TRIED}
    for name, structure in {"stone pier, 2 by 9 m": Block.of_size(2.0, 9.0), **tried}.items():
        analysis = responses_behind(
            fragility(motions, structure, stations=labels, contacts=False, **ALL_LEVELS)
        )
        shares = np.isinf(analysis.rotation_ratios).mean(axis=2)
        reached = analysis.factors <= LARGEST_FACTOR
        sample = analysis.sample
        trials = sample.by_station(reached.astype(float))
        with np.errstate(invalid="ignore"):
            within = sample.by_station(np.where(reached, shares, 0.0)) / trials
        yield (
            name,
            RealSites(
                analysis.levels, sample.by_station(shares), within, sample.part(np.arange(sample.count))
            ),
        )


def population_scores(name: str) -> Iterator[scores.Score]:
    """Yield the scores of one of POPULATIONS."""
    rng, draw = np.random.default_rng(99), partial(population_shares, name)
    truth = np.mean([draw(rng, 10_000).mean(axis=0) for _ in range(MANY // 10_000)], axis=0)
    yield from _scores(name, "drawn", LEVELS, truth, draw)


def _scores(
    name: str, whence: str, levels: np.ndarray, curve: np.ndarray, draw: Draw
) -> Iterator[scores.Score]:
    """Coverage of the interval and bias of the median, at each number of stations. curve: (k,) of all of them."""
    truth = median_of(levels, curve[None])
    for count in STATIONS:
        rng, names = np.random.default_rng(count), ClusterSample.scattered(list(map(str, range(count))))
        over = np.array([median_of(levels, draw(rng, count)) for _ in range(ESTIMATES)]) / truth
        ends = [fragility_of(levels, draw(rng, count), names).interval for _ in range(TRIALS)]
        covers = [low <= truth <= high for low, high in ends]
        bias = {"bias of the median": bias_of(over)}
        part = f"{count} stations {whence}"
        yield from scores.scored(name, part, {"intervals that hold the median": covers}, range(TRIALS))
        yield from scores.scored(name, part, bias, range(ESTIMATES), replicates=200)


def bias_of(over: np.ndarray) -> scores.Measure:
    """Return the bias of medians (n,) over their truth, as a measure."""
    return lambda rows: float(np.median(over[rows])) - 1


def population_shares(name: str, rng: np.random.Generator, count: int) -> np.ndarray:
    """Draw `count` stations of one of POPULATIONS; return the shares that overturn at LEVELS, (n, k)."""
    if name == "two populations":
        middle = np.where(rng.random((count, 1)) < 0.5, -0.45, 0.7)
        return (np.exp(middle + 0.25 * rng.standard_normal((count, 1))) < LEVELS).astype(float)
    first = np.exp(0.5 * rng.standard_normal((count, 1)))
    overturns = first < LEVELS
    if name == "dip":  # half of the stations let stand again, over a range, what they had overturned
        stands = first * np.exp(rng.uniform(0.1, 0.5, (count, 1)))
        again = stands * np.exp(rng.uniform(0.1, 0.6, (count, 1)))
        back = rng.random((count, 1)) < 0.5
        overturns &= ~(back & (stands < LEVELS) & (again > LEVELS))
    if name == "plateau of 0.8":
        overturns &= rng.random((count, 1)) < 0.8
    return overturns.astype(float)
