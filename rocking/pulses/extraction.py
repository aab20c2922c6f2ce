"""The dominant sinusoidal acceleration pulse of a record: matched filter on acceleration with projected amplitude.

The compiled scan is imported where it is called: it loads numba, and who only names a setting or a method does not pay.
"""

import math
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.kinds import PulseKind
from rocking.pulses.pulse import Pulse, PulseAnalysis, PulseEvidence, PulseSettings
from rocking.quantities import instance
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

NOTHING_LEFT = 1e-20
"""Share of the record's energy below which what the pursuit leaves, or what a cycle gains, is rounding."""
LEAST_PEAK = 1e-100
"""Peak acceleration, m/s², above which squares do not vanish."""
GREATEST_PEAK = 1e100
"""Peak acceleration, m/s², below which squares do not overflow."""
PER_OCTAVE = 24
"""Frequencies of the scan in each octave."""
LEAST_SAMPLES = 8
"""Samples in the shortest cycle that is sought."""
SAME_OVERLAP = 0.5
"""Ratio of common to joint time from which two pulses are one."""
REFINEMENT_REACH = 3.0
"""Steps of the frequency grid that a refinement may walk from its scanned maximum."""
SCANNED_OVERLAP = 0.7
"""Share of common time from which two scanned maxima count as one; the narrower limit is applied after refinement."""
LEAST_SHARE = 0.01
"""Share of the largest gain below which a maximum of the scan is no rival."""
NEAR_BEST = 0.8
"""Share of the largest scanned gain from which a maximum is worth a look when only the best is wanted."""
NEAR_TIME = 0.5
"""Periods between two onsets within which a pulse that is found again is the same pulse."""
NEAR_OCTAVES = 0.5
"""Octaves of frequency within which it is."""

EQUAL_GAIN_RATIO = 0.85
"""Second gain over first above which the choice between the two is not the record's."""
OSCILLATION_GAIN_RATIO = 0.7
"""Gain of the half-shifted twins over that of a cycle amid an oscillation: 1 in two full cycles, 0.25 in one."""
ADJOINING_PERIOD_CHANGE = 0.25
"""Relative change of period up to which a neighbouring cycle continues the same oscillation."""
ADJOINING_GAP = 0.25
"""Distance between the end of one cycle and the start of the next, in periods, up to which they adjoin."""
EDGE_ACCELERATION = 0.3
"""First or last acceleration over the pulse's amplitude from which the motion was cut, not quiet."""
EDGE_DISTANCE = 0.1
"""Distance from an end of the record, in periods, below which the cycle may have been cut."""
FILTERED_CYCLES = 0.2
"""Periods beyond this share of the longest period that a high-pass leaves are reduced by it."""
GAP_DURATION = 1.0
"""Run of identical samples, s, that looks like a filled gap."""
SAMPLES_ENOUGH = 40
"""Samples in the shortest cycle that a search needs; the sum of squares of a sine over so many is exact."""
LEAST_THINNING = 4
"""Times finer than that from which only every fourth, fifth, ... sample is searched, as of the motion of a floor."""


def extract_pulses(accelerogram: Accelerogram, *, settings: PulseSettings | None = None) -> PulseAnalysis:
    """Return the one-cycle sine pulses of largest energy gain in `accelerogram`.

    The gain G = ⟨a, s⟩²/⟨s, s⟩ is scanned over frequencies and onsets; the best maxima are refined on the
    continuous sine and ranked by gain. The record is taken as it stands: no filter, no baseline; of one that
    is sampled far more finely than its shortest cycle needs, samples in between are left out.

    Parameters
    ----------
    accelerogram : Accelerogram
        The record, taken as it stands.
    settings : PulseSettings or None, optional
        Range of the search; None: the default.

    Returns
    -------
    PulseAnalysis
        The pulses ranked by energy gain, the pursuit, and reasons to doubt the dominant one.

    Raises
    ------
    PulseError
        When the samples are all equal or no period of the band fits the record.

    Examples
    --------
    >>> import numpy as np
    >>> from rocking import Accelerogram, Pulse, extract_pulses
    >>> motion = Pulse(amplitude=3.0, circular_frequency=5.0, start_time=4.0).acceleration(np.arange(0, 20, 0.01))
    >>> extract_pulses(Accelerogram(motion, time_step=0.01)).dominant
    Pulse(3 m/s² = 0.3059 g, period 1.257 s, start 4 s)
    """
    instance(PulseError, "accelerogram", accelerogram, Accelerogram)
    settings = settings or PulseSettings()
    samples = accelerogram.acceleration
    name = accelerogram.source.path or "The accelerogram"
    if np.ptp(samples) == 0:
        raise PulseError(
            f"{name} holds {samples.size} samples that all equal {samples[0]:g} m/s², but a pulse can only be sought "
            "in a record that moves; check the file and its channel.",
            acceleration=float(samples[0]),
        )
    if not LEAST_PEAK < accelerogram.peak_acceleration < GREATEST_PEAK:
        raise PulseError(
            f"{name} has a peak of {accelerogram.peak_acceleration:g} m/s², but a peak between {LEAST_PEAK:g} and "
            f"{GREATEST_PEAK:g} m/s² is needed; check its unit.",
            peak_acceleration=accelerogram.peak_acceleration,
        )
    searched = _thinned(accelerogram, settings)
    search = PulseSearch.of(searched, settings)
    samples = searched.acceleration
    maxima = search.maxima(samples)
    if maxima.gains.max(initial=0.0) <= NOTHING_LEFT * search.energy(samples):
        raise PulseError(
            f"{name} holds no motion that a cycle within it could explain; its samples differ only at its ends, so "
            "check the file.",
            acceleration=samples,
        )
    ranked = search.ranked(samples, maxima)
    sequence = _pursued(search, samples, maxima, ranked[0])
    flags = _raised(searched, search, ranked, sequence)
    return PulseAnalysis(accelerogram, ranked, sequence, flags, search.band)


