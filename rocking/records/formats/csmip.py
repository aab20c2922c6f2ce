"""CSMIP/CDMG Volume 1 and 2 text: raw and corrected accelerograms, one block per channel, old and new spelling."""

import re

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import acceleration_factor
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, starts
from rocking.records.formats.header import (
    check_duration,
    check_equal,
    check_nothing_left,
    coordinates,
    corner,
    missing_channels,
    optional,
    optional_number,
)
from rocking.records.formats.text import column_width, count, filled, lines, number, period
from rocking.records.formats.volume1 import evened, pairs, volume1_block
from rocking.records.instrument import site_warnings
from rocking.records.plausibility import agree_with_header

_VOLUME_1 = re.compile(r"Uncorrected Accelerogram Data\s+Processed", re.I)
_VOLUME_2 = re.compile(r"Corrected accelerogram\s+.*Chan", re.I)
_VOLUME_3 = re.compile(r"(Response and )?Fourier amplitude spectr|Response (and|spectr)", re.I)
_DATA_1 = re.compile(
    r"^\s*(?P<n>\d+)\s+Accelerogram points at\s+(?P<rate>[\d.]+)\s*pts/sec in units of\s+(?P<unit>\S+?)\s*\.?\s+"
    r"Format:\s*\((?P<per_line>\d+)[FE](?P<width>\d+)", re.I,
)  # fmt: skip
_DATA_2 = re.compile(
    r"^\s*(?P<n>\d+)\s+points of (?P<quantity>accel|veloc|displ)\w* data equally spaced at\s+(?P<step>[\d.]+)\s*sec"
    r"[.,]?\s*(?:in|\(units:)\s*(?P<unit>[\w/]+)[.)]*\s*(?:\((?P<per_line>\d+)[FE](?P<width>\d+))?", re.I,
)  # fmt: skip
_PER_LINE = 8
"""Of the volumes before 2000, which do not say it."""


def _recognise(content: bytes) -> bool:
    if starts(content, _VOLUME_2):
        return True
    return starts(content, _VOLUME_1) and not any("RENADIC" in row.upper() for row in lines(content, 13))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text, start, blocks = lines(content), 0, []
    for i, line in enumerate(text):
        if line.startswith("/&"):
            blocks.append(text[start:i])
            start = i + 1
    if any(_announcement(line) or _VOLUME_1.match(line) for line in text[start:]):
        blocks.append(text[start:])
    else:
        check_nothing_left(text[start:])
    return [_channel(block, options, len(blocks)) for block in blocks]


def _announcement(line: str) -> re.Match[str] | None:
    return _DATA_1.match(line) or _DATA_2.match(line)


def _channel(block: list[str], options: Options, channels: int) -> Accelerogram:
    announced = [(i, data) for i, line in enumerate(block) if (data := _announcement(line))]
    if not announced and any(re.match(r"UNITS\b.*\bG/10", line, re.I) for line in block[:13]):
        return _film(block, options, channels)
    if not announced or (
        "quantity" in announced[0][1].groupdict() and announced[0][1]["quantity"].lower() != "accel"
    ):
        raise RecordError(
            "no line announces points of acceleration with their format; the file is truncated, "
            "or holds velocity or displacement only."
        )
    ends = [i for i, _ in announced[1:]] + [len(block)]
    parts = [_numbers(block[i + 1 : end], data) for (i, data), end in zip(announced, ends, strict=True)]
    head, data = "\n".join(block[: announced[0][0]]), announced[0][1]
    return _record(head, data, parts[0], options, channels)


def _numbers(rows: list[str], data: re.Match[str]) -> np.ndarray:
    per_line = int(data["per_line"] or _PER_LINE)
    width = int(data["width"] or column_width(rows[0] if rows else ""))
    return filled(rows, count("number of points", data["n"]), max(1, per_line), max(1, width))


