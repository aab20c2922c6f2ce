"""Formats that obspy opens for us: miniSEED with StationXML, SAC, EVT; directions, and the obspy plug-ins."""

import dataclasses
import io
import os
from importlib.metadata import entry_points
from pathlib import Path

import numpy as np
import obspy
import pytest
from obspy import Stream, Trace, UTCDateTime, read_inventory
from obspy import read as obspy_read
from obspy.core.util.base import get_example_file

import rocking
from rocking.catalogue import load_catalogue
from rocking.errors import RecordError, RockingError, UndeclaredError
from rocking.records import Accelerogram, read
from rocking.records.direction import Direction
from rocking.records.formats import FORMATS
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning
from tests.folders import list_folder
from tests.refusals import refused

PLUGINS = {form.plugin for form in FORMATS if form.plugin}

XML = """<?xml version="1.0" encoding="UTF-8"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1"><Source>made</Source>
<Created>2020-01-01T00:00:00</Created><Network code="XX"><Station code="MADE">
<Latitude>1</Latitude><Longitude>2</Longitude><Elevation>0</Elevation><Site><Name>Made</Name></Site>
<Channel code="HNE" locationCode="" startDate="2000-01-01T00:00:00"><Latitude>1</Latitude><Longitude>2</Longitude>
<Elevation>0</Elevation><Depth>0</Depth><Azimuth>72</Azimuth><Dip>0</Dip><SampleRate>100</SampleRate>
<Response><InstrumentSensitivity><Value>200000</Value><Frequency>1</Frequency><InputUnits><Name>{units}</Name></InputUnits>
<OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity><Stage number="1"><PolesZeros>
<InputUnits><Name>{units}</Name></InputUnits><OutputUnits><Name>COUNTS</Name></OutputUnits>
<PzTransferFunctionType>LAPLACE (RADIANS/SECOND)</PzTransferFunctionType>
<NormalizationFactor>1</NormalizationFactor><NormalizationFrequency>1</NormalizationFrequency></PolesZeros>
<StageGain><Value>200000</Value><Frequency>1</Frequency></StageGain></Stage></Response></Channel></Station></Network>
</FDSNStationXML>"""

EXAMPLES = Path(obspy.__path__[0]) / "io/xseed/tests/data"
COUNTS = np.round(1e5 * np.sin(np.arange(4000) / 30) * np.hanning(4000)).astype(np.int32) + 777


NAMES = {"network": "XX", "station": "MADE", "delta": 0.01, "starttime": UTCDateTime("2020-01-01T00:00:10.5")}


def trace(values: np.ndarray = COUNTS, channel: str = "HNE") -> Trace:
    return Trace(values, NAMES | {"channel": channel})


@pytest.fixture
def miniseed(tmp_path: Path) -> Path:
    trace().write(str(tmp_path / "record.mseed"), format="MSEED")
    return tmp_path / "record.mseed"


def test_counts_are_divided_by_the_sensitivity_found_beside_them(miniseed: Path) -> None:
    (miniseed.parent / "other.xml").write_text("<xml/>")
    (miniseed.parent / "station.xml").write_text(XML.format(units="M/S**2"))
    (record,) = read(miniseed)
    assert np.allclose(record.acceleration, (COUNTS - COUNTS.mean()) / 200000, atol=1e-12)
    assert (record.component, record.azimuth, record.network, record.station) == ("HNE", 72.0, "XX", "MADE")
    assert "overall sensitivity 200000" in record.processing[0] and record.start_time.startswith("2020-01-01")


def test_the_full_response_is_removed_to_acceleration(miniseed: Path) -> None:
    """A flat accelerometer gives the same either way; a velocity meter's counts are differentiated."""
    flat = miniseed.parent / "station.xml"
    flat.write_text(XML.format(units="M/S**2"))
    (by_sensitivity,), (full,) = read(miniseed), read(miniseed, response="full")
    middle = slice(500, 3500)
    # the band's lower edge, 0.05 Hz, is a tenth of the signal's 0.53 Hz
    assert np.abs(full.acceleration - by_sensitivity.acceleration)[middle].max() < 0.01
    flat.write_text(XML.format(units="M/S"))
    (differentiated,) = read(miniseed)
    assert "full instrument response" in differentiated.processing[0]
    expected = np.gradient(COUNTS / 200000, 0.01)
    assert np.abs(differentiated.acceleration - expected)[middle].max() < 0.02 * np.abs(expected).max()


