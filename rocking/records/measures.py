"""Measures of the intensity of a record that engineers know it by."""

import math
from dataclasses import dataclass

import numpy as np

from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.processing import displacement, integral, velocity

SIGNIFICANT_SHARES = 0.05, 0.95
"""Shares of the Arias intensity at which the significant duration D5–95 begins and ends."""


@dataclass(frozen=True, eq=False)
class RecordMeasures:
    """What a record is known by.

    peak_acceleration, peak_velocity, peak_displacement: largest magnitudes, m/s², m/s, m; velocity and displacement by
    the trapezoidal rule from rest, as the record stands. arias_intensity: π/(2g) ∫a² dt, m/s (Arias 1970). husid:
    (n,) share of it that has been spent at each sample, from 0 to 1. significant_times: s, at which 5 and 95 % have.
    """

    peak_acceleration: float
    peak_velocity: float
    peak_displacement: float
    arias_intensity: float
    husid: np.ndarray
    significant_times: tuple[float, float]

    @property
    def significant_duration(self) -> float:
        """D5–95, s (Trifunac & Brady 1975)."""
        return self.significant_times[1] - self.significant_times[0]


def record_measures(accelerogram: Accelerogram) -> RecordMeasures:
    """Return the measures of one component. Of a record that is zero throughout, nothing is ever spent."""
    spent = integral(np.square(accelerogram.acceleration), accelerogram.time_step)
    husid = spent / spent[-1] if spent[-1] > 0 else np.zeros_like(spent)
    husid.flags.writeable = False
    begin, end = (float(np.interp(share, husid, accelerogram.times)) for share in SIGNIFICANT_SHARES)
    return RecordMeasures(
        peak_acceleration=accelerogram.peak_acceleration,
        peak_velocity=float(np.abs(velocity(accelerogram)).max()),
        peak_displacement=float(np.abs(displacement(accelerogram)).max()),
        arias_intensity=math.pi / (2 * GRAVITY) * float(spent[-1]),
        husid=husid,
        significant_times=(begin, end),
    )
