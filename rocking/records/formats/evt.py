"""Kinemetrics EVT (Altus K2, Etna, Makalu): counts, with full scale and sensitivity in the file itself."""

import struct

from rocking.errors import RecordError
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram, without_offset
from rocking.records.formats.waveform import joined, stream

_OBSPY_G = 9.81
"""obspy turns the sensitivity in V/g into V/(m/s²) with this g."""

_COMPONENTS = "XYZ"
_TAG = struct.Struct(">cBBBLHHHH")
_FRAME = struct.Struct(">6xL6xH")
"""Time of a frame's first sample: whole seconds and milliseconds."""
_FRAME_LENGTH = 100
"""ms."""


def _recognise(content: bytes) -> bool:
    return content[:1] == b"K" and content[:32].count(b"KMI") == 1


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    options.unit_of("m/s2")
    _check_frames(content)
    result, warnings = stream(content, "KINEMETRICS_EVT", apply_calib=False)
    return [_record(trace, i, options, warnings) for i, trace in enumerate(joined(result))]


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


def _record(trace, index: int, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    values, offset = without_offset(trace.data.astype(float) * stats.calib * (GRAVITY / _OBSPY_G), "m/s2")
    component = str(stats.kinemetrics_evt.get("chan_id", "")).strip() or _COMPONENTS[index % 3]
    return accelerogram(
        "m/s2",
        values,
        options.time_step_of(float(stats.delta)),
        component=component,
        station=stats.station,
        event=str(stats.starttime)[:10],
        start_time=str(stats.starttime),
        processing=(offset,),
        warnings=warnings,
        vertical=component.upper() in ("Z", "V", "UP") or index == 2,
    )


EVT = Format(
    "Kinemetrics EVT", "Kinemetrics recorders", "KMI mark at the start of the file", _recognise, _read
)
