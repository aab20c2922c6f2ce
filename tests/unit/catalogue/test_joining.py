"""Joining: which files of a folder are one station's, on files made in the shape of those that were joined wrongly."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import rocking
from rocking.catalogue import CatalogueRecord, load_catalogue, open_station
from rocking.catalogue.catalogue import catalogue_text
from rocking.catalogue.folder import catalogue_of_folder
from rocking.catalogue.listing import listing_text, reading_of, warnings_of
from rocking.records.claims import direction_in_name
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.folders import list_folder

VALUES = 0.3 * np.sin(np.arange(4000) * 0.07) * np.hanning(4000)


FACTORS = {
    "000": 1.3,
    "090": 1.4,
    "N": 1.1,
    "HNE": 1.5,
    "T": 1.6,
    "FP": 1.7,
    "TRAN": 1.8,
    "HN2": 1.9,
    "Y": 1.05,
}
"""By which the components of a station differ: none is a copy of another."""


def peer(
    folder: Path, name: str, component: str, size: int = 4000, place: str = "Here", date: str = "1/2/1999"
) -> None:
    """A file of PEER, in g; `place` is its station and `date` that of the earthquake."""
    rows = "\n".join(f"{value:.7E}" for value in VALUES[:size] * FACTORS.get(component, 1.2))
    head = f"PEER NGA\nQuake, {date}, {place}, {component}\nACCELERATION IN UNITS OF G\nNPTS= {size}, DT= .005 SEC\n"
    (folder / name).write_text(f"{head}{rows}\n")


def bare(
    folder: Path, name: str, factor: float, heading: str = "", size: int = 4000, step: float = 0.01
) -> None:
    """A table of time and one column that says no direction."""
    rows = "".join(f"{i * step:.3f},{factor * v:.6f}\n" for i, v in enumerate(VALUES[:size]))
    (folder / name).write_text(heading + rows)


def rows(folder: Path) -> dict[str, str]:
    """The id of each row by its files."""
    return {row["file"]: row["id"] for row in list_folder(folder)[1]}


def notes(folder: Path) -> str:
    return " ".join(row["note"] for row in list_folder(folder)[1])


def opened(folder: Path, **cells: str):
    """The stations of a folder as its catalogue, with these cells typed into every row, opens them."""
    _, made = list_folder(folder)
    (folder / "catalogue.csv").write_text(catalogue_text([row | cells for row in made]), encoding="utf-8")
    return [open_station(record) for record in load_catalogue(folder / "catalogue.csv")]


def test_one_name_of_an_event_two_years_apart_is_two_earthquakes(tmp_path: Path) -> None:
    peer(tmp_path, "a.AT2", "000", date="6/28/1966")
    peer(tmp_path, "b.AT2", "090", date="6/28/1968")
    assert len(rows(tmp_path)) == 2
    peer(tmp_path, "b.AT2", "090", date="6/28/1966")
    assert rows(tmp_path) == {"a.AT2;b.AT2": "Quake_Here"}


@pytest.mark.parametrize("other", [{"place": "There"}, {"date": "1/2/1997"}])
def test_the_number_in_a_name_does_not_overrule_the_header(tmp_path: Path, other: dict[str, str]) -> None:
    peer(tmp_path, "RSN7_Q_A000.AT2", "000")
    peer(tmp_path, "RSN7_Q_A090.AT2", "090", **other)
    assert len(rows(tmp_path)) == 2
    peer(tmp_path, "RSN7_Q_A090.AT2", "090")
    assert list(rows(tmp_path).values()) == ["RSN7_Quake_Here"]
    peer(tmp_path, "RSN8_Q_A090.AT2", "090")
    (tmp_path / "RSN7_Q_A090.AT2").unlink()
    assert len(rows(tmp_path)) == 2


@pytest.mark.parametrize(("names", "is_told"), [
    (("L", "N"), True), (("FN", "000"), True), (("HN1", "HNE"), True), (("L", "T"), False), (("FN", "FP"), False),
    (("LONG", "TRAN"), False), (("HN1", "HN2"), False), (("000", "090"), False), (("X", "Y"), False),
])  # fmt: skip
def test_an_angle_that_nobody_knows_is_told(tmp_path: Path, names: tuple[str, str], is_told: bool) -> None:
    for name in names:
        peer(tmp_path, f"a_{name}.AT2", name)
    assert len(rows(tmp_path)) == 1
    told = RockingWarning.of(RecordKind.ANGLE_UNKNOWN, first=min(names), second=max(names))
    assert (str(told) in notes(tmp_path)) == is_told
    (station,) = opened(tmp_path)
    for channel in station.horizontal:
        assert (RecordKind.ANGLE_UNKNOWN in {warning.kind for warning in channel.warnings}) == is_told


def test_components_of_unlike_length_are_joined_from_the_first_sample(tmp_path: Path) -> None:
    for component, size in (("000", 3944), ("090", 4000), ("UP", 3999)):
        peer(tmp_path, f"RSN9_A{component}.AT2", component, size)
    assert len(rows(tmp_path)) == 1
    (station,) = opened(tmp_path)
    one, two = station.horizontal
    assert one.acceleration.size == two.acceleration.size == station.vertical.acceleration.size == 3944
    assert (
        two.acceleration == pytest.approx(FACTORS["090"] * 9.80665 * VALUES[:3944], abs=1e-5)
        and not one.processing
    )
    assert two.processing[-1].startswith(
        "The last 56 samples left out: the station's shortest file holds 3944"
    )


def test_peer_components_of_unlike_length_are_one_record_and_reported(tmp_path: Path) -> None:
    """Of Erzincan 1992 one component is 106 samples of 4262 longer, .53 s, and its shaking comes later by so much."""
    for name, component, size in (("a", "000", 3700), ("b", "090", 4000), ("v", "UP", 3800)):
        peer(tmp_path, f"{name}.AT2", component, size)
    assert list(rows(tmp_path)) == ["a.AT2;b.AT2;v.AT2"]
    (station,) = opened(tmp_path)
    for channel in (*station.horizontal, station.vertical):
        assert channel.acceleration.size == 3700
        assert (
            RockingWarning.of(RecordKind.LENGTHS_UNLIKE, least=3700, most=4000, apart_s=1.5)
            in channel.warnings
        )


def test_what_lacks_the_end_of_the_shaking_is_no_component_of_the_same_record(tmp_path: Path) -> None:
    peer(tmp_path, "a.AT2", "000", 2500)
    peer(tmp_path, "b.AT2", "090", 4000)
    assert len(rows(tmp_path)) == 2 and "they hold 2500 and 4000 samples" in notes(tmp_path)


def test_tables_of_unlike_length_may_lack_their_beginning(tmp_path: Path) -> None:
    bare(tmp_path, "a_NS.csv", 1.0, "time (s),acceleration (g)\n", 3700)
    bare(tmp_path, "a_EW.csv", 0.9, "time (s),acceleration (g)\n", 4000)
    assert len(rows(tmp_path)) == 2


@pytest.mark.parametrize("ends", [
    ("000.csv", "090.csv"), ("N26W.time_g.csv", "N64E.time_g.csv"), ("-NS.txt", "-EW.txt"), ("_n.csv", "_e.csv"),
    ("_0.csv", "_90.csv"), (".HNE.csv", ".HNN.csv"), ("350.txt", "080.txt"),
])  # fmt: skip
@pytest.mark.parametrize("heading", ["", "time (s),acceleration (g)\n"])
def test_pairs_whose_direction_only_the_name_says(
    tmp_path: Path, ends: tuple[str, str], heading: str
) -> None:
    for factor, end in enumerate(ends, 1):
        bare(tmp_path, f"RSN779_LOMAP_LGP{end}", factor, heading)
    assert list(rows(tmp_path).values()) == ["RSN779_LOMAP_LGP"]
    (station,) = opened(tmp_path, unit="g")
    angles = [channel.azimuth for channel in station.horizontal]
    assert None not in angles and abs(angles[0] - angles[1]) % 180 == 90
    factors = {round(c.acceleration[500] / (9.80665 * VALUES[500])) for c in station.horizontal}
    assert factors == {1, 2}


def test_a_vertical_by_its_name_acts_upwards(tmp_path: Path) -> None:
    for factor, end in enumerate(("000", "090", "-UP"), 1):
        bare(tmp_path, f"ELC{end}.csv", factor)
    (station,) = opened(tmp_path, unit="g")
    assert len(station.horizontal) == 2 and station.vertical.component == "UP"
    kinds = {warning.kind for file in catalogue_of_folder(tmp_path).files for warning in warnings_of(file)}
    assert not kinds & {RecordKind.DIRECTION_UNKNOWN, RecordKind.DIRECTION_IN_NAME}


def test_a_warning_of_some_channels_names_them() -> None:
    """A warning that names what it is about is left as it is, and so is one of all channels."""
    of_two = RockingWarning.of(RecordKind.PEAK_RARE, peak_g=4.0)
    of_all = RockingWarning.of(RecordKind.HALF_REPEATED, samples=3)
    named = RockingWarning(RecordKind.LONE_MAY_BE_VERTICAL, "A")
    channels = [
        rocking.Accelerogram(VALUES, 0.01, name, warnings=(*own, of_all))
        for name, own in (("A", (of_two, named)), ("B", (of_two,)), ("C", ()))
    ]
    assert set(reading_of(channels).warnings) == {replace(of_two, about="A, B"), of_all, named}


@pytest.mark.parametrize("names", [
    ("gm_001", "gm_091", "gm_181"),  # a suite by number
    ("gm_001", "gm_002"), ("gm_10", "gm_55"), ("a000", "b090"), ("quake_2016", "quake_2106"), ("one", "two"),
])  # fmt: skip
def test_numbers_at_the_end_of_a_name_are_no_azimuths_unless_they_are_square(
    tmp_path: Path, names: tuple[str, ...]
) -> None:
    for factor, name in enumerate(names, 1):
        bare(tmp_path, f"{name}.csv", factor)
    assert len(rows(tmp_path)) == len(names)


def test_one_odd_file_parts_no_other(tmp_path: Path) -> None:
    """Another band, a second vertical, a file of another step, one that names no direction."""
    for component in ("HNN", "HNE", "BNN"):
        peer(tmp_path, f"s.{component}.AT2", component)
    assert list(rows(tmp_path)) == ["s.BNN.AT2", "s.HNE.AT2;s.HNN.AT2"]
    for name in ("HNZ", "V"):
        peer(tmp_path, f"s.{name}.AT2", name)
    peer(tmp_path, "s.AT2", "no direction at all")
    text = (tmp_path / "s.BNN.AT2").read_text().replace("BNN", "000").replace(".005", ".010")
    (tmp_path / "s.000.AT2").write_text(text)
    joined = [files for files in rows(tmp_path) if ";" in files]
    assert joined == ["s.HNE.AT2;s.HNN.AT2;s.HNZ.AT2"]


def test_of_three_horizontal_components_the_two_at_a_right_angle_are_the_pair(tmp_path: Path) -> None:
    for component in ("000", "045", "090"):
        peer(tmp_path, f"{component}.AT2", component)
    assert set(rows(tmp_path)) == {"000.AT2;090.AT2", "045.AT2"}
    listed, (pair, _) = list_folder(tmp_path)
    assert f"Joined:\n  {pair['id']}: 000.AT2, 090.AT2\n\n" in listing_text(listed)


def test_where_two_pairs_could_be_meant_none_is(tmp_path: Path) -> None:
    for name, component in (("a", "000"), ("b", "090"), ("c", "090")):
        peer(tmp_path, f"{name}.AT2", component, 4000 - (name == "c"))
    assert len(rows(tmp_path)) == 3 and "component 90 occurs 2 times" in notes(tmp_path).replace("090", "90")


def test_pairs_whose_unit_is_typed_later_are_one_row_from_the_start(tmp_path: Path) -> None:
    """Counts are far beyond what ground does in any unit that is likely."""
    for factor, end in ((4e6, "000"), (9e3, "090")):
        bare(tmp_path, f"counts_{end}.csv", factor)
    listed, made = list_folder(tmp_path)
    assert [row["file"] for row in made] == ["counts_000.csv;counts_090.csv"]
    assert {file.blanks for file in listed} == {("unit",)} and "Fill in unit." in made[0]["note"]
    (station,) = opened(tmp_path, unit="um/s2")
    assert len(station.horizontal) == 2


def test_files_of_which_one_declares_its_unit_are_no_pair(tmp_path: Path) -> None:
    bare(tmp_path, "a_000.csv", 1.3, "time (s),acc (g)\n")
    bare(tmp_path, "a_090.csv", 1.4)
    listed, made = list_folder(tmp_path, unit="g")
    assert len(made) == 2
    assert {file.separation for file in listed} == {RockingWarning(RecordKind.DECLARED_BY_SOME)}


def test_the_names_of_a_row_are_those_of_files_that_give_none(tmp_path: Path) -> None:
    bare(tmp_path, "a.csv", 1, "time (s),acc (g)\n")
    bare(tmp_path, "b.csv", 2, "time (s),acc (g)\n")
    station = open_station(CatalogueRecord("r", "a.csv;b.csv", component="N30W;N60E", folder=tmp_path))
    assert [channel.azimuth for channel in station.horizontal] == [330.0, 60.0]


@pytest.mark.parametrize(("name", "found"), [
    ("RSN8064_CCHURCH_CCCCN26W.time_g.csv", ("RSN8064_CCHURCH_CCCC", "N26W")),
    ("RSN6_IMPVALL.I_I-ELC180.time_g.csv", ("RSN6_IMPVALL.I_I-ELC", "180")),
    ("sample_UD.txt", ("sample", "UD")), ("elcentroNS.dat", ("elcentro", "NS")), ("record_2016.csv", ("", "")),
    ("series_999.csv", ("", "")), ("HNE.csv", ("", "")), ("stone.csv", ("", "")), ("a_361.csv", ("", "")),
])  # fmt: skip
def test_the_direction_at_the_end_of_a_name(name: str, found: tuple[str, str]) -> None:
    assert direction_in_name(name) == found
