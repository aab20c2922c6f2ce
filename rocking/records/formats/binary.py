"""The formats that obspy reads, from bytes we have recognised, by the format we name: SAC, EVT, miniSEED."""

import io
import re
import struct
import warnings
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from rocking.errors import RecordError, UndeclaredError
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, without_offset
from rocking.records.formats.text import LARGEST_SERIES
from rocking.records.instrument import azimuth
from rocking.records.traces import calibrated, first_line, joined, names, site
from rocking.remarks import Kind, Remark
from rocking.tables import read_whole

_DAMAGE = re.compile(r"integrity|not a SEED record|unexpected end|will not be read|corrupt|mismatch", re.I)
"""The warnings of libmseed when the numbers are not those that were written."""


def _stream(content: bytes, form: str, **options: Any) -> Any:
    """Return obspy's Stream of `content` in its format `form`, joined, and warnings; RecordError for an error."""
    import obspy  # which takes a second to import

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            notes = _check_blocks(content) if form == "MSEED" else []
            result = obspy.read(io.BytesIO(content), format=form, check_compression=False, **options)
        except RecordError:
            raise
        except Exception as error:
            reason, _, _ = first_line(error).partition(": <_io")  # what an address in memory follows
            raise RecordError(f"damaged {form} file, {reason}; fetch it again.") from error
    messages = [first_line(each.message) for each in caught]
    if form == "MSEED" and (damage := [text for text in messages if _DAMAGE.search(text)]):
        raise RecordError(f"damaged {form} file, {damage[0]}; fetch it again.")
    if not any(trace.stats.npts for trace in result):
        raise RecordError(f"the {form} file holds no samples.")
    notes += [Remark.of(Kind.TOLD_BY_OBSPY, text=text) for text in messages]
    for _, station, _, channel, _, begin, length, _ in result.get_gaps():
        if length < 0:
            of = f"{station} {channel}"
            notes.append(Remark.of(Kind.BLOCKS_OVERLAP, of, overlap_s=float(-length), time=str(begin)))
    return joined(result), tuple(sorted(set(notes), key=str))


def _check_blocks(content: bytes) -> list[Remark]:
    """Check by the heads of its blocks that a miniSEED file is whole and not too large; a warning of a leap."""
    import obspy  # which takes a second to import
    from obspy.io.mseed.util import get_record_information

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        notes = get_record_information(io.BytesIO(content))
        heads = obspy.read(io.BytesIO(content), format="MSEED", check_compression=False, headonly=True)
    at = 0 if notes.get("excess_bytes") else len(content)
    with suppress(Exception):  # the records may differ in length, and yet end where the file does
        while at < len(content):
            at += get_record_information(io.BytesIO(content), offset=at)["record_length"]
    if at != len(content):
        record = f"the last record of {notes['record_length']} bytes"
        raise RecordError(f"{record} is cut after {notes['excess_bytes']}; fetch the whole file.")
    samples = sum(trace.stats.npts for trace in heads)
    if samples > LARGEST_SERIES:
        raise RecordError(f"the file unpacks to {samples} samples, more than {LARGEST_SERIES}; cut it first.")
    marks = (content[place : place + 6] for place in range(0, len(content), notes["record_length"]))
    numbers = np.array([int(mark) for mark in marks if mark.isdigit()])
    leaps = np.flatnonzero((np.diff(numbers) != 1) & (numbers[1:] != 1))
    if not 0 < 2 * leaps.size < numbers.size - 1:
        return []
    before = int(numbers[leaps[0]])
    after = int(numbers[leaps[0] + 1])
    return [Remark.of(Kind.BLOCKS_LEAP, before=before, after=after)]


