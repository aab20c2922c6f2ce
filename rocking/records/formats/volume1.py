"""Volume 1 text of USC, RENADIC and BHRC: 13 lines of text, 7 of integers, 7 of reals, then samples in tenths of g."""

import re
from dataclasses import dataclass

import numpy as np

from rocking.errors import RecordError
from rocking.records.accelerogram import Accelerogram
from rocking.records.formats.format import Format, Options, starts, without_offset
from rocking.records.formats.header import (
    blocks,
    check_nothing_left,
    coordinates,
    missing_channels,
    optional,
    optional_number,
    required,
    typed_magnitude,
)
from rocking.records.formats.sampling import check_no_gap, even_step
from rocking.records.formats.text import count, fields, filled, in_columns, is_number, lines, number, whole
from rocking.records.instrument import is_vertical
from rocking.records.plausibility import agree_with_header

_HEADER, _REALS, _RATE = 27, 20, 8
_TEXT = 13
_STEP = 0.005
"""s; the even step to which film records are interpolated."""
_LONGEST_GAP = 0.25
"""s."""


@dataclass(frozen=True)
class Block:
    """One channel: its text header, the samples declared, the duration declared [s], and its rows of numbers."""

    head: str
    declared: int
    duration: float
    rows: list[str]
    rate: float | None
    """Samples per second, where the reals of the header say it."""


def volume1_block(text: list[str]) -> Block:
    """Return one channel from its lines. Raises RecordError when the header is cut or not in tenths of g."""
    head = "\n".join(text[:_TEXT])
    size = required(
        "points and length", r"NO\. OF POINTS\s*=\s*(\S+)\s+(?:DURATION|RECORD LENGTH)\s*=\s*([\d.]+)", head
    )
    required("units of G/10", r"^UNITS\b.*\bG/10", head)
    body = text[_HEADER:]
    end = next((i for i, row in enumerate(body) if row.startswith("/&")), len(body))
    check_nothing_left(body[end + 1 :])
    rows = [row for row in body[:end] if row.strip()]
    reals = " ".join(text[_REALS : _REALS + 2]).split()
    rate = float(reals[_RATE]) if len(reals) > _RATE and is_number(reals[_RATE]) else 0.0
    declared = count("NO. OF POINTS", size[1])
    return Block(head, declared, number("duration", size[2]), rows, rate if 1 <= rate <= 1e4 else None)


def pairs(block: Block, margin: int) -> tuple[np.ndarray, np.ndarray]:
    """Return (times, samples) of a block of five (t, a) pairs a line in columns of 7."""
    table = in_columns(fields(block.rows, 7, margin), 2)
    times = table[:, 0]
    whole(times, block.declared, per_line=0)
    step = (times[-1] - times[0]) / (times.size - 1)
    if abs(block.duration - times[-1]) > 2 * step + 0.001:  # which may count a last step or not
        raise RecordError(
            f"the header declares a length of {block.duration:g} s, but the last sample stands at {times[-1]:g} s; "
            "the file is damaged or its header belongs to another record."
        )
    return times, table[:, 1]


def evened(times: np.ndarray, values: np.ndarray) -> tuple[float, np.ndarray, tuple[str, ...]]:
    """Return (step, samples at even times, sentences) of a trace digitised from film: linear between its points.

    Raises RecordError at a gap: points were digitised where the trace bends, a dozen to a hundred a second.
    """
    step = even_step(times)
    if step is not None:
        return step, values, ()
    check_no_gap(times, _LONGEST_GAP)
    even = np.arange(round(times[0] / _STEP), int(times[-1] / _STEP + 1e-6) + 1) * _STEP
    sentence = f"The {times.size} samples are unevenly spaced; interpolated linearly to {even.size}, {_STEP:g} s apart."
    return _STEP, np.interp(even, times, values), (sentence,)


