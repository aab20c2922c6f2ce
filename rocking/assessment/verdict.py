"""Verdict: does a predicted rotation err against the integrated one, and on which side? Each word is defined here once.

A structure rests, rocks or overturns. It rests up to `NEGLIGIBLE` of its critical rotation, lifted or not: whether a
rotation is exactly zero hangs on the last digit of the uplift acceleration, and a tremor below a thousandth of the
critical rotation, far below what any scatter of restitution or amplitude does, can neither harm nor decide anything. A
threshold of zero would count each such tremor that a prediction leaves out as uplift missed. Predicted over integrated
rotation, in contrast, is given wherever both are lifted and stay up: without the smallest predictions, the share that
lies within a factor two would look better than it is.
"""

import math
from enum import StrEnum

NEGLIGIBLE = 1e-3
"""Largest rotation over critical rotation at which a structure counts as resting."""


class Verdict(StrEnum):
    """How a prediction stands to the integration."""

    AGREE = "agree"
    """Both rest, both rock or both overturn."""
    UNSAFE = "unsafe"
    """The prediction says less than happens."""
    SAFE = "safe"
    """The prediction says more than happens."""
    UNKNOWN = "unknown"
    """One of the two is not known."""


def rests(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rests; False for nan."""
    return rotation_ratio <= NEGLIGIBLE


def rocks(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rocks and stays up; False for nan."""
    return NEGLIGIBLE < rotation_ratio < math.inf


def verdict(predicted: float, integrated: float) -> Verdict:
    """Compare two rotation ratios (inf: overturns, nan: not known)."""
    if math.isnan(predicted) or math.isnan(integrated):
        return Verdict.UNKNOWN
    difference = _severity(predicted) - _severity(integrated)
    return Verdict.AGREE if difference == 0 else Verdict.SAFE if difference > 0 else Verdict.UNSAFE


def ratio(predicted: float, integrated: float) -> float:
    """Return predicted over integrated rotation ratio where both are lifted and stay up, else nan."""
    return predicted / integrated if 0 < predicted < math.inf and 0 < integrated < math.inf else math.nan


def within_factor_two(predicted: float, integrated: float) -> bool | None:
    """Whether two rotation ratios lie within a factor two of each other; None where they have no ratio."""
    found = ratio(predicted, integrated)
    return None if math.isnan(found) else 0.5 <= found <= 2


def _severity(rotation_ratio: float) -> int:
    return 0 if rests(rotation_ratio) else 1 if rocks(rotation_ratio) else 2
