"""Two words on one fact that differ are asked or refused at every door, naming both and what to type."""

from collections.abc import Callable
from pathlib import Path

import made_files
import obspy
import openpyxl
import pytest
from made_files import MADE, MADE_BINARY, content_of

import rocking
from rocking.catalogue import load_catalogue, open_station
from rocking.earthquakes.sample import MADE as MADE_MOTION
from rocking.errors import RecordError
from rocking.records import read
from rocking.records.formats import Options
from rocking.records.formats.layouts import AskedError
from rocking.records.kinds import RecordKind
from rocking.records.obspy import workspace
from rocking.records.read import read_content
from tests.unit.catalogue.test_catalogue import row, write
from tests.unit.records.test_claims import at2
from tests.unit.records.test_instruments import XML, trace
from tests.unit.records.test_layouts import MOTION, TIMES, answered, table

STRONG = 0.1 * MOTION


def text(head: str, columns: str = "t,NS (m/s2)", name: str = "made.csv") -> Callable[[Path], Path]:
    """A table of times and motion below a head of comments."""

    def write(folder: Path) -> Path:
        path = folder / name
        names = f"{columns}\n" if columns else ""
        path.write_text(head + names + table(TIMES, STRONG, parted=","), encoding="utf-8")
        return path

    return write


def series(head: str, name: str = "made.txt") -> Callable[[Path], Path]:
    """A column alone, whose step nothing but the head or a person says."""

    def write(folder: Path) -> Path:
        (folder / name).write_text(head + table(STRONG), encoding="utf-8")
        return folder / name

    return write


def book(
    head: str,
    columns: tuple[str, ...] = ("t (s)", "NS (m/s2)"),
    name: str = "made.xlsx",
    below: tuple[str, ...] = (),
) -> Callable[[Path], Path]:
    """A workbook with a line of text above its names."""

    def write(folder: Path) -> Path:
        sheet = (document := openpyxl.Workbook()).active
        for cells in filter(
            None, ([head] if head else [], columns, below, *zip(TIMES.tolist(), STRONG.tolist(), strict=True))
        ):
            sheet.append(cells)
        document.save(folder / name)
        return folder / name

    return write


def of_peer(name: str = "made.AT2", **parts: str) -> Callable[[Path], Path]:
    return lambda folder: at2(folder, **parts).rename(folder / name)


def of_instrument(code: str, azimuth: str) -> Callable[[Path], Path]:
    """Counts next to the StationXML of a channel of this code and azimuth."""

    def write(folder: Path) -> Path:
        record = trace()
        xml = XML.format(units="M/S**2").replace("<Azimuth>72</Azimuth>", f"<Azimuth>{azimuth}</Azimuth>")
        xml = xml.replace(f'code="{record.stats.channel}"', f'code="{code}"')
        record.stats.channel = code
        record.write(str(folder / "record.mseed"), format="MSEED")
        (folder / "station.xml").write_text(xml)
        return folder / "record.mseed"

    return write


def answer(write: Callable[[Path], Path], text_of: str) -> Callable[[Path], Path]:
    """The file with the answer that a person gave to what it asks."""

    def answered_file(folder: Path) -> Path:
        path = write(folder)
        with pytest.raises(AskedError) as asked:
            read(path)
        answered(folder, asked.value.question, text_of)
        return path

    return answered_file


