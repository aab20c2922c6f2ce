"""Where a function of one number vanishes, and where it is least, after Brent (1973).

`scipy.optimize` has the same, but takes a third of a second to import, which every job and every command would pay.
"""

import math
from collections.abc import Callable
from typing import SupportsFloat

_GOLDEN = (3 - math.sqrt(5)) / 2
_ROUNDS = 200
_ROUNDING = math.sqrt(2.2e-16)
"""Share of a place by which a smooth function must be moved from its minimum before its value tells."""


def root(
    function: Callable[[float], SupportsFloat], low: float, high: float, absolute: float, relative: float
) -> float:
    """Return a place in [low, high] where `function` changes its sign, to `absolute` + `relative` times the place.

    It must have unlike signs at the two ends. Algorithms for Minimization without Derivatives, section 4.
    """
    before, at = float(low), float(high)
    value_before, value = float(function(before)), float(function(at))
    if value_before == 0:
        return before
    # The root lies between `at`, the best so far, and `across`, where the sign is the other one.
    across, value_across = before, value_before
    last = step = at - before
    for _ in range(_ROUNDS):
        if value == 0:
            break
        if (value > 0) == (value_across > 0):
            across, value_across = before, value_before
            last = step = at - before
        if abs(value_across) < abs(value):
            before, at, across = at, across, at
            value_before, value, value_across = value, value_across, value
        least = (absolute + relative * abs(at)) / 2
        half = (across - at) / 2
        if abs(half) <= least:
            break
        last, step = step, last
        if abs(last) >= least and abs(value_before) > abs(value):
            step = _interpolated(before - at, across - at, value_before, value, value_across)
            if not 2 * abs(step) < min(abs(last), 3 * abs(half) - least):
                last = step = half
        else:
            last = step = half
        before, value_before = at, value
        at += step if abs(step) > least else math.copysign(least, half)
        value = float(function(at))
    return at


def _interpolated(before: float, across: float, at_before: float, at: float, at_across: float) -> float:
    """The step to where a line through two of the places, or an inverse parabola through three, vanishes.

    before, across: how far they lie from the third place, whose value is `at`. inf where they tell nothing.
    """
    if before == across:
        numerator, denominator = -at * before, at_before - at
    else:
        to_before = (at_before - at) / before
        to_across = (at_across - at) / across
        numerator = -at * (at_across * to_across - at_before * to_before)
        denominator = to_across * to_before * (at_across - at_before)
    return numerator / denominator if denominator else math.inf


def minimum(
    function: Callable[[float], float], low: float, high: float, accuracy: float
) -> tuple[float, float]:
    """Return a place in (low, high) where `function` is locally least, to `accuracy`, and its value there.

    By parabolas through the three best places, and golden sections where those do not help; the same places, one after
    another, as `scipy.optimize.minimize_scalar(method="bounded")`.
    """
    place = second = third = low + _GOLDEN * (high - low)
    value = value_second = value_third = float(function(place))
    step = last = 0.0
    for _ in range(_ROUNDS):
        middle = (low + high) / 2
        smallest = _ROUNDING * abs(place) + accuracy / 3
        if abs(place - middle) <= 2 * smallest - (high - low) / 2:
            break
        golden = True
        if abs(last) > smallest:
            r = (place - second) * (value - value_third)
            q = (place - third) * (value - value_second)
            p = (place - third) * q - (place - second) * r
            q = 2 * (q - r)
            p = -p if q > 0 else p
            q = abs(q)
            last, before_last = step, last
            if abs(p) < abs(q * before_last / 2) and q * (low - place) < p < q * (high - place):
                golden = False
                step = p / q
                near_an_end = min(place + step - low, high - (place + step)) < 2 * smallest
                if near_an_end:
                    step = math.copysign(smallest, middle - place)
        if golden:
            last = (low if place >= middle else high) - place
            step = _GOLDEN * last
        tried = place + math.copysign(max(abs(step), smallest), step)
        value_tried = float(function(tried))
        if value_tried <= value:
            low, high = (place, high) if tried >= place else (low, place)
            third, value_third = second, value_second
            second, value_second = place, value
            place, value = tried, value_tried
            continue
        low, high = (tried, high) if tried < place else (low, tried)
        if value_tried <= value_second or second == place:
            third, value_third = second, value_second
            second, value_second = tried, value_tried
        elif value_tried <= value_third or third in (place, second):
            third, value_third = tried, value_tried
    return place, value
