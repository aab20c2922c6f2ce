"""Formats of networks around the Pacific: CWB, JMA, CSMNC, GeoNet, EMOD3D."""

import re

from rocking.errors import RecordError
from rocking.quantities import NUMBER
from rocking.records.claims import refuse_other_quantity
from rocking.records.formats import text
from rocking.records.formats.format import (
    WORD,
    Format,
    Layout,
    Options,
    in_blocks,
    key,
    keyed,
    optional,
    parted,
    typed_magnitude,
)
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_velocity
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

_CWB = Layout("gal", {"unit": key("AMPLITUDEUNIT", WORD)} | keyed(
    duration="RECORDLENGTH(SEC)", rate="SAMPLERATE(HZ)", station="STATIONCODE",
    event_time="ORIGIN TIME(GMT+08)", latitude="STATIONLATITUDE(N)", longitude="STATIONLONGITUDE(E)",
    channels="DATASEQUENCE",
), mandatory=("duration", "rate"), duration_digits=0.0, half_digit=5e-4, code="TW")  # fmt: skip


def _read_cwb(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, re.compile("#Data:").match, "begins with #Data:")
    head = re.sub("^#", "", head, flags=re.M)
    labels = re.findall(r"([A-Z])\(", _CWB.required("channels", head))
    scales = re.findall(r"^Magnitude\((\w+)\)(:.*)", head, re.I | re.M)  # lines like "Magnitude(Mw):7.6"
    facts = typed_magnitude(" ".join(scale + value for scale, value in scales))
    lines = (optional(rf"^.*MAX.*\b{label}\s*:(.*)", head) for label in labels)
    extremes = (re.findall(NUMBER, line, re.I) for line in lines)  # the greatest and the least
    facts["peaks"] = [max((abs(float(number)) for number in two), default=None) for two in extremes]
    time = _CWB.text("event_time", head)
    facts["event"] = facts["event_time"] = time and f"{time} +08:00"

    table = text.table(rows[1:], len(labels) + 1, width=10)
    times = table[:, 0]
    samples = table[:, 1:]
    return _CWB.channels(head, samples, labels, options, step=text.only_even_step(times), **facts)


_JMA = Layout("", {
    "rate": r"^\s*SAMPLING RATE\s*=\s*([\d.]+)\s*Hz", "station": r"^SITE CODE=\s*([\x21-\x7e]+)",
    "latitude": r"^\s*LAT\.=\s*(.*)", "longitude": r"^\s*LON\.=\s*(.*)", "unit": r"^\s*UNIT\s*=\s*(\w+)",
    "start": r"^\s*INITIAL TIME\s*=\s*([\d ]+)", "magnitude": r"^SITE CODE=(?:[^,]*,){4}\s*([\d.]+)",
}, ahead=9.0, code="JMA")  # fmt: skip
_JMA_HEADER = 7
_JMA_NAMES = "NS,EW,UD"
_JMA_FIRST = re.compile(rf"SITE CODE=(?:.*\n){{6}}[ \t]*{_JMA_NAMES}[ \t]*(?:\n|\Z)")


def _read_jma(content: bytes, options: Options) -> list[Accelerogram]:
    """The header gives no number of samples."""
    head, rows = parted(content, _JMA_HEADER)
    labels = _JMA_NAMES.split(",")
    if broken := next((row for row in rows if row.count(",") != len(labels) - 1 and row.strip()), ""):
        raise RecordError(
            f"a line of the samples is {broken[:40]!r}, but must hold {len(labels)} numbers.", samples=broken
        )
    table = text.table([row.replace(",", " ") for row in rows], len(labels))
    return _JMA.channels(head, table, labels, options)


_CSMNC = Layout("cm/s2", {
    "samples": r"^NO\. OF POINTS:\s*(\S+)", "step": r"EQUALLY SPACED INTERVALS OF:\s*(\S+)",
    "duration": r"\bDURATION:\s*([\d.]+)", "component": r"^COMP\.\s*(\S+)", "station": r"^STATION:\s*(\S+)",
    "event": r"\A(?:.*\n){2}[ \t]*(.{,60})", "event_time": r"^\d+ +(\d{4}-\d\d-\d\d [\d:]+ \w+)",
    "magnitude": r"^MAGNITUDE\s+([\d.]+.*)", "place": r"^STATION:\s*\S+\s+(.*)",
    "peak": r"^PEAK VALUE:\s*(-?[\d.]+)", "peak_time": r"^PEAK VALUE:.*?\bAT\s+([\d.]+)\s*SEC",
    "corrected": r"^(CORRECTED) ", "quantity": r"^(?:UN)?CORRECTED (\w+)\s+UNIT:",
    "unit": r"^(?:UN)?CORRECTED \w+\s+UNIT:\s*(\S+)",
}, duration_digits=1.0, per_line=8, width=13)  # fmt: skip
_CSMNC_HEADER = 16
_CSMNC_FIRST = re.compile(r"(?=(?:.*\n){0,15}NO\. OF POINTS:)(?:.*\n){0,15}OBSERVING POINT:")


