"""What each format's header says beside the numbers: names, directions, corner, earthquake, state of processing."""

import re
from typing import Any

import made_files
import numpy as np
import obspy
import pytest
from made_files import MADE, MADE_BINARY, content_of, format_of, read_text

from rocking.errors import RecordError
from rocking.records.formats import Options, by_obspy
from rocking.records.formats.format import Layout, keyed, universal
from rocking.records.kinds import RecordKind
from rocking.records.read import read_content
from rocking.warnings import RockingWarning
from tests.refusals import refused

FIELDS = ("component", "azimuth", "station", "network", "event", "processed", "high_pass_frequency")
SAID: dict[str, list[tuple[Any, ...]]] = {
    "PEER AT2": [("45", 45.0, "Station", "", "Quake", True, None)],
    "PEER AT2: of 2008": [("45", 45.0, "Station", "", "Quake", True, None)],
    "COSMOS V1/V2": [("45", 45.0, "CE-J1", "", "Some Day", True, 0.3)],
    "CSMIP V1/V2": [("45", 45.0, "89146", "", "", True, 0.3)],
    "CSMIP V1/V2: of 1983": [("45", 45.0, "36456", "", "MADE EARTHQUAKE", True, 0.05)],
    "CSMIP V1/V2: raw": [("45", 45.0, "", "", "MADE EARTHQUAKE", False, None)],
    "CSMIP V1/V2: film": [("45", 45.0, "", "", "MADE EARTHQUAKE", False, None)],
    "USGS SMC": [("45", 45.0, "Made", "", "Quake", True, 0.1)],
    "USC Volume 1": [("N45E", 45.0, "", "", "QUAKE", False, None)],
    "USC Volume 2": [("N45E", 45.0, "USC# 0061", "", "MADE EARTHQUAKE", True, 0.225)],
    "RENADIC": [("EW", 90.0, "", "", "", False, None)],
    "BHRC": [("L1", 45.0, "1", "", "", False, None)],
    "K-NET/KiK-net": [("E-W", 90.0, "MADE01", "BO", "2018-01-24T19:51:00+09:00", False, None)],
    "DYNA (ESM, ITACA, AFAD)": [("HNE", 90.0, "X", "", "MADE", True, 0.1)],
    "DYNA (ESM, ITACA, AFAD): filtered anew": [("HNE", 90.0, "X", "", "MADE", True, 0.025)],
    "JMA CSV": [
        (*case, "9CFMADE", "JMA", "", False, None) for case in (("NS", 0.0), ("EW", 90.0), ("UD", None))
    ],
    "EMOD3D text": [("090", 90.0, "MADE", "", "", None, None)],
    "AFAD/NSMN text": [
        (*one_case, "0921", "TK", "", False, None)
        for one_case in (("N-S", 0.0), ("E-W", 90.0), ("U-D", None))
    ],
    "ESD": [("NS", 0.0, "694", "", "990", True, 0.25)],
    "RESORCE": [("NS", 0.0, "", "", "2009-04-06T01:32:39", True, 0.1)],
    "GeoNet V1A/V2A": [("N45E", 45.0, "WTMC", "NZ", "", False, None)],
    "UNAM/CICESE": [("N45E", 45.0, "ACAC", "", "", False, None), ("V", None, "ACAC", "", "", False, None)],
    "CWB": [("U", None, "EAS", "TW", "", False, None), ("N", 0.0, "EAS", "TW", "", False, None)],
    "CSMNC": [("EW", 90.0, "65JZC", "", "QUAKE", False, None)],
    "columns of numbers: titled": [("channel 1", None, "", "", "made", None, None)],
    "columns of numbers: two headers": [
        ("channel 1", None, "", "", "Kobe 000, acceleration in g", None, None)
    ],
    "columns of numbers": [("NS", 0.0, "", "", "", None, None), ("EW", 90.0, "", "", "", None, None)],
    "miniSEED": [("HNE", 90.0, "MADE", "XX", "", False, None)],
    "SAC": [("HNE", 90.0, "MADE", "XX", "", False, None)],
    "ASDF station": [("HNE", 90.0, "MADE", "NZ", "us1", True, 0.1)],
    "GSE": [("HNE", 90.0, "MADE", "XX", "", False, None)],
    "SLIST or TSPAIR": [("HNE", 90.0, "MADE", "XX", "", False, None)],
    "SLIST or TSPAIR: pairs": [("HNE", 90.0, "MADE", "XX", "", False, None)],
    "Kinemetrics EVT": [("X", None, "MADE", "", "2011-09-09", False, None)],
}
"""By hand from the text of each made file; the two of UNAM that differ in their lines of numbers say the same."""
VERTICAL = {"U-D", "V", "U", "UD"}