def _sac_direction(header: dict[str, float], component: str) -> dict[str, Any]:
    """Return where a SAC header lets a channel point: azimuth [degrees] and whether it is vertical, as far as it says.

    Zeros for both, in a channel called north or east, are those of a program that sets neither: they say nothing.
    """
    angle, inclination = (header.get(key, _UNDEFINED) for key in ("cmpaz", "cmpinc"))
    if angle == 0 == inclination and azimuth(component) in (0.0, 90.0):
        return {}
    facts: dict[str, Any] = {"azimuth": angle % 360} if abs(angle) <= 360 else {}
    if inclination != _UNDEFINED:  # degrees from upwards: 0 and 180 are vertical, 90 is horizontal
        facts["vertical"] = abs(inclination % 180 - 90) > _STEEP
    return facts


_SAC_HEADER = 632
_SAC_PLACE = {"latitude": "stla", "longitude": "stlo", "elevation": "stel"}
_UNDEFINED = -12345.0
_OTHER_SAC = {6: "displacement", 7: "velocity"}
"""Kinds of the dependent variable, `idep`, that are no acceleration (SAC manual: IDISP, IVEL)."""
_STEEP = 45.0
"""Degrees out of the horizontal from which on a component is vertical."""
_BURIED = 5.0
"""m below the surface from which on a sensor stands in a borehole."""
_VERSION = 304
"""Byte at which the header's version stands (SAC manual, word 76)."""
_SAMPLES = 316
"""Byte at which its number of samples stands (word 79)."""


def _is_sac(content: bytes) -> bool:
    if len(content) <= _SAC_HEADER:
        return False
    for order in "<>":
        version, samples = (struct.unpack_from(order + "i", content, at)[0] for at in (_VERSION, _SAMPLES))
        if version in (6, 7) and samples > 0 and 0 <= len(content) - _SAC_HEADER - 4 * samples <= 176:
            return True
    return False


def _read_sac(content: bytes, options: Options) -> list[Accelerogram]:
    traces, warnings = _stream(content, "SAC", checksize=True)
    records = []
    for trace in traces:
        numbers = {key: float(x) for key, x in trace.stats.sac.items() if isinstance(x, np.floating | float)}
        header = {key: value for key, value in numbers.items() if value != _UNDEFINED}
        if quantity := _OTHER_SAC.get(int(trace.stats.sac.get("idep", 0))):
            raise RecordError(
                f"its header says that it holds {quantity}; use the acceleration of the same record."
            )
        # The step in the file has single precision: 0.02 is stored as 0.0199999996.
        step = float(f"{trace.stats.delta:.6g}")
        _check_sac(header, trace.data, step)
        unit, values, facts = _sac_motion(trace, options)
        facts |= {name: header[key] for name, key in _SAC_PLACE.items() if key in header}
        facts |= _sac_direction(header, trace.stats.channel)
        if header.get("stdp", 0.0) >= _BURIED:
            facts["borehole"] = True
        facts |= names(trace) | {"warnings": (*warnings, *facts["warnings"])}
        records.append(options.accelerogram(unit, values, step, **facts))
    return records


def _sac_motion(trace: Any, options: Options) -> tuple[str, np.ndarray, dict[str, Any]]:
    """Return the unit of the samples of a SAC file, the samples (n,), and what was done to them.

    A unit that is declared wins; without one the samples are counts, which the StationXML that is given, or lies beside
    the file, turns into acceleration. Raises UndeclaredError where there is neither.
    """
    if options.unit is None:
        try:
            inventory = _inventory(trace.stats, options)
        except UndeclaredError as error:
            raise UndeclaredError(_SAC_SILENT.format(error), "unit") from None
        if inventory is not None:
            motion = calibrated(trace, inventory, options.response)
            facts = {"processing": (motion.sentence,), "warnings": motion.warnings, "processed": False}
            return "m/s2", motion.acceleration, facts | site(trace, inventory)
    unit = options.unit_of(None)
    values, offset = without_offset(trace.data.astype(float) * trace.stats.calib, unit)
    scale = float(trace.stats.calib)
    scaled = (Remark.of(Kind.SCALE_APPLIED, factor=scale),) if scale != 1 else ()
    return unit, values, {"processing": (*map(str, scaled), offset), "warnings": scaled}


