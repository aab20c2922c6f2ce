"""Workspaces of gmprocess: ASDF files (HDF5) of many stations, of which each is read as a file of an archive.

A member is called after the tag and the station, `us1000778i_default/NZ.HSES`; the tag is the earthquake and the label
of the processing. Its content is one station as it is in the workspace: samples, StationXML, and what gmprocess
noted of them.
"""

import json
import re
import struct
import warnings
import zlib
from base64 import b64decode, b64encode
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from io import BytesIO
from typing import Any

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import acceleration_unit
from rocking.records.doors import advice
from rocking.records.formats.format import Options
from rocking.records.kinds import RecordKind
from rocking.records.obspy.inventories import inventory_of, parsed_inventory
from rocking.records.obspy.one_trace import from_traces
from rocking.records.obspy.traces import joined
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

MARK = b"\x89HDF\r\n\x1a\n"
"""The begin of an HDF5 file."""
STATION = b"\0ASDF station\0"
"""The begin of the content of a member."""
_BEGIN = struct.Struct("<II")
"""Bytes of the facts, and the checksum of all that follows."""
_RAW_LABELS = "unprocessed", "raw", "raw_recording"
"""The labels of motion as it was fetched: of gmprocess, of its first versions, and of pyasdf."""
_LARGEST_TEXT = 2**25
"""Bytes of a StationXML, a QuakeML or a description of the processing."""
_TRACE = re.compile(r"([^.]*)\.([^.]*)\.([^.]*)\.(.*?)__(.*?)__(.*?)__(.+)")
"""Network, station, location, channel, start, end and tag, as ASDF names a series."""


def opened(source: str | BytesIO) -> Any:
    """Return the HDF5 file at a path, or of a content. Raises RecordError where it is no workspace that can be read."""
    try:
        import h5py  # of the extra `asdf`
    except ImportError:
        raise RecordError(
            "this is an HDF5 file, which a workspace of gmprocess (ASDF) is, and which h5py reads: pip install "
            "'rocking[asdf]'.",
            format="HDF5",
        ) from None
    file = h5py.File(source, "r")
    form = file.attrs.get("file_format", b"")
    if (form.decode("latin-1") if isinstance(form, bytes) else str(form)).strip("\0 ") != "ASDF":
        file.close()
        raise RecordError(
            "this is an HDF5 file, but no ASDF file as the workspaces of gmprocess are; export time and acceleration "
            "as text, with their units as names.",
            format="HDF5",
        )
    return file


def stations(file: Any) -> tuple[frozenset[str], frozenset[str]]:
    """Return the names of the members of a workspace, and of those whose raw motion is there processed as well."""
    names = set()
    for station in _group(file, "Waveforms"):
        for series in _group(file, "Waveforms", station):
            if match := _TRACE.fullmatch(series):
                names.add(f"{match[7]}/{station}")
    parted = {
        name: (_is_raw(tag), _event_of(tag), station) for name in names for tag, station in [name.split("/")]
    }
    corrected = {(event, station) for is_raw, event, station in parted.values() if not is_raw}
    passed_over = {name for name, (is_raw, *whose) in parted.items() if is_raw and tuple(whose) in corrected}
    return frozenset(names), frozenset(passed_over)


def station_content(file: Any, name: str, largest: int) -> bytes:
    """Return the content of the member `name`. Raises RecordError where it is larger than `largest` bytes."""
    tag, _, station = name.partition("/")
    size = 0
    traces = []
    samples = []
    for series in _group(file, "Waveforms", station):
        match = _TRACE.fullmatch(series)
        if match is None or match[7] != tag:
            continue
        data = _dataset(file, "Waveforms", station, series)
        size += data.size * data.dtype.itemsize
        if size > largest:
            raise RecordError(
                f"the station holds more than {largest} bytes, the most that is read; cut it first.",
                size=size,
            )
        code = f"{match[1]}.{match[2]}.{match[3]}.{match[4]}_{tag}"
        values = np.ascontiguousarray(data[()])
        samples.append(values.astype(values.dtype.newbyteorder("<")).tobytes())
        traces.append({
            "location": match[3], "channel": match[4], "start_ns": int(data.attrs["starttime"]),
            "rate_hz": float(data.attrs["sampling_rate"]), "type": values.dtype.newbyteorder("<").str,
            "samples": int(values.size), "unit": _unit_noted(_text(file, "Provenance", code)),
            **_noted(_text(file, "AuxiliaryData", "TraceProcessingParameters", station, code)),
        })  # fmt: skip
    event = _event_of(tag)
    facts = {"station": station, "tag": tag, "event": event, "traces": traces, **_earthquake(file, event)}
    return packed(facts, _text(file, "Waveforms", station, "StationXML").encode(), b"".join(samples))


