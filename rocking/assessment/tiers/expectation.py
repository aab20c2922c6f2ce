"""Expectation: what a tier says of a case, in numbers and in words."""

import math
from dataclasses import dataclass

from rocking.assessment.tiers.tier import Tier
from rocking.assessment.verdict import NEGLIGIBLE

SURE = 0.01
"""Probabilities below, and above its complement, are printed as such."""


@dataclass(frozen=True)
class Expectation:
    """What a tier says of a case.

    probability: that the mechanism overturns; probability_low, probability_high: its 90 % interval. rotation_low,
    rotation_median, rotation_high: 5, 50 and 95 % of φ_max/φ_cr; inf overturns.
    """

    tier: Tier
    probability: float
    probability_low: float
    probability_high: float
    rotation_low: float
    rotation_median: float
    rotation_high: float

    def __str__(self) -> str:
        said = probability_in_words(self.probability, self.probability_low, self.probability_high)
        return f"{said}, {band_in_words(self.rotation_low, self.rotation_high)}"


def probability_in_words(probability: float, low: float, high: float) -> str:
    """Say a probability of overturning with its interval: "overturns with 30 % (18–45)"."""
    if probability < SURE:
        return f"overturns with less than {_percent(SURE)} %"
    if probability > 1 - SURE:
        return f"overturns with more than {_percent(1 - SURE)} %"
    return f"overturns with {_percent(probability)} % ({_percent(low)}–{_percent(high)})"


def band_in_words(low: float, high: float) -> str:
    """Say a band of the rotation ratio: "between 0.05 and 0.4 φ_cr"."""
    if low == math.inf:
        return "overturns"
    if high <= NEGLIGIBLE:
        return "at rest"
    if high == math.inf:
        return (
            "anything from rest to overturning"
            if low <= NEGLIGIBLE
            else f"at least {low:.1g} φ_cr, or overturns"
        )
    return f"at most {high:.1g} φ_cr" if low <= NEGLIGIBLE else f"between {_two(low, high)} φ_cr"


def _percent(share: float) -> str:
    return f"{100 * share:.0f}"


def _two(low: float, high: float) -> str:
    digits = 1 if high > 1.5 * low else 2
    return f"{low:.{digits}g} and {high:.{digits}g}"
