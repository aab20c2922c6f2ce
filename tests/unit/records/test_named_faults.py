"""Files that were once misread, or refused though they are good: each made as it lies in some collection."""

import re
from pathlib import Path

import made_files
import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records import Accelerogram, read
from rocking.records.formats.layouts import AskedError
from rocking.records.kinds import RecordKind
from tests.folders import list_folder
from tests.refusals import refused
from tests.unit.records.test_layouts import answered

TIMES = 0.01 * np.arange(600)
MOTION = np.sin(7.3 * TIMES) * np.exp(-0.4 * TIMES) + 0.2 * np.sin(31 * TIMES + 1)


def opened(folder: Path, text: str, name: str = "made.txt", **declared: object) -> list[Accelerogram]:
    """The channels of a file with that text."""
    (folder / name).write_text(text)
    return read(folder / name, **declared)


def opened_once(folder: Path, text: str, answer: str) -> None:
    """Write a file whose layout is asked for, and the answer beside it."""
    with pytest.raises(AskedError) as asked:
        opened(folder, text)
    answered(folder, asked.value.question, answer)


def rows(*columns: np.ndarray, parted: str = ",") -> str:
    return "".join(parted.join(f"{value:.6f}" for value in row) + "\n" for row in np.transpose(columns))


def test_raw_and_corrected_components_are_not_joined(tmp_path: Path) -> None:
    """One station, one earthquake, one step: north as it was recorded, east as it was corrected."""
    text = made_files.csmnc()
    (tmp_path / "a.dat").write_text(text)
    corrected = text.replace("COMP. EW", "COMP. NS").replace("UNCORRECTED ACC", "CORRECTED ACC")
    (tmp_path / "b.dat").write_text(corrected)
    assert [read(tmp_path / name)[0].processed for name in ("a.dat", "b.dat")] == [False, True]
    _, catalogue = list_folder(tmp_path)
    assert [row["file"] for row in catalogue] == ["a.dat", "b.dat"]
    (tmp_path / "b.dat").write_text(text.replace("COMP. EW", "COMP. NS"))
    _, catalogue = list_folder(tmp_path)
    assert [row["file"] for row in catalogue] == ["a.dat;b.dat"]


@pytest.mark.parametrize("title", [
    "CHI-CHI 09/20/99, CHY101, E, (CWB)", "CHI-CHI 09/20/99, CHY101, E (CWB)", "CHI-CHI 09/20/99, CHY101, E",
])  # fmt: skip
def test_the_network_in_a_header_of_peer_hides_neither_station_nor_direction(
    tmp_path: Path, title: str
) -> None:
    text = made_files.peer().replace("Quake, 1/2/1999, Station, 45", title)
    (record,) = opened(tmp_path, text)
    assert (record.station, record.component, record.azimuth) == ("CHY101", "E", 90.0)
    assert record.event == "CHI-CHI"


@pytest.mark.parametrize("parted", [",", "; ", "  "])
def test_a_wrapped_series_is_one_whatever_parts_its_numbers(tmp_path: Path, parted: str) -> None:
    """Smoothness decides: along the rows of a series the next number is nearer than the one a row further on."""
    (record,) = opened(tmp_path, rows(*MOTION.reshape(-1, 5).T, parted=parted), unit="m/s2", time_step=0.01)
    assert np.allclose(record.acceleration, MOTION, atol=1e-6)
    other, third = np.roll(MOTION, 100), 0.7 * np.roll(MOTION, 233)
    opened_once(tmp_path, rows(MOTION, other, third, parted=parted), "N, E, Z m/s2, dt 0.01")
    channels = read(tmp_path / "made.txt")
    assert [
        np.allclose(a.acceleration, b, atol=1e-6)
        for a, b in zip(channels, (MOTION, other, third), strict=True)
    ]


def test_one_and_the_step_above_a_column_are_no_samples(tmp_path: Path) -> None:
    """As some programs of analysis begin their files: one series, every 0.005 s."""
    column = "".join(f"{value:.6f}\n" for value in 0.1 * MOTION)
    (record,) = opened(tmp_path, f"1\n0.005\n{column}", unit="g")
    assert record.time_step == 0.005 and record.acceleration.size == MOTION.size
    assert [warning.kind for warning in record.warnings] == [RecordKind.FIRST_NUMBERS]
    # A column that begins with 1 and goes on near it is a motion.
    (record,) = opened(tmp_path, "1\n" + rows(MOTION + 0.8), unit="m/s2", time_step=0.01)
    assert record.acceleration.size == MOTION.size + 1


