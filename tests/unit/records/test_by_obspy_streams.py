"""Streams of obspy: what lets their channels be none of one record, and what their responses leave open."""

import io
from pathlib import Path

import numpy as np
import pytest
from obspy import Stream, Trace, UTCDateTime, read, read_inventory
from obspy.core.inventory import Comment, Inventory, Network

import rocking
from rocking.errors import RecordError
from rocking.records.kinds import RecordKind
from rocking.warnings import Kind
from tests.refusals import refused
from tests.unit.records.test_instruments import XML

COUNTS = np.round(1e5 * np.sin(np.arange(3000) / 30) * np.hanning(3000))


def trace(channel: str = "HNE", station: str = "MADE", delta: float = 0.01) -> Trace:
    return Trace(COUNTS.copy(), {"network": "XX", "station": station, "channel": channel, "delta": delta})


def inventory(units: str = "M/S**2", dip: float = 0.0):
    """A StationXML whose response is a sensitivity of 200 000 without stages."""
    text = f"""<?xml version="1.0" encoding="UTF-8"?>
<FDSNStationXML xmlns="http://www.fdsn.org/xml/station/1" schemaVersion="1.1"><Source>made</Source>
<Created>2020-01-01T00:00:00</Created><Network code="XX"><Station code="MADE">
<Latitude>1</Latitude><Longitude>2</Longitude><Elevation>0</Elevation><Site><Name>Made</Name></Site>
<Channel code="HNE" locationCode="" startDate="1960-01-01T00:00:00"><Latitude>1</Latitude><Longitude>2</Longitude>
<Elevation>0</Elevation><Depth>0</Depth><Azimuth>90</Azimuth><Dip>{dip}</Dip><SampleRate>100</SampleRate>
<Response><InstrumentSensitivity><Value>200000</Value><Frequency>1</Frequency><InputUnits><Name>{units}</Name></InputUnits>
<OutputUnits><Name>COUNTS</Name></OutputUnits></InstrumentSensitivity></Response></Channel></Station></Network>
</FDSNStationXML>"""
    return read_inventory(io.BytesIO(text.encode()), format="STATIONXML")


@pytest.mark.parametrize(("other", "kind"), [
    (trace("HNN", "ELSE"), RecordKind.STATIONS_UNLIKE), (trace("HNN", delta=0.02), RecordKind.STEPS_OF_STREAM_UNLIKE),
    (trace("HNN"), None),
])  # fmt: skip
def test_channels_of_unlike_stations_or_steps_are_told(other: Trace, kind: Kind | None) -> None:
    records = rocking.from_obspy(Stream([trace(), other]), unit="nm/s2")
    unlike = {RecordKind.STATIONS_UNLIKE, RecordKind.STEPS_OF_STREAM_UNLIKE}
    told = [{warning.kind for warning in record.warnings} & unlike for record in records]
    assert told == [{kind} if kind else set()] * 2


def test_pieces_of_a_channel_with_unlike_rates_are_refused() -> None:
    later = trace(delta=0.02)
    later.stats.starttime += 30
    with refused(RecordError, "channel", "Sampling rate differs: 100.0 vs 50.0"):
        rocking.from_obspy(Stream([trace(), later]), unit="nm/s2")


def test_a_gap_is_refused_with_its_time() -> None:
    first, later = trace(), trace()
    later.stats.starttime += 40
    with refused(RecordError, "channel", first.id) as caught:
        rocking.from_obspy(Stream([first, later]), unit="nm/s2")
    assert "has a gap at 30 s" in str(caught.value)