_SAC_SILENT = (
    "unit is not declared, for a SAC file declares none. Of acceleration, declare it: the column unit of the "
    "catalogue, --unit on the command line, unit= in Python. Of counts, give the StationXML of the instrument: {}"
)


def _check_sac(header: dict[str, float], data: np.ndarray, step: float) -> None:
    """Compare the extremes and the end that the header states with the samples, before any mean is removed."""
    measured = {"depmin": data.min(), "depmax": data.max(), "depmen": data.mean(dtype=float)}
    allowed = 1e-4 * max(abs(header.get("depmin", _UNDEFINED)), abs(header.get("depmax", _UNDEFINED)))
    for key, value in measured.items():
        if allowed and key in header and not abs(header[key] - value) <= allowed:
            stated = f"the header states {key.upper()} = {header[key]:g}, but the samples reach {value:g}"
            raise RecordError(f"{stated}; the file is damaged or its header another's; fetch it again.")
    begin = header.get("b", 0.0)
    end = header.get("e", 0.0)
    # Single precision keeps seven digits of the times.
    allowed = 0.5 * step + 3e-7 * max(abs(begin), abs(end))
    if {"b", "e"} <= header.keys() and begin != end and abs(end - begin - step * (data.size - 1)) > allowed:
        stated = f"the header states an end at {end:g} s, but {data.size} samples every {step:g} s"
        raise RecordError(f"{stated} from {begin:g} s end elsewhere; the file is damaged; fetch it again.")


_OBSPY_G = 9.81  # obspy turns the sensitivity in V/g into V/(m/s²) with this g

_COMPONENTS = "XYZ"
_TAG = struct.Struct(">cBBBLHHHH")
_FRAME = struct.Struct(">6xL6xH")  # time of a frame's first sample: whole seconds and milliseconds
_FRAME_LENGTH = 100  # ms


def _read_evt(content: bytes, options: Options) -> list[Accelerogram]:
    options.unit_of("m/s2")
    _check_frames(content)
    traces, warnings = _stream(content, "KINEMETRICS_EVT", apply_calib=False)
    records = []
    for i, trace in enumerate(traces):
        samples = trace.data.astype(float) * trace.stats.calib * (GRAVITY / _OBSPY_G)
        values, offset = without_offset(samples, "m/s2")
        component = str(trace.stats.kinemetrics_evt.get("chan_id", "")).strip() or _COMPONENTS[i % 3]
        facts: dict[str, Any] = {"processing": (offset,), "warnings": warnings, **names(trace)}
        facts |= {"component": component, "event": str(trace.stats.starttime)[:10]}
        facts["vertical"] = component.upper() in ("Z", "V", "UP") or i == 2
        records.append(options.accelerogram("m/s2", values, float(trace.stats.delta), **facts))
    return records


def _check_frames(content: bytes) -> None:
    """Check the sum of each frame, and that one follows another by a tenth of a second."""
    at = 0
    before = None
    while content[at : at + 1] == b"K" and at + _TAG.size <= len(content):
        _, _, _, _, kind, head, body, _, checksum = _TAG.unpack_from(content, at)
        frame = content[at + _TAG.size : at + _TAG.size + head + body]
        if len(frame) < head + body or checksum not in (0, sum(frame) & 0xFFFF) or (kind == 1) != (at == 0):
            raise RecordError(f"the frame at byte {at} is cut or damaged: its sum differs; fetch it again.")
        if kind == 2 and head >= _FRAME.size:
            seconds, milliseconds = _FRAME.unpack_from(frame)
            now = 1000 * seconds + milliseconds
            if before is not None and now - before != _FRAME_LENGTH:
                late = f"the frame at byte {at} begins {now - before} ms after the one before, not {_FRAME_LENGTH} ms"
                raise RecordError(f"{late}: frames are missing, repeated or out of order.")
            before = now
        at += _TAG.size + head + body
    if content[at:].strip(b"\0"):
        raise RecordError(f"what stands at byte {at} is no frame; the file is damaged, fetch it again.")


