"""The velocity pulse of two components and its period T_p (Shahi & Baker 2014). T_p is never 2π/ω_g of a Pulse.

Shahi, S. K. & Baker, J. W. (2014). An efficient algorithm to identify strong-velocity pulses in multicomponent
ground motions. Bull. Seism. Soc. Am. 104(5), 2456–2466. The db4 transform of both components gives, in closed form,
the largest coefficient over all orientations; the five largest are pulses that may be, and the indicator decides.
"""

import math
from dataclasses import dataclass
from functools import cache, lru_cache
from itertools import chain

import numpy as np

from rocking.errors import PulseError
from rocking.pulses.pulse import Pulse
from rocking.signal.accelerogram import Accelerogram
from rocking.signal.processing import fast_length, integral
from rocking.signal.rotation import paired

SUPPORT = 7.0
"""Length of db4 in its own time; its centre frequency is 5 cycles over it."""
LARGEST_KEPT = 2**16
"""Length of the longest transform of a wavelet that is kept for the next time: 1 MB each."""
SHORTEST_PERIOD = 0.25
"""Lower end of the band of T_p that is searched, s."""
LONGEST_PERIOD = 15.0
"""Upper end of that band, s."""
SCALES = 50
"""Steps of the first search over scales; the best is then refined to one sample."""
RESOLUTION = 64
"""Samples of a wavelet's unit of time that its search needs; more are averaged, which changes it by less than 0.1 %."""
MOST_SAMPLES = 2_000_000
"""Samples of the longest record that is searched, hours of any recorder; ten million would take gigabytes."""
POTENTIAL_PULSES = 5
"""Pulses that the indicator judges, by size."""
WAVELETS = 10
"""Wavelets of one scale that make up one pulse."""
NEIGHBOURHOOD = 0.4
"""Distance in scales within which the wavelets of a pulse lie, and which a pulse keeps to itself."""
LATE_ENERGY = 0.17
"""Share of the squared velocity before the pulse from which it arrives too late to be a directivity pulse."""
PULSE_START = 0.05
"""Share of the pulse's squared velocity that marks its start."""
UNLIKE_PERIODS = 2.0
"""Factor between T_p and the period of a sine from which the two are not the same feature of the motion."""
PERIOD_OF_SCALE = SUPPORT / 5
"""T_p over the scale in s: the period of the largest Fourier amplitude of db4 (Baker 2007)."""


@dataclass(frozen=True, kw_only=True)
class VelocityPulse:
    """The velocity pulse of two horizontal components.

    period: T_p, s, pseudo-period of the wavelet. orientation: rad from the first component towards the second, in
    (−π/2, π/2]. peak_velocity: m/s, in that orientation, before extraction.
    indicator: PI; the motion is pulse-like where PI > 0 and the pulse is not late. centre_time: s.
    """

    period: float
    orientation: float
    peak_velocity: float
    indicator: float
    late: bool
    centre_time: float

    @property
    def pulse_like(self) -> bool:
        """Whether the published criterion calls the motion pulse-like."""
        return self.indicator > 0 and not self.late

    def is_unlike(self, sine: Pulse) -> bool:
        """Whether T_p and the period of `sine` differ by more than a factor 2."""
        ratio = sine.period / self.period
        return max(ratio, 1 / ratio) > UNLIKE_PERIODS


def velocity_pulse(first: Accelerogram, second: Accelerogram | None = None) -> VelocityPulse:
    """Return the velocity pulse of two horizontal components: the largest that is pulse-like, else the largest.

    Without a second component it is the pulse of the first alone, of orientation 0, to which the criterion was not
    fitted. Raises RecordError when the components do not fit together, PulseError when no pulse of the shortest period
    fits.
    """
    step = first.time_step
    pair = first.acceleration[np.newaxis] if second is None else np.array(paired(first, second))
    velocities, scales = _searched(pair, step)
    places = _largest(velocities, scales)
    pulses = (_judged(velocities, step, scales, row, column) for row, column in places)
    largest = next(pulses)
    return next((pulse for pulse in chain([largest], pulses) if pulse.pulse_like), largest)


def largest_velocity_pulse(accelerogram: Accelerogram) -> tuple[float, float]:
    """Return (T_p, centre) in s of the largest velocity pulse of one component, whether or not it is pulse-like.

    Raises PulseError when the record is still or too short for a pulse.
    """
    step = accelerogram.time_step
    velocities, scales = _searched(accelerogram.acceleration[np.newaxis], step)
    row, column = _largest(velocities, scales, 1)[0]
    return PERIOD_OF_SCALE * _refined_scale(velocities[0], scales, row, column) * step, column * step