def test_a_sensitivity_without_stages_turns_counts_into_the_motion_in_its_units() -> None:
    """Of a seismometer the velocity is differentiated, by central differences."""
    of_velocity = (COUNTS - COUNTS.mean()) / 200000
    for units, motion in (
        ("M/S**2", of_velocity),
        ("M/S", np.gradient(of_velocity, 0.01)),
        ("CM/S**2", of_velocity / 100),
    ):
        (record,) = rocking.from_obspy(trace(), inventory=inventory(units))
        assert record.acceleration == pytest.approx(motion, abs=1e-12)
        with refused(RecordError, "response", "stages"):
            rocking.from_obspy(trace(), inventory=inventory(units), response="full")
    in_gal = read_inventory(io.BytesIO(XML.format(units="CM/S**2").encode()), format="STATIONXML")
    later = trace()
    later.stats.starttime = UTCDateTime(2020, 1, 1)
    with refused(RecordError, "response", "CM/S**2"):
        rocking.from_obspy(later, inventory=in_gal, response="full")


@pytest.mark.parametrize(("units", "field"), [("M/S**2", ""), ("M/S", "quantity"), ("V", "unit")])
def test_removing_the_sensitivity_leaves_the_unit_that_the_response_states(units: str, field: str) -> None:
    """As remove_sensitivity leaves a trace: divided, with the offset of the recorder, and its response attached."""
    done = trace()
    done.data += 5000
    done.stats.response = inventory(units).get_response(done.id, done.stats.starttime)
    done.stats.processing = ["ObsPy 1.5.1: remove_sensitivity()"]
    done.data = done.data / 200000
    if field:
        with refused(RecordError, field):
            rocking.from_obspy(done)
    else:
        (record,) = rocking.from_obspy(done)
        assert np.allclose(record.acceleration, (COUNTS - COUNTS.mean()) / 200000, rtol=0, atol=1e-12)
        assert record.processed is False and record.processing[-1].startswith(
            "Mean of the whole record removed, 0.0249"
        )


@pytest.mark.parametrize(("dip", "is_told", "vertical"), [
    (0.0, False, False), (-4.0, False, False), (12.0, True, False), (-80.0, True, True), (-88.0, False, True),
])  # fmt: skip
def test_a_tilted_sensor_is_told(dip: float, is_told: bool, vertical: bool) -> None:
    (record,) = rocking.from_obspy(trace(), inventory(dip=dip))
    assert record.vertical == vertical
    assert (RecordKind.TILTED in {warning.kind for warning in record.warnings}) == is_told


def test_a_response_without_stages_is_not_removed_in_full() -> None:
    with refused(RecordError, "response", "stages"):
        rocking.from_obspy(trace(), inventory(), response="full")


def described_twice(change: str, new: str, ends: str = "") -> Inventory:
    """The StationXML with a second epoch of the channel since 1990, of which one word is another."""
    station = inventory()[0][0]
    later = inventory()[0][0].channels[0]
    later.start_date = UTCDateTime(1965, 1, 1)
    if change == "gain":
        later.response.instrument_sensitivity.value = float(new)
    else:
        later.azimuth = float(new)
    if ends:
        station.channels[0].end_date = UTCDateTime(ends)
    station.channels.append(later)
    return Inventory([Network("XX", [station])])


@pytest.mark.filterwarnings("ignore:Found more than one matching response")
@pytest.mark.parametrize(("change", "new"), [("gain", "500000"), ("azimuth", "0")])
def test_epochs_that_overlap_and_differ_are_refused_with_both(change: str, new: str) -> None:
    """The first one was taken, unsaid: by a gain 2.5 times the true one."""
    with refused(RecordError, "inventory") as caught:
        rocking.from_obspy(trace(), described_twice(change, new))
    assert all(words in str(caught.value) for words in ("200000 counts", "(from 1960", "(from 1965"))
    (record,) = rocking.from_obspy(trace(), described_twice(change, new, ends="1964-12-31"))
    (same,) = rocking.from_obspy(trace(), described_twice("gain", "200000"))
    per_unit = 500000 if change == "gain" else 200000
    assert np.allclose(record.acceleration, (COUNTS - COUNTS.mean()) / per_unit, rtol=0, atol=1e-12)
    assert (record.azimuth, same.azimuth) == (0 if change == "azimuth" else 90, 90)