def packed(facts: dict[str, Any], stationxml: bytes, samples: bytes) -> bytes:
    """Return the content of a member: the facts about the station, its StationXML, the samples of its channels."""
    # As text of another alphabet, or the StationXML within would make a StationXML of the whole.
    text = json.dumps(facts | {"stationxml": b64encode(stationxml).decode()}, sort_keys=True).encode()
    body = text + samples
    return STATION + _BEGIN.pack(len(text), zlib.crc32(body)) + body


def _is_raw(tag: str) -> bool:
    return any(tag == label or tag.endswith(f"_{label}") for label in _RAW_LABELS)


def _event_of(tag: str) -> str:
    """Return the earthquake that a tag of gmprocess begins with, "" of one that is a label alone."""
    raw = next((label for label in _RAW_LABELS if tag.endswith(f"_{label}")), "")
    return tag.removesuffix(f"_{raw}") if raw else ("" if _is_raw(tag) else tag.rpartition("_")[0])


def _member(file: Any, *names: str) -> Any:
    """Return what lies at a path in the file itself, None where nothing does: a link may lead to any other file."""
    import h5py

    found = file
    for name in names:
        if not isinstance(found, h5py.Group) or not isinstance(found.get(name, getlink=True), h5py.HardLink):
            return None
        found = found[name]
    return found


def _group(file: Any, *names: str) -> Iterator[str]:
    """Yield the names in a group, sorted."""
    import h5py

    found = _member(file, *names)
    yield from sorted(found) if isinstance(found, h5py.Group) else ()


def _dataset(file: Any, *names: str) -> Any:
    """Return a series of numbers. Raises RecordError where it is none, or its numbers lie in another file."""
    import h5py

    found = _member(file, *names)
    is_plain = isinstance(found, h5py.Dataset) and found.ndim == 1 and found.dtype.kind in "iuf"
    if not is_plain or found.external or found.is_virtual:
        raise RecordError(
            f"{names[-1]} is no series of numbers in this file; fetch the workspace again.", samples=names[-1]
        )
    return found


def _text(file: Any, *names: str) -> str:
    """Return the text that ASDF stores as a series of bytes, "" where there is none."""
    if _member(file, *names) is None:
        return ""
    data = _dataset(file, *names)
    if data.size > _LARGEST_TEXT:
        raise RecordError(
            f"{names[-1]} holds {data.size} bytes, more than {_LARGEST_TEXT}.", size=int(data.size)
        )
    return bytes(data[()].astype(np.uint8)).decode("utf-8", "replace").strip("\0")


_ACTIVITY = re.compile(r"(?s)<prov:activity\b[^>]*seis_prov:sp(\d+)_.*?</prov:activity>")
_UNIT_LEFT = re.compile(r"<seis_prov:output_units[^>]*>([^<]*)<")


def _unit_noted(provenance: str) -> str:
    """Return the unit that the last step of the processing left, by SEIS-PROV; "" where none says one."""
    steps = sorted((int(step[1]), step[0]) for step in _ACTIVITY.finditer(provenance))
    units = [match[1].strip() for _, step in steps if (match := _UNIT_LEFT.search(step))]
    return units[-1] if units else ""


def _noted(parameters: str) -> dict[str, Any]:
    """Return the corner of the high-pass, Hz, and why gmprocess let a trace fail, of what it noted of it (JSON)."""
    try:
        noted = json.loads(parameters or "{}")
        corner = float(noted.get("corner_frequencies", {}).get("highpass", 0.0))
        return {"high_pass_hz": corner, "failure": str(noted.get("failure", {}).get("reason", ""))}
    except (ValueError, AttributeError, TypeError):
        return {"high_pass_hz": 0.0, "failure": ""}


def _earthquake(file: Any, name: str) -> dict[str, Any]:
    """Return the time and the magnitude of the earthquake of that name, as far as the QuakeML of the file has them."""
    from obspy import read_events

    content = _text(file, "QuakeML").encode()
    if not (name and content) or b"<!DOCTYPE" in content:
        return {}
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            events = read_events(BytesIO(content), format="QUAKEML")
        event = next(candidate for candidate in events if str(candidate.resource_id).endswith(name))
        origin = event.preferred_origin() or event.origins[0]
        magnitude = event.preferred_magnitude() or event.magnitudes[0]
    except Exception:  # obspy raises what it likes of what is not there
        return {}
    return {
        "event_time": str(origin.time),
        "magnitude": float(magnitude.mag),
        "magnitude_type": str(magnitude.magnitude_type or ""),
    }


