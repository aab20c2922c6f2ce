"""The formats that obspy reads: opened from bytes we have recognised, under a name we give, never guessed."""

import io
import warnings

import numpy as np

from rocking.errors import RecordError


def stream(content: bytes, form: str, name: str, **options):
    """Return obspy's Stream of `content` in the obspy format `form`, and the warnings that were raised on the way.

    Raises RecordError for whatever obspy raises, and when nothing is in the file.
    """
    import obspy

    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        try:
            result = obspy.read(io.BytesIO(content), format=form, check_compression=False, **options)
        except Exception as error:
            raise RecordError(
                f"{name}: damaged {form} file, {_first_line(error)}; fetch it again."
            ) from error
    if not any(trace.stats.npts for trace in result):
        raise RecordError(f"{name}: the {form} file holds no samples.")
    return result, tuple(sorted({f"obspy: {_first_line(w.message)}." for w in caught}))


def joined(result, name: str):
    """Return the stream with the pieces of each channel joined. Raises RecordError at a gap, naming where it is."""
    try:
        result = result.merge(method=0)
    except Exception as error:
        raise RecordError(f"{name}: the pieces of a channel do not join, {_first_line(error)}.") from error
    for trace in result:
        if np.ma.is_masked(trace.data):
            at = int(np.flatnonzero(np.ma.getmaskarray(trace.data))[0]) * trace.stats.delta
            raise RecordError(
                f"{name}: channel {trace.id} has a gap at {at:g} s; give a record without gaps."
            )
        trace.data = np.ma.getdata(trace.data)
    return result


def _first_line(error) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0].rstrip(".")[:200]
