"""GeoNet (New Zealand) text, V1A and V2A: mm/s² in columns of 8, one block per component."""

import re

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import (
    blocks,
    check_duration,
    coordinates,
    corner,
    distance,
    optional,
    optional_number,
    required,
    typed_magnitude,
)
from rocking.records.formats.text import count, filled, lines, number
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"(Un)?corrected accelerogram\s", re.I)
_TEXT, _HEADER, _PER_LINE, _WIDTH = 16, 26, 10, 8
_PREPENDED = 31
"""Place in the integer header of the number of samples put before the first digitised one, from which times count.

After GNS accelerogram data files, Standard Format (2008).
"""
_STEP = r"intervals of\s+([\d.]+)\s*s|data at\s+([\d.]+)\s*sec intervals"


def _recognise(content: bytes) -> bool:
    head = lines(content, 3)
    return bool(_FIRST.match(head[0])) and len(head) > 1 and head[1].startswith("Site ")


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    found = blocks(content, _FIRST)
    note = f"A GeoNet file holds 3 components, but this one holds {len(found)}."
    return [_record(block, options, (note,) if len(found) % 3 else ()) for block in found]


def _record(block: list[str], options: Options, notes: tuple[str, ...]) -> Accelerogram:
    head = "\n".join(block[:16])
    declared = count(
        "Number of points", required("the number of points", r"^Number of points\s+(\S+)", head)[1]
    )
    factor = number("raw unit", optional(r"readings in units of\s+([\d.]+)\s*mm/s/s", head) or "1")
    required("acceleration in mm/s/s", r"^Acceleration:\s+peak\s+\S+\s+mm/s/s", head)
    steps = required("the sampling step", _STEP, head)
    values = _samples(block[_HEADER:], declared)
    time_step = number("step", steps[1] or steps[2])
    if duration := optional(r"\bDuration\s+([\d.]+)", head):
        check_duration("Duration", duration, declared, time_step)
    record = options.accelerogram(
        "mm/s2",
        values * factor,
        time_step,
        component=optional(r"^Component\s+(\S+)", head),
        warnings=notes,
        station=optional(r"^Site\s+(\S+)", head),
        event=optional(r"^(\d{4} \w+ \d+)\s", head),
        network="NZ",
        **typed_magnitude(optional(r"^Epicentre\b.*\b(M[A-Za-z]\s+[\d.]+)", head)),
        event_time=optional(r"^(\d{4} \w+ \d+\s+[\d:]+)", head),
        **coordinates(optional(r"^Site\s+\S+\s+(.*)", head)),
        epicentral_distance=distance(optional(r"^Epicentre\b.*\bDist\s+([\d.]+)\s*km", head)),
        processed=block[0].lower().startswith("corrected"),
        high_pass_frequency=corner(optional_number(r"transition bands are\s+([\d.]+)", head)),
    )
    peak = optional_number(r"^Acceleration:\s+peak\s+(-?[\d.]+)", head)
    at = optional_number(r"^Acceleration:\s+peak\s+\S+\s+mm/s/s at\s+([\d.]+)\s*s", head)
    integers = " ".join(block[_TEXT : _TEXT + 4]).split()
    if at is not None and len(integers) == 40 and integers[_PREPENDED].isdecimal():
        at += int(integers[_PREPENDED]) * time_step
    return agree_with_header(record, peak, "mm/s2", half_digit=0.05, at=at)


def _samples(rows: list[str], declared: int) -> np.ndarray:
    """Return the acceleration, which a corrected file follows by as many lines of velocity and of displacement."""
    rows = [row for row in rows if row.strip()]
    wanted = -(-declared // _PER_LINE)
    if len(rows) in (wanted, 3 * wanted):
        return filled(rows[:wanted], declared, _PER_LINE, _WIDTH)
    raise RecordError(
        f"the header declares {declared} samples, which fill {wanted} lines once or thrice, but {len(rows)} "
        "stand there: lines are missing or repeated, the file is truncated or damaged; fetch it again."
    )


GEONET = Format("GeoNet V1A/V2A", "GeoNet (GNS Science), New Zealand",
    "first line Corrected or Uncorrected accelerogram above a Site line", _recognise, _read, "GEONET")  # fmt: skip