def test_strain_is_no_acceleration_and_a_numbered_letter_no_direction(tmp_path: Path) -> None:
    """Strata calls its columns S-1, S-2, after the soils."""
    with refused(RecordError, "quantity", "shear strain"):
        opened(tmp_path, "# Shear Strain time series\nTime (s),S-1\n" + rows(TIMES, MOTION), unit="g")
    (record,) = opened(tmp_path, "Time (s),S-1\n" + rows(TIMES, MOTION), unit="m/s2")
    assert record.azimuth is None


@pytest.mark.parametrize("first", [np.geomspace(0.01, 10, 600), np.linspace(0.1, 60, 600)])
def test_a_matrix_of_spectra_is_no_record(tmp_path: Path, first: np.ndarray) -> None:
    for columns in (
        [first, np.abs(MOTION), 0.5 * np.abs(MOTION)],
        [np.geomspace(0.01, 10, 600), np.abs(MOTION)],
    ):
        with refused(AskedError, "layout"):
            opened(tmp_path, rows(*columns), unit="g", time_step=0.01)


def test_an_even_pair_of_columns_without_negative_numbers_is_told(tmp_path: Path) -> None:
    """It may be a record whose offset was not removed."""
    (record,) = opened(tmp_path, rows(TIMES, np.abs(MOTION)), unit="m/s2")
    assert RecordKind.NEVER_NEGATIVE in {warning.kind for warning in record.warnings}


def test_a_peak_that_a_header_cuts_off_damages_nothing(tmp_path: Path) -> None:
    """The Mexican members' headers cut digits off, and some state the peak's time where others count samples."""
    text = made_files.unam()
    gal = 100 * np.abs(made_files.TRUE).max()
    cut = np.floor(10 * gal) / 10, np.floor(5 * gal) / 10
    stated = text.replace(f"/{gal:.4f}/{gal / 2:.4f}", f"/{cut[0]:.1f}/{cut[1]:.1f}")
    place = np.abs(made_files.TRUE).argmax()
    stated = stated.replace(
        f"/{place + 1}/{place + 1}", f"/{place * 0.01 + 0.001:.3f}/{place * 0.01 + 0.001:.3f}"
    )
    assert stated != text
    assert [record.warnings for record in opened(tmp_path, stated)] == [(), ()]


FILM = np.sort(np.concatenate([np.arange(0, 2, 0.0031), np.arange(1, 2, 0.0173)]))
"""s; where a trace on film bends."""


def film(tail: str, counted: int) -> str:
    """An uncorrected file of the USGS: pairs of times and cm/s², counted without the last line in most of them."""
    pairs = np.column_stack([FILM, 100 * np.interp(FILM, TIMES, MOTION)])
    text = (
        made_files.smc()
        .replace("2 CORRECTED", "1 UNCORRECTED")
        .replace(f"{made_files.N:10d}", f"{counted:10d}")
    )
    head = text[: text.index("| one\n") + 6]
    for extreme in (100 * made_files.TRUE.max(), 100 * made_files.TRUE.min()):
        head = head.replace(f"{extreme:15.7E}", f"{1.7e38:15.7E}")
    return head + made_files.columns(pairs.ravel(), 8, "10.3E") + tail


@pytest.mark.parametrize(("tail", "is_cut"), [
    ("", False), (" 2.010E+00 9.999E+02 2.011E+00 9.999E+02 2.012E+00 9.999E+02 2.013E+00 9.999E+02\n", True),
    ("|second trace\n 0.000E+00 9.999E+02 1.000E-01 9.999E+02\n", True),
])  # fmt: skip
@pytest.mark.parametrize("counted", [FILM.size, 2 * FILM.size], ids=["points", "numbers"])
def test_points_of_film_end_at_a_seam(tmp_path: Path, tail: str, is_cut: bool, counted: int) -> None:
    """Sixteen of seventeen files of the kind end in a line of another trace, which their count leaves out."""
    (record,) = opened(tmp_path, film(tail, counted), "made.smc")
    expected = [RecordKind.SEAM_CUT, RecordKind.UNEVEN_FILM] if is_cut else [RecordKind.UNEVEN_FILM]
    assert [warning.kind for warning in record.warnings] == expected
    times = 0.005 * np.arange(record.acceleration.size)
    # The times are printed with four digits, by which a slope of 9 m/s³ moves the numbers.
    assert np.abs(record.acceleration - np.interp(times, TIMES, MOTION)).max() < 0.03
    assert times[-1] == pytest.approx(FILM[-1], abs=0.005)


