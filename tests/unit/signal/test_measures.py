"""Measures and response spectra against closed forms, a general solver, and what sources and agencies print."""

import itertools
import math

import numpy as np
import pytest
from scipy import integrate
from scipy.constants import g

from rocking.records import Accelerogram, read
from rocking.signal.measures import record_measures, response_spectrum

STEP = 0.005


def test_whole_cycles_of_a_sine():
    # a² has the mean a_g²/2; over whole cycles the trapezoidal rule is exact, and the share spent is t/T at their ends
    amplitude, period, cycles = 2.5, 0.8, 10
    times = np.arange(round(cycles * period / STEP) + 1) * STEP
    found = record_measures(Accelerogram(amplitude * np.sin(2 * np.pi * times / period), STEP))
    assert found.arias_intensity == pytest.approx(math.pi / (2 * g) * amplitude**2 / 2 * cycles * period)
    # velocity a_g/ω (1 − cos ωt) and displacement a_g/ω t less a bounded part, up to the (ω dt)²/12 of the rule
    omega = 2 * np.pi / period
    assert found.peak_velocity == pytest.approx(2 * amplitude / omega, rel=(omega * STEP) ** 2 / 6)
    assert found.peak_displacement == pytest.approx(amplitude / omega * cycles * period, rel=1e-3)


def test_steady_shaking_lasts_nine_tenths_of_it():
    found = record_measures(Accelerogram(np.full(2001, 1.5), STEP))
    assert found.significant_times == pytest.approx((0.5, 9.5))
    assert found.significant_duration == pytest.approx(9.0)


@pytest.mark.real_records
def test_peak_velocities_of_real_records(real_records, manifest):
    # printed by the source for NGA-West2 files, whose velocity starts from rest at the first sample
    rows = [row for row in manifest if row["format"] == "PEER AT2 NGA-West2" and row["pgv_cm_s"]]
    assert len(rows) >= 20
    for row in rows:
        found = record_measures(read(real_records / row["file"])[0])
        assert found.peak_acceleration == pytest.approx(float(row["pga_g"]) * g, rel=1e-4)
        assert 100 * found.peak_velocity == pytest.approx(float(row["pgv_cm_s"]), rel=1e-3), row["file"]


@pytest.mark.parametrize("damping", [0.0, 0.02, 0.05, 0.2])
def test_a_suddenly_applied_acceleration(damping):
    # D ω²/a = 1 + exp(−ζπ/√(1 − ζ²)) (Chopra, Dynamics of Structures, Eq. 4.3.2 at its first peak); a peak between
    # two of 20 or more steps is missed by up to (π/20)²/2, and the first ramp takes a step
    spectrum = response_spectrum(Accelerogram(np.full(8001, 2.0), STEP), np.array([0.1, 0.7, 3.0]), damping)
    overshoot = np.exp(-damping * np.pi / np.sqrt(1 - damping**2))
    assert spectrum.pseudo_acceleration == pytest.approx(2.0 * (1 + overshoot), rel=1.3e-2)


@pytest.mark.parametrize("period", [0.06, 0.4, 2.5])
def test_noise_against_a_general_solver(period):
    rng, step = np.random.default_rng(1), 0.02
    samples = np.concatenate(([0.0], rng.standard_normal(200), [0.0]))
    times, omega = np.arange(samples.size) * step, 2 * np.pi / period

    def change(time, state):
        return [state[1], -np.interp(time, times, samples) - 0.1 * omega * state[1] - omega**2 * state[0]]

    # a solver that may not step over a corner, looked at densely
    precise = {"rtol": 1e-8, "atol": 1e-12, "method": "DOP853"}
    reached, largest = [0.0, 0.0], 0.0
    for begin, end in itertools.pairwise(times):
        part = integrate.solve_ivp(change, (begin, end), reached, dense_output=True, **precise)
        largest = max(largest, np.abs(part.sol(np.linspace(begin, end, 20))[0]).max())
        reached = part.y[:, -1]
    found = response_spectrum(Accelerogram(samples, step), np.array([period]))
    # the peak between two of 20 steps, (π/20)²/2
    assert found.displacement[0] == pytest.approx(largest, rel=1.3e-2)


def test_the_same_motion_in_finer_steps_has_the_same_spectrum():
    # a stiff oscillator is followed in 7 steps for each of the record's, which the finer record holds already; it ends
    # on its strongest sample, so that what follows matters
    coarse = np.random.default_rng(4).standard_normal(50) * np.linspace(0.1, 1.0, 50)
    coarse[-1] = 4.0
    fine = np.interp(np.arange(49 * 7 + 1) / 7, np.arange(50), coarse)
    stiff = np.array([0.06])
    one = response_spectrum(Accelerogram(coarse, 0.02), stiff)
    other = response_spectrum(Accelerogram(fine, 0.02 / 7), stiff)
    assert one.displacement == pytest.approx(other.displacement, rel=1e-9)


def printed_spectra(path):
    """(periods s, displacements m) of the channels of a CSMIP volume 3: 100 values each, of which 78 are used."""
    lines = path.read_text(encoding="ascii").splitlines()
    for place, line in enumerate(lines):
        if line.startswith("Damping ="):
            after = [float(word) for text in lines[place + 1 : place + 14] for word in text.split()]
            start = next(i for i in range(place, 0, -1) if lines[i].startswith("Fourier amplitude"))
            before = [float(word) for text in lines[start - 13 : start] for word in text.split()]
            yield np.array(before[:78]), 0.0254 * np.array(after[:78])


@pytest.mark.real_records
def test_the_spectra_that_an_agency_printed(real_records):
    # Willow Creek 2012, three channels: volume 3 of CGS beside the accelerations of volume 2
    records = read(real_records / "formats_csmip" / "CE89146.V2")
    spectra = list(printed_spectra(real_records / "formats_csmip" / "CE89146.V3"))
    assert len(records) == len(spectra) == 3
    for record, (periods, displacement) in zip(records, spectra, strict=True):
        found = response_spectrum(record, periods)
        assert found.displacement == pytest.approx(displacement, rel=0.02)
