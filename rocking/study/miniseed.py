"""The processed motion of a record as miniSEED, to the last bit: what one step of a study hands to the next."""

import io
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from rocking.signal.accelerogram import Accelerogram


def miniseed_of(channels: Sequence[Accelerogram]) -> bytes:
    """Return the samples of channels, m/s², as 64-bit floats of miniSEED, in their order; no bytes of none.

    A station is cut to its first five letters, and channels are HN1, HN2, ... or HNZ: names have little room there.
    """
    from obspy import Stream, Trace, UTCDateTime  # which takes a second to import

    stream = Stream()
    for place, channel in enumerate(channels, start=1):
        header = {"delta": channel.time_step, "channel": "HNZ" if channel.vertical else f"HN{place}"}
        header["station"] = "".join(c for c in channel.station.upper() if c.isascii() and c.isalnum())[:5]
        if channel.start_time:
            header["starttime"] = UTCDateTime(channel.start_time)
        stream.append(Trace(np.array(channel.acceleration), header=header))
    buffer = io.BytesIO()
    if channels:
        stream.write(buffer, format="MSEED", encoding="FLOAT64")
    return buffer.getvalue()


def look_for_readers() -> None:
    """Let obspy look for what reads and writes miniSEED, once for this process and those that are forked from it."""
    from obspy import read

    read(io.BytesIO(miniseed_of([Accelerogram(np.zeros(2), 0.01)])), format="MSEED")


def samples_in(path: Path) -> list[np.ndarray]:
    """Return the samples of each channel in a file that holds what `miniseed_of` gave."""
    from obspy import read

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return [trace.data for trace in read(str(path), format="MSEED")]
