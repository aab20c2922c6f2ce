"""BHRC (Iran) text: Volume 1 blocks of evenly spaced samples in tenths of g."""

import re

from rocking.records.accelerogram import Accelerogram
from rocking.records.directions import is_vertical
from rocking.records.formats.format import Format, Options, accelerogram, without_offset
from rocking.records.formats.header import magnitude, optional, optional_number, starts
from rocking.records.formats.text import filled
from rocking.records.formats.volume1 import Block, channels

_SCALES = ("Mw", "Ms", "M", "ML", "mb")
"""Of magnitude, the preferred one first."""
_FIRST = re.compile(r"\* VOL1DS FILE:")
_PER_LINE, _WIDTH = 10, 13


def _read(content: bytes, options: Options) -> list[Accelerogram]:
    return [_record(block, options) for block in channels(content, _FIRST)]


def _record(block: Block, options: Options) -> Accelerogram:
    values = filled(block.rows, block.declared, _PER_LINE, _WIDTH)
    step = block.duration / block.declared
    notes: tuple[str, ...] = ()
    if block.rate and abs(block.rate * step - 1) > 1e-3:
        notes = (
            f"The header gives a rate of {block.rate:g} Hz, but duration and number of points a step of {step:g} s.",
        )
    unit = options.unit_of("g/10")
    values, offset = without_offset(values, unit)
    component = optional(r"^COMP\s+(\S+)", block.head)
    letter = component[:1].upper()
    return accelerogram(
        unit,
        values,
        options.time_step_of(step),
        component=component,
        station=optional(r"FILE:\s*(\w+)", block.head),
        event=optional(r"^Origin Time\s*:\s*(\S+\s+\S+)", block.head),
        magnitude=magnitude(
            *(optional(rf"^Epicenter\b.*\b{scale} ?(\d[\d.]*)", block.head) for scale in _SCALES)
        ),
        processing=(offset,),
        warnings=notes,
        vertical=is_vertical(letter),
        azimuth=_azimuth(block.head, letter),
    )


def _azimuth(head: str, letter: str) -> float | None:
    """Return the azimuth that the header gives to L or T."""
    return optional_number(rf"Azimuth\b.*\b{letter}\s+(\d+)", head) if letter in ("L", "T") else None


BHRC = Format(
    "BHRC",
    "BHRC, Iran",
    "first line * VOL1DS FILE:",
    lambda content: starts(content, _FIRST),
    _read,
    plugin="BHRC",
)
