"""AFAD/NSMN text of Turkey: a header, then three columns named by direction, in gal."""

import re

from rocking.records.accelerogram import Accelerogram
from rocking.records.directions import azimuth, is_vertical
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import (
    magnitude,
    mapping,
    numeric,
    optional_number,
    place_of,
    starts,
    valued,
)
from rocking.records.formats.text import count, in_columns, lines, numbers, whole
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"STRONG GROUND MOTION RECORDS OF T", re.I)
_HEADER = 40


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    text = lines(content)
    at = place_of(text[:_HEADER], _columns, f"names the columns (N-S, E-W, U-D) in the first {_HEADER}")
    pairs, columns = mapping(text[:at]), _columns(text[at])
    values = numbers("\n".join(text[at + 1 :]).encode("latin-1"))
    table = in_columns(values, len(columns))
    declared = count("NUMBER OF DATA", valued(pairs, "NUMBER OF DATA"))
    _, notes = whole(table[:, 0], declared, per_line=1)
    return [_record(pairs, label, table[:, i], notes, options) for i, label in enumerate(columns)]


def _columns(line: str) -> list[str]:
    labels = line.split()
    return labels if len(labels) > 1 and all(azimuth(x) is not None or is_vertical(x) for x in labels) else []


def _record(pairs: dict[str, str], component: str, values, notes, options: Options) -> Accelerogram:
    peaks = next((key for key in pairs if "PGA" in key), "")
    record = accelerogram(
        options.unit_of("gal"),
        values,
        options.time_step_of(numeric(pairs, "SAMPLING INTERVAL (SEC)")),
        component=component,
        warnings=notes,
        station=pairs.get("STATION ID", ""),
        event=pairs.get("EARTHQUAKE DATE", ""),
        network="TK",
        magnitude=magnitude(pairs.get("EARTHQUAKE MAGNITUDE", "")),
        processed="RAW" not in peaks,
    )
    stated = optional_number(rf"\({re.escape(component)}\)\s*(-?[\d.]+)", pairs.get(peaks, ""))
    return agree_with_header(record, stated, "gal", half_digit=5e-7)


AFAD = Format("AFAD/NSMN text", "AFAD, Turkey", "first line STRONG GROUND MOTION RECORDS OF TURKIYE",
              lambda content: starts(content, _FIRST), _read, plugin="AFAD")  # fmt: skip