def _record(
    head: str, data: re.Match[str], values: np.ndarray, options: Options, channels: int
) -> Accelerogram:
    corrected = bool(_VOLUME_2.match(head))
    said = data.groupdict()
    record = options.accelerogram(
        data["unit"],
        values,
        number("step", data["step"]) if "step" in said else period("points per second", data["rate"]),
        processed=corrected,
        high_pass_frequency=corner(
            optional_number(r"3 dB pts at\s+([\d.]+)", head) or optional_number(r"RAMPS AT\s+([\d.]+)", head)
        ),
        **_named(head, channels),
    )
    _check_sampling(head, values.size, record.time_step, corrected)
    if not corrected:
        return agree_with_header(record, *_uncorrected_peak(head))
    peak = optional_number(r"Peak acceleration\s*=\s*(-?[\d.]+)", head)
    at = optional_number(r"Peak acceleration\s*=.*?\bat\s+([\d.]+)\s*sec", head)
    return agree_with_header(record, peak, "cm/s2", 5e-4, at=at)


def _check_sampling(head: str, samples: int, time_step: float, corrected: bool) -> None:
    """Compare number and step of the samples with what the text above says of them."""
    if corrected:
        said = optional(r"^\s*(\S+)\s+points of instrument", head)
        interval = optional_number(r"^At equally-spaced intervals of\s+([\d.]+)", head)
    else:
        said = optional(r"^No\. of points\s*=\s*(\S+)", head)
        interval = None
        if duration := optional(r"Record length\s*=\s*([\d.]+)", head):
            check_duration("Record Length", duration, samples, time_step)
    if said:
        check_equal("the number of points", count("number of points", said), samples, 0)
    if interval:
        check_equal("the interval", interval, time_step)


def _uncorrected_peak(head: str) -> tuple[float | None, str, float]:
    return optional_number(r"Max\s*=\s*(-?[\d.]+)\s*g", head), "g", 5e-4


def _named(head: str, channels: int) -> dict:
    direction = optional(r"^Chan\s*\d+:\s*(\S+(?: Deg)?)", head)
    title = next((row.strip() for row in head.split("\n") if re.search(r"\bEARTHQUAKE\b", row)), "")
    place = optional(r"\bLocation:\s*(.*?)\s*$", head)
    return coordinates(optional(r"^Station No\.\s*\S+\s+(.*)", head)) | {
        "component": re.sub(r"\s+deg$", "", direction, flags=re.I),
        "station": optional(r"^Station No\.\s*(\S+)", head),
        "event": optional(r"^(?:Rcrd|Record) of\s+(.{10,40}?)(?:\s{2,}|$)", head) or title[:60],
        "warnings": (*missing_channels(head, channels), *site_warnings(place)),
    }


def _film(block: list[str], options: Options, channels: int) -> Accelerogram:
    """Return a raw channel digitised from film: (t, a) pairs in seconds and tenths of g."""
    film = volume1_block(block)
    times, values = pairs(film, margin=0)
    step, even, notes = evened(times, values)
    named = _named(film.head, channels)
    named["warnings"] = (*notes, *named["warnings"])
    record = options.accelerogram("g/10", even, step, processing=notes, **named)
    samples = values * acceleration_factor("g/10")
    return agree_with_header(record, *_uncorrected_peak(film.head), samples=samples)


def _refuse(content: bytes, options: Options) -> list[Accelerogram]:
    raise RecordError("this is a Volume 3 file of spectra, not a time history; use the V1 or V2 file.")


CSMIP = Format("CSMIP V1/V2", "California Geological Survey (CSMIP, CDMG)",
    "first line like Uncorrected Accelerogram Data Processed, or Corrected accelerogram Chan", _recognise,
    _read, "CSMIP_V1V2")  # fmt: skip
SPECTRA = Format("CSMIP V3 spectra", "California Geological Survey (CSMIP, CDMG)",
    "first line that names response or Fourier spectra", _VOLUME_3, _refuse)  # fmt: skip