_GEONET = Layout("mm/s2", {
    "samples": r"^Number of points\s+(\S+)", "step": r"(?:intervals of|data at)\s+([\d.]+)\s*s",
    "duration": r"\bDuration\s+([\d.]+)", "component": r"^Component\s+(\S+)", "station": r"^Site\s+(\S+)",
    "event": r"^(\d{4} \w+ \d+)\s", "event_time": r"^(\d{4} \w+ \d+\s+[\d:]+(?: UT)?)", "place": r"^Site\s+\S+\s+(.*)",
    "magnitude": r"^Epicentre\b.*\b(M[A-Za-z]?\s+[\d.]+)", "distance": r"^Epicentre\b.*\bDist\s+([\d.]+)\s*km",
    "high_pass": r"transition bands are\s+([\d.]+)", "peak": r"^Acceleration:\s+peak\s+(\S+)\s+mm/s/s",
    "peak_time": r"^Acceleration:\s+peak\s+\S+\s+mm/s/s at\s+([\d.]+)\s*s", "corrected": r"\A(corrected)",
    "rms": r"^Acceleration:.*\brms\s+([\d.]+)",
}, mandatory=("peak",), code="NZ")  # fmt: skip
_GEONET_BLOCK = re.compile(r"(Un)?corrected accelerogram\s", re.I)
_GEONET_FIRST = re.compile(rf"(?i:{_GEONET_BLOCK.pattern}).*\nSite ")
_TEXT = 16
_HEADER = 26
_PER_LINE = 10
_WIDTH = 8
_PREPENDED = 31
"""Place in the integer header of the number of samples put before the first digitised one, from which times count.

After GNS accelerogram data files, Standard Format (2008).
"""


def _geonet_channel(block: list[str], options: Options, total: int) -> Accelerogram:
    note = RockingWarning.of(RecordKind.CHANNELS_OF_GEONET, held=total)
    head = "\n".join(block[:_TEXT])
    samples = _GEONET.count(head)
    rows = [row for row in block[_HEADER:] if row.strip()]
    # A corrected file goes on with velocity and displacement.
    size = len(rows) // 3 if len(rows) == 3 * -(-samples // _PER_LINE) else len(rows)
    values = text.filled(rows[:size], samples, _PER_LINE, _WIDTH)
    unit = optional(r"readings in units of\s+([\d.]+)\s*mm/s/s", head) or "1"
    factor = text.number("raw unit", unit)
    integers = " ".join(block[_TEXT : _TEXT + 4]).split()
    at = _GEONET.number("peak_time", head)
    if at is not None and len(integers) == 40 and integers[_PREPENDED].isdecimal():
        at += int(integers[_PREPENDED]) * text.number("the step", _GEONET.required("step", head))
    notes = (note,) if total % 3 else ()
    record = _GEONET.channel(head, values * factor, options, warnings=notes, peak_time=at)
    if size == len(rows):
        return record
    return agree_with_velocity(record, text.filled(rows[size : 2 * size], samples, _PER_LINE, _WIDTH) / 1000)


_EMOD3D_FIRST = re.compile(
    r"(?i)[ \t]*\S+[ \t]+\S.*\n[ \t]*(\d+)[ \t]+(\d\.\d+e[-+]\d\d)"
    r"([ \t]+-?\d+){2}([ \t]+-?\d\.\d+e[-+]\d\d){4}[ \t]*\n"
)
"""Station and component above number of samples, step, hours and minutes, and four reals."""
_EMOD3D = Layout("", {
    "station": r"\A\s*(\S+)", "component": r"\A\s*\S+\s+(\S+)", "samples": r"^\s*(\d+)\s+\d\.\d+e",
    "step": r"^\s*\d+\s+(\d\.\d+e\S+)",
}, per_line=6)  # fmt: skip


def _read_emod3d(content: bytes, options: Options) -> list[Accelerogram]:
    head, rows = parted(content, 2)
    refuse_other_quantity(head)
    return _EMOD3D.series(head, rows, options, processed=None)


CWB = Format(
    "CWB",
    "Central Weather Bureau, Taiwan",
    "first line #Earthquake Information, or #StationCode: as on the disc of 1999",
    re.compile(r"#(Earthquake Information|StationCode\s*:)"),
    _read_cwb,
    "CWB",
)
JMA = Format(
    "JMA CSV",
    "Japan Meteorological Agency",
    "SITE CODE= at the start and a seventh line NS,EW,UD",
    _JMA_FIRST,
    _read_jma,
)
CSMNC = Format(
    "CSMNC",
    "China Strong Motion Networks Centre",
    "lines OBSERVING POINT: and NO. OF POINTS: in the first 16",
    _CSMNC_FIRST,
    lambda content, options: _CSMNC.series(*parted(content, _CSMNC_HEADER), options),
    "CSMNC",
)
GEONET = Format(
    "GeoNet V1A/V2A",
    "GeoNet (GNS Science), New Zealand",
    "first line Corrected or Uncorrected accelerogram above a Site line",
    _GEONET_FIRST,
    in_blocks(_GEONET_BLOCK, _geonet_channel),
    "GEONET",
)
EMOD3D = Format(
    "EMOD3D text",
    "EMOD3D and ucgmsim, simulated and observed motion",
    "station and component above samples, step and six more numbers",
    _EMOD3D_FIRST,
    _read_emod3d,
)
