"""Synthetic records: seeded, byte for byte, with the pulse that was asked for."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.quantities import GRAVITY
from rocking.records import read
from tests.synthetic import SHIPPED, SyntheticRecord, at2_text, noise, pulse, synthetic_record

FILE = Path(__file__).parents[2] / "records" / f"{SHIPPED.name}.AT2"


def test_the_shipped_file_is_what_the_generator_makes_and_calls_itself_synthetic() -> None:
    content = FILE.read_bytes()
    assert content == at2_text(SHIPPED).encode() and b"NOT RECORDED" in content[:80]
    (record,) = read(FILE)
    # eight digits are printed
    assert np.abs(record.acceleration - synthetic_record(SHIPPED).acceleration).max() < 1e-7 * GRAVITY
    assert record.time_step == SHIPPED.time_step and "synthetic" in record.station.lower()


def test_the_pulse_is_one_cycle_of_a_sine() -> None:
    times = np.arange(0, 10, 1e-3)
    wave = pulse(replace(SHIPPED, pulse_period=1.6, pulse_start=2.0, pulse_amplitude=-3.0), times)
    assert wave[times < 2].max() == 0 and wave[times > 3.601].max() == 0
    assert wave[np.argmin(abs(times - 2.4))] == pytest.approx(-3.0, rel=1e-6)
    assert abs(wave.sum()) < 1e-9


def test_noise_is_seeded_and_shaped() -> None:
    recipe = SyntheticRecord(
        name="n",
        seed=7,
        pulse_amplitude=0.0,
        pulse_period=1.0,
        pulse_start=0.0,
        noise_peak=2.0,
        duration=40.0,
        time_step=0.005,
        corner_frequency=0.5,
        kappa=0.04,
    )
    series = noise(recipe, 8000)
    assert np.array_equal(series, noise(recipe, 8000))
    assert not np.array_equal(series, noise(replace(recipe, seed=8), 8000))
    assert np.abs(series).max() == pytest.approx(2.0)
    # Energy is in the window: rises to its largest at 0.2 of the duration and falls to a twentieth at the end.
    energy = np.cumsum(series**2) / np.sum(series**2)
    assert energy[4000] > 0.75 and energy[800] < 0.35
    # Mean spectrum of many seeds against the formula, octave by octave: flat above the corner times exp(-πκf).
    spectra = [np.abs(np.fft.rfft(noise(replace(recipe, seed=s), 8000))) for s in range(40)]
    mean, f = np.sqrt(np.mean([s**2 / np.mean(s**2) for s in spectra], axis=0)), np.fft.rfftfreq(8000, 0.005)
    formula = f**2 / (1 + (f / 0.5) ** 2) * np.exp(-np.pi * 0.04 * f)
    bands = [(f >= a) & (f < 2 * a) for a in (0.125, 0.25, 0.5, 1, 2, 4, 8, 16)]
    ratio = np.array([np.sqrt(np.mean(mean[b] ** 2) / np.mean(formula[b] ** 2)) for b in bands])
    # 40 seeds of 10 or more independent values in the narrowest octave: 1/sqrt(2·40·5) = 5 %, three of these
    assert np.abs(ratio / np.median(ratio) - 1).max() < 0.15
