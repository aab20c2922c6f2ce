"""Stations: components from several files, joined; and the vertical one."""

from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.catalogue import CatalogueRecord, open_station
from rocking.catalogue.folder import catalogue_of_folder, unlisted
from rocking.catalogue.listing import warnings_of
from rocking.errors import RecordError
from rocking.records import Accelerogram
from rocking.records.kinds import RecordKind
from rocking.signal import aligned
from rocking.warnings import RockingWarning
from tests.folders import list_folder
from tests.refusals import refused

VALUES = np.sin(np.arange(300) * 0.3)


def _written(folder, name, component, values, start=""):
    """A small DYNA file, whose header names its component and may say when it begins."""
    stamp = f"20200101_0000{start}" if start else ""
    text = (
        f"EVENT_NAME: E\nNETWORK: XX\nSTATION_CODE: S\nDATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS: {stamp}\n"
        f"SAMPLING_INTERVAL_S: 0.01\nNDATA: {len(values)}\nSTREAM: {component}\nUNITS: m/s^2\n"
        "DATA_TYPE: ACCELERATION\n"
    )
    (folder / name).write_text(text + "".join(f"{v:.8f}\n" for v in values))


@pytest.fixture
def station(tmp_path):
    _written(tmp_path, "e.asc", "HNE", VALUES, "10.00")
    _written(tmp_path, "n.asc", "HNN", 2 * VALUES[:290], "10.10")
    _written(tmp_path, "z.asc", "HNZ", 0.5 * VALUES[:250], "09.95")
    return tmp_path


def _record(folder, file="e.asc;n.asc;z.asc", **cells):
    return CatalogueRecord("a", file, folder=folder, **cells)


def test_the_files_of_a_station_are_one_record_on_their_common_span(station):
    """From 10.10 s on: 10 samples of the first, 15 of the third are before it, which leaves 235 of the third."""
    opened = open_station(_record(station, scale_factor=2.0))
    east, north = opened.horizontal
    assert (east.component, north.component, opened.vertical.component) == ("HNE", "HNN", "HNZ")
    # eight digits are printed
    assert east.acceleration == pytest.approx(2 * VALUES[10:245], abs=2e-8)
    assert north.acceleration == pytest.approx(4 * VALUES[:235], abs=2e-8)
    assert opened.vertical.acceleration == pytest.approx(VALUES[15:250], abs=2e-8)
    assert {c.start_time for c in (east, north, opened.vertical)} == {"2020-01-01T00:00:10.100000Z"}
    assert all("Cut to the span common" in c.processing[-1] for c in (east, north, opened.vertical))


def test_a_component_that_the_row_calls_vertical_acts_upwards_and_no_other(station):
    opened = open_station(_record(station, vertical_component="HNE"))
    assert [channel.component for channel in (*opened.horizontal, opened.vertical)] == ["HNN", "HNE"]


def test_files_that_do_not_fit_together_are_refused_in_a_sentence(station):
    """Unlike names, steps and lengths; between samples; apart in time."""
    _written(station, "short.asc", "HNN", VALUES[:200])
    _written(station, "late.asc", "HNN", VALUES, "50.00")
    _written(station, "between.asc", "HNN", VALUES, "10.005")
    _written(station, "again.asc", "HNE", -VALUES, "10.00")
    (station / "half.asc").write_text((station / "n.asc").read_text().replace("S: 0.01", "S: 0.02"))
    (station / "v.asc").write_text((station / "n.asc").read_text().replace("ACCELERATION", "VELOCITY"))
    for other, field in {
        "short": "files", "late": "samples", "between": "start_time", "again": "files", "half": "files",
        "v": "quantity",
    }.items():  # fmt: skip
        with refused(RecordError, field) as caught:
            open_station(_record(station, f"e.asc;{other}.asc"))
        assert str(caught.value).startswith("a: ") and "\n" not in str(caught.value)
    for cells, (field, value) in (
        ({"inventory": "none.xml"}, ("inventory", "none.xml")),
        ({"file": "z.asc"}, ("component", "HNZ")),  # no horizontal component
        ({"component": "HNX"}, ("component", "HNX")),
        ({"vertical_component": "HNX"}, ("component", "HNX")),
    ):
        with refused(RecordError, field, value):
            open_station(_record(station, **cells))


