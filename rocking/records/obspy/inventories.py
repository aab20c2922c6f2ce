"""Inventories: the descriptions of instruments that turn counts into acceleration, found and parsed once."""

import io
import re
import warnings
from collections.abc import Sequence
from contextlib import suppress
from functools import lru_cache
from pathlib import Path
from typing import Any

from rocking.errors import RecordError, UndeclaredError
from rocking.records.doors import advice
from rocking.records.formats.format import Options
from rocking.tables import read_whole

_LARGEST_XML = 32 * 2**20
"""Bytes."""
DATALESS = rb"\d{6}V "
RESP = rb"(#.*\n)*B05\dF\d\d\b|#\s*<+\s*IRIS SEED Reader"
SACPZ = rb"(\*.*\n)*\s*(ZEROS|POLES|CONSTANT)\s+-?\d"
"""The first characters of what describes instruments other than StationXML."""


def inventory_for(stats: Any, options: Options) -> Any:
    """Return the inventory given, else the one in the folder that names this network and station, or None.

    Raises RecordError where a unit is given as well, UndeclaredError where none is found.
    """
    if options.inventory is not None and options.unit is not None:
        counts = f"unit is {options.unit!r}, but by the inventory they are counts; omit one of the two."
        raise RecordError(counts, unit=options.unit)
    if options.inventory is not None:
        return inventory_of(options.inventory)
    if options.unit is not None or options.folder is None:
        return None
    naming = _naming(stats, options.described) or _naming(stats, sorted(options.folder.glob("*.xml")))
    if len(naming) != 1:
        several = f"several do: {', '.join(p.name for p in naming)}" if naming else "none in its folder does"
        missing = f"no single StationXML describes {stats.network}.{stats.station} ({several})"
        raise UndeclaredError(
            f"{missing}; {advice('inventory')}; if the samples are acceleration, {advice('unit')}.",
            unit=None,
        )
    return inventory_of(naming[0])


def _naming(stats: Any, paths: Sequence[Path]) -> list[Path]:
    """Return those of XML files that name the network and the station of a trace."""
    naming = []
    for path in paths:
        with suppress(OSError):
            state = path.stat()
            codes = _codes_in(str(path), state.st_mtime_ns, state.st_size)
            if ("Network", stats.network) in codes and ("Station", stats.station) in codes:
                naming.append(path)
    return naming


_CODE = re.compile(r'<(?:\w+:)?(Network|Station)\b[^>]*\bcode="([^"]*)"')


@lru_cache(maxsize=1000)
def _codes_in(path: str, _changed: int, _size: int) -> frozenset[tuple[str, str]]:
    """Return the networks and stations that an XML file describes, none where it is no StationXML.

    changed, size: its state, by which each file of a folder is looked through once, and not for each record in it.
    """
    try:
        text = read_whole(Path(path), _LARGEST_XML, RecordError).decode("utf-8", "replace")
    except RecordError:
        return frozenset()
    return frozenset(_CODE.findall(text)) if "FDSNStationXML" in text[:2000] else frozenset()


def inventory_of(path: Path | None) -> Any:
    """Return obspy's inventory of the StationXML at a path, None of no path."""
    return path and parsed_inventory(read_whole(path, _LARGEST_XML, RecordError, path.name), path.name)


_KINDS = (
    ("StationXML", "STATIONXML", re.compile(rb"(?s)(?!.*<!DOCTYPE).{,2000}?FDSNStationXML")),
    ("dataless SEED", "SEED", re.compile(DATALESS)),
    ("RESP", "RESP", re.compile(RESP)),
)
"""What instruments are described in: its name, that in obspy, and how it begins."""


@lru_cache(maxsize=4)
def parsed_inventory(content: bytes, name: str) -> Any:
    """Return obspy's inventory of a description, which the channels of a station ask for one after another."""
    from obspy import read_inventory  # which takes a second to import

    kind, form = next(((kind, form) for kind, form, first in _KINDS if first.match(content)), ("", ""))
    if not kind:
        is_poles = re.match(SACPZ, content)
        what = "holds poles and zeros of SAC, which no response is made of" if is_poles else "is none"
        raise RecordError(
            f"the inventory {name} {what}; give a plain StationXML, a dataless SEED or a RESP.",
            inventory=name,
        )
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            return read_inventory(io.BytesIO(content), format=form)
    except Exception as error:
        raise RecordError(
            f"damaged {kind} {name}, {str(error)[:200]}; fetch it again.", inventory=name
        ) from error
