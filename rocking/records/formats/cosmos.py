"""COSMOS strong-motion text, V1 and V2: self-describing blocks, one per channel and quantity."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import blocks, corner, optional, optional_number, starts
from rocking.records.formats.text import count, fields, whole
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"(Corrected|Uncorrected)\s+(acceleration|velocity|displacement)\s+\(Format v", re.I)
_DATA = re.compile(
    r"^\s*(?P<n>\d+)\s+(?P<quantity>\w+)\s+pts,.*?units\s*=\s*(?P<unit>[\w/^]+)\.?\s*(?:\((?P<code>\d+)\))?\s*,?"
    r"\s*Format\s*=\s*\(\s*(?P<per_line>\d+)[FE](?P<width>\d+)",
    re.I,
)
_REALS = re.compile(r"^\s*(\d+)\s+Real-header values follow on\s+(\d+)\s+lines.*?\d+[FE](\d+)", re.I)
_UNITS = {"g": "g", "cm/sec2": "cm/s2", "cm/s2": "cm/s2", "cm/sec/sec": "cm/s2", "m/s2": "m/s2", "gal": "gal"}
_STEP, _PEAK = 33, 63
"""Places in the real header of the sampling step and of the largest value of the COSMOS format 1.20."""


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    found = [
        record for block in blocks(content, _FIRST) if (record := _block(block, name, options)) is not None
    ]
    if not found:
        raise RecordError(
            f"{name}: this COSMOS file holds velocity or displacement only; use the acceleration file."
        )
    return found


def _block(block: list[str], name: str, options: Options) -> Accelerogram | None:
    at, data = next(((i, m) for i, line in enumerate(block) if (m := _DATA.match(line))), (0, None))
    if data is None:
        raise RecordError(
            f"{name}: no line gives points, units and Format of the samples; the file is truncated."
        )
    if not data["quantity"].lower().startswith("accel"):
        return None
    head = "\n".join(block[:at])
    reals = _reals(block[:at], name)
    unit = options.unit_of(name, _unit(name, data["unit"]))
    values, told = _samples(block[at + 1 :], data, name)
    component = _component(head)
    record = accelerogram(
        name,
        COSMOS.name,
        unit,
        values,
        options.time_step_of(name, reals[_STEP]),
        component=component,
        warnings=told,
        station=optional(r"Code:\s*(\S+)", head),
        event=optional(r"(?:Rcrd|Record)?\s*(?:of)?\s*(.*)", block[1]),
        processed=block[0].lower().startswith("corrected"),
        high_pass_frequency=corner(optional_number(r"filtered below\s+([\d.]+)\s*Hz", head)),
    )
    agree_with_header(record, reals[_PEAK] if abs(reals[_PEAK] + 999) > 1e-3 else None, unit, half_digit=5e-7)
    return record


def _samples(rows: list[str], data: re.Match[str], name: str):
    declared = count(name, "number of points", data["n"])
    per_line, width = max(1, int(data["per_line"])), max(1, int(data["width"]))
    body = rows[: -(-declared // per_line)]
    if body and re.match(r"\s*(End-of-data|/&)", body[-1], re.I):
        body = body[:-1]
    return whole(name, fields(name, body, width), declared, per_line)


def _reals(head: list[str], name: str):
    for i, line in enumerate(head):
        if found := _REALS.match(line):
            values = fields(
                name, head[i + 1 : i + 1 + count(name, "real-header lines", found[2])], int(found[3]) or 1
            )
            if values.size > _PEAK:
                return values
    raise RecordError(
        f"{name}: the real header does not hold the {_PEAK + 1} values that give step and peak."
    )


def _unit(name: str, text: str) -> str:
    unit = _UNITS.get(text.lower().rstrip("."))
    if unit is None:
        raise RecordError(
            f"{name}: units of the samples are {text!r}, but must be one of {', '.join(_UNITS)}."
        )
    return unit


def _component(head: str) -> str:
    """Return the direction of the channel line ("360 deg" as 360, "Up"), else the channel code of the SCNL comment."""
    direction = optional(r"^Sta\s+Chan?\s*[^:]*:\s*([^(\n]*?)\s*\(", head)
    direction = direction.split(":")[-1].strip()
    if degrees := optional(r"^(\d+)\s*deg", direction):
        return degrees
    code = optional(r"<SCNL>\s*[^.\s]+\.([A-Z0-9]{3})\.", head)
    return code if direction.lower() in ("", "other") and code else direction


COSMOS = Format("COSMOS V1/V2", "first line like Corrected acceleration (Format v01.20",
                lambda content: starts(content, _FIRST), _read)  # fmt: skip