def test_counts_without_an_instrument_are_refused(miniseed: Path) -> None:
    trace(COUNTS // 1000).write(str(miniseed), format="MSEED")
    with refused(RecordError, "unit"):
        read(miniseed)
    assert read(miniseed, unit="gal")[0].source.unit == "gal"
    for name in ("a.xml", "b.xml"):
        (miniseed.parent / name).write_text(XML.format(units="M/S**2"))
    with refused(RecordError, "unit"):
        read(miniseed)
    assert read(miniseed, inventory=miniseed.parent / "a.xml")[0].azimuth == 72


def test_counts_of_sac_are_divided_as_those_of_miniseed_are(tmp_path: Path) -> None:
    counts = trace(COUNTS.astype(np.float32))
    counts.write(str(tmp_path / "record.sac"), format="SAC")
    with refused(RecordError, "unit"):
        read(tmp_path / "record.sac")
    with refused(RecordError, "peak", "peak acceleration is 101.921 g"):
        read(tmp_path / "record.sac", unit="cm/s2")
    (tmp_path / "station.xml").write_text(XML.format(units="M/S**2"))
    (record,) = read(tmp_path / "record.sac")
    assert np.allclose(record.acceleration, (COUNTS - COUNTS.mean()) / 200000, atol=1e-7)
    assert record.azimuth == 72 and record.processed is False
    assert read(tmp_path / "record.sac", unit="nm/s2")[0].source.unit == "nm/s2"


def test_a_folder_of_counts_hears_that_its_stationxml_is_missing(miniseed: Path) -> None:
    trace(COUNTS.astype(np.float32)).write(str(miniseed.parent / "record.sac"), format="SAC")
    files = list_folder(miniseed.parent)[0]
    assert len(files) == 2  # miniSEED and SAC
    for file in files:
        assert RockingWarning(RecordKind.COUNTS_WITHOUT_UNIT) in file.warnings
    (miniseed.parent / "station.xml").write_text(XML.format(units="M/S**2"))
    assert [file.warnings for file in list_folder(miniseed.parent)[0]][:2] == [(), ()]


def test_what_the_c_library_says_of_a_response_is_a_warning_of_the_record(miniseed: Path, capfd) -> None:
    """The gain of a velocity meter with poles at 1 rad/s holds at its own frequency only."""
    poles = "".join(
        f'<Pole number="{n}"><Real>-0.7</Real><Imaginary>{sign}0.7</Imaginary></Pole>'
        for n, sign in ((0, ""), (1, "-"))
    )
    xml = XML.format(units="M/S**2").replace("</PolesZeros>", poles + "</PolesZeros>")
    (miniseed.parent / "station.xml").write_text(xml.replace("<Frequency>1<", "<Frequency>0.01<", 1))
    (record,) = read(miniseed, response="full")
    assert RecordKind.SENSITIVITY_UNLIKE_STAGES in {warning.kind for warning in record.warnings}
    os.write(2, b"heard again")
    printed = capfd.readouterr()
    assert "sensitivities" not in printed.err + printed.out and printed.err.endswith("heard again")


@pytest.mark.parametrize(("xml", "value"), [
    ("", "given.xml"), ("<FDSNStationXML", "given.xml"), ("<!DOCTYPE x><FDSNStationXML/>", "given.xml"),
    (XML.format(units="M/S**2").replace("2000-01-01", "2030-01-01"), "XX.MADE..HNE"),
])  # fmt: skip
def test_inventories_that_do_not_serve(miniseed: Path, xml: str, value: str) -> None:
    path = miniseed.parent / "given.xml"
    path.write_text(xml)
    with refused(RecordError, "inventory", value):
        read(miniseed, inventory=path)


def test_obspys_own_records() -> None:
    """AKT013: the header of the file states 4.383 gal. STNA: 63 365 counts of 2.5 V / 2.5025 V/g / 2²³."""
    (akita,) = read(get_example_file("test.knet"))
    assert (akita.station, akita.component, akita.time_step) == ("AKT013", "E-W", 0.01)
    assert akita.peak_acceleration == pytest.approx(0.04383, abs=5e-6)
    assert akita.start_time == "1996-08-10T18:12:24Z"
    channels = read(get_example_file("STNA.20020722.044649.evt.gz"))
    assert [(c.component, c.vertical) for c in channels] == [("X", False), ("Y", False), ("Z", True)]
    stated = 63364.613 * 2.5 / 2.502500057 / 2**23 * 9.80665
    assert channels[0].peak_acceleration == pytest.approx(stated, rel=1e-6) and channels[0].time_step == 0.004


@pytest.mark.parametrize(("name", "degrees", "vertical"), [
    ("228", 228.0, False), ("360", 0.0, False), ("090", 90.0, False), ("N26W", 334.0, False), ("S62W", 242.0, False),
    ("N00E", 0.0, False), ("S10E", 170.0, False), ("E-W", 90.0, False), ("NS", 0.0, False), ("HNE", 90.0, False),
    ("HGZ", None, True), ("-UP", None, True), ("up", None, True), ("U-D", None, True), ("V", None, True),
    ("T3", None, False), ("Long", None, False), ("", None, False),
    ("400", None, True), ("401", None, False), ("HN1", None, False),
])  # fmt: skip
def test_directions(name: str, degrees: float | None, vertical: bool) -> None:
    assert (Direction.of(name).azimuth, Direction.of(name).vertical) == (degrees, vertical)


def test_every_plug_in_is_declared_and_refuses_quietly(tmp_path: Path) -> None:
    points = entry_points(group="obspy.plugin.waveform")
    assert {point.name for point in points if "rocking" in point.value} == PLUGINS
    rubbish = tmp_path / "rubbish"
    rubbish.write_bytes(b"\x1f\x8b\xff\x00nonsense")

    class Broken(io.RawIOBase):
        def read(self, *_: object) -> bytes:
            raise OSError("gone")

    for name in PLUGINS:
        group = entry_points(group=f"obspy.plugin.waveform.{name}")
        is_format = group["isFormat"].load()
        assert callable(group["readFormat"].load())
        for source in (str(rubbish), rubbish, io.BytesIO(b""), tmp_path / "none", Broken(), None, 7):
            assert is_format(source) is False


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to("/dev/zero")])
def test_an_input_that_is_no_file_is_refused_and_not_waited_for(miniseed: Path, make) -> None:
    """As record, as inventory, beside a record, and as catalogue."""
    path = miniseed.parent / "odd.xml"
    make(path)
    for reads in (lambda: read(path), lambda: read(miniseed, inventory=path), lambda: load_catalogue(path)):
        with refused(RockingError, "file", "odd.xml") as caught:
            reads()
        assert "\n" not in str(caught.value)
    with refused(RecordError, "unit"):
        read(miniseed)
    assert [file.file for file in list_folder(miniseed.parent)[0]] == ["record.mseed"]