def test_files_that_name_no_component_are_named_by_the_row(tmp_path):
    for name, factor in (("u", 0.5), ("a", 1.0), ("b", 2.0)):
        rows = "".join(f"{i * 0.01:.2f} {factor * v:.8f}\n" for i, v in enumerate(VALUES))
        (tmp_path / f"{name}.txt").write_text(rows)
    opened = open_station(_record(tmp_path, "u.txt;a.txt;b.txt", unit="m/s2", component="UP;N30W;N60E"))
    assert [c.azimuth for c in opened.horizontal] == [330.0, 60.0] and opened.vertical.component == "UP"
    assert opened.horizontal[1].acceleration == pytest.approx(2 * VALUES, abs=2e-8)


def test_a_direction_that_the_row_says_is_in_doubt_no_more(tmp_path):
    """The heading "acc" says no direction; the names of the files do, and so the row."""
    for angle, period in (("000", 0.7), ("090", 0.9)):
        times = np.arange(400) * 0.01
        lines = [f"{time:.2f},{0.3 * np.sin(2 * np.pi * time / period):.6f}" for time in times]
        (tmp_path / f"event_st_{angle}.csv").write_text("time (s),acc (g)\n" + "\n".join(lines) + "\n")
    first = catalogue_of_folder(tmp_path)
    (row,) = first.new
    assert row["component"] == "000;090"
    again = catalogue_of_folder(tmp_path, existing=[row])
    for listing in (first, again):
        assert [warnings_of(file) for file in listing.files] == [[], []]
    opened = open_station(_record(tmp_path, row["file"], component=row["component"]))
    assert [channel.azimuth for channel in opened.horizontal] == [0.0, 90.0]
    assert [channel.warnings for channel in opened.horizontal] == [(), ()]


def test_a_folder_joins_the_files_of_a_station_and_says_why_not(station):
    _written(station, "later.asc", "HNE", VALUES, "59.00")
    text = (station / "e.asc").read_text()
    (station / "other.asc").write_text(text.replace("STATION_CODE: S", "STATION_CODE: T"))
    (station / "event.asc").write_text(text.replace("EVENT_NAME: E", "EVENT_NAME: F"))
    listed, rows = list_folder(station)
    assert [row["file"] for row in rows] == ["e.asc;n.asc;z.asc", "event.asc", "later.asc", "other.asc"]
    assert listed[0].companions == 2
    _written(station, "again.asc", "HNN", -VALUES, "10.00")
    files = {file.file: file for file in list_folder(station)[0]}
    assert files["e.asc"].separation == RockingWarning.of(RecordKind.COMPONENT_TWICE, "HNN", times=2)
    assert not files["e.asc"].companions


def test_records_beside_the_catalogue_that_it_does_not_name_are_told(station):
    (station / "notes.txt").write_text("Dear Sir or Madam\n")
    (station / "catalogue.csv").write_text("id,file\na,e.asc;n.asc\n")
    (told,) = unlisted(station / "catalogue.csv")
    assert told == RockingWarning.of(RecordKind.FILES_UNLISTED, files="z.asc", folder=str(station))
    _written(station, "more.asc", "HNE", VALUES)
    (told,) = unlisted(station / "catalogue.csv")
    assert told == RockingWarning.of(RecordKind.FILES_UNLISTED, files="more.asc, z.asc", folder=str(station))
    (station / "other.csv").write_text("id,file\nb,z.asc\nc,more.asc\n")
    assert unlisted(station / "catalogue.csv") == ()


