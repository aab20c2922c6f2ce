"""Files that were once misread, or refused though they are good: each made as it lies in some collection."""

from pathlib import Path

import made_files
import numpy as np
import pytest

from rocking.errors import RecordError
from rocking.records import Accelerogram, read
from rocking.records.folder import list_folder
from rocking.remarks import Kind

TIMES = 0.01 * np.arange(600)
MOTION = np.sin(7.3 * TIMES) * np.exp(-0.4 * TIMES) + 0.2 * np.sin(31 * TIMES + 1)


def opened(folder: Path, text: str, name: str = "made.txt", **declared: object) -> list[Accelerogram]:
    """The channels of a file with that text."""
    (folder / name).write_text(text)
    return read(folder / name, **declared)


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
    channels = opened(tmp_path, rows(MOTION, other, third, parted=parted), unit="m/s2", time_step=0.01)
    assert [
        np.allclose(a.acceleration, b, atol=1e-6)
        for a, b in zip(channels, (MOTION, other, third), strict=True)
    ]


def test_one_and_the_step_above_a_column_are_no_samples(tmp_path: Path) -> None:
    """As some programs of analysis begin their files: one series, every 0.005 s."""
    column = "".join(f"{value:.6f}\n" for value in 0.1 * MOTION)
    (record,) = opened(tmp_path, f"1\n0.005\n{column}", unit="g")
    assert record.time_step == 0.005 and record.acceleration.size == MOTION.size
    assert [remark.kind for remark in record.warnings] == [Kind.FIRST_ARE_SERIES_AND_STEP]
    # A column that begins with 1 and goes on near it is a motion.
    (record,) = opened(tmp_path, "1\n" + rows(MOTION + 0.8), unit="m/s2", time_step=0.01)
    assert record.acceleration.size == MOTION.size + 1


def test_strain_is_no_acceleration_and_a_numbered_letter_no_direction(tmp_path: Path) -> None:
    """Strata calls its columns S-1, S-2, after the soils."""
    with pytest.raises(RecordError, match="this is a file of shear strain"):
        opened(tmp_path, "# Shear Strain time series\nTime (s),S-1\n" + rows(TIMES, MOTION), unit="g")
    (record,) = opened(tmp_path, "Time (s),S-1\n" + rows(TIMES, MOTION), unit="m/s2")
    assert record.azimuth is None


@pytest.mark.parametrize("first", [np.geomspace(0.01, 10, 600), np.linspace(0.1, 60, 600)])
def test_a_matrix_of_spectra_is_no_record(tmp_path: Path, first: np.ndarray) -> None:
    with pytest.raises(RecordError, match="no number of its columns is below zero"):
        opened(tmp_path, rows(first, np.abs(MOTION), 0.5 * np.abs(MOTION)), unit="g", time_step=0.01)


def test_an_even_pair_of_columns_without_negative_numbers_is_told(tmp_path: Path) -> None:
    """It may be a record whose offset was not removed."""
    (record,) = opened(tmp_path, rows(TIMES, np.abs(MOTION)), unit="m/s2")
    assert Kind.NEVER_NEGATIVE in {remark.kind for remark in record.warnings}


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
