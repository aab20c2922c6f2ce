"""FIV3 after Dávalos and Miranda (2019), EESD 48, 1384-1405, in plain loops."""

import math
from collections.abc import Sequence
from itertools import pairwise


def fiv3(acceleration: Sequence[float], step: float, period: float, alpha: float, beta: float) -> float:
    """Return FIV3: three times the best of windows of alpha·T over what a Butterworth filter at beta/T lets pass.

    The filter of second order is that of the bilinear transform with its corner warped; the velocity is linear between
    its samples, where a window ends between two.
    """
    k = math.tan(math.pi * beta / period * step)
    scale = 1 + math.sqrt(2) * k + k * k
    feed = k * k / scale
    back = 2 * (k * k - 1) / scale, (1 - math.sqrt(2) * k + k * k) / scale
    filtered: list[float] = []
    for n, value in enumerate(acceleration):
        before, before_that = (acceleration[n - m] if n >= m else 0.0 for m in (1, 2))
        out, out_before = (filtered[n - m] if n >= m else 0.0 for m in (1, 2))
        filtered.append(feed * (value + 2 * before + before_that) - back[0] * out - back[1] * out_before)

    velocity = [0.0]
    for first, second in pairwise(filtered):
        velocity.append(velocity[-1] + step * (first + second) / 2)
    window = alpha * period / step
    whole, part = int(window + 1e-9), max(window - int(window + 1e-9), 0.0)
    gained = []
    for n in range(len(velocity) - whole - (1 if part else 0)):
        end = velocity[n + whole]
        if part:
            end += part * (velocity[n + whole + 1] - end)
        gained.append(end - velocity[n])

    def greatest(values: list[float]) -> float:
        inner = range(1, len(values) - 1)
        peaks = [values[n] for n in inner if values[n - 1] < values[n] > values[n + 1]]
        return sum(sorted(peaks)[-3:])

    return max(abs(greatest(gained)), abs(greatest([-item for item in gained])))
