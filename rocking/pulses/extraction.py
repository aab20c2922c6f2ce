"""The dominant sinusoidal acceleration pulse of a record: matched filter on acceleration with projected amplitude."""

import math
from dataclasses import dataclass

import numpy as np

from rocking.errors import PulseError
from rocking.pulses import flags as rules
from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.flags import Flag
from rocking.pulses.pulse import Pulse
from rocking.pulses.settings import PulseSettings
from rocking.records.accelerogram import Accelerogram

REFINEMENT_REACH = 3.0
"""Steps of the frequency grid that a refinement may walk from its scanned maximum."""
SCANNED_OVERLAP = 0.7
"""Share of common time from which two scanned maxima count as one; the narrower limit is applied after refinement."""
NEAR_BEST = 0.8
"""Share of the largest scanned gain from which a maximum can still become the best by refinement."""
LEAST_SHARE = 0.01
"""Share of the largest gain below which a maximum of the scan is no rival."""
GAP_DURATION = 1.0
"""Run of identical samples, s, that looks like a filled gap."""


@dataclass(frozen=True, eq=False)
class Band:
    """The frequencies that can be sought in a record: (m,) Hz, ascending, and why the band was narrowed."""

    frequencies: np.ndarray
    flags: tuple[Flag, ...]

    @property
    def limits(self) -> tuple[float, float]:
        """Lowest and highest frequency, Hz."""
        return float(self.frequencies[0]), float(self.frequencies[-1])


def extract_pulses(accelerogram: Accelerogram, *, settings: PulseSettings | None = None) -> PulseAnalysis:
    """Return the one-cycle sine pulses of largest energy gain in `accelerogram`.

    The gain G = ⟨a, s⟩²/⟨s, s⟩ is scanned over frequencies and onsets; the best maxima are refined on the
    continuous sine and ranked by gain. The record is taken as it stands: no filter, no baseline.
    Raises PulseError when the samples are all equal or no period of the band fits the record.
    """
    settings = settings or PulseSettings()
    samples = _varying(accelerogram)
    band = searched_band(accelerogram, settings)
    gains = energy_map(accelerogram, band.frequencies)
    search = _Search(accelerogram.time_step, band, settings, LEAST_SHARE * float(gains.max()))
    ranked = search.ranked(samples, gains)
    sequence = search.pursued(samples, gains, ranked[0])
    residual = samples - ranked[0].pulse.acceleration(accelerogram.times)
    residual.flags.writeable = False
    raised = (*_raised(accelerogram, ranked, sequence, band), *band.flags)
    return PulseAnalysis(accelerogram, ranked, sequence, residual, raised, band.limits)


def energy_map(accelerogram: Accelerogram, frequencies: np.ndarray) -> np.ndarray:
    """Return the energy gain, (n, m) m²/s³, of a cycle of each frequency (m,) Hz that starts at each sample (n,)."""
    gains = np.zeros((accelerogram.acceleration.size, len(frequencies)))
    _scan(accelerogram.acceleration, accelerogram.time_step, frequencies, gains)
    return gains


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
            f"{_named(accelerogram)} lasts {accelerogram.duration:g} s at a time step of "
            f"{accelerogram.time_step:g} s, but a pulse between {settings.lowest_frequency:g} and "
            f"{settings.highest_frequency:g} Hz needs one period of record and {settings.samples_per_cycle:g} "
            "samples in a cycle; give a longer or more finely sampled record, or widen the band."
        )
    steps = math.ceil(settings.per_octave * math.log2(high / low) - 1e-9)
    frequencies = low * 2.0 ** (np.arange(steps + 1) / settings.per_octave)
    frequencies[-1] = high
    return Band(frequencies, tuple(found))