CASES: dict[str, tuple[Callable[[Path], Path], dict, tuple[str, ...]]] = {
    # unit
    "unit: AT2, head and option": (of_peer(), {"unit": "gal"}, ("gal", "UNITS OF G")),
    "unit: AT2, two heads": (of_peer(unit="UNITS OF G, UNITS OF GAL"), {}, ("UNITS OF G", "unit=")) ,
    "unit: AT2, brackets": (of_peer(first="RECORD (cm/s2)"), {}, ("RECORD (cm/s2)", "UNITS OF G", "unit=")),
    "unit: AT2, name and option": (of_peer("acc_m_s2.AT2", unit="HISTORY"), {"unit": "g"}, ("g", "m_s2")),
    "unit: AT2, name and head": (of_peer("made_m_s2.AT2"), {}, ("m_s2", "UNITS OF G", "unit=")),
    "unit: table, name and column": (text("", name="made_gal.csv"), {}, ("gal", "NS (m/s2)", "unit=")),
    "unit: workbook, name and column": (book("", name="made_gal.xlsx"), {}, ("gal", "NS (m/s2)", "unit=")),
    "unit: table, head and column": (text("# units: mg\n"), {}, ("units: mg", "NS (m/s2)", "unit=")),
    "unit: table, column and option": (text(""), {"unit": "g"}, ("'g'", "NS (m/s2)")),
    "unit: table, head and option": (text("# units: mg\n", "t,NS"), {"unit": "g"}, ("'g'", "units: mg")),
    "unit: table, name and option": (text("", "t,NS", "acc_m_s2.csv"), {"unit": "g"}, ("'g'", "m_s2")),
    "unit: table, two heads": (text("# units: mg\n# units: gal\n", "t,NS"), {}, ("mg", "gal", "unit=")),
    "unit: table, head and answer": (
        answer(text("Station X\nk = 7\n# units: mg\n", "t,Q1,"), "t, NS g"), {}, ("g", "mg")
    ),
    "unit: table, answer and option": (answer(series(""), "one series g, dt 0.01"), {"unit": "gal"}, ("'g'", "'gal'")),
    "unit: table, name and answer": (
        answer(series("", "made_gal.txt"), "one series g, dt 0.01"), {}, ("g", "gal")
    ),
    "unit: workbook, column and option": (book(""), {"unit": "g"}, ("'g'", "NS (m/s2)")),
    "unit: workbook, head and column": (book("units: mg"), {}, ("mg", "NS (m/s2)", "unit=")),
    "unit: AT2, Portuguese head": (of_peer(first="unidade: cm/seg2"), {}, ("cm/seg2", "UNITS OF G", "unit=")),
    "unit: table, Russian head": (text("# единицы: см/с²\n", "t,NS (g)"), {}, ("см/с²", "NS (g)", "unit=")),
    "unit: table, Japanese head": (text("# 加速度(gal)\n"), {}, ("gal", "NS (m/s2)", "unit=")),
    "unit: table, name in mg": (text("", name="made_mg.csv"), {}, ("mg", "NS (m/s2)", "unit=")),
    "unit: workbook, name and row below": (
        book("", ("t", "NS (mg)"), below=("s", "g")), {}, ("NS (mg)", "(g)", "unit=")
    ),
    # step
    "step: AT2, head and option": (of_peer(), {"time_step": 0.02}, ("0.02", "0.01")),
    "step: AT2, two heads": (of_peer(first="RECORD, dt = 0.003 s"), {}, ("dt = 0.003 s", "0.01 s", "time_step=")),
    "step: AT2, head and rate": (of_peer(first="RECORD. Sampling rate: 40 Hz"), {}, ("40 Hz", "0.01 s", "time_step=")),
    "step: AT2, name and head": (of_peer("made_dt0.005.AT2"), {}, ("dt0.005", "0.01 s", "time_step=")),
    "step: table, name and times": (text("", name="made_50Hz.csv"), {}, ("50Hz", "0.01 s", "time_step=")),
    "step: table, head and times": (text("# dt = 0.005\n"), {}, ("0.005", "0.01 s", "time_step=")),
    "step: table, column and answer": (answer(text("", "t (ms),Q1,"), "t, NS g"), {}, ("t (ms)", "t, NS g")),
    "step: table, times and option": (text(""), {"time_step": 0.02}, ("0.02", "0.01")),
    "step: table, head and option": (series("# dt = 0.005\n# units: g\n"), {"time_step": 0.02}, ("0.02", "0.005")),
    "step: table, rate and step": (series("# dt = 0.005\n# sampled at 100 Hz\n# units: g\n"), {}, ("time_step=",)),
    "step: table, two heads": (series("# dt = 0.005\n# dt = 0.01\n# units: g\n"), {}, ("time_step=",)),
    "step: table, name and option": (
        series("# units: g\n", "made_dt0.005.txt"), {"time_step": 0.02}, ("0.02", "dt0.005")
    ),
    "step: table, name and answer": (
        answer(series("", "made_dt0.005.txt"), "one series g, dt 0.01"), {}, ("0.01", "dt0.005")
    ),
    "step: table, head and answer": (
        answer(series("Station X\nk = 7\n# dt = 0.005\n"), "one series g, dt 0.01"), {}, ("0.01", "0.005")
    ),
    "step: table, answer and option": (
        answer(series(""), "one series g, dt 0.01"), {"time_step": 0.02}, ("0.01", "0.02")
    ),
    "step: workbook, head and times": (book("dt = 0.005 s"), {}, ("0.005", "0.01 s", "time_step=")),
    "step: workbook, times and option": (book(""), {"time_step": 0.02}, ("0.02", "0.01")),
    "step: table, Russian head": (text("# частота дискретизации: 50 Гц\n"), {}, ("50 Гц", "0.01 s", "time_step=")),
    "step: table, head in ms": (text("# Abtastintervall: 5 ms\n"), {}, ("5 ms", "0.01 s", "time_step=")),
    "step: table, rate that is spoken of and option": (
        series("# units: g\n# 200 samples per second\n"), {"time_step": 0.02}, ("0.02", "200 samples")
    ),
    "step: table, name in ms": (text("", name="made_5ms.csv"), {}, ("5ms", "0.01 s", "time_step=")),
    # count
    "count: table, Italian head": (text("# numero di campioni: 1000\n"), {}, ("1000", "600")),
    "count: workbook, two cells": (book("NPTS 1000"), {}, ("1000", "600")),
    "count: table, head and rows": (text("# NPTS = 1000\n"), {}, ("1000", "600")),
    "count: table, two heads": (text("# NPTS = 700\n# 1000 points\n"), {}, ("700", "600")),
    "count: workbook, head and rows": (book("NPTS = 1000"), {}, ("1000", "600")),
    # quantity
    "quantity: AT2, title": (of_peer(first="PEER VELOCITY TIME SERIES"), {}, ("velocity",)),
    "quantity: AT2, name": (of_peer("made.VT2"), {}, ("velocity", "UNITS OF G", "unit=")),
    "quantity: table, head": (text("# velocity in cm/s\n", "t,NS"), {"unit": "g"}, ("velocity",)),
    "quantity: table, column": (text("", "t,vel (cm/s)"), {}, ("velocity",)),
    "quantity: table, name": (text("", "t,NS", "made_vel.csv"), {"unit": "g"}, ("velocity",)),
    "quantity: workbook, head": (book("velocity in cm/s"), {}, ("velocity",)),
    "quantity: workbook, column": (book("", ("t (s)", "vel (cm/s)")), {}, ()),
    "quantity: table, unit of length": (text("# units: cm\n", "t,NS"), {"unit": "g"}, ("displacement",)),
    "quantity: table, name of a spectrum": (text("", "t,NS", "made_psa.csv"), {"unit": "g"}, ("spectrum",)),
    "quantity: table, spectrum in Spanish": (text("# espectro de respuesta\n", "t,NS"), {"unit": "g"}, ("espectro",)),
    "quantity: table, unit of length in Italian": (text("# unità: m\n"), {}, ("displacement",)),
    # direction
    "direction: table, column and answer": (
        answer(text("Station X\nk = 7\n", "t,NS,"), "t, EW g"), {}, ("NS", "EW g")
    ),
    "direction: table, head and answer": (
        answer(text("Station X\nk = 7\n# Component: NS\n", "t,Q1,"), "t, EW g"), {}, ("NS", "EW g")
    ),
}  # fmt: skip
"""What speaks of a fact twice → (how the file is written, what is typed, what the sentence names)."""


