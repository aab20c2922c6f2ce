"""miniSEED counts, turned into acceleration by the StationXML that describes the instrument."""

import io
import re
import warnings
from pathlib import Path

from rocking.errors import RecordError, UndeclaredError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.binary import joined, stream
from rocking.records.formats.format import Format, Options

_FIXED_HEADER = re.compile(rb"[0-9 \0]{6}[DRQM][ \0]")
_LARGEST_XML = 32 * 2**20
_CORNERS = (0.02, 0.05, 0.8, 0.95)
"""Band in which a full response is removed: Hz, Hz, and shares of the Nyquist frequency."""


def _recognise(content: bytes) -> bool:
    return len(content) >= 128 and bool(_FIXED_HEADER.match(content))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    result, noticed = stream(content, "MSEED")
    result = joined(result)
    inventory = _inventory(result[0].stats, options)
    if inventory is None:
        options.unit_of(None)
    return [_record(trace, inventory, options, noticed) for trace in result]


def _record(trace, inventory, options: Options, noticed: tuple[str, ...]) -> Accelerogram:
    stats = trace.stats
    values, unit, steps = _calibrated(trace, inventory, options)
    return options.accelerogram(
        unit,
        values,
        float(f"{stats.delta:.9g}"),
        component=stats.channel,
        station=stats.station,
        network=stats.network,
        location=stats.location,
        start_time=str(stats.starttime),
        processing=steps,
        warnings=noticed,
        azimuth=_orientation(trace, inventory),
    )


def _calibrated(trace, inventory, options: Options):
    """Return (values, unit, processing sentences): by declared unit, by sensitivity, or by the full response."""
    data = trace.data.astype(float)
    if inventory is None:
        return data, options.unit_of(None), ()
    try:
        response = inventory.get_response(trace.id, trace.stats.starttime)
        sensitivity = response.instrument_sensitivity
        measured, gain = sensitivity.input_units.upper(), float(sensitivity.value)
    except Exception as error:
        raise RecordError(
            f"the StationXML holds no response of {trace.id} at {trace.stats.starttime}."
        ) from error
    if options.response == "sensitivity" and measured in ("M/S**2", "M/S/S", "M/S^2") and gain:
        mean = data.mean() / gain
        step = f"Counts divided by the overall sensitivity {gain:g}, and their mean removed, {mean:.6g} m/s²."
        return data / gain - mean, "m/s2", (step,)
    return _deconvolved(trace, inventory)


def _deconvolved(trace, inventory):
    nyquist = trace.stats.sampling_rate / 2
    band = (_CORNERS[0], _CORNERS[1], _CORNERS[2] * nyquist, _CORNERS[3] * nyquist)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            clean = trace.copy().remove_response(
                inventory=inventory, output="ACC", pre_filt=band, water_level=None
            )
    except Exception as error:
        raise RecordError(f"the response of {trace.id} cannot be removed, {error}.") from error
    step = (
        "Mean removed, 5 % cosine taper, full instrument response removed to acceleration between "
        + " and ".join(f"{band[i]:g}-{band[i + 1]:g} Hz" for i in (0, 2))
    )
    return clean.data, "m/s2", (step + ".",)


def _orientation(trace, inventory) -> float | None:
    try:
        value = inventory.get_orientation(trace.id, trace.stats.starttime)["azimuth"]
        return float(value) % 360
    except Exception:
        return None


def _inventory(stats, options: Options):
    """Return the inventory given, else the one in the folder that names this network and station, or None."""
    if options.inventory is not None:
        return _parse(options.inventory)
    if options.unit is not None or options.folder is None:
        return None
    found = [
        path for path in sorted(options.folder.glob("*.xml")) if _names(path, stats.network, stats.station)
    ]
    if len(found) != 1:
        several = f"several do: {', '.join(p.name for p in found)}" if found else "none beside it does"
        raise UndeclaredError(
            f"no single StationXML describes {stats.network}.{stats.station} ({several}); "
            "give inventory=, or unit= if the samples are already acceleration."
        )
    return _parse(found[0])


def _names(path: Path, network: str, station: str) -> bool:
    if not path.is_file() or path.stat().st_size > _LARGEST_XML:
        return False
    text = path.read_bytes().decode("utf-8", "replace")
    station_code = re.search(rf'<(\w+:)?Station\b[^>]*\bcode="{re.escape(station)}"', text)
    return "FDSNStationXML" in text[:2000] and f'code="{network}"' in text and station_code is not None


def _parse(path: Path):
    from obspy import read_inventory

    try:
        content = path.read_bytes() if path.stat().st_size <= _LARGEST_XML else b""
    except OSError as error:
        raise RecordError(f"the StationXML {path.name} cannot be opened, {error.strerror}.") from error
    if b"FDSNStationXML" not in content[:2000] or b"<!DOCTYPE" in content:
        raise RecordError(f"{path.name} is not a plain StationXML file of less than 32 MB; give one.")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read_inventory(io.BytesIO(content), format="STATIONXML")
    except Exception as error:
        raise RecordError(f"damaged StationXML {path.name}, {str(error)[:200]}.") from error


def _is_inventory(content: bytes) -> bool:
    return b"<FDSNStationXML" in content[:2000]


def _refuse(content: bytes, options: Options) -> list[Accelerogram]:
    raise RecordError(
        "a StationXML describes an instrument and holds no samples; read the miniSEED beside it."
    )


MINISEED = Format(
    "miniSEED",
    "FDSN data centres",
    "miniSEED fixed header (six digits, then D, R, Q or M)",
    _recognise,
    _read,
)
STATIONXML = Format("StationXML", "FDSN data centres", "FDSNStationXML element", _is_inventory, _refuse)
