"""COSMOS strong-motion text, V1 and V2: self-describing blocks, one per channel and quantity."""

import re
from typing import Any

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_factor
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import Layout, blocks, check_nothing_left, distance, optional
from rocking.records.formats.text import count, fields, filled
from rocking.records.plausibility import agree_with_mean_square

_LAYOUT = Layout("", {
    "event": r"\A.*\n(?:Rcrd|Record)?[ \t]*(?:of)?[ \t]*(.*)", "station": r"Code:\s*(\S+)",
    "high_pass": r"filtered below\s+([\d.]+)\s*Hz", "corrected": r"\A(corrected)",
    "location": r"\bLocation:\s*(.*?)\s*$", "event_time": r"^Origin:\s*(\d.*?)\s*(?:\(.*)?$",
    "magnitude": r"^Hypocenter:.*?(M\w=.*)", "latitude": r"^Coords:\s*([-\d.]+)",
    "longitude": r"^Coords:\s*\S+\s+([-\d.]+)",
}, half_digit=5e-7)  # fmt: skip
_FIRST = re.compile(r"(Corrected|Uncorrected)\s+(acceleration|velocity|displacement)\s+\(Format v", re.I)
_DATA = re.compile(
    r"^\s*(?P<n>\d+)\s+(?P<quantity>\w+)\s+pts,.*?units\s*=\s*(?P<unit>[\w/^]+)\.?\s*(?:\((?P<code>\d+)\))?\s*,?"
    r"\s*Format\s*=\s*\(\s*(?P<per_line>\d+)[FE](?P<width>\d+)", re.I)  # fmt: skip
_REALS = re.compile(r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines.*?\d+[FE](\d+)", re.I)
_END = re.compile(r"\s*(End-of-data|/&)", re.I)
_ELEVATION, _DISTANCE, _RECORDER_STEP, _STEP, _LENGTH, _PEAK, _PEAK_TIME, _RMS = 2, 16, 33, 61, 62, 63, 64, 83
"""Places in the real header (COSMOS format 1.20): elevation of the station, m, and its distance from the epicentre, km;
step of the recorder, s, which is not that of a resampled series; of the series, step in ms, length, s, largest value
and its time; of a raw one its root mean square."""
_UNKNOWN = -999.0
_CODES = {"02": "g", "2": "g", "04": "cm/s2", "4": "cm/s2"}
"""Units of acceleration by their code in the format."""


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    every = blocks(content, _FIRST)
    records = [record for block in every if (record := _channel(block, options, len(every))) is not None]
    if not records:
        raise RecordError("this COSMOS file holds velocity or displacement only; use the acceleration file.")
    return records


def _channel(block: list[str], options: Options, held: int) -> Accelerogram | None:
    """Return the accelerogram of a block, or None where it is of another quantity."""
    at, data = next(((i, m) for i, line in enumerate(block) if (m := _DATA.match(line))), (0, None))
    if data is None:
        raise RecordError("no line gives points, units and Format of the samples; the file is truncated.")
    by_code = _CODES.get(data["code"] or "")
    if not data["quantity"].lower().startswith("accel"):
        if by_code:
            raise RecordError(f"a channel of {data['quantity']} has units of {by_code} by its code.")
        return None
    if acceleration_factor(by_code or data["unit"]) != acceleration_factor(data["unit"]):
        raise RecordError(f"the units are {data['unit']!r}, but their code {data['code']} says {by_code}.")
    head = "\n".join(block[:at])
    reals = _reals(block[:at])
    step = reals[_STEP] / 1000 if 0 < reals[_STEP] < 1e4 else reals[_RECORDER_STEP]
    values = _samples(block[at + 1 :], data)
    length, lasts = reals[_LENGTH], values.size * step
    wrong = 0 < length < 1e5 and abs(length - lasts) > 1.5 * step + 5e-4  # not all agencies fill it
    stated = [None if abs(real - _UNKNOWN) < 1e-3 else real for real in reals]
    note = f"The header gives the series a length of {length:g} s, but its samples last {lasts:g} s."
    facts: dict[str, Any] = {"component": _component(head), "warnings": (note,) if wrong else ()}
    facts |= {"elevation": stated[_ELEVATION], "epicentral_distance": distance(stated[_DISTANCE])}
    facts |= {"peak": stated[_PEAK], "peak_time": stated[_PEAK_TIME]}
    record = _LAYOUT.channel(head, values, options, unit=data["unit"], step=step, held=held, **facts)
    if record.processed or len(reals) <= _RMS:
        return record
    return agree_with_mean_square(record, reals[_RMS], data["unit"], digit=1e-6)


def _samples(rows: list[str], data: re.Match[str]) -> np.ndarray:
    end = next((i for i, row in enumerate(rows) if _END.match(row)), None)
    if end is None:
        raise RecordError("no line End-of-data ends a channel: the file is truncated; fetch it again.")
    check_nothing_left(rows[end + 1 :])
    declared = count("number of points", data["n"])
    return filled(rows[:end], declared, max(1, int(data["per_line"])), max(1, int(data["width"])))


def _reals(head: list[str]) -> list[float]:
    for i, line in enumerate(head):
        if match := _REALS.match(line):
            values = fields(head[i + 1 : i + 1 + count("real-header lines", match[2])], int(match[3]) or 1)
            if values.size == count("real-header values", match[1]) > _PEAK_TIME:
                return values.tolist()
    raise RecordError(
        "the real header does not hold the values it announces; the file is damaged; fetch it again."
    )


def _component(head: str) -> str:
    """Return the direction of the channel line ("360 deg" as 360, "Up"), else the channel code of the SCNL comment."""
    direction = optional(r"^Sta\s+Chan?\s*[^:]*:\s*([^(\n]*?)\s*\(", head).split(":")[-1].strip()
    if degrees := optional(r"^(\d+)\s*deg", direction):
        return degrees
    code = optional(r"<SCNL>\s*[^.\s]+\.([A-Z0-9]{3})\.", head)
    return code if direction.lower() in ("", "other") and code else direction


COSMOS = Format("COSMOS V1/V2", "COSMOS, CESMD and USGS, USA",
    "first line like Corrected acceleration (Format v01.20", _FIRST, _read, "COSMOS_V1V2")  # fmt: skip
