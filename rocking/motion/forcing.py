"""The ground motion as the kernel sees it: samples joined by lines or curves, or one exact sine pulse."""

import math
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from rocking.errors import MotionError
from rocking.motion.nonlinear_kernel import CURVE, Ground
from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY, kind_of
from rocking.records.accelerogram import Accelerogram

GroundMotion = Accelerogram | Pulse

CURVE_ERROR = 1e-6
"""Largest distance of a curve from the samples that it joins, over the peak of the motion: where one is farther, lines
join them all."""

_REMEMBERED = 64
"""Ground motions whose arrays are kept: more than the eight directions of a raw pair after each of six processings,
which every structure and every stage of a reserve goes through again."""


@dataclass(frozen=True, eq=False)
class Forcing:
    """The ground motion as the kernel takes it.

    start_time: s, added to every time of the response. vertical: whether it has a vertical component.
    """

    ground: Ground
    start_time: float
    vertical: bool

    @cached_property
    def weightless(self) -> bool:
        """Whether g + ü_v falls below zero."""
        return self.ground.gravity + float(self.ground.lightest[0]) < 0

    @property
    def excitation(self) -> float:
        """The largest |ü_g|/(g + ü_v), whatever the phase of the two; inf where gravity may vanish."""
        least = self.ground.gravity + self.ground.lightest[0]
        return float(self.ground.strongest[0] / least) if least > 0 else math.inf


def forcing_of(motion: GroundMotion, vertical: Accelerogram | None = None) -> Forcing:
    """Return what the kernel takes of a record, with its vertical component, or of a pulse.

    Those of the directions and processings of a record are remembered.
    Raises MotionError when `motion` is neither or a pulse that is no full sine, or `vertical` does not fit its samples.
    """
    if not isinstance(motion, Accelerogram | Pulse):
        raise MotionError(f"the ground motion is {kind_of(motion)}, but must be an Accelerogram or a Pulse.")
    if isinstance(motion, Pulse) and not motion.is_full_sine:
        raise MotionError(
            f"the ground motion is {motion!r}, but of pulses one full sine alone is integrated as it stands; give its "
            "samples: Accelerogram(pulse.acceleration(times), time_step)."
        )
    if vertical is None:
        return _forcing(motion, None)
    if isinstance(motion, Pulse):
        raise MotionError(
            "vertical is given with a pulse, but needs a record of the same samples; leave it out."
        )
    if not isinstance(vertical, Accelerogram):
        raise MotionError(f"vertical is {kind_of(vertical)}, but must be an Accelerogram.")
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
    return _forcing(motion, vertical)


def _curves(motion: Accelerogram) -> np.ndarray:
    """Return the curves (c, CURVE) through samples of every smooth stretch, by power of the time in it.

    None, (0, CURVE), where there is no stretch, or where one is farther than CURVE_ERROR from a sample between those.
    """
    stretch = motion.smooth_steps
    coefficients = min(CURVE, stretch - 1)
    if coefficients < 3 or (motion.acceleration.size - 1) % stretch:
        return np.empty((0, CURVE))
    count = (motion.acceleration.size - 1) // stretch

    def samples(places: np.ndarray) -> np.ndarray:
        return np.stack([motion.acceleration[place:][::stretch][:count] for place in places])

    # Close together at both ends, as Chebyshev's: what is between them departs most in the middle between two.
    through = np.rint(stretch * (1 - np.cos(np.linspace(0, np.pi, coefficients))) / 2).astype(int)
    between = np.setdiff1d((through[1:] + through[:-1]) // 2, through)
    powers = np.linalg.inv(np.vander(through / stretch, increasing=True)) @ samples(through)
    there = np.vander(between / stretch, coefficients, increasing=True) @ powers
    if not np.abs(there - samples(between)).max() <= CURVE_ERROR * motion.peak_acceleration:
        return np.empty((0, CURVE))
    curves = np.zeros((count, CURVE))
    curves[:, :coefficients] = powers.T / (stretch * motion.time_step) ** np.arange(coefficients)
    return curves


@lru_cache(maxsize=_REMEMBERED)
def _forcing(motion: GroundMotion, vertical: Accelerogram | None) -> Forcing:
    # Copies, because a record's own arrays are read-only, for which the kernel would be compiled again.
    horizontal = np.array([motion.amplitude] if isinstance(motion, Pulse) else motion.acceleration)
    lift = np.zeros(horizontal.size) if vertical is None else vertical.acceleration.copy()
    curves = np.empty((0, CURVE)) if isinstance(motion, Pulse) else _curves(motion)
    ground = Ground(
        horizontal=horizontal,
        vertical=lift,
        strongest=np.maximum.accumulate(np.abs(horizontal[::-1]))[::-1].copy(),
        lightest=lift if vertical is None else np.minimum.accumulate(lift[::-1])[::-1].copy(),
        time_step=motion.period if isinstance(motion, Pulse) else motion.time_step,
        circular_frequency=motion.circular_frequency if isinstance(motion, Pulse) else 0.0,
        gravity=GRAVITY,
        curves=curves,
        stretch=motion.smooth_steps if isinstance(motion, Accelerogram) and curves.size else 1,
    )
    return Forcing(ground, motion.start_time if isinstance(motion, Pulse) else 0.0, vertical is not None)
