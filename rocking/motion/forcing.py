"""The ground motion as the kernel sees it: samples joined by straight lines, or one exact sine pulse."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rocking.errors import MotionError
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram

GroundMotion = Accelerogram | Pulse


@dataclass(frozen=True, eq=False)
class Forcing:
    """ground, gravity, threat: (n,) ü_g, g + ü_v, and the largest |ü_g|/(g + ü_v) from each sample to the end.

    time_step: s, of the samples. frequency: rad/s of a sine pulse, whose period is then time_step and whose amplitude
    is ground[0]; 0.0 for samples. start_time: s, added to every time of the response.
    """

    ground: np.ndarray
    gravity: np.ndarray
    threat: np.ndarray
    time_step: float
    frequency: float = 0.0
    start_time: float = 0.0
    vertical: bool = False

    def scaled(self, factor: float) -> "Forcing":
        """The same motion with its accelerations, vertical one included, multiplied by `factor`."""
        ground, gravity = self.ground * factor, self.gravity
        if self.vertical:
            gravity = GRAVITY + factor * (gravity - GRAVITY)
        return Forcing(
            ground,
            gravity,
            _threat(ground, gravity),
            self.time_step,
            self.frequency,
            self.start_time,
            self.vertical,
        )


def forcing_of(motion: GroundMotion, vertical: Accelerogram | None = None) -> Forcing:
    """Return what the kernel takes of a record, with its vertical component, or of a pulse.

    The last few are remembered.
    Raises MotionError when `motion` is neither, or `vertical` does not fit it sample by sample.
    """
    if not isinstance(motion, Accelerogram | Pulse):
        raise MotionError(
            f"the ground motion is a {type(motion).__name__}, but must be an Accelerogram or a Pulse."
        )
    if vertical is not None:
        _check_fit(vertical, motion)
    return _forcing(motion, vertical)


@lru_cache(maxsize=4)
def _forcing(motion: GroundMotion, vertical: Accelerogram | None) -> Forcing:
    if isinstance(motion, Pulse):
        ground, gravity = np.array([motion.amplitude]), np.array([GRAVITY])
        threat = _threat(ground, gravity)
        return Forcing(ground, gravity, threat, motion.period, motion.circular_frequency, motion.start_time)
    # A copy, because the record's own array is read-only, for which the kernel would compile anew.
    ground, gravity = motion.acceleration.copy(), np.full(motion.acceleration.size, GRAVITY)
    if vertical is not None:
        gravity += vertical.acceleration
    return Forcing(ground, gravity, _threat(ground, gravity), motion.time_step, vertical=vertical is not None)


def _check_fit(vertical: Accelerogram, motion: GroundMotion) -> None:
    if isinstance(motion, Pulse):
        raise MotionError(
            "vertical is given with a pulse, but needs a record of the same samples; leave it out."
        )
    if not isinstance(vertical, Accelerogram):
        raise MotionError(f"vertical is a {type(vertical).__name__}, but must be an Accelerogram.")
    if vertical.acceleration.size != motion.acceleration.size:
        raise MotionError(
            f"vertical has {vertical.acceleration.size} samples, but must have the {motion.acceleration.size} of the "
            "horizontal component; cut or resample it first."
        )
    if abs(vertical.time_step - motion.time_step) > 1e-9 * motion.time_step:
        raise MotionError(
            f"vertical has a time step of {vertical.time_step!r} s, but must have the {motion.time_step!r} s of the "
            "horizontal component; resample it first."
        )


def _threat(ground: np.ndarray, gravity: np.ndarray) -> np.ndarray:
    largest = np.maximum.accumulate(np.abs(ground[::-1]))[::-1]
    least = np.minimum.accumulate(gravity[::-1])[::-1]
    return np.where(least > 0, largest / np.where(least > 0, least, 1.0), np.inf)
