"""Butterworth filters run both ways, equal to those of scipy.signal, which takes a second to import."""

import math

import numpy as np
from numba import njit


def filtered(values: np.ndarray, order: int, corner: float, *, is_high: bool) -> np.ndarray:
    """Return `values` (n,) filtered forwards and backwards, each begun in the steady state of its first value.

    corner: as a share of the Nyquist frequency, in (0, 1). is_high: whether what is below it is taken out.
    """
    sections = _sections(order, corner, is_high)
    states = np.empty((len(sections), 2))
    level = 1.0
    for state, (b0, b1, b2, _, a1, a2) in zip(states, sections, strict=True):
        # The state in which a section answers a constant input with a constant output.
        rest = [b1 - a1 * b0, b2 - a2 * b0]
        state[:] = level * np.linalg.solve([[1.0 + a1, -1.0], [a2, 1.0]], rest)
        level *= (b0 + b1 + b2) / (1.0 + a1 + a2)
    samples = np.array(values, dtype=float)
    for _ in range(2):
        _run(samples, sections, states * samples[0])
        samples = samples[::-1].copy()
    return samples


def _sections(order: int, corner: float, is_high: bool) -> np.ndarray:
    """Return the sections of second order of a Butterworth filter, (s, 6) b₀ b₁ b₂ a₀ a₁ a₂, the most resonant last.

    By the bilinear transform of poles on a circle (Butterworth 1930); of an odd order the first has a pole at 0.
    """
    circle = -np.exp(1j * math.pi * np.arange(1 - order, order, 2) / (2 * order))
    warped = 4.0 * math.tan(math.pi * corner / 2.0)
    poles = warped / circle if is_high else warped * circle
    gain = np.real(1.0 / np.prod(-circle)) * 4.0**order if is_high else warped**order
    gain = float(np.real(gain / np.prod(4.0 - poles)))
    placed = (4.0 + poles) / (4.0 - poles)
    resonant = sorted(placed[placed.imag > 1e-12], key=abs, reverse=True)
    zeros = [1.0 if is_high else -1.0] * order + [0.0] * (order % 2)
    rows = []
    for pole in resonant:  # each takes the zeros that are next to it
        zeros.sort(key=lambda zero: abs(zero - pole))
        one, other = zeros.pop(0), zeros.pop(0)
        rows.append([1.0, -one - other, one * other, 1.0, -2.0 * pole.real, (pole * pole.conj()).real])
    if order % 2:
        rows.append([1.0, -sum(zeros), math.prod(zeros), 1.0, -placed[order // 2].real, 0.0])
    rows[-1][:3] = [gain * part for part in rows[-1][:3]]
    return np.array(rows[::-1])


@njit(cache=True, error_model="numpy")
def _run(samples: np.ndarray, sections: np.ndarray, states: np.ndarray) -> None:
    """Run `samples` (n,) through sections (s, 6) from their states (s, 2), in place (direct form II, transposed)."""
    for place in range(samples.size):
        value = samples[place]
        for s in range(sections.shape[0]):
            out = sections[s, 0] * value + states[s, 0]
            states[s, 0] = sections[s, 1] * value - sections[s, 4] * out + states[s, 1]
            states[s, 1] = sections[s, 2] * value - sections[s, 5] * out
            value = out
        samples[place] = value
