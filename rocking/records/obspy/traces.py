"""Traces of obspy: pieces joined, counts turned into acceleration by the response of their instrument."""

import os
import re
import tempfile
import warnings
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_factor, acceleration_unit
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import BURIED
from rocking.warnings import RockingWarning

_CORNERS = (0.02, 0.05, 0.8, 0.95)
"""Band in which a full response is removed: Hz, Hz, and shares of the Nyquist frequency."""


def joined(result: Any) -> Any:
    """Return the stream with the pieces of each channel joined, in the order in which the channels come.

    Raises RecordError at a gap, naming where it is.
    """
    order = list(dict.fromkeys(trace.id for trace in result))
    numeric = [trace for trace in result if trace.data.dtype.kind in "iuf"]
    result.traces = numeric or result.traces  # a recorder may log text next to its channels
    _level_rates(result)
    try:
        result = result.merge(method=0)
    except Exception as error:
        raise RecordError(
            f"the pieces of a channel do not join, {first_line(error)}.", channel=first_line(error)
        ) from error
    for trace in result:
        if trace.data.dtype.kind not in "iuf":
            raise RecordError(
                f"channel {trace.id} holds text and no samples; leave it out.", channel=trace.id
            )
        if np.ma.is_masked(trace.data):
            at = int(np.flatnonzero(np.ma.getmaskarray(trace.data))[0]) * trace.stats.delta
            raise RecordError(
                f"channel {trace.id} has a gap at {at:g} s; give a record without gaps.", channel=trace.id
            )
        trace.data = np.ma.getdata(trace.data)
    result.traces.sort(key=lambda trace: order.index(trace.id))  # which joining sorts by name
    return result


_DRIFT = 0.1
"""Samples by which the pieces of a channel whose rates are rounded otherwise may drift apart."""


def _level_rates(result: Any) -> None:
    """Give the pieces of each channel one rate where theirs differ by less than any of them could show."""
    first: dict[str, Any] = {}
    for trace in result:
        rate = first.setdefault(trace.id, trace).stats.sampling_rate
        drift = abs(trace.stats.sampling_rate - rate) * trace.stats.npts  # times the rate, which may be 0
        if 0 < drift < _DRIFT * rate:
            trace.stats.sampling_rate = rate


LARGEST_GAIN = 1e20
"""Counts per m/s² beyond which a sensitivity is damaged; the most sensitive seismometers have 1e10."""
_SAME_FREQUENCY = 0.01
_STAGES_AGREE = 0.05
"""Difference of the overall sensitivity from the product of its stages up to which the two are the same."""


def measured_as(units: str) -> tuple[str, int]:
    """Return the unit of acceleration that the input units of a response lead to, and by how many differentiations.

    "M/S**2" is ("m/s2", 0), "nm/s" is ("nm/s2", 1), "G" is ("g", 0). Raises RecordError for what is no motion.
    """
    name = units.lower().replace("nano", "n").replace("micro", "u").replace("gravity", "g")
    for order, rate in enumerate(("", "/s", "/s/s")):
        if unit := acceleration_unit(name.strip() + rate):
            return unit, order
    raise RecordError(
        f"the instrument of this channel measures {units!r}, which is no motion of the ground; use a channel of "
        "acceleration or velocity.",
        quantity=units,
    )


@dataclass(frozen=True, eq=False)
class Motion:
    """Samples (n,) of a trace in m/s² or a declared unit, how they came to it, and what is doubtful of them.

    is_levelled: whether their mean is removed as the offset of the recorder.
    """

    samples: np.ndarray
    processing: tuple[str, ...]
    warnings: tuple[RockingWarning, ...] = ()
    is_levelled: bool = False


def calibrated(trace: Any, inventory: Any, response: str) -> Motion:
    """Return what the counts of a trace are as acceleration.

    inventory: obspy's; None where the trace holds its response itself. Raises RecordError where none can be removed.
    """
    stats = trace.stats
    if inventory is not None:
        _check_epochs(trace, inventory)
    try:
        of = stats.response if inventory is None else inventory.get_response(trace.id, stats.starttime)
        units = str(of.instrument_sensitivity.input_units)
        gain = float(of.instrument_sensitivity.value)
    except Exception as error:
        raise RecordError(
            f"the StationXML holds no response of {trace.id} at {stats.starttime}.", inventory=trace.id
        ) from error
    unit, order = measured_as(units)
    first = next((str(stage.input_units) for stage in of.response_stages or () if stage.input_units), units)
    leads_to = str(of.instrument_sensitivity.output_units).upper()
    if leads_to in ("V", "VOLT", "VOLTS") or measured_as(first) != (unit, order):
        raise RecordError(
            f"the sensitivity of {trace.id} leads from {units} to {leads_to}, but its first stage measures {first}, "
            "and its samples are counts: the StationXML contradicts itself; ask the network which one holds.",
            inventory=trace.id,
        )
    factor = acceleration_factor(unit)
    warnings = _check_gain(gain, of, trace.id, response)
    staged = bool(getattr(of, "response_stages", None))
    if response == "sensitivity" and (order == 0 or (order == 1 and not staged)):
        return replace(_by_sensitivity(trace, gain / factor, order), warnings=warnings)
    if not staged:
        raise RecordError(
            f"the response of {trace.id} has no stages, of which its full removal consists; give a StationXML that has "
            "them, or take response: sensitivity.",
            response="stages",
        )
    if factor != 1:
        raise RecordError(
            f"the response of {trace.id} is in {units}, which its full removal does not convert; give a StationXML in "
            "M/S or M/S**2, or take response: sensitivity.",
            response=units,
        )
    return _by_response(trace, inventory)


