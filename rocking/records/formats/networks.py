"""Formats of single networks, whose headers are sentences or places: K-NET, JMA, CSMNC, GeoNet, USGS SMC."""

import re
from typing import Any

from rocking.errors import RecordError
from rocking.quantities import positive
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, starts, without_offset
from rocking.records.formats.header import Layout, blocks, optional, required, site, typed_magnitude
from rocking.records.formats.text import (
    after_lines,
    column_width,
    count,
    fields,
    filled,
    in_columns,
    lines,
    number,
    numbers,
    whole,
)
from rocking.records.plausibility import agree_with_velocity

_JAPAN = 9.0  # h ahead of universal time
_DELAY = 15 / 3600  # h; of a K-NET recorder, which its record time carries
_KNET_KEYS = (
    "Origin Time", "Lat.", "Long.", "Depth. (km)", "Mag.", "Station Code", "Station Lat.", "Station Long.",
    "Station Height(m)", "Record Time", "Sampling Freq(Hz)", "Duration Time(s)", "Dir.", "Scale Factor",
    "Max. Acc. (gal)", "Last Correction", "Memo.",
)  # fmt: skip
_KNET = Layout("gal", {
    "rate": r"^Sampling Freq\(Hz\)\s*(.*?)(?:Hz)?$", "duration": r"^Duration Time\(s\)\s*(.*)",
    "component": r"^Dir\.\s*(.*)", "station": r"^Station Code\s*(.*)", "event_time": r"^Origin Time\s*(.*)",
    "magnitude": r"^Mag\.\s*(.*)", "latitude": r"^Station Lat\.\s*(.*)", "longitude": r"^Station Long\.\s*(.*)",
    "elevation": r"^Station Height\(m\)\s*(.*)", "peak": r"^Max\. Acc\. \(gal\)\s*(.*)",
    "start": r"^Record Time\s*(.*)",
}, needed=("duration", "peak"), duration_steps=0.501, duration_digits=0.0, half_digit=5e-4, ahead=_JAPAN + _DELAY,
    code="BO")  # fmt: skip
_KIKNET = {"1": "NS", "2": "EW", "3": "UD", "4": "NS", "5": "EW", "6": "UD"}
_BOREHOLE = {"1", "2", "3"}


def _is_knet(content: bytes) -> bool:
    head = lines(content, 10)
    return len(head) == 10 and all(map(str.startswith, head, _KNET_KEYS))


def _read_knet(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content, len(_KNET_KEYS))
    if missing := [key for key in _KNET_KEYS if not any(line.startswith(key) for line in text)]:
        raise RecordError(f"the header has no line {missing[0]!r}; K-NET's has {len(_KNET_KEYS)} lines.")
    head = "\n".join(text)
    scale = r"^Scale Factor\s*([\d.]+)\s*\(gal\)\s*/\s*([\d.]+)\s*$"
    parts = required("a Scale Factor like 3920(gal)/6182761", scale, head)
    full, counts = (positive(RecordError, "Scale Factor", number("Scale Factor", parts[i])) for i in (1, 2))
    unit = options.unit_of("gal")
    values, offset = without_offset(numbers(after_lines(content, len(_KNET_KEYS))) * (full / counts), unit)
    direction = _KNET.text("component", head)
    facts: dict[str, Any] = {"processing": (offset,), "borehole": direction in _BOREHOLE}
    facts["component"] = _KIKNET.get(direction, direction)
    facts["event"] = f"{_KNET.text('event_time', head)} M{_KNET.text('magnitude', head)}"
    return [_KNET.channel(head, values, options, **facts)]


