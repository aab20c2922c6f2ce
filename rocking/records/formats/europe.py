"""Formats of European networks and collections: DYNA (ESM, ITACA, AFAD), AFAD, RESORCE."""

import re
from typing import Any

from rocking.quantities import NUMBER
from rocking.records.direction import Direction
from rocking.records.formats import text
from rocking.records.formats.format import (
    Format,
    Layout,
    Options,
    key,
    keyed,
    optional,
    optional_number,
    parted,
    typed_magnitude,
)
from rocking.records.formats.text import iso_date
from rocking.signal.accelerogram import Accelerogram

_DYNA = Layout("", keyed(
    samples="NDATA", step="SAMPLING_INTERVAL_S", duration="DURATION_S", component="STREAM", station="STATION_CODE",
    network="NETWORK", latitude="STATION_LATITUDE_DEGREE", longitude="STATION_LONGITUDE_DEGREE",
    elevation="STATION_ELEVATION_M", distance="EPICENTRAL_DISTANCE_KM", high_pass="LOW_CUT_FREQUENCY_HZ",
    peak="PGA_CM/S^2", peak_time="TIME_PGA_S", start="DATE_TIME_FIRST_SAMPLE_YYYYMMDD_HHMMSS",
    quantity="DATA_TYPE", unit="UNITS",
), peak_unit="cm/s2")  # fmt: skip
_DYNA_END = re.compile(r"(?!AAD_|[A-Z][A-Z0-9_/^]*:)")
_DYNA_FIRST = re.compile(r"(?:AAD_.*\n)*EVENT_NAME:(?:.*\n){1,100}?SAMPLING_INTERVAL_S:")
"""AFAD puts lines AAD_ above a header after filtering the samples anew (Kahramanmaraş 2023)."""
_DYNA_HEADER = 200  # lines of the longest header, of this format and of the next two
_AFAD_HEADER = 40
_RESORCE_HEADER = 20


def _read_dyna(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _DYNA_END.match, "of numbers", _DYNA_HEADER)
    is_filtered_anew = head.startswith("AAD_")
    head = re.sub("^AAD_", "", head, flags=re.M)
    date = iso_date(optional(key("EVENT_DATE_YYYYMMDD"), head))
    scales = f"Mw={optional(key('MAGNITUDE_W'), head)} ML={optional(key('MAGNITUDE_L'), head)}"
    facts: dict[str, Any] = typed_magnitude(scales)
    facts["event"] = f"{optional(key('EVENT_NAME'), head)} {date}"
    facts["event_time"] = f"{date} {optional(key('EVENT_TIME_HHMMSS'), head)}"
    if is_filtered_anew:  # the peak that the header states is that of the samples before
        facts["peak"] = 0.0
    return _DYNA.series(head, rows, options, **facts)


_AFAD = Layout("gal", keyed(
    samples="NUMBER OF DATA", step="SAMPLING INTERVAL (SEC)", station="STATION ID", event="EARTHQUAKE DATE",
    event_time="EARTHQUAKE DATE", magnitude="EARTHQUAKE MAGNITUDE", place="STATION COORDINATES",
    elevation="STATION ALTITUDE (M)",
), half_digit=5e-7, code="TK")  # fmt: skip


def _directions(line: str) -> list[str]:
    """Return the names of the columns that `line` heads, all of them directions, or none."""
    labels = line.split()
    return labels if len(labels) > 1 and all(Direction.of(label).is_known for label in labels) else []


def _read_afad(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _directions, "names the columns (N-S, E-W, U-D)", _AFAD_HEADER)
    labels = _directions(rows[0])
    table = text.table(rows[1:], len(labels))
    line = optional(r"^(.*PGA.*:.*)", head)
    peaks = [optional_number(rf"\({re.escape(label)}\)\s*({NUMBER})", line) for label in labels]
    is_processed = "RAW" not in line
    return _AFAD.channels(head, table, labels, options, peaks=peaks, processed=is_processed)


_RESORCE_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_RESORCE_FIRST = re.compile(
    rf"Event Date & Time(?:.*\n){{1,{_RESORCE_HEADER}}}?(?i:{_RESORCE_TITLE.pattern})"
)
_RESORCE = Layout("m/s2", {"network": r"^Network\s*:\s*(\S+)", "quantity": r"^(\w+) time series in \S"} | keyed(
    samples="NUMBER OF DATA", step="TIME INCREMENT (S)", component="ORIENTATION", station="STATION CODE / NAME",
    event="EVENT DATE & TIME", event_time="EVENT DATE & TIME", high_pass="FILTER CUT-OFF FREQUENCY (HZ)",
    peak="PGA (M/S/S)",
), per_line=5, width=14)  # fmt: skip


def _read_resorce(content: bytes, options: Options) -> list[Accelerogram]:
    title = "names the time series and its unit"
    head, rows = parted(content, _RESORCE_TITLE.match, title, _RESORCE_HEADER)
    return _RESORCE.series(f"{head}\n{rows[0]}", rows[1:], options)


DYNA = Format(
    "DYNA (ESM, ITACA, AFAD)",
    "ESM and ITACA (ORFEUS, INGV), AFAD",
    "EVENT_NAME: at the start, or below lines AAD_, and SAMPLING_INTERVAL_S: below",
    _DYNA_FIRST,
    _read_dyna,
    "DYNA",
)
AFAD = Format(
    "AFAD/NSMN text",
    "AFAD, Turkey",
    "first line STRONG GROUND MOTION RECORDS OF TURKIYE",
    re.compile(r"STRONG GROUND MOTION RECORDS OF T", re.I),
    _read_afad,
    "AFAD",
)
RESORCE = Format(
    "RESORCE",
    "RESORCE and SHARE, Europe",
    "Event Date & Time at the start and a line that names the time series",
    _RESORCE_FIRST,
    _read_resorce,
    "RESORCE",
)
