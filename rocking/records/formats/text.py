"""Numbers out of text, fast, yet strict about every character; the step of printed times; and dates as ISO 8601."""

import re
import warnings
from contextlib import suppress
from datetime import datetime

import numpy as np

from rocking.errors import RecordError
from rocking.quantities import is_number
from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning

_NUMERIC = b"0123456789+-.eE \t\n\r"
_LARGEST = 1e100
"""The largest plausible number; a larger one (or, in a header, one below its inverse) is damage, and would overflow."""


def lines(content: bytes, limit: int | None = None) -> list[str]:
    """Return the first `limit` lines (all by default) as text: bytes beyond ASCII as UTF-8, else as Latin-1."""
    head = content if limit is None else content[: 400 * limit]
    try:
        text = head.decode("utf-8")
    except UnicodeDecodeError as error:
        # The limit may cut the last character.
        is_cut = error.start >= len(head) - 3 and error.reason == "unexpected end of data"
        text = head[: error.start].decode("utf-8") if is_cut else head.decode("latin-1")
    return text.split("\n", -1 if limit is None else limit)[:limit]


def after_lines(content: bytes, number: int) -> bytes:
    """Return `content` after its first `number` lines."""
    return content.split(b"\n", number)[number] if content.count(b"\n") >= number else b""


def number(field: str, token: str) -> float:
    """Return `token` as a float. Raises RecordError naming file and field."""
    if not is_number(token.strip()):
        raise RecordError(
            f"{field} is {token.strip()[:40]!r}, but must be a number.", **{field: token.strip()}
        )
    value = float(token)
    if value and not 1 / _LARGEST < abs(value) < _LARGEST:
        raise RecordError(
            f"{field} is {token.strip()[:40]!r}, beyond what any header holds.", **{field: token.strip()}
        )
    return value


def count(field: str, token: str) -> int:
    """Return `token` as a whole number, zero or more. Raises RecordError naming file and field."""
    value = number(field, token)
    if value < 0 or value != int(min(value, 1e9)):
        raise RecordError(
            f"{field} is {token.strip()[:40]!r}, but must be a whole number from 0 to 1e9.",
            **{field: token.strip()},
        )
    return int(value)


def numbers(text: bytes | str) -> np.ndarray:
    """Return the numbers of `text`, separated by blanks and line ends, (n,); RecordError at the first that is none."""
    text = text.encode() if isinstance(text, str) else text
    if (values := _apart(text)) is not None:
        return values
    check_plain(text)
    raise RecordError(
        "the samples cannot be separated; every sample must be a plain decimal number.", samples=None
    )


def _apart(text: bytes) -> np.ndarray | None:
    """Return the numbers of a text, (n,), None where it holds anything else; RecordError at one beyond any size."""
    if not text.translate(None, _NUMERIC):
        with suppress(DeprecationWarning, ValueError), warnings.catch_warnings():
            warnings.simplefilter("error")
            values = np.fromstring(text, sep=" ") if text.strip() else np.empty(0)
            if values.size and not np.abs(values).max() < _LARGEST:
                at = int(np.argmax(~(np.abs(values) < _LARGEST)))
                raise RecordError(
                    f"number {at + 1} of the samples is {values[at]:g}, beyond {_LARGEST:g}.",
                    samples=float(values[at]),
                )
            return values
    return None


def check_plain(text: bytes) -> None:
    """Raise RecordError at the first word of `text` that is no plain decimal number."""
    if not text.translate(None, b"-0123456789 \t\n\r"):  # of whole numbers obspy refuses what is none
        return
    # A dash of typography is named before numbers that merely touch, which is how some formats write.
    for line, row in sorted(enumerate(lines(text), 1), key=lambda numbered: numbered[1].isascii()):
        for token in row.split():
            if not is_number(token):
                defect = f"line {line} of the samples holds {token[:40]!r}"
                raise RecordError(f"{defect}; every sample must be a plain decimal number.", samples=token)