_JMA = Layout("", {
    "rate": r"^\s*SAMPLING RATE\s*=\s*([\d.]+)\s*Hz", "station": r"^SITE CODE=\s*([\x21-\x7e]+)",
    "latitude": r"^\s*LAT\.=\s*(.*)", "longitude": r"^\s*LON\.=\s*(.*)",
    "start": r"^\s*INITIAL TIME\s*=\s*([\d ]+)", "magnitude": r"^SITE CODE=(?:[^,]*,){4}\s*([\d.]+)",
}, ahead=_JAPAN, code="JMA")  # fmt: skip
_JMA_HEADER, _JMA_NAMES = 7, "NS,EW,UD"


def _is_jma(content: bytes) -> bool:
    return content.startswith(b"SITE CODE=") and lines(content, _JMA_HEADER)[-1].strip() == _JMA_NAMES


def _read_jma(content: bytes, options: Options) -> list[Accelerogram]:
    """The header gives no number of samples."""
    text = lines(content)
    head = "\n".join(text[:_JMA_HEADER])
    rows = text[_JMA_HEADER:]
    labels = _JMA_NAMES.split(",")
    if broken := next((row for row in rows if row.strip() and row.count(",") != len(labels) - 1), ""):
        raise RecordError(f"a line of the samples is {broken[:40]!r}, but must hold {len(labels)} numbers.")
    table = in_columns(numbers("\n".join(rows).replace(",", " ")), len(labels))
    unit = required("the unit", r"^\s*UNIT\s*=\s*(\w+)", head)[1]
    return _JMA.channels(head, table, labels, options, unit=unit)


_CSMNC = Layout("cm/s2", {
    "samples": r"^NO\. OF POINTS:\s*(\S+)", "step": r"EQUALLY SPACED INTERVALS OF:\s*(\S+)",
    "duration": r"\bDURATION:\s*([\d.]+)", "component": r"^COMP\.\s*(\S+)", "station": r"^STATION:\s*(\S+)",
    "event": r"\A(?:.*\n){2}[ \t]*(.{,60})", "event_time": r"^\d+ +(\d{4}-\d\d-\d\d [\d:]+ \w+)",
    "magnitude": r"^MAGNITUDE\s+([\d.]+.*)", "place": r"^STATION:\s*\S+\s+(.*)",
    "peak": r"^PEAK VALUE:\s*(-?[\d.]+)", "peak_time": r"^PEAK VALUE:.*?\bAT\s+([\d.]+)\s*SEC",
    "corrected": r"^(CORRECTED) ",
}, duration_digits=1.0, half_digit=5e-4)  # fmt: skip
_CSMNC_HEADER, _CSMNC_PER_LINE, _CSMNC_WIDTH = 16, 8, 13


def _is_csmnc(content: bytes) -> bool:
    head = "\n" + "\n".join(lines(content, _CSMNC_HEADER))
    return "\nNO. OF POINTS:" in head and "\nOBSERVING POINT:" in head


