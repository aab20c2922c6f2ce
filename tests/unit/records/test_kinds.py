"""What a file or a channel is, asked before its numbers are used: kinds that are read, and kinds that are refused."""

from pathlib import Path

import numpy as np
import pytest
from obspy import Trace
from obspy.io.sac import SACTrace

import rocking
from rocking.errors import RecordError
from rocking.records import read
from rocking.records.formats.format import coordinates
from rocking.records.formats.layouts import AskedError
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.contracts.made_files import TRUE, columns, cwb, smc
from tests.refusals import refused
from tests.unit.records.test_layouts import answered

TIMES = np.arange(600) * 0.01
WAVE = np.round(np.sin(5 * TIMES) * np.exp(-((TIMES - 3) ** 2)), 6)


def write(folder: Path, content: str | bytes, name: str = "made.txt") -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode("latin-1"))
    return path


def table(*series: np.ndarray, head: str = "", parted: str = ",") -> str:
    rows = (parted.join(f"{value:.6f}" for value in row) for row in np.transpose(series))
    return head + "\n".join(rows) + "\n"


def test_every_channel_of_a_table_has_the_times_left_of_it(tmp_path):
    head = "Time 1 (s),NS (g),Time 2 (s),EW (g)\n"
    first, second = read(write(tmp_path, table(TIMES, 0.1 * WAVE, 2 * TIMES, 0.3 * WAVE, head=head)))
    assert (first.component, first.time_step) == ("NS", 0.01)
    assert (second.component, second.time_step) == ("EW", 0.02)
    assert np.allclose(second.acceleration, 3 * first.acceleration, atol=2e-5)


def test_without_names_a_column_that_rises_evenly_is_no_channel(tmp_path):
    path = write(tmp_path, table(TIMES, WAVE, TIMES, 3 * WAVE))
    with pytest.raises(AskedError) as asked:
        read(path, unit="m/s2")
    assert asked.value.question.proposal == "t, ?, t, ?"
    answered(tmp_path, asked.value.question, "t, a, t, a m/s2")
    assert [record.peak_acceleration for record in read(path)] == [
        pytest.approx(np.abs(WAVE).max()),
        pytest.approx(3 * np.abs(WAVE).max()),
    ]


@pytest.mark.parametrize("head", ["No,Time (s),acc (g)\n", "point,t,acc (g)\n"])
def test_a_count_of_the_rows_is_no_channel(tmp_path, head):
    (record,) = read(write(tmp_path, table(np.arange(600.0), TIMES, WAVE, head=head)))
    assert record.time_step == 0.01
    assert record.peak_acceleration == pytest.approx(9.80665 * np.abs(WAVE).max())


def test_times_in_a_unit_that_is_none_are_refused(tmp_path):
    with refused(RecordError, "unit", "furlongs"):
        read(write(tmp_path, table(TIMES, WAVE, head="time (furlongs),acc (g)\n")))


def test_the_unit_of_times_may_be_the_last_word_of_their_name(tmp_path):
    (record,) = read(write(tmp_path, table(1000 * TIMES, WAVE, head="time_ms,acc (g)\n")))
    assert record.time_step == pytest.approx(0.01)


@pytest.mark.parametrize(
    "head", ["Time [sec] Corrected Acceleration [g]\n", "Time [sec]   Acceleration [g]\n"]
)
def test_names_of_several_words_are_one_name_each(tmp_path, head):
    (record,) = read(write(tmp_path, table(TIMES, WAVE, head=head, parted="  ")))
    assert record.peak_acceleration == pytest.approx(9.80665 * np.abs(WAVE).max())


@pytest.mark.parametrize("head", ["600 0.01\n", "N= 600, DT= .0100 SEC\n", "N DT\n600 0.01\n", "0.01 600\n"])
@pytest.mark.parametrize("per_line", [1, 5, 8])
def test_a_count_and_a_step_head_the_samples(tmp_path, head, per_line):
    path = write(tmp_path, head + columns(WAVE, per_line, "14.6E"))
    (record,) = read(path, unit="m/s2")
    assert record.acceleration.size == 600 and record.time_step == 0.01
    assert record.peak_acceleration == pytest.approx(np.abs(WAVE).max(), rel=1e-6)


def test_points_of_film_in_smc_are_joined_by_lines(tmp_path):
    times = np.cumsum(np.random.default_rng(1).uniform(0.01, 0.04, 300))
    values = 50 * np.sin(4 * times)
    head, _, _ = smc().partition("| one\n")
    head = head.replace("2 CORRECTED", "1 UNCORRECTED").replace(f"{TRUE.size:10d}", f"{300:10d}", 1)
    head = head.replace(f"{1 / 0.01:15.7E}", f"{1.7e38:15.7E}", 1)
    for extreme, place in ((100 * TRUE.max(), values.argmax()), (100 * TRUE.min(), values.argmin())):
        at, size = f"{times[place]:15.7E}", f"{values[place]:15.7E}"
        where = head.index(f"{extreme:15.7E}")
        head = head[: where - 15] + at + size + head[where + 15 :]
    (record,) = read(
        write(tmp_path, head + "| one\n" + columns(np.column_stack([times, values]).ravel(), 8, "10.4f"))
    )
    even = np.arange(record.acceleration.size) * record.time_step + round(times[0] / 0.005) * 0.005
    assert record.time_step == 0.005
    assert np.allclose(
        100 * record.acceleration, np.interp(even, times, values), atol=0.05
    )  # times to 1e-4 s
    (told,) = record.warnings  # the header puts the peak where it is among the points
    assert told.kind is RecordKind.UNEVEN_FILM


