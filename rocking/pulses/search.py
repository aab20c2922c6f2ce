"""The search for pulses in samples: the band that a record can hold, the scan, its best maxima and their refinement."""

import math
from dataclasses import dataclass, replace

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.analysis import PulseEvidence
from rocking.pulses.flags import Flag
from rocking.pulses.pulse import Pulse
from rocking.pulses.settings import PulseSettings
from rocking.records.accelerogram import Accelerogram

REFINEMENT_REACH = 3.0
"""Steps of the frequency grid that a refinement may walk from its scanned maximum."""
SCANNED_OVERLAP = 0.7
"""Share of common time from which two scanned maxima count as one; the narrower limit is applied after refinement."""
LEAST_SHARE = 0.01
"""Share of the largest gain below which a maximum of the scan is no rival."""
NEAR_BEST = 0.8
"""Share of the largest scanned gain from which a maximum is worth a look when only the best is wanted."""
NEAR_TIME, NEAR_OCTAVES = 0.5, 0.5
"""Periods of onset and octaves of frequency within which a pulse is still the same pulse, sought again."""


@dataclass(frozen=True, eq=False)
class Band:
    """The frequencies that can be sought in a record: (m,) Hz, ascending, and why the band was narrowed."""

    frequencies: np.ndarray
    flags: tuple[Flag, ...]

    @property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest frequency, Hz."""
        return float(self.frequencies[0]), float(self.frequencies[-1])


def searched_band(accelerogram: Accelerogram, settings: PulseSettings) -> Band:
    """Return the frequencies that `settings` asks for and the record can hold. Raises PulseError when none is left."""
    low, high, found = settings.lowest_frequency, settings.highest_frequency, []
    if 1 / accelerogram.duration > low:
        low, found = 1 / accelerogram.duration, [Flag.SHORT_RECORD]
    finest = 1 / (settings.samples_per_cycle * accelerogram.time_step)
    if finest < high:
        high, found = finest, [*found, Flag.COARSE_SAMPLING]
    if low >= high:
        raise PulseError(
            f"{accelerogram.source.path or 'The accelerogram'} lasts {accelerogram.duration:g} s at a time step of "
            f"{accelerogram.time_step:g} s, but a pulse between {settings.lowest_frequency:g} and "
            f"{settings.highest_frequency:g} Hz needs one period of record and {settings.samples_per_cycle:g} "
            "samples in a cycle; give a longer or more finely sampled record, or widen the band."
        )
    steps = math.ceil(settings.per_octave * math.log2(high / low) - 1e-9)
    frequencies = low * 2.0 ** (np.arange(steps + 1) / settings.per_octave)
    frequencies[-1] = high
    return Band(frequencies, tuple(found))


@dataclass(frozen=True, eq=False)
class Maxima:
    """Local maxima of the energy gain on the grid: onsets (k,) samples, columns (k,) of the frequency, gains (k,)."""

    onsets: np.ndarray
    columns: np.ndarray
    gains: np.ndarray


@dataclass(frozen=True, eq=False)
class PulseSearch:
    """A search with one time step, band and settings; the samples may be a record, a residual or a rotation."""

    time_step: float
    band: Band
    settings: PulseSettings

    def maxima(self, samples: np.ndarray, onsets: slice = slice(None), share: float = LEAST_SHARE) -> Maxima:
        """Return the maxima of `samples`, (n,) m/s² or (c, n) of components whose gains are added, at `onsets`."""
        return _maxima(np.atleast_2d(samples), self.time_step, self.band.frequencies, onsets, share)

    def renewed(self, maxima: Maxima, samples: np.ndarray, changed: Pulse) -> Maxima:
        """Return `maxima` with those whose cycle can meet `changed`, where alone `samples` differ, sought again."""
        first = math.floor((changed.start_time - 1 / self.band.limits[0]) / self.time_step) - 2
        last = math.ceil(changed.end_time / self.time_step) + 2
        onsets = slice(max(first, 0), min(last, samples.size))
        kept = (maxima.onsets < onsets.start) | (maxima.onsets >= onsets.stop)
        new = self.maxima(samples, onsets)
        return Maxima(
            np.concatenate((maxima.onsets[kept], new.onsets)),
            np.concatenate((maxima.columns[kept], new.columns)),
            np.concatenate((maxima.gains[kept], new.gains)),
        )

    def ranked(self, samples: np.ndarray, maxima: Maxima) -> tuple[PulseEvidence, ...]:
        """Return the best pulses that do not cover one another, by refined gain."""
        energy = energy_of(samples, self.time_step)
        refined = [self.refined(samples, energy, *place) for place in self.candidates(maxima)]
        refined.sort(key=lambda evidence: -evidence.gain)
        kept: list[PulseEvidence] = []
        for evidence in refined:
            if all(shared_time(evidence.pulse, other.pulse) < self.settings.overlap for other in kept):
                kept.append(evidence)
        return tuple(kept[: self.settings.alternatives])

    def best(self, samples: np.ndarray, maxima: Maxima) -> PulseEvidence | None:
        """Return the pulse of largest refined gain; None where nothing is left to find."""
        energy = energy_of(samples, self.time_step)
        found = [self.refined(samples, energy, *place) for place in self.candidates(maxima, 2)]
        return max(found, key=lambda evidence: evidence.gain, default=None)

    def candidates(self, maxima: Maxima, count: int | None = None) -> list[tuple[int, float]]:
        """Return (onset sample, frequency in Hz) of the best maxima that do not cover one another."""
        order = np.argsort(-maxima.gains, kind="stable")
        onsets, frequencies = maxima.onsets[order], self.band.frequencies[maxima.columns[order]]
        starts, free = onsets * self.time_step, np.ones(order.size, bool)
        ends = starts + 1 / frequencies
        kept: list[tuple[int, float]] = []
        while len(kept) < (count or self.settings.candidates) and free.any():
            best = int(np.argmax(free))
            kept.append((int(onsets[best]), float(frequencies[best])))
            common = np.minimum(ends, ends[best]) - np.maximum(starts, starts[best])
            joint = np.maximum(ends, ends[best]) - np.minimum(starts, starts[best])
            free &= common < SCANNED_OVERLAP * joint
        return kept

    def refined(self, samples: np.ndarray, energy: float, onset: int, frequency: float) -> PulseEvidence:
        """Return the pulse at the maximum of the gain near one scanned maximum; energy: ∫a² dt, m²/s³."""
        from rocking.pulses.refinement import refine
        from rocking.pulses.scan import envelope_phase

        turn = 2 * math.pi * self.time_step
        lowest, highest = (turn * limit for limit in self.band.limits)
        reach = REFINEMENT_REACH * math.log(2) / self.settings.per_octave
        angle, start, sine, norm = refine(samples, onset, turn * frequency, lowest, highest, reach)
        pulse = Pulse(sine / norm, angle / self.time_step, start * self.time_step)
        gain = sine * sine / norm * self.time_step
        return PulseEvidence(pulse, gain, gain / energy, envelope_phase(samples, round(start), angle))

    def window(self, pulse: Pulse, count: int) -> slice:
        """Return the samples, of `count`, that a pulse like `pulse` can touch: see near()."""
        first = math.floor((pulse.start_time - NEAR_TIME * pulse.period) / self.time_step)
        longest = (NEAR_TIME + 2**NEAR_OCTAVES) * pulse.period
        last = math.ceil((pulse.start_time + longest) / self.time_step) + 2
        return slice(max(first, 0), min(last, count))

    def near(self, pulse: Pulse, samples: np.ndarray, window: slice) -> Pulse:
        """Return the best pulse in `samples`, which fill `window`, within half a period and half an octave.

        Raises PulseError where no such cycle lies in the window or the samples there are still.
        """
        steps = round(NEAR_OCTAVES * self.settings.per_octave)
        frequencies = 2.0 ** (np.arange(-steps, steps + 1) / self.settings.per_octave) / pulse.period
        frequencies = np.unique(np.clip(frequencies, *self.band.limits))
        onsets = math.ceil((pulse.start_time + NEAR_TIME * pulse.period) / self.time_step) + 1 - window.start
        maxima = _maxima(samples[np.newaxis], self.time_step, frequencies, slice(0, onsets), NEAR_BEST)
        if not maxima.gains.size:
            raise PulseError(
                f"No sine of about {pulse.period:.3g} s lies within the record near {pulse.start_time:.3g} s; "
                "give a longer record or another pulse method."
            )
        best = np.argmax(maxima.gains)
        frequency = float(frequencies[maxima.columns[best]])
        found = self.refined(samples, 1.0, int(maxima.onsets[best]), frequency).pulse
        return replace(found, start_time=found.start_time + window.start * self.time_step)


def _maxima(
    samples: np.ndarray, time_step: float, frequencies: np.ndarray, onsets: slice, share: float
) -> Maxima:
    from rocking.pulses.scan import local_maxima

    first, last, _ = onsets.indices(samples.shape[1])
    places, gains = local_maxima(samples, time_step, 2 * np.pi * time_step * frequencies, first, last, share)
    kept = gains >= share * gains.max(initial=0.0)
    return Maxima(places[kept, 0], places[kept, 1], gains[kept])


def energy_of(samples: np.ndarray, time_step: float) -> float:
    """∫a² dt, m²/s³. A plain sum: a dot product of long vectors starts threads and depends on their number."""
    return float(np.square(samples).sum()) * time_step


def shared_time(one: Pulse, other: Pulse) -> float:
    """Common time of two pulses over the time from the first start to the last end, 0 to 1."""
    common = min(one.end_time, other.end_time) - max(one.start_time, other.start_time)
    return max(common, 0.0) / (max(one.end_time, other.end_time) - min(one.start_time, other.start_time))