@pytest.mark.parametrize("first", [TIMES + 1e-3 * np.sin(9 * np.arange(600)), np.round(0.5 * TIMES, 2)])
def test_a_column_of_times_for_each_channel_repeats_nothing(tmp_path: Path, first: np.ndarray) -> None:
    """Times that are uneven, or printed too coarsely, were taken for a motion that stands in the file twice."""
    text = rows(first, MOTION, first, np.roll(MOTION, 50))
    opened_once(tmp_path, text, "t, N, t, E m/s2")
    if np.diff(first).min() > 0:
        assert [record.component for record in read(tmp_path / "made.txt")] == ["N", "E"]
    else:
        with refused(RecordError, "times", 0.0):
            read(tmp_path / "made.txt")


@pytest.mark.parametrize("text", [
    "time (s),acc (m/s2)\n" + rows(TIMES, MOTION) + ",\n,,\n ; \n",
    "time (s),acc (m/s2),,\n" + rows(TIMES, MOTION).replace("\n", ",,\n"),
    "dt=0.01\nacc: m/s2\n" + rows(MOTION),
    "dt=0.01\nNPTS = 600\npoints: 601\nacc: m/s2\n" + rows(MOTION),
    "dt=0.01 / acc: m/s2\n" + rows(MOTION),
    "t,acc_g\n" + rows(TIMES, MOTION / 9.80665),
    "time,acc_g\n" + rows(TIMES, MOTION / 9.80665),
    "time (s),acc (m/s2)\n" + rows(TIMES, MOTION) + "VLEE $\n",
])  # fmt: skip
def test_what_offices_write_around_a_table(tmp_path: Path, text: str) -> None:
    (record,) = opened(tmp_path, text, "made.csv")
    assert record.time_step == 0.01 and np.allclose(record.acceleration, MOTION, atol=1e-5)


@pytest.mark.parametrize(("text", "field", "value"), [
    ("time (s),N (m/s2),E (m/s2)\n" + re.sub(r"(\n0\.5.*,).*", r"\1", rows(TIMES, MOTION, MOTION)), "columns", 2),
    ("time (s),N (m/s2),E (m/s2)\n" + re.sub(r"(\n0\.5.*,).*,", r"\1,", rows(TIMES, MOTION, MOTION)), "cell", ""),
    (rows(TIMES, MOTION, parted=" ") + "6.000000\n", "columns", 1),
    ("acc (m/s2)\n" + 40 * "12\n" + "12-34\n", "samples", None),
    ("t (s),N (m/s2)\n" + "".join(f"{i}e-8,{a:.6f}\n" for i, a in enumerate(MOTION)), "times", 1e-8),
    ("# NPTS = 601\n# points: 602\nt (s),N (m/s2)\n" + rows(TIMES, MOTION), "samples", 600),
])  # fmt: skip
def test_a_table_with_a_damaged_row_step_or_count_is_refused(
    tmp_path: Path, text: str, field: str, value: object
) -> None:
    with refused(RecordError, field, value):
        opened(tmp_path, text, "made.csv", unit="m/s2")


def test_small_letters_in_the_titles_of_the_mexican_standard(tmp_path: Path) -> None:
    text = made_files.unam().replace("ESTANDAR DE ACEL", "ESTANDAR De ACEL").replace("DATOS DE", "DATOS De")
    assert len(opened(tmp_path, text)) == 2


def test_one_letter_behind_a_station_s_digits_is_its_direction(tmp_path: Path) -> None:
    """TCU052E, N and V as Taiwan's collections call them: bare columns whose direction only the name says."""
    for letter, series in zip("ENV", (MOTION, np.roll(MOTION, 60), 0.5 * np.roll(MOTION, 120)), strict=True):
        (tmp_path / f"TCU052{letter}.txt").write_text(rows(TIMES, series, parted=" "))
    _, (row,) = list_folder(tmp_path, unit="m/s2")
    assert (row["file"], row["component"]) == ("TCU052E.txt;TCU052N.txt;TCU052V.txt", "E;N;V")
    (upwards,) = read(tmp_path / "TCU052V.txt", unit="m/s2")
    assert upwards.vertical and [warning.kind for warning in upwards.warnings] == [
        RecordKind.VERTICAL_BY_NAME
    ]
