"""The demand of a design level on a part on the ground or on a support (Circolare 7/2019, C7.2.3 and C8.7.1.12)."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocking.codes.design_spectrum import DesignSpectrum
from rocking.floors.spectrum import UPPER_PERIOD, amplification, mode_factor
from rocking.floors.support import Support


@dataclass(frozen=True, eq=False)
class FloorDemand:
    """The motion that a part feels where it stands: on the ground, or on a support by the modes of what carries it.

    spectrum: of the ground. support: None on the ground; the participation of its modes is γ_k ψ_k(z), with n storeys
    γ_1 = 3n/(2n + 1) and ψ_1 = z/H (C7.2.10).
    """

    spectrum: DesignSpectrum
    support: Support | None = None

    def peak(self, level: ArrayLike) -> np.ndarray:
        """Return a_Z [m/s²], what a rigid part feels (C7.2.8), were the level `level` [m/s²], of any shape.

        It is not let below the ground's own peak, which sums of few modes may miss.
        """
        ground = self.spectrum.ordinates(0.0, level, self.spectrum.damping)
        if self.support is None:
            return ground
        peaks = np.array(self._mode_peaks(self.support, level))
        floor = np.sqrt(np.square(peaks).sum(axis=0))
        larger: np.ndarray = np.maximum(ground, floor)
        return larger

    def acceleration(self, period: ArrayLike, level: ArrayLike, damping: float) -> np.ndarray:
        """Return S_eZ(T, ξ, z) [m/s²] of parts of that `period` [s] (C7.2.5), were the level `level` [m/s²].

        The two broadcast.
        """
        periods = np.asarray(period, dtype=float)
        ground = self.spectrum.ordinates(periods, level, damping)
        if self.support is None:
            return ground
        factors = [amplification(mode, periods, damping) for mode in self.support.modes]
        peaks = self._mode_peaks(self.support, level)
        terms = [np.square(peak * factor) for peak, factor in zip(peaks, factors, strict=True)]
        floor: np.ndarray = np.sqrt(sum(terms))
        return np.where(periods > _first_period(self.support), np.maximum(floor, ground), floor)

    def displacement(
        self, shortest: float, period: ArrayLike, level: ArrayLike, damping: float
    ) -> np.ndarray:
        """Return the displacement demand [m] at the secant `period` [s] of parts, were the level `level` [m/s²].

        The two broadcast. shortest: T_0 of the parts, from which on site spectra are searched for their largest S_De;
        0 of such as are tied rigidly. On the ground S_De, on a support C8.7.1.12.
        """
        if self.support is None:
            return self.spectrum.largest_displacement(shortest, period, level, damping)
        periods = np.asarray(period, dtype=float)
        demand = self.acceleration(periods, level, damping) * (periods / (2 * math.pi)) ** 2
        first = _first_period(self.support)
        resonance = UPPER_PERIOD * first
        at_resonance = self.acceleration(first, level, damping) * (resonance / (2 * math.pi)) ** 2
        return np.where(periods > resonance, np.maximum(demand, at_resonance), demand)

    def _mode_peaks(self, support: Support, level: ArrayLike) -> list[np.ndarray]:
        """a_Z,k of each mode (C7.2.7)."""
        return [
            self.spectrum.ordinates(mode.period, level, mode.damping_ratio) * mode_factor(mode)
            for mode in support.modes
        ]


def _first_period(support: Support) -> float:
    return max(mode.period for mode in support.modes)
