"""PEER AT2 in every spelling of its header, and the VT2 and DT2 files that are not acceleration."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.header import Layout
from rocking.records.formats.text import after_lines, count, lines, number, numbers, whole

_STEPS = (
    re.compile(r"NPTS\s*=\s*(?P<npts>[^\s,]+)\s*,?\s*DT\s*=\s*(?P<dt>[0-9.+\-]+(E[+-]?\d+)?)", re.I),
    re.compile(r"^\s*(?P<npts>\d+)\s+(?P<dt>\S+)\s+NPTS\s*,\s*DT", re.I),
)
_UNITS = (
    (re.compile(r"\b(CM/SEC?(/SEC?|\*\*2|\^?2)|GAL)\b", re.I), "cm/s2"),
    (re.compile(r"\bM/SEC?(/SEC?|\*\*2|\^?2)", re.I), "m/s2"),
    (re.compile(r"\b(UNITS OF|UNITS ARE|ACCELERATION IN)\s*\(?G\b", re.I), "g"),
)
_VELOCITY_UNIT = re.compile(r"\bUNITS (OF|ARE) \(?(CM|M|IN)/S(EC)?\b(?!\s*[/*^\d])")
_LAYOUT = Layout(
    event_time=r"\A.*\n.*?(\d{1,2}/\d{1,2}/\d{2,4}(?:,? +\d{1,2}:?\d\d)?)", peak=r"PGA\s*=\s*([0-9.]+)\s*G\b",
    peak_unit="g", half_digit=5e-6,
)  # fmt: skip
_FILTER_POINTS = re.compile(r"HP\s*=\s*([0-9.]+)\s*HZ", re.I)
_POLES = re.compile(r"(-?\d+)\s+POLE\s+@\s*([0-9.]+)", re.I)
_HEADER_LINES = 8
_LONGEST_COMPONENT = 16
_MATCHED = "The header says that the record is matched to a spectrum: artificial, not a recorded motion."


def _header(content: bytes) -> tuple[list[str], re.Match[str]] | None:
    """Return the lines up to the one that gives NPTS and DT, and its match."""
    head = lines(content, _HEADER_LINES)
    for i, line in enumerate(head):
        if size := next((m for pattern in _STEPS if (m := pattern.search(line[:200]))), None):
            return head[: i + 1], size
    return None


def _quantity(header: list[str]) -> str:
    """Return the quantity a header names: acceleration unless it says velocity or displacement."""
    text = " ".join(header).upper()
    named = re.search(r"\b(VELOCITY|DISPLACEMENT)\b", text)
    if named and not re.search(r"\bACC(EL|\b)", text):
        return named[1].lower()
    return (
        "velocity" if _VELOCITY_UNIT.search(text) and not re.search(r"\bACC(EL|\b)", text) else "acceleration"
    )


def _kind(content: bytes) -> str:
    """Return the quantity of a PEER file, "" for another."""
    header = _header(content)
    return _quantity(header[0]) if header else ""


def _refuse(content: bytes, options: Options) -> list[Accelerogram]:
    raise RecordError(
        f"this is a PEER {_kind(content)} file, not acceleration; use the AT2 file of the same record."
    )


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    header = _header(content)
    if header is None:
        raise RecordError("the header holds no line with NPTS and DT; give a PEER AT2 file.")
    head, size = header
    text = "\n".join(head)
    unit = next((unit for pattern, unit in _UNITS if pattern.search(text)), "")
    declared = count("NPTS", size["npts"])
    values, warnings = whole(numbers(after_lines(content, len(head))), declared, per_line=8)
    record = _LAYOUT.channel(
        text,
        values,
        options,
        unit=unit,
        step=number("DT", size["dt"]),
        component=_component(head),
        station=_field(head, -2),
        event=_field(head, 0),
        warnings=(*warnings, *([_MATCHED] if re.search(r"\bmatched\b", head[0], re.I) else [])),
        processed=True,
        high_pass_frequency=_high_pass(text),
    )
    return [record]


def _field(head: list[str], index: int) -> str:
    fields = [field.strip() for field in head[1].split(",")] if len(head) > 1 else []
    return fields[index] if len(fields) >= 3 else ""


def _component(head: list[str]) -> str:
    title = re.sub(r"\([^()]*\)", "", head[1]).strip() if len(head) > 1 else ""
    spelled = re.search(r"(LONGITUDINAL|TRANSVERSE|VERTICAL)\s+COMP", title)
    if spelled:
        return spelled[1].title()
    last = title.rsplit(",", 1)[-1].strip() if "," in title else ""
    return last if len(last) <= _LONGEST_COMPONENT else ""


def _high_pass(text: str) -> float | None:
    points, poles = _FILTER_POINTS.search(text), _POLES.findall(text)
    corner = points[1] if points else poles[1][1] if len(poles) > 1 and poles[1][0] != "0" else "0"
    return float(corner) or None if corner.count(".") <= 1 and corner != "." else None


PEER_AT2 = Format("PEER AT2", "PEER (NGA databases), USA",
    "line with NPTS and DT in the first 8 lines of an acceleration file",
    lambda content: _kind(content) == "acceleration", _read, "PEER_AT2")  # fmt: skip
PEER_OTHER = Format("PEER VT2 or DT2", "PEER (NGA databases), USA",
    "NPTS and DT below VELOCITY or DISPLACEMENT TIME SERIES",
    lambda content: _kind(content) in ("velocity", "displacement"), _refuse)  # fmt: skip
