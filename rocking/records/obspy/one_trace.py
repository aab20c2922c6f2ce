"""Traces of obspy as accelerograms: the same whether obspy read the file or this package did."""

from collections.abc import Iterator
from typing import Any, Literal, get_args

import numpy as np

from rocking.errors import RecordError, UndeclaredError, about
from rocking.quantities import GRAVITY, acceleration_factor
from rocking.records.claims import of_another
from rocking.records.direction import Direction, directed
from rocking.records.formats.format import plain, without_offset
from rocking.records.formats.text import LARGEST_SERIES
from rocking.records.kinds import RecordKind
from rocking.records.obspy.traces import STEEP, Motion, calibrated, names, quantity_order, site, unit_left_by
from rocking.records.plausibility import BURIED
from rocking.signal.accelerogram import OBSPY_EXTRAS, SAME_STEP, Accelerogram, Source
from rocking.warnings import RockingWarning

Calibration = Literal["apply", "done"]
"""Whether the samples of a trace are still to be multiplied by its calibration, or are: obspy never resets it."""
_TO_DISPLACEMENT = "GSE1", "GSE2", "CSS", "NNSA_KB_CORE"
"""The formats whose calibration is in nm of displacement a count, at a period that it is stated for."""
_OBSPY_G = 9.81
"""m/s²; with which obspy turns the sensitivity of a Kinemetrics recorder in V/g into V/(m/s²)."""
_CALIBRATED_TO = {"KNET": "gal", "KINEMETRICS_EVT": "m/s2"}
"""The formats whose calibration leads to an acceleration, and the unit that it is taken in."""
_RAW = (*_CALIBRATED_TO, "SAC")
"""The formats of one recorder's numbers, from whose mean its offset is known."""
_DIRECTED = ("component", "azimuth", "vertical")
"""The facts that a rotation makes untrue."""
_UNDEFINED = -12345.0
"""What a SAC header holds where it says nothing."""
_OTHER_SAC = {6: "displacement", 7: "velocity"}
"""Kinds of the dependent variable, `idep`, that are no acceleration (SAC manual: IDISP, IVEL)."""
_PLACE = {"latitude": "stla", "longitude": "stlo", "elevation": "stel"}
_COMPONENTS = "XYZ"


def from_traces(
    traces: Any, inventory: Any, unit: str | None, response: str, calibration: Calibration | None
) -> list[Accelerogram]:
    """Return the accelerogram of each of several traces without gaps, with what lets them be none of one record."""
    records = []
    for trace in traces:
        with about(trace.id):
            records.append(_from_trace(trace, inventory, unit, response, calibration))
    warnings = tuple(_unlike(records))
    return [record.warned(*warnings) for record in records]


def _unlike(records: list[Accelerogram]) -> Iterator[RockingWarning]:
    """Yield what lets the channels of a stream be none of one record: several stations, or several time steps."""
    stations = sorted({f"{record.network}.{record.station}" for record in records})
    if len(stations) > 1:
        yield RockingWarning.of(
            RecordKind.STATIONS_UNLIKE, stations=", ".join(stations[:3]), number=len(stations)
        )
    steps = [record.time_step for record in records]
    if max(steps) > min(steps) * (1 + SAME_STEP):
        yield RockingWarning.of(RecordKind.STEPS_OF_STREAM_UNLIKE, least_s=min(steps), most_s=max(steps))


# Whole on purpose: what is known of the samples, what is asked, and what is done to them, each from the one before.
def _from_trace(
    trace: Any, inventory: Any, unit: str | None, response: str, calibration: Calibration | None
) -> Accelerogram:
    """Return the accelerogram of one trace without gaps; the arguments are those of from_obspy.

    Raises RecordError for velocity and displacement, and UndeclaredError where nothing says what the samples are.
    """
    stats = trace.stats
    if stats.npts > LARGEST_SERIES:
        raise RecordError(
            f"it holds {stats.npts} samples, more than {LARGEST_SERIES}; cut the motion out of it first.",
            samples=stats.npts,
        )
    form = str(stats.get("_format", ""))
    own = dict(stats.get("rocking", {}))
    steps = list(stats.get("processing", ()))
    if own and own.get("component") != stats.channel:
        own = {name: value for name, value in own.items() if name not in _DIRECTED}
    is_motion = bool(own) or "output=" in " ".join(steps)  # what was integrated or differentiated is known
    declared = _unit_of(trace, unit, own, is_motion, has_response=inventory is not None)
    is_due = not quantity_order(trace)[1] and _is_due(trace, calibration, is_counts=declared is None)
    is_raw = all("remove_sensitivity(" in step or "trim(" in step for step in steps)
    of_file = form in _OF_FILES and is_raw
    fields: dict[str, Any] = {"processed": False if declared is None or of_file else None}
    fields |= names(trace) | header(trace)
    fields |= {name: own[name] for name in OBSPY_EXTRAS if name in own}
    place = site(trace, inventory)
    warnings = [*fields.get("warnings", ()), *place.pop("warnings", ())]
    fields |= place
    done = *fields.get("processing", ()), *(f"obspy: {step}"[:200] for step in steps)
    if declared is None:
        motion, factor = calibrated(trace, inventory, response), 1.0
    else:
        motion, factor = as_stated(trace, declared, is_due), acceleration_factor(declared)
    if motion.is_levelled and is_raw:
        fields["processed"] = False
    fields |= {"processing": (*done, *motion.processing), "warnings": (*warnings, *motion.warnings)}
    fields = {name: plain(value) if isinstance(value, str) else value for name, value in fields.items()}
    source = Source(format="obspy", unit=declared or "m/s2")
    # A step of single precision is stored as 0.0199999996, and that of a rate as 0.0100000000001.
    step = float(f"{stats.delta:.{6 if form == 'SAC' else 9}g}")
    fields = directed(fields)
    if RecordKind.ORIENTATION_UNKNOWN in {warning.kind for warning in warnings}:
        fields["azimuth"] = None  # nor does the code of the channel say it
    return Accelerogram(motion.samples * factor, step, source=source, **fields)