def test_there_and_back_nothing_changes() -> None:
    rng = np.random.default_rng(3)
    stream = Stream([trace(rng.normal(size=200), channel) for channel in ("HNE", "HNN", "HNZ")])
    records = rocking.from_obspy(stream, unit="m/s2")
    assert [(r.component, r.azimuth, r.vertical) for r in records] == [
        ("HNE", 90.0, False), ("HNN", 0.0, False), ("HNZ", None, True),
    ]  # fmt: skip
    back = Stream([record.to_obspy() for record in records])
    for before, after in zip(stream, back, strict=True):
        assert np.array_equal(before.data, after.data) and before.id == after.id
        assert (before.stats.delta, before.stats.starttime) == (after.stats.delta, after.stats.starttime)
    for first, again in zip(records, rocking.from_obspy(back), strict=True):
        pairs = ((getattr(first, f.name), getattr(again, f.name)) for f in dataclasses.fields(first)[1:])
        assert all(one == other for one, other in pairs if not hasattr(one, "sha256"))
        assert first.sha256 == again.sha256


def test_what_a_stream_leaves_open_is_refused() -> None:
    values = np.sin(np.arange(50.0))
    late = trace(values)
    late.stats.starttime += 5
    counts = trace(values)
    counts.stats.response = object()
    for given, unit, field, value in (
        (trace(values), None, "unit", None),
        (Stream([trace(values), late]), "g", "channel", "XX.MADE..HNE"),
        (Stream(), "g", "stream", 0),
        (trace(values), "furlong", "unit", "furlong"),
    ):
        with refused(RecordError, field, value):
            rocking.from_obspy(given, unit=unit)


