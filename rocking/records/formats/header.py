"""Headers: finding what they declare, and saying what is missing."""

import re
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from rocking.errors import RecordError
from rocking.records.formats.text import lines, number


def blocks(content: bytes, first_line: re.Pattern[str]) -> list[list[str]]:
    """Return the lines of each block of a file, a block starting at each line that matches `first_line`."""
    text = lines(content)
    starts = [i for i, line in enumerate(text) if first_line.match(line)]
    return [text[a:b] for a, b in pairwise([*starts, len(text)])]


def place_of(text: list[str], is_sought: Callable[[str], object], what: str) -> int:
    """Return the place of the first line that `is_sought`. Raises RecordError: no line `what`."""
    at = next((i for i, line in enumerate(text) if is_sought(line)), None)
    if at is None:
        raise RecordError(f"no line {what}; the file is cut.")
    return at


def required(what: str, pattern: str, text: str) -> re.Match[str]:
    """Return the first match of `pattern` in `text`. Raises RecordError saying `what` the header lacks."""
    found = re.search(pattern, text, re.I | re.M)
    if not found:
        raise RecordError(f"the header does not declare {what}; the file is damaged or not what it seems.")
    return found


def optional(pattern: str, text: str) -> str:
    """Return the first group of the first match of `pattern` in `text`, stripped, or ""."""
    found = re.search(pattern, text, re.I | re.M)
    return found[1].strip() if found else ""


def optional_number(pattern: str, text: str) -> float | None:
    """Return the first group of the first match as a float, or None when there is none or it is no number."""
    try:
        return float(optional(pattern, text).replace("_", "?"))
    except ValueError:
        return None


def mapping(text: list[str]) -> dict[str, str]:
    """Return the "KEY : value" lines as a mapping, keys stripped and in upper case; the first of a key counts."""
    pairs: dict[str, str] = {}
    for key, colon, value in (line.partition(":") for line in text):
        if colon:
            pairs.setdefault(key.strip().upper(), value.strip())
    return pairs


def valued(pairs: dict[str, str], key: str) -> str:
    """Return the value of `key`. Raises RecordError when it is missing or empty."""
    if not pairs.get(key):
        raise RecordError(f"the header gives no {key}; the file is damaged or not what it seems.")
    return pairs[key]


def numeric(pairs: dict[str, str], key: str) -> float:
    """Return the value of `key` as a number. Raises RecordError when it is missing or no number."""
    return number(key, valued(pairs, key))


def corner(value: float | None) -> float | None:
    """Return a high-pass corner in Hz, or None where the header says none (0, -999, nothing)."""
    return value if value is not None and 0 < value < 100 else None


def magnitude(*texts: str) -> float | None:
    """Return the first number of the first text that holds a magnitude; 0 and below stand for none."""
    found = (optional_number(r"(-?\d+(?:\.\d+)?)", text) for text in texts)
    return next((value for value in found if value is not None and 0 < value <= 10), None)


_SCALES = "Mw", "Ms", "M", "ML", "mb"
"""Of magnitude, the preferred one first."""
_TYPED = re.compile(
    r"\b(M[wslb]?)(?![a-z])\W{0,3}(\d\d?(?:\.\d+)?)|(\d\d?(?:\.\d+)?)\s*\(?(M[wslb]?)\b", re.I
)


def typed_magnitude(text: str) -> dict[str, Any]:
    """Return magnitude and magnitude_type of a text like "6.5 Mw", "4.0(Ms)" or "/mb=6.1/Mw=7.1", by preference."""
    scales = {scale.lower(): scale for scale in _SCALES}
    given = {scales[(m[1] or m[4]).lower()]: magnitude(m[2] or m[3]) for m in _TYPED.finditer(text)}
    scale = next((scale for scale in _SCALES if given.get(scale)), "")
    return {"magnitude": given[scale] if scale else magnitude(text), "magnitude_type": scale}


_ANGLE = r"(\d{1,3}(?:\.\d+)?)(?:[ °]+(\d\d?)[ ']+(\d\d?))?[ °\"]*(?:LAT\. *|LONG?\. *)?"
_COORDINATES = re.compile(rf"{_ANGLE}([NS])\b[\s,:-]*{_ANGLE}([EW])\b", re.I)


def coordinates(text: str, elevation: str = "") -> dict[str, float | None]:
    """Return latitude and longitude, degrees, of a text like "40.941N, 123.633W" or "42 37 10S 173 03 13E".

    elevation: the text of the height above the sea, m. What is not there, or is 0, 0, is left out.
    """
    place: dict[str, float | None] = {}
    if found := _COORDINATES.search(text):
        north, east = (
            (float(d) + float(m or 0) / 60 + float(s or 0) / 3600) * (-1 if side.upper() in "SW" else 1)
            for d, m, s, side in (found.groups()[:4], found.groups()[4:])
        )
        if abs(north) <= 90 and abs(east) <= 180 and (north, east) != (0, 0):
            place = {"latitude": north, "longitude": east}
    height = optional_number(r"(-?\d+(?:\.\d+)?)", elevation)
    return place if height is None or not -500 < height < 9000 else place | {"elevation": height}


def distance(kilometres: str) -> float | None:
    """Return the distance in m that a header gives in km, or None where it says none (-999, 32767, nothing)."""
    value = optional_number(r"^\s*(-?\d+(?:\.\d*)?)", kilometres)
    return 1000 * value if value is not None and 0 <= value <= 20_100 else None


def check_duration(
    field: str, text: str, samples: int, time_step: float, *, rounding: float | None = None
) -> None:
    """Check `samples` against the duration printed as `text`, s, within a step and what the print rounds.

    A record of n samples lasts n steps for some agencies and n - 1 for others. rounding: s, where it is not half of the
    last digit printed. Raises RecordError when they disagree.
    """
    declared = number(field, text)
    if rounding is None:
        rounding = 0.5 * 10.0 ** -len(text.strip().partition(".")[2])
    if abs(samples * time_step - declared) > 1.001 * time_step + rounding:
        raise RecordError(
            f"{field} is {declared:g} s, but the {samples} samples last {samples * time_step:g} s: "
            "it is truncated or its header belongs to another record; fetch the whole file."
        )


def check_equal(field: str, first: float, second: float, relative: float = 1e-3) -> None:
    """Check that two places of a header give the same number. Raises RecordError when they do not."""
    if abs(first - second) > relative * abs(first):
        raise RecordError(
            f"the header gives {field} as {first:g} and as {second:g}; it is damaged, fetch it again."
        )


def missing_channels(head: str, held: int) -> tuple[str, ...]:
    """Return a warning when `head` speaks of more channels of the record than the file holds."""
    spoken = optional_number(r"\(\s*(\d+)\s+Chns\s+of", head)
    if spoken is None or not held < spoken < 1e4:
        return ()
    return (f"The header speaks of {spoken:g} channels, but the file holds {held}.",)


def check_nothing_left(rows: list[str]) -> None:
    """Check that nothing but blanks follows the last channel. Raises RecordError: a channel is cut."""
    if any(row.strip() for row in rows):
        raise RecordError(
            f"{len(rows)} lines follow the end of the last whole channel: another channel is cut; "
            "fetch the whole file."
        )