def test_every_format_has_its_header_here() -> None:
    assert {format_of(name) for name in SAID} == {format_of(name) for name in MADE | MADE_BINARY}


@pytest.mark.parametrize("name", SAID)
def test_what_a_header_says(name: str) -> None:
    records = read_content(content_of(name), "made", (MADE | MADE_BINARY)[name][2])
    assert [tuple(getattr(record, field) for field in FIELDS) for record in records] == SAID[name]
    assert [record.vertical for record in records] == [record.component in VERTICAL for record in records]
    assert {record.source.format for record in records} == {format_of(name)}


@pytest.mark.parametrize("dash", ["\N{MINUS SIGN}", "\N{EN DASH}"])
@pytest.mark.parametrize("name", sorted(set(MADE) - {"columns of numbers: two headers"}))
def test_a_dash_of_typography_before_a_number_is_refused_by_name(name: str, dash: str) -> None:
    """The file with two headers is then of no known format."""
    before, after = re.split(r"-(?=[\d.])(?!.*-[\d.])", content_of(name).decode("latin-1"), flags=re.S)
    with refused(RecordError, "samples"):
        read_content(f"{before}{dash}{after}".encode(), "made", MADE[name][2])


def test_a_pattern_of_a_fact_that_no_header_states_is_refused() -> None:
    with pytest.raises(ValueError, match="peka"):
        Layout("cm/s2", keyed(peka="PGA", samples="NDATA"))


@pytest.mark.parametrize(("line", "corner"), [
    ("HP=0.13 HZ, LP=40.0 HZ", 0.13), ("HP= 1 HZ", 1.0), ("HP= 0.0 HZ", None), ("HP=0.1.2 HZ", None),
    ("FILTER POINTS: HP=. HZ", None), ("4 POLE @ 30. HZ LOW, 4 POLE @ .15 HZ HIGH", 0.15),
    ("4 POLE @ 30. HZ LOW, 0 POLE @ .15 HZ HIGH", None), ("4 POLE @ 30. HZ", None), ("", None),
])  # fmt: skip
def test_the_corner_that_a_peer_header_tells(line: str, corner: float | None) -> None:
    (record,) = read_text(made_files.peer().replace("NPTS=", f"{line}\nNPTS=" if line else "NPTS="))
    assert record.high_pass_frequency == corner


@pytest.mark.parametrize(("title", "component"), [
    (", " + "C" * 16, "C" * 16), (", " + "C" * 17, "channel 1"), (" TRANSVERSE COMP", "Transverse"),
])  # fmt: skip
def test_the_component_in_the_title_of_a_peer_file(title: str, component: str) -> None:
    (record,) = read_text(made_files.peer().replace(", 45\n", f"{title}\n"))
    assert record.component == component


@pytest.mark.parametrize(("rows", "warned"), [(4, True), (3, False)])
def test_a_number_cut_short_is_seen_beside_two_whole_ones(rows: int, warned: bool) -> None:
    """The first of the lines looked at may itself be cut, by the looking."""
    lines = [f"{i * 0.01:.2f} {0.1 + i * 0.01:.6f}" for i in range(rows)]
    found = read_text("\n".join(lines)[:-2], unit="g")
    assert (RecordKind.NUMBER_CUT in {warning.kind for warning in found[0].warnings}) == warned