def inventory_of(**changed: str):
    """The StationXML with other texts in place of those that are named."""
    text = XML.format(units=changed.pop("units", "M/S**2"))
    for old, new in changed.items():
        before = {
            "dip": "<Dip>0<",
            "depth": "<Depth>0<",
            "gain": "<Value>200000</Value><Frequency>1</Frequency><Input",
        }
        after = {"dip": f"<Dip>{new}<", "depth": f"<Depth>{new}<"}
        after["gain"] = f"<Value>{new}</Value><Frequency>1</Frequency><Input"
        text = text.replace(before[old], after[old])
    return read_inventory(io.BytesIO(text.encode()), format="STATIONXML")


def with_response(samples: np.ndarray) -> Stream:
    """A trace to which the response of its instrument is attached."""
    one = trace(samples)
    one.stats.response = inventory_of().get_response(one.id, one.stats.starttime)
    return Stream([one])


def test_a_unit_that_is_given_wins_over_a_response() -> None:
    stream = with_response(COUNTS / 1e4)
    (record,) = rocking.from_obspy(stream, unit="cm/s2")
    assert record.peak_acceleration == pytest.approx(np.abs(COUNTS).max() / 1e6)


def test_samples_whose_response_was_removed_are_not_divided_again() -> None:
    stream = with_response(COUNTS)
    removed = stream.copy().remove_response(output="ACC", water_level=None, pre_filt=(0.02, 0.05, 40, 45))
    (record,) = rocking.from_obspy(removed)
    assert np.allclose(record.acceleration, removed[0].data)
    (same,) = rocking.from_obspy(removed, unit="m/s2")
    assert np.array_equal(same.acceleration, record.acceleration)
    for velocity in (
        stream.copy().remove_response(output="VEL", water_level=None, pre_filt=(0.02, 0.05, 40, 45)),
        removed.copy().integrate(),
    ):
        for unit in (None, "m/s2"):
            with refused(RecordError, "quantity", "velocity"):
                rocking.from_obspy(velocity, unit=unit)
    (again,) = rocking.from_obspy(removed.copy().integrate().differentiate())
    assert again.acceleration.size == record.acceleration.size


def test_what_a_rotation_made_untrue_is_not_believed() -> None:
    pair = [
        Accelerogram(item, 0.01, name) for item, name in zip(np.eye(2, 60) + 0.1, ("HNN", "HNE"), strict=True)
    ]
    turned = Stream([component.to_obspy() for component in pair]).rotate("NE->RT", back_azimuth=30.0)
    records = rocking.from_obspy(turned)
    assert len(records) == 2
    for record in records:
        assert record.component in ("HNR", "HNT") and record.azimuth is None


def test_a_stream_passes_the_checks_of_a_file() -> None:
    for samples, field in ((COUNTS * 1.0, "peak"), (np.zeros(4_000_001), "samples")):
        with refused(RecordError, field):
            rocking.from_obspy(trace(samples), unit="m/s2")
    calibrated = trace(COUNTS / 1e5)
    calibrated.stats.calib = 2.0
    with refused(UndeclaredError, "calibration"):
        rocking.from_obspy(calibrated, unit="m/s2")
    for calibration, factor in (("apply", 2), ("done", 1)):
        (record,) = rocking.from_obspy(calibrated, unit="m/s2", calibration=calibration)
        assert record.peak_acceleration == pytest.approx(factor * np.abs(COUNTS).max() / 1e5)
    with refused(RecordError, "calibration", True):
        rocking.from_obspy(calibrated, unit="m/s2", calibration=True)
    numbered = Stream([trace(COUNTS / (1e5 + n), channel=str(n)) for n in range(3)])
    for record in rocking.from_obspy(numbered, unit="m/s2"):
        assert record.azimuth is None and record.component.startswith("channel ")


