"""What the benchmarks share: the least CPU time of several runs, and a ground motion to shake with."""

from collections.abc import Callable
from time import process_time

import numpy as np

from rocking import Accelerogram


def least_cpu(*calls: Callable[[], object], repeats: int = 15) -> list[float]:
    """Least CPU time of each call, s; the calls take turns, so that a busy machine slows all of them alike."""
    spent = [[] for _ in calls]
    for _ in range(repeats + 1):
        for times, call in zip(spent, calls, strict=True):
            started = process_time()
            call()
            times.append(process_time() - started)
    return [min(times[1:]) for times in spent]  # the first run warms up


def shaking(
    seconds: float, strength: float, seed: int = 1, step: float = 0.005, period: float = 0.4
) -> Accelerogram:
    """Noise of about this period, peak `strength` [m/s²], that grows and fades over a second at its ends."""
    count = round(seconds / step)
    shape = np.hanning(max(round(period / step), 3))
    samples = np.convolve(np.random.default_rng(seed).normal(size=count + shape.size), shape, "same")[:count]
    times = np.arange(count) * step
    samples *= np.clip(times, 0, 1) * np.clip(times[-1] - times, 0, 1)
    return Accelerogram(samples * strength / np.abs(samples).max(), step)