def test_unam_columns_are_ten_wide_where_the_header_names_no_width() -> None:
    """Of ten digits each, so that they touch."""
    head, rule, rows = MADE["UNAM/CICESE"][0]().rpartition(f"{'-' * 79}\n")
    full = "".join(f"{float(row[:10]):10.6f}{float(row[10:]):10.6f}\n" for row in rows.splitlines())
    assert re.search(r"\d-\d", full)
    text = f"{head}{rule}{full}"
    (plain, _), (other, _) = (read_text(t) for t in (text, text.replace(": 2F10.4", ": libre")))
    assert (plain.acceleration == other.acceleration).all()


def test_the_seventh_channel_of_cicese_has_the_first_header_of_the_second_block() -> None:
    """Six of the first channel, in its digits and directions of their own, and the second channel as the seventh."""
    text = MADE["UNAM/CICESE"][0]()
    blocks = re.sub(
        r"(.*)C1-C6(.*?: )/(.*)/(.*)\n", r"\1C1-C6\2" + r"/\3" * 6 + "\n" + r"\1C7-C12\2/\4\n", text
    )
    names = [f"N{angle}E" for angle in (10, 20, 30, 40, 50, 60)]
    head, rule, rows = blocks.replace("/N45E" * 6, f"/{'/'.join(names)}").rpartition(f"{'-' * 79}\n")
    wide = "".join(row[:10] * 6 + row[10:] + "\n" for row in rows.splitlines())
    found = read_text(f"{head.replace('2F10.4', '7F10.4')}{rule}{wide}")
    assert [record.component for record in found] == [*names, "V"]
    assert 2 * found[-1].acceleration == pytest.approx(found[0].acceleration, abs=2e-6)


def test_the_third_of_three_channels_of_a_recorder_is_vertical_by_its_place(monkeypatch) -> None:
    """A second instrument on the same recorder begins again with X."""
    header = {"delta": 0.01, "station": "MADE", "kinemetrics_evt": {}, "_format": "KINEMETRICS_EVT"}
    traces = [obspy.Trace(np.arange(9.0), header | {"channel": str(place)}) for place in range(6)]
    monkeypatch.setattr(by_obspy, "_stream", lambda *_, **__: (traces, ()))
    records = by_obspy.EVT.read(b"", Options())
    assert [(r.component, r.vertical) for r in records] == 2 * [("X", False), ("Y", False), ("Z", True)]


@pytest.mark.parametrize(("labels", "components"), [
    ("/N90E;/V;+", ["N90E", "V"]), ("/N45E;L/V;", ["N45E", "V"]), ("/;N45E/;V", ["N45E", "V"]),
])  # fmt: skip
def test_bearing_and_sense_of_a_cicese_channel_are_told_apart(labels: str, components: list[str]) -> None:
    """The vertical was taken as a horizontal component by the name of its sense, +."""
    found = read_text(MADE["UNAM/CICESE"][0]().replace("/N45E/V\n", f"{labels}\n"))
    assert [record.component for record in found] == components
    assert [record.vertical for record in found] == [False, True]


def test_times_of_jma_and_afad_are_utc() -> None:
    assert {record.start_time for record in read_text(MADE["JMA CSV"][0]())} == {"2016-04-14T12:26:20Z"}
    (record,) = read_text(MADE["DYNA (ESM, ITACA, AFAD): filtered anew"][0]())
    assert record.start_time == "2023-02-06T01:17:07.332030Z"
    times = ("2018/13/24 19:51:43", "0001/01/01 00:00:00", "2018/01/24 19:51:43.5")
    assert [universal(time, 9.0) for time in times] == ["", "", "2018-01-24T10:51:43.500000Z"]


