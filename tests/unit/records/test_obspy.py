"""obspy as a door: streams become accelerograms and come back, our text formats are read by obspy."""

import dataclasses
from pathlib import Path

import numpy as np
import pytest
from obspy import Stream, Trace, UTCDateTime, read_inventory
from obspy import read as obspy_read

from rocking.errors import RecordError
from rocking.records import Accelerogram, read
from rocking.records.obspy_plugin import PLUGINS

START = UTCDateTime("2020-01-01T00:00:10.5")
NAMES = {"network": "XX", "station": "MADE", "location": "00", "delta": 0.01, "starttime": START}


def trace(channel: str, values: np.ndarray) -> Trace:
    return Trace(values, NAMES | {"channel": channel})


def test_there_and_back_nothing_changes() -> None:
    rng = np.random.default_rng(3)
    stream = Stream([trace(channel, rng.normal(size=200)) for channel in ("HNE", "HNN", "HNZ")])
    records = Accelerogram.from_obspy(stream, unit="m/s2")
    assert [(r.component, r.azimuth, r.vertical) for r in records] == [
        ("HNE", 90.0, False), ("HNN", 0.0, False), ("HNZ", None, True),
    ]  # fmt: skip
    back = Stream([record.to_obspy() for record in records])
    for before, after in zip(stream, back, strict=True):
        assert np.array_equal(before.data, after.data) and before.id == after.id
        assert (before.stats.delta, before.stats.starttime) == (after.stats.delta, after.stats.starttime)
    for first, again in zip(records, Accelerogram.from_obspy(back), strict=True):
        pairs = ((getattr(first, f.name), getattr(again, f.name)) for f in dataclasses.fields(first)[1:])
        assert all(one == other for one, other in pairs if not hasattr(one, "sha256"))
        assert first.sha256 == again.sha256


def test_what_a_stream_leaves_open_is_refused() -> None:
    values = np.sin(np.arange(50.0))
    late = trace("HNE", values)
    late.stats.starttime += 5
    counts = trace("HNE", values)
    counts.stats.response = object()
    for given, unit, word in (
        (trace("HNE", values), None, "neither a unit nor a response"),
        (counts, "g", "both a unit and a response"),
        (Stream([trace("HNE", values), late]), "g", "has a gap at"),
        (Stream(), "g", "holds no trace"),
        (trace("HNE", values), "furlong", "unit is 'furlong'"),
    ):
        with pytest.raises(RecordError, match=word):
            Accelerogram.from_obspy(given, unit=unit)


@pytest.mark.real_records
def test_a_stored_answer_of_a_data_centre_reads_as_its_files_do(real_records: Path) -> None:
    folder = real_records / "formats_mseed_stationxml"
    files = sorted(folder.glob("*.mseed"))
    stream = sum((obspy_read(str(file), format="MSEED") for file in files), Stream())
    inventory = read_inventory(str(folder / "CI.CLC.xml"), format="STATIONXML")
    found = Accelerogram.from_obspy(stream, inventory)
    assert [r.sha256 for r in found] == [read(file)[0].sha256 for file in files]


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
    with pytest.raises(RecordError, match="sample"):
        Accelerogram(samples, 0.01)


@pytest.mark.parametrize("name", ["a\0b", "\u202egnp.exe", "\udce9", "two\nlines"])
def test_names_that_cannot_be_printed_are_refused(name: str) -> None:
    with pytest.raises(RecordError, match="printable"):
        Accelerogram(np.arange(3.0), 0.01, station=name)
