"""The dominant sinusoidal acceleration pulse of a record: matched filter on acceleration with projected amplitude."""

import math

import numpy as np

from rocking.errors import PulseError
from rocking.pulses import flags as rules
from rocking.pulses.analysis import PulseAnalysis, PulseEvidence
from rocking.pulses.flags import Flag
from rocking.pulses.search import Band, Maxima, PulseSearch, energy_of, searched_band
from rocking.pulses.settings import PulseSettings
from rocking.records.accelerogram import Accelerogram

NOTHING_LEFT = 1e-20
"""Share of the record's energy below which what the pursuit leaves, or what a cycle gains, is rounding."""
LEAST_PEAK, GREATEST_PEAK = 1e-100, 1e100
"""Peak accelerations, m/s², whose squares neither vanish nor overflow."""


def extract_pulses(accelerogram: Accelerogram, *, settings: PulseSettings | None = None) -> PulseAnalysis:
    """Return the one-cycle sine pulses of largest energy gain in `accelerogram`.

    The gain G = ⟨a, s⟩²/⟨s, s⟩ is scanned over frequencies and onsets; the best maxima are refined on the
    continuous sine and ranked by gain. The record is taken as it stands: no filter, no baseline.
    Raises PulseError when the samples are all equal or no period of the band fits the record.
    """
    settings = settings or PulseSettings()
    samples = _varying(accelerogram)
    band = searched_band(accelerogram, settings)
    search = PulseSearch(accelerogram.time_step, band, settings)
    maxima = _something(accelerogram, search.maxima(samples))
    ranked = search.ranked(samples, maxima)
    sequence = _pursued(search, samples, maxima, ranked[0])
    residual = samples - ranked[0].pulse.acceleration(accelerogram.times)
    residual.flags.writeable = False
    raised = (*_raised(accelerogram, ranked, sequence, band), *band.flags)
    return PulseAnalysis(accelerogram, ranked, sequence, residual, raised, band.limits)


def energy_map(
    accelerogram: Accelerogram, *, settings: PulseSettings | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Return (gains, frequencies): the energy gain (n, m) in m²/s³ of a cycle that starts at each sample (n,).

    frequencies: (m,) Hz, ascending. Where the cycle does not fit in the record the gain is 0.
    """
    from rocking.pulses.scan import energy_gains

    frequencies = searched_band(accelerogram, settings or PulseSettings()).frequencies
    angles = 2 * np.pi * accelerogram.time_step * frequencies
    return energy_gains(accelerogram.acceleration[np.newaxis], accelerogram.time_step, angles), frequencies


def _pursued(
    search: PulseSearch, samples: np.ndarray, maxima: Maxima, first: PulseEvidence
) -> tuple[PulseEvidence, ...]:
    """Return `first` and the pulses sought in turn in what the ones before left."""
    sequence, residual = [first], samples.copy()
    times = np.arange(samples.size) * search.time_step
    while len(sequence) < search.settings.pursuit:
        residual -= sequence[-1].pulse.acceleration(times)
        if energy_of(residual, search.time_step) <= NOTHING_LEFT * energy_of(samples, search.time_step):
            break
        maxima = search.renewed(maxima, residual, sequence[-1].pulse)
        found = search.best(residual, maxima)
        if found is None:
            break
        sequence.append(found)
    return tuple(sequence)


def _raised(
    accelerogram: Accelerogram,
    ranked: tuple[PulseEvidence, ...],
    sequence: tuple[PulseEvidence, ...],
    band: Band,
) -> tuple[Flag, ...]:
    pulse, second = ranked[0].pulse, ranked[1] if len(ranked) > 1 else None
    ratio = second.gain / ranked[0].gain if second else 0.0
    frequency = pulse.circular_frequency / (2 * math.pi)
    strong = rules.OSCILLATION_GAIN_RATIO * ranked[0].gain
    found = {
        Flag.AMBIGUOUS: rules.ambiguous(ratio),
        Flag.MULTI_CYCLE: (len(sequence) > 1 and rules.adjoins(pulse, sequence[1].pulse))
        or rules.oscillates(pulse, [other.pulse for other in ranked[1:] if other.gain > strong]),
        Flag.EDGE: rules.at_edge(pulse, accelerogram.acceleration, accelerogram.time_step),
        Flag.FILTERED: rules.filtered(pulse, accelerogram.high_pass_frequency),
        Flag.SYMMETRIC: second is not None and rules.mirrored(pulse, second.pulse, ratio),
        Flag.BAND_LIMIT: not band.limits[0] * (1 + 1e-9) < frequency < band.limits[1] * (1 - 1e-9),
        Flag.GAP: rules.holds_gap(accelerogram.acceleration, accelerogram.time_step),
    }
    return tuple(flag for flag, raised in found.items() if raised)


def _varying(accelerogram: Accelerogram) -> np.ndarray:
    samples, name = accelerogram.acceleration, accelerogram.source.path or "The accelerogram"
    if np.ptp(samples) == 0:
        raise PulseError(
            f"{name} holds {samples.size} samples that all equal {samples[0]:g} m/s², but a pulse can only be sought "
            "in a record that moves; check the file and its channel."
        )
    if not LEAST_PEAK < accelerogram.peak_acceleration < GREATEST_PEAK:
        raise PulseError(
            f"{name} has a peak of {accelerogram.peak_acceleration:g} m/s², but a peak between {LEAST_PEAK:g} and "
            f"{GREATEST_PEAK:g} m/s² is needed; check its unit."
        )
    return samples


def _something(accelerogram: Accelerogram, maxima: Maxima) -> Maxima:
    energy = energy_of(accelerogram.acceleration, accelerogram.time_step)
    if maxima.gains.max(initial=0.0) <= NOTHING_LEFT * energy:
        raise PulseError(
            f"{accelerogram.source.path or 'The accelerogram'} holds no motion that a cycle within it could explain; "
            "its samples differ only at its ends, so check the file."
        )
    return maxima
