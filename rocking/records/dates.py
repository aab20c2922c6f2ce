"""Dates of earthquakes: the spellings of two dozen agencies as one, ISO 8601."""

import re
from datetime import datetime, timedelta, timezone

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
_AHEAD = {
    "Z": 0, "UT": 0, "UTC": 0, "GMT": 0, "JST": 9, "BTM": 8, "PST": -8, "PDT": -7, "MST": -7, "MDT": -6, "EST": -5,
    "EDT": -4, "NZST": 12, "NZDT": 13,
}  # fmt: skip
"""Hours ahead of universal time of each zone that headers name; CST is another in America and in China."""
_CENTURY = 30
"""A year of two digits from here on is of the twentieth century: no digital record is older than 1930."""


def iso_date(text: str) -> str:
    """Return the date, and the time as far as it is given, of `text` in ISO 8601; `text` where it is no date.

    The zone is the one that the text names, and none where it names none. Of "2/9/1971" the month stands first, as in
    the files of American agencies, unless only the second number can be one.

    >>> iso_date("Mon Feb 13, 2012 13:06:45.0 PST"), iso_date("1/17/94, 12:31")
    ('2012-02-13T13:06:45-08:00', '1994-01-17T12:31')
    """
    for spelling in _SPELLINGS:
        if match := spelling.fullmatch(text):
            return _iso(match.groupdict()) or text
    return text


def day_of(text: str) -> str:
    """Return the day of a date in ISO 8601, in any other text what it is."""
    is_iso = re.match(r"\d{4}-\d\d-\d\d(?:T|$)", text)
    return text[:10] if is_iso else text


def _iso(parts: dict[str, str | None]) -> str:
    """Return the parts of a date as ISO 8601; "" where there is no such day, time or zone."""
    zone = (parts["zone"] or "").upper()
    hour = parts["hour"]
    minute = parts["minute"]
    seconds = float(parts["second"] or 0)
    try:
        day = datetime(*_year_month_day(parts), int(hour or 0), int(minute or 0), int(seconds))
        offset = _offset(zone)
    except ValueError:
        return ""
    if not hour:
        return f"{day:%Y-%m-%d}"
    if parts["second"] is None:
        time = f"{day:%Y-%m-%dT%H:%M}"
    else:
        digits = f"{seconds % 1:.6f}".rstrip("0").rstrip(".")[1:]
        time = f"{day:%Y-%m-%dT%H:%M:%S}{digits}"
    return time + offset


def _year_month_day(parts: dict[str, str | None]) -> tuple[int, int, int]:
    year = int(parts["year"] or 0)
    if year < 100:
        year += 1900 if year >= _CENTURY else 2000
    day = int(parts["day"] or 0)
    if word := parts.get("word"):
        return year, _MONTHS.index(word[:3].lower()) + 1, day
    month = int(parts["month"] or 0)
    if month > 12 >= day:
        month, day = day, month
    return year, month, day


def _offset(zone: str) -> str:
    """Return a zone as ISO 8601 ends in it. Raises ValueError for one that is not known."""
    if not zone:
        return ""
    if zone[0] in "+-":
        return f"{zone[:3]}:{zone[-2:]}"
    if zone not in _AHEAD:
        raise ValueError(zone)
    ahead = timezone(timedelta(hours=_AHEAD[zone]))
    return "Z" if not _AHEAD[zone] else f"{datetime(2000, 1, 1, tzinfo=ahead):%z}"[:3] + ":00"