def _channels_at(trace: Any, inventory: Any) -> Any:
    """Return the descriptions of a trace that hold at its start."""
    network, station, location, code = trace.id.split(".")
    return [
        channel
        for net in inventory
        if net.code == network
        for site in net
        if site.code == station
        for channel in site
        if (channel.code, channel.location_code) == (code, location)
        and channel.is_active(time=trace.stats.starttime)
    ]


def _check_epochs(trace: Any, inventory: Any) -> None:
    """Raise RecordError where a StationXML gives a channel two sensitivities or directions at one time."""
    said: dict[str, str] = {}
    for described in _channels_at(trace, inventory):
        if described.response and (of := described.response.instrument_sensitivity):
            points = f"azimuth {described.azimuth}, dip {described.dip}"
            words = f"{of.value:g} counts per {of.input_units}, {points}"
            said.setdefault(words, f"{words} (from {described.start_date})")
    if len(said) > 1:
        raise RecordError(
            f"the StationXML describes {trace.id} at {trace.stats.starttime} twice, as "
            f"{' and as '.join(said.values())}; take out the epoch that does not hold.",
            inventory=trace.id,
        )


_NO_ORIENTATION = re.compile(
    r"(?i)(orientation|orientaci[oó]n|azimuth)[^.;]*\b(not (known|surveyed|verified|reliable|measured)|"
    r"un(known|certain|verified|surveyed|reliable)|desconocid|incert|sconosciut)|"
    r"unknown (sensor )?(orientation|azimuth)"
)


def _by_sensitivity(trace: Any, per_unit: float, order: int) -> Motion:
    """Return the counts of a trace over the overall sensitivity; order: 1 where it is one of velocity, else 0."""
    counts = trace.data.astype(float)
    mean = counts.mean() / per_unit
    done = f"Counts divided by the overall sensitivity {per_unit:g}"
    if order == 0:
        return Motion(counts / per_unit - mean, (f"{done}, and their mean removed, {mean:.6g} m/s².",))
    motion = np.gradient(counts / per_unit - mean, trace.stats.delta)
    stays = "the response of the seismometer has no stages and stays"
    return Motion(motion, (f"{done} to a velocity, its mean removed, and differentiated; {stays}.",))


def _by_response(trace: Any, inventory: Any) -> Motion:
    """Return the counts of a trace without the full response of its instrument."""
    nyquist = trace.stats.sampling_rate / 2
    band = (_CORNERS[0], _CORNERS[1], _CORNERS[2] * nyquist, _CORNERS[3] * nyquist)
    try:
        with warnings.catch_warnings(), printed() as lines:
            warnings.simplefilter("ignore")
            how = {"output": "ACC", "pre_filt": band, "water_level": None}
            clean = trace.copy().remove_response(inventory=inventory, **how)
    except Exception as error:
        raise RecordError(
            f"the response of {trace.id} cannot be removed, {error}.", response=trace.id
        ) from error
    limits = " and ".join(f"{band[i]:g}-{band[i + 1]:g} Hz" for i in (0, 2))
    removed = f"full instrument response removed to acceleration between {limits}"
    is_unlike = any("sensitivities" in line for line in lines)
    unlike = (RockingWarning(RecordKind.SENSITIVITY_UNLIKE_STAGES, trace.id),) if is_unlike else ()
    return Motion(clean.data, (f"Mean removed, 5 % cosine taper, {removed}.",), unlike)


@contextmanager
def printed() -> Iterator[list[str]]:
    """Collect the lines that a library of C writes to the error output of the process, which name no file."""
    lines: list[str] = []
    try:
        before = os.dup(2)
    except OSError:  # a process without an error output
        yield lines
        return
    with tempfile.TemporaryFile() as output:
        os.dup2(output.fileno(), 2)
        try:
            yield lines
        finally:
            os.dup2(before, 2)
            os.close(before)
            output.seek(0)
            lines += output.read().decode("utf-8", "replace").splitlines()


