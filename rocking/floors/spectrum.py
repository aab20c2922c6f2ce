"""Floor spectrum: the elastic spectrum on a support as the Italian code writes it, from the ground's own.

Circolare 21 January 2019 n. 7 C.S.LL.PP., C7.2.3. Symbols as there, each within its own function.
"""

import math
from collections.abc import Callable

import numpy as np

from rocking.errors import RecordError
from rocking.floors.support import Mode, Support
from rocking.quantities import finite, within
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.measures import damping_factor, response_spectrum

GroundSpectrum = Callable[[float, float], float]
"""Elastic spectrum of the ground: acceleration [m/s²] of an undamped period [s] and a damping ratio."""

LOWER_PERIOD = 0.8
"""a of C7.2.6: share of the period of a mode from which on its floor spectrum is flat."""
UPPER_PERIOD = 1.1
"""b of C7.2.6: share of that period up to which it is flat."""

LEAST_DAMPING = 0.001
"""Damping ratio below which the formula, which divides by its root, has no value that means anything."""

FLOOR_DAMPING = 0.05
"""Damping ratio of the floor spectra of tables and reports."""


def spectrum_of(record: Accelerogram) -> GroundSpectrum:
    """Return the spectrum of a record itself; at the period 0 its peak acceleration."""

    def acceleration(period: float, damping_ratio: float) -> float:
        if period == 0:
            return record.peak_acceleration
        return float(response_spectrum(record, np.array([period]), damping_ratio).pseudo_acceleration[0])

    return acceleration


def has_code_spectrum(support: Support) -> bool:
    """Return whether the code's formula has a value for a support: each mode has some damping."""
    return all(mode.damping_ratio >= LEAST_DAMPING for mode in support.modes)


def mode_factor(mode: Mode) -> float:
    """Return a_Z,k over the ground's S_e(T_k, ξ_k): |γ_k ψ_k(z)| √(1 + .0004 ξ_k²), ξ_k in per cent (C7.2.7)."""
    per_cent = 100 * mode.damping_ratio
    return abs(mode.participation) * math.sqrt(1 + 0.0004 * per_cent**2)


def mode_acceleration(mode: Mode, ground: GroundSpectrum) -> float:
    """Return a_Z,k, m/s², the largest acceleration of the support in one mode (C7.2.7)."""
    return ground(mode.period, mode.damping_ratio) * mode_factor(mode)


def floor_spectrum(
    support: Support, periods: np.ndarray, damping_ratio: float, ground: GroundSpectrum
) -> np.ndarray:
    """Return S_eZ, m/s², of what stands on the support with `periods`, (n,) s, and `damping_ratio` (C7.2.5, C7.2.6).

    Above the first period of the support it is no less than the ground's. A rigid mode, of period 0, adds nothing to
    the ground. Raises RecordError for a damping of 0 of support or structure, of which the code's formula has no value.
    """
    damping_ratio = within(RecordError, "damping_ratio", damping_ratio, low=LEAST_DAMPING, high=0.999)
    periods = np.array([finite(RecordError, "period", period, "s") for period in np.atleast_1d(periods)])
    of_modes = [
        mode_acceleration(mode, ground) * amplification(mode, periods, damping_ratio)
        for mode in support.modes
    ]
    spectrum = np.sqrt(sum(np.square(of_mode) for of_mode in of_modes))
    of_ground = np.array([ground(float(period), damping_ratio) for period in periods])
    first_period = max(mode.period for mode in support.modes)
    at_least_the_ground = np.maximum(spectrum, of_ground)
    return np.asarray(np.where(periods > first_period, at_least_the_ground, spectrum))


def amplification(mode: Mode, periods: np.ndarray, damping_ratio: float) -> np.ndarray:
    """Return S_eZ,k over a_Z,k (C7.2.6) at `periods` [s] of any shape; 0 for a rigid mode.

    The damping of the mode is a ratio in p: in per cent p would fall below 1. Raises RecordError for a mode without
    damping.
    """
    if mode.period == 0:
        return np.zeros(np.shape(periods))
    within(RecordError, "damping_ratio of the support", mode.damping_ratio, low=LEAST_DAMPING, high=0.999)
    a = LOWER_PERIOD
    b = UPPER_PERIOD
    p = 1.1 / math.sqrt(mode.damping_ratio) * damping_factor(damping_ratio)
    below = np.maximum(1 - periods / (a * mode.period), 0) ** 1.6
    above = np.maximum(periods / (b * mode.period) - 1, 0) ** 1.2
    return p / (1 + (p - 1) * (below + above))
