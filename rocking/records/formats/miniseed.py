"""miniSEED counts, turned into acceleration by the StationXML that describes the instrument."""

import io
import re
import warnings
from pathlib import Path

from rocking.errors import RecordError, UndeclaredError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.binary import stream
from rocking.records.formats.format import Format, Options
from rocking.records.traces import calibrated, joined, site

_FIXED_HEADER = re.compile(rb"[0-9 \0]{6}[DRQM][ \0]")
_LARGEST_XML = 32 * 2**20


def _recognise(content: bytes) -> bool:
    return len(content) >= 128 and bool(_FIXED_HEADER.match(content))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    result, noticed = stream(content, "MSEED")
    result = joined(result)
    inventory = _inventory(result[0].stats, options)
    records = []
    for trace in result:
        stats = trace.stats
        done: tuple[str, ...] = ()
        if inventory is None:
            values, unit = trace.data.astype(float), options.unit_of(None)
        else:
            values, sentence = calibrated(trace, inventory, options.response)
            unit, done = "m/s2", (sentence,)
        step = float(f"{stats.delta:.9g}")
        records.append(
            options.accelerogram(
                unit, values, step, warnings=noticed, **site(trace, inventory), processing=done,
                component=stats.channel, station=stats.station, network=stats.network, location=stats.location,
                start_time=str(stats.starttime),
            )
        )  # fmt: skip
    return records


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


MINISEED = Format("miniSEED", "FDSN data centres", "miniSEED fixed header (six digits, then D, R, Q or M)",
    _recognise, _read)  # fmt: skip
STATIONXML = Format("StationXML", "FDSN data centres", "FDSNStationXML element", _is_inventory, _refuse)
