"""Streams of obspy as accelerograms, through the same checks as files."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from rocking.errors import RecordError, about
from rocking.quantities import acceleration_factor
from rocking.records.accelerogram import OBSPY_EXTRAS, Accelerogram, Source
from rocking.records.direction import directed
from rocking.records.formats.format import without_offset
from rocking.records.joining import SAME_STEP
from rocking.records.read import checked_channels
from rocking.records.traces import calibrated, joined, names, quantity_order, site, unit_left_by
from rocking.remarks import Kind, Remark

_CALIBRATED_TO_DISPLACEMENT = "GSE1", "GSE2", "CSS", "NNSA_KB_CORE"
"""The formats whose calibration is in nm of displacement a count, at a period that it is stated for."""
_DIRECTED = ("component", "azimuth", "vertical")
"""The facts that a rotation makes untrue."""


LARGEST_TRACE = 4_000_000
"""Samples of the longest trace that is taken: five and a half hours at 200 Hz."""


def from_obspy(
    trace_or_stream: Any, inventory: Any = None, unit: str | None = None, response: str = "sensitivity"
) -> list[Accelerogram]:
    """Return an accelerogram for each channel of an obspy Trace or Stream, as `Accelerogram.from_obspy` does.

    Raises RecordError for a gap, for velocity and displacement, and where nothing says what the samples are.

    >>> from obspy import Trace
    >>> rocking.from_obspy(Trace(np.sin(np.arange(9.0)), {"channel": "HNZ"}), unit="m/s2")[0].vertical
    True
    """
    from obspy import Stream, Trace  # which takes a second to import

    stream = Stream([trace_or_stream] if isinstance(trace_or_stream, Trace) else trace_or_stream).copy()
    if not stream:
        raise RecordError("the stream holds no trace; give one with acceleration.")
    records = []
    for trace in joined(stream):
        with about(trace.id):
            records.append(_from_trace(trace, inventory, unit, response))
    told = tuple(_unlike(records))
    return checked_channels([record.warned(*told) for record in records])


def _unlike(records: list[Accelerogram]) -> Iterator[Remark]:
    """Yield what lets the channels of a stream be none of one record: several stations, or several time steps."""
    stations = sorted({f"{record.network}.{record.station}" for record in records})
    if len(stations) > 1:
        yield Remark.of(Kind.STATIONS_UNLIKE, stations=", ".join(stations[:3]), number=len(stations))
    steps = [record.time_step for record in records]
    if max(steps) > min(steps) * (1 + SAME_STEP):
        yield Remark.of(Kind.STEPS_OF_STREAM_UNLIKE, least_s=min(steps), most_s=max(steps))


def _from_trace(trace: Any, inventory: Any, unit: str | None, response: str) -> Accelerogram:
    """The accelerogram of one trace without gaps."""
    if trace.stats.npts > LARGEST_TRACE:
        raise RecordError(
            f"it holds {trace.stats.npts} samples, more than {LARGEST_TRACE}; cut the motion out of it first."
        )
    own = dict(trace.stats.get("rocking", {}))
    steps = list(trace.stats.get("processing", ()))
    if own and own.get("component") != trace.stats.channel:
        own = {name: value for name, value in own.items() if name not in _DIRECTED}
    is_motion = bool(own) or "output=" in " ".join(steps)  # what was integrated or differentiated is known
    declared = _unit_of(trace, unit, own, is_motion, has_response=inventory is not None)
    fields: dict[str, Any] = {"processed": False if declared is None else None, **names(trace)}
    fields |= {name: own[name] for name in OBSPY_EXTRAS if name in own}
    place = site(trace, inventory)
    doubts = [*fields.get("warnings", ()), *place.get("warnings", ())]
    fields |= place
    if str(trace.stats.channel).isdigit() and len(str(trace.stats.channel)) == 1:
        fields.setdefault("azimuth", None)
        fields["component"] = f"channel {trace.stats.channel}"
    processing = [*fields.get("processing", ()), *(f"obspy: {step}"[:200] for step in steps)]
    if declared is None:
        motion = calibrated(trace, inventory, response)
        samples = motion.acceleration
        processing.append(motion.sentence)
        doubts += motion.warnings
    else:
        calibration = float(trace.stats.get("calib", 1.0))
        samples = np.asarray(trace.data, dtype=float) * acceleration_factor(declared)
        if trace.stats.get("_format") in _CALIBRATED_TO_DISPLACEMENT:
            if calibration not in (0.0, 1.0):
                doubts.append(Remark.of(Kind.CALIBRATION_NOT_APPLIED, factor=calibration))
        elif calibration != 1:
            samples = samples * calibration
            processing.append(
                f"Samples multiplied by the calibration that the trace states, {calibration:g}."
            )
        if "remove_sensitivity(" in " ".join(steps):  # which leaves the offset of the recorder in
            samples, sentence = without_offset(samples, "m/s2")
            processing.append(sentence)
            is_raw = all("remove_sensitivity(" in step or "trim(" in step for step in steps)
            fields["processed"] = False if is_raw else fields["processed"]
    fields |= {"processing": tuple(processing), "warnings": tuple(doubts)}
    source = Source(format="obspy", unit=declared or "m/s2")
    return Accelerogram(samples, float(trace.stats.delta), source=source, **directed(fields))


def _unit_of(
    trace: Any, unit: str | None, own: dict[str, Any], is_motion: bool, *, has_response: bool
) -> str | None:
    """Return the unit of a trace's samples, None where they are counts whose response is at hand.

    unit: as the caller declares it, which wins. own: what this program wrote into the trace. is_motion: its first
    samples were of acceleration. Raises RecordError for samples of velocity or displacement, and of no unit.
    """
    order, removed = quantity_order(trace)
    if order and (order > 0 or is_motion or unit is None):
        kinds = {1: "velocity", 2: "displacement"}
        kind = kinds.get(order, "the derivative of an acceleration")
        last = list(trace.stats.processing)[-1].partition("(")[0].split()[-1]
        raise RecordError(
            f"its processing by obspy, {last} at the end, leaves {kind}; give acceleration: "
            "remove_response(output='ACC')."
        )
    if unit is not None:
        return unit
    if not removed and (has_response or "response" in trace.stats):
        return None
    declared = "m/s2" if removed and order == 0 else own.get("unit")
    if declared is None and removed:
        declared = unit_left_by(trace)
    if declared is None:
        state = "its sensitivity removed" if removed else "neither a unit nor a response"
        raise RecordError(f"it has {state}; give unit= of its samples, or the inventory= of counts.")
    return str(declared)
