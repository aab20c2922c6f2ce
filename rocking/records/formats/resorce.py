"""RESORCE/SHARE text: nine header lines, then m/s² in touching columns 14 wide."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import corner, mapping, numeric, optional_number, valued
from rocking.records.formats.text import count, fields, lines, whole
from rocking.records.plausibility import agree_with_header

_TITLE = re.compile(r"(Acc[a-z]*tion|Velocity|Displacement) time series in (\S+)", re.I)
_HEADER, _WIDTH, _PER_LINE = 20, 14, 5


def _title(content: bytes) -> tuple[int, re.Match[str]] | None:
    text = lines(content, _HEADER)
    if not text[0].startswith("Event Date & Time"):
        return None
    return next(((i, m) for i, line in enumerate(text) if (m := _TITLE.match(line))), None)


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    found = _title(content)
    if found is None:
        raise RecordError("no line names the time series and its unit; the file is cut.")
    at, title = found
    if not title[1].lower().startswith("acc"):
        raise RecordError(f"this RESORCE file holds {title[1].lower()}, not acceleration; use the .acc file.")
    text = lines(content)
    pairs = mapping(text[:at])
    declared = count("Number of Data", valued(pairs, "NUMBER OF DATA"))
    values = fields(text[at + 1 :], _WIDTH)
    values, notes = whole(values, declared, _PER_LINE)
    component, cuts = pairs.get("ORIENTATION", ""), pairs.get("FILTER CUT-OFF FREQUENCY (HZ)", "")
    record = accelerogram(
        options.unit_of("m/s2"),
        values,
        options.time_step_of(numeric(pairs, "TIME INCREMENT (S)")),
        component=component,
        warnings=notes,
        station=pairs.get("STATION CODE / NAME", ""),
        event=pairs.get("EVENT DATE & TIME", ""),
        processed=bool(cuts),
        high_pass_frequency=corner(optional_number(r"^\s*([\d.]+)", cuts)),
    )
    return [agree_with_header(record, optional_number(r"(.*)", pairs.get("PGA (M/S/S)", "")), "m/s2")]


RESORCE = Format("RESORCE", "RESORCE and SHARE, Europe",
                 "Event Date & Time at the start and a line that names the time series",
                 lambda content: _title(content) is not None, _read, plugin="RESORCE")  # fmt: skip
