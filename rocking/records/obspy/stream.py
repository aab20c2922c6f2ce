"""Streams of obspy as accelerograms, through the same checks as files."""

from typing import Any

from rocking.errors import RecordError
from rocking.records.obspy.one_trace import Calibration, from_traces
from rocking.records.obspy.traces import joined
from rocking.records.read import checked_channels
from rocking.signal.accelerogram import Accelerogram


def from_obspy(
    trace_or_stream: Any,
    inventory: Any = None,
    unit: str | None = None,
    response: str = "sensitivity",
    calibration: Calibration | None = None,
) -> list[Accelerogram]:
    """Return an accelerogram for each channel of an obspy Trace or Stream, in the order of its channels.

    Every check of `read` is made, and the record is the one that `read` gives of the same file. What obspy has noted of
    the processing is read: samples whose response was removed to acceleration are in m/s².

    Parameters
    ----------
    trace_or_stream : object
        Obspy Trace or Stream.
    inventory : object, optional
        StationXML, as obspy reads it; None: the response attached to the trace, or the samples are in `unit`.
    unit : str or None, optional
        Unit of samples that are acceleration already, such as "m/s2", which wins over a response; None: as the
        inventory says.
    response : str, default 'sensitivity'
        "sensitivity" divides counts by the overall sensitivity; "full" removes the whole instrument response.
    calibration : {'apply', 'done'} or None, optional
        Whether the samples are still to be multiplied by the calibration of the trace ("apply"), or are so
        already ("done"); None where that follows from the trace.

    Returns
    -------
    list of Accelerogram
        One accelerogram a channel.

    Raises
    ------
    RecordError
        For a gap, for velocity and displacement, where nothing says what the samples are, and where nothing
        says whether they are multiplied by the calibration of the trace.

    Examples
    --------
    >>> from obspy import Trace
    >>> rocking.from_obspy(Trace(np.sin(np.arange(9.0)), {"channel": "HNZ"}), unit="m/s2")[0].vertical
    True
    """
    from obspy import Stream, Trace  # which takes a second to import

    stream = Stream([trace_or_stream] if isinstance(trace_or_stream, Trace) else trace_or_stream).copy()
    if not stream:
        raise RecordError("the stream holds no trace; give one with acceleration.", stream=0)
    return checked_channels(from_traces(joined(stream), inventory, unit, response, calibration))