def test_dip_and_depth_say_what_is_vertical_and_what_is_down_hole() -> None:
    (record,) = rocking.from_obspy(trace(), inventory_of(dip="-90", depth="156"))
    assert record.vertical and record.borehole and not record.is_horizontal
    (record,) = rocking.from_obspy(trace(), inventory_of(depth="1.5"))
    assert record.is_horizontal and record.azimuth == 72.0


@pytest.mark.parametrize(
    ("units", "factor"), [("NM/S**2", 1e-9), ("cm/s**2", 1e-2), ("G", 9.80665), ("M/S/S", 1.0)]
)
def test_the_input_unit_of_an_instrument_is_read_by_its_factor(units: str, factor: float) -> None:
    samples = COUNTS / COUNTS.max() / factor * 200000
    (record,) = rocking.from_obspy(trace(samples), inventory_of(units=units))
    assert record.peak_acceleration == pytest.approx(np.abs(samples - samples.mean()).max() * factor / 200000)


@pytest.mark.parametrize(
    ("changed", "named"),
    [
        ({"units": "V"}, ("quantity", "V")),
        ({"gain": "INF"}, ("sensitivity",)),
        ({"gain": "1e300"}, ("sensitivity", 1e300)),
        ({"gain": "0"}, ("sensitivity", 0.0)),
        ({"gain": "230000"}, ("sensitivity",)),
    ],
)
def test_a_response_that_is_none_is_refused(changed: dict[str, str], named: tuple) -> None:
    with refused(RecordError, *named):
        rocking.from_obspy(trace(), inventory_of(**changed))


def test_a_sensitivity_at_another_frequency_than_its_stages_is_told() -> None:
    """A seismometer's falls off between the two; at the same frequency the two contradict each other."""
    text = XML.format(units="M/S**2").replace("<Value>200000</Value><Frequency>1</Frequency><Input",
                                              "<Value>230000</Value><Frequency>5</Frequency><Input")  # fmt: skip
    inventory = read_inventory(io.BytesIO(text.encode()), format="STATIONXML")
    (record,) = rocking.from_obspy(trace(), inventory)
    assert np.allclose(record.acceleration, (COUNTS - COUNTS.mean()) / 230000, atol=1e-12)
    assert [warning.kind for warning in record.warnings] == [RecordKind.SENSITIVITY_ELSEWHERE]


def test_the_full_removal_asks_the_stages_alone() -> None:
    """The stated sensitivity, 15 % off, takes no part in it."""
    (record,) = rocking.from_obspy(trace(), inventory_of(gain="230000"), response="full")
    (right,) = rocking.from_obspy(trace(), inventory_of(), response="full")
    assert np.allclose(record.acceleration, right.acceleration, atol=1e-9)


def test_a_direction_that_nobody_states_is_told() -> None:
    (record,) = rocking.from_obspy(trace(COUNTS / 1e5, channel="QQX"), unit="m/s2")
    assert RockingWarning(RecordKind.LONE_MAY_BE_VERTICAL, "QQX") in record.warnings


@pytest.mark.real_records
def test_a_stored_answer_of_a_data_centre_reads_as_its_files_do(real_records: Path) -> None:
    folder = real_records / "formats_mseed_stationxml"
    files = sorted(folder.glob("*.mseed"))
    stream = sum((obspy_read(str(file), format="MSEED") for file in files), Stream())
    inventory = read_inventory(str(folder / "CI.CLC.xml"), format="STATIONXML")
    found = rocking.from_obspy(stream, inventory)
    assert [r.sha256 for r in found] == [read(file)[0].sha256 for file in files]
    for item in stream:
        item.stats.response = inventory.get_response(item.id, item.stats.starttime)
    divided = rocking.from_obspy(stream.remove_sensitivity())
    for one, record in zip(divided, found, strict=True):
        assert np.allclose(one.acceleration, record.acceleration, rtol=0, atol=1e-9)


