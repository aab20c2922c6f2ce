"""What is not known of a structure, identified from tests of it that ended standing or overturned.

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
from dataclasses import dataclass, replace

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import expit, logit
from scipy.stats import qmc

from rocking import EquivalentBlock

PARAMETERS = (
    "uplift_multiplier_positive",
    "uplift_multiplier_negative",
    "frequency_parameter",
    "restitution",
)
"""What is identified of a block with two sides."""
LEVELS = (0.05, 0.5, 0.95)
"""Quantiles that a range gives."""
ITERATIONS = (10, 20, 40, 80)
"""Numbers of steps among which the fit chooses."""
UNEXPLAINED = (0.02, 0.05, 0.1)
"""Values of ε among which the fit chooses."""
FOLDS = 10
"""Parts into which the groups are dealt for that choice."""
SHARPNESS = (0.5, 2.0)
"""Bounds of b: outcomes that all are as stated would have no largest one."""


@dataclass(frozen=True)
class BlockPrior:
    """What may be true of a rigid body on two contact lines before any test: a box, even in the logarithms (η: even).

    uplift_multiplier: λ, geometric mean of the two sides, -. frequency_parameter: p, rad/s, the same on both sides.
    side_ratio: largest λ of one side over the other's, ≥ 1. restitution: η. Each but the ratio (lowest, highest).
    size: number of blocks that fill the box, evenly (Sobol), a power of two.
    """

    uplift_multiplier: tuple[float, float]
    frequency_parameter: tuple[float, float]
    side_ratio: float = 1.5
    restitution: tuple[float, float] = (0.7, 0.99)
    size: int = 2048

    def parameters(self) -> np.ndarray:
        """Return (size, 4): PARAMETERS of each block."""
        share = qmc.Sobol(4, seed=0).random(self.size)
        (low, high), (slow, fast) = self.uplift_multiplier, self.frequency_parameter
        lift = low * (high / low) ** share[:, 0]
        ratio = np.sqrt(self.side_ratio) ** (2 * share[:, 1] - 1)
        frequency = slow * (fast / slow) ** share[:, 2]
        least, most = self.restitution
        return np.column_stack([lift * ratio, lift / ratio, frequency, least + share[:, 3] * (most - least)])


@dataclass(frozen=True, eq=False)
class Mixture:
    """What the tests say of a structure: candidates, and the share of each in the population.

    parameters: (m, 4) PARAMETERS of the candidates. weights: (m,), summing to 1. unexplained: ε. iterations: steps
    taken. sharpness: b.
    """

    parameters: np.ndarray
    weights: np.ndarray
    unexplained: float
    iterations: int
    sharpness: float

    def probability(self, overturns: np.ndarray) -> np.ndarray:
        """P' of overturning, (n,), of tests whose verdicts by candidate are `overturns`, (n, m)."""
        share = with_unexplained(overturns @ self.weights, self.unexplained)
        probability: np.ndarray = expit(self.sharpness * logit(share))
        return probability

    def ranges(self) -> Mapping[str, tuple[float, float, float]]:
        """Return 5 %, 50 % and 95 % of PARAMETERS over the population."""
        ends = np.quantile(self.parameters, LEVELS, axis=0, weights=self.weights, method="inverted_cdf")
        return {name: tuple(own) for name, own in zip(PARAMETERS, ends.T.tolist(), strict=True)}


def two_sided_block(
    positive_multiplier: float, negative_multiplier: float, frequency_parameter: float, restitution: float
) -> EquivalentBlock:
    """Return the block that lifts at λ of each side; φ_cr = atan λ, as of a rigid body on two contact lines."""
    positive, negative = (
        EquivalentBlock(
            frequency_parameter=frequency_parameter,
            critical_rotation=float(np.arctan(multiplier)),
            acceleration_scale=float(np.arctan(multiplier)) / multiplier,
            restitution=restitution,
        )
        for multiplier in (positive_multiplier, negative_multiplier)
    )
    return replace(positive, other_side=negative)


def with_unexplained(share: np.ndarray, unexplained: float | np.ndarray) -> np.ndarray:
    """(1 − ε) share + ε/2."""
    return (1 - unexplained) * share + unexplained / 2


