"""Weights of candidate structures from tests that ended yes or no: a mixing distribution by maximum likelihood.

Each test meets one structure drawn from an unknown population: a specimen set up anew never stands quite the same. With
o_tj whether candidate j overturns in test t, w_j its share of the population and ε the share of outcomes that no
candidate explains,

    P_t = (1 − ε) Σ_j w_j o_tj + ε/2 ,

and w maximises the likelihood of the outcomes (Kiefer & Wolfowitz 1956), by the steps of expectation and maximisation
(Laird 1978). The maximum itself sits on few candidates and is too sure of them; stopped early, the weights stay spread.
Where to stop, and ε, are chosen on groups of tests that take no part in the fit (the same input motion, scaled).
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

ITERATIONS = (10, 20, 40, 80)
"""Numbers of steps among which the fit chooses."""
UNEXPLAINED = (0.02, 0.05, 0.1)
"""Values of ε among which the fit chooses."""
FOLDS = 10
"""Parts into which the groups are dealt for that choice."""


@dataclass(frozen=True, eq=False)
class Mixture:
    """weights: (m,) of the candidates, summing to 1. unexplained: ε. iterations: steps taken.

    log_score: mean ln P of the outcomes that took no part in the fit, at the choice made.
    """

    weights: np.ndarray
    unexplained: float
    iterations: int
    log_score: float

    def probability(self, overturns: np.ndarray) -> np.ndarray:
        """P of overturning, (n,), of tests whose verdicts by candidate are `overturns`, (n, m)."""
        return with_unexplained(overturns @ self.weights, self.unexplained)


def with_unexplained(share: np.ndarray, unexplained: float) -> np.ndarray:
    """(1 − ε) share + ε/2."""
    return (1 - unexplained) * share + unexplained / 2


def fit_mixture(overturns: np.ndarray, outcomes: np.ndarray, groups: Sequence[str]) -> Mixture:
    """Return the mixture of the candidates that explains the outcomes, its two settings chosen by groups left out.

    overturns: (n, m) whether candidate j overturns in test t. outcomes: (n,) whether it did. groups: (n,) labels; with
    fewer than two groups the middle settings are taken.
    """
    patterns, owner, prior = _patterns(overturns)
    score = _log_scores(patterns, prior, outcomes, np.asarray(groups))
    best = max(score, key=lambda key: score[key])
    unexplained, iterations = best
    *_, weights = _weights(patterns, prior, outcomes, unexplained, (iterations,))
    shared = weights[owner] / np.bincount(owner)[owner]
    return Mixture(shared, unexplained, iterations, score[best])


def equal_members(overturns: np.ndarray, weights: np.ndarray, count: int) -> np.ndarray:
    """Return `count` candidates whose plain share of overturnings is nearest to the weighted share, test by test.

    Greedy: each next member is the one that brings the mean of those chosen nearest to the target; one may be chosen
    twice. overturns: (n, m), of the tests of the fit.
    """
    table = overturns.astype(np.float64)
    allowed = np.flatnonzero(weights > weights.max() * 1e-3)
    table = table[:, allowed]
    target, chosen, total = overturns @ weights, [], np.zeros(len(table))
    squares = (table**2).sum(axis=0)
    for size in range(1, count + 1):
        gap = size * target - total
        nearest = int(np.argmin(squares - 2 * (gap @ table)))
        chosen.append(allowed[nearest])
        total += table[:, nearest]
    return np.array(chosen)


def _log_scores(
    patterns: np.ndarray, prior: np.ndarray, outcomes: np.ndarray, groups: np.ndarray
) -> dict[tuple[float, int], float]:
    """Mean ln P of the outcomes of the groups left out, by (ε, steps)."""
    _, place = np.unique(groups, return_inverse=True)
    fold = place % FOLDS
    if place.max(initial=0) == 0:
        return {(UNEXPLAINED[len(UNEXPLAINED) // 2], ITERATIONS[len(ITERATIONS) // 2]): float("nan")}
    total = {(each, steps): 0.0 for each in UNEXPLAINED for steps in ITERATIONS}
    for out in np.unique(fold):
        left, kept = fold == out, fold != out
        for unexplained in UNEXPLAINED:
            found = _weights(patterns[kept], prior, outcomes[kept], unexplained, ITERATIONS)
            for steps, weights in zip(ITERATIONS, found, strict=True):
                probability = with_unexplained(patterns[left] @ weights, unexplained)
                total[unexplained, steps] += float(
                    np.log(np.where(outcomes[left], probability, 1 - probability)).sum()
                )
    return {key: value / outcomes.size for key, value in total.items()}


def _patterns(overturns: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distinct columns of the table, which of them each candidate has, and their prior shares."""
    packed = np.packbits(overturns.astype(bool), axis=0)
    _, first, owner, count = np.unique(
        packed, axis=1, return_index=True, return_inverse=True, return_counts=True
    )
    return overturns[:, first].astype(np.float32), owner.ravel(), (count / count.sum()).astype(np.float32)


def _weights(
    patterns: np.ndarray,
    prior: np.ndarray,
    outcomes: np.ndarray,
    unexplained: float,
    iterations: Sequence[int],
) -> Iterator[np.ndarray]:
    """Yield the weights after each of the rising numbers of steps, from the prior on."""
    telling = patterns.min(axis=1) != patterns.max(axis=1)
    rows = patterns[telling]
    likelihood = with_unexplained(np.where(outcomes[telling, None], rows, 1 - rows), unexplained).astype(
        np.float32
    )
    weights, done = prior.copy(), 0
    for steps in iterations:
        for _ in range(steps - done if len(likelihood) else 0):
            weights *= ((1 / (likelihood @ weights)) @ likelihood) / len(likelihood)
        done = steps
        yield weights / weights.sum()
