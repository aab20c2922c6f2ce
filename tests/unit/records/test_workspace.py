"""Workspaces of gmprocess: each station as gmprocess writes it, raw or processed by its label, and nothing outside."""

import io
import json
from pathlib import Path

import numpy as np
import obspy
import pytest
from obspy.core import inventory

import rocking
from rocking.catalogue import load_catalogue
from rocking.catalogue.catalogue import catalogue_text
from rocking.catalogue.station import open_station
from rocking.errors import RecordError, UndeclaredError
from rocking.records import read
from rocking.records.archive import members
from rocking.records.kinds import RecordKind
from rocking.records.obspy import workspace
from tests.contracts.made_files import STEP, TRUE
from tests.folders import list_folder
from tests.refusals import refused

h5py = pytest.importorskip("h5py")

EVENT = "us1000778i"
START = obspy.UTCDateTime(2016, 11, 13, 11, 3)
GAIN = 2e5
"""Counts per m/s²."""
QUAKEML = obspy.core.event.Catalog([
    obspy.core.event.Event(
        resource_id=f"smi:local/{EVENT}",
        origins=[obspy.core.event.Origin(time=START - 60, latitude=-42.7, longitude=173.0)],
        magnitudes=[obspy.core.event.Magnitude(mag=7.8, magnitude_type="Mww")],
    )
])  # fmt: skip


def stationxml(code: str, unit: str = "cm/s^2") -> bytes:
    """The StationXML of three channels as gmprocess makes it: an azimuth 0 where it knows none, no dip."""
    gain = inventory.InstrumentSensitivity(GAIN, 1.0, "M/S**2", "COUNTS")
    channels = [
        inventory.Channel(
            f"HN{end}", "20", -42.0, 173.0, 12.0, 0.0, azimuth=0.0, sample_rate=1 / STEP,
            calibration_units=unit, response=inventory.Response(instrument_sensitivity=gain),
        )
        for end in "ENZ"
    ]  # fmt: skip
    station = inventory.Station(code, -42.0, 173.0, 12.0, channels=channels)
    stream = io.BytesIO()
    inventory.Inventory([inventory.Network("NZ", [station])], source="made").write(
        stream, format="STATIONXML"
    )
    return stream.getvalue()


def provenance(*steps: tuple[str, str]) -> bytes:
    """The SEIS-PROV document of steps, each with the unit that it leaves, "" where it says none."""
    text = "<prov:document>"
    for number, (step, unit) in enumerate(steps, 1):
        left = f"<seis_prov:output_units>{unit}</seis_prov:output_units>" if unit else ""
        text += f'<prov:activity prov:id="seis_prov:sp{number:03d}_xx_0b1cd68">{step}{left}</prov:activity>'
    return f"{text}</prov:document>".encode()


PROCESSED = provenance(("Remove Response", "cm/s^2"), ("Highpass Filter", ""))


def add(file, *names: str, content: bytes) -> None:
    file["/".join(names)] = np.frombuffer(content, np.uint8)


def add_station(
    file, code: str, label: str, samples: np.ndarray, prov: bytes = b"", xml: bytes = b"", **noted
) -> None:
    """Add the three channels of a station: the east one `samples`, the north one half of them, the vertical a tenth."""
    group = f"Waveforms/NZ.{code}"
    tag = f"{EVENT}_{label}" if label != "raw_recording" else label
    for end, share in (("E", 1.0), ("N", 0.5), ("Z", 0.1)):
        nslct = f"NZ.{code}.20.HN{end}"
        series = f"{nslct}__2016-11-13T11:03:00__2016-11-13T11:03:01__{tag}"
        data = file.create_dataset(f"{group}/{series}", data=(share * samples).astype(samples.dtype))
        data.attrs["starttime"] = int(START.ns)
        data.attrs["sampling_rate"] = 1 / STEP
        if prov:
            add(file, "Provenance", f"{nslct}_{tag}", content=prov)
        if noted:
            place = ("AuxiliaryData", "TraceProcessingParameters", f"NZ.{code}", f"{nslct}_{tag}")
            add(file, *place, content=json.dumps(noted).encode())
    if f"{group}/StationXML" not in file:
        add(file, group, "StationXML", content=xml or stationxml(code))


COUNTS = np.round(GAIN * TRUE).astype(np.int32)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """A station raw and processed, and one that is raw alone."""
    with h5py.File(tmp_path / "workspace.h5", "w") as file:
        file.attrs["file_format"] = np.bytes_("ASDF")
        buffer = io.BytesIO()
        QUAKEML.write(buffer, format="QUAKEML")
        add(file, "QuakeML", content=buffer.getvalue())
        add_station(file, "HSES", "unprocessed", COUNTS)
        add_station(
            file,
            "HSES",
            "default",
            100 * TRUE,
            PROCESSED,
            corner_frequencies={"type": "snr", "highpass": 0.08},
        )
        add_station(file, "WTMC", "unprocessed", COUNTS)
    return tmp_path / "workspace.h5"


