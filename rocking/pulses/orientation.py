"""The dominant pulse of two components and the direction in which it points."""

import math
from dataclasses import dataclass

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.analysis import PulseAnalysis
from rocking.pulses.components import rotated, same_sampling
from rocking.pulses.extraction import extract_pulses
from rocking.pulses.pulse import Pulse
from rocking.pulses.search import PulseSearch, searched_band
from rocking.pulses.settings import PulseSettings
from rocking.records.accelerogram import Accelerogram

TURN_TOLERANCE = 1e-12
"""Change of angle, rad, at which refinement of pulse and direction in turn has settled."""
MAXIMUM_TURNS = 100


@dataclass(frozen=True, eq=False)
class OrientedAnalysis:
    """The pulses along the axis in which one pulse gains most.

    angle: rad from the first component towards the second, in (−π/2, π/2]. amplitudes: of the dominant pulse along
    the two components, m/s². analysis: of the record rotated by `angle`; its dominant pulse is the one found.
    """

    angle: float
    amplitudes: tuple[float, float]
    analysis: PulseAnalysis

    def gain(self, angles: np.ndarray) -> np.ndarray:
        """Return the energy gain, m²/s³, of the dominant pulse along axes at `angles` (any shape, rad)."""
        angles = np.asarray(angles, dtype=float)
        projected = self.amplitudes[0] * np.cos(angles) + self.amplitudes[1] * np.sin(angles)
        return self.analysis.evidence.gain * (projected / math.hypot(*self.amplitudes)) ** 2


def extract_pulses_oriented(
    first: Accelerogram, second: Accelerogram, *, settings: PulseSettings | None = None
) -> OrientedAnalysis:
    """Return the pulses of two horizontal components along the axis that the dominant pulse points in.

    For one period and onset the best axis is closed form: G₁ + G₂ at θ = atan(a₂/a₁). So the sum of the two energy
    maps is scanned, and each of its best maxima is refined in period and onset along its own axis, in turn with it.
    Raises PulseError when the components differ in time step or hold nothing that moves.
    """
    settings = settings or PulseSettings()
    samples = same_sampling(first, second)
    if not np.ptp(samples, axis=1).any():
        raise PulseError(
            "Both components are constant throughout, but a pulse needs a motion; check the files."
        )
    band = searched_band(rotated(first, second, 0.0), settings)
    search = PulseSearch(first.time_step, band, settings)
    maxima = search.maxima(samples)
    best = max(
        (_settled(search, samples, onset, frequency) for onset, frequency in search.candidates(maxima)),
        key=lambda found: found[1],
    )
    record = rotated(first, second, best[0])
    analysis = extract_pulses(record, settings=settings)
    amplitude = analysis.dominant.amplitude
    return OrientedAnalysis(best[0], (amplitude * math.cos(best[0]), amplitude * math.sin(best[0])), analysis)


def _settled(search: PulseSearch, samples: np.ndarray, onset: int, frequency: float) -> tuple[float, float]:
    """Return (angle, gain) of the maximum of G₁ + G₂ near one scanned maximum."""
    angle = _best_angle(samples, search.time_step, onset * search.time_step, frequency)
    for _ in range(MAXIMUM_TURNS):
        along = samples[0] * math.cos(angle) + samples[1] * math.sin(angle)
        found = search.refined(along, 1.0, onset, frequency)
        pulse = found.pulse
        turned = _best_angle(samples, search.time_step, pulse.start_time, 1 / pulse.period)
        if abs(math.remainder(turned - angle, math.pi)) < TURN_TOLERANCE:
            break
        angle = turned
    return angle, found.gain


def _best_angle(samples: np.ndarray, time_step: float, start: float, frequency: float) -> float:
    """Angle of the two least-squares amplitudes of one pulse, in (−π/2, π/2]: an axis has no sense."""
    times = np.arange(samples.shape[1]) * time_step
    first, second = (samples * Pulse(1.0, 2 * math.pi * frequency, start).acceleration(times)).sum(axis=1)
    return (
        math.atan2(second, first) if first > 0 else math.atan2(-second, -first) if first < 0 else math.pi / 2
    )
