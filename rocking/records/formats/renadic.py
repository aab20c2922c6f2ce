"""RENADIC (Chile) text: Volume 1 blocks of (t, a) pairs in seconds and tenths of g."""

import re

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, accelerogram
from rocking.records.formats.header import missing_channels, optional, optional_number, starts
from rocking.records.formats.sampling import even_step
from rocking.records.formats.text import lines
from rocking.records.formats.volume1 import Block, channels, pairs
from rocking.records.plausibility import agree_with_header

_FIRST = re.compile(r"UNCORRECTED ACCELEROGRAM DATA\s+PROCESSED")


def _recognise(content: bytes) -> bool:
    return starts(content, _FIRST) and any("RENADIC" in line.upper() for line in lines(content, 13))


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    found = channels(content, _FIRST)
    return [_record(block, options, len(found)) for block in found]


def _record(block: Block, options: Options, held: int) -> Accelerogram:
    times, values = pairs(block, margin=0)
    step = even_step(times)
    if step is None:
        raise RecordError("the times are not evenly spaced, but RENADIC's are; the file is damaged.")
    record = accelerogram(
        options.unit_of("g/10"),
        values,
        options.time_step_of(step),
        component=optional(r"^CHAN\s*\d+:\s*(\S+)", block.head),
        station=optional(r"^(QDR S/N\s*\d+)", block.head),
        event=optional(r"^([\d/]+ [\d:]+)", block.head),
        warnings=missing_channels(block.head, held),
    )
    peak = optional_number(r"MAX\s*=\s*(-?[\d.]+)\s*G", block.head)
    return agree_with_header(record, peak, "g", half_digit=5e-4)


RENADIC = Format(
    "RENADIC",
    "RENADIC (Universidad de Chile)",
    "first line UNCORRECTED ACCELEROGRAM DATA PROCESSED with RENADIC below",
    _recognise,
    _read,
    plugin="RENADIC",
)
