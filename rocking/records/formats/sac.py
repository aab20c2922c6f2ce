"""SAC binary files: evenly sampled, in a unit that the caller declares because the header's is seldom true."""

import struct

from rocking.records.accelerogram import Accelerogram
from rocking.records.directions import azimuth, is_vertical
from rocking.records.formats.format import Format, Options, accelerogram, without_offset
from rocking.records.formats.waveform import joined, stream

_HEADER = 632
_VERSION, _SAMPLES = 304, 316
"""Bytes at which the header's version and number of samples stand (SAC manual, words 76 and 79)."""


def _recognise(content: bytes) -> bool:
    return len(content) > _HEADER and any(_fits(content, order) for order in "<>")


def _fits(content: bytes, order: str) -> bool:
    (version,) = struct.unpack_from(order + "i", content, _VERSION)
    (samples,) = struct.unpack_from(order + "i", content, _SAMPLES)
    return (
        version in (6, 7)
        and samples > 0
        and _HEADER + 4 * samples <= len(content) <= _HEADER + 4 * samples + 176
    )


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    result, warnings = stream(content, "SAC", name)
    unit = options.unit_of(name, None)
    return [_record(trace, name, unit, options, warnings) for trace in joined(result, name)]


def _record(trace, name: str, unit: str, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    azimuth_in_file = float(stats.sac.get("cmpaz", float("nan")))
    known = -360 <= azimuth_in_file <= 360
    vertical = is_vertical(stats.channel)
    values, offset = without_offset(trace.data.astype(float) * stats.calib, unit)
    return accelerogram(
        name,
        SAC.name,
        unit,
        values,
        options.time_step_of(name, _step(stats)),
        component=stats.channel,
        station=stats.station,
        network=stats.network,
        warnings=warnings,
        start_time=str(stats.starttime),
        vertical=vertical,
        processing=(offset,),
        azimuth=None if vertical else azimuth_in_file % 360 if known else azimuth(stats.channel),
    )


def _step(stats) -> float:
    """The step in the file has single precision: 0.02 is stored as 0.0199999996."""
    return float(f"{stats.delta:.6g}")


SAC = Format(
    "SAC", "SAC header of version 6 or 7 whose number of samples fits the size of the file", _recognise, _read
)
