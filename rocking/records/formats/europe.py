"""Formats of European networks and collections: DYNA (ESM, ITACA, AFAD), AFAD, RESORCE, ESD."""

import re
from typing import Any

from rocking.errors import RecordError
from rocking.quantities import NUMBER
from rocking.records.direction import Direction
from rocking.records.formats import text
from rocking.records.formats.format import (
    LONGEST_HEADER,
    Format,
    Layout,
    Options,
    key,
    keyed,
    optional,
    optional_number,
    parted,
    typed_magnitude,
    universal,
)
from rocking.records.formats.text import iso_date
from rocking.records.plausibility import agree_with_velocity
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


def _read_dyna(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _DYNA_END.match, "of numbers")
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
    head, rows = parted(content, _directions, "names the columns (N-S, E-W, U-D)")
    labels = _directions(rows[0])
    table = text.table(rows[1:], len(labels))
    line = optional(r"^(.*PGA.*:.*)", head)
    peaks = [optional_number(rf"\({re.escape(label)}\)\s*({NUMBER})", line) for label in labels]
    is_processed = "RAW" not in line
    return _AFAD.channels(head, table, labels, options, peaks=peaks, processed=is_processed)


_RESORCE_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_RESORCE_FIRST = re.compile(rf"Event Date & Time(?:.*\n){{1,{LONGEST_HEADER}}}?(?i:{_RESORCE_TITLE.pattern})")
_RESORCE = Layout("m/s2", {"network": r"^Network\s*:\s*(\S+)", "quantity": r"^(\w+) time series in \S"} | keyed(
    samples="NUMBER OF DATA", step="TIME INCREMENT (S)", component="ORIENTATION", station="STATION CODE / NAME",
    event="EVENT DATE & TIME", event_time="EVENT DATE & TIME", high_pass="FILTER CUT-OFF FREQUENCY (HZ)",
    peak="PGA (M/S/S)",
), per_line=5, width=14)  # fmt: skip


def _read_resorce(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _RESORCE_TITLE.match, "names the time series and its unit")
    return _RESORCE.series(f"{head}\n{rows[0]}", rows[1:], options)


_ESD_SECTION = re.compile(r"[ \t]*->[ \t]*(un)?corrected[ \t]+(\w+)", re.I)
_ESD_FIRST = re.compile(
    rf"[ \t]*file:.*\n[ \t]*earthquake code:(?:.*\n){{1,{LONGEST_HEADER}}}?{_ESD_SECTION.pattern}", re.I
)
_ESD = Layout("m/s2", {
    "unit": r"^[ \t]*units:[ \t]*([^,;\s]+)", "high_pass": r"band-?pass[ -]?filter[ ]*\(([\d.]+)",
    "corrected": r"^[ \t]*->[ \t]*(corrected)", "step": key("SAMPLING PERIOD", r"([\d.]+)"),
    "duration": key("RECORD LENGTH", r"([\d.]+)"),
} | keyed(
    samples="NUMBER OF SAMPLES", component="ORIENTATION OF TRANSDUCER", station="STATION CODE", event="EARTHQUAKE CODE",
), per_line=10, width=13)  # fmt: skip
_ESD_START = re.compile(r"(?im)^[ \t]*time of first sample:[ \t]*(\d\d)\.(\d\d)\.(\d{4}) +([\d:.]+) *UTC")


def _read_esd(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, _ESD_SECTION.match, "that begins with ->")
    begins = [at for at, row in enumerate(rows) if row.lstrip().startswith(("->", "STOP"))]
    ends = [*begins[1:], len(rows)]
    sections = [rows[begin:end] for begin, end in zip(begins, ends, strict=True)]
    of_motion = [lines for lines in sections if re.match(r"\s*-> *corrected acc", lines[0], re.I)]
    if len(of_motion) != 1:
        titles = ", ".join(lines[0].strip(" \t->")[:40] for lines in sections)
        raise RecordError(
            f"the file holds {titles}; use the file of corrected acceleration (.cor).", quantity=titles
        )
    (title, *numbers) = of_motion[0]
    start = _ESD_START.search(head)
    facts = {"start_time": universal("{2}-{1}-{0} {3}".format(*start.groups()), 0.0)} if start else {}
    (record,) = _ESD.series(f"{head}\n{title}", numbers, options, **facts)
    velocity = [lines[1:] for lines in sections if re.match(r"\s*-> *corrected vel", lines[0], re.I)]
    return [agree_with_velocity(record, text.fields(velocity[0], 13)) if velocity else record]


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
ESD = Format(
    "ESD",
    "European Strong-Motion Database (ISESD), corrected files",
    "keys file and earthquake code at the start and a line that begins with -> corrected",
    _ESD_FIRST,
    _read_esd,
)
