"""TierFit: one fitted tier, and what it says of intensity measures."""

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from rocking.assessment.tiers.tier import STRUCTURE, Tier

NORMAL_95 = 1.6449
"""95 % quantile of the normal distribution."""


@dataclass(frozen=True, eq=False)
class TierFit:
    """One fitted tier. centre, spread, least, largest: (k,) of the terms. coefficients: (k + 1,) and their covariance
    (k + 1, k + 1), intercept first.

    edges: (m,) ascending locations at which the classes of the band begin; bands: (m, 3) low, median and high.
    """

    tier: Tier
    centre: np.ndarray
    spread: np.ndarray
    least: np.ndarray
    largest: np.ndarray
    coefficients: np.ndarray
    covariance: np.ndarray
    edges: np.ndarray
    bands: np.ndarray

    def unlike(self, measures: Mapping[str, float]) -> str:
        """Which property of a structure lies beyond those behind the fit, in words; "" where none does."""
        for place, name in enumerate(STRUCTURE, start=-len(STRUCTURE)):
            least, largest, value = self.least[place], self.largest[place], measures[name]
            slack = 0.05 * (largest - least)
            if not least - slack <= value <= largest + slack:
                said, low, high = (f"{float(f'{each:.2g}'):g}" for each in (value, least, largest))
                return f"{name.replace('_', ' ')} is {said}, beyond the {low} to {high} of the calibration"
        return ""

    def design(self, known: np.ndarray) -> np.ndarray:
        """(n, k + 1) of the terms (n, k): an intercept, and what is centred and scaled."""
        return np.column_stack([np.ones(len(known)), (known - self.centre) / self.spread])

    def log_odds(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Log odds of overturning (n,) of terms (n, k), and their standard error."""
        design = self.design(known)
        variance = np.einsum("ij,jk,ik->i", design, self.covariance, design)
        return design @ self.coefficients, np.sqrt(np.maximum(variance, 0.0))

    def probabilities(self, known: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Of overturning (n,), and the ends of its 90 % interval."""
        odds, error = self.log_odds(known)
        middle, low, high = (1 / (1 + np.exp(-(odds + k * NORMAL_95 * error))) for k in (0, -1, 1))
        return middle, low, high

    def settled(self, known: np.ndarray, risk: float) -> tuple[np.ndarray, np.ndarray]:
        """Whether the case of each terms (n, k) stands, and whether it overturns, at the worse end of the interval."""
        odds, error = self.log_odds(known)
        limit = math.log(risk / (1 - risk))
        return odds + NORMAL_95 * error <= limit, odds - NORMAL_95 * error >= -limit

    def rotations(self, known: np.ndarray) -> np.ndarray:
        """(n, 3) low, median and high of the rotation ratio."""
        place = np.searchsorted(self.edges, self.location(known), side="right") - 1
        return self.bands[np.maximum(place, 0)] * self.anchor(known)[:, None]

    def location(self, known: np.ndarray) -> np.ndarray:
        """What the band is looked up by."""
        return np.log(self.anchor(known)) if self.tier.follows_the_block else self.log_odds(known)[0]

    def anchor(self, known: np.ndarray) -> np.ndarray:
        """What the band is a multiple of: the rotation ratio of the block (1 where it overturns), or 1."""
        if not self.tier.follows_the_block:
            return np.ones(len(known))
        terms = self.tier.terms
        overturns = known[:, terms.index("block_overturns")] > 0
        return np.where(overturns, OVERTURNED, np.exp(known[:, terms.index("block")]))


OVERTURNED = 10.0
"""Stands for the rotation ratio of a block that overturns."""
