"""Synthetic near-fault accelerograms: one pulse plus filtered noise, seeded, and plainly called synthetic.

`python -m tests.synthetic FOLDER` writes the shipped file, byte for byte the same each time.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from rocking.earthquakes.sample import MADE
from rocking.quantities import GRAVITY
from rocking.signal.accelerogram import Accelerogram

_EPSILON = 0.2
_ETA = 0.05


@dataclass(frozen=True, kw_only=True)
class SyntheticRecord:
    """The parameters of a synthetic record.

    pulse_amplitude: of one sine cycle, m/s², signed; pulse_period, pulse_start, duration, time_step: s; noise_peak:
    largest magnitude of the noise, m/s²; corner_frequency [Hz] and kappa [s] shape its spectrum.
    """

    name: str
    seed: int
    pulse_amplitude: float = 4.0
    pulse_period: float = 0.6
    pulse_start: float = 1.0
    noise_peak: float = 1.0
    duration: float = 6.0
    time_step: float = 0.01
    corner_frequency: float = 0.3
    kappa: float = 0.04


def synthetic_record(recipe: SyntheticRecord) -> Accelerogram:
    """Return the accelerogram of `recipe`: pulse plus noise, m/s²."""
    times = np.arange(round(recipe.duration / recipe.time_step)) * recipe.time_step
    values = pulse(recipe, times) + noise(recipe, times.size)
    names: dict[str, Any] = {"component": "H1", "station": recipe.name, "event": MADE}
    return Accelerogram(values, recipe.time_step, **names, processed=True)


def pulse(recipe: SyntheticRecord, times: np.ndarray) -> np.ndarray:
    """Return the pulse's acceleration at `times` (n,) s, m/s²."""
    phase = 2 * np.pi * (times - recipe.pulse_start) / recipe.pulse_period
    return recipe.pulse_amplitude * np.where((phase >= 0) & (phase <= 2 * np.pi), np.sin(phase), 0)


def noise(recipe: SyntheticRecord, samples: int) -> np.ndarray:
    """Return stochastic ground acceleration (samples,), m/s², by the method of Boore (2003).

    White noise, windowed (Saragoni & Hart 1974, ε = 0.2, η = 0.05), its spectrum levelled to unit mean power and
    multiplied by the omega-squared source f²/(1 + (f/f_c)²) and the site's exp(−πκf), then scaled to its peak.
    """
    if recipe.noise_peak == 0:
        return np.zeros(samples)
    # The legacy generator is the one whose stream numpy promises never to change: the bundled files depend on it.
    white = np.random.RandomState(recipe.seed).standard_normal(samples)

    # (t/t_ε)^b exp(b (1 − t/t_ε)) is 1 at the share ε of the duration and η at its end.
    ratio = np.arange(1, samples + 1) / samples / _EPSILON
    b = -_EPSILON * np.log(_ETA) / (1 + _EPSILON * (np.log(_EPSILON) - 1))
    window = ratio**b * np.exp(b * (1 - ratio))

    spectrum = np.fft.rfft(white * window)
    spectrum /= np.sqrt(np.mean(np.abs(spectrum) ** 2))
    frequency = np.fft.rfftfreq(samples, recipe.time_step)
    source = frequency**2 / (1 + (frequency / recipe.corner_frequency) ** 2)
    site = np.exp(-np.pi * recipe.kappa * frequency)
    series: np.ndarray = np.fft.irfft(spectrum * source * site, samples)
    return series * float(recipe.noise_peak / np.abs(series).max())


SHIPPED = SyntheticRecord(
    name="synthetic_strong_pulse",
    seed=1,
    pulse_amplitude=0.55 * GRAVITY,
    pulse_period=1.0,
    pulse_start=4.0,
    noise_peak=0.15 * GRAVITY,
    duration=20.0,
    time_step=0.005,
)
"""The recipe of the synthetic accelerogram of the shipped example."""


def at2_text(recipe: SyntheticRecord) -> str:
    """Return the record of `recipe` as the text of an AT2 file, in g, five numbers a line.

    The shipped one says that it is made. Tests take the others for recorded ones, with the earthquakes that they name.
    """
    record = synthetic_record(recipe)
    values = [f"{value:15.7e}" for value in record.acceleration / GRAVITY]
    origin = "SYNTHETIC ACCELEROGRAM, NOT RECORDED" if recipe is SHIPPED else "RECORD OF A TEST"
    head = (
        f"{origin}; MADE BY python -m tests.synthetic, SEED {recipe.seed}",
        f"{record.event.split(',')[0]}, 1/1/2000, {recipe.name}, {record.component}",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {len(values):6d}, DT= {record.time_step:8.5f} SEC",
    )
    return "\n".join((*head, *("".join(values[i : i + 5]) for i in range(0, len(values), 5)), ""))


if __name__ == "__main__":
    (target,) = sys.argv[1:]
    (Path(target) / f"{SHIPPED.name}.AT2").write_bytes(at2_text(SHIPPED).encode("ascii"))
