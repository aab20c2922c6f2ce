"""Rocking spectra: the largest rotation of every equivalent block under one ground motion."""

import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from rocking.errors import MotionError
from rocking.quantities import GRAVITY, within
from rocking.records.accelerogram import Accelerogram


def rocking_spectrum(
    accelerogram: Accelerogram,
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    restitution: float,
    workers: int | None = None,
) -> np.ndarray:
    """Return φ_max/φ_cr, (m, n), of the equivalent blocks of p [rad/s] (m,) and λ (n,) under one record; inf overturns.

    Exact (linear between samples), on all cores or on `workers` threads. Raises MotionError when p or λ is not
    positive, or the restitution lies outside [0, 1].
    """
    from rocking.motion import linear_kernel as kernel

    frequencies = _positive("frequency_parameters", frequency_parameters)
    pushes = 1 / (GRAVITY * _positive("uplift_multipliers", uplift_multipliers))
    restitution = within(MotionError, "restitution", restitution, 0, 1)
    ground, step = accelerogram.acceleration.copy(), accelerogram.time_step
    if frequencies.size and frequencies.max() * step > 50:
        raise MotionError(
            f"frequency_parameters reach {frequencies.max()!r} rad/s, but at a time step of {step!r} s "
            f"must stay below {50 / step:g}."
        )
    ratios = np.empty((frequencies.size, pushes.size))

    def row(i: int) -> None:
        takeable = np.empty((1, 2, ground.size))
        kernel.takeback(ground, step, frequencies[i], 1, takeable[0, 0])
        kernel.takeback(ground, step, frequencies[i], -1, takeable[0, 1])
        kernel.spectrum_row(
            frequencies[i], pushes, restitution, kernel.Samples(ground, step, takeable), ratios[i]
        )

    with ThreadPoolExecutor(workers or os.cpu_count()) as pool:
        list(pool.map(row, range(frequencies.size)))
    return ratios


def _positive(field: str, values: np.ndarray) -> np.ndarray:
    array = np.array(values, dtype=float)
    if array.ndim != 1 or not np.all(np.isfinite(array)) or not np.all(array > 0):
        raise MotionError(f"{field} must be a one-dimensional array of finite numbers greater than 0.")
    return array
