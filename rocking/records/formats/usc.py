"""USC Volume 1 text: digitised film, unevenly spaced (t, a) pairs in seconds and tenths of g."""

import re

from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import optional, starts
from rocking.records.formats.volume1 import Block, channels, evened, pairs

_FIRST = re.compile(r"FILE\s+\d+\s+OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I", re.I)


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    return [_record(block, options) for block in channels(content, _FIRST)]


def _record(block: Block, options: Options) -> Accelerogram:
    times, values = pairs(block, margin=1)
    step, values, notes = evened(times, values)
    return accelerogram(
        options.unit_of("g/10"),
        values,
        options.time_step_of(step),
        component=optional(r"^COMP\s+(\S+)", block.head),
        station=optional(r"^STATION\s+(USC#\s*\d+)", block.head),
        event=block.head.split("\n")[1].strip()[:60],
        processing=notes,
        warnings=notes,
    )


USC = Format("USC Volume 1", "University of Southern California",
             "first line FILE n OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I",
             lambda content: starts(content, _FIRST), _read, plugin="USC_V1")  # fmt: skip