def test_a_file_that_a_catalogue_refused_is_not_said_to_be_new_until_it_is_another(station):
    """Of z.asc, which holds the vertical component alone, and of one with too few samples."""
    _written(station, "short.asc", "HNE", VALUES[:1])
    (station / "catalogue.csv").write_text("id,file\na,e.asc;n.asc\n")
    (told,) = unlisted(station / "catalogue.csv")
    assert told == RockingWarning.of(
        RecordKind.FILES_UNLISTED, files="short.asc, z.asc", folder=str(station)
    ), "nobody has read them"
    existing = [{"id": "a", "file": "e.asc;n.asc"}]
    found = catalogue_of_folder(station, existing=existing, keeps_readings=True)
    assert not found.new and all(file.refusal for file in found.files if not file.record)
    assert unlisted(station / "catalogue.csv") == ()
    _written(station, "short.asc", "HNE", VALUES)
    (told,) = unlisted(station / "catalogue.csv")
    assert told == RockingWarning.of(RecordKind.FILES_UNLISTED, files="short.asc", folder=str(station))


JOINED = {
    "capemend1992_petrolia": 3, "chichi1999_tcu052": 2, "christchurch2011_cccc": 2, "duzce1999_bolu": 2,
    "erzincan1992": 3, "manjil1990_abbar": 2,
    "formats_afad": 3, "formats_emod3d": 3, "formats_esm_dyna": 3, "formats_knet": 6, "impvall1940_elcentro": 2,
    "formats_mseed_stationxml": 3, "formats_sac": 3, "formats_smc": 2, "impvall1979_bonds_corner": 2,
    "impvall1979_e04": 2, "impvall1979_e06": 3, "impvall1979_e07": 3, "kobe1995_kjma": 3, "kocaeli1999_yarimca": 3,
    "kobe1995_takatori": 2, "landers1992_lucerne": 3, "lomaprieta1989_corralitos": 2, "lomaprieta1989_los_gatos_LGP": 2,
    "northridge1994_newhall": 3, "northridge1994_rinaldi": 3,
    "northridge1994_sylmar_olive_view": 3, "open": 6, "parkfield2004_c02": 3,
}  # fmt: skip
"""Files by folder, by hand from their names. Of Erzincan and Manjil the lengths differ by more than 2 %."""


@pytest.mark.real_records
@pytest.mark.parametrize("folder", [case for case in JOINED if not case.startswith("formats_")])
def test_the_files_of_a_real_station_are_joined(real_records, folder):
    _, rows = list_folder(real_records / folder)
    assert sum(len(row["file"].split(";")) for row in rows if ";" in row["file"]) == JOINED[folder]


@pytest.mark.slow
@pytest.mark.real_records
def test_the_real_stations_are_joined_and_no_other(real_records):
    _, rows = list_folder(real_records)
    joined = [row["file"].split(";") for row in rows if ";" in row["file"]]
    near = [files for files in joined if "suites" not in files[0]]
    counts = Counter(str(Path(file).parent) for files in near for file in files)
    assert counts == JOINED
    for files in near:
        assert len({Path(file).name[:3] for file in files}) == 1 or "example" in files[0], files
    suites = [[int(Path(file).stem) for file in files] for files in joined if "suites" in files[0]]
    assert len(suites) >= 20 and all(one % 2 == 1 and other == one + 1 for one, other in suites)


def test_it_is_still_after_its_end_and_cut_at_the_end_of_the_other():
    short, long = Accelerogram(np.ones(5), 0.01), Accelerogram(np.zeros(8), 0.01)
    assert aligned(short, long).acceleration.tolist() == [1.0] * 5 + [0.0] * 3
    assert aligned(long, short).acceleration.tolist() == [0.0] * 5