_FIXED_HEADER = re.compile(rb"[0-9 \0]{6}[DRQM][ \0]")
_LARGEST_XML = 32 * 2**20


def _read_miniseed(content: bytes, options: Options) -> list[Accelerogram]:
    """The samples are counts, turned into acceleration by the StationXML that describes the instrument."""
    traces, warnings = _stream(content, "MSEED")
    inventory = _inventory(traces[0].stats, options)
    unit = options.unit_of(None) if inventory is None else None
    records = []
    for record in Accelerogram.from_obspy(traces, inventory, unit, options.response):
        step = options.time_step_of(float(f"{record.time_step:.9g}"))
        doubts = (*warnings, *record.warnings)
        records.append(replace(record, time_step=step, warnings=doubts, processed=False))
    return records


def _inventory(stats: Any, options: Options) -> Any:
    """Return the inventory given, else the one in the folder that names this network and station, or None."""
    if options.inventory is not None:
        return _parse(options.inventory)
    if options.unit is not None or options.folder is None:
        return None
    naming = []
    for path in sorted(options.folder.glob("*.xml")):
        with suppress(RecordError):
            text = read_whole(path, _LARGEST_XML, RecordError).decode("utf-8", "replace")
            station = re.search(rf'<(\w+:)?Station\b[^>]*\bcode="{re.escape(stats.station)}"', text)
            if station and "FDSNStationXML" in text[:2000] and f'code="{stats.network}"' in text:
                naming.append(path)
    if len(naming) != 1:
        several = f"several do: {', '.join(p.name for p in naming)}" if naming else "none beside it does"
        missing = f"no single StationXML describes {stats.network}.{stats.station} ({several})"
        raise UndeclaredError(f"{missing}; give inventory=, or unit= if the samples are acceleration.")
    return _parse(naming[0])


def _parse(path: Path) -> Any:
    from obspy import read_inventory  # which takes a second to import

    content = read_whole(path, _LARGEST_XML, RecordError, path.name)
    if b"FDSNStationXML" not in content[:2000] or b"<!DOCTYPE" in content:
        raise RecordError(f"{path.name} is not a plain StationXML file; give one.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read_inventory(io.BytesIO(content), format="STATIONXML")
    except Exception as error:
        raise RecordError(f"damaged StationXML {path.name}, {str(error)[:200]}; fetch it again.") from error


def may_be_counts(head: bytes) -> bool:
    """Whether a file that begins with `head`, its first 1024 bytes, may hold counts, which need a StationXML."""
    if MINISEED.recognise(head):
        return True
    versions = (struct.unpack_from(order + "i", head.ljust(_SAC_HEADER), _VERSION)[0] for order in "<>")
    return any(version in (6, 7) for version in versions)


def _refuse(content: bytes, options: Options) -> list[Accelerogram]:
    raise RecordError("a StationXML holds no samples, but describes an instrument; read the miniSEED.")


SAC = Format(
    "SAC",
    "SAC (IRIS, and many networks)",
    "SAC header of version 6 or 7 whose number of samples fits the size of the file",
    _is_sac,
    _read_sac,
)
EVT = Format(
    "Kinemetrics EVT",
    "Kinemetrics recorders",
    "KMI mark at the start of the file",
    lambda content: content[:1] == b"K" and content[:32].count(b"KMI") == 1,
    _read_evt,
)
MINISEED = Format(
    "miniSEED",
    "FDSN data centres",
    "miniSEED fixed header (six digits, then D, R, Q or M)",
    lambda content: len(content) >= 128 and bool(_FIXED_HEADER.match(content)),
    _read_miniseed,
)
STATIONXML = Format(
    "StationXML",
    "FDSN data centres",
    "FDSNStationXML element",
    lambda content: b"<FDSNStationXML" in content[:2000],
    _refuse,
)
