"""Two horizontal components of one motion: that they belong together, and the motion along another axis."""

import math

import numpy as np

from rocking.errors import PulseError
from rocking.records.accelerogram import Accelerogram


def same_sampling(first: Accelerogram, second: Accelerogram) -> np.ndarray:
    """Return both accelerations, (2, n) m/s², over the samples they share from the first on.

    Components of one recording often differ by a few samples at the end; those are dropped.
    Raises PulseError when the time steps differ or one is vertical.
    """
    if first.vertical or second.vertical:
        raise PulseError("One of the two components is vertical, but a direction needs two horizontal ones.")
    if not math.isclose(first.time_step, second.time_step, rel_tol=1e-9):
        raise PulseError(
            f"The time steps are {first.time_step:g} and {second.time_step:g} s, but two components must share one; "
            "resample one of them."
        )
    count = min(first.acceleration.size, second.acceleration.size)
    return np.array([first.acceleration[:count], second.acceleration[:count]])


def rotated(first: Accelerogram, second: Accelerogram, angle: float) -> Accelerogram:
    """Return the motion along an axis at `angle`, rad, from the first component towards the second, as a record."""
    one, two = same_sampling(first, second)
    return first.processed_by(
        one * math.cos(angle) + two * math.sin(angle),
        f"Rotated by {math.degrees(angle):.2f}° from component {first.component or 'one'} "
        f"towards component {second.component or 'two'}.",
        component=f"{math.degrees(angle):.0f}° from {first.component or 'one'}",
        azimuth=azimuth_of_axis(first.azimuth, second.azimuth, angle),
    )


def azimuth_of_axis(first: float | None, second: float | None, angle: float) -> float | None:
    """Azimuth in degrees of the rotated axis; None unless the components are known to be square to each other."""
    if first is None or second is None:
        return None
    apart = (second - first) % 360
    if not math.isclose(min(apart, 360 - apart), 90, abs_tol=1.0):
        return None
    return (first + math.degrees(angle) * (1 if apart < 180 else -1)) % 360
