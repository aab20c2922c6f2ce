"""How severe a ground motion is for a structure: intensity measures, most of them logs of ratios.

All are relative to what overturns or lifts the equivalent block, so that one number means the same for every structure.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.measures import velocity
from rocking.sine_pulse import overturning_amplitudes
from rocking.structures import EquivalentBlock, Mechanism

NUDGES = (0.75, 0.875, 1.0, 1.125, 1.25)
"""Factors on the ground motion at which the block is tried around the motion as given."""
_SMALLEST, _LARGEST = math.log(1e-3), math.log(1e3)
"""Logs of ratios are kept between these."""
_TURNED = math.log(2.0)
"""Largest log of a rotation ratio: a block that stays up hardly turns beyond its critical rotation."""
_PERIODS = np.geomspace(0.15, 8.0, 48)
"""Of the sines among which the most dangerous one is sought, s."""


@dataclass(frozen=True, eq=False)
class Shape:
    """What is measured once of a record, whatever the structure and whatever the factor on it.

    velocity: m/s at each sample.
    """

    accelerogram: Accelerogram
    peak_velocity: float
    velocity: np.ndarray

    @classmethod
    def of(cls, accelerogram: Accelerogram) -> "Shape":
        """Measure a record."""
        course = velocity(accelerogram)
        return cls(accelerogram, float(np.abs(course).max()), course)


def of_structure(mechanism: Mechanism) -> dict[str, float]:
    """What is known of the structure before any motion: restitution, and the defects of its equivalent block."""
    defects = mechanism.block_defects
    return {
        "restitution": min(side.restitution for side in mechanism.sides),
        "restoring_defect": defects.restoring,
        "forcing_defect": defects.forcing,
    }


def of_peaks(shape: Shape, block: EquivalentBlock) -> dict[str, float]:
    """ln of p PGV/(gλ) and of PGA/(gλ)."""
    uplift = GRAVITY * _uplift(block)
    return {
        "peak_velocity": _log(per_velocity(block) * shape.peak_velocity),
        "peak_acceleration": _log(shape.accelerogram.peak_acceleration / uplift),
    }


def per_velocity(block: EquivalentBlock) -> float:
    """p/(gλ), s/m."""
    return block.frequency_parameter / (GRAVITY * _uplift(block))


def of_pulse(pulse: Pulse, block: EquivalentBlock) -> dict[str, float]:
    """ln of the amplitude of the pulse over the least that overturns the block, and of ω_g/p."""
    polarity = 1 if pulse.amplitude > 0 else -1
    least = float(overturning_amplitudes([block], [pulse.circular_frequency], polarity)[0, 0])
    return {
        "pulse": _log(abs(pulse.amplitude) / least),
        "frequency_ratio": _log(pulse.circular_frequency / block.frequency_parameter),
    }


def of_sines(shape: Shape, block: EquivalentBlock) -> dict[str, float]:
    """ln of the amplitude of a sine cycle in the record over the least that overturns: of the most dangerous period."""
    periods, amplitudes = _matched(shape.accelerogram)
    worst = max(
        float(np.max(amplitudes / _overturning(block, tuple(2 * np.pi / periods), polarity)))
        for polarity in ((1,) if block.symmetric else (1, -1))
    )
    return {"sine": _log(worst)}


def of_pushes(shape: Shape, block: EquivalentBlock) -> dict[str, float]:
    """ln of two velocities, times p/(gλ): the largest change within 2/p, and the largest that decays with e^(−pt).

    The block rests at the start of the second and overturns without an impact where it exceeds 1, if it lifts there and
    does not touch the ground again.
    """
    p, uplift = block.frequency_parameter, GRAVITY * _uplift(block)
    step = shape.accelerogram.time_step
    return {
        "velocity_change": _log(p * _largest_change(shape.velocity, max(1, round(2 / (p * step)))) / uplift),
        "push": _log(p * _largest_push(shape.accelerogram.acceleration, step, p) / uplift),
    }


def from_ratio(rotation_ratio: float) -> dict[str, float]:
    """What a rotation ratio of the block says: whether it overturns, and else its ln; it fails as if it overturned."""
    overturns = not rotation_ratio < math.inf
    return {"block_overturns": float(overturns), "block": 0.0 if overturns else _log(rotation_ratio, _TURNED)}


def from_nudged(rotation_ratios: np.ndarray) -> dict[str, float]:
    """What the rotation ratios at NUDGES say: of the middle one, of the largest, and how many overturn."""
    share = float(np.mean(~(rotation_ratios < math.inf)))
    return from_ratio(float(rotation_ratios[len(NUDGES) // 2])) | {
        "block_high": from_ratio(float(rotation_ratios[-1]))["block"],
        "block_overturning_share": share,
        "block_never_overturns": float(share == 0),
        "block_always_overturns": float(share == 1),
    }


def scaled(measures: Mapping[str, float], factor: float) -> dict[str, float]:
    """The measures, none of which follows the block, under the motion times `factor`."""
    shift = math.log(factor)
    return {name: _kept(value + shift) if name in SCALING else value for name, value in measures.items()}


SCALING = ("peak_velocity", "peak_acceleration", "pulse", "sine", "velocity_change", "push")
"""Measures that grow with the log of the motion."""


def _log(ratio: float, largest: float = _LARGEST) -> float:
    return _kept(math.log(ratio), largest) if ratio > 0 else _SMALLEST


def _kept(value: float, largest: float = _LARGEST) -> float:
    return min(max(value, _SMALLEST), largest)


def _uplift(block: EquivalentBlock) -> float:
    return min(side.uplift_multiplier for side in block.sides)


def _largest_change(course: np.ndarray, samples: int) -> float:
    """Largest difference of two velocities at most `samples` apart."""
    from scipy.ndimage import (  # slow to import, and needed by this measure only
        maximum_filter1d,
        minimum_filter1d,
    )

    highest = maximum_filter1d(course, samples + 1, mode="nearest")
    lowest = minimum_filter1d(course, samples + 1, mode="nearest")
    return float((highest - lowest).max())


def _largest_push(acceleration: np.ndarray, step: float, p: float) -> float:
    """Largest |∫ ü_g(t) e^(−p(t − t₀)) dt| over all t₀, by trapezoids."""
    from scipy.signal import lfilter  # as above

    decay = math.exp(-p * step)
    ahead = lfilter([step / 2, step / 2 * decay], [1.0, -decay], acceleration[::-1])
    return float(np.abs(ahead).max())


@lru_cache(maxsize=32)
def _overturning(block: EquivalentBlock, frequencies: tuple[float, ...], polarity: int) -> np.ndarray:
    return overturning_amplitudes([block], frequencies, polarity)[0]


@lru_cache(maxsize=8)
def _matched(accelerogram: Accelerogram) -> tuple[np.ndarray, np.ndarray]:
    """The periods that fit into the record, and the largest amplitude of a sine cycle of each, by least squares."""
    from scipy.signal import fftconvolve  # as above

    step, samples = accelerogram.time_step, accelerogram.acceleration
    kept = _PERIODS[(samples.size * step > _PERIODS) & (4 * step < _PERIODS)]
    amplitudes = []
    for period in kept:
        cycle = np.sin(2 * np.pi * np.arange(0, period, step) / period)
        found = fftconvolve(samples, cycle[::-1], mode="valid") if cycle.size <= samples.size else np.zeros(1)
        amplitudes.append(np.abs(found).max() / (cycle @ cycle))
    return kept, np.array(amplitudes)