@dataclass(frozen=True, eq=False)
class _Search:
    """The search of one record: what stays the same while its samples give way to residuals."""

    time_step: float
    band: Band
    settings: PulseSettings
    floor: float

    def ranked(self, samples: np.ndarray, gains: np.ndarray) -> tuple[PulseEvidence, ...]:
        """Return the best pulses that do not cover one another, by refined gain."""
        energy = float(samples @ samples) * self.time_step
        starts = self._candidates(gains, self.settings.candidates, self.floor)
        refined = [self._refined(samples, energy, onset, frequency) for onset, frequency in starts]
        refined.sort(key=lambda evidence: -evidence.gain)
        kept: list[PulseEvidence] = []
        for evidence in refined:
            if all(_shared(evidence.pulse, other.pulse) < self.settings.overlap for other in kept):
                kept.append(evidence)
        return tuple(kept[: self.settings.alternatives])

    def pursued(
        self, samples: np.ndarray, gains: np.ndarray, first: PulseEvidence
    ) -> tuple[PulseEvidence, ...]:
        """Return `first` and the pulses sought in turn in what the ones before left."""
        sequence, residual, gains = [first], samples.copy(), gains.copy()
        times = np.arange(samples.size) * self.time_step
        while len(sequence) < self.settings.pursuit:
            pulse = sequence[-1].pulse
            residual -= pulse.acceleration(times)
            self._rescan(residual, gains, pulse)
            energy = float(residual @ residual) * self.time_step
            starts = self._candidates(gains, 2, max(self.floor, NEAR_BEST * float(gains.max())))
            found = [self._refined(residual, energy, onset, frequency) for onset, frequency in starts]
            if not found:
                break
            sequence.append(max(found, key=lambda evidence: evidence.gain))
        return tuple(sequence)

    def _rescan(self, residual: np.ndarray, gains: np.ndarray, pulse: Pulse) -> None:
        """Scan again the onsets whose cycle can meet `pulse`."""
        first = int((pulse.start_time - 1 / self.band.frequencies[0]) / self.time_step) - 1
        last = int(pulse.end_time / self.time_step) + 2
        _scan(residual, self.time_step, self.band.frequencies, gains, max(first, 0), min(last, residual.size))

    def _candidates(self, gains: np.ndarray, count: int, floor: float) -> list[tuple[int, float]]:
        """Return (onset sample, frequency in Hz) of the best scanned maxima that do not cover one another."""
        from rocking.pulses.scan import local_maxima

        maxima = local_maxima(gains, floor)
        maxima = maxima[np.argsort(-gains[maxima[:, 0], maxima[:, 1]], kind="stable")]
        starts, frequencies = maxima[:, 0] * self.time_step, self.band.frequencies[maxima[:, 1]]
        ends = starts + 1 / frequencies
        kept: list[tuple[int, float]] = []
        free = np.ones(len(maxima), bool)
        while len(kept) < count and free.any():
            best = int(np.argmax(free))
            kept.append((int(maxima[best, 0]), float(frequencies[best])))
            common = np.minimum(ends, ends[best]) - np.maximum(starts, starts[best])
            joint = np.maximum(ends, ends[best]) - np.minimum(starts, starts[best])
            free &= common < SCANNED_OVERLAP * joint
        return kept

    def _refined(self, samples: np.ndarray, energy: float, onset: int, frequency: float) -> PulseEvidence:
        from rocking.pulses.scan import refine

        turn = 2 * math.pi * self.time_step
        lowest, highest = (turn * limit for limit in self.band.limits)
        reach = REFINEMENT_REACH * math.log(2) / self.settings.per_octave
        angle, start, sine, cosine, norm = refine(samples, onset, turn * frequency, lowest, highest, reach)
        pulse = Pulse(sine / norm, angle / self.time_step, start * self.time_step)
        gain = sine * sine / norm * self.time_step
        return PulseEvidence(
            pulse, gain, gain / energy, math.atan2(math.copysign(1, sine) * cosine, abs(sine))
        )


def _scan(samples, time_step, frequencies, gains, first=0, last=None) -> None:
    from rocking.pulses.scan import energy_gains

    angles = 2 * np.pi * time_step * np.asarray(frequencies, dtype=float)
    energy_gains(samples, time_step, angles, first, samples.size if last is None else last, gains)


def _shared(one: Pulse, other: Pulse) -> float:
    """Common time of two pulses divided by the time from the first start to the last end."""
    common = min(one.end_time, other.end_time) - max(one.start_time, other.start_time)
    return max(common, 0.0) / (max(one.end_time, other.end_time) - min(one.start_time, other.start_time))


def _raised(accelerogram: Accelerogram, ranked, sequence, band: Band) -> tuple[Flag, ...]:
    pulse, second = ranked[0].pulse, ranked[1] if len(ranked) > 1 else None
    ratio = second.gain / ranked[0].gain if second else 0.0
    frequency = pulse.circular_frequency / (2 * math.pi)
    found = {
        Flag.AMBIGUOUS: rules.ambiguous(ratio),
        Flag.MULTI_CYCLE: len(sequence) > 1 and rules.adjoins(pulse, sequence[1].pulse),
        Flag.EDGE: rules.at_edge(pulse, accelerogram.duration),
        Flag.FILTERED: rules.filtered(pulse, accelerogram.high_pass_frequency),
        Flag.SYMMETRIC: second is not None and rules.mirrored(pulse, second.pulse, ratio),
        Flag.BAND_LIMIT: not band.limits[0] * (1 + 1e-9) < frequency < band.limits[1] * (1 - 1e-9),
        Flag.GAP: _longest_run(accelerogram.acceleration) * accelerogram.time_step > GAP_DURATION,
    }
    return tuple(flag for flag, raised in found.items() if raised)


def _longest_run(samples: np.ndarray) -> int:
    """Steps of the longest run of identical samples that other samples enclose."""
    changes = np.flatnonzero(np.diff(samples))
    return int(np.diff(changes).max(initial=1)) - 1


def _varying(accelerogram: Accelerogram) -> np.ndarray:
    samples = accelerogram.acceleration
    if np.ptp(samples) == 0:
        raise PulseError(
            f"{_named(accelerogram)} holds {samples.size} samples that all equal {samples[0]:g} m/s², "
            "but a pulse can only be sought in a record that moves; check the file and its channel."
        )
    return samples


def _named(accelerogram: Accelerogram) -> str:
    return accelerogram.source.path or "The accelerogram"
