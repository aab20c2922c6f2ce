"""Where a component points: the words of many agencies and offices, each with what it can only mean."""

from dataclasses import dataclass

import pytest

from rocking.records.claims import direction_in_name
from rocking.records.direction import Direction, directed, pair_warning, warnings_of_channel
from rocking.records.kinds import RecordKind


@dataclass(frozen=True)
class Channel:
    """A channel by what is known of it."""

    component: str
    azimuth: float | None = None
    vertical: bool = False


@pytest.mark.parametrize("name", [
    "+V", "-V", "V+", "+UP", "Ver.", "ver", "L Z", "Düşey", "Dikey", "U_D", "V", "U-D", "HNZ", "-Up", "BHZ00", "HNZ.00",
    "HNZ--", "Z--", "VRT", "V1", "UPP", "UPWD", "DWN1", "Vertical Up", "hnz 10", "Vert up", "VERT1", "-Z", "UP 1",
    "Vertical (up)", "UD2", "Upwards", "HNZ_20",
])  # fmt: skip
def test_verticals(name: str) -> None:
    assert Direction.of(name) == Direction(vertical=True)


@pytest.mark.parametrize(("name", "along"), [
    ("E-O", 90.0), ("Kuzey-Güney", 0.0), ("D-B", 90.0),
    ("EO", 90.0), ("Oeste", 270.0), ("N90O", 270.0), ("S14O", 194.0), ("N45O", 315.0), ("Az 90", 90.0),
    ("AZ=135", 135.0), ("azimuth: 270", 270.0), ("N120", 120.0), ("S E", 90.0), ("S N", 0.0), ("N05", None),
    ("BH210", None), ("HNE.00", 90.0), ("BHN00", 0.0), ("V90", None), ("HNR", None), ("WE", 90.0), ("UPLAND", None),
    ("X", None),
])  # fmt: skip
def test_azimuths(name: str, along: float | None) -> None:
    """O is oeste; a bearing counts from its pole to its side: S14O is 180 + 14. "N05" is the number of a station."""
    assert Direction.of(name).azimuth == along and not Direction.of(name).vertical


@pytest.mark.parametrize(("name", "axis"), [
    ("L", "L"), ("--L", "L"), ("-T1", "T"), ("T2", "T"), ("Long.", "L"), ("Radial", "R"), ("H1", "H1"), ("HN2", "2"),
    ("FN", "FN"), ("LOMA", ""), ("", ""),
])  # fmt: skip
def test_axes_whose_azimuth_is_not_known(name: str, axis: str) -> None:
    found = Direction.of(name)
    assert (found.relative, found.is_known) == (axis, False)


@pytest.mark.parametrize(("first", "second", "across"), [
    ("L", "T", True), ("--L", "-T1", True), ("H1", "H2", True), ("HN1", "HN2", True), ("FN", "FP", True),
    ("L", "N", False), ("L", "L1", False), ("H1", "T", False), ("channel 1", "L", False), ("T", "channel 2", False),
])  # fmt: skip
def test_a_pair_at_right_angles_by_what_its_names_mean(first: str, second: str, across: bool) -> None:
    pair = Channel(first), Channel(second)
    assert all(warnings_of_channel(component) == () for component in pair)
    warning = pair_warning(pair)
    assert warning is None if across else warning is not None and warning.kind is RecordKind.ANGLE_UNKNOWN


def test_a_pair_of_columns_without_names_is_not_doubted() -> None:
    """Neither says anything that could contradict their being a pair; one name beside none does (above)."""
    assert pair_warning((Channel("acc"), Channel("channel 2"))) is None


def test_what_is_said_first_counts() -> None:
    """The reader's header, then the name of the component, then that of the file, then the row."""
    assert directed({"component": "HNE", "azimuth": 92.0}) == {
        "component": "HNE",
        "azimuth": 92.0,
        "vertical": False,
    }
    assert directed({"component": "HNE", "vertical": True})["azimuth"] is None


@pytest.mark.parametrize(("file", "found"), [
    ("H-E12140.AT2", ("H-E12", "140")), ("C02090.txt", ("C02", "090")), ("site_N90O.csv", ("site", "N90O")),
    ("TCU052E.txt", ("TCU052", "E")), ("TCU052V.txt", ("TCU052", "V")), ("EQ1_V+.txt", ("EQ1", "V+")),
    ("rec20161113.csv", ("", "")), ("motion000123.txt", ("", "")), ("ELC-EO.txt", ("ELC", "EO")),
])  # fmt: skip
def test_the_end_of_a_file_s_name(file: str, found: tuple[str, str]) -> None:
    """Three digits stand behind the two of a station; a longer number is a date, or counts files."""
    assert direction_in_name(file) == found