def test_the_disc_of_1999_is_read_as_its_later_files_are(tmp_path):
    later = read(write(tmp_path, cwb(), "later.dat"))
    disc = read(write(tmp_path, cwb().partition("\n")[2], "disc.dat"))
    assert [record.sha256 for record in disc] == [record.sha256 for record in later]
    assert [record.vertical for record in disc] == [True, False]


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (
            "Raw acceleration counts   (Format v01.20 with 13 text lines)\n" * 3,
            "COSMOS V0 file of raw counts",
        ),
        ("BEGIN GSE2.0\nMSG_TYPE DATA\n" * 3, "message of GSE or IMS; cut off the lines above"),
        ("* **********\n* NETWORK\nZEROS 3\nPOLES 5\n", "poles and zeros, which holds a response"),
        ("<!DOCTYPE html><html><body>Not found\n", "web page, and no record"),
        ("%PDF-1.5\nxx", "PDF or an archive"),
        (
            "CORRECTED ACCELEROGRAM  IIA001  40.001.0\nIMPERIAL VALLEY EARTHQUAKE\n",
            "Volume II file without the component",
        ),
        ("FILE  1 OF CORRECTED ACCELEROGRAM DATA OF VOLUME II\n", "Volume II file without the component"),
    ],
)
def test_other_kinds_of_file_are_named_with_what_to_do(tmp_path, content, words):
    with pytest.raises(RecordError, match=words):
        read(write(tmp_path, content))


@pytest.mark.parametrize(("kind", "word"), [("ivel", "velocity"), ("idisp", "displacement")])
def test_a_sac_file_that_says_it_is_no_acceleration_is_refused(tmp_path, kind, word):
    path = tmp_path / "made.sac"
    SACTrace(data=WAVE.astype("f4"), delta=0.01, idep=kind, kcmpnm="HNE").write(str(path))
    with refused(RecordError, "quantity"):
        read(path, unit="m/s2")


def test_a_unit_that_is_given_wins_where_obspy_differentiated_what_nobody_named():
    trace = Trace(WAVE / 10, {"channel": "HNE", "delta": 0.01}).differentiate()
    (record,) = rocking.from_obspy(trace, unit="m/s2")
    assert np.allclose(record.acceleration, trace.data)
    with refused(RecordError, "quantity", "velocity"):
        rocking.from_obspy(Trace(WAVE / 10, {"channel": "HNE", "delta": 0.01}).integrate(), unit="m/s2")


@pytest.mark.parametrize("text", ["31.86 LAT. N\n 116.60 LONG. W", "31.86 N / 116.60 O", "31.86 N; 116.60 W"])
def test_places_are_read_as_they_are_written(text):
    assert coordinates(text) == {"latitude": 31.86, "longitude": -116.6}


@pytest.mark.parametrize(
    ("code", "azimuth", "inclination", "along", "vertical", "is_told"),
    [
        ("HNE", 90, 90, 90.0, False, False),
        ("HNE", 270, 90, 270.0, False, False),
        ("HNN", 30, 90, 30.0, False, False),
        ("HNZ", 0, 0, None, True, False),
        ("HN1", 0, 0, None, True, False),
        ("HNE", 0, 0, 90.0, False, False),  # neither is set
        ("HNN", 0, 0, 0.0, False, False),
        ("HNE", 0, 90, 0.0, False, True),
        ("HNZ", 0, 90, 0.0, False, True),
        ("HNE", 90, 0, None, True, True),
        ("HNN", 360, 90, 0.0, False, False),
        ("HN1", 360.5, 90, None, False, False),  # a number that is no angle, as of what is not known
    ],
)
def test_a_sac_header_that_contradicts_its_channel_code_is_told(
    tmp_path, code, azimuth, inclination, along, vertical, is_told
):
    path = tmp_path / "made.sac"
    numbers = np.sin(np.arange(400) * 0.1).astype("f4")
    SACTrace(data=numbers, delta=0.01, kcmpnm=code, cmpaz=azimuth, cmpinc=inclination).write(str(path))
    (record,) = read(path, unit="m/s2")
    assert (record.azimuth, record.vertical) == (along, vertical)
    assert (RecordKind.DIRECTION_CONTRADICTED in {warning.kind for warning in record.warnings}) == is_told


def test_the_scale_of_a_sac_file_is_told(tmp_path):
    path = tmp_path / "made.sac"
    numbers = np.sin(np.arange(400) * 0.1).astype("f4")
    SACTrace(data=numbers, delta=0.01, kcmpnm="HNE", scale=2.0).write(str(path))
    (record,) = read(path, unit="m/s2")
    assert record.acceleration == pytest.approx(2 * (numbers - numbers.mean()), abs=1e-5)
    assert RockingWarning.of(RecordKind.SCALE_APPLIED, factor=2.0) in record.warnings
