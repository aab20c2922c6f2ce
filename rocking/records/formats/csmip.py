"""CSMIP/CDMG Volume 1 and 2 text: uncorrected and corrected accelerograms, one block per channel."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import corner, optional, optional_number, starts
from rocking.records.formats.text import count, fields, lines, number, whole
from rocking.records.plausibility import agree_with_header

_VOLUME_1 = re.compile(r"Uncorrected Accelerogram Data\s+Processed")
_VOLUME_2 = re.compile(r"Corrected accelerogram\s+.*Chan", re.I)
_VOLUME_3 = re.compile(r"(Response and )?Fourier amplitude spectr|Response (and|spectr)", re.I)
_DATA_1 = re.compile(
    r"^\s*(?P<n>\d+)\s+Accelerogram points at\s+(?P<rate>[\d.]+)\s*pts/sec in units of\s+(?P<unit>\S+?)\s*\.?\s+"
    r"Format:\s*\((?P<per_line>\d+)[FE](?P<width>\d+)", re.I,
)  # fmt: skip
_DATA_2 = re.compile(
    r"^\s*(?P<n>\d+)\s+points of accel data equally spaced at\s+(?P<step>[\d.]+)\s*sec,\s*in\s+(?P<unit>[\w/]+)\.?\s*"
    r"\((?P<per_line>\d+)[FE](?P<width>\d+)", re.I,
)  # fmt: skip
_UNITS = {"g": "g", "cm/sec2": "cm/s2", "cm/sec/sec": "cm/s2", "cm/s/s": "cm/s2", "g/10": "g/10"}


def _read(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    text, found, start = lines(content), [], 0
    for i, line in enumerate(text):
        if data := _DATA_1.match(line) or _DATA_2.match(line):
            found.append(_channel("\n".join(text[start:i]), data, text[i + 1 :], name, options))
        elif line.startswith("/&"):
            start = i + 1
    if not found:
        raise RecordError(
            f"{name}: no line announces points of acceleration with their format; the file is truncated."
        )
    return found


def _channel(head: str, data: re.Match[str], rows: list[str], name: str, options: Options) -> Accelerogram:
    corrected = "step" in data.groupdict()
    declared, per_line = count(name, "number of points", data["n"]), max(1, int(data["per_line"]))
    values = fields(name, rows[: -(-declared // per_line)], max(1, int(data["width"])))
    values, told = whole(name, values, declared, per_line)
    step = number(name, "step", data["step"]) if corrected else 1 / _rate(name, data["rate"])
    component = _component(head)
    record = accelerogram(
        name,
        CSMIP.name,
        options.unit_of(name, _unit(name, data["unit"])),
        values,
        options.time_step_of(name, step),
        component=component,
        station=optional(r"^Station No\.\s*(\S+)", head),
        warnings=told,
        processed=corrected,
        event=optional(r"^(?:Rcrd|Record) of\s+(.{10,40}?)(?:\s{2,}|$)", head),
        high_pass_frequency=corner(optional_number(r"3 dB pts at\s+([\d.]+)", head)),
    )
    if corrected:
        agree_with_header(record, optional_number(r"Peak acceleration\s*=\s*(-?[\d.]+)", head), "cm/s2", 5e-4)
    else:
        agree_with_header(record, optional_number(r"Max\s*=\s*(-?[\d.]+)\s*g", head), "g", 5e-4)
    return record


def _rate(name: str, text: str) -> float:
    rate = number(name, "points per second", text)
    if not rate > 0:
        raise RecordError(f"{name}: points per second is {text!r}, but must be greater than 0.")
    return rate


def _unit(name: str, text: str) -> str:
    if text.lower() not in _UNITS:
        raise RecordError(
            f"{name}: units of the samples are {text!r}, but must be one of {', '.join(_UNITS)}."
        )
    return _UNITS[text.lower()]


def _component(head: str) -> str:
    direction = optional(r"^Chan\s*\d+:\s*(\S+(?: Deg)?)", head)
    return direction.removesuffix(" Deg").removesuffix(" deg")


def _is_spectra(content: bytes) -> bool:
    return starts(content, _VOLUME_3)


def _refuse(content: bytes, name: str, options: Options) -> list[Accelerogram]:
    raise RecordError(
        f"{name}: this is a Volume 3 file of spectra, not a time history; use the V1 or V2 file."
    )


CSMIP = Format("CSMIP V1/V2", "first line like Uncorrected Accelerogram Data Processed, or Corrected accelerogram Chan",
               lambda content: starts(content, _VOLUME_1) or starts(content, _VOLUME_2), _read)  # fmt: skip
SPECTRA = Format(
    "CSMIP V3 spectra", "first line that names response or Fourier spectra", _is_spectra, _refuse
)