def test_the_origin_of_an_earthquake_comes_before_the_time_of_a_record() -> None:
    times = "Rcrd of Tue Aug 28, 2018 19:33:00.0 PDT\nCSMIP Processing   (Origin: 8/29/18, 02:33:28.0 UTC)\nStation No."
    (record,) = read_text(MADE["CSMIP V1/V2"][0]().replace("Station No.", times))
    assert (record.event_time, record.event) == ("2018-08-29T02:33:28Z", "2018-08-28T19:33:00-07:00")


def test_names_of_columns_are_components_without_their_unit() -> None:
    text = made_files.table().replace("time,acc_NS(m/s2),acc_EW(m/s2)", "time [s];a_N10E [g];quake [cm/s^2]")
    one, two = read_text(text.replace(",", ";"))
    assert (one.component, one.azimuth, one.source.unit) == ("N10E", 10.0, "g")
    assert (two.component, two.source.unit) == ("quake", "cm/s2")
    assert one.peak_acceleration == pytest.approx(2 * 9.80665 / 0.01 * two.peak_acceleration / 4, rel=1e-6)


@pytest.mark.parametrize(
    ("spelt", "magnitude", "scale"),
    [
        ("M  4.09", 4.09, "M"),
        ("ML    5.10", 5.1, "ML"),
        ("Mw 7.82", 7.82, "Mw"),
        ("Mb  5.2", 5.2, "mb"),
        ("", None, ""),
    ],
)
def test_the_magnitude_of_geonet(spelt: str, magnitude: float | None, scale: str) -> None:
    epicentre = f"Epicentre  42 41 33S 173 01 19E  Bearing S18W  Dist    9km  Depth   15km {spelt}\n"
    (record,) = read_text(made_files.geonet().replace("x\n", epicentre, 1))
    assert (record.magnitude, record.magnitude_type) == (magnitude, scale)
    assert record.epicentral_distance == 9000


@pytest.mark.parametrize(("orientation", "along"), [("WE", 90.0), ("NS", 0.0), ("N26W", 334.0)])
def test_the_orientation_of_resorce(orientation: str, along: float) -> None:
    text = made_files.resorce().replace(": NS", f": {orientation}")
    assert read_text(text)[0].azimuth == along


@pytest.mark.parametrize(
    "coordinates",
    [": 31.868 LAT. N\n                                       : 116.664 LONG. W",
     ": 31.868 LAT. N.\n:116.664 LONG. O.", ": 31.868 N, 116.664 W\n", ": 31.868 Lat. Norte\n : 116.664 Long. Oeste"],
)  # fmt: skip
def test_the_place_of_a_station_of_cicese(coordinates: str) -> None:
    key = "COORDENADAS DE LA ESTACION             "
    text = made_files.unam().replace("ORIENTACION C1", f"{key}{coordinates}\nORIENTACION C1", 1)
    assert (read_text(text)[0].latitude, read_text(text)[0].longitude) == (31.868, -116.664)


@pytest.mark.parametrize(
    "key", ["Station No. 89146", "Station Id. 89146", "STATION ID: 89146", "Station Id 89146"]
)
def test_the_station_of_csmip(key: str) -> None:
    (record,) = read_text(made_files.csmip().replace("Station No. 89146", key))
    assert (record.station, record.latitude, record.longitude) == ("89146", 40.9, -123.6)


@pytest.mark.parametrize("line", ["QDR S/N 673", "SMA-1 S/N AA6D", "S/N 673"])
def test_the_instrument_names_a_station_of_renadic(line: str) -> None:
    text = made_files.renadic().replace("RENADIC\nx\n", f"RENADIC\n{line}\n", 1)
    assert read_text(text)[0].station == line


@pytest.mark.parametrize(("printed", "warnings"), [
    ("100.000", ()), ("****.**", (RockingWarning.of(RecordKind.RATE_NO_NUMBER, rate="****.**"),)),
    ("101.000", (RockingWarning.of(RecordKind.RATE_UNLIKE_STEP, rate_hz=101.0, time_step_s=0.01),)),
])  # fmt: skip
def test_the_step_of_bhrc_is_that_of_its_duration_and_its_rate_only_warns(
    printed: str, warnings: tuple[RockingWarning, ...]
) -> None:
    (record,) = read_text(made_files.bhrc().replace("100.000", printed))
    assert (record.time_step, record.warnings) == (0.01, warnings)