def test_a_station_is_read_processed_where_it_is_and_raw_elsewhere(path: Path) -> None:
    assert members(path) == (f"{EVENT}_default/NZ.HSES", f"{EVENT}_unprocessed/NZ.WTMC")
    records = read(path)
    assert [(record.station, record.component, record.processed) for record in records] == [
        (station, f"HN{end}", station == "HSES") for station in ("HSES", "WTMC") for end in "ENZ"
    ]
    assert [record.azimuth for record in records] == [90.0, 0.0, None] * 2
    assert [record.vertical for record in records] == [False, False, True] * 2
    processed, raw = records[0], records[3]
    assert processed.acceleration == pytest.approx(TRUE, abs=1e-12)
    assert raw.acceleration == pytest.approx(TRUE - TRUE.mean(), abs=1 / GAIN)
    assert processed.time_step == raw.time_step == STEP
    assert processed.high_pass_frequency == 0.08 and raw.high_pass_frequency is None
    for record in records:
        assert (record.event, record.magnitude, record.magnitude_type) == (EVENT, 7.8, "Mww")
        assert (record.network, record.location, record.latitude, record.elevation) == (
            "NZ",
            "20",
            -42.0,
            12.0,
        )
        assert record.start_time.startswith("2016-11-13T11:03:00")
        assert record.warnings == ()


def test_the_raw_motion_of_a_station_is_read_where_it_is_named(path: Path) -> None:
    east, *_ = read(path / f"{EVENT}_unprocessed" / "NZ.HSES")
    assert not east.processed
    assert east.acceleration == pytest.approx(TRUE - TRUE.mean(), abs=1 / GAIN)


def test_a_catalogue_has_a_row_a_station_and_a_study_opens_it(path: Path) -> None:
    listed, rows = list_folder(path.parent)
    assert [row["file"] for row in rows] == [f"workspace.h5/{name}" for name in members(path)]
    assert all(not file.refusal for file in listed)
    catalogue = path.parent / "catalogue.csv"
    catalogue.write_text(catalogue_text(rows), encoding="utf-8")
    for record in load_catalogue(catalogue):
        station = open_station(record)
        assert len(station.horizontal) == 2 and station.vertical is not None


def test_physical_units_under_the_raw_label_are_no_counts(path: Path) -> None:
    """As gmprocess keeps the files of K-NET: their provenance says the unit that they were read in."""
    with h5py.File(path, "a") as file:
        add_station(file, "KNET", "unprocessed", 100 * TRUE, provenance(("Remove Response", "cm/s^2")))
    east, *_ = read(path / f"{EVENT}_unprocessed" / "NZ.KNET")
    assert east.acceleration == pytest.approx(TRUE, abs=1e-12)
    assert not east.processed


def test_the_unit_of_processed_motion_without_provenance_is_that_of_its_stationxml(path: Path) -> None:
    with h5py.File(path, "a") as file:
        add_station(file, "BARE", "default", 100 * TRUE)
        add_station(file, "MUTE", "default", 100 * TRUE, xml=stationxml("MUTE", "acc"))
    assert read(path / f"{EVENT}_default" / "NZ.BARE")[0].acceleration == pytest.approx(TRUE, abs=1e-12)
    with refused(UndeclaredError, "unit"):
        read(path / f"{EVENT}_default" / "NZ.MUTE")
    east, *_ = read(path / f"{EVENT}_default" / "NZ.MUTE", unit="gal")
    assert east.acceleration == pytest.approx(TRUE, abs=1e-12)


def test_what_is_no_acceleration_or_of_another_unit_than_declared_is_refused(path: Path) -> None:
    with h5py.File(path, "a") as file:
        add_station(
            file,
            "VELO",
            "default",
            10 * TRUE,
            provenance(("Remove Response", "cm/s^2"), ("Integrate", "cm/s")),
        )
    with pytest.raises(RecordError):
        read(path / f"{EVENT}_default" / "NZ.VELO")
    with pytest.raises(RecordError):
        read(path / f"{EVENT}_default" / "NZ.HSES", unit="g")


def test_a_trace_that_gmprocess_rejects_says_so(path: Path) -> None:
    with h5py.File(path, "a") as file:
        add_station(
            file, "WEAK", "default", 100 * TRUE, PROCESSED, failure={"module": "snr", "reason": "Failed SNR"}
        )
    for record in read(path / f"{EVENT}_default" / "NZ.WEAK"):
        (warning,) = record.warnings
        assert warning.kind is RecordKind.FAILED_IN_GMPROCESS and warning["reason"] == "Failed SNR"


