"""The dominant pulse of ten real records: values computed once with the same method, by other code."""

import numpy as np
import pytest
from scipy import signal
from scipy.constants import g

from rocking.pulses import PulseSettings, extract_pulses, velocity_pulse
from rocking.records import Accelerogram, read
from rocking.signal.rotation import rotate

# record, |a_g| [g], T_g [s], t₀ [s], EVa, G₂/G₁; mean of the first 0.5 s removed, acausal 0.05 Hz high-pass, 0.12–5 Hz
REGRESSION = [
    ("northridge1994_rinaldi/RSN1063_NORTHR_RRS228.AT2", 0.670, 0.81, 2.05, 0.37, 0.95),
    ("impvall1979_e06/RSN181_IMPVALL.H_H-E06230.AT2", 0.142, 3.34, 5.54, 0.28, 0.97),
    ("impvall1979_e07/RSN182_IMPVALL.H_H-E07230.AT2", 0.308, 0.75, 5.56, 0.32, 0.90),
    ("kobe1995_takatori/TAK000.AT2", 0.508, 1.24, 4.93, 0.28, 0.78),
    ("kobe1995_kjma/RSN1106_KOBE_KJM000.AT2", 0.617, 0.67, 8.00, 0.23, 0.65),
    ("erzincan1992/RSN821_ERZINCAN_ERZ-NS.AT2", 0.307, 1.21, 2.19, 0.57, 0.60),
    ("northridge1994_newhall/RSN1044_NORTHR_NWH360.AT2", 0.591, 0.75, 4.96, 0.36, 0.46),
    ("superstition1987_pts/RSN723_SUPER.B_B-PTS225.AT2", 0.317, 1.58, 11.31, 0.33, 0.53),
    ("landers1992_lucerne/RSN879_LANDERS_LCN260.AT2", 0.208, 1.03, 9.77, 0.05, 0.75),
    ("impvall1940_elcentro/RSN6_IMPVALL.I_I-ELC180.AT2", 0.176, 0.59, 1.68, 0.09, 0.94),
]
# Lucerne's second gain depends on whether a pulse of twice the period that contains the dominant one counts as
# a rival: it shares 48.6 % of their joint time, so here it does, and its ratio is 0.99 instead of 0.75.
NESTED_RIVAL = "landers1992_lucerne/RSN879_LANDERS_LCN260.AT2"


@pytest.fixture(scope="module")
def analysis(real_records):
    def extract(file):
        (record,) = read(real_records / file)
        step = record.time_step
        samples = record.acceleration - record.acceleration[: int(0.5 / step)].mean()
        high_pass = signal.butter(2, 0.05, "highpass", fs=1 / step, output="sos")
        filtered = Accelerogram(signal.sosfiltfilt(high_pass, samples), step)
        return extract_pulses(filtered, settings=PulseSettings(lowest_frequency=0.12))

    return extract


@pytest.mark.real_records
@pytest.mark.parametrize(("file", "amplitude", "period", "start", "explained", "ratio"), REGRESSION)
def test_dominant_pulse_of_a_real_record(analysis, file, amplitude, period, start, explained, ratio):
    found = analysis(file)
    # tolerances of the table: 5 % of amplitude and period, 0.1 s, 0.03
    rivals = found.ranked[:2] if ratio >= 0.9 else found.ranked[:1]
    assert any(
        abs(abs(e.pulse.amplitude) / g / amplitude - 1) <= 0.05
        and abs(e.pulse.period / period - 1) <= 0.05
        and abs(e.pulse.start_time - start) <= 0.1
        and abs(e.explained_energy - explained) <= 0.03
        for e in rivals
    ), [(e.pulse, e.explained_energy) for e in rivals]
    # the table prints two digits, and its own code refines elsewhere: one unit of its last digit
    assert found.gain_ratio == pytest.approx(0.99 if file == NESTED_RIVAL else ratio, abs=0.01)


# T_p [s] of Shahi & Baker (2014) as printed in the NGA-West2 flat file (here: the manifest), two components each.
# Newhall is the one exception: its largest pulse (1.04 s) arrives late by the published criterion and the next one
# (1.34 s, 2 % from the published 1.37 s) has an indicator of −0.24, just short of pulse-like.
VELOCITY_PULSE_EXCEPTIONS = {"1044"}


def components(manifest):
    """The first file of each horizontal component, by record sequence number."""
    found = {}
    for row in manifest:
        if row["role"] in ("pulse", "non-pulse") and row["file"].lower().endswith((".at2", ".csv")):
            if "UP" in row["component"] or row["pga_g"] == "":
                continue
            found.setdefault(row["rsn"], {}).setdefault(row["component"], row)
    return {rsn: list(rows.values()) for rsn, rows in found.items() if len(rows) == 2}


@pytest.fixture(scope="module")
def velocity_pulses(real_records, manifest):
    """(row of the manifest, components, velocity pulse) of each pair."""
    found = []
    for rows in components(manifest).values():
        units = [{"unit": "g"} if row["file"].endswith("csv") else {} for row in rows]
        pair = [read(real_records / row["file"], **unit)[0] for row, unit in zip(rows, units, strict=True)]
        found.append((rows[0], pair, velocity_pulse(*pair)))
    return found


@pytest.mark.real_records
def test_period_of_the_velocity_pulse(velocity_pulses):
    errors = {
        row["rsn"]: abs(found.period / float(row["tp_sb2014_s"]) - 1)
        for row, _, found in velocity_pulses
        if row["tp_sb2014_s"]
    }
    pulse_like = [found.pulse_like for row, _, found in velocity_pulses if row["role"] == "non-pulse"]
    assert len(errors) >= 17
    assert {rsn for rsn, error in errors.items() if error > 0.10} == VELOCITY_PULSE_EXCEPTIONS
    assert sum(error <= 0.05 for error in errors.values()) >= 0.9 * len(errors)
    assert len(pulse_like) >= 4
    assert not any(pulse_like)


@pytest.mark.real_records
def test_orientation_and_size_of_the_velocity_pulse(velocity_pulses):
    # the published azimuth is that of an axis, so half a turn does not matter, and is printed in whole degrees; the
    # components of Lucerne are 85° apart, which the published rotation corrects for and the pair as recorded does not
    turned, sizes = {}, {}
    for row, (first, second), found in velocity_pulses:
        if not row["pulse_orient_sb2014_deg"] or row["rsn"] in VELOCITY_PULSE_EXCEPTIONS:
            continue
        azimuth = rotate(first, second, angle=found.orientation).azimuth
        if azimuth is not None:
            turned[row["rsn"]] = (azimuth - float(row["pulse_orient_sb2014_deg"]) + 90) % 180 - 90
            sizes[row["rsn"]] = 100 * found.peak_velocity / float(row["pgv_sb2014_cm_s"]) - 1
    assert len(turned) >= 12
    assert max(map(abs, turned.values())) <= 3
    assert sum(abs(size) <= 0.01 for size in sizes.values()) >= 0.9 * len(sizes)


@pytest.mark.real_records
def test_sine_and_velocity_pulse_of_real_records_are_often_unlike(velocity_pulses):
    # median T_g/T_p of 0.37 over many records: below half, so that most pairs of periods are flagged as unlike
    ratios = []
    for _, pair, found in velocity_pulses:
        ratios += [extract_pulses(component).dominant.period / found.period for component in pair]
    assert 0.25 < np.median(ratios) < 0.5
