"""CWB (Taiwan) free-format text: time and three components in columns of 10, gal."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import (
    check_duration,
    magnitude,
    mapping,
    numeric,
    optional,
    place_of,
    starts,
    valued,
)
from rocking.records.formats.sampling import even_step
from rocking.records.formats.text import fields, in_columns, is_number, lines
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"#Earthquake Information")
_HEADER, _WIDTH = 60, 10


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = place_of(text[:_HEADER], lambda line: line.startswith("#Data:"), f"#Data: in the first {_HEADER}")
    pairs = mapping([line.removeprefix("#") for line in text[:at]])
    unit = valued(pairs, "AMPLITUDEUNIT")
    if not unit.lower().startswith("gal"):
        raise RecordError(f"AmplitudeUnit is {unit!r}, but must be gal.")
    labels = re.findall(r"([A-Z])\(", valued(pairs, "DATASEQUENCE"))
    table = in_columns(fields(text[at + 1 :], _WIDTH), len(labels) + 1)
    step = _step(table[:, 0], pairs)
    return [_record(label, table[:, i], step, pairs, options) for i, label in enumerate(labels, 1)]


def _step(times, pairs: dict[str, str]) -> float:
    """Return the step of the times, after checking it and the length against the header."""
    step, rate = even_step(times), numeric(pairs, "SAMPLERATE(HZ)")
    if step is None or abs(step * rate - 1) > 1e-3:
        raise RecordError(f"SampleRate is {rate:g} Hz, but the times are not spaced so; the file is damaged.")
    check_duration("RecordLength(sec)", valued(pairs, "RECORDLENGTH(SEC)"), times.size, step, rounding=0.0)
    return step


def _record(component: str, values, step: float, pairs: dict[str, str], options: Options) -> Accelerogram:
    record = accelerogram(
        options.unit_of("gal"),
        values,
        options.time_step_of(step),
        component=component,
        station=pairs.get("STATIONCODE", ""),
        event=pairs.get("ORIGIN TIME(GMT+08)", ""),
        network="TW",
        magnitude=magnitude(*(value for key, value in pairs.items() if key.startswith("MAGNITUDE"))),
    )
    ends = optional(
        rf"({re.escape(component)}:.*)", "\n".join(f"{k[-1]}:{v}" for k, v in pairs.items() if "MAX" in k)
    )
    stated = [abs(float(t)) for t in re.split(r"[~\s:]+", ends)[1:] if is_number(t)]
    return agree_with_header(record, max(stated, default=None), "gal", half_digit=5e-4)


CWB = Format(
    "CWB",
    "Central Weather Bureau, Taiwan",
    "first line #Earthquake Information",
    lambda content: starts(content, _FIRST),
    _read,
    plugin="CWB",
)
