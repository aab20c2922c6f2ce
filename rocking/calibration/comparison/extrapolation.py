"""From answers at three settings, each half the one before, to the limit and its error bar."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True, eq=False)
class Run:
    """What a code says at one setting, nan where nothing.

    rotation_ratio: φ_max/φ_cr, inf if it overturns. restitution: of a reversal on still ground. outside_hinges: share
    of joint rotation outside the hinges of the mechanism at the largest rotation. landings: (k,) s.
    """

    rotation_ratio: float
    restitution: float = math.nan
    outside_hinges: float = math.nan
    landings: np.ndarray = field(default_factory=lambda: np.empty(0))


def answer_of(runs: Sequence[Run], duration: float, reason: str) -> dict:
    """Return the limits of three runs as a mapping for JSON; reason: why the largest rotation has none, if so.

    Where the limit of a small rotation would be negative, the last run stands, with the bar of the extrapolation.
    """
    ratio, bar = limit_of([run.rotation_ratio for run in runs])
    ratio = runs[-1].rotation_ratio if ratio < 0 else ratio
    kept, kept_bar = limit_of([run.restitution for run in runs])
    return {
        "rotation_ratio": ratio,
        "error_bar": bar,
        "restitution": kept,
        "restitution_error": kept_bar,
        "outside_hinges": runs[-1].outside_hinges,
        "landings": runs[-1].landings.tolist(),
        "duration": duration,
        "reason": reason if math.isnan(ratio) else "",
    }


def limit_of(answers: Sequence[float]) -> tuple[float, float]:
    """Return the limit of three answers whose setting (time step, flexibility) halves each time, and half its bar.

    The order is the observed one, kept between 1/2 and 2 (Roache 1994, Richardson's extrapolation); the bar is the last
    change, or the extrapolated one if that is larger. Answers that overturn have no limit: inf if all do, else nan.
    """
    if any(not math.isfinite(each) for each in answers):
        return (math.inf if all(math.isinf(each) for each in answers) else math.nan), math.nan
    coarse, middle, fine = answers
    before, last = middle - coarse, fine - middle
    if last == 0:
        return fine, 0.0
    shrinks = min(max(before / last, math.sqrt(2)), 4.0) if before * last > 0 else math.sqrt(2)
    step = last / (shrinks - 1)
    return fine + step, max(abs(last), abs(step))
