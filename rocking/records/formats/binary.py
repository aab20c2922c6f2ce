"""The formats that obspy reads, from bytes we have recognised, by the format we name, never guessed; SAC and EVT."""

import io
import re
import struct
import warnings

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, without_offset
from rocking.records.formats.sampling import LARGEST_SERIES
from rocking.records.traces import first_line, joined

_DAMAGE = re.compile(r"integrity|not a SEED record|unexpected end|will not be read|corrupt|mismatch", re.I)
"""What libmseed warns of when the numbers are not those that were written."""


def stream(content: bytes, form: str, **options):
    """Return obspy's Stream of `content` in the obspy format `form`, and the warnings that were raised on the way.

    Raises RecordError for whatever obspy raises, and when nothing is in the file.
    """
    import obspy

    _check_size(content, form)
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            result = obspy.read(io.BytesIO(content), format=form, check_compression=False, **options)
        except Exception as error:
            raise RecordError(f"damaged {form} file, {first_line(error)}; fetch it again.") from error
    if form == "MSEED" and (damage := [w for w in caught if _DAMAGE.search(str(w.message))]):
        raise RecordError(f"damaged {form} file, {first_line(damage[0].message)}; fetch it again.")
    if not any(trace.stats.npts for trace in result):
        raise RecordError(f"the {form} file holds no samples.")
    told = {f"obspy: {first_line(w.message)}." for w in caught}
    for _, station, _, channel, _, begin, seconds, _ in result.get_gaps():
        if seconds < 0:
            told.add(
                f"Blocks of {station} {channel} overlap by {-seconds:g} s at {begin}: repeated or overwritten."
            )
    return result, tuple(sorted(told))


def _check_size(content: bytes, form: str) -> None:
    """Check, from the heads of its records, that a miniSEED file is whole and not too large unpacked."""
    if form != "MSEED":
        return
    import obspy
    from obspy.io.mseed.util import get_record_information

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            notes = get_record_information(io.BytesIO(content))
            heads = obspy.read(io.BytesIO(content), format=form, check_compression=False, headonly=True)
    except Exception as error:
        raise RecordError(f"damaged {form} file, {first_line(error)}; fetch it again.") from error
    if notes.get("excess_bytes") and not _records_end_well(content):
        raise RecordError(
            f"the last record of {notes['record_length']} bytes is cut after {notes['excess_bytes']}: "
            "the file is truncated; fetch the whole file."
        )
    samples = sum(trace.stats.npts for trace in heads)
    if samples > LARGEST_SERIES:
        raise RecordError(f"the file unpacks to {samples} samples, more than {LARGEST_SERIES}; cut it first.")


def _records_end_well(content: bytes) -> bool:
    """Whether the records, which may differ in length, end where the file does."""
    from obspy.io.mseed.util import get_record_information

    at = 0
    try:
        while at < len(content):
            at += get_record_information(io.BytesIO(content), offset=at)["record_length"]
    except Exception:
        return False
    return at == len(content)


_SAC_HEADER = 632
_SAC_PLACE = {"latitude": "stla", "longitude": "stlo", "elevation": "stel"}
_UNDEFINED = -12345.0
_VERSION, _SAMPLES = 304, 316
"""Bytes at which the header's version and number of samples stand (SAC manual, words 76 and 79)."""


def _is_sac(content: bytes) -> bool:
    return len(content) > _SAC_HEADER and any(_fits_sac(content, order) for order in "<>")


def _fits_sac(content: bytes, order: str) -> bool:
    (version,) = struct.unpack_from(order + "i", content, _VERSION)
    (samples,) = struct.unpack_from(order + "i", content, _SAMPLES)
    return (
        version in (6, 7)
        and samples > 0
        and _SAC_HEADER + 4 * samples <= len(content) <= _SAC_HEADER + 4 * samples + 176
    )


def _read_sac(content: bytes, options: Options) -> list[Accelerogram]:
    result, warnings = stream(content, "SAC", checksize=True)
    unit = options.unit_of(None)
    return [_sac_record(trace, unit, options, warnings) for trace in joined(result)]


