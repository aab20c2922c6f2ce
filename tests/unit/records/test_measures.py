"""Measures of a record against closed forms and against what the sources of real records print."""

import math

import numpy as np
import pytest
from scipy.constants import g

from rocking.records import Accelerogram, read
from rocking.records.measures import record_measures

STEP = 0.005


def test_whole_cycles_of_a_sine():
    # a² has the mean a_g²/2; over whole cycles the trapezoidal rule is exact, and the share spent is t/T at their ends
    amplitude, period, cycles = 2.5, 0.8, 10
    times = np.arange(round(cycles * period / STEP) + 1) * STEP
    found = record_measures(Accelerogram(amplitude * np.sin(2 * np.pi * times / period), STEP))
    assert found.arias_intensity == pytest.approx(math.pi / (2 * g) * amplitude**2 / 2 * cycles * period)
    assert found.husid[:: round(period / STEP)] == pytest.approx(np.arange(cycles + 1) / cycles, abs=1e-12)
    assert (found.husid[0], found.husid[-1]) == (0, 1)
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
