"""Recursive filters: Butterworth's, run both ways over a record, and the recursion of an oscillator.

What scipy.signal does of this is done here in the same order, and gives the same numbers, without what importing it
costs every process: it brings scipy.stats along, more than half a second. Import this module where a record is
filtered only: numba, which comes with it, is of no use to one that is only read.
"""

import math
from typing import Any

import numpy as np
from numba import njit, types

_BILINEAR = 4.0
"""Twice the sampling rate in the bilinear transformation, where frequencies are shares of Nyquist's."""
_OPTIONS: dict[str, Any] = {"cache": True, "nogil": True, "error_model": "numpy", "no_cfunc_wrapper": True}
_REALS, _COMPLEXES = types.float64[::1], types.complex128[::1]
_SECTIONS = types.float64[:, ::1]


def butterworth(order: int, corner: float, high_pass: bool) -> np.ndarray:
    """Return the second-order sections of a Butterworth filter, (⌈order/2⌉, 6): b0, b1, b2, 1, a1, a2.

    high_pass: whether what is faster than the corner passes, or what is slower. corner: where half of the power passes,
    as share of Nyquist's frequency, in (0, 1). The poles lie evenly on a half circle (Butterworth 1930) and are taken
    to samples by the bilinear transformation (Oppenheim & Schafer, Discrete-Time Signal Processing, section 7.1). The
    section whose poles are nearest to the unit circle comes last.
    """
    # Of each pair of conjugate poles the one above; the real pole of an odd order is the first.
    places = np.arange((order + 1) % 2, order, 2)
    above = -np.exp(-1j * math.pi * places / (2 * order))
    evenly = -np.exp(1j * math.pi * np.arange(1 - order, order, 2) / (2 * order))
    warped = _BILINEAR * math.tan(math.pi * corner / 2)
    if high_pass:
        poles = warped / evenly
        above = np.conj(warped / above)
        gain = (1 / np.prod(-evenly)).real * (_BILINEAR**order / np.prod(_BILINEAR - poles)).real
        zero = 1.0
    else:
        poles = warped * evenly
        above = warped * above
        gain = warped**order * (1 / np.prod(_BILINEAR - poles)).real
        zero = -1.0
    sampled = (_BILINEAR + above) / (_BILINEAR - above)
    sampled = sampled[np.argsort(-np.abs(1 - np.abs(sampled)), kind="stable")]
    sections = np.array([_section(pole, zero) for pole in sampled])
    sections[0, :3] *= gain
    return sections


def _section(pole: complex, zero: float) -> list[float]:
    """A pair of conjugate poles with two zeros, or a real pole with one."""
    if abs(pole.imag) < 1e-12:  # of an odd order, real but for rounding
        return [1.0, -zero, 0.0, 1.0, -pole.real, 0.0]
    return [1.0, -2 * zero, 1.0, 1.0, -2 * pole.real, pole.real**2 + pole.imag**2]


def both_ways(sections: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Return `values` (n,) run through the sections (k, 6) forwards and then backwards, so that no phase shifts.

    Each run starts as if its first value had lasted for ever.
    """
    at_rest = _steady_states(sections)
    forwards = np.array(values, dtype=float)
    _run(sections, at_rest * forwards[0], forwards)
    backwards = forwards[::-1].copy()
    _run(sections, at_rest * backwards[0], backwards)
    return backwards[::-1].copy()


def _steady_states(sections: np.ndarray) -> np.ndarray:
    """The two states of each section (k, 2) under the constant input 1."""
    states = np.empty((len(sections), 2))
    entering = 1.0
    for state, (b0, b1, b2, _, a1, a2) in zip(states, sections, strict=True):
        kept = np.array([[1 + a1, -1.0], [a2, 1.0]])
        state[:] = entering * np.linalg.solve(kept, [b1 - a1 * b0, b2 - a2 * b0])
        entering *= (b0 + b1 + b2) / (1 + a1 + a2)
    return states


@njit([types.void(_SECTIONS, _SECTIONS, _REALS)], **_OPTIONS)
def _run(sections, states, values):  # type: ignore[no-untyped-def]
    """Run `values` (n,) through the sections in place, in the transposed direct form II."""
    for place in range(values.shape[0]):
        value = values[place]
        for k in range(sections.shape[0]):
            before = value
            value = sections[k, 0] * before + states[k, 0]
            states[k, 0] = sections[k, 1] * before - sections[k, 4] * value + states[k, 1]
            states[k, 1] = sections[k, 2] * before - sections[k, 5] * value
        values[place] = value


def recursion(factor: complex, values: np.ndarray) -> np.ndarray:
    """Return q (n,), complex, with q[k] = factor q[k − 1] + values[k] and nothing before the first.

    values: (n,) complex; written over.
    """
    _recur(factor, values)
    return values


@njit([types.void(types.complex128, _COMPLEXES)], **_OPTIONS)
def _recur(factor, values):  # type: ignore[no-untyped-def]
    for place in range(1, values.shape[0]):
        values[place] += factor * values[place - 1]
