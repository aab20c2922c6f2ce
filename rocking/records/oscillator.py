"""Oscillator: a linear mode under an acceleration that is linear between its samples, compiled.

`scipy.signal.lfilter` gives the same, but takes half a second to import, which every report would pay.
"""

import numpy as np
from numba import njit, types

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