def as_stated(trace: Any, unit: str, is_due: bool) -> Motion:
    """Return the samples of a trace that are in `unit`; is_due: once they are multiplied by its calibration."""
    form = str(trace.stats.get("_format", ""))
    order, is_removed = quantity_order(trace)
    factor = float(trace.stats.get("calib", 1.0))
    samples = np.asarray(trace.data, dtype=float)
    warnings: tuple[RockingWarning, ...] = ()
    if form == "KNET" and unit == "gal" and not is_removed:
        samples = samples * (100 * factor if is_due else 100.0)  # of m/s²
    elif is_due:
        samples = samples * factor
        warnings = (
            () if form in _CALIBRATED_TO else (RockingWarning.of(RecordKind.SCALE_APPLIED, factor=factor),)
        )
    elif form in _TO_DISPLACEMENT and factor != 1 and not is_removed:
        warnings = (RockingWarning.of(RecordKind.CALIBRATION_NOT_APPLIED, factor=factor),)
    if form == "KINEMETRICS_EVT" and not is_removed:
        samples = samples * (GRAVITY / _OBSPY_G)
    done = [str(warning) for warning in warnings if warning.kind is RecordKind.SCALE_APPLIED]
    # To remove the sensitivity leaves the offset of the recorder in.
    is_levelled = form in _RAW if not is_removed else order is None
    if is_levelled:
        samples, sentence = without_offset(samples, unit)
        done.append(sentence)
    return Motion(samples, tuple(done), warnings, is_levelled)


_OF_FILES = (*_RAW, *_TO_DISPLACEMENT, "MSEED", "SLIST", "TSPAIR", "WIN", "SEISAN", "REFTEK130")
"""The formats of recorders, whose numbers nobody has corrected."""


def _is_due(trace: Any, calibration: Calibration | None, is_counts: bool) -> bool:
    """Return whether the samples are still to be multiplied by the calibration of their trace.

    is_counts: a response turns them into acceleration, in place of a calibration. Raises UndeclaredError where nothing
    says whether they are multiplied already, and RecordError where counts are.
    """
    if calibration not in (None, *get_args(Calibration)):
        raise RecordError(
            f"calibration is {calibration!r}, but must be 'apply' or 'done'.", calibration=calibration
        )
    factor = float(trace.stats.get("calib", 1.0))
    form = str(trace.stats.get("_format", ""))
    if factor == 1 or (form in _TO_DISPLACEMENT and not is_counts):
        return False
    is_whole = trace.data.dtype.kind in "iu" or not np.any(np.mod(trace.data, 1.0))
    if is_whole and factor % 1:  # no factor has touched whole numbers
        return not is_counts
    if calibration is None:
        raise UndeclaredError(
            f"its calibration is {factor:g}, and nothing says whether its samples are multiplied by that: obspy leaves "
            "the number where apply_calib=True has used it; give calibration='apply' or 'done' to rocking.from_obspy.",
            calibration=None,
        )
    if is_counts and calibration == "done":
        raise RecordError(
            f"its samples are multiplied by the calibration {factor:g}, and are no counts, as the response is of; read "
            "the file without apply_calib, or give unit= and no inventory.",
            calibration=calibration,
        )
    return calibration == "apply" and not is_counts


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
            "remove_response(output='ACC').",
            quantity=kind,
        )
    calibrated_to = "" if removed else _CALIBRATED_TO.get(str(trace.stats.get("_format", "")), "")
    if unit is not None:
        if calibrated_to and acceleration_factor(unit) not in (1.0, acceleration_factor(calibrated_to)):
            raise RecordError(
                f"unit is {unit!r}, but the calibration of this format leads to m/s²; omit it.", unit=unit
            )
        if own.get("unit") and acceleration_factor(unit) != acceleration_factor(own["unit"]):
            raise RecordError(
                f"unit is {own['unit']!r} in the trace, but {unit!r} was declared; omit it.", unit=unit
            )
        return calibrated_to or unit
    if not removed and (has_response or "response" in trace.stats):
        return None
    declared = "m/s2" if removed and order == 0 else own.get("unit") or calibrated_to or None
    if declared is None and removed:
        declared = unit_left_by(trace)
    if declared is None:
        state = "its sensitivity removed" if removed else "neither a unit nor a response"
        raise RecordError(
            f"it has {state}; give unit= of its samples, or the inventory= of counts.", unit=None
        )
    return str(declared)