@pytest.mark.parametrize(
    ("place", "is_buried"),
    [("Downhole", True), ("Depth 30 m", True), ("-156 m", True), ("Downhole: 100 ft", True), ("Downhole: 2 m", False),
     ("Free Field", False), ("Depth 0 m", False), ("Basement", False)],
)  # fmt: skip
def test_a_channel_down_hole_is_no_motion_of_the_surface(place: str, is_buried: bool) -> None:
    (record,) = read_text(made_files.cosmos().replace("Location:\n", f"Location: {place}\n"))
    assert record.borehole is is_buried and record.is_horizontal is not is_buried


def test_a_station_of_peer_down_hole_is_no_motion_of_the_surface() -> None:
    (record,) = read_text(made_files.peer().replace("Station, 45", "Array (Downhole 90 m), 45"))
    assert record.borehole and RecordKind.DOWN_HOLE in {warning.kind for warning in record.warnings}


@pytest.mark.parametrize(
    ("unit", "step"), [("SEC", 0.01), ("MSEC", 1e-5), ("ms", 1e-5), ("Milliseconds", 1e-5)]
)
def test_the_step_of_peer_in_milliseconds(unit: str, step: float) -> None:
    assert read_text(made_files.peer().replace(" SEC", f" {unit}"))[0].time_step == pytest.approx(step)


@pytest.mark.parametrize(
    ("code", "vertical"), [("400", True), ("500", True), ("600", True), ("360", False), ("700", False)]
)
def test_codes_above_360_are_no_angles(code: str, vertical: bool) -> None:
    (record,) = read_text(made_files.smc().replace("component=     45", f"component=     {code}"))
    assert record.vertical is vertical and record.azimuth == (0.0 if code == "360" else None)
    kinds = {warning.kind for warning in record.warnings}
    assert (kinds == {RecordKind.DIRECTION_UNKNOWN}) is (code == "700")


@pytest.mark.parametrize(
    ("code", "told"),
    [
        ("HJ1", RockingWarning.of(RecordKind.CHANNEL_NO_MOTION, "HJ1", sensor="rotational sensor")),
        ("BDF", RockingWarning.of(RecordKind.CHANNEL_NO_MOTION, "BDF", sensor="pressure sensor")),
        ("HHE", RockingWarning.of(RecordKind.CHANNEL_OF_VELOCITY, "HHE", sensor="high-gain seismometer")),
        ("HNE", None),
    ],
)
def test_the_code_of_a_channel_says_what_it_measures(code: str, told: RockingWarning | None) -> None:
    (record,) = read_text(made_files.dyna().replace("HNE", code))
    assert told in record.warnings if told else not record.warnings


def test_text_with_names_and_units_below_a_header_of_a_network_is_the_networks() -> None:
    (record, *_) = read_text(made_files.jma().replace("gal(cm/s/s)", "gal"))
    assert record.source.format == "JMA CSV"


def test_a_file_of_the_european_database_holds_velocity_beside_acceleration() -> None:
    velocity = "-> corrected velocity time histories\n" + made_files.columns(made_files.TRUE, 8, "13.5E")
    (record,) = read_text(made_files.esd() + velocity + "STOP\n")
    assert record.acceleration.size == made_files.N
    assert record.start_time == "1999-12-31T04:55:53.671000Z"
    kinds = {warning.kind for warning in record.warnings}
    assert kinds & {RecordKind.VELOCITY_UNLIKE, RecordKind.VELOCITY_UNLIKE_THERE}


@pytest.mark.parametrize("kind", ["uncorrected acceleration", "corrected velocity"])
def test_another_series_of_the_european_database_is_refused_by_name(kind: str) -> None:
    other = made_files.esd().replace("corrected acceleration", kind)
    with refused(RecordError, "quantity"):
        read_text(other)
