"""GeoNet (New Zealand) text, V1A and V2A: mm/s² in columns of 8, one block per component."""

import re

from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import blocks, corner, optional, optional_number, required
from rocking.records.formats.text import count, fields, lines, number, whole
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"(Un)?corrected accelerogram\s", re.I)
_HEADER, _PER_LINE, _WIDTH = 26, 10, 8
_STEP = r"intervals of\s+([\d.]+)\s*s|data at\s+([\d.]+)\s*sec intervals"


def _recognise(content: bytes) -> bool:
    head = lines(content, 3)
    return bool(_FIRST.match(head[0])) and len(head) > 1 and head[1].startswith("Site ")


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    return [_record(block, name, options) for block in blocks(content, _FIRST)]


def _record(block: list[str], name: str, options: Options) -> Accelerogram:
    head = "\n".join(block[:16])
    declared = count(
        name,
        "Number of points",
        required(name, "the number of points", r"^Number of points\s+(\S+)", head)[1],
    )
    factor = number(name, "raw unit", optional(r"readings in units of\s+([\d.]+)\s*mm/s/s", head) or "1")
    required(name, "acceleration in mm/s/s", r"^Acceleration:\s+peak\s+\S+\s+mm/s/s", head)
    steps = required(name, "the sampling step", _STEP, head)
    rows = block[_HEADER : _HEADER + -(-declared // _PER_LINE)]
    values, told = whole(name, fields(name, rows, _WIDTH), declared, _PER_LINE)
    component = optional(r"^Component\s+(\S+)", head)
    record = accelerogram(
        name,
        GEONET.name,
        options.unit_of(name, "mm/s2"),
        values * factor,
        options.time_step_of(name, number(name, "step", steps[1] or steps[2])),
        component=component,
        warnings=told,
        station=optional(r"^Site\s+(\S+)", head),
        event=optional(r"^(\d{4} \w+ \d+)\s", head),
        network="NZ",
        processed=block[0].lower().startswith("corrected"),
        high_pass_frequency=corner(optional_number(r"transition bands are\s+([\d.]+)", head)),
    )
    agree_with_header(
        record, optional_number(r"^Acceleration:\s+peak\s+(-?[\d.]+)", head), "mm/s2", half_digit=0.05
    )
    return record


GEONET = Format(
    "GeoNet V1A/V2A", "first line Corrected or Uncorrected accelerogram above a Site line", _recognise, _read
)