def fields(rows: list[str], width: int = 0, margin: int = 0) -> np.ndarray:
    """Return the numbers of `rows`, (n,), apart by blanks; where they touch, by columns of `width` after a `margin`.

    width: 0 where they never touch. Raises RecordError where a word, or a column, is not one number.
    """
    text = "\n".join(rows)
    if not width or not text.isascii():
        return numbers(text)
    with suppress(RecordError):
        if (values := _apart(text.encode())) is not None:
            return values
    cells = re.findall(f".{{1,{width}}}", "\n".join(row.rstrip()[margin:] for row in rows))
    text = " ".join(cells)
    if len(text.split()) != len(cells) or any(map(str.isspace, cells)):
        broken = next(cell for cell in cells if len(cell.split()) != 1).strip()
        raise RecordError(f"a column of {width} characters holds {broken!r}, not one number.", samples=broken)
    return numbers(text)


def table(rows: list[str], columns: int, width: int = 0, margin: int = 0) -> np.ndarray:
    """Return the numbers of `rows` in columns, (n, columns), as fields() reads them; RecordError if one lacks."""
    values = fields(rows, width, margin)
    if not columns or not values.size or values.size % columns:
        raise RecordError(
            f"{values.size} numbers do not fill {columns} columns; the file is truncated.",
            samples=int(values.size),
        )
    return values.reshape(-1, columns)


def column_width(row: str) -> int:
    """Return the width of the columns of `row`, from the places of its first two decimal points."""
    points = [m.start() for m in re.finditer(r"\.", row)]
    return points[1] - points[0] if len(points) > 1 else max(1, len(row.rstrip()))


_FILLING = re.compile(rb"(?i)(?:[ \t,;]+nan)+[\s,;]*\Z")


def without_filling(body: bytes) -> tuple[bytes, tuple[RockingWarning, ...]]:
    """Return rows of numbers without the NaN that fill up the last one, and a warning where there were any."""
    match = _FILLING.search(body, max(0, len(body) - 4000)) if b"nan" in body[-200:].lower() else None
    if match is None:
        return body, ()
    return body[: match.start()] + b"\n", (RockingWarning(RecordKind.ROW_FILLED_UP),)


def whole(values: np.ndarray, declared: int, per_line: int) -> tuple[np.ndarray, tuple[RockingWarning, ...]]:
    """Return `values`, with a warning if there are up to a line more than `declared`.

    Raises RecordError when there are fewer (the file is cut) or many more (it holds something else).
    """
    if declared < 2:
        raise RecordError(
            f"the header declares {declared} samples, but must declare at least 2.", samples=declared
        )
    if values.size == declared:
        return values, ()
    stated = f"the header declares {declared} samples, but the file holds {values.size}"
    if values.size < declared:
        raise RecordError(
            f"{stated}: it is truncated or its header is another's; fetch the whole file.", samples=declared
        )
    if values.size > declared + per_line:
        raise RecordError(
            f"{stated}: more than one line too many; correct the header or cut the file.", samples=declared
        )
    return values, (RockingWarning.of(RecordKind.SAMPLES_SURPLUS, declared=declared, held=values.size),)


