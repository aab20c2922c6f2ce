"""Traces of obspy: pieces joined, counts turned into acceleration by the response of their instrument."""

import warnings
from contextlib import suppress
from typing import Any

import numpy as np

from rocking.errors import RecordError

_CORNERS = (0.02, 0.05, 0.8, 0.95)
"""Band in which a full response is removed: Hz, Hz, and shares of the Nyquist frequency."""


def joined(result: Any) -> Any:
    """Return the stream with the pieces of each channel joined. Raises RecordError at a gap, naming where it is."""
    try:
        result = result.merge(method=0)
    except Exception as error:
        raise RecordError(f"the pieces of a channel do not join, {first_line(error)}.") from error
    for trace in result:
        if np.ma.is_masked(trace.data):
            at = int(np.flatnonzero(np.ma.getmaskarray(trace.data))[0]) * trace.stats.delta
            raise RecordError(f"channel {trace.id} has a gap at {at:g} s; give a record without gaps.")
        trace.data = np.ma.getdata(trace.data)
    return result


def calibrated(trace: Any, inventory: Any, response: str) -> tuple[np.ndarray, str]:
    """Return (acceleration (n,) m/s², the sentence that says how) of a trace of counts.

    inventory: obspy's; None where the trace holds its response itself. Raises RecordError where none can be removed.
    """
    stats = trace.stats
    try:
        of = stats.response if inventory is None else inventory.get_response(trace.id, stats.starttime)
        measured = of.instrument_sensitivity.input_units.upper()
        gain = float(of.instrument_sensitivity.value)
    except Exception as error:
        raise RecordError(f"the StationXML holds no response of {trace.id} at {stats.starttime}.") from error
    if response == "sensitivity" and measured in ("M/S**2", "M/S/S", "M/S^2") and gain:
        counts = trace.data.astype(float)
        mean = counts.mean() / gain
        step = f"Counts divided by the overall sensitivity {gain:g}, and their mean removed, {mean:.6g} m/s²."
        return counts / gain - mean, step
    nyquist = stats.sampling_rate / 2
    band = (_CORNERS[0], _CORNERS[1], _CORNERS[2] * nyquist, _CORNERS[3] * nyquist)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            how = {"output": "ACC", "pre_filt": band, "water_level": None}
            clean = trace.copy().remove_response(inventory=inventory, **how)
    except Exception as error:
        raise RecordError(f"the response of {trace.id} cannot be removed, {error}.") from error
    limits = " and ".join(f"{band[i]:g}-{band[i + 1]:g} Hz" for i in (0, 2))
    removed = f"full instrument response removed to acceleration between {limits}"
    return clean.data, f"Mean removed, 5 % cosine taper, {removed}."


def site(trace: Any, inventory: Any) -> dict[str, float]:
    """Return azimuth, latitude, longitude [degrees] and elevation [m] of a trace, as far as the inventory has them."""
    facts = {}
    with suppress(Exception):  # obspy raises what it likes for what is not there
        facts["azimuth"] = float(inventory.get_orientation(trace.id, trace.stats.starttime)["azimuth"]) % 360
    with suppress(Exception):
        place = inventory.get_coordinates(trace.id, trace.stats.starttime)
        facts |= {name: float(place[name]) for name in ("latitude", "longitude", "elevation")}
    return facts


def first_line(error: object) -> str:
    """Return the first line of what an error says, without the point at its end."""
    return (str(error).strip().splitlines() or [type(error).__name__])[0].rstrip(".")[:200]


def names(trace: Any) -> dict[str, str]:
    """Return component, station, network, location and start of a trace, as fields of an Accelerogram."""
    stats = trace.stats
    start = {"start_time": str(stats.starttime)} if stats.starttime.timestamp else {}
    return {"component": stats.channel} | {k: stats[k] for k in ("station", "network", "location")} | start
