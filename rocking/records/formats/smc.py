"""USGS SMC text: ten header lines, integers, reals, comments, then cm/s² in touching columns."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, starts
from rocking.records.formats.header import corner, distance, magnitude, optional
from rocking.records.formats.text import column_width, fields, lines, whole
from rocking.records.plausibility import agree_with_header

_KINDS = {"0": "unknown", "1": "uncorrected accelerogram", "2": "corrected accelerogram", "3": "velocity",
          "4": "displacement", "5": "response spectrum", "6": "Fourier spectrum"}  # fmt: skip
_FIRST = re.compile(
    r"([0-6]) (UNKNOWN|UNCORRECTED ACC|CORRECTED ACC|VELOCITY|DISPLACEMENT|RESPONSE|FOURIER)", re.I
)
_TEXT, _INTEGERS, _REALS = 11, 6, 10
"""Lines of each part of the header."""
_COMMENTS, _SAMPLES = 15, 16
_RATE, _LARGEST, _SMALLEST, _CORNER = 1, 29, 31, 32
"""Places in the integer and in the real header; the time of an extreme stands before its value."""
_MISSING = 1.69e38


def _recognise(content: bytes) -> bool:
    return starts(content, _FIRST) and len(head := lines(content, 12)) == 12 and len(head[11].split()) == 8


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    kind = text[0][:1]
    if kind not in "012":
        raise RecordError(f"this SMC file holds {_KINDS.get(kind, kind)}, not acceleration.")
    integers = fields(text[_TEXT : _TEXT + _INTEGERS], 10)
    reals = fields(text[_TEXT + _INTEGERS : _TEXT + _INTEGERS + _REALS], 15)
    if integers.size < 48 or reals.size < 50:
        raise RecordError(
            f"the SMC header holds {integers.size} integers and {reals.size} reals, not 48 and 50."
        )
    first = _TEXT + _INTEGERS + _REALS + _whole(integers[_COMMENTS])
    comments = text[_TEXT + _INTEGERS + _REALS : first]
    if not all(row.startswith("|") for row in comments) or any(row.startswith("|") for row in text[first:]):
        raise RecordError(
            f"the header declares {len(comments)} lines of comment, but other lines begin with |; "
            "the file is damaged."
        )
    body = [row for row in text[first:] if row.strip()]
    width = column_width(body[0]) if body else 10
    values, notes = whole(fields(body, width), _whole(integers[_SAMPLES]), 80 // width)
    return [_record("\n".join(text[:_TEXT]), kind, values, notes, reals, options)]


def _record(head: str, kind: str, values, notes, reals, options: Options) -> Accelerogram:
    if not 0 < reals[_RATE] < 1e6:
        raise RecordError(
            f"samples per second is {reals[_RATE]:g}, but must be greater than 0 and below 1e6."
        )
    record = options.accelerogram(
        "cm/s2",
        values,
        1 / float(reals[_RATE]),
        component=optional(r"component\s*=\s*(\S+)", head),
        station=optional(r"station\s*=\s*(.*?)\s*component", head),
        warnings=notes,
        event=optional(r"^\s+\d{4}\s+\d+\s+\d+\s+\d{4}\s+(.*)$", head),
        magnitude=magnitude(
            *(optional(rf"{scale}=\s*([\d.]+)", head) for scale in ("Moment Mag", "Ms", "Ml"))
        ),
        epicentral_distance=distance(optional(r"epicentral dist\s*=\s*([\d.]+)", head)),
        processed=kind == "2",
        high_pass_frequency=corner(float(reals[_CORNER])),
    )
    extremes = [(abs(reals[i]), reals[i - 1]) for i in (_LARGEST, _SMALLEST) if abs(reals[i]) < _MISSING]
    if not extremes:
        return record
    peak, at = max(extremes)
    return agree_with_header(record, peak, "cm/s2", at=float(at) if 0 < at < _MISSING else None)


def _whole(value: float) -> int:
    if not 0 <= value < 1e8:
        raise RecordError(f"a count in the integer header is {value:g}, but must be from 0 to 1e8.")
    return int(value)


SMC = Format("USGS SMC", "U.S. Geological Survey",
    "first line like 2 CORRECTED ACCELEROGRAM above ten text lines and integers", _recognise, _read,
    "USGS_SMC")  # fmt: skip
