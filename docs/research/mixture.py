"""Weights of candidate structures from tests that ended yes or no: a mixing distribution by maximum likelihood.

Each test meets one structure drawn from an unknown population: a specimen set up anew never stands quite the same. With
o_tj whether candidate j overturns in test t, w_j its share of the population and ε the share of outcomes that no
candidate explains,

    P_t = (1 − ε) Σ_j w_j o_tj + ε/2 ,

and w maximises the likelihood of the outcomes (Kiefer & Wolfowitz 1956), by the steps of expectation and maximisation
(Laird 1978). The maximum itself sits on few candidates and is too sure of them; stopped early, the weights stay spread.
Where to stop, and ε, are chosen on groups of tests that take no part in the fit (the same input motion, scaled). On the
same groups a sharpness b is fitted last, because weights that stay spread are too careful,

    logit P'_t = b logit P_t .
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import expit, logit

ITERATIONS = (10, 20, 40, 80)
"""Numbers of steps among which the fit chooses."""
UNEXPLAINED = (0.02, 0.05, 0.1)
"""Values of ε among which the fit chooses."""
FOLDS = 10
"""Parts into which the groups are dealt for that choice."""
SHARPNESS = (0.5, 2.0)
"""Bounds of b: outcomes that all are as said would have no largest one."""


@dataclass(frozen=True, eq=False)
class Mixture:
    """weights: (m,) of the candidates, summing to 1. unexplained: ε. iterations: steps taken. sharpness: b.

    log_score: mean ln P' of the outcomes that took no part in the fit, at the choice made.
    """

    weights: np.ndarray
    unexplained: float
    iterations: int
    sharpness: float
    log_score: float

    def probability(self, overturns: np.ndarray) -> np.ndarray:
        """P' of overturning, (n,), of tests whose verdicts by candidate are `overturns`, (n, m)."""
        share = with_unexplained(overturns @ self.weights, self.unexplained)
        return expit(self.sharpness * logit(share))


def with_unexplained(share: np.ndarray, unexplained: float | np.ndarray) -> np.ndarray:
    """(1 − ε) share + ε/2."""
    return (1 - unexplained) * share + unexplained / 2


def fit_mixture(overturns: np.ndarray, outcomes: np.ndarray, groups: Sequence[str]) -> Mixture:
    """Return the mixture of the candidates that explains the outcomes, its two settings chosen by groups left out.

    overturns: (n, m) whether candidate j overturns in test t. outcomes: (n,) whether it did. groups: (n,) labels; with
    fewer than two groups the middle settings are taken.
    """
    patterns, owner, prior = _patterns(overturns)
    hits = np.where(outcomes[:, None], patterns, 1 - patterns)
    left_out = _left_out(hits, prior, np.asarray(groups))
    unexplained, iterations = max(left_out, key=lambda choice: np.log(left_out[choice]).mean())
    sharpness, log_score = _sharpened(left_out[unexplained, iterations])
    every = np.ones((len(hits), 1), dtype=np.float32)
    (weights,) = _weights(hits, prior, every, np.array([unexplained]), (iterations,))
    shared = weights[owner, 0] / np.bincount(owner)[owner]
    return Mixture(shared, unexplained, iterations, sharpness, log_score)


def _left_out(
    hits: np.ndarray, prior: np.ndarray, groups: np.ndarray
) -> Mapping[tuple[float, int], np.ndarray]:
    """Return by (ε, steps) the probability of each outcome, (n,), its group left out; nothing known of one group."""
    _, place = np.unique(groups, return_inverse=True)
    if place.max(initial=0) == 0:
        middle = UNEXPLAINED[len(UNEXPLAINED) // 2], ITERATIONS[len(ITERATIONS) // 2]
        return {middle: np.full(len(hits), np.nan)}
    parts = min(FOLDS, int(place.max()) + 1)
    fold = place % parts
    kept = (fold[:, None] != np.arange(parts)).astype(np.float32)
    masks, choices = np.tile(kept, len(UNEXPLAINED)), np.repeat(UNEXPLAINED, parts)
    found = {}
    for steps, weights in zip(ITERATIONS, _weights(hits, prior, masks, choices, ITERATIONS), strict=True):
        said = with_unexplained(hits @ weights, choices).reshape(len(hits), len(UNEXPLAINED), parts)
        for k, unexplained in enumerate(UNEXPLAINED):
            found[unexplained, steps] = said[np.arange(len(hits)), k, fold]
    return found


def _sharpened(said: np.ndarray) -> tuple[float, float]:
    """Return b that makes outcomes of probabilities `said` likeliest, and their mean ln P'; 1 if nothing was."""
    odds = logit(said.astype(np.float64))
    if not np.isfinite(odds).all():
        return 1.0, float("nan")
    best = minimize_scalar(lambda b: np.logaddexp(0, -b * odds).mean(), bounds=SHARPNESS, method="bounded")
    return float(best.x), -float(best.fun)


def _patterns(overturns: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distinct columns of the table, which of them each candidate has, and their prior shares."""
    packed = np.packbits(overturns.astype(bool), axis=0)
    _, first, owner, count = np.unique(
        packed, axis=1, return_index=True, return_inverse=True, return_counts=True
    )
    return overturns[:, first].astype(np.float32), owner.ravel(), (count / count.sum()).astype(np.float32)


def _weights(
    hits: np.ndarray, prior: np.ndarray, kept: np.ndarray, unexplained: np.ndarray, iterations: Sequence[int]
) -> Iterator[np.ndarray]:
    """Yield the weights (m, c) of c fits side by side after each of the rising numbers of steps, from the prior on.

    hits: (n, m) whether candidate j ends test t as it ended. kept: (n, c), 1 for the tests of a fit, else 0.
    unexplained: (c,) ε. Tests that all candidates end alike say nothing and are left aside.
    """
    telling = hits.min(axis=1) != hits.max(axis=1)
    hits, kept = hits[telling], kept[telling]
    count, share = kept.sum(axis=0), unexplained.astype(np.float32)
    weights, done = np.repeat(prior[:, None], len(share), axis=1), 0
    for steps in iterations:
        for _ in range(steps - done):
            ratio = kept / with_unexplained(hits @ weights, share)
            gain = (1 - share) * (hits.T @ ratio) + share / 2 * ratio.sum(axis=0)
            weights *= np.where(count, gain / np.maximum(count, 1), 1)
        done = steps
        yield weights / weights.sum(axis=0)
