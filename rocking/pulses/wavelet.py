"""The db4 wavelet on samples: its coefficients at one scale, and what it covers of a record.

A scale is the number of samples of the wavelet's unit of time; the wavelet is seven of them long.
"""

import math
from functools import cache, lru_cache

import numpy as np

SUPPORT = 7.0
"""Length of db4 in its own time; its centre frequency is 5 cycles over it."""
LARGEST_KEPT = 2**16
"""Length of the longest transform of a wavelet that is kept for the next time: 1 MB each."""


@cache
def _table() -> tuple[np.ndarray, np.ndarray]:
    import pywt

    _, wavelet, places = pywt.Wavelet("db4").wavefun(level=10)
    return places, wavelet


def _half_length(scale: float) -> int:
    return math.floor(SUPPORT / 2 * scale)


def _wavelet(scale: float) -> np.ndarray:
    """db4 stretched to `scale` samples per unit and of unit energy, centred on the middle sample (odd count)."""
    half = _half_length(scale)
    places, wavelet = _table()
    return np.interp(np.arange(-half, half + 1) / scale + SUPPORT / 2, places, wavelet) / math.sqrt(scale)


def coefficients(velocities: np.ndarray, scale: int, low: int, high: int) -> np.ndarray:
    """Coefficients of one scale centred at the samples [low, high); only what they see is transformed."""
    begin = max(0, low - _half_length(scale))
    return transform(velocities[begin : high + _half_length(scale)], scale)[low - begin : high - begin]


def transform(velocities: np.ndarray, scale: float) -> np.ndarray:
    """Coefficient of the wavelet of one scale centred at each sample of (n,) velocities, real or complex."""
    from scipy import fft

    half = _half_length(scale)
    size = fft.next_fast_len(velocities.size + 2 * half)
    spectrum = _kept_spectrum(scale, size) if size <= LARGEST_KEPT else _spectrum(scale, size)
    if np.iscomplexobj(velocities):
        full = fft.ifft(fft.fft(velocities, size) * spectrum)
    else:
        full = fft.irfft(fft.rfft(velocities, size) * spectrum[: size // 2 + 1], size)
    return np.concatenate([full[size - half :], full[: velocities.size]])[: velocities.size]


def _spectrum(scale: float, size: int) -> np.ndarray:
    """Fourier transform of the wavelet read backwards: the conjugate of its own, as it is real."""
    from scipy import fft

    return np.conj(fft.fft(_wavelet(scale), size))


_kept_spectrum = lru_cache(maxsize=128)(_spectrum)
"""The records of a study often have one length, and some seventy scales are asked for in each."""


def coefficient_at(velocity: np.ndarray, scale: int, column: int) -> float:
    """Coefficient of one wavelet at one sample."""
    begin, end, wavelet = overlap(velocity.size, scale, column)
    return float((velocity[begin:end] * wavelet).sum())


def overlap(count: int, scale: int, column: int) -> tuple[int, int, np.ndarray]:
    """First and last sample of the wavelet centred at `column` inside `count` samples, and that part of it."""
    wavelet = _wavelet(scale)
    begin = column - wavelet.size // 2
    low, high = max(begin, 0), min(begin + wavelet.size, count)
    return low, high, wavelet[low - begin : high - begin]
