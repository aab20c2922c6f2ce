"""What the extraction of pulses costs: compiled beside plain numpy in one run.

Run as a script. A 40 s, 200 Hz component, five refined alternatives; the plain version does the same scan, maxima
and refinement with numpy and scipy, one frequency after the other.
"""

import numpy as np
from clock import least_cpu
from scipy import ndimage, optimize

from rocking.pulses import PulseSettings, extract_pulses
from rocking.records.accelerogram import Accelerogram

RATE = 200.0
ALTERNATIVES = 5


def component(duration, seed=0):
    """Noise with a strong phase of a quarter of the record and one pulse, m/s²."""
    rng = np.random.default_rng(seed)
    times = np.arange(round(duration * RATE)) / RATE
    envelope = np.exp(-(((times - 0.35 * duration) / (0.15 * duration)) ** 2))
    phase = (times - 0.3 * duration) / 1.1
    pulse = 3.0 * np.sin(2 * np.pi * phase) * ((phase > 0) & (phase < 1))
    return Accelerogram(pulse + rng.standard_normal(times.size) * envelope, 1 / RATE)


def plain_extraction(record, settings):
    """The five best pulses (gain, frequency, onset) by cumulative sums in numpy and a simplex refinement."""
    samples, step = record.acceleration, record.time_step
    times = record.times
    octaves = np.log2(settings.highest_frequency / settings.lowest_frequency)
    frequencies = settings.lowest_frequency * 2 ** (
        np.arange(octaves * settings.per_octave + 1) / settings.per_octave
    )
    gains = np.zeros((frequencies.size, samples.size))
    for row, frequency in zip(gains, frequencies, strict=True):
        count = int(1 / frequency / step) + 1
        turning = np.exp(2j * np.pi * frequency * times)
        sums = np.concatenate([[0], np.cumsum(samples * turning)])
        inner = ((sums[count:] - sums[:-count]) / turning[: samples.size - count + 1]).imag
        row[: inner.size] = inner**2 * 2 * frequency * step**2
    highest = (gains == ndimage.maximum_filter(gains, size=3)) & (gains > 0.01 * gains.max())
    places = np.argwhere(highest)
    places = places[np.argsort(-gains[tuple(places.T)])][: settings.candidates]
    found = [plain_refinement(samples, step, frequencies[i], j * step) for i, j in places]
    return sorted(found, reverse=True)[:ALTERNATIVES]


def plain_refinement(samples, step, frequency, start):
    """(gain, frequency, onset) at the end of a simplex search."""
    first = max(0, int((start - 1 / frequency) / step))
    part = samples[first : first + int(3.5 / frequency / step)]
    times = np.arange(first, first + part.size) * step

    def loss(x):
        phase = (times - start - x[1] / frequency) * frequency * np.exp(x[0])
        sine = np.sin(2 * np.pi * phase) * ((phase >= 0) & (phase <= 1))
        return -((part @ sine) ** 2) / max(sine @ sine, 1e-12) * step

    found = optimize.minimize(loss, [0, 0], method="Nelder-Mead", options={"xatol": 1e-6, "fatol": 1e-9})
    return -found.fun, frequency * np.exp(found.x[0]), start + found.x[1] / frequency


def main():
    """Print the table."""
    settings = PulseSettings(alternatives=ALTERNATIVES)
    record = component(40)
    compiled, plain = least_cpu(
        lambda: extract_pulses(record, settings=settings),
        lambda: plain_extraction(record, settings),
        repeats=5,
    )
    found, other = extract_pulses(record, settings=settings), plain_extraction(record, settings)
    print("\n40 s at 200 Hz, five refined alternatives; compiled also holds flags and a pursuit of three")
    print(f"{'method':10} {'ms':>8} {'ratio':>7} {'gain m²/s³':>12} {'T_g s':>9} {'t_0 s':>9}")
    for name, spent, gain, period, start in (
        ("numpy", plain, other[0][0], 1 / other[0][1], other[0][2]),
        ("compiled", compiled, found.evidence.gain, found.dominant.period, found.dominant.start_time),
    ):
        print(f"{name:10} {1e3 * spent:8.2f} {plain / spent:7.1f} {gain:12.6f} {period:9.5f} {start:9.5f}")


if __name__ == "__main__":
    main()