@pytest.mark.parametrize("case", CASES)
def test_two_words_that_differ_are_asked_or_refused_with_both(tmp_path: Path, case: str) -> None:
    write, typed, named = CASES[case]
    path = write(tmp_path)
    with pytest.raises(RecordError) as said:
        read(path, **typed)
    for word in named:
        assert word in str(said.value), str(said.value)


@pytest.mark.parametrize(("made", "kind", "named"), [
    (of_peer(first="COMPONENT AZIMUTH = 300"), RecordKind.DIRECTION_SAID_TWICE, ("300", "090")),
    (of_peer(first="RECORD, vertical component"), RecordKind.DIRECTION_SAID_TWICE, ("vertical", "090")),
    (text("# Komponente: Ost-West\n"), RecordKind.DIRECTION_SAID_TWICE, ("Ost-West", "NS")),
    (text("# Component: NS\n# Yön: düşey\n", "t,acc (m/s2)"), RecordKind.DIRECTION_SAID_TWICE, ("NS", "düşey")),
    (of_peer("x_UP.AT2"), RecordKind.DIRECTION_IN_NAME, ("UP", "090")),
    (text("", "t,H1 (m/s2)", "x_vertical_acc.csv"), RecordKind.DIRECTION_IN_NAME, ("vertical", "H1")),
    (text("", name="x_EW.csv"), RecordKind.DIRECTION_IN_NAME, ("EW", "NS")),
    (text("# Component: EW\n"), RecordKind.DIRECTION_SAID_TWICE, ("EW", "NS")),
    (book("Component: EW"), RecordKind.DIRECTION_SAID_TWICE, ("EW", "NS")),
    (of_instrument("HNN", "100"), RecordKind.DIRECTION_CONTRADICTED, ("HNN", "100")),
    (of_instrument("HNZ", "72"), RecordKind.DIRECTION_CONTRADICTED, ("HNZ", "72")),
])  # fmt: skip
def test_two_directions_that_differ_are_told_with_both(
    tmp_path: Path, made: Callable[[Path], Path], kind: RecordKind, named: tuple[str, ...]
) -> None:
    """No option could settle them."""
    (record,) = read(made(tmp_path))
    told = [str(warning) for warning in record.warnings if warning.kind is kind]
    assert len(told) == 1 and all(word in told[0] for word in named)