@pytest.mark.parametrize(("old", "new"), [
    ("<PolesZeros>\n<InputUnits><Name>M/S**2", "<PolesZeros>\n<InputUnits><Name>M/S"),
    ("<Name>COUNTS</Name></OutputUnits></Inst", "<Name>V</Name></OutputUnits></Inst"),
])  # fmt: skip
def test_a_sensitivity_that_its_first_stage_or_the_counts_contradict_is_refused(old: str, new: str) -> None:
    """The one led to a motion of another order, and the other left out the gain of the recorder, both unsaid."""
    text = XML.format(units="M/S**2")
    assert old in text
    described = read_inventory(io.BytesIO(text.replace(old, new).encode()), format="STATIONXML")
    late = trace()
    late.stats.starttime = UTCDateTime(2020, 1, 1)
    with refused(RecordError, "inventory"):
        rocking.from_obspy(late, described)


def test_the_rate_of_a_stationxml_is_held_against_that_of_the_samples() -> None:
    for rate, is_told in ((100.0, False), (200.0, True)):
        described = inventory()
        described[0][0][0].sample_rate = rate
        (record,) = rocking.from_obspy(trace(), described)
        assert (RecordKind.RATE_UNLIKE_STEP in {warning.kind for warning in record.warnings}) == is_told
        assert record.time_step == 0.01


@pytest.mark.parametrize(("note", "dip", "azimuth"), [
    ("Sensor azimuth unverified", 0.0, None), ("orientación desconocida", 0.0, None),
    ("Sensor orientation not known", 0.0, None), ("Unknown orientation", 0.0, None),
    ("Orientation checked in 1999", 0.0, 90.0), ("Sensor orientation not known", -90.0, 90.0),
])  # fmt: skip
def test_an_orientation_that_nobody_knows_is_no_azimuth(note: str, dip: float, azimuth: float | None) -> None:
    described = inventory(dip=dip)
    described[0][0][0].comments = [Comment(note)]
    (record,) = rocking.from_obspy(trace(), described)
    assert record.azimuth == (None if record.vertical else azimuth) and record.vertical == (dip != 0)
    is_told = RecordKind.ORIENTATION_UNKNOWN in {warning.kind for warning in record.warnings}
    assert is_told == (azimuth is None)


def test_pieces_whose_rates_differ_by_their_rounding_are_one_channel() -> None:
    first, second = trace(), trace()
    second.stats.starttime += 30
    second.stats.sampling_rate = 99.9999
    (record,) = rocking.from_obspy(Stream([first, second]), unit="nm/s2")
    assert record.acceleration.size == 6000 and record.time_step == 0.01
    assert second.stats.sampling_rate == 99.9999  # that of the caller


def test_a_channel_without_a_rate_is_refused(tmp_path: Path) -> None:
    """As of a log that a recorder writes into its miniSEED."""
    log = Trace(COUNTS.copy(), {"sampling_rate": 0.0, "channel": "LOG"})
    log.write(str(tmp_path / "log.mseed"), format="MSEED")
    with pytest.raises(RecordError, match=r"^log\.mseed: "):
        rocking.read(tmp_path / "log.mseed", unit="m/s2")


def test_a_log_of_text_next_to_the_channels_is_passed_over() -> None:
    header = {"network": "XX", "station": "MADE", "channel": "LOG"}
    log = Trace(np.frombuffer(b"clock locked", dtype="S1").copy(), header)
    (record,) = rocking.from_obspy(Stream([log, trace()]), unit="nm/s2")
    assert record.component == "HNE"
    with refused(RecordError, "channel", log.id):
        rocking.from_obspy(Stream([log]), unit="nm/s2")


def test_a_sac_file_ends_where_its_header_says() -> None:
    """As the file was written, and not once it is cut, which leaves the header as it was."""
    content = io.BytesIO()
    trace().write(content, format="SAC")
    content.seek(0)
    stream = read(content, format="SAC")
    assert len(rocking.from_obspy(stream, unit="um/s2")) == 1
    stream[0].stats.sac.e += 1.0
    with refused(RecordError, "e"):
        rocking.from_obspy(stream, unit="um/s2")
    stream.trim(stream[0].stats.starttime + 1)
    assert len(rocking.from_obspy(stream, unit="um/s2")) == 1
