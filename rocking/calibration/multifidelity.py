"""What few runs of the mechanism buy, measured: samples of a fragility held against the answer of all runs."""

from collections.abc import Iterator
from dataclasses import asdict, dataclass

import numpy as np

from rocking.assessment.fragility.lognormal import fit_lognormal
from rocking.assessment.fragility.multifidelity import corrected, inclusion, systematic_draw
from rocking.assessment.fragility.settings import FEWEST_RUNS
from rocking.assessment.rows.of_trade import MultiFidelityRow

REPEATS = 200
SHARES = (1 / 28, 1 / 14, 1 / 7)
"""Of all cases in which the mechanism is followed: 100, 200 and 400 of 70 components at 40 levels."""
_OPEN = 0.1, 0.9
"""Probabilities between which the curve is open."""


@dataclass(frozen=True, eq=False)
class Answers:
    """Who overturns, (r, k) at levels (k,), by each method; cpu: of one run of mechanism and of block, s."""

    levels: np.ndarray
    mechanism: np.ndarray
    block: np.ndarray
    sine: np.ndarray
    mechanism_cpu: float
    block_cpu: float


@dataclass(frozen=True, eq=False)
class Spread:
    """Of samples about the answer of all runs: 90 % widths, and biases over them."""

    curve_width: float
    curve_bias: float
    median_width: float
    median_bias: float


def multi_fidelity_rows(structure: str, answers: Answers) -> Iterator[MultiFidelityRow]:
    """Yield a row for each of SHARES that leaves runs enough."""
    cases = answers.mechanism.size
    dear, cheap = answers.mechanism_cpu, answers.block_cpu
    rng = np.random.default_rng(0)
    records, random = _plain_spreads(answers, rng)
    block, sine = (_correlation(answers, said) for said in (answers.block, answers.sine))
    for runs in (round(share * cases) for share in SHARES):
        if runs < FEWEST_RUNS:
            continue
        found = spread(answers, _sampled(answers, runs, rng))
        curve_gain = _runs_for(found.curve_width, records.curve_width, cases) / runs
        yield MultiFidelityRow(
            structure=structure,
            cases=cases,
            runs=runs,
            repeats=REPEATS,
            **asdict(found),
            curve_gain=curve_gain,
            median_gain=_runs_for(found.median_width, records.median_width, cases) / runs,
            median_gain_cases=_runs_for(found.median_width, random.median_width, cases) / runs,
            correlation_block=block,
            correlation_sine=sine,
            cost_ratio=dear / cheap,
            cpu_gain=curve_gain * runs * dear / (runs * dear + cases * cheap),
            two_level_gain=two_level_gain(block, cheap / dear),
        )


def two_level_gain(correlation: float, cost: float) -> float:
    """Return how many times less control variates cost than plain sampling, at the best share of cheap and dear runs.

    cost: of a cheap run over a dear one. Peherstorfer, Willcox & Gunzburger 2016, SIAM J. Sci. Comput. 38, A3163, of
    two models: as many cheap runs for a dear one as the root of correlation²/((1 − correlation²) cost).
    """
    return 1 / (np.sqrt(1 - correlation**2) + np.sqrt(cost) * abs(correlation)) ** 2


def spread(answers: Answers, curves: np.ndarray) -> Spread:
    """Return how far `curves`, (repeats, k), lie from the answer of all runs."""
    truth = answers.mechanism.mean(axis=0)
    is_open = (truth > _OPEN[0]) & (truth < _OPEN[1])
    medians = np.log(_medians(answers, curves))
    exact = float(np.log(_medians(answers, truth[None])[0]))
    low, high = np.quantile(curves[:, is_open], [0.05, 0.95], axis=0)
    curve_width = float((high - low).mean())
    median_width = float(np.diff(np.quantile(medians, [0.05, 0.95]))[0])
    return Spread(
        curve_width,
        float(np.abs(curves.mean(axis=0) - truth)[is_open].mean()) / curve_width,
        median_width,
        abs(float(medians.mean()) - exact) / median_width,
    )


def _sampled(answers: Answers, runs: int, rng: np.random.Generator) -> np.ndarray:
    chance = inclusion(answers.levels, answers.block, runs)
    draws = (systematic_draw(chance, rng) for _ in range(REPEATS))
    known = answers.levels, answers.block
    return np.array([corrected(*known, drawn, answers.mechanism, chance).mean(axis=0) for drawn in draws])


def _plain_spreads(answers: Answers, rng: np.random.Generator) -> tuple[Spread, Spread]:
    """Without the block, in half of all cases: half of the records at all levels, and other ones at each level."""
    outcomes, some = answers.mechanism, len(answers.mechanism) // 2
    records = np.array([outcomes[rng.permutation(len(outcomes))[:some]].mean(axis=0) for _ in range(REPEATS)])
    places = (rng.random(outcomes.shape).argsort(axis=0)[:some] for _ in range(REPEATS))
    random = np.array([np.take_along_axis(outcomes, place, axis=0).mean(axis=0) for place in places])
    return spread(answers, records), spread(answers, random)


def _medians(answers: Answers, curves: np.ndarray) -> np.ndarray:
    """Of the fitted lognormals."""
    tried = np.full_like(curves, float(len(answers.mechanism)))
    return fit_lognormal(answers.levels, curves * tried, tried).median


def _runs_for(width: float, of_half: float, cases: int) -> float:
    """Runs that give `width` where half of all give `of_half`: its square goes with 1/runs − 1/cases."""
    return 1 / ((width / of_half) ** 2 / cases + 1 / cases)


def _correlation(answers: Answers, said: np.ndarray) -> float:
    """Of overturning at the same level, mean of the levels where the curve is open."""
    share = answers.mechanism.mean(axis=0)
    found = []
    for level in np.flatnonzero((share > _OPEN[0]) & (share < _OPEN[1])):
        one, other = answers.mechanism[:, level], said[:, level]
        found.append(float(np.corrcoef(one, other)[0, 1]) if np.ptp(other) > 0 else 0.0)
    return float(np.mean(found)) if found else float("nan")
