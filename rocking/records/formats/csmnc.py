"""CSMNC (China) text: sixteen header lines, then cm/s²."""

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import (
    check_duration,
    coordinates,
    optional,
    optional_number,
    required,
    typed_magnitude,
)
from rocking.records.formats.text import count, fields, lines, number, whole
from rocking.records.plausibility import agree_with_header

_HEADER, _PER_LINE, _WIDTH = 16, 8, 13


def _recognise(content: bytes) -> bool:
    head = lines(content, _HEADER)
    return any(x.startswith("NO. OF POINTS:") for x in head) and any(
        x.startswith("OBSERVING POINT:") for x in head
    )


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    head = "\n".join(text[:_HEADER])
    kind = required("the quantity and its unit", r"^(?:UN)?CORRECTED (\w+)\s+UNIT:\s*(\S+)", head)
    if kind[1].upper() != "ACCELERATION" or kind[2].upper() not in ("CM/SEC/SEC", "CM/S/S", "GAL"):
        raise RecordError(f"the file holds {kind[1]} in {kind[2]}, but must hold ACCELERATION in CM/SEC/SEC.")
    said = required(
        "points and interval", r"NO\. OF POINTS:\s*(\S+)\s+EQUALLY SPACED INTERVALS OF:\s*(\S+)", head
    )
    values, notes = whole(fields(text[_HEADER:], _WIDTH), count("NO. OF POINTS", said[1]), _PER_LINE)
    record = options.accelerogram(
        "cm/s2",
        values,
        number("interval", said[2]),
        component=optional(r"^COMP\.\s*(\S+)", head),
        warnings=notes,
        station=optional(r"^STATION:\s*(\S+)", head),
        event=text[2].strip()[:60],
        **typed_magnitude(optional(r"^MAGNITUDE\s+([\d.]+.*)", head)),
        event_time=optional(r"^\d+ +(\d{4}-\d\d-\d\d [\d:]+ \w+)", head),
        **coordinates(optional(r"^STATION:\s*\S+\s+(.*)", head)),
        processed=optional(r"^((?:UN)?CORRECTED) ", head).upper() == "CORRECTED",
    )
    if duration := optional(r"\bDURATION:\s*([\d.]+)", head):
        rounding = None if "." in duration else 1.0
        check_duration("DURATION", duration, values.size, record.time_step, rounding=rounding)
    peak = optional_number(r"^PEAK VALUE:\s*(-?[\d.]+)", head)
    at = optional_number(r"^PEAK VALUE:.*?\bAT\s+([\d.]+)\s*SEC", head)
    return [agree_with_header(record, peak, "cm/s2", half_digit=5e-4, at=at)]


CSMNC = Format("CSMNC", "China Strong Motion Networks Centre",
    "lines OBSERVING POINT: and NO. OF POINTS: in the first 16", _recognise, _read, "CSMNC")  # fmt: skip