def _check_gain(gain: float, response: Any, name: str, removal: str) -> tuple[RockingWarning, ...]:
    """Refuse a sensitivity that no instrument has, or that its own stages contradict at the frequency it is stated for.

    At another frequency than theirs it may differ, as a warning says; the full removal uses the stages alone.
    """
    if not 0 < abs(gain) < LARGEST_GAIN:
        raise RecordError(
            f"the overall sensitivity is {gain:g}, but must be above 0 and below {LARGEST_GAIN:g}; the StationXML is "
            "damaged: fetch it again.",
            sensitivity=gain,
        )
    staged = [stage for stage in response.response_stages or () if stage.stage_gain]
    product = float(np.prod([float(stage.stage_gain) for stage in staged])) if staged else gain
    off = abs(product / gain - 1)
    if removal == "full" or off <= _STAGES_AGREE:
        return ()
    at = response.instrument_sensitivity.frequency
    others = [stage.stage_gain_frequency for stage in staged if stage.stage_gain_frequency is not None]
    if at is not None and any(other > 0 and abs(other / at - 1) > _SAME_FREQUENCY for other in others if at):
        return (RockingWarning.of(RecordKind.SENSITIVITY_ELSEWHERE, name, at_hz=float(at), off=off),)
    raise RecordError(
        f"the overall sensitivity is {gain:g}, but the gains of its stages multiply to {product:g}, more than 5 % "
        "off: the StationXML contradicts itself; ask the network which one holds.",
        sensitivity=gain,
    )


STEEP = 45.0
"""Degrees out of the horizontal from which on a sensor is vertical."""
_TILTED = 5.0
"""Degrees out of the horizontal or the vertical from which on a sensor is reported as tilted."""


def site(trace: Any, inventory: Any) -> dict[str, Any]:
    """Return where a trace was recorded, as far as the inventory says it, as fields of an Accelerogram.

    Azimuth, latitude and longitude [degrees], elevation [m], whether it is vertical (by its dip) and down-hole; as its
    warnings whether it is tilted, and whether nobody knows its orientation: then the azimuth is left out.
    """
    facts: dict[str, Any] = {}
    with suppress(Exception):  # obspy raises what it likes for what is not there
        active = _channels_at(trace, inventory)
        said = " ".join(note.value for described in active for note in described.comments)
        is_unknown = bool(_NO_ORIENTATION.search(said))
        orientation = inventory.get_orientation(trace.id, trace.stats.starttime)
        dip = float(orientation.get("dip") or 0.0)
        warnings: tuple[RockingWarning, ...] = ()
        step, rate = float(trace.stats.delta), float(active[0].sample_rate or 0)
        if rate and abs(rate * step - 1) > _SAME_FREQUENCY and not trace.stats.get("processing"):
            warnings = (RockingWarning.of(RecordKind.RATE_UNLIKE_STEP, rate_hz=rate, time_step_s=step),)
        if is_unknown and abs(dip) <= STEEP:
            warnings = (*warnings, RockingWarning(RecordKind.ORIENTATION_UNKNOWN, trace.id))
        elif orientation.get("azimuth") is not None:
            facts["azimuth"] = float(orientation["azimuth"]) % 360
        if orientation.get("dip") is not None:
            facts["vertical"] = abs(dip) > STEEP
            if min(abs(dip), abs(90 - abs(dip))) > _TILTED:
                warnings = (*warnings, RockingWarning.of(RecordKind.TILTED, trace.id, dip_deg=dip))
        if warnings:
            facts["warnings"] = warnings
    with suppress(Exception):
        place = inventory.get_coordinates(trace.id, trace.stats.starttime)
        facts |= {name: float(place[name]) for name in ("latitude", "longitude", "elevation")}
        if float(place.get("local_depth") or 0.0) >= BURIED:
            facts["borehole"] = True
    return facts


_QUANTITIES = {"ACC": 0, "VEL": 1, "DISP": 2}


def quantity_order(trace: Any) -> tuple[int | None, bool]:
    """Return (how often the samples are integrated, or None where nothing says it; whether the response is removed).

    By what obspy has noted in `stats.processing`: 0 is acceleration, 1 velocity, 2 displacement, negative the others.
    """
    order: int | None = None
    removed = False
    for step in trace.stats.get("processing", ()):
        if "remove_response(" in step:
            output = re.search(r"output='?(\w+)'?", step)
            order = _QUANTITIES.get(output[1].upper() if output else "VEL", 1)
            removed = True
        elif "remove_sensitivity(" in step:
            removed = True
        elif "integrate(" in step:
            order = (order or 0) + 1
        elif "differentiate(" in step:
            order = (order or 0) - 1
    return order, removed


def unit_left_by(trace: Any) -> str | None:
    """Return the unit of samples over their sensitivity alone, by the response that is attached to the trace.

    None where none is attached, or it says nothing. Raises RecordError for velocity and displacement.
    """
    try:
        units = str(trace.stats.response.instrument_sensitivity.input_units)
        unit, order = measured_as(units)
    except (AttributeError, RecordError):
        return None
    if order:
        raise RecordError(
            f"its sensitivity was removed, which leaves {units}; give acceleration: remove_response(output='ACC').",
            quantity=units,
        )
    return unit


def first_line(error: object) -> str:
    """Return the first line of what an error says, without the point at its end."""
    return (str(error).strip().splitlines() or [type(error).__name__])[0].rstrip(".")[:200]


def names(trace: Any) -> dict[str, str]:
    """Return component, station, network, location and start of a trace, as fields of an Accelerogram."""
    stats = trace.stats
    start = {"start_time": str(stats.starttime)} if stats.starttime.timestamp else {}
    return {"component": stats.channel} | {k: stats[k] for k in ("station", "network", "location")} | start