def _thinned(accelerogram: Accelerogram, settings: PulseSettings) -> Accelerogram:
    """Return every sample that the search needs: itself where that is all of them."""
    enough = 1 / (SAMPLES_ENOUGH * settings.highest_frequency)
    stride = math.floor(enough / accelerogram.time_step * (1 + 1e-9))
    if stride < LEAST_THINNING or accelerogram.acceleration.size <= 2 * stride:
        return accelerogram
    thinned = accelerogram.acceleration[::stride]
    return replace(
        accelerogram, acceleration=thinned, time_step=stride * accelerogram.time_step, smooth_steps=1
    )


class Maxima(NamedTuple):
    """Local maxima of the energy gain on the grid: onsets (k,) samples, columns (k,) of the frequency, gains (k,)."""

    onsets: np.ndarray
    columns: np.ndarray
    gains: np.ndarray


@dataclass(frozen=True, eq=False)
class PulseSearch:
    """A search with one time step, settings and frequencies (m,) Hz, ascending; of a record or a residual."""

    time_step: float
    frequencies: np.ndarray
    settings: PulseSettings

    @classmethod
    def of(cls, accelerogram: Accelerogram, settings: PulseSettings) -> "PulseSearch":
        """Return that of the frequencies in `settings` that the record can hold; raises PulseError without any."""
        step = accelerogram.time_step
        low = max(settings.lowest_frequency, 1 / accelerogram.duration)
        high = min(settings.highest_frequency, 1 / (LEAST_SAMPLES * step))
        if low >= high:
            raise PulseError(
                f"{accelerogram.source.path or 'The accelerogram'} lasts {accelerogram.duration:g} s at a time step of "
                f"{step:g} s, but a pulse between {settings.lowest_frequency:g} and "
                f"{settings.highest_frequency:g} Hz needs one period of record and {LEAST_SAMPLES} "
                "samples in a cycle; give a longer or more finely sampled record, or widen the band."
            )
        count = math.ceil(PER_OCTAVE * math.log2(high / low) - 1e-9) + 1
        frequencies = low * 2.0 ** (np.arange(count) / PER_OCTAVE)
        frequencies[-1] = high
        return cls(step, frequencies, settings)

    @property
    def band(self) -> tuple[float, float]:
        """Lowest and highest frequency, Hz."""
        return float(self.frequencies[0]), float(self.frequencies[-1])

    def energy(self, samples: np.ndarray) -> float:
        """∫a² dt, m²/s³. A plain sum: a dot product of long vectors starts threads and depends on their number."""
        return float(np.square(samples).sum()) * self.time_step

    def maxima(
        self,
        samples: np.ndarray,
        onsets: slice = slice(None),
        frequencies: np.ndarray | None = None,
        share: float = LEAST_SHARE,
    ) -> Maxima:
        """Return the maxima of `samples`, (n,) m/s², at `onsets` and `frequencies` (m,) Hz, by default of the band.

        Of the samples only those are looked at that a cycle with such an onset can meet.
        """
        from rocking.pulses.scan import local_maxima

        frequencies_searched = self.frequencies if frequencies is None else frequencies
        first, last, _ = onsets.indices(samples.size)
        begin = max(first - 1, 0)
        met = samples[
            np.newaxis, begin : last + math.ceil(1 / (frequencies_searched[0] * self.time_step)) + 2
        ]
        angles = 2 * np.pi * self.time_step * frequencies_searched
        places, gains = local_maxima(met, self.time_step, angles, first - begin, last - begin, share)
        large = gains >= share * gains.max(initial=0.0)
        return Maxima(places[large, 0] + begin, places[large, 1], gains[large])

    def renewed(self, maxima: Maxima, samples: np.ndarray, changed: Pulse) -> Maxima:
        """Return `maxima` with those whose cycle can meet `changed`, where alone `samples` differ, searched again."""
        first = math.floor((changed.start_time - 1 / self.band[0]) / self.time_step) - 2
        last = math.ceil(changed.end_time / self.time_step) + 2
        onsets = slice(max(first, 0), min(last, samples.size))
        elsewhere = (maxima.onsets < onsets.start) | (maxima.onsets >= onsets.stop)
        kept = Maxima(*(values[elsewhere] for values in maxima))
        added = self.maxima(samples, onsets)
        return Maxima(*(np.concatenate([old, new]) for old, new in zip(kept, added, strict=True)))

    def ranked(self, samples: np.ndarray, maxima: Maxima) -> tuple[PulseEvidence, ...]:
        """Return the best pulses that do not cover one another, by refined gain."""
        from rocking.pulses.scan import apart

        refined = self.refined_maxima(samples, maxima, self.settings.candidates)
        starts = np.array([evidence.pulse.start_time for evidence in refined])
        ends = np.array([evidence.pulse.end_time for evidence in refined])
        gains = np.array([evidence.gain for evidence in refined])
        chosen = apart(starts, ends, gains, self.settings.alternatives, SAME_OVERLAP)
        return tuple(refined[place] for place in chosen)

    def refined_maxima(self, samples: np.ndarray, maxima: Maxima, count: int) -> list[PulseEvidence]:
        """Return the best `count` maxima that do not cover one another, refined, by refined gain."""
        from rocking.pulses.scan import apart

        starts = maxima.onsets * self.time_step
        ends = starts + 1 / self.frequencies[maxima.columns]
        energy = self.energy(samples)
        refined = [
            self.refined(
                samples, energy, int(maxima.onsets[best]), float(self.frequencies[maxima.columns[best]])
            )
            for best in apart(starts, ends, maxima.gains, count, SCANNED_OVERLAP)
        ]
        return sorted(refined, key=lambda evidence: -evidence.gain)

    def refined(self, samples: np.ndarray, energy: float, onset: int, frequency: float) -> PulseEvidence:
        """Return the pulse at the maximum of the gain near one scanned maximum; energy: ∫a² dt, m²/s³."""
        from rocking.pulses.scan import envelope_phase, refine

        turn = 2 * math.pi * self.time_step
        lowest, highest = (turn * limit for limit in self.band)
        reach = REFINEMENT_REACH * math.log(2) / PER_OCTAVE
        angle, start, sine, norm = refine(samples, onset, turn * frequency, lowest, highest, reach)
        pulse = Pulse(
            amplitude=sine / norm,
            circular_frequency=angle / self.time_step,
            start_time=start * self.time_step,
        )
        gain = sine * sine / norm * self.time_step
        return PulseEvidence(
            pulse=pulse,
            gain=gain,
            explained_energy=gain / energy,
            phase=envelope_phase(samples, round(start), angle),
        )

    def near(self, pulse: Pulse, samples: np.ndarray) -> PulseEvidence:
        """Return the best pulse in `samples` within half a period of onset and half an octave of `pulse`.

        Only the samples that such a pulse can touch are searched. Raises PulseError where no such cycle lies within
        the record or the samples there are still.
        """
        from rocking.pulses.scan import envelope_phase

        first = max(math.floor((pulse.start_time - NEAR_TIME * pulse.period) / self.time_step), 0)
        longest = (NEAR_TIME + 2**NEAR_OCTAVES) * pulse.period
        window = samples[first : math.ceil((pulse.start_time + longest) / self.time_step) + 2]
        steps = round(NEAR_OCTAVES * PER_OCTAVE)
        octaves = np.arange(-steps, steps + 1) / PER_OCTAVE
        frequencies = np.unique(np.clip(2.0**octaves / pulse.period, *self.band))
        onsets = math.ceil((pulse.start_time + NEAR_TIME * pulse.period) / self.time_step) + 1 - first
        maxima = self.maxima(window, slice(0, onsets), frequencies, NEAR_BEST)
        if not maxima.gains.size:
            raise PulseError(
                f"No sine of about {pulse.period:.3g} s lies within the record near {pulse.start_time:.3g} s; "
                "give a longer record or another pulse method."
            )
        best = np.argmax(maxima.gains)
        frequency = float(frequencies[maxima.columns[best]])
        evidence = self.refined(window, self.energy(samples), int(maxima.onsets[best]), frequency)
        sine = replace(evidence.pulse, start_time=evidence.pulse.start_time + first * self.time_step)
        onset = round(sine.start_time / self.time_step)
        angle = sine.circular_frequency * self.time_step
        return replace(evidence, pulse=sine, phase=envelope_phase(samples, onset, angle))


