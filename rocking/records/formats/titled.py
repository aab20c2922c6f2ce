"""One series below a line of its number of samples and its step, which stands first or below a title."""

import re

from rocking.quantities import acceleration_unit
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats import text
from rocking.records.formats.format import Format, Options
from rocking.records.formats.remarks import OF_ACCELERATION, Declarations
from rocking.records.instrument import refuse_other_quantity

_FIRST_LINES = 12
"""Lines that are looked at, at the beginning."""
_WORDS = re.compile(r"[A-Za-z=:,;()]+")
_UNIT_IN_WORDS = re.compile(r"(?:\b(?:in|units?(?: of| are|:)?)\s+|[(\[]\s*)([A-Za-z][\w/^*²]*)", re.I)
"""The unit follows the word "in" or "units", or stands in brackets."""
LONGEST_STEP = 1.0
"""The longest step of a record, s, by which a line of two numbers is told to be samples and step."""


def _title(content: bytes) -> tuple[str, str] | None:
    """Return (samples, step) of a title and a line of these two and words above numbers, None of another file."""
    head = [line for line in text.lines(content, _FIRST_LINES) if len(line) < 2000]
    if len(head) < 4 or all(map(text.is_number, head[0].split())):
        return None
    rows = [row.split() for row in head[2:-1] if row.strip()]
    if {len(row) for row in rows} == {2} and len(head[0].split()) == 2:
        return None  # two columns below their names
    parts = _WORDS.sub(" ", head[1]).split()
    if not rows or len(parts) != 2 or not all(map(text.is_number, sum(rows, parts))):
        return None
    for samples, step in (parts, parts[::-1]):
        if samples.isdecimal() and int(samples) > 1 and "." in step and 0 < float(step) <= LONGEST_STEP:
            return samples, step
    return None


def heading_of(content: bytes) -> tuple[str, str] | None:
    """Return (samples, step) of a first line of these two, with or without words, above as many numbers, or None."""
    if b"\0" in content[:4096]:
        return None
    head = [line for line in text.lines(content, _FIRST_LINES) if len(line) < 2000]
    if len(head) < 4 or "NPTS" in head[0].upper():  # which is PEER's
        return None
    parts = _WORDS.sub(" ", head[0]).split()
    rows = [row.split() for row in head[1:-1] if row.strip()]
    if not rows or len(parts) != 2 or not all(map(text.is_number, sum(rows, parts))):
        return None
    found = len(text.after_lines(content, 1).split())
    for samples, step in (parts, parts[::-1]):
        is_count = samples.isdecimal() and int(samples) > 1
        if (
            is_count
            and "." in step
            and 0 < float(step) <= LONGEST_STEP
            and int(samples) in (found, found - 1)
        ):
            return samples, step
    return None


def _read_titled(content: bytes, options: Options) -> list[Accelerogram]:
    if heading := heading_of(content):
        return _below_title(b"\n" + content, options, *heading)
    samples, step = _title(content) or ("", "")
    return _below_title(content, options, samples, step, event=text.lines(content, 1)[0].strip()[:60])


def _below_title(content: bytes, options: Options, size: str, step: str, **names: str) -> list[Accelerogram]:
    title, second, *rows = text.lines(content, _FIRST_LINES)
    refuse_other_quantity(options.file, f"{title}\n{second}")
    above = f"{title}\n{second}"
    of_numbers = bool(OF_ACCELERATION.search(above))
    words = (match[1] for match in _UNIT_IN_WORDS.finditer(above) if of_numbers or match[0][0] not in "([")
    unit = next(filter(None, map(acceleration_unit, words)), None)
    per_line = max(len(row.split()) for row in rows)
    samples = text.count("number of samples", size)
    values, notes = text.whole(text.numbers(text.after_lines(content, 2)), samples, per_line)
    seconds = text.number("time step", step)
    facts = {"component": Declarations.of((title, second)).component} | names
    return [options.accelerogram(unit, values, seconds, warnings=notes, processed=None, **facts)]


_EMOD3D = re.compile(
    r"(?i)[ \t]*\S+[ \t]+\S.*\n[ \t]*(\d+)[ \t]+(\d\.\d+e[-+]\d\d)"
    r"([ \t]+-?\d+){2}([ \t]+-?\d\.\d+e[-+]\d\d){4}[ \t]*\n"
)
"""Station and component above number of samples, step, hours and minutes, and four reals."""


def _read_emod3d(content: bytes, options: Options) -> list[Accelerogram]:
    title, second = text.lines(content, 2)
    station, component = title.split()[:2]
    return _below_title(content, options, *second.split()[:2], station=station, component=component)


TITLED = Format(
    "titled column",
    "programs of analysis, files like KOBE.000",
    "line with number of samples and step, below a title or first, then numbers",
    lambda content: heading_of(content) is not None or _title(content) is not None,
    _read_titled,
)
EMOD3D = Format(
    "EMOD3D text",
    "EMOD3D and ucgmsim, simulated and observed motion",
    "station and component above samples, step and six more numbers",
    _EMOD3D,
    _read_emod3d,
)
