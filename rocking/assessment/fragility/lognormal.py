"""The lognormal fragility curve by maximum likelihood, many at once."""

from typing import NamedTuple

import numpy as np
from scipy.special import erfcx, ndtr

DISPERSIONS = (0.02, 3.0)
"""Between which a dispersion is sought: outcomes that a level parts cleanly would fit ever smaller ones."""
_MOST_STEPS = 100
_SETTLED = 1e-9
_FARTHEST = 8.0
"""Standard deviations beyond which a probability is 0 or 1 to double precision."""


class LognormalFits(NamedTuple):
    """P = Φ(ln(IM/median)/dispersion). median, dispersion: (b,)."""

    median: np.ndarray
    dispersion: np.ndarray

    def probability(self, levels: np.ndarray) -> np.ndarray:
        """Return P at `levels`, (b, k)."""
        return np.asarray(ndtr(np.log(levels / self.median[:, None]) / self.dispersion[:, None]))


def fit_lognormal(
    levels: np.ndarray, overturned: np.ndarray, tried: np.ndarray, near: LognormalFits | None = None
) -> LognormalFits:
    """Fit b curves at once, by Fisher scoring.

    levels: (k,) > 0, at least two. overturned, tried: (b, k) how many overturned, fractions allowed, of how many tried
    at each level. near: one fit that all will be near to, which saves steps. Where all or none overturn the median lies
    at the edge of what the levels can tell.
    """
    logs = np.log(levels)
    middle, spread = float(logs.mean()), float(logs.std())
    z = (logs - middle) / spread
    steepest, flattest = spread / DISPERSIONS[0], spread / DISPERSIONS[1]
    a, b = np.zeros(len(tried)), np.ones(len(tried))
    if near is not None:
        b = np.clip(spread / np.broadcast_to(near.dispersion, len(tried)), flattest, steepest)
        a = (middle - np.log(near.median)) / spread * b
    moving = np.arange(len(tried))
    for _ in range(_MOST_STEPS):
        step_a, step_b = _step(z, overturned[moving], tried[moving], a[moving], b[moving])
        size = np.abs(step_a) + np.abs(step_b)
        short = np.minimum(1.0, 2.0 / np.maximum(size, 1e-300))  # two deviations at a time, lest it overshoot
        b[moving] = np.clip(b[moving] + short * step_b, flattest, steepest)
        most = _FARTHEST * np.maximum(b[moving], 1)
        a[moving] = np.clip(a[moving] + short * step_a, -most, most)
        moving = moving[size > _SETTLED]
        if not moving.size:
            break
    dispersion = spread / b
    return LognormalFits(np.exp(middle - a * dispersion), dispersion)


def _step(
    z: np.ndarray, overturned: np.ndarray, tried: np.ndarray, a: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    eta = np.clip(a[:, None] + b[:, None] * z, -_FARTHEST, _FARTHEST)
    # The normal density over Φ(η) and over Φ(−η).
    above, below = (np.sqrt(2 / np.pi) / erfcx(sign * eta / np.sqrt(2)) for sign in (-1, 1))
    slope = overturned * above - (tried - overturned) * below
    weight = tried * above * below
    g0, g1 = slope.sum(axis=1), (slope * z).sum(axis=1)
    tiny = 1e-9 * np.maximum(tried.sum(axis=1), 1.0)
    h00, h01, h11 = weight.sum(axis=1) + tiny, (weight * z).sum(axis=1), (weight * z**2).sum(axis=1) + tiny
    determinant = h00 * h11 - h01**2
    return (h11 * g0 - h01 * g1) / determinant, (h00 * g1 - h01 * g0) / determinant
