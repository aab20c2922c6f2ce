"""From answers at three settings, each half the one before, to the limit and its error bar."""

import math
from collections.abc import Sequence


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
