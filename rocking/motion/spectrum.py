"""Rocking spectra: the largest rotation of every equivalent block under one ground motion."""

import os
from concurrent.futures import ThreadPoolExecutor
from typing import TYPE_CHECKING

import numpy as np

from rocking.errors import MotionError
from rocking.quantities import GRAVITY, within
from rocking.records.accelerogram import Accelerogram

if TYPE_CHECKING:
    from matplotlib.axes import Axes


class RockingSpectrum(np.ndarray):
    """φ_max/φ_cr, (m, n): an array that knows its axes.

    frequency_parameters: p (m,), rad/s. uplift_multipliers: λ (n,). A part of it keeps the axes of the whole.
    """

    frequency_parameters: np.ndarray
    uplift_multipliers: np.ndarray

    def __array_finalize__(self, of: np.ndarray | None) -> None:
        self.frequency_parameters = getattr(of, "frequency_parameters", np.empty(0))
        self.uplift_multipliers = getattr(of, "uplift_multipliers", np.empty(0))

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw lines of equal ratio over p and λ, on `axes` or on new ones, and return the axes.

        Raises MotionError for fewer than two values on either axis, or for a part of a spectrum.
        """
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)


def rocking_spectrum(
    accelerogram: Accelerogram,
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    restitution: float,
    workers: int | None = None,
) -> RockingSpectrum:
    """Return φ_max/φ_cr, (m, n), of the equivalent blocks of p [rad/s] (m,) and λ (n,) under one record; inf overturns.

    Exact (linear between samples), on all cores or on `workers` threads. Raises MotionError when p or λ is not
    positive, or the restitution lies outside [0, 1].
    """
    from rocking.motion import linear_kernel as kernel

    frequencies = _positive("frequency_parameters", frequency_parameters)
    multipliers = _positive("uplift_multipliers", uplift_multipliers)
    pushes = 1 / (GRAVITY * multipliers)
    restitution = within(MotionError, "restitution", restitution, 0, 1)
    ground, step = accelerogram.acceleration.copy(), accelerogram.time_step
    if frequencies.size and frequencies.max() * step > 50:
        raise MotionError(
            f"frequency_parameters reach {frequencies.max()!r} rad/s, but at a time step of {step!r} s "
            f"must stay below {50 / step:g}."
        )
    ratios = RockingSpectrum((frequencies.size, pushes.size))
    ratios.frequency_parameters, ratios.uplift_multipliers = frequencies, multipliers
    rows = ratios.view(np.ndarray)

    def row(i: int) -> None:
        takeable = np.empty((1, 2, ground.size))
        kernel.takeback(ground, step, frequencies[i], 1, takeable[0, 0])
        kernel.takeback(ground, step, frequencies[i], -1, takeable[0, 1])
        kernel.spectrum_row(
            frequencies[i], pushes, restitution, kernel.Samples(ground, step, takeable), rows[i]
        )

    with ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        list(pool.map(row, range(frequencies.size)))
    return ratios


def _positive(field: str, values: np.ndarray) -> np.ndarray:
    array = np.array(values, dtype=float)
    if array.ndim != 1 or not np.all(np.isfinite(array)) or not np.all(array > 0):
        raise MotionError(f"{field} must be a one-dimensional array of finite numbers greater than 0.")
    return array
