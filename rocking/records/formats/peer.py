"""PEER AT2 in every spelling of its header; VT2 and DT2 files, which are not acceleration, are refused."""

import re

import numpy as np

from rocking.quantities import GRAVITY, acceleration_factor, is_number
from rocking.records.claims import (
    Claim,
    Declarations,
    Where,
    agreed,
    azimuth_of_sensor,
    factor_warnings,
    point_apart,
    refuse_other_quantity,
    warnings_of_claims,
)
from rocking.records.direction import directed
from rocking.records.formats.format import Format, Layout, Options
from rocking.records.formats.text import after_lines, count, lines, number, numbers, whole, without_filling
from rocking.records.kinds import RecordKind
from rocking.signal.accelerogram import RARE_PEAK, WEAK_PEAK, Accelerogram
from rocking.warnings import RockingWarning

_STEPS = (
    re.compile(
        r"NPTS\s*=\s*(?P<npts>[^\s,]+)\s*,?\s*DT\s*=\s*(?P<dt>[0-9.+\-]+(E[+-]?\d+)?)"
        r"(?P<milli>\s*M(?:ILLI)?-?S(?:EC\w*)?\b)?",
        re.I,
    ),
    re.compile(r"^\s*(?P<npts>\d+)\s+(?P<dt>\S+)\s+NPTS\s*,\s*DT", re.I),
)
_LAYOUT = Layout(
    "",
    {
        "event_time": r"\A.*\n.*?(\d{1,2}/\d{1,2}/\d{2,4}(?:,? +\d{1,2}:?\d\d)?)",
        "peak": r"PGA\s*=\s*([0-9.]+)\s*G\b",
    },
    peak_unit="g",
)
_FILTER_POINTS = re.compile(r"HP\s*=\s*([0-9.]+)\s*HZ", re.I)
_POLES = re.compile(r"(-?\d+)\s+POLE\s+@\s*([0-9.]+)", re.I)
_DATE_AT_END = re.compile(r"\s*\b\d{1,2}/\d{1,2}/\d{2,4}(?:,? +\d{1,2}:?\d\d)?$")
"""In a title like "DUZCE 11/12/99": the date is a separate fact."""
_IN_BRACKETS = re.compile(r"\([^()]*(?:\)|$)")
"""The sense of a direction, or a network of its own part, as in "CHI-CHI 09/20/99, CHY101, E, (CWB)".

A title may be cut within it, after 80 characters."""
_HEADER_LINES = 8
_LONGEST_COMPONENT = 16


def _head(content: bytes) -> tuple[list[str], re.Match[str] | None]:
    """Return the first lines up to the one with NPTS and DT, by which a file is known, and what that holds."""
    head = lines(content.lstrip(b"\n"), _HEADER_LINES)  # or a blank line above is taken for the title
    for place, line in enumerate(head, 1):
        if match := next(filter(None, (pattern.search(line[:200]) for pattern in _STEPS)), None):
            return head[:place], match
    return head, None


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    head, size = _head(content)
    assert size is not None  # by which the file is known
    text = "\n".join(head)
    declarations = Declarations.of(head)
    units = {claim.value for claim in declarations.claims if claim.what == "unit"}
    # What a line of its own says counts more than a title that speaks of an accelerogram.
    for line in head:
        refuse_other_quantity(line, bool(units))
    declared = count("NPTS", size["npts"])
    agreed("samples", declarations.claims)
    body = after_lines(content.lstrip(b"\n"), len(head))
    bare, filled = without_filling(body)
    is_filled = filled and len(bare.split()) == declared
    values, warnings = whole(numbers(bare if is_filled else body), declared, per_line=8)
    warnings += filled
    said = [*declarations.claims, *options.said]
    peak = np.abs(values).max()
    # Numbers in g under a head that says cm/s² would be 980 times too weak.
    if peak * GRAVITY <= RARE_PEAK and any(peak * acceleration_factor(unit) < WEAK_PEAK for unit in units):
        said.append(Claim("unit", "g", Where.FORMAT, "an AT2 of PEER is in g"))
    unit = agreed("unit", said) or ""
    parts = [part.strip() for part in head[1].split(",")] if len(head) > 1 else [""]
    while len(parts) > 1 and _IN_BRACKETS.fullmatch(parts[-1]):
        del parts[-1]
    title = ",".join(parts)
    poles = _POLES.findall(text)
    points = _FILTER_POINTS.search(text)
    corner = points[1] if points else poles[1][1] if len(poles) > 1 and poles[1][0] != "0" else "0"
    named = _component(title)
    component = azimuth_of_sensor(head) or named
    if point_apart(named, component):
        warnings += (RockingWarning.of(RecordKind.DIRECTION_SAID_TWICE, component, other=named),)
    # A sentence says where a channel points, and does not name it.
    facts = directed({"component": component or declarations.only("direction") or ""})
    facts |= {"component": component, "processed": True, "warnings": warnings}
    if re.search(r"\bmatched\b", head[0], re.I):
        facts["warnings"] += (RockingWarning(RecordKind.MATCHED_TO_SPECTRUM),)
    facts["warnings"] += factor_warnings(head)
    if len(parts) >= 3:
        undated = _DATE_AT_END.sub("", parts[0])
        facts |= {"station": parts[-2], "event": undated or parts[0]}
    facts["high_pass_frequency"] = float(corner) or None if is_number(corner) else None
    step = number("DT", size["dt"]) * (1e-3 if size.groupdict().get("milli") else 1.0)
    step = agreed("time_step", (Claim("time_step", step, Where.HEAD), *said)) or step
    record = _LAYOUT.channel(text, values, options, unit=unit, step=step, **facts)
    return [record.warned(*warnings_of_claims(record, declarations))]


def _component(title: str) -> str:
    title = _IN_BRACKETS.sub("", title).strip()
    if spelled := re.search(r"(LONGITUDINAL|TRANSVERSE|VERTICAL)\s+COMP", title):
        return spelled[1].title()
    last = title.rsplit(",", 1)[-1].strip() if "," in title else ""
    return last if len(last) <= _LONGEST_COMPONENT else ""


PEER_AT2 = Format(
    "PEER AT2",
    "PEER (NGA databases), USA",
    "line with NPTS and DT in the first 8 lines",
    lambda content: _head(content)[1] is not None,
    _read,
    "PEER_AT2",
)
