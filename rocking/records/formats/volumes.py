"""Volumes 1 and 2 of text: COSMOS; USC, RENADIC and BHRC in tenths of g; CSMIP and USC, corrected, of every age.

COSMOS describes each block itself; in the others 13 lines of text, 7 of integers and 7 of reals head each channel.
"""

import re
from functools import partial
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_factor, is_number
from rocking.records.direction import Direction
from rocking.records.formats import text
from rocking.records.formats.format import (
    Format,
    Layout,
    Options,
    check_end,
    check_equal,
    distance,
    in_blocks,
    optional,
    optional_number,
    required,
    without_offset,
)
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_mean_square, agree_with_velocity
from rocking.signal.accelerogram import Accelerogram
from rocking.warnings import RockingWarning

_COSMOS = Layout("", {
    "event": r"\A.*\n(?:Rcrd|Record)?[ \t]*(?:of)?[ \t]*(.*)", "station": r"Code:\s*(\S+)",
    "high_pass": r"filtered below\s+([\d.]+)\s*Hz", "corrected": r"\A(corrected)",
    "location": r"\bLocation:\s*(.*?)\s*$", "event_time": r"^Origin:\s*(\d.*?)\s*(?:\(.*)?$",
    "magnitude": r"^Hypocenter:.*?(M\w=.*)", "latitude": r"^Coords:\s*([-\d.]+)",
    "longitude": r"^Coords:\s*\S+\s+([-\d.]+)",
}, half_digit=5e-7)  # fmt: skip
_COSMOS_FIRST = re.compile(
    r"(Corrected|Uncorrected)\s+(acceleration|velocity|displacement)\s+\(Format v", re.I
)
_DATA = re.compile(
    r"(?i)^\s*(?P<n>\d+)\s+(?P<quantity>\w+)\s+pts,.*?units\s*=\s*(?P<unit>[\w/^]+)\.?\s*(?:\((?P<code>\d+)\))?\s*,?"
    r"\s*Format\s*=\s*\(\s*(?P<per_line>\d+)[FE](?P<width>\d+)"
)
_REALS = re.compile(r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines.*?\d+[FE](\d+)", re.I)
_END = re.compile(r"\s*(End-of-data|/&)", re.I)
# Places in the real header (COSMOS format 1.20).
_ELEVATION = 2  # of the station, m
_DISTANCE = 16  # of the station from the epicentre, km
_RECORDER_STEP = 33  # s, which is not that of a resampled series
_STEP = 61  # of the series, ms
_LENGTH = 62  # of the series, s
_PEAK = 63  # its largest value
_PEAK_TIME = 64  # and its time
_RMS = 83  # root mean square of a raw series
_UNKNOWN = -999.0
_CODES = {"02": "g", "2": "g", "04": "cm/s2", "4": "cm/s2"}
"""Units of acceleration by their code in the format."""


def _cosmos(block: list[str], options: Options, total: int) -> Accelerogram | None:
    """Return the accelerogram of a block, or None where it is of another quantity."""
    at, data = next(((i, m) for i, line in enumerate(block) if (m := _DATA.match(line))), (0, None))
    if data is None:
        raise RecordError(
            "no line gives points, units and Format of the samples; the file is truncated.",
            header="points, units and Format",
        )
    by_code = _CODES.get(data["code"] or "")
    if not data["quantity"].lower().startswith("accel"):
        if by_code:
            raise RecordError(
                f"a channel of {data['quantity']} has units of {by_code} by its code.",
                quantity=data["quantity"],
            )
        return None
    if acceleration_factor(by_code or data["unit"]) != acceleration_factor(data["unit"]):
        raise RecordError(
            f"the units are {data['unit']!r}, but their code {data['code']} says {by_code}.",
            unit=data["unit"],
        )
    head = "\n".join(block[:at])
    end = next((i for i, row in enumerate(block) if i > at and _END.match(row)), None)
    if end is None:
        raise RecordError(
            "no line End-of-data ends a channel: the file is truncated; fetch it again.", header="End-of-data"
        )
    check_end(block[end + 1 :])
    per_line, width = (max(1, int(data[name])) for name in ("per_line", "width"))
    reals = _reals(block[:at])
    step = reals[_STEP] / 1000 if 0 < reals[_STEP] < 1e4 else reals[_RECORDER_STEP]
    values = text.filled(block[at + 1 : end], text.count("number of points", data["n"]), per_line, width)
    length = reals[_LENGTH]
    lasts = values.size * step
    wrong = 0 < length < 1e5 and abs(length - lasts) > 1.5 * step + 5e-4  # not all agencies fill it
    stated = [None if abs(real - _UNKNOWN) < 1e-3 else real for real in reals]
    note = RockingWarning.of(RecordKind.LENGTH_UNLIKE_HEADER, stated_s=length, lasts_s=lasts)
    facts: dict[str, Any] = {"component": _component(head), "warnings": (note,) if wrong else ()}
    facts |= {"elevation": stated[_ELEVATION], "epicentral_distance": distance(stated[_DISTANCE])}
    facts |= {"peak": stated[_PEAK], "peak_time": stated[_PEAK_TIME]}
    record = _COSMOS.channel(head, values, options, unit=data["unit"], step=step, total=total, **facts)
    if record.processed or len(reals) <= _RMS:
        return record
    return agree_with_mean_square(record, reals[_RMS], data["unit"], digit=1e-6)


def _reals(head: list[str]) -> list[float]:
    for i, line in enumerate(head):
        if match := _REALS.match(line):
            rows = head[i + 1 :][: text.count("real-header lines", match[2])]
            values = text.fields(rows, int(match[3]) or 1)
            if values.size == text.count("real-header values", match[1]) > _PEAK_TIME:
                return [float(value) for value in values]
    raise RecordError(
        "the real header does not hold the values it announces: it is damaged; fetch it again.",
        header="reals",
    )


def _component(head: str) -> str:
    """Return the direction of the channel line ("360 deg" as 360, "Up"), else the channel code of the SCNL comment."""
    direction = optional(r"^Sta\s+Chan?\s*[^:]*:\s*([^(\n]*?)\s*\(", head).split(":")[-1].strip()
    if degrees := optional(r"^(\d+)\s*deg", direction):
        return degrees
    code = optional(r"<SCNL>\s*[^.\s]+\.([A-Z0-9]{3})\.", head)
    return code if direction.lower() in ("", "other") and code else direction


_HEADER = 27
_REALS_AT = 20
_RATE = 8
_TEXT = 13
_DURATION = r"NO\. OF POINTS\s*=\s*\S+\s+(?:DURATION|RECORD LENGTH)\s*=\s*([\d.]+)"
_SIZE = {"samples": r"NO\. OF POINTS\s*=\s*(\S+)"}
_USC = Layout("g/10", _SIZE | {
    "rms": r"^RMS.*=\s*([\d.]+) G/10", "component": r"^COMP\s+(\S+)", "station": r"^STATION\s+(USC#\s*\d+)",
    "event": r"\A.*\n(.{,60})",
}, width=7, margin=1)  # fmt: skip
_RENADIC = Layout("g/10", _SIZE | {
    "component": r"^CHAN\s*\d+:\s*(\S+)", "station": r"^((?:\S+\s+)?S/N\s*\S+)", "event": r"^([\d/]+ [\d:]+)",
    "peak": r"MAX\s*=\s*(-?[\d.]+)\s*G", "rms": r"^RMS.*=\s*([\d.]+) G\b(?!/)",
}, peak_unit="g", width=7)  # fmt: skip
_BHRC = Layout("g/10", _SIZE | {
    "component": r"^COMP\s+(\S+)", "station": r"FILE:\s*(\w+)", "event": r"^Origin Time\s*:\s*(\S+\s+\S+)",
    "event_time": r"^Origin Time\s*:\s*(\S+\s+\S+)", "magnitude": r"^(Epicenter\b.*)",
    "place": r"\bStation\s+(.*?)\s+Altitude", "elevation": r"\bAltitude\s+(\S+)",
}, per_line=10, width=13)  # fmt: skip
_CSMIP = {
    "component": r"^Chan\s*\d+:\s*(\S+)", "station": r"^Station (?:No|Id)\b\.?:?\s*(\S+)",
    "place": r"^Station (?:No|Id)\b\.?:?\s*\S+\s+(.*)",
    "location": r"\bLocation:\s*(.*?)\s*$",  # of the times the earthquake's own, else that of the record
    "event_time": r"^(?:Rcrd|Record) of\s+(.{10,40}?)(?:\s{2,}|$)(?:[^|]*?\(Origin:\s*(\d[^)\n]*?)\s*\))?",
    "event": r"^(?:(?:Rcrd|Record) of\s+(.{10,40}?)(?:\s{2,}|$)|\s*(\S.*\bEARTHQUAKE\b.*))",
    "peak": r"Max\s*=\s*(-?[\d.]+)\s*g",
}  # fmt: skip
_USC_2 = Layout("cm/s2", {
    "component": r"^COMP\s+(\S+)", "station": r"^STATION\s+(USC#\s*\d+)", "event": r"\A(?:.*\n){2}(.{,60})",
    "unit": r"^PEAK ACCELERATION\s*=\s*\S+\s+([A-Z/]+)", "peak": r"^PEAK ACCELERATION\s*=\s*(-?[\d.]+)",
    "peak_time": r"^PEAK ACCELERATION\s*=.*?\bAT\s+([\d.]+)\s*SEC", "high_pass": r"FILTERED BETWEEN\s+([\d.]+)",
    "event_time": r"\A(?:.*\n){3}(\w{3} \d+, \d{4}) ", "magnitude": r"^MAGNITUDE\s*=\s*([\d.]+)",
    "distance": r"EPICENTRAL DISTANCE\s*=\s*([\d.]+)\s*KM", "place": r"^STATION\s+USC#\s*\d+\s+(.{,34})",
}, peak_unit="cm/s2")  # fmt: skip
"""Corrected motion; the header gives its extremes with the other sign than the samples, and so does that of Caltech."""
_FILM = Layout("g/10", _CSMIP | _SIZE, peak_unit="g", width=7)
_CSMIP_1 = Layout("", _CSMIP | {
    "duration": r"Record length\s*=\s*([\d.]+)", "rms": r"\A(?:.*\n){20}.{30}(.{10})",
}, peak_unit="g")  # fmt: skip
_CSMIP_2 = Layout("", _CSMIP | {
    "high_pass": r"(?:3 dB pts at|RAMPS AT)\s+([\d.]+)", "peak": r"Peak acceleration\s*=\s*(-?[\d.]+)",
    "peak_time": r"Peak acceleration\s*=.*?\bat\s+([\d.]+)\s*sec",
}, peak_unit="cm/s2")  # fmt: skip


def _rows(block: list[str]) -> tuple[str, list[str]]:
    """Return the text and the rows of numbers of one channel in tenths of g. Raises RecordError for another unit."""
    head = "\n".join(block[:_TEXT])
    required("units of G/10", r"^(UNITS)\b.*\bG/10", head)
    required("points and length", _DURATION, head)
    body = block[_HEADER:]
    end = next((i for i, row in enumerate(body) if row.startswith("/&")), len(body))
    check_end(body[end + 1 :])
    return head, [row for row in body[:end] if row.strip()]


def _digitised(
    layout: Layout, block: list[str], options: Options, total: int, is_even: bool = False
) -> Accelerogram:
    """Return a channel of five pairs of time and acceleration a line, in columns of 7."""
    head, rows = _rows(block)
    times, values = text.table(rows, 2, layout.width, layout.margin).T
    text.whole(times, layout.count(head), per_line=0)
    duration = text.number("duration", optional(_DURATION, head))
    # The length may count a last step or not.
    if abs(duration - times[-1]) > 2 * np.ptp(times) / (times.size - 1) + 0.001:
        stated = f"the header declares a length of {duration:g} s, but the last sample is at {times[-1]:g} s"
        raise RecordError(
            f"{stated}; the file is damaged or its header is another's; fetch it again.", duration=duration
        )
    if is_even:
        text.only_even_step(times)
    return layout.through(head, times, values, options, total=total)


def _bhrc(block: list[str], options: Options, _: int) -> Accelerogram:
    head, rows = _rows(block)
    samples = text.filled(rows, _BHRC.count(head), _BHRC.per_line, _BHRC.width)
    values, offset = without_offset(samples, options.unit_of("g/10"))
    step = text.number("duration", optional(_DURATION, head)) / values.size
    reals = " ".join(block[_REALS_AT : _REALS_AT + 2]).split()
    printed = reals[_RATE] if len(reals) > _RATE else "0"
    rate = float(printed) if is_number(printed) else 0.0
    notes: tuple[RockingWarning, ...] = ()
    if not is_number(printed):
        notes = (RockingWarning.of(RecordKind.RATE_NO_NUMBER, rate=printed),)
    elif 1 <= rate <= 1e4 and abs(rate * step - 1) > 1e-3:
        notes = (RockingWarning.of(RecordKind.RATE_UNLIKE_STEP, rate_hz=rate, time_step_s=step),)
    letter = _BHRC.text("component", head)[:1].upper()
    facts: dict[str, Any] = {"processing": (offset,), "warnings": notes}
    facts["vertical"] = Direction.of(letter).vertical
    if letter in ("L", "T"):
        facts["azimuth"] = optional_number(rf"Azimuth\b.*\b{letter}\s+(\d+)", head)
    return _BHRC.channel(head, values, options, step=step, **facts)


_VOLUME_1 = re.compile(r"Uncorrected Accelerogram Data[ \t]+Processed", re.I)
_VOLUME_2 = re.compile(r"Corrected accelerogram[ \t].*Chan", re.I)
_USC_2_FIRST = re.compile(r"Corrected accelerogram[ \t](?!.*Chan).*\bComp\b", re.I)
_OF_RENADIC = r"(?:.*\n){0,12}.*RENADIC"
_CSMIP_FIRST = re.compile(rf"{_VOLUME_1.pattern}(?!{_OF_RENADIC})|{_VOLUME_2.pattern}", re.I)
_DATA_1 = re.compile(
    r"(?i)^\s*(?P<n>\d+)\s+Accelerogram points at\s+(?P<rate>[\d.]+)\s*pts/sec in units of\s+(?P<unit>\S+?)\s*\.?\s+"
    r"Format:\s*\((?P<per_line>\d+)[FE](?P<width>\d+)"
)
_DATA_2 = re.compile(
    r"(?i)^\s*(?P<n>\d+)\s+points\s+of (?P<quantity>acc|vel|dis)\w* data equally spaced at\s+(?P<step>[\d.]+)\s*sec"
    r"[.,]?\s*(?:(?:in units|in|\(units:)\s*(?P<unit>[\w/]+)[.)]*\s*(?:\((?P<per_line>\d+)[FE](?P<width>\d+))?)?"
)


def _read_csmip(content: bytes, options: Options) -> list[Accelerogram]:
    parts = re.split(r"^/&.*\n?", content.decode("latin-1"), flags=re.M)
    *channels, rest = (part.split("\n") for part in parts)
    if any(_announcement(line) or _VOLUME_1.match(line) for line in rest):
        channels.append(rest)
    else:
        check_end(rest)
    return [_csmip(block, options, len(channels)) for block in channels]


def _announcement(line: str) -> re.Match[str] | None:
    return _DATA_1.match(line) or _DATA_2.match(line)


def _csmip(block: list[str], options: Options, total: int) -> Accelerogram:
    announced = [(i, data) for i, line in enumerate(block) if (data := _announcement(line))]
    if not announced and any(re.match(r"UNITS\b.*\bG/10", line, re.I) for line in block[:_TEXT]):
        return _digitised(_FILM, block, options, total)
    facts: dict[str, Any] = announced[0][1].groupdict() if announced else {}
    if not announced or (facts.get("quantity") or "acc").lower() != "acc":
        raise RecordError(
            "no line like '1500 POINTS OF ACC DATA EQUALLY SPACED AT .020 SEC.' announces its acceleration: the file "
            "is cut, of velocity, or of another layout; use the file of the same record from another agency.",
            header="POINTS OF ACC DATA",
        )
    parts = []
    for (i, data), end in zip(announced, [*(i for i, _ in announced[1:]), len(block)], strict=True):
        rows = block[i + 1 : end]
        samples = text.count("number of points", data["n"])
        first = rows[0] if rows else ""  # shows the layout that volumes before 2000 do not say
        width = int(data["width"] or text.column_width(first))
        per_line = int(data["per_line"] or first.count("."))
        parts.append(text.filled(rows, samples, max(1, per_line), max(1, width)))
    head = "\n".join(block[: announced[0][0]])
    values = parts[0]
    layout = _USC_2 if _USC_2_FIRST.match(head) else _CSMIP_2 if _VOLUME_2.match(head) else _CSMIP_1
    is_corrected = layout is not _CSMIP_1
    rate = facts.get("rate")
    step = 1 / max(1e-9, text.number("rate", rate)) if rate else text.number("step", facts["step"])
    points = r"^\s*(\S+)\s+(?:points of )?instrument" if is_corrected else r"^No\. of points\s*=\s*(\S+)"
    if points := optional(points, head):
        check_equal("the number of points", text.count("number of points", points), values.size, 0)
    interval = optional_number(r"^At equally-spaced intervals of\s+([\d.]+)", head)
    if is_corrected and interval:
        check_equal("the interval", interval, step)
    more: dict[str, Any] = {
        "unit": facts["unit"] or "",
        "step": step,
        "processed": is_corrected,
        "total": total,
    }
    record = layout.channel(head, values, options, **more)
    for part, (_, data) in zip(parts[1:], announced[1:], strict=True):
        of = data.groupdict(default="")
        if of.get("quantity", "").lower() == "vel" and of["unit"].lower() == "cm/sec":
            record = agree_with_velocity(record, part / 100)
    return record


_USC_FIRST = re.compile(r"FILE\s+\d+\s+OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I", re.I)
_BHRC_FIRST = re.compile(r"\* VOL1DS FILE:", re.I)


COSMOS = Format(
    "COSMOS V1/V2",
    "COSMOS, CESMD and USGS, USA",
    "first line like Corrected acceleration (Format v01.20",
    _COSMOS_FIRST,
    in_blocks(_COSMOS_FIRST, _cosmos),
    "COSMOS_V1V2",
)
USC = Format(
    "USC Volume 1",
    "University of Southern California",
    "first line FILE n OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I",
    _USC_FIRST,
    in_blocks(_USC_FIRST, partial(_digitised, _USC)),
    "USC_V1",
)
USC_2 = Format(
    "USC Volume 2",
    "University of Southern California",
    "first line CORRECTED ACCELEROGRAM with a component (COMP)",
    _USC_2_FIRST,
    in_blocks(_USC_2_FIRST, _csmip),
)
RENADIC = Format(
    "RENADIC",
    "RENADIC (Universidad de Chile)",
    "first line UNCORRECTED ACCELEROGRAM DATA PROCESSED with RENADIC below",
    re.compile(_VOLUME_1.pattern + _OF_RENADIC, re.I),
    in_blocks(_VOLUME_1, partial(_digitised, _RENADIC, is_even=True)),
    "RENADIC",
)
BHRC = Format(
    "BHRC",
    "BHRC, Iran",
    "first line * VOL1DS FILE:",
    _BHRC_FIRST,
    in_blocks(_BHRC_FIRST, _bhrc),
    "BHRC",
)
CSMIP = Format(
    "CSMIP V1/V2",
    "California Geological Survey (CSMIP, CDMG)",
    "first line like Uncorrected Accelerogram Data Processed, or Corrected accelerogram Chan",
    _CSMIP_FIRST,
    _read_csmip,
    "CSMIP_V1V2",
)
