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
"""Share of the largest scanned gain from which a maximum can still become the best by refinement."""
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


def scanned_gains(
    samples: np.ndarray,
    time_step: float,
    frequencies: np.ndarray,
    into: np.ndarray | None = None,
    onsets: slice = slice(None),
) -> np.ndarray:
    """Return the energy gain, (n, m) m²/s³, of a cycle of each frequency (m,) Hz that starts at each sample (n,).

    into: a map to renew at `onsets` only; by default a new one. Where the cycle does not fit the gain is 0.
    """
    from rocking.pulses.scan import energy_gains

    gains = np.empty((samples.size, len(frequencies))) if into is None else into
    first, last, _ = onsets.indices(samples.size)
    energy_gains(
        samples, time_step, 2 * np.pi * time_step * np.asarray(frequencies, float), first, last, gains
    )
    return gains


@dataclass(frozen=True, eq=False)
class PulseSearch:
    """A search with one time step, band and settings; the samples may be a record, a residual or a rotation."""

    time_step: float
    band: Band
    settings: PulseSettings

    def gains(self, samples: np.ndarray) -> np.ndarray:
        """Return the energy map of `samples`, (n, m) m²/s³."""
        return scanned_gains(samples, self.time_step, self.band.frequencies)

    def renew(self, gains: np.ndarray, samples: np.ndarray, changed: Pulse) -> None:
        """Scan again the onsets whose cycle can meet `changed`, where alone `samples` differ from before."""
        first = math.floor((changed.start_time - 1 / self.band.limits[0]) / self.time_step) - 1
        last = math.ceil(changed.end_time / self.time_step) + 1
        onsets = slice(max(first, 0), min(last, samples.size))
        scanned_gains(samples, self.time_step, self.band.frequencies, gains, onsets)

    def ranked(self, samples: np.ndarray, gains: np.ndarray) -> tuple[PulseEvidence, ...]:
        """Return the best pulses that do not cover one another, by refined gain."""
        energy = float(samples @ samples) * self.time_step
        refined = [self.refined(samples, energy, *place) for place in self.candidates(gains)]
        refined.sort(key=lambda evidence: -evidence.gain)
        kept: list[PulseEvidence] = []
        for evidence in refined:
            if all(shared_time(evidence.pulse, other.pulse) < self.settings.overlap for other in kept):
                kept.append(evidence)
        return tuple(kept[: self.settings.alternatives])

    def best(self, samples: np.ndarray, gains: np.ndarray) -> PulseEvidence | None:
        """Return the pulse of largest refined gain; None where nothing is left to find."""
        energy = float(samples @ samples) * self.time_step
        places = self.candidates(gains, 2, NEAR_BEST)
        found = [self.refined(samples, energy, *place) for place in places]
        return max(found, key=lambda evidence: evidence.gain, default=None)

    def candidates(
        self, gains: np.ndarray, count: int | None = None, share: float = LEAST_SHARE
    ) -> list[tuple[int, float]]:
        """Return (onset sample, frequency in Hz) of the best scanned maxima that do not cover one another."""
        from rocking.pulses.scan import local_maxima

        maxima = local_maxima(gains, share * gains.max())
        maxima = maxima[np.argsort(-gains[maxima[:, 0], maxima[:, 1]], kind="stable")]
        starts, frequencies = maxima[:, 0] * self.time_step, self.band.frequencies[maxima[:, 1]]
        ends, free = starts + 1 / frequencies, np.ones(len(maxima), bool)
        kept: list[tuple[int, float]] = []
        while len(kept) < (count or self.settings.candidates) and free.any():
            best = int(np.argmax(free))
            kept.append((int(maxima[best, 0]), float(frequencies[best])))
            common = np.minimum(ends, ends[best]) - np.maximum(starts, starts[best])
            joint = np.maximum(ends, ends[best]) - np.minimum(starts, starts[best])
            free &= common < SCANNED_OVERLAP * joint
        return kept

    def refined(self, samples: np.ndarray, energy: float, onset: int, frequency: float) -> PulseEvidence:
        """Return the pulse at the maximum of the gain near one scanned maximum; energy: ∫a² dt, m²/s³."""
        from rocking.pulses.scan import envelope_phase, refine

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
        """Return the best pulse in `samples`, which fill `window`, within half a period and half an octave."""
        steps = round(NEAR_OCTAVES * self.settings.per_octave)
        frequencies = 2.0 ** (np.arange(-steps, steps + 1) / self.settings.per_octave) / pulse.period
        frequencies = np.unique(np.clip(frequencies, *self.band.limits))
        onsets = math.ceil((pulse.start_time + NEAR_TIME * pulse.period) / self.time_step) + 1 - window.start
        gains = np.zeros((samples.size, frequencies.size))
        scanned_gains(samples, self.time_step, frequencies, gains, slice(0, onsets))
        onset, place = np.unravel_index(np.argmax(gains), gains.shape)
        found = self.refined(samples, 1.0, int(onset), float(frequencies[place])).pulse
        return replace(found, start_time=found.start_time + window.start * self.time_step)


def shared_time(one: Pulse, other: Pulse) -> float:
    """Common time of two pulses over the time from the first start to the last end, 0 to 1."""
    common = min(one.end_time, other.end_time) - max(one.start_time, other.start_time)
    return max(common, 0.0) / (max(one.end_time, other.end_time) - min(one.start_time, other.start_time))
