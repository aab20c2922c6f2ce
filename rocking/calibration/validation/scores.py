"""How good probabilities of overturning are, against what happened."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

RESAMPLES = 2000
"""Draws of an interval."""
LEVELS = (0.025, 0.975)
"""Of the paired 95 % intervals."""
EDGES = (0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0)
"""Of the classes of a reliability diagram."""


@dataclass(frozen=True)
class ReliabilityClass:
    """Tests whose probability lies in one class. stated, observed: mean probability and share that overturned.

    low, high: 90 % interval of the share that overturned, by resampling motions.
    """

    tests: int
    stated: float
    observed: float
    low: float
    high: float


def accuracy(probability: np.ndarray, outcomes: np.ndarray) -> float:
    """Share of tests whose verdict, overturning where P > 1/2, is right."""
    return float(np.mean((probability > 0.5) == outcomes))


def brier(probability: np.ndarray, outcomes: np.ndarray) -> float:
    """Mean of (P − outcome)², 0 at best."""
    return float(np.mean((probability - outcomes) ** 2))


def calibration_slope(probability: np.ndarray, outcomes: np.ndarray) -> float:
    """Slope of the least-squares line of the outcomes over P; 1 where P means what it says, nan for a constant P."""
    centred = probability - probability.mean()
    spread = float(centred @ centred)
    return float(centred @ outcomes / spread) if spread > 0 else float("nan")


def logit_slope(probability: np.ndarray, outcomes: np.ndarray, limit: float = 0.01) -> float:
    """Slope of the logistic regression of the outcomes on logit P (Cox 1958), P kept `limit` away from 0 and 1."""
    from scipy.optimize import minimize

    kept = np.clip(probability, limit, 1 - limit)
    rows = np.column_stack([np.ones(kept.size), np.log(kept / (1 - kept))])

    def loss(line: np.ndarray) -> float:
        return float(np.logaddexp(0, rows @ line).sum() - outcomes @ (rows @ line))

    return float(minimize(loss, np.array([0.0, 1.0])).x[1])


def interval(
    score: Callable[[np.ndarray], float], motions: Sequence[str], levels: tuple[float, float] = LEVELS
) -> tuple[float, float]:
    """Return quantiles of a score when motions are drawn anew with replacement, all tests of a motion together.

    score: of the indices of the tests drawn, with repeats; nan is left out.
    """
    draw = np.random.default_rng(0)
    names, place = np.unique(np.asarray(motions), return_inverse=True)
    members = [np.flatnonzero(place == k) for k in range(names.size)]
    found = [
        score(np.concatenate([members[k] for k in draw.integers(names.size, size=names.size)]))
        for _ in range(RESAMPLES)
    ]
    low, high = np.nanquantile(found, levels)
    return float(low), float(high)


def reliability(
    probability: np.ndarray, outcomes: np.ndarray, motions: Sequence[str]
) -> list[ReliabilityClass]:
    """Return the classes of a reliability diagram that hold a test."""
    place = np.clip(np.searchsorted(EDGES, probability, side="right") - 1, 0, len(EDGES) - 2)

    def observed(which: int) -> Callable[[np.ndarray], float]:
        def share(rows: np.ndarray) -> float:
            inside = rows[place[rows] == which]
            return float(outcomes[inside].mean()) if inside.size else float("nan")

        return share

    classes = []
    for which in np.unique(place).tolist():
        inside = place == which
        low, high = interval(observed(which), motions, (0.05, 0.95))
        classes.append(
            ReliabilityClass(
                int(inside.sum()),
                float(probability[inside].mean()),
                float(outcomes[inside].mean()),
                low,
                high,
            )
        )
    return classes