@pytest.mark.real_records
def test_obspy_reads_our_text_formats(real_records: Path) -> None:
    assert len(PLUGINS) == 14
    for file in ("formats_peer_at2/NIS090.AT2", "formats_smc/0111a.smc", "formats_bhrc/5529-1.V1"):
        stream, records = obspy_read(str(real_records / file)), read(real_records / file)
        for one, record in zip(stream, records, strict=True):
            assert np.array_equal(one.data, record.acceleration)
            assert one.stats.delta == record.time_step


@pytest.mark.parametrize("samples", [
    np.ma.masked_array([1.0, 2.0, 3.0], [0, 1, 0]), np.array([1j, 2]), np.array([True, False]), np.array(["1", "2"]),
    np.array([[1.0, 2.0]]), np.array([1.0, np.nan]), [1.0],
])  # fmt: skip
def test_an_array_that_is_no_accelerogram_is_refused(samples) -> None:
    """The gaps of a masked array became samples."""
    with refused(RecordError, "acceleration"):
        Accelerogram(samples, 0.01)


@pytest.mark.parametrize("name", ["a\0b", "\u202egnp.exe", "\udce9", "two\nlines"])
def test_names_that_cannot_be_printed_are_refused(name: str) -> None:
    with refused(RecordError, "station"):
        Accelerogram(np.arange(3.0), 0.01, station=name)


@pytest.mark.parametrize(("file", "channel"), [
    ("dataless.seed.BW_FURT", "BW.FURT..EHZ"), ("RESP.BW.FURT..EHZ", "BW.FURT..EHZ"),
    ("dataless.seed.BW_MANZ", "BW.MANZ..EHZ"),
])  # fmt: skip
def test_an_inventory_may_be_dataless_seed_or_resp(tmp_path: Path, file: str, channel: str) -> None:
    """The full response of the same file is what obspy itself removes by it."""
    described = EXAMPLES / file
    network, station, _, code = channel.split(".")
    counts = Trace(COUNTS, NAMES | {"network": network, "station": station, "channel": code})
    counts.stats.starttime = UTCDateTime("2010-01-01")
    counts.write(str(tmp_path / "record.mseed"), format="MSEED")
    (record,) = read(tmp_path / "record.mseed", inventory=described, response="full")
    (same,) = rocking.from_obspy(counts, read_inventory(str(described)), response="full")
    assert np.array_equal(record.acceleration, same.acceleration) and record.peak_acceleration > 0


@pytest.mark.parametrize("text", ["* ****\nZEROS 3\nPOLES 5\n", "nothing", "<FDSNStationXML><!DOCTYPE x>"])
def test_what_is_no_inventory_is_named_with_what_may_be_given(miniseed: Path, text: str) -> None:
    (miniseed.parent / "SAC_PZs").write_text(text)
    with refused(RecordError, "inventory", "SAC_PZs") as error:
        read(miniseed, inventory=miniseed.parent / "SAC_PZs")
    assert "dataless SEED" in str(error.value) and ("poles and zeros" in str(error.value)) == (
        "ZEROS" in text
    )


@pytest.mark.parametrize("form", ["MSEED", "SAC"])
def test_a_unit_next_to_an_inventory_is_refused(tmp_path: Path, form: str) -> None:
    """The one says that the samples are acceleration, the other that they are counts; either won, unsaid."""
    trace().write(str(tmp_path / "record"), format=form)
    (tmp_path / "given.xml").write_text(XML.format(units="M/S**2"))
    with refused(RecordError, "unit", "cm/s2"):
        read(tmp_path / "record", unit="cm/s2", inventory=tmp_path / "given.xml")
    (tmp_path / "made_vel").write_bytes((tmp_path / "record").read_bytes())
    with refused(RecordError, "unit"):
        read(tmp_path / "made_vel")
