"""Does the 90 % interval of a fragility's median hold the truth? Drawn from real stations, and from known populations.

Of real stations the truth is the curve of all of them, from which few are drawn with repetition; of populations that
are no lognormals (two apart, a dip, a plateau below one) it is the curve of very many.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np

from docs.research import scores
from docs.research.fragilities import median_of
from docs.research.report import publish
from docs.research.scores import Score
from docs.research.sites import independent, structures_tried
from rocking.assessment.fragility import fragility_of, incremental_dynamic_analysis
from rocking.records import Accelerogram
from rocking.structures import Block, Structure

STATIONS = (8, 20, 35)
TRIALS = 800
"""With an interval."""
ESTIMATES = 20_000
"""Of the median alone, for its bias."""
LEVELS = np.geomspace(0.1, 8.0, 80)
MANY = 2_000_000
"""Stations whose curve is the truth of a population."""
TRIED = ("block R 2 m, 0.12 rad", "wall 1.5 + 1.5 m, 0.4 m", "arch 140°, t/r 0.15")
STRUCTURES: Mapping[str, Structure] = {
    "stone pier, 2 by 9 m": Block.of_size(2.0, 9.0),
    **{name: each for name, each in structures_tried().items() if name in TRIED},
}
Draw = Callable[[np.random.Generator, int], np.ndarray]
"""Shares that overturn of so many stations at each level, (n, k)."""


def write_coverage(
    records: Iterable[tuple[str, Accelerogram]], folder: Path, tell: Callable[[str], None]
) -> None:
    """Write the scores of the median into `folder`; tell: is given a line for each structure and population."""
    counted = [(site, record) for _, site, record in independent(records)]
    found: list[Score] = []
    for name in STRUCTURES:
        found += real_scores(name, counted)
        tell(name)
    for name in POPULATIONS:
        found += population_scores(name)
        tell(name)
    subtitle = f"{TRIALS} intervals and {ESTIMATES} medians of each; of real stations the pool is the truth."
    publish(folder, "What the interval of a fragility's median covers", subtitle, {Score: found})


def real_scores(name: str, records: Sequence[tuple[str, Accelerogram]]) -> Iterator[Score]:
    """Yield the scores of one of STRUCTURES under `records` by site."""
    sites, motions = zip(*records, strict=True)
    analysis = incremental_dynamic_analysis(motions, STRUCTURES[name], stations=sites)
    shares = np.isinf(analysis.rotation_ratios).mean(axis=2)
    pool = np.array([shares[np.array(sites) == site].mean(axis=0) for site in dict.fromkeys(sites)])

    def draw(rng: np.random.Generator, count: int) -> np.ndarray:
        return rng.choice(pool, count)

    yield from _scores(name, f"of {len(pool)} real ones", analysis.levels, pool.mean(axis=0), draw)


def population_scores(name: str) -> Iterator[Score]:
    """Yield the scores of one of POPULATIONS."""
    rng, draw = np.random.default_rng(99), POPULATIONS[name]
    truth = np.mean([draw(rng, 10_000).mean(axis=0) for _ in range(MANY // 10_000)], axis=0)
    yield from _scores(name, "drawn", LEVELS, truth, draw)


def _scores(name: str, whence: str, levels: np.ndarray, curve: np.ndarray, draw: Draw) -> Iterator[Score]:
    """Coverage of the interval and bias of the median, at each number of stations. curve: (k,) of all of them."""
    truth = median_of(levels, curve[None])
    for count in STATIONS:
        rng, names = np.random.default_rng(count), list(map(str, range(count)))
        over = np.array([median_of(levels, draw(rng, count)) for _ in range(ESTIMATES)]) / truth
        ends = [fragility_of(levels, draw(rng, count), names).interval for _ in range(TRIALS)]
        held = scores.mean([low <= truth <= high for low, high in ends])
        bias = {"bias of the median": lambda rows, over=over: float(np.median(over[rows])) - 1}
        part = f"{count} stations {whence}"
        yield from scores.scored(name, part, {"intervals that hold the median": held}, range(TRIALS))
        yield from scores.scored(name, part, bias, range(ESTIMATES), replicates=200)


def _lognormal(rng: np.random.Generator, count: int) -> np.ndarray:
    return (np.exp(0.5 * rng.standard_normal((count, 1))) < LEVELS).astype(float)


def _two_populations(rng: np.random.Generator, count: int) -> np.ndarray:
    middle = np.where(rng.random((count, 1)) < 0.5, -0.45, 0.7)
    return (np.exp(middle + 0.25 * rng.standard_normal((count, 1))) < LEVELS).astype(float)


def _dip(rng: np.random.Generator, count: int) -> np.ndarray:
    """Half of the stations let stand again, over a range, what they had overturned."""
    first = np.exp(0.5 * rng.standard_normal((count, 1)))
    stands = first * np.exp(rng.uniform(0.1, 0.5, (count, 1)))
    again = stands * np.exp(rng.uniform(0.1, 0.6, (count, 1)))
    back = rng.random((count, 1)) < 0.5
    return ((first < LEVELS) & ~(back & (stands < LEVELS) & (again > LEVELS))).astype(float)


def _plateau(rng: np.random.Generator, count: int) -> np.ndarray:
    return _lognormal(rng, count) * (rng.random((count, 1)) < 0.8)


POPULATIONS: dict[str, Draw] = {
    "lognormal": _lognormal,
    "two populations": _two_populations,
    "dip": _dip,
    "plateau of 0.8": _plateau,
}
