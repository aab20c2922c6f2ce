"""Text below two header lines: a title, then number of samples and time step, then numbers, any number on a line."""

import re

from rocking.errors import RecordError
from rocking.quantities import acceleration_unit
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options
from rocking.records.formats.text import after_lines, count, is_number, lines, number, numbers, whole
from rocking.records.instrument import refuse_other_quantity

_HEAD = 12
_WORDS = re.compile(r"[A-Za-z=:,;()]+")
_UNIT = re.compile(r"(?:\b(?:in|units?(?: of| are|:)?)\s+|[(\[]\s*)([A-Za-z][\w/^*²]*)", re.I)
"""The unit follows the word "in" or "units", or stands in brackets."""
_LONGEST_STEP = 1.0
"""s; of a record, so that a line of two numbers is known for samples and step."""


def _announced(line: str) -> tuple[str, str] | None:
    """Return (samples, step) of a line that holds these two numbers and nothing else but words."""
    found = [part for part in _WORDS.sub(" ", line).split() if is_number(part)]
    if len(found) != 2 or len(_WORDS.sub(" ", line).split()) != 2:
        return None
    for samples, step in (found, found[::-1]):
        if samples.isdecimal() and int(samples) > 1 and "." in step and 0 < float(step) <= _LONGEST_STEP:
            return samples, step
    return None


def _titled(content: bytes) -> tuple[str, str] | None:
    head = [line for line in lines(content, _HEAD) if len(line) < 2000]
    if len(head) < 4 or all(is_number(cell) for cell in head[0].split()):
        return None
    found = _announced(head[1])
    if found is None:
        return None
    rows = [row.split() for row in head[2:-1] if row.strip()]
    if {len(row) for row in rows} == {2} and len(head[0].split()) == 2:
        return None  # two columns below their names
    return found if rows and all(is_number(cell) for row in rows for cell in row) else None


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    found = _titled(content)
    if found is None:
        raise RecordError("the second line does not give the number of samples and the time step.")
    title, second = lines(content, _HEAD)[:2]
    refuse_other_quantity(options.file, f"{title}\n{second}")
    unit = next(filter(None, (acceleration_unit(m[1]) for m in _UNIT.finditer(f"{title}\n{second}"))), None)
    declared = count("number of samples", found[0])
    per_line = max(len(row.split()) for row in lines(content, _HEAD)[2:])
    values, notes = whole(numbers(after_lines(content, 2)), declared, per_line)
    step = number("time step", found[1])
    event = title.strip()[:60]
    return [options.accelerogram(unit, values, step, event=event, warnings=notes, processed=None)]


TITLED = Format("titled column", "programs of analysis, files like KOBE.000",
    "title, then a line with number of samples and step, then numbers",
    lambda content: _titled(content) is not None, _read)  # fmt: skip


_EMOD3D = re.compile(r"\s*(\d+)\s+(\d\.\d+e[-+]\d\d)(\s+-?\d+){2}(\s+-?\d\.\d+e[-+]\d\d){4}\s*", re.I)
"""Number of samples, step, hours and minutes, and four reals below station and component."""


def _is_emod3d(content: bytes) -> bool:
    head = lines(content, 3)
    return len(head) == 3 and len(head[0].split()) >= 2 and _EMOD3D.fullmatch(head[1]) is not None


def _read_emod3d(content: bytes, options: Options) -> list[Accelerogram]:
    title, second = lines(content, 3)[:2]
    refuse_other_quantity(options.file, title)
    station, component = title.split()[:2]
    declared, step = second.split()[:2]
    values, notes = whole(numbers(after_lines(content, 2)), count("number of samples", declared), per_line=6)
    named = {"station": station, "component": component}
    seconds = number("time step", step)
    return [options.accelerogram(None, values, seconds, warnings=notes, processed=None, **named)]


EMOD3D = Format("EMOD3D text", "EMOD3D and ucgmsim, simulated and observed motion",
    "station and component above samples, step and six more numbers", _is_emod3d, _read_emod3d)  # fmt: skip