def _pursued(
    search: PulseSearch, samples: np.ndarray, maxima: Maxima, first: PulseEvidence
) -> tuple[PulseEvidence, ...]:
    """Return `first` and the pulses found in turn in what the ones before left."""
    sequence = [first]
    residual = samples.copy()
    while len(sequence) < search.settings.pursuit:
        _take_out(sequence[-1].pulse, residual, search.time_step)
        if search.energy(residual) <= NOTHING_LEFT * search.energy(samples):
            break
        maxima = search.renewed(maxima, residual, sequence[-1].pulse)
        refined = search.refined_maxima(residual, maxima, 2)
        if not refined:
            break
        sequence.append(refined[0])
    return tuple(sequence)


def _take_out(pulse: Pulse, samples: np.ndarray, time_step: float) -> None:
    """Subtract a pulse from `samples`, of which it meets but a few."""
    begin = max(math.floor(pulse.start_time / time_step), 0)
    met = slice(begin, math.ceil(pulse.end_time / time_step) + 1)
    times = np.arange(begin, min(met.stop, samples.size)) * time_step
    samples[met] -= pulse.acceleration(times)


def _raised(
    accelerogram: Accelerogram,
    search: PulseSearch,
    ranked: tuple[PulseEvidence, ...],
    sequence: tuple[PulseEvidence, ...],
) -> tuple[RockingWarning, ...]:
    """The flags of the dominant pulse."""
    pulse = ranked[0].pulse
    second = ranked[1] if len(ranked) > 1 else None
    equal = second is not None and second.gain / ranked[0].gain > EQUAL_GAIN_RATIO
    strong = [other.pulse for other in ranked[1:] if other.gain > OSCILLATION_GAIN_RATIO * ranked[0].gain]
    more_cycles = oscillates(pulse, strong)
    for neighbour in (following.pulse for following in sequence[1:2]):  # which continues the same oscillation
        gap = min(abs(neighbour.start_time - pulse.end_time), abs(pulse.start_time - neighbour.end_time))
        alike = abs(neighbour.period / pulse.period - 1) <= ADJOINING_PERIOD_CHANGE
        more_cycles = more_cycles or (alike and gap <= ADJOINING_GAP * pulse.period)
    high_pass = accelerogram.high_pass_frequency
    samples = accelerogram.acceleration
    step = accelerogram.time_step
    frequency = 1 / pulse.period
    low, high = search.band
    rooms = pulse.start_time / pulse.period, ((samples.size - 1) * step - pulse.end_time) / pulse.period
    loud = np.abs(samples[[0, -1]]) > EDGE_ACCELERATION * abs(pulse.amplitude)
    changes = np.flatnonzero(np.diff(samples))  # a run of identical samples at an end is padding, no gap
    raised = {
        PulseKind.PULSE_UNSTABLE: equal or more_cycles,
        PulseKind.PULSE_AT_AN_END: np.any(rooms < np.where(loud, 1.0, EDGE_DISTANCE)),
        PulseKind.PULSE_FILTERED: high_pass is not None and pulse.period > FILTERED_CYCLES / high_pass,
        PulseKind.PULSE_SYMMETRIC: equal and second is not None and _twin(pulse, second.pulse),
        PulseKind.PULSE_AT_BAND_LIMIT: not low * (1 + 1e-9) < frequency < high * (1 - 1e-9),
        PulseKind.PULSE_NEXT_TO_GAP: (np.diff(changes).max(initial=1) - 1) * step > GAP_DURATION,
        PulseKind.PULSE_RECORD_SHORT: low > search.settings.lowest_frequency,
        PulseKind.PULSE_SAMPLING_COARSE: high < search.settings.highest_frequency,
    }
    return tuple(RockingWarning(kind) for kind, holds in raised.items() if holds)


def oscillates(pulse: Pulse, strong_rivals: list[Pulse]) -> bool:
    """Whether twins of opposite sign lie half a cycle before and after: the middle cycle of a longer motion."""
    starts = [rival.start_time for rival in strong_rivals if _twin(pulse, rival)]
    return bool(starts) and min(starts) < pulse.start_time < max(starts)


def _twin(pulse: Pulse, rival: Pulse) -> bool:
    """Whether `rival` has the opposite sign, nearly the same period and lies half a cycle away."""
    distance = abs(rival.start_time + rival.period / 2 - pulse.start_time - pulse.period / 2)
    return (
        rival.amplitude * pulse.amplitude < 0
        and abs(rival.period / pulse.period - 1) <= ADJOINING_PERIOD_CHANGE
        and abs(distance / pulse.period - 0.5) <= ADJOINING_GAP / 2
    )