def test_notes_that_nobody_can_read_are_left_out_and_what_is_too_large_is_refused(
    path: Path, monkeypatch
) -> None:
    with h5py.File(path, "a") as file:
        add_station(file, "ODD", "default", 100 * TRUE, PROCESSED, corner_frequencies=3)
        file["QuakeML"][:9] = 0
        with refused(RecordError, "size"):
            workspace.station_content(file, f"{EVENT}_default/NZ.ODD", TRUE.nbytes)
    for record in read(path / f"{EVENT}_default" / "NZ.ODD"):
        assert (record.high_pass_frequency, record.event_time, record.magnitude) == (None, "", None)
    monkeypatch.setattr(workspace, "_LARGEST_TEXT", 5)
    with refused(RecordError, "size"):
        read(path / f"{EVENT}_default" / "NZ.HSES")


def test_a_workspace_without_labels_of_gmprocess_is_of_raw_counts(tmp_path: Path) -> None:
    """As pyasdf calls what data centres serve; and counts without a response are asked for it."""
    with h5py.File(tmp_path / "a.asdf", "w") as file:
        file.attrs["file_format"] = b"ASDF"
        add_station(file, "HSES", "raw_recording", COUNTS)
        add_station(file, "NONE", "raw_recording", COUNTS, xml=b"\0")
    (name, without) = members(tmp_path / "a.asdf")
    east, *_ = read(tmp_path / "a.asdf" / name)
    assert east.acceleration == pytest.approx(TRUE - TRUE.mean(), abs=1 / GAIN) and east.event == ""
    with pytest.raises(UndeclaredError):
        read(tmp_path / "a.asdf" / without)
    assert read(tmp_path / "a.asdf" / without, unit="nm/s2")


def test_links_and_samples_outside_are_not_followed(path: Path, tmp_path: Path) -> None:
    secret = tmp_path / "secret.h5"
    with h5py.File(secret, "w") as file:
        add_station(file, "HSES", "default", 100 * TRUE, PROCESSED)
    (tmp_path / "secret.bin").write_bytes(TRUE.tobytes())
    with h5py.File(path, "a") as file:
        file["Waveforms/NZ.LINK"] = h5py.ExternalLink(str(secret), "Waveforms/NZ.HSES")
        name = f"NZ.BULK.20.HNN__a__b__{EVENT}_default"
        outside = [(str(tmp_path / "secret.bin"), 0, TRUE.nbytes)]
        data = file.create_dataset(f"Waveforms/NZ.BULK/{name}", TRUE.shape, float, external=outside)
        data.attrs["starttime"], data.attrs["sampling_rate"] = int(START.ns), 1 / STEP
    assert not any("LINK" in name for name in members(path))
    with pytest.raises(RecordError):
        read(path / f"{EVENT}_default" / "NZ.BULK")
    assert len(read(path)) == 6  # it costs the others nothing


def test_hdf5_files_of_others_and_damaged_ones_are_refused(path: Path, tmp_path: Path) -> None:
    with h5py.File(tmp_path / "other.h5", "w") as file:
        file["x"] = TRUE
    (tmp_path / "cut.h5").write_bytes(path.read_bytes()[:5000])
    content = workspace.packed({"station": "A.B", "tag": "raw", "traces": []}, b"", b"1234")
    (tmp_path / "member").write_bytes(content[:-1])
    for name in ("other.h5", "cut.h5", "member"):
        with pytest.raises(RecordError):
            read(tmp_path / name)
    refusals = {file.file: bool(file.refusal) for file in list_folder(tmp_path)[0]}
    assert refusals["other.h5"] and refusals["cut.h5"]
    assert not refusals[f"workspace.h5/{EVENT}_default/NZ.HSES"]


def test_without_h5py_the_extra_is_named(path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "h5py", None)
    with refused(RecordError, "format", "HDF5"):
        rocking.read(path)
    (file,) = list_folder(path.parent)[0]
    assert "rocking[asdf]" in file.refusal


@pytest.mark.parametrize("ending", ["h5", "hdf5", "hdf", "asdf"])
def test_counts_under_a_tag_of_ones_own_are_read_by_the_response(tmp_path: Path, ending: str) -> None:
    """Whole numbers in no unit; numbers with decimals may be anything, and are asked for."""
    path = tmp_path / f"own.{ending}"
    with h5py.File(path, "w") as file:
        file.attrs["file_format"] = np.bytes_("ASDF")
        add_station(file, "HSES", "mine", COUNTS, xml=stationxml("HSES", ""))
        add_station(file, "WTMC", "mine", TRUE, xml=stationxml("WTMC", ""))
    east = read(path / f"{EVENT}_mine" / "NZ.HSES")[0]
    assert east.acceleration == pytest.approx(TRUE - TRUE.mean(), abs=1e-5) and not east.processed
    with refused(UndeclaredError, "unit"):
        read(path / f"{EVENT}_mine" / "NZ.WTMC")