def header(trace: Any) -> dict[str, Any]:
    """Return what the header of a file says of a trace beyond what obspy calls the same in all, as fields of a record.

    Raises RecordError where it says that the samples are no acceleration.
    """
    form = str(trace.stats.get("_format", ""))
    if form == "SAC" and "sac" in trace.stats:
        return _of_sac(trace.stats)
    if form == "KNET" and "knet" in trace.stats:
        return _of_knet(trace.stats)
    if form == "KINEMETRICS_EVT":
        return _of_evt(trace.stats)
    name = str(trace.stats.channel)
    is_number = name.isdigit() and len(name) == 1  # of a channel, and no azimuth
    named: dict[str, Any] = {"component": f"channel {name}", "azimuth": None} if is_number else {}
    if form == "WIN":  # whose channels have numbers and no directions
        component = named.get("component", name)
        named["warnings"] = (RockingWarning(RecordKind.DIRECTION_UNKNOWN, component),)
    return named


def stated_by_sac(stats: Any) -> dict[str, float]:
    """Return the numbers that a SAC header states, by their keys."""
    numbers = {key: float(x) for key, x in stats.sac.items() if isinstance(x, np.floating | float)}
    return {key: value for key, value in numbers.items() if value != _UNDEFINED}


def _of_sac(stats: Any) -> dict[str, Any]:
    if quantity := _OTHER_SAC.get(int(stats.sac.get("idep", 0))):
        raise of_another(quantity)
    header = stated_by_sac(stats)
    is_as_read = not stats.get("processing") and stats.npts == stats.sac.get("npts")
    if is_as_read and f"{stats.delta:.6g}" == f"{header.get('delta', 0.0):.6g}":
        _check_end(header, stats.npts, float(f"{stats.delta:.6g}"))
    facts: dict[str, Any] = {name: header[key] for name, key in _PLACE.items() if key in header}
    facts |= _sac_direction(header, stats.channel)
    if header.get("stdp", 0.0) >= BURIED:
        facts["borehole"] = True
    return facts


def _check_end(header: dict[str, float], samples: int, step: float) -> None:
    """Raise RecordError where the samples of a SAC file end elsewhere than its header states."""
    begin = header.get("b", 0.0)
    end = header.get("e", 0.0)
    # Single precision keeps seven digits of the times.
    allowed = 0.5 * step + 3e-7 * max(abs(begin), abs(end))
    if {"b", "e"} <= header.keys() and begin != end and abs(end - begin - step * (samples - 1)) > allowed:
        stated = f"the header states an end at {end:g} s, but {samples} samples every {step:g} s"
        raise RecordError(
            f"{stated} from {begin:g} s end elsewhere; the file is damaged; fetch it again.", e=end
        )


def _sac_direction(header: dict[str, float], component: str) -> dict[str, Any]:
    """Return where a SAC header lets a channel point: azimuth [degrees] and whether it is vertical, as far as it says.

    Zeros for both, in a channel called north or east, are those of a program that sets neither: they say nothing.
    """
    angle, inclination = (header.get(key, _UNDEFINED) for key in ("cmpaz", "cmpinc"))
    if angle == 0 == inclination and Direction.of(component).azimuth in (0.0, 90.0):
        return {}
    facts: dict[str, Any] = {"azimuth": angle % 360} if abs(angle) <= 360 else {}
    if inclination != _UNDEFINED:  # degrees from upwards: 0 and 180 are vertical, 90 is horizontal
        facts["vertical"] = abs(inclination % 180 - 90) > STEEP
    return facts


_OF_KNET = {"NS": "N-S", "EW": "E-W", "UD": "U-D"}
"""The directions of K-NET as its files write them."""


def _of_knet(stats: Any) -> dict[str, Any]:
    """Sensors 1 to 3 of KiK-net, which obspy calls NS1 to UD1, are down the borehole; NS2 to UD2 are at the surface."""
    name = str(stats.channel)
    component = _OF_KNET.get(name, name.rstrip("12"))
    facts: dict[str, Any] = {"component": component, "borehole": name.endswith("1")}
    facts["start_time"] = f"{stats.starttime.datetime.isoformat()}Z"
    facts |= {field: float(stats.knet[key]) for field, key in _PLACE.items() if key in stats.knet}
    return facts


def _of_evt(stats: Any) -> dict[str, Any]:
    place = int(stats.channel) if str(stats.channel).isdigit() else 0
    name = str(stats.get("kinemetrics_evt", {}).get("chan_id", "")).strip() or _COMPONENTS[place % 3]
    facts: dict[str, Any] = {"component": name, "event": str(stats.starttime)[:10]}
    facts["vertical"] = name.upper() in ("Z", "V", "UP") or place == 2
    return facts