def _read_csmnc(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    head = "\n".join(text[:_CSMNC_HEADER])
    kind = required("the quantity and its unit", r"^(?:UN)?CORRECTED (\w+)\s+UNIT:\s*(\S+)", head)
    if kind[1].upper() != "ACCELERATION" or kind[2].upper() not in ("CM/SEC/SEC", "CM/S/S", "GAL"):
        raise RecordError(f"the file holds {kind[1]} in {kind[2]}, but must hold ACCELERATION in CM/SEC/SEC.")
    values, notes = whole(fields(text[_CSMNC_HEADER:], _CSMNC_WIDTH), _CSMNC.count(head), _CSMNC_PER_LINE)
    return [_CSMNC.channel(head, values, options, warnings=notes)]


_GEONET = Layout("mm/s2", {
    "samples": r"^Number of points\s+(\S+)", "step": r"(?:intervals of|data at)\s+([\d.]+)\s*s",
    "duration": r"\bDuration\s+([\d.]+)", "component": r"^Component\s+(\S+)", "station": r"^Site\s+(\S+)",
    "event": r"^(\d{4} \w+ \d+)\s", "event_time": r"^(\d{4} \w+ \d+\s+[\d:]+)", "place": r"^Site\s+\S+\s+(.*)",
    "magnitude": r"^Epicentre\b.*\b(M[A-Za-z]\s+[\d.]+)", "distance": r"^Epicentre\b.*\bDist\s+([\d.]+)\s*km",
    "high_pass": r"transition bands are\s+([\d.]+)", "peak": r"^Acceleration:\s+peak\s+(\S+)\s+mm/s/s",
    "peak_time": r"^Acceleration:\s+peak\s+\S+\s+mm/s/s at\s+([\d.]+)\s*s", "corrected": r"\A(corrected)",
    "rms": r"^Acceleration:.*\brms\s+([\d.]+)",
}, needed=("peak",), half_digit=0.05, code="NZ")  # fmt: skip
_GEONET_FIRST = re.compile(r"(Un)?corrected accelerogram\s", re.I)
_TEXT, _HEADER, _PER_LINE, _WIDTH = 16, 26, 10, 8
_PREPENDED = 31
"""Place in the integer header of the number of samples put before the first digitised one, from which times count.

After GNS accelerogram data files, Standard Format (2008).
"""


def _is_geonet(content: bytes) -> bool:
    head = lines(content, 3)
    return bool(_GEONET_FIRST.match(head[0])) and len(head) > 1 and head[1].startswith("Site ")


def _read_geonet(content: bytes, options: Options) -> list[Accelerogram]:
    every = blocks(content, _GEONET_FIRST)
    note = f"A GeoNet file holds 3 components, but this one holds {len(every)}."
    return [_geonet_channel(block, options, (note,) if len(every) % 3 else ()) for block in every]


def _geonet_channel(block: list[str], options: Options, notes: tuple[str, ...]) -> Accelerogram:
    head = "\n".join(block[:_TEXT])
    declared = _GEONET.count(head)
    rows = [row for row in block[_HEADER:] if row.strip()]
    wanted = -(-declared // _PER_LINE)
    if len(rows) not in (wanted, 3 * wanted):  # a corrected file goes on with velocity and displacement
        stated = f"the header declares {declared} samples, {wanted} lines once or thrice, but {len(rows)} stand there"
        raise RecordError(
            f"{stated}: lines are missing or repeated, the file is truncated or damaged; fetch it again."
        )
    factor = number("raw unit", optional(r"readings in units of\s+([\d.]+)\s*mm/s/s", head) or "1")
    integers = " ".join(block[_TEXT : _TEXT + 4]).split()
    at = _GEONET.number("peak_time", head)
    if at is not None and len(integers) == 40 and integers[_PREPENDED].isdecimal():
        at += int(integers[_PREPENDED]) * number("the step", _GEONET.declared("step", head))
    values = filled(rows[:wanted], declared, _PER_LINE, _WIDTH) * factor
    record = _GEONET.channel(head, values, options, warnings=notes, peak_time=at)
    if len(rows) == wanted:
        return record
    return agree_with_velocity(record, filled(rows[wanted : 2 * wanted], declared, _PER_LINE, _WIDTH) / 1000)


_SMC = Layout("cm/s2", {
    "component": r"component\s*=\s*(\S+)", "station": r"station\s*=\s*(.*?)\s*component",
    "event": r"^\s+\d{4}\s+\d+\s+\d+\s+\d{4}\s+(.*)$", "distance": r"epicentral dist\s*=\s*([\d.]+)",
    "corrected": r"\A(2) ", "event_time": r"^\s+(\d{4}\s+\d+\s+\d+\s+\d{4}) ",
})  # fmt: skip
_SMC_KINDS = {"0": "unknown", "1": "uncorrected accelerogram", "2": "corrected accelerogram", "3": "velocity",
              "4": "displacement", "5": "response spectrum", "6": "Fourier spectrum"}  # fmt: skip
_SMC_FIRST = re.compile(r"(?i)[0-6] (UNKNOWN|(UN)?CORRECTED ACC|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)")
_SMC_TEXT, _SMC_INTEGERS, _SMC_REALS = 11, 17, 27  # lines at which each part of the header ends
_COMMENTS, _SAMPLES = 15, 16
_RATE, _LARGEST, _SMALLEST, _CORNER = 1, 29, 31, 32
"""Places in the integer and in the real header; the time of an extreme stands before its value."""
_PLACE = slice(10, 13)  # places in the real header of latitude, longitude and elevation of the station
_MISSING = 1.69e38


def _is_smc(content: bytes) -> bool:
    head = lines(content, 12)
    return starts(content, _SMC_FIRST) and len(head) == 12 and len(head[11].split()) == 8


def _read_smc(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    kind = text[0][:1]
    if kind not in "012":
        raise RecordError(f"this SMC file holds {_SMC_KINDS.get(kind, kind)}, not acceleration.")
    integers = fields(text[_SMC_TEXT:_SMC_INTEGERS], 10)
    reals = fields(text[_SMC_INTEGERS:_SMC_REALS], 15)
    if integers.size < 48 or reals.size < 50:
        raise RecordError(f"the header holds {integers.size} integers and {reals.size} reals, not 48 and 50.")
    remarks, samples = (count("a count in the header", f"{integers[at]:.0f}") for at in (_COMMENTS, _SAMPLES))
    first = _SMC_REALS + remarks
    if any(row.startswith("|") != (at < first) for at, row in enumerate(text[_SMC_REALS:], _SMC_REALS)):
        raise RecordError(f"the header declares {remarks} lines of comment, but others begin with |.")
    rate = float(reals[_RATE])
    if not 0 < rate < 1e6:
        raise RecordError(f"samples per second is {rate:g}, but must be greater than 0 and below 1e6.")
    body = [row for row in text[first:] if row.strip()]
    width = column_width(body[0]) if body else 10
    values, notes = whole(fields(body, width), samples, 80 // width)
    extremes = [(abs(reals[i]), reals[i - 1]) for i in (_LARGEST, _SMALLEST) if abs(reals[i]) < _MISSING]
    peak, at = max(extremes, default=(None, 0.0))
    head = "\n".join(text[:_SMC_TEXT])
    scales = " ".join(optional(r"^Moment (Mag.*)", head).replace("Mag", "Mw").split())
    place = site(*(real if abs(real) < _MISSING else None for real in reals[_PLACE].tolist()))
    facts: dict[str, Any] = {**typed_magnitude(scales), **place, "warnings": notes, "peak": peak}
    facts["high_pass_frequency"] = float(reals[_CORNER]) if 0 < reals[_CORNER] < 100 else None
    facts["peak_time"] = float(at) if 0 < at < _MISSING else None
    return [_SMC.channel(head, values, options, step=1 / rate, **facts)]


KNET = Format("K-NET/KiK-net", "NIED, Japan",
    "header that starts with Origin Time, Lat., Long., Depth. (km)", _is_knet, _read_knet)  # fmt: skip
JMA = Format("JMA CSV", "Japan Meteorological Agency",
    "SITE CODE= at the start and a seventh line NS,EW,UD", _is_jma, _read_jma)  # fmt: skip
CSMNC = Format("CSMNC", "China Strong Motion Networks Centre",
    "lines OBSERVING POINT: and NO. OF POINTS: in the first 16", _is_csmnc, _read_csmnc, "CSMNC")  # fmt: skip
GEONET = Format("GeoNet V1A/V2A", "GeoNet (GNS Science), New Zealand",
    "first line Corrected or Uncorrected accelerogram above a Site line", _is_geonet, _read_geonet,
    "GEONET")  # fmt: skip
SMC = Format("USGS SMC", "U.S. Geological Survey",
    "first line like 2 CORRECTED ACCELEROGRAM above ten text lines and integers", _is_smc, _read_smc,
    "USGS_SMC")  # fmt: skip