def _searched(accelerations: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """The velocities of components (c, n), m/s, and the scales that are searched in them; raises PulseError."""
    if accelerations.shape[1] > MOST_SAMPLES:
        raise PulseError(
            f"The motion holds {accelerations.shape[1]} samples, but a velocity pulse is searched for in at most "
            f"{MOST_SAMPLES}; cut the record to its earthquake.",
            samples=accelerations.shape[1],
        )
    if not np.any(accelerations):
        raise PulseError(
            "The motion is zero throughout, but a velocity pulse needs one that moves; check the file.",
            acceleration=0.0,
        )
    velocities = np.array([integral(acceleration, step) for acceleration in accelerations])
    return velocities, searched_scales(step, velocities.shape[1])


def pulse_indicator(*, peak_ratio: float, energy_ratio: float, peak_velocity: float) -> float:
    """Return PI of Shahi & Baker (2014) from the residual's shares of PGV and of energy; peak_velocity in m/s.

    A quadratic in the principal component PC and in PGV [cm/s], both centred on the data it was fitted to.
    """
    component = 0.63 * peak_ratio + 0.777 * energy_ratio
    p = (component - 1.208421) / 0.2462717
    v = (100 * peak_velocity - 11.58861) / 18.88015
    return -7.817 - 0.5679 * p**2 - 0.1516 * v**2 - 3.0253 * p - 1.7396 * v - 2.7156 * p * v


def searched_scales(time_step: float, count: int) -> np.ndarray:
    """Return the scales, in samples, of the first search over T_p = 1.4 · scale · time_step."""
    lowest = max(math.floor(SHORTEST_PERIOD / PERIOD_OF_SCALE / time_step), 2)
    step = math.ceil((LONGEST_PERIOD / PERIOD_OF_SCALE / time_step - lowest) / SCALES)
    scales = lowest + step * np.arange(SCALES + 1)
    if SUPPORT * lowest > count:
        raise PulseError(
            f"The components hold {count} samples of {time_step:g} s, but a velocity pulse of {SHORTEST_PERIOD:g} s "
            f"needs {math.ceil(SUPPORT * lowest)}; give a longer record.",
            samples=count,
        )
    return scales


def _largest(
    velocities: np.ndarray, scales: np.ndarray, count: int = POTENTIAL_PULSES
) -> list[tuple[int, int]]:
    """(scale index, sample) of the largest coefficients over all orientations, c₁² + c₂², each keeping its room."""
    # One complex transform serves two components; more samples than the wavelet resolves are averaged.
    both = velocities[0] if len(velocities) == 1 else velocities[0] + 1j * velocities[1]
    widths = [max(1, scale // RESOLUTION) for scale in scales.tolist()]
    means = {n: both[: both.size // n * n].reshape(-1, n).mean(axis=1) for n in set(widths)}
    squares = [
        n * np.square(np.abs(transform(means[n], scale / n)))
        for n, scale in zip(widths, scales.tolist(), strict=True)
    ]
    places = []
    for _ in range(count):
        row = int(np.argmax([values.max() for values in squares]))
        width = widths[row]
        column = int(np.argmax(squares[row]))
        if width > 1:  # of the samples that were averaged there, and their neighbours
            low = max(0, (column - 1) * width)
            high = min((column + 2) * width, both.size)
            column = low + int(np.argmax(np.abs(coefficients(both, int(scales[row]), low, high))))
        places.append((row, column))
        room = NEIGHBOURHOOD * int(scales[row])
        for values, n in zip(squares, widths, strict=True):
            middle = column - (n - 1) / 2
            values[max(0, math.ceil((middle - room) / n)) : max(0, math.floor((middle + room) / n) + 1)] = 0
    return places


def _judged(velocities: np.ndarray, step: float, scales: np.ndarray, row: int, column: int) -> VelocityPulse:
    """Extract the pulse at one coefficient in its own orientation and judge it."""
    amplitudes = [coefficient_at(velocity, int(scales[row]), column) for velocity in velocities]
    first = amplitudes[0]
    second = amplitudes[1] if len(amplitudes) == 2 else 0.0
    orientation = (math.atan(second / first) if first else math.pi / 2) if second else 0.0
    velocity = math.cos(orientation) * velocities[0] + math.sin(orientation) * velocities[-1]
    scale = _refined_scale(velocity, scales, row, column)
    pulse, centre = _extracted(velocity, scale, column)
    peak = np.abs(velocity).max()
    remainder = np.abs(velocity - pulse).max()
    energy = ((velocity - pulse) ** 2).sum() / (velocity**2).sum()
    return VelocityPulse(
        period=PERIOD_OF_SCALE * scale * step,
        orientation=orientation,
        peak_velocity=float(peak),
        indicator=float(
            pulse_indicator(peak_ratio=remainder / peak, energy_ratio=energy, peak_velocity=peak)
        ),
        late=_late(velocity, pulse),
        centre_time=centre * step,
    )


def _refined_scale(velocity: np.ndarray, scales: np.ndarray, row: int, column: int) -> int:
    """Scale, to one sample, of the largest coefficient between the neighbours of one scale of the first search."""
    low = int(scales[max(row - 1, 0)])
    high = int(scales[min(row + 1, len(scales) - 1)])
    stride = math.isqrt(high - low) or 1
    # The size has one peak there, many strides wide.
    coarse = range(low, high + 1, stride)
    sizes = [abs(coefficient_at(velocity, scale, column)) for scale in coarse]
    near = coarse[int(np.argmax(sizes))]
    fine = range(max(low, near - stride), min(high, near + stride) + 1)
    sizes = [abs(coefficient_at(velocity, scale, column)) for scale in fine]
    return fine[int(np.argmax(sizes))]


def _extracted(velocity: np.ndarray, scale: int, column: int) -> tuple[np.ndarray, int]:
    """Return the pulse, as the sum of the largest wavelets of one scale near `column`, and its first centre."""
    pulse = np.zeros_like(velocity)
    centre = column
    reach = math.ceil(NEIGHBOURHOOD * scale)
    for number in range(WAVELETS):
        low = max(0, centre - reach)
        high = min(centre + reach + 1, velocity.size)
        sizes = coefficients(velocity - pulse, scale, low, high).real
        best = int(np.argmax(np.abs(sizes)))
        begin, end, wavelet = overlap(velocity.size, scale, low + best)
        pulse[begin:end] += sizes[best] * wavelet
        if number == 0:
            centre = low + best
    return pulse, centre


def _late(velocity: np.ndarray, pulse: np.ndarray) -> bool:
    """Whether the record has spent 17 % of its squared velocity when the pulse has spent 5 %."""
    spent, started = (np.cumsum(values**2) / np.sum(values**2) for values in (velocity, pulse))
    before = np.flatnonzero(started <= PULSE_START)
    return bool(before.size and spent[before[-1]] >= LATE_ENERGY)


_SCALING_FILTER = np.array([
    0.2303778133088965, 0.7148465705529157, 0.6308807679298589, -0.02798376941685985,
    -0.1870348117190931, 0.03084138183556076, 0.03288301166688520, -0.01059740178506903,
])  # fmt: skip
"""Of the wavelet of Daubechies with four vanishing moments (Ten Lectures on Wavelets, 1992, table 6.1)."""
_LEVELS = 10
"""Halvings of the step at which the wavelet is tabulated."""


@cache
def _table() -> tuple[np.ndarray, np.ndarray]:
    """Places (n,) and values (n,) of db4 over its support, by the cascade algorithm from its scaling filter."""
    values = _SCALING_FILTER[::-1] * (-1.0) ** np.arange(_SCALING_FILTER.size)
    for _ in range(_LEVELS - 1):
        between = np.zeros(2 * values.size - 1)
        between[::2] = values
        values = np.convolve(between, _SCALING_FILTER)
    wavelet = np.zeros(int(SUPPORT) * 2**_LEVELS + 1)
    wavelet[1 : values.size + 1] = 2 ** (_LEVELS / 2) * values
    return np.arange(wavelet.size) / 2**_LEVELS, wavelet


def _wavelet(scale: float) -> np.ndarray:
    """db4 stretched to `scale` samples per unit and of unit energy, centred on the middle sample (odd count)."""
    half = math.floor(SUPPORT / 2 * scale)
    places, wavelet = _table()
    result: np.ndarray = np.interp(
        np.arange(-half, half + 1) / scale + SUPPORT / 2, places, wavelet
    ) / math.sqrt(scale)
    return result


def coefficients(velocities: np.ndarray, scale: int, low: int, high: int) -> np.ndarray:
    """Coefficients of one scale centred at the samples [low, high); only what they see is transformed."""
    half = math.floor(SUPPORT / 2 * scale)
    begin = max(0, low - half)
    return transform(velocities[begin : high + half], scale)[low - begin : high - begin]


def transform(velocities: np.ndarray, scale: float) -> np.ndarray:
    """Coefficient of the wavelet of one scale centred at each sample of (n,) velocities, real or complex."""
    half = math.floor(SUPPORT / 2 * scale)
    size = fast_length(velocities.size + 2 * half)
    spectrum = _kept_spectrum(scale, size) if size <= LARGEST_KEPT else _spectrum(scale, size)
    full: np.ndarray
    if np.iscomplexobj(velocities):
        full = np.fft.ifft(np.fft.fft(velocities, size) * spectrum)
    else:
        full = np.fft.irfft(np.fft.rfft(velocities, size) * spectrum[: size // 2 + 1], size)
    return np.concatenate([full[size - half :], full[: velocities.size]])[: velocities.size]


def _spectrum(scale: float, size: int) -> np.ndarray:
    """Fourier transform of the wavelet read backwards: the conjugate of its own, as it is real."""
    result: np.ndarray = np.conj(np.fft.fft(_wavelet(scale), size))
    return result


_kept_spectrum = lru_cache(maxsize=128)(_spectrum)
"""The records of a study often have one length, and some seventy scales are used in each."""


def coefficient_at(velocity: np.ndarray, scale: int, column: int) -> float:
    """Coefficient of one wavelet at one sample."""
    begin, end, wavelet = overlap(velocity.size, scale, column)
    return float((velocity[begin:end] * wavelet).sum())


def overlap(count: int, scale: int, column: int) -> tuple[int, int, np.ndarray]:
    """First and last sample of the wavelet centred at `column` inside `count` samples, and that part of it."""
    wavelet = _wavelet(scale)
    begin = column - wavelet.size // 2
    low = max(begin, 0)
    high = min(begin + wavelet.size, count)
    return low, high, wavelet[low - begin : high - begin]
