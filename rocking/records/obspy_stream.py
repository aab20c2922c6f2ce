"""Streams of obspy as accelerograms, through the same checks as files."""

from typing import Any

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram, Calibration
from rocking.records.one_trace import from_traces
from rocking.records.read import checked_channels
from rocking.records.traces import joined


def from_obspy(
    trace_or_stream: Any,
    inventory: Any = None,
    unit: str | None = None,
    response: str = "sensitivity",
    calibration: Calibration | None = None,
) -> list[Accelerogram]:
    """Return an accelerogram for each channel of an obspy Trace or Stream, as `Accelerogram.from_obspy` does.

    Raises RecordError for a gap, for velocity and displacement, where nothing says what the samples are, and where
    nothing says whether they are multiplied by the calibration of the trace.

    >>> from obspy import Trace
    >>> rocking.from_obspy(Trace(np.sin(np.arange(9.0)), {"channel": "HNZ"}), unit="m/s2")[0].vertical
    True
    """
    from obspy import Stream, Trace  # which takes a second to import

    stream = Stream([trace_or_stream] if isinstance(trace_or_stream, Trace) else trace_or_stream).copy()
    if not stream:
        raise RecordError("the stream holds no trace; give one with acceleration.")
    return checked_channels(from_traces(joined(stream), inventory, unit, response, calibration))