@pytest.mark.parametrize(("code", "azimuth"), [("HNN", 100.0), ("HNZ", 72.0)])
def test_a_stream_is_told_what_its_stationxml_says_of_its_direction(
    tmp_path: Path, code: str, azimuth: float
) -> None:
    path = of_instrument(code, f"{azimuth:g}")(tmp_path)
    (record,) = rocking.from_obspy(obspy.read(str(path)), inventory(tmp_path))
    assert record.azimuth == azimuth
    assert RecordKind.DIRECTION_CONTRADICTED in {warning.kind for warning in record.warnings}


def test_what_a_header_calls_synthetic_is_made_in_every_catalogue(tmp_path: Path) -> None:
    """Else it counted as recorded where a row does not say it."""
    at2(tmp_path, first="SYNTHETIC ACCELEROGRAM, NOT RECORDED")
    for event in ("", MADE_MOTION):
        path = write(tmp_path, row(file="made.AT2", sha256="", event=event))
        assert open_station(load_catalogue(path)[0]).horizontal[0].event == MADE_MOTION
    path = write(tmp_path, row(file="made.AT2", sha256="", event="Kobe 1995"))
    with pytest.raises(RecordError) as said:
        open_station(load_catalogue(path)[0])
    assert "Kobe 1995" in str(said.value) and MADE_MOTION in str(said.value)


FORMATS = [name for name in (MADE | MADE_BINARY) if not (MADE | MADE_BINARY)[name][2].unit]


@pytest.mark.parametrize("name", FORMATS)
@pytest.mark.parametrize("typed", [{"unit": "mg"}, {"time_step": 3 * made_files.STEP}])
def test_what_is_typed_stands_against_no_format(name: str, typed: dict) -> None:
    """Each format that states its unit and its step refuses another; the sentence names both."""
    with pytest.raises(RecordError) as said:
        read_content(content_of(name), "made", Options(**typed))
    ((field, value),) = typed.items()
    assert said.value.field == field and f"{value}" in str(said.value)


def inventory(folder: Path) -> object:
    return obspy.read_inventory(str(folder / "station.xml"))


def workspace_of(unit: str, of_channel: str = "") -> bytes:
    """A station of a workspace whose processing left `unit`, with a StationXML that states another, or none."""
    whole = made_files.asdf_station()
    facts, _, samples = workspace._parted(whole)
    facts["traces"][0]["unit"] = unit
    xml = XML.format(units="M/S**2").replace('locationCode=""', 'locationCode="20"').replace('"XX"', '"NZ"')
    if of_channel:
        xml = xml.replace(
            "<SampleRate>", f"<CalibrationUnits><Name>{of_channel}</Name></CalibrationUnits><SampleRate>"
        )
    return workspace.packed({**facts}, xml.encode() if of_channel else b"", samples)


def test_a_workspace_is_held_against_what_is_typed_and_said_twice() -> None:
    with pytest.raises(RecordError) as said:
        read_content(workspace_of("cm/s^2"), "made", Options(unit="g"))
    assert "'g'" in str(said.value) and "cm/s" in str(said.value)
    for unit in ("cm/s", "m"):
        with pytest.raises(RecordError):
            read_content(workspace_of(unit), "made", Options())


@pytest.mark.parametrize(("cells", "named"), [
    ({"unit": "gal"}, ("gal", "UNITS OF G")), ({"time_step_s": "0.02"}, ("0.02", "0.01")),
])  # fmt: skip
def test_a_cell_of_the_catalogue_stands_against_no_file(tmp_path: Path, cells: dict, named: tuple) -> None:
    at2(tmp_path)
    path = write(tmp_path, row(file="made.AT2", sha256="", **cells))
    with pytest.raises(RecordError) as said:
        open_station(load_catalogue(path)[0])
    assert all(word in str(said.value) for word in named)


def test_a_stream_is_held_against_its_own_unit_and_processing() -> None:
    own = read_content(content_of("PEER AT2"), "made.AT2", Options())[0].to_obspy()
    with pytest.raises(RecordError, match=r"m/s2.*'g'"):
        rocking.from_obspy(own, unit="g")
    with pytest.raises(RecordError, match="velocity"):
        rocking.from_obspy(own.copy().integrate(), unit=None)
