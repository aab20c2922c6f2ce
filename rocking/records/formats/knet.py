"""K-NET and KiK-net ASCII: counts with a scale factor, one component per file."""

import re
from datetime import datetime, timedelta

from rocking.errors import RecordError
from rocking.quantities import positive
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, without_offset
from rocking.records.formats.header import check_duration, coordinates, magnitude
from rocking.records.formats.text import after_lines, lines, number, numbers, period
from rocking.records.plausibility import agree_with_header

_FIELDS = (
    "Origin Time", "Lat.", "Long.", "Depth. (km)", "Mag.", "Station Code", "Station Lat.", "Station Long.",
    "Station Height(m)", "Record Time", "Sampling Freq(Hz)", "Duration Time(s)", "Dir.", "Scale Factor",
    "Max. Acc. (gal)", "Last Correction", "Memo.",
)  # fmt: skip
_KIKNET = {"1": "NS", "2": "EW", "3": "UD", "4": "NS", "5": "EW", "6": "UD"}
_BOREHOLE = {"1", "2", "3"}
_DELAY = timedelta(hours=9, seconds=15)
"""Times are Japanese, and the record time carries the 15 s delay of the recorder."""


def _recognise(content: bytes) -> bool:
    head = lines(content, 10)
    return len(head) == 10 and all(row.startswith(field) for row, field in zip(head, _FIELDS, strict=False))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    fields = _header(content)
    options.unit_of("gal")
    counts = numbers(after_lines(content, len(_FIELDS)))
    time_step = period("Sampling Freq(Hz)", fields["Sampling Freq(Hz)"].removesuffix("Hz"))
    duration = fields["Duration Time(s)"]
    check_duration("Duration Time(s)", duration, counts.size, time_step, rounding=-0.5 * time_step)
    values, offset = without_offset(counts * _scale(fields["Scale Factor"]), "gal")
    direction = fields["Dir."]
    record = options.accelerogram(
        "gal",
        values,
        time_step,
        component=_KIKNET.get(direction, direction),
        station=fields["Station Code"],
        event=f"{fields['Origin Time']} M{fields['Mag.']}",
        start_time=_start(fields["Record Time"]),
        magnitude=magnitude(fields["Mag."]),
        event_time=fields["Origin Time"],
        **coordinates(f"{fields['Station Lat.']}N {fields['Station Long.']}E", fields["Station Height(m)"]),
        processing=(offset,),
        network="BO",
        borehole=direction in _BOREHOLE,
    )
    peak = number("Max. Acc. (gal)", fields["Max. Acc. (gal)"])
    return [agree_with_header(record, peak, "gal", half_digit=5e-4)]


def _header(content: bytes) -> dict[str, str]:
    """Return the header by its fields. Raises RecordError when a line is missing."""
    head = lines(content, len(_FIELDS))
    fields = {
        key: row[len(key) :].strip() for key, row in zip(_FIELDS, head, strict=False) if row.startswith(key)
    }
    missing = [key for key in _FIELDS if key not in fields]
    if missing:
        raise RecordError(f"the header has no line {missing[0]!r}; a K-NET header has {len(_FIELDS)} lines.")
    return fields


def _scale(text: str) -> float:
    """Return gal per count from "3920(gal)/6182761"."""
    parts = re.fullmatch(r"([0-9.]+)\(gal\)/([0-9.]+)", text.replace(" ", ""))
    if not parts:
        raise RecordError(f"Scale Factor is {text!r}, but must look like 3920(gal)/6182761.")
    return number("Scale Factor", parts[1]) / positive(
        RecordError, "Scale Factor", number("Scale Factor", parts[2])
    )


def _start(text: str) -> str:
    try:
        return (datetime.strptime(text, "%Y/%m/%d %H:%M:%S") - _DELAY).isoformat() + "Z"
    except (ValueError, OverflowError):
        return ""


KNET = Format("K-NET/KiK-net", "NIED, Japan",
    "header that starts with Origin Time, Lat., Long., Depth. (km)", _recognise, _read)  # fmt: skip