def fit_mixture(
    parameters: np.ndarray, overturns: np.ndarray, outcomes: np.ndarray, groups: Sequence[str]
) -> Mixture:
    """Return the mixture of the candidates that explains the outcomes, its two settings chosen by groups left out.

    parameters: (m, 4) of the candidates. overturns: (n, m) whether candidate j overturns in test t. outcomes: (n,)
    whether it did. groups: (n,) labels; with fewer than two groups the middle settings are taken.
    """
    patterns, owner, prior = _patterns(overturns)
    hits = np.where(outcomes[:, None], patterns, 1 - patterns)
    left_out = _left_out(hits, prior, np.asarray(groups))
    unexplained, iterations = max(left_out, key=lambda choice: np.log(left_out[choice]).mean())
    every = np.ones((len(hits), 1), dtype=np.float32)
    (weights,) = _weights(hits, prior, every, np.array([unexplained]), (iterations,))
    shared = weights[owner, 0] / np.bincount(owner)[owner]
    return Mixture(parameters, shared, unexplained, iterations, sharpness(left_out[unexplained, iterations]))


def _left_out(
    hits: np.ndarray, prior: np.ndarray, groups: np.ndarray
) -> Mapping[tuple[float, int], np.ndarray]:
    """Return by (ε, steps) the probability of each outcome, (n,), its group left out; of one group: one half."""
    names, place = np.unique(groups, return_inverse=True)
    if names.size < 2:
        middle = UNEXPLAINED[len(UNEXPLAINED) // 2], ITERATIONS[len(ITERATIONS) // 2]
        return {middle: np.full(len(hits), 0.5)}
    parts = min(FOLDS, names.size)
    fold = place % parts
    mask = (fold[:, None] != np.arange(parts)).astype(np.float32)
    masks, choices = np.tile(mask, len(UNEXPLAINED)), np.repeat(UNEXPLAINED, parts)
    stated = {}
    for steps, weights in zip(ITERATIONS, _weights(hits, prior, masks, choices, ITERATIONS), strict=True):
        each = with_unexplained(hits @ weights, choices).reshape(len(hits), len(UNEXPLAINED), parts)
        for k, unexplained in enumerate(UNEXPLAINED):
            stated[unexplained, steps] = each[np.arange(len(hits)), k, fold]
    return stated


def sharpness(stated: np.ndarray) -> float:
    """Return b that makes outcomes of the probabilities `stated` (n,) likeliest; 1 where all are one half."""
    odds = logit(stated.astype(np.float64))
    if not odds.any():
        return 1.0
    best = minimize_scalar(lambda b: np.logaddexp(0, -b * odds).mean(), bounds=SHARPNESS, method="bounded")
    return float(best.x)


def _patterns(overturns: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return the distinct columns of the table, which of them each candidate has, and their prior shares."""
    packed = np.packbits(overturns.astype(bool), axis=0)
    _, first, owner, count = np.unique(
        packed, axis=1, return_index=True, return_inverse=True, return_counts=True
    )
    return overturns[:, first].astype(np.float32), owner.ravel(), (count / count.sum()).astype(np.float32)


def _weights(
    hits: np.ndarray, prior: np.ndarray, mask: np.ndarray, unexplained: np.ndarray, iterations: Sequence[int]
) -> Iterator[np.ndarray]:
    """Yield the weights (m, c) of c fits side by side after each of the rising numbers of steps, from the prior on.

    hits: (n, m) whether candidate j ends test t as it ended. mask: (n, c), 1 for the tests of a fit, else 0.
    unexplained: (c,) ε. Tests that all candidates end alike say nothing and are left aside.
    """
    telling = hits.min(axis=1) != hits.max(axis=1)
    hits, mask = hits[telling], mask[telling]
    count, share = mask.sum(axis=0), unexplained.astype(np.float32)
    weights, done = np.repeat(prior[:, None], len(share), axis=1), 0
    for steps in iterations:
        for _ in range(steps - done):
            ratio = mask / with_unexplained(hits @ weights, share)
            gain = (1 - share) * (hits.T @ ratio) + share / 2 * ratio.sum(axis=0)
            weights *= np.where(count, gain / np.maximum(count, 1), 1)
        done = steps
        yield weights / weights.sum(axis=0)
