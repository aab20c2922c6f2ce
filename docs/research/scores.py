"""How good probabilities are against what happened, and how well each score is known: by drawing sites anew."""

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

import numpy as np

from docs.research.tier_fit import logistic

T = TypeVar("T")

NINETY = (0.05, 0.95)
"""Levels of a 90 % interval."""
Measure = Callable[[np.ndarray], float]
"""A score of some of the cases, by index, with repeats; nan where they tell none."""


@dataclass(frozen=True)
class ReliabilityClass:
    """Cases whose probability lies between two edges. stated, observed: mean probability and share that overturned.

    low, high: 90 % interval of the share that overturned.
    """

    probability_from: float
    probability_to: float
    rows: np.ndarray
    stated: float
    observed: float
    low: float
    high: float


def resampled(labels: Sequence[object] | np.ndarray, replicates: int) -> list[np.ndarray]:
    """Return indices of the cases of as many labels (n,) as there are, drawn with repetition, `replicates` times.

    All cases of a label (a site, an input motion) are drawn together.
    """
    names, place = np.unique(np.asarray(labels), return_inverse=True)
    rows = [np.flatnonzero(place == k) for k in range(names.size)]
    rng = np.random.default_rng(0)
    return [
        np.concatenate([rows[k] for k in rng.integers(names.size, size=names.size)])
        for _ in range(replicates)
    ]


def interval(
    measure: Measure, draws: Sequence[np.ndarray], levels: tuple[float, float] = NINETY
) -> tuple[float, float]:
    """Return the quantiles of a measure over `draws`, where it tells something; nan where it never does."""
    known = [value for rows in draws if not math.isnan(value := measure(rows))]
    low, high = np.quantile(known, levels) if known else (math.nan, math.nan)
    return float(low), float(high)


def scored(measure: Measure, cases: int, draws: Sequence[np.ndarray]) -> dict[str, Any]:
    """Return a measure of all cases with its 90 % interval, by the names of the columns of a table."""
    low, high = interval(measure, draws)
    return {"value": measure(np.arange(cases)), "value_low": low, "value_high": high}


def of_cases(measure: Callable[[Sequence[T]], float], cases: Sequence[T]) -> Measure:
    """Return a score of cases as one of their indices."""
    return lambda rows: measure([cases[k] for k in rows])


def reliability(
    probability: np.ndarray, outcomes: np.ndarray, edges: Sequence[float], draws: Sequence[np.ndarray]
) -> Iterator[ReliabilityClass]:
    """Yield the classes of a reliability diagram that hold a case. outcomes: (n,) in [0, 1]."""
    place = np.clip(np.searchsorted(edges, probability, side="right") - 1, 0, len(edges) - 2)

    def observed(rows: np.ndarray) -> float:
        inside = rows[place[rows] == which]
        return float(outcomes[inside].mean()) if inside.size else math.nan

    for which in np.unique(place).tolist():
        rows = np.flatnonzero(place == which)
        stated, share = float(probability[rows].mean()), float(outcomes[rows].mean())
        low, high = interval(observed, draws)
        yield ReliabilityClass(edges[which], edges[which + 1], rows, stated, share, low, high)


def accuracy(probability: np.ndarray, outcomes: np.ndarray) -> float:
    """Share of cases whose verdict, overturning where P > 1/2, is right."""
    return float(np.mean((probability > 0.5) == outcomes))


def brier(probability: np.ndarray, shares: np.ndarray) -> float:
    """Mean of (P − outcome)², 0 at best; of a share in [0, 1], over the outcomes that it sums up."""
    return float(np.mean((probability - shares) ** 2 + shares * (1 - shares)))


def brier_skill(probability: np.ndarray, shares: np.ndarray) -> float:
    """1 − Brier score over that of who says the mean share of every case; nan where nothing or everything overturns."""
    base = shares.mean()
    return 1 - brier(probability, shares) / float(base * (1 - base)) if 0 < base < 1 else math.nan


def calibration_slope(probability: np.ndarray, outcomes: np.ndarray) -> float:
    """Slope of the least-squares line of the outcomes over P; 1 where P means what it says, nan for a constant P."""
    centred = probability - probability.mean()
    spread = float(centred @ centred)
    return float(centred @ outcomes / spread) if spread > 0 else math.nan


def logit_slope(odds: np.ndarray, outcomes: np.ndarray) -> float:
    """Slope of the logistic regression of the outcomes, or shares, on the log odds said (Cox 1958); 1 is right."""
    kept = np.clip(odds, -12, 12)
    coefficients, _ = logistic(np.column_stack([np.ones(kept.size), kept]), outcomes, np.arange(kept.size))
    return float(coefficients[1])