def read_station(content: bytes, options: Options) -> list[Accelerogram]:
    """The channels of a station: raw counts by the response, and processed motion in the unit that is noted of it."""
    facts, stationxml, samples = _parted(content)
    own = parsed_inventory(stationxml, "of the workspace") if stationxml else None
    _leave_out_stand_ins(own)
    records = []
    for trace, noted in _traces(facts, samples):
        is_raw = _is_raw(facts["tag"]) or _are_counts(noted, own, trace)
        unit = _unit_of(noted, own, trace, is_raw, options)
        inventory = inventory_of(options.inventory) or own if unit is None else own
        if unit is None and inventory is None:
            raise UndeclaredError(
                f"the workspace holds no StationXML of {trace.id}; {advice('inventory')}.", unit=None
            )
        (record,) = from_traces([trace], inventory, unit, options.response, None)
        if noted["failure"]:
            record = record.warned(RockingWarning.of(RecordKind.FAILED_IN_GMPROCESS, reason=noted["failure"]))
        named = {name: facts[name] for name in _OF_EARTHQUAKE if name in facts}
        step = options.time_step_of(record.time_step)
        corner = noted["high_pass_hz"] or None
        records.append(
            replace(record, processed=not is_raw, time_step=step, high_pass_frequency=corner, **named)
        )
    return records


_OF_EARTHQUAKE = "event", "event_time", "magnitude", "magnitude_type"
"""The facts of a member that are fields of each of its channels."""


def _parted(content: bytes) -> tuple[dict[str, Any], bytes, bytes]:
    """Return what packed() put together. Raises RecordError where something is missing or changed."""
    begin = len(STATION) + _BEGIN.size
    length, checksum = _BEGIN.unpack_from(content.ljust(begin, b"\0"), len(STATION))
    body = content[begin:]
    if not body or zlib.crc32(body) != checksum:
        raise RecordError(
            "the station of a workspace is cut or damaged; fetch the workspace again.", format="ASDF station"
        )
    facts: dict[str, Any] = json.loads(body[:length])
    return facts, b64decode(facts["stationxml"]), body[length:]


def _traces(facts: dict[str, Any], samples: bytes) -> Iterator[tuple[Any, dict[str, Any]]]:
    """Yield obspy's trace of each channel, pieces of one channel joined, and what is noted of it."""
    from obspy import Stream, Trace, UTCDateTime  # which takes a second to import

    network, _, station = facts["station"].partition(".")
    stream = Stream()
    noted_of = {}
    at = 0
    for noted in facts["traces"]:
        kind = np.dtype(noted["type"])
        values = np.frombuffer(samples, kind, noted["samples"], at).astype(kind.newbyteorder("="))
        at += values.nbytes
        header = {
            "network": network, "station": station, "location": noted["location"].strip("-"),
            "channel": noted["channel"], "sampling_rate": noted["rate_hz"],
            "starttime": UTCDateTime(ns=noted["start_ns"]),
        }  # fmt: skip
        trace = Trace(values, header)
        noted_of[trace.id] = noted
        stream.append(trace)
    yield from ((trace, noted_of[trace.id]) for trace in joined(stream))


def _unit_of(noted: dict[str, Any], own: Any, trace: Any, is_raw: bool, options: Options) -> str | None:
    """Return the unit of the samples of a trace, None of raw counts.

    By what gmprocess noted, and of processed motion by the StationXML. Raises RecordError for another quantity, and
    UndeclaredError where neither says it, or both say unlike units.
    """
    of_channel = "" if is_raw else _calibration_unit(own, trace)
    units = [noted["unit"] or of_channel, of_channel if acceleration_unit(of_channel) else ""]
    unit = options.unit_in(units, "the workspace")
    return options.unit if is_raw and unit is None else options.unit_of(unit)


def _are_counts(noted: dict[str, Any], inventory: Any, trace: Any) -> bool:
    """Whether samples under a tag of one's own are counts: whole numbers in no unit, with a response of counts."""
    is_stated = noted["unit"] or _calibration_unit(inventory, trace)
    if is_stated or trace.data.dtype.kind not in "iu" or inventory is None:
        return False
    with suppress(Exception):  # obspy raises what it likes for what is not there
        return bool(inventory.get_response(trace.id, trace.stats.starttime))
    return False


def _calibration_unit(inventory: Any, trace: Any) -> str:
    """Return the unit that the StationXML states for the samples of a channel, "" where it states none."""
    stats = trace.stats
    of_trace = inventory.select(stats.network, stats.station, channel=stats.channel) if inventory else ()
    channels = [channel for network in of_trace for station in network for channel in station]
    units = {str(channel.calibration_units) for channel in channels if channel.calibration_units}
    return units.pop() if len(units) == 1 else ""


def _leave_out_stand_ins(inventory: Any) -> None:
    """Take out the azimuth 0 without a dip that gmprocess writes where it knows none: the channel's name says more."""
    for network in inventory or ():
        for station in network:
            for channel in station:
                if channel.azimuth is not None and float(channel.azimuth) == 0 and channel.dip is None:
                    channel.azimuth = None