def _sac_record(trace, unit: str, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    azimuth = float(stats.sac.get("cmpaz", float("nan")))
    _check_sac(stats, trace.data)
    values, offset = without_offset(trace.data.astype(float) * stats.calib, unit)
    return options.accelerogram(
        unit,
        values,
        _sac_step(stats),
        component=stats.channel,
        station=stats.station,
        network=stats.network,
        location=stats.location,
        warnings=warnings,
        start_time=str(stats.starttime),
        processing=(offset,),
        azimuth=azimuth % 360 if -360 <= azimuth <= 360 else None,
        **{
            name: float(stats.sac[key])
            for name, key in _SAC_PLACE.items()
            if stats.sac.get(key, -12345) != -12345
        },
    )


def _check_sac(stats, data: np.ndarray) -> None:
    """Compare the extremes and the end that the header states with the samples, before any mean is removed."""
    low, high, mean = (float(stats.sac.get(key, _UNDEFINED)) for key in ("depmin", "depmax", "depmen"))
    allowed = 1e-4 * max(abs(low), abs(high))
    measured = (
        ("DEPMIN", low, data.min()),
        ("DEPMAX", high, data.max()),
        ("DEPMEN", mean, data.mean(dtype=float)),
    )
    for key, stated, found in measured:
        if allowed and stated != _UNDEFINED and not abs(stated - found) <= allowed:
            raise RecordError(
                f"the header states {key} = {stated:g}, but the samples reach {found:g}; the file is damaged "
                "or its header belongs to another record."
            )
    begin, end = (float(stats.sac.get(key, _UNDEFINED)) for key in ("b", "e"))
    if _UNDEFINED not in (begin, end) and end != begin:
        step = _sac_step(stats)
        # Single precision keeps seven digits of the times.
        if abs(end - begin - step * (stats.npts - 1)) > 0.5 * step + 3e-7 * max(abs(begin), abs(end)):
            raise RecordError(
                f"the header states an end at {end:g} s, but {stats.npts} samples every {step:g} s from "
                f"{begin:g} s end elsewhere; the file is damaged."
            )


def _sac_step(stats) -> float:
    """The step in the file has single precision: 0.02 is stored as 0.0199999996."""
    return float(f"{stats.delta:.6g}")


SAC = Format("SAC", "SAC (IRIS, and many networks)",
    "SAC header of version 6 or 7 whose number of samples fits the size of the file", _is_sac, _read_sac)  # fmt: skip


_OBSPY_G = 9.81
"""obspy turns the sensitivity in V/g into V/(m/s²) with this g."""

_COMPONENTS = "XYZ"
_TAG = struct.Struct(">cBBBLHHHH")
_FRAME = struct.Struct(">6xL6xH")
"""Time of a frame's first sample: whole seconds and milliseconds."""
_FRAME_LENGTH = 100
"""ms."""


def _read_evt(content: bytes, options: Options) -> list[Accelerogram]:
    options.unit_of("m/s2")
    _check_frames(content)
    result, warnings = stream(content, "KINEMETRICS_EVT", apply_calib=False)
    return [_evt_record(trace, i, options, warnings) for i, trace in enumerate(joined(result))]


def _check_frames(content: bytes) -> None:
    """Check the sum of each frame, and that one follows another by a tenth of a second."""
    at, before = 0, None
    while content[at : at + 1] == b"K" and at + _TAG.size <= len(content):
        _, _, _, _, kind, head, body, _, checksum = _TAG.unpack_from(content, at)
        frame = content[at + _TAG.size : at + _TAG.size + head + body]
        if len(frame) < head + body or checksum not in (0, sum(frame) & 0xFFFF) or (kind == 1) != (at == 0):
            raise RecordError(f"the frame at byte {at} is cut or damaged: its sum differs; fetch it again.")
        if kind == 2 and head >= _FRAME.size:
            seconds, milliseconds = _FRAME.unpack_from(frame)
            now = 1000 * seconds + milliseconds
            if before is not None and now - before != _FRAME_LENGTH:
                raise RecordError(
                    f"the frame at byte {at} begins {now - before} ms after the one before, not "
                    f"{_FRAME_LENGTH} ms: frames are missing, repeated or out of order."
                )
            before = now
        at += _TAG.size + head + body
    if content[at:].strip(b"\0"):
        raise RecordError(f"what stands at byte {at} is no frame; the file is damaged, fetch it again.")


def _evt_record(trace, index: int, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    values, offset = without_offset(trace.data.astype(float) * stats.calib * (GRAVITY / _OBSPY_G), "m/s2")
    component = str(stats.kinemetrics_evt.get("chan_id", "")).strip() or _COMPONENTS[index % 3]
    return options.accelerogram(
        "m/s2",
        values,
        float(stats.delta),
        component=component,
        station=stats.station,
        event=str(stats.starttime)[:10],
        start_time=str(stats.starttime),
        processing=(offset,),
        warnings=warnings,
        vertical=component.upper() in ("Z", "V", "UP") or index == 2,
    )


EVT = Format("Kinemetrics EVT", "Kinemetrics recorders", "KMI mark at the start of the file",
    lambda content: content[:1] == b"K" and content[:32].count(b"KMI") == 1, _read_evt)  # fmt: skip
