"""SAC binary files: evenly sampled, in a unit that the caller declares because the header's is seldom true."""

import struct

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram, without_offset
from rocking.records.formats.waveform import joined, stream

_HEADER = 632
_UNDEFINED = -12345.0
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


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    result, warnings = stream(content, "SAC", checksize=True)
    unit = options.unit_of(None)
    return [_record(trace, unit, options, warnings) for trace in joined(result)]


def _record(trace, unit: str, options: Options, warnings: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    azimuth_in_file = float(stats.sac.get("cmpaz", float("nan")))
    known = -360 <= azimuth_in_file <= 360
    _check_header(stats, trace.data)
    values, offset = without_offset(trace.data.astype(float) * stats.calib, unit)
    return accelerogram(
        unit,
        values,
        options.time_step_of(_step(stats)),
        component=stats.channel,
        station=stats.station,
        network=stats.network,
        warnings=warnings,
        start_time=str(stats.starttime),
        processing=(offset,),
        azimuth=azimuth_in_file % 360 if known else None,
    )


def _check_header(stats, data: np.ndarray) -> None:
    """Compare the extremes and the end that the header states with the samples, before any mean is removed."""
    low, high = (float(stats.sac.get(key, _UNDEFINED)) for key in ("depmin", "depmax"))
    allowed = 1e-4 * max(abs(low), abs(high))
    for key, stated, found in (("DEPMIN", low, data.min()), ("DEPMAX", high, data.max())):
        if allowed and stated != _UNDEFINED and not abs(stated - found) <= allowed:
            raise RecordError(
                f"the header states {key} = {stated:g}, but the samples reach {found:g}; the file is damaged "
                "or its header belongs to another record."
            )
    begin, end = (float(stats.sac.get(key, _UNDEFINED)) for key in ("b", "e"))
    if _UNDEFINED not in (begin, end) and end != begin:
        step = _step(stats)
        # Single precision keeps seven digits of the times.
        if abs(end - begin - step * (stats.npts - 1)) > 0.5 * step + 3e-7 * max(abs(begin), abs(end)):
            raise RecordError(
                f"the header states an end at {end:g} s, but {stats.npts} samples every {step:g} s from "
                f"{begin:g} s end elsewhere; the file is damaged."
            )


def _step(stats) -> float:
    """The step in the file has single precision: 0.02 is stored as 0.0199999996."""
    return float(f"{stats.delta:.6g}")


SAC = Format(
    "SAC",
    "SAC (IRIS, and many networks)",
    "SAC header of version 6 or 7 whose number of samples fits the size of the file",
    _recognise,
    _read,
)
