"""The formats that obspy reads: opened from bytes we have recognised, by the format we name, never guessed."""

import io
import re
import warnings

import numpy as np

from rocking.errors import RecordError
from rocking.records.formats.sampling import LARGEST_SERIES

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
            raise RecordError(f"damaged {form} file, {_first_line(error)}; fetch it again.") from error
    if form == "MSEED" and (damage := [w for w in caught if _DAMAGE.search(str(w.message))]):
        raise RecordError(f"damaged {form} file, {_first_line(damage[0].message)}; fetch it again.")
    if not any(trace.stats.npts for trace in result):
        raise RecordError(f"the {form} file holds no samples.")
    return result, tuple(sorted({f"obspy: {_first_line(w.message)}." for w in caught}))


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
        raise RecordError(f"damaged {form} file, {_first_line(error)}; fetch it again.") from error
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


def joined(result):
    """Return the stream with the pieces of each channel joined. Raises RecordError at a gap, naming where it is."""
    try:
        result = result.merge(method=0)
    except Exception as error:
        raise RecordError(f"the pieces of a channel do not join, {_first_line(error)}.") from error
    for trace in result:
        if np.ma.is_masked(trace.data):
            at = int(np.flatnonzero(np.ma.getmaskarray(trace.data))[0]) * trace.stats.delta
            raise RecordError(f"channel {trace.id} has a gap at {at:g} s; give a record without gaps.")
        trace.data = np.ma.getdata(trace.data)
    return result


def _first_line(error) -> str:
    return (str(error).strip().splitlines() or [type(error).__name__])[0].rstrip(".")[:200]
