"""The synthetic records: seeded, byte for byte, with the pulse that was asked for."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from rocking.records import read
from rocking.records.synthetic import BUNDLED, SyntheticRecord, noise, pulse, synthetic_record, write_bundled

SHIPPED = Path(__file__).parents[3] / "records"


def test_the_committed_files_are_what_the_generator_makes(tmp_path: Path) -> None:
    made = write_bundled(tmp_path)
    assert {p.name for p in made} == {p.name for p in SHIPPED.glob("synthetic_*")}
    for path in made:
        assert path.read_bytes() == (SHIPPED / path.name).read_bytes(), path.name


@pytest.mark.parametrize("recipe", BUNDLED, ids=lambda r: r.name)
def test_the_files_read_back_and_call_themselves_synthetic(recipe: SyntheticRecord) -> None:
    (record,) = read(SHIPPED / f"{recipe.name}.AT2")
    made = synthetic_record(recipe)
    # eight digits are printed
    assert np.abs(record.acceleration - made.acceleration).max() < 1e-7 * GRAVITY
    assert record.time_step == recipe.time_step and "synthetic" in record.station.lower()
    assert b"NOT RECORDED" in (SHIPPED / f"{recipe.name}.AT2").read_bytes()[:80]


def test_pulse_shapes() -> None:
    times = np.arange(0, 10, 1e-3)
    sine = replace(BUNDLED[0], pulse_period=1.6, pulse_start=2.0, pulse_amplitude=-3.0)
    wave = pulse(sine, times)
    assert wave[times < 2].max() == 0 and wave[times > 3.601].max() == 0
    assert wave[np.argmin(abs(times - 2.4))] == pytest.approx(-3.0, rel=1e-6)
    long = pulse(replace(sine, pulse_shape="mavroeidis"), times)
    assert np.abs(long).max() == pytest.approx(3.0, rel=1e-4)
    # the derivative of ½(1 + cos(2πft/γ))cos(2πft), which starts and ends at rest, by differences of that function
    t, f = times - 2.0 - 1.6, 1 / 1.6
    velocity = np.where(np.abs(t) <= 1.6, 0.5 * (1 + np.cos(np.pi * f * t)) * np.cos(2 * np.pi * f * t), 0)
    slope = np.gradient(velocity, 1e-3)
    inside = np.abs(t) < 1.59
    assert np.corrcoef(long[inside], -slope[inside])[0, 1] > 0.999999
    assert abs(long.sum()) * 1e-3 < 1e-3


def test_noise_is_seeded_and_shaped() -> None:
    recipe = SyntheticRecord("n", 7, 0.0, 1.0, 0.0, 2.0, 40.0, 0.005, corner_frequency=0.5, kappa=0.04)
    series = noise(recipe, 8000)
    assert np.array_equal(series, noise(recipe, 8000)) and not np.array_equal(
        series, noise(replace(recipe, seed=8), 8000)
    )
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


@pytest.mark.parametrize(("changes", "field"), [
    ({"pulse_period": 0.0}, "pulse_period"),
    ({"duration": -1.0}, "duration"),
    ({"duration": 0.01}, "duration"),
    ({"time_step": float("nan")}, "time_step"),
    ({"noise_peak": float("inf")}, "noise_peak"),
    ({"pulse_shape": "square"}, "pulse_shape"),
])  # fmt: skip
def test_bad_recipes(changes: dict, field: str) -> None:
    with pytest.raises(RecordError, match=field):
        replace(BUNDLED[0], **changes)