def _usc(block: Block, options: Options, _: int) -> Accelerogram:
    step, values, notes = evened(*pairs(block, margin=1))
    return options.accelerogram(
        "g/10",
        values,
        step,
        component=optional(r"^COMP\s+(\S+)", block.head),
        station=optional(r"^STATION\s+(USC#\s*\d+)", block.head),
        event=block.head.split("\n")[1].strip()[:60],
        processing=notes,
        warnings=notes,
    )


def _renadic(block: Block, options: Options, held: int) -> Accelerogram:
    times, values = pairs(block, margin=0)
    step = even_step(times)
    if step is None:
        raise RecordError("the times are not evenly spaced, but RENADIC's are; the file is damaged.")
    record = options.accelerogram(
        "g/10",
        values,
        step,
        component=optional(r"^CHAN\s*\d+:\s*(\S+)", block.head),
        station=optional(r"^(QDR S/N\s*\d+)", block.head),
        event=optional(r"^([\d/]+ [\d:]+)", block.head),
        warnings=missing_channels(block.head, held),
    )
    peak = optional_number(r"MAX\s*=\s*(-?[\d.]+)\s*G", block.head)
    return agree_with_header(record, peak, "g", half_digit=5e-4)


def _bhrc(block: Block, options: Options, _: int) -> Accelerogram:
    values, offset = without_offset(
        filled(block.rows, block.declared, per_line=10, width=13), options.unit_of("g/10")
    )
    step = block.duration / block.declared
    notes: tuple[str, ...] = ()
    if block.rate and abs(block.rate * step - 1) > 1e-3:
        notes = (
            f"The header gives a rate of {block.rate:g} Hz, but duration and number of points a step of {step:g} s.",
        )
    component = optional(r"^COMP\s+(\S+)", block.head)
    letter = component[:1].upper()
    return options.accelerogram(
        "g/10",
        values,
        step,
        component=component,
        station=optional(r"FILE:\s*(\w+)", block.head),
        event=optional(r"^Origin Time\s*:\s*(\S+\s+\S+)", block.head),
        **typed_magnitude(optional(r"^(Epicenter\b.*)", block.head)),
        event_time=optional(r"^Origin Time\s*:\s*(\S+\s+\S+)", block.head),
        **coordinates(
            optional(r"\bStation\s+(.*?)\s+Altitude", block.head), optional(r"\bAltitude\s+(\S+)", block.head)
        ),
        processing=(offset,),
        warnings=notes,
        vertical=is_vertical(letter),
        azimuth=optional_number(rf"Azimuth\b.*\b{letter}\s+(\d+)", block.head)
        if letter in ("L", "T")
        else None,
    )


def _volume1(
    name: str, origin: str, sought: str, first: re.Pattern[str], read, plugin: str, mark: str = ""
) -> Format:
    """Return the format whose channels start with a line like `first`; `mark` stands in the text below it."""

    def recognise(content: bytes) -> bool:
        return starts(content, first) and any(mark in line.upper() for line in lines(content, _TEXT))

    def read_all(content: bytes, options: Options) -> list[Accelerogram]:
        channels = [volume1_block(text) for text in blocks(content, first)]
        return [read(block, options, len(channels)) for block in channels]

    return Format(name, origin, sought, recognise, read_all, plugin)


USC = _volume1("USC Volume 1", "University of Southern California",
    "first line FILE n OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I",
    re.compile(r"FILE\s+\d+\s+OF UNCORRECTED ACCELEROGRAM DATA OF VOLUME I", re.I), _usc, "USC_V1")  # fmt: skip
RENADIC = _volume1("RENADIC", "RENADIC (Universidad de Chile)",
    "first line UNCORRECTED ACCELEROGRAM DATA PROCESSED with RENADIC below",
    re.compile(r"UNCORRECTED ACCELEROGRAM DATA\s+PROCESSED"), _renadic, "RENADIC", "RENADIC")  # fmt: skip
BHRC = _volume1(
    "BHRC", "BHRC, Iran", "first line * VOL1DS FILE:", re.compile(r"\* VOL1DS FILE:"), _bhrc, "BHRC"
)
