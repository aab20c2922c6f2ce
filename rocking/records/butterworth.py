"""Butterworth filters run both ways, so that they shift nothing, compiled.

`scipy.signal.sosfiltfilt` gives the same, but takes half a second to import, which every record would pay.
"""

import math

import numpy as np
from numba import njit, types


def run_both_ways(values: np.ndarray, order: int, corner: float, *, passes_high: bool) -> np.ndarray:
    """Return `values` (n,) after a filter and the same one backwards, each from the steady state of its first value.

    order: of each run; both together leave a half at the corner. corner: as a share of the Nyquist frequency.
    """
    sections = _sections(order, corner, passes_high)
    filtered = np.array(values, dtype=float)
    for _ in range(2):
        start = float(filtered[0])
        for section in sections:
            _run(filtered, *section, start)
            start *= sum(section[:3]) / (1 + section[3] + section[4])
        filtered = np.ascontiguousarray(filtered[::-1])
    return filtered


def _sections(order: int, corner: float, passes_high: bool) -> list[tuple[float, float, float, float, float]]:
    """Return b₀, b₁, b₂, a₁, a₂ of each second-order section by the bilinear transform, K = tan(π/2 · corner).

    The poles of the order N lie on a circle, two by two with the damping cos(π (2k + 1)/2N), and one on the axis where
    N is odd (Butterworth 1930).
    """
    warped = math.tan(0.5 * math.pi * corner)
    square = warped * warped
    sections = []
    for pair in range(order // 2):
        damped = 2 * warped * math.sin(math.pi * (2 * pair + 1) / (2 * order))
        scale = 1 / (1 + damped + square)
        gain = scale if passes_high else square * scale
        middle = -2 * gain if passes_high else 2 * gain
        sections.append((gain, middle, gain, 2 * (square - 1) * scale, (1 - damped + square) * scale))
    if order % 2:
        scale = 1 / (1 + warped)
        gain = scale if passes_high else warped * scale
        sections.append((gain, -gain if passes_high else gain, 0.0, (warped - 1) * scale, 0.0))
    return sections


_REAL = types.float64


@njit(
    types.void(types.float64[::1], _REAL, _REAL, _REAL, _REAL, _REAL, _REAL),
    cache=True,
    error_model="numpy",
)
def _run(values: np.ndarray, b0: float, b1: float, b2: float, a1: float, a2: float, start: float) -> None:
    """Run one section over `values` in place. start: what came before them, for ever."""
    settled = start * (b0 + b1 + b2) / (1 + a1 + a2)
    first = settled - b0 * start
    second = b2 * start - a2 * settled
    for place in range(values.size):
        came = values[place]
        goes = first + b0 * came
        first = second + b1 * came - a1 * goes
        second = b2 * came - a2 * goes
        values[place] = goes
