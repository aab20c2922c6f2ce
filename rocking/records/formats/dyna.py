"""DYNA text: a header of KEY: value lines, then one sample a line. Written by ESM, ITACA and AFAD."""

import re
from itertools import takewhile

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import (
    check_duration,
    corner,
    distance,
    magnitude,
    mapping,
    numeric,
    optional_number,
    valued,
)
from rocking.records.formats.text import count, lines, numbers, whole
from rocking.records.plausibility import agree_with_header

_KEY = re.compile(r"[A-Z][A-Z0-9_/^]*:")
_LONGEST_HEADER = 100


def _header_length(content: bytes) -> int:
    """Return the number of KEY: lines at the start."""
    return sum(1 for _ in takewhile(_KEY.match, lines(content, _LONGEST_HEADER)))


def _recognise(content: bytes) -> bool:
    return content.startswith(b"EVENT_NAME:") and b"\nSAMPLING_INTERVAL_S:" in content[:8000].replace(
        b"\r", b"\n"
    )


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    length = _header_length(content)
    text = lines(content)
    pairs = mapping(text[:length])
    kind = valued(pairs, "DATA_TYPE")
    if kind.upper() != "ACCELERATION":
        raise RecordError(f"DATA_TYPE is {kind!r}, but must be ACCELERATION; use the ACC file of the record.")
    unit = options.unit_of(valued(pairs, "UNITS"))
    declared = count("NDATA", valued(pairs, "NDATA"))
    values, notes = whole(numbers("\n".join(text[length:]).encode("latin-1")), declared, per_line=1)
    record = _record(pairs, unit, values, notes, options)
    if pairs.get("DURATION_S"):
        check_duration("DURATION_S", pairs["DURATION_S"], declared, record.time_step)
    peak, at = (
        optional_number(r"^\s*(-?[\d.]+)", pairs.get(key, "")) for key in ("PGA_CM/S^2", "TIME_PGA_S")
    )
    return [agree_with_header(record, peak, "cm/s2", half_digit=5e-4, at=at)]


def _record(pairs: dict[str, str], unit: str, values, notes, options: Options) -> Accelerogram:
    high_pass = corner(optional_number(r"^\s*([\d.]+)", pairs.get("LOW_CUT_FREQUENCY_HZ", "")))
    return accelerogram(
        unit,
        values,
        options.time_step_of(numeric(pairs, "SAMPLING_INTERVAL_S")),
        component=pairs.get("STREAM", ""),
        station=pairs.get("STATION_CODE", ""),
        network=pairs.get("NETWORK", ""),
        warnings=notes,
        event=f"{pairs.get('EVENT_NAME', '')} {pairs.get('EVENT_DATE_YYYYMMDD', '')}".strip(),
        start_time=_start(pairs),
        magnitude=magnitude(pairs.get("MAGNITUDE_W", ""), pairs.get("MAGNITUDE_L", "")),
        epicentral_distance=distance(pairs.get("EPICENTRAL_DISTANCE_KM", "")),
        processed=high_pass is not None,
        high_pass_frequency=high_pass,
    )


def _start(pairs: dict[str, str]) -> str:
    found = re.fullmatch(
        r"(\d{4})(\d\d)(\d\d)_(\d\d)(\d\d)(\d\d(?:\.\d+)?)",
        pairs.get("DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS", ""),
    )
    return "{}-{}-{}T{}:{}:{}Z".format(*found.groups()) if found else ""


DYNA = Format(
    "DYNA (ESM, ITACA, AFAD)",
    "ESM and ITACA (ORFEUS, INGV), AFAD",
    "EVENT_NAME: at the start and SAMPLING_INTERVAL_S: below",
    _recognise,
    _read,
    plugin="DYNA",
)
