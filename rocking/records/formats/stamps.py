"""Stamps: times of day, with or without a date, with which the rows of a logger's table begin."""

import re

import numpy as np

_STAMP = re.compile(
    rb"(?m)^[ \t]*\"?(?:\d{1,4}[-/.]\d{1,2}[-/.]\d{1,4}[T ][ \t]*)?"
    rb"(\d{1,2}):(\d{2}):(\d{2}(?:\.\d*)?)(?:Z|[+-]\d{2}:?\d{2})?\"?(?=[ \t,;])"
)
_LOOKED_AT = 8_000
"""Bytes at the beginning of a file in which stamped rows stand, if it has any."""
_FEWEST = 12
"""Stamped rows from which on they are rows of a table, and no dates of a header."""
_DAY = 86_400.0
"""s."""


def in_seconds(content: bytes) -> bytes:
    """Return a table whose rows begin with times of day with seconds after the first in their place, else `content`."""
    if len(_STAMP.findall(content[:_LOOKED_AT])) < _FEWEST:
        return content
    stamps = np.array(_STAMP.findall(content)).astype(float)
    seconds = stamps @ np.array([3600.0, 60.0, 1.0])
    seconds += _DAY * np.cumsum(np.diff(seconds, prepend=seconds[0]) < -_DAY / 2)  # past midnight
    written = iter(np.round(seconds - seconds[0], 6).tolist())
    return _STAMP.sub(lambda _: b"%.6f" % next(written), content)