def filled(rows: list[str], declared: int, per_line: int, width: int, margin: int = 0) -> np.ndarray:
    """Return the `declared` numbers of a block whose every line but the last holds `per_line`, (declared,).

    Raises RecordError when lines are missing or repeated: the block ends elsewhere than its header says.
    """
    line_count = -(-declared // per_line)
    rows = [row for row in rows if row.strip()]
    if len(rows) < line_count or (len(rows) > line_count and declared > 1):
        state = "truncated" if len(rows) < line_count else "damaged"
        stated = f"the header declares {declared} samples, or {line_count} lines, but holds {len(rows)}"
        raise RecordError(
            f"{stated}: lines are missing or repeated, the file is {state}; fetch it again.", samples=declared
        )
    return whole(fields(rows, width, margin), declared, per_line=0)[0]


LARGEST_SERIES = 4_000_000
"""Samples of all channels of a file: five and a half hours at 200 Hz."""
_SMALLEST_STEP = 1e-6
_LONGEST_GAP = 5


def even_step(times: np.ndarray) -> float | None:
    """Return the step of `times` (n,) s if they are even within the rounding of their printing, else None.

    Raises RecordError when they do not increase.
    """
    if times.size < 2:
        raise RecordError(f"{times.size} times, but at least 2 are needed.", times=int(times.size))
    steps = np.diff(times)
    if steps.min() <= 0:
        at = int(np.flatnonzero(steps <= 0)[0])
        raise RecordError(
            f"time {times[at + 1]:g} s follows {times[at]:g} s, but times must increase.",
            times=float(times[at + 1]),
        )
    step = (times[-1] - times[0]) / (times.size - 1)
    if step < _SMALLEST_STEP:
        raise RecordError(
            f"the times are {step:g} s apart, less than any recorder's {_SMALLEST_STEP:g} s.", times=step
        )
    off = np.abs(times - (times[0] + step * np.arange(times.size))).max()
    shifted = (times * 10.0**digits for digits in range(9))
    digits = (n for n, scaled in enumerate(shifted) if np.allclose(scaled, np.round(scaled), 0, 1e-4))
    quantum = 10.0 ** -next(digits, 9)
    # Half a printed digit for the time itself, and as much for the line through the rounded first and last ones. A
    # digit as coarse as the step rounds nothing: a line that is missing would pass for rounding.
    allowed = max(0.01 * step, 1.02 * quantum if quantum < 0.9 * step else 0.0) + 1e-9 * abs(times[-1])
    if off > allowed or steps.max() - step > allowed:
        return None
    # A whole rate in Hz, or few digits, where that is as likely for times that were rounded.
    uncertainty = quantum / times.size + 1e-12 * step
    rate = round(1 / step)
    candidates = [1 / rate] if rate else []
    candidates += [float(f"{step:.{digits}g}") for digits in range(1, 10)]
    near = (float(candidate) for candidate in candidates if abs(candidate - step) <= uncertainty)
    return next(near, float(step))


def only_even_step(times: np.ndarray) -> float:
    """Return the step of `times` (n,) s. Raises RecordError where they are uneven."""
    if (step := even_step(times)) is None:
        raise RecordError(
            "the times are not even, but this format's are; the file is damaged; fetch it again.",
            times="uneven",
        )
    return step


def resampled(times: np.ndarray) -> tuple[float, np.ndarray, RockingWarning]:
    """Return (step, even times, the warning that says so) for uneven `times`: linear, at their median step.

    Raises RecordError at a gap of more than five of these steps: a line across it would be no record.
    """
    step = float(f"{np.median(np.diff(times)):.6g}")
    check_no_gap(times, _LONGEST_GAP * step)
    number = int((times[-1] - times[0]) / step) + 1
    if number > LARGEST_SERIES:
        raise RecordError(
            f"the times are uneven and would make {number} samples {step:g} s apart.", times=number
        )
    warning = RockingWarning.of(RecordKind.UNEVEN, samples=times.size, number=number, time_step_s=step)
    return step, times[0] + step * np.arange(number), warning


_APART = 0.005
"""s; the even step at which lines through points of film are sampled."""
_LONGEST_LINE = 0.25
"""s; the longest line between two points of film."""


def through_points(times: np.ndarray) -> tuple[float, np.ndarray, RockingWarning]:
    """Return (step, even times, the warning that says so) for points of film, a dozen to a hundred a second.

    They lie where the trace bends and are joined by lines. Raises RecordError at a gap.
    """
    check_no_gap(times, _LONGEST_LINE)
    even = np.arange(round(times[0] / _APART), int(times[-1] / _APART + 1e-6) + 1) * _APART
    return (
        _APART,
        even,
        RockingWarning.of(RecordKind.UNEVEN_FILM, samples=times.size, number=even.size, time_step_s=_APART),
    )


def check_no_gap(times: np.ndarray, longest: float) -> None:
    """Raise RecordError when two neighbours of `times` (n,) s are more than `longest` s apart."""
    gaps = np.diff(times)
    at = int(gaps.argmax())
    if gaps[at] > longest * (1 + 1e-9):
        gap = f"no samples between {times[at]:g} and {times[at + 1]:g} s, more than {longest:g} s apart"
        raise RecordError(
            f"{gap}; cut the record there, a gap is not bridged.",
            times=(float(times[at]), float(times[at + 1])),
        )


_MONTHS = ("jan", "feb", "mar", "apr", "may", "jun", "jul", "aug", "sep", "oct", "nov", "dec")
_MONTH = rf"(?P<word>(?:{'|'.join(_MONTHS)})[a-z]*)\.?"
_WEEKDAY = r"(?:(?:mon|tue|wed|thu|fri|sat|sun)[a-z]*\.?,?\s+)?"
_DATES = (
    r"(?P<year>\d{4})(?P<parting>[-/. ])(?P<month>\d\d?)(?P=parting)(?P<day>\d\d?)",
    r"(?P<year>\d{4})(?P<month>\d\d)(?P<day>\d\d)",
    rf"(?P<year>\d{{4}})[- ]{_MONTH}[- ](?P<day>\d\d?)",
    rf"{_WEEKDAY}{_MONTH}\s+(?P<day>\d\d?)\s*,?\s*(?P<year>\d{{4}})",
    rf"{_WEEKDAY}(?P<day>\d\d?)[- ]{_MONTH},?[- ](?P<year>\d{{4}})",
    r"(?P<month>\d\d?)/(?P<day>\d\d?)/(?P<year>\d{4}|\d\d)",
)
_TIME = r"(?P<hour>\d\d?):?(?P<minute>\d\d)(?::?(?P<second>\d\d(?:\.\d*)?))?"
_ZONE = r"\(?(?P<zone>[A-Za-z]{1,4}|[+-]\d\d:?\d\d)\)?"
_SPELLINGS = [
    re.compile(rf"\s*{date}(?:(?:\s*[,T]\s*|\s+|-){_TIME})?(?:\s*{_ZONE})?\s*", re.I) for date in _DATES
]
_ZONES = {
    "Z": "Z", "UT": "Z", "UTC": "Z", "GMT": "Z", "JST": "+09:00", "BTM": "+08:00", "PST": "-08:00", "PDT": "-07:00",
    "MST": "-07:00", "MDT": "-06:00", "EST": "-05:00", "EDT": "-04:00", "NZST": "+12:00", "NZDT": "+13:00",
}  # fmt: skip
"""The zones that headers name, as ISO 8601 writes them; CST is another in America and in China."""
_CENTURY = 30
"""A year of two digits from here on is of the twentieth century: no digital record is older than 1930."""


def iso_date(text: str) -> str:
    """Return the date, and the time as far as it is given, of `text` in ISO 8601; `text` where it is no date.

    The zone is the one that the text names, and none where it names none. Of "2/9/1971" the month is first, as in
    the files of American agencies, unless only the second number can be one.

    >>> iso_date("Mon Feb 13, 2012 13:06:45.0 PST"), iso_date("1/17/94, 12:31")
    ('2012-02-13T13:06:45-08:00', '1994-01-17T12:31')
    """
    match = next((found for spelling in _SPELLINGS if (found := spelling.fullmatch(text))), None)
    if match is None:
        return text
    parts = match.groupdict()

    year = int(parts["year"])
    if year < 100:
        year += 1900 if year >= _CENTURY else 2000
    day = int(parts["day"])
    month = _MONTHS.index(parts["word"][:3].lower()) + 1 if "word" in parts else int(parts["month"])
    if "word" not in parts and month > 12 >= day:
        month, day = day, month

    seconds = float(parts["second"] or 0)
    try:
        date = datetime(year, month, day, int(parts["hour"] or 0), int(parts["minute"] or 0), int(seconds))
    except ValueError:  # there is no such day or time
        return text
    zone = (parts["zone"] or "").upper()
    offset = f"{zone[:3]}:{zone[-2:]}" if zone[:1] in ("+", "-") else _ZONES.get(zone)
    if zone and offset is None:
        return text
    if not parts["hour"]:
        return f"{date:%Y-%m-%d}"
    if parts["second"] is None:
        time = f"{date:%Y-%m-%dT%H:%M}"
    else:
        fraction = f"{seconds % 1:.6f}".rstrip("0").rstrip(".")[1:]
        time = f"{date:%Y-%m-%dT%H:%M:%S}{fraction}"
    return time + (offset or "")


def day_of(text: str) -> str:
    """Return the day of a date in ISO 8601, in any other text what it is."""
    is_iso = re.match(r"\d{4}-\d\d-\d\d(?:T|$)", text)
    return text[:10] if is_iso else text