def test_a_channel_that_may_be_vertical_is_asked_for(tmp_path):
    """Two, or three whose names say which is upright, are taken; a row that names components decides."""
    waves = np.random.default_rng(1).normal(size=(3, 300))

    def table(names):
        rows = zip(np.arange(300) * 0.01, *waves[: len(names)], strict=True)
        lines = [",".join(f"{value:.6f}" for value in row) for row in rows]
        heads = ["time (s)", *(f"{name} (m/s2)" for name in names)]
        (tmp_path / "t.csv").write_text("\n".join([",".join(heads), *lines]) + "\n")
        return _record(tmp_path, "t.csv")

    with pytest.raises(RecordError) as caught:
        open_station(table("ABC"))
    asked = RockingWarning.of(RecordKind.SOME_MAY_BE_VERTICAL, channels=3, names="A, B, C")
    assert str(caught.value).endswith(f"t.csv: {asked}")
    named = open_station(replace(table("ABC"), component="A;C"))
    assert [channel.component for channel in named.horizontal] == ["A", "C"] and named.vertical is None
    assert len(open_station(table("AB")).horizontal) == 2
    with pytest.raises(RecordError) as caught:
        open_station(table(["QQX"]))
    assert str(caught.value).endswith(f"t.csv: {RockingWarning(RecordKind.LONE_MAY_BE_VERTICAL, 'QQX')}")
    (alone,) = open_station(replace(table(["QQX"]), component="QQX")).horizontal
    assert alone.component == "QQX"
    kinds = {warning.kind for channel in (alone, *named.horizontal) for warning in channel.warnings}
    assert not kinds & {RecordKind.LONE_MAY_BE_VERTICAL, RecordKind.SOME_MAY_BE_VERTICAL}
    upright = open_station(table(["A", "B", "UP"]))
    assert [channel.component for channel in upright.horizontal] == ["A", "B"]
    assert upright.vertical.component == "UP"


@pytest.mark.parametrize(
    "name",
    [
        "acc",
        "ACC",
        "a",
        "Acceleration",
        "ground acc",
        "signal",
        "elcentro",
        "X",
        "S1",
        "CH 1",
        "Fault normal",
    ],
)
def test_a_lone_column_with_a_heading_in_words_is_read(tmp_path, name):
    """It is a description and no channel code, and a file of one column is what most people have."""
    rows = "".join(f"{0.01 * place:.2f},{value:.6f}\n" for place, value in enumerate(VALUES))
    (tmp_path / "t.csv").write_text(f"time (s),{name} (m/s2)\n{rows}")
    assert len(open_station(_record(tmp_path, "t.csv")).horizontal) == 1


@pytest.mark.parametrize(("second", "told"), [("90", False), ("95", False), ("96", True), ("84", True)])
def test_components_more_than_five_degrees_off_a_right_angle_are_told(tmp_path, second, told):
    _written(tmp_path, "a.asc", "000", VALUES, "10.00")
    _written(tmp_path, "b.asc", second, np.roll(VALUES, 5), "10.00")
    _, (row,) = list_folder(tmp_path)
    apart = RockingWarning.of(RecordKind.NOT_SQUARE, first="000", second=second, angle_deg=84.0)
    assert (str(apart) in row["note"]) is told


@pytest.mark.parametrize(("east", "upward", "horizontal", "has_vertical"), [
    (1.0, 0.5, ["NS"], True), (-1.0, 0.5, ["NS"], True), (0.7, 1.0, ["NS", "EW"], False),
    (0.7, 0.5, ["NS", "EW"], True),
])  # fmt: skip
def test_a_component_that_is_a_copy_of_another_is_told_and_counted_once(
    tmp_path: Path, east: float, upward: float, horizontal: list[str], has_vertical: bool
) -> None:
    times = np.arange(400) * 0.01
    motion = np.sin(9 * times) * np.exp(-((times - 2) ** 2)) * 0.3
    rows = np.transpose([times, motion, east * motion, upward * motion])
    lines = "\n".join(" ".join(f"{value:.7f}" for value in row) for row in rows)
    (tmp_path / "made.txt").write_text(f"Time(s) NS(g) EW(g) UD(g)\n{lines}\n")
    record = CatalogueRecord("r", "made.txt", folder=tmp_path)
    station = open_station(record)
    assert [channel.component for channel in station.horizontal] == horizontal
    assert (station.vertical is not None) == has_vertical
    copies = [warning for warning in station.horizontal[0].warnings if warning.kind is RecordKind.SAME_MOTION]
    assert bool(copies) == (len(horizontal) + has_vertical < 3)
    assert {dict(copy.values)["other"] for copy in copies} <= {"NS", "EW"}, "by name, not by place"
    named = open_station(replace(record, component="NS;EW"))
    assert [channel.component for channel in named.horizontal] == horizontal
