"""Methods, and how a prediction stands to the integration: each verdict and threshold is defined here once.

A structure rests, rocks or overturns. It rests up to `NEGLIGIBLE` of its critical rotation, lifted or not: whether a
rotation is exactly zero depends on the last digit of the uplift acceleration, and a tremor below a thousandth of the
critical rotation, far below what any scatter of restitution or amplitude does, can neither harm nor decide anything. A
threshold of zero would count each such tremor that a prediction leaves out as uplift missed. Predicted over integrated
rotation, in contrast, is given wherever both are lifted and stay up: without the smallest predictions, the share that
lies within a factor two would look better than it is.
"""

import math
from enum import StrEnum

NEGLIGIBLE = 1e-3
"""Largest rotation over critical rotation at which a structure counts as resting."""
CLOSE = 0.1
"""Relative difference up to which the words are "within 10 %"."""
BOTH_COMPONENTS = "both"
"""In place of a component: all directions of a record."""
POLARITIES = {"1.0": "as recorded", "-1.0": "reversed"}
"""The sign of a motion in words."""


class Method(StrEnum):
    """The method by which a largest rotation was computed."""

    CLOSED_FORM = "closed form"
    BLOCK_ON_RECORD = "block on record"
    MECHANISM_ON_PULSE = "mechanism on pulse"
    MECHANISM_ON_RECORD = "mechanism on record"


class Agreement(StrEnum):
    """The agreement of a prediction with the integration."""

    SAME = "same outcome"
    """Both rest, both rock or both overturn."""
    TOO_LOW = "too low"
    """The prediction says less than happens: the unsafe side."""
    TOO_HIGH = "too high"
    """The prediction says more than happens."""
    UNKNOWN = "unknown"
    """One of the two is missing."""


def rests(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rests; False for nan."""
    return _severity(rotation_ratio) == 0


def rocks(rotation_ratio: float) -> bool:
    """Whether a structure with this largest rotation ratio rocks and stays up; False for nan."""
    return _severity(rotation_ratio) == 1


class Acts(StrEnum):
    """When the pulse of a prediction acts, relative to the fall of the integration."""

    BEFORE = "before"
    DURING = "during"
    AFTER = "after"


STILL_FALLING = 6.0
"""Time after the end of a pulse, in 1/p, within which a body that it threw may still fall."""


def acts(*, start: float, end: float, fall: float, frequency_parameter: float) -> Acts | None:
    """Return when a pulse from `start` to `end` acts relative to a fall at `fall`; None where nothing falls."""
    if math.isnan(fall):
        return None
    if fall < start:
        return Acts.AFTER
    return Acts.DURING if fall <= end + STILL_FALLING / frequency_parameter else Acts.BEFORE


def agreement(*, predicted: float, integrated: float) -> Agreement:
    """Compare two rotation ratios (inf: overturns, nan: missing)."""
    if math.isnan(predicted) or math.isnan(integrated):
        return Agreement.UNKNOWN
    difference = _severity(predicted) - _severity(integrated)
    return Agreement.SAME if difference == 0 else Agreement.TOO_HIGH if difference > 0 else Agreement.TOO_LOW


def ratio(*, predicted: float, integrated: float) -> float:
    """Return predicted over integrated rotation ratio where both are lifted and stay up, else nan."""
    return predicted / integrated if 0 < predicted < math.inf and 0 < integrated < math.inf else math.nan


def ratio_in_words(*, predicted: float, integrated: float) -> str:
    """Say how a predicted rotation ratio stands to the integrated one: "20 × too low", "within 10 %".

    Two digits at the most; "" where one of them is missing.
    """
    if math.isnan(predicted) or math.isnan(integrated):
        return ""
    if words := _WORDS.get((_severity(predicted), _severity(integrated))):
        return words
    factor = max(predicted / integrated, integrated / predicted)
    if factor <= 1 + CLOSE:
        return f"within {CLOSE:.0%}".replace("%", " %")
    digits = f"{factor:.1f}" if factor < 10 else f"{float(f'{factor:.2g}'):.0f}"
    return f"{digits} × too {'high' if predicted > integrated else 'low'}"


_WORDS = {
    (0, 0): "both at rest",
    (0, 1): "misses the rocking",
    (0, 2): "misses the overturning",
    (1, 0): "rocks instead of resting",
    (1, 2): "misses the overturning",
    (2, 0): "overturns instead of resting",
    (2, 1): "overturns instead of rocking",
    (2, 2): "both overturn",
}
"""The agreement by predicted and integrated severity: rests, rocks, overturns."""


def within_factor_two(*, predicted: float, integrated: float) -> bool | None:
    """Whether two rotation ratios lie within a factor two of each other; None where they have no ratio."""
    quotient = ratio(predicted=predicted, integrated=integrated)
    return None if math.isnan(quotient) else 0.5 <= quotient <= 2


def _severity(rotation_ratio: float) -> int:
    """0 of what rests, 1 of what rocks and stays up, 2 of what overturns, or of nan."""
    return 0 if rotation_ratio <= NEGLIGIBLE else 1 if rotation_ratio < math.inf else 2
