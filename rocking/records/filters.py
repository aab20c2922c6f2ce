"""Filters: recursions over the samples of a record, compiled. Butterworth's both ways, and the linear oscillator's.

`scipy.signal` has both, as `sosfiltfilt` and `lfilter`, but takes half a second to import, which every record would
pay.
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


_SAMPLES = types.Array(types.float64, 1, "C", readonly=True)


@njit(types.void(types.complex128[::1], types.complex128), cache=True, error_model="numpy")
def accumulate(values: np.ndarray, decay: complex) -> None:
    """Turn the gains of each step into what they leave, in place: y_n = v_n + decay · y_(n − 1)."""
    for place in range(1, values.size):
        values[place] += decay * values[place - 1]


@njit(
    types.float64(_SAMPLES, types.int64, types.int64, types.complex128, types.complex128, types.complex128),
    cache=True,
    error_model="numpy",
)
def largest_imaginary(
    samples: np.ndarray, finer: int, after: int, decay: complex, begin: complex, end: complex
) -> float:
    """Return the largest |Im q| of q_n = decay · q_(n − 1) + begin · a_(n − 1) + end · a_n, from rest.

    a: `finer` steps from each of the `samples` to the next along a line, then zero for `after` steps.
    """
    q = end * samples[0]
    largest: float = abs(q.imag)
    before = samples[0]
    for place in range(1, samples.size):
        first = samples[place - 1]
        rise = (samples[place] - first) / finer
        for part in range(1, finer + 1):
            now = samples[place] if part == finer else first + rise * part
            q = decay * q + begin * before + end * now
            largest = max(largest, abs(q.imag))
            before = now
    for _ in range(after):
        q = decay * q + begin * before
        largest = max(largest, abs(q.imag))
        before = 0.0
    return largest
