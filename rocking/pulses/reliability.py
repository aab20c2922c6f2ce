"""The reliability table: how often prediction by the pulse agreed with the whole record, by light and by ω_g/p."""

import csv
import math
from collections.abc import Iterable
from dataclasses import dataclass, fields
from functools import lru_cache
from pathlib import Path

from rocking.errors import PulseError
from rocking.pulses.evidence import Light
from rocking.quantities import finite


@dataclass(frozen=True)
class Reliability:
    """One cell of the table: comparisons of one light with ω_g/p in [frequency_ratio_from, frequency_ratio_to).

    records: independent records behind the cell. comparisons: record × structure × scale. within_factor_2: share of
    the comparisons whose predicted rotation lies within a factor 2 of that under the record. median_ratio: predicted
    over that under the record. overturnings_found, overturnings_missed: of those under the record, by the pulse.
    """

    light: Light
    frequency_ratio_from: float
    frequency_ratio_to: float
    records: int
    comparisons: int
    within_factor_2: float
    median_ratio: float
    overturnings_found: int
    overturnings_missed: int


COLUMNS = tuple(field.name for field in fields(Reliability))


def read_reliability(lines: Iterable[str]) -> tuple[Reliability, ...]:
    """Return the rows of a CSV text with the columns of Reliability. Raises PulseError for any defect."""
    rows = csv.DictReader(lines)
    if tuple(rows.fieldnames or ()) != COLUMNS:
        raise PulseError(
            f"The reliability table has columns {rows.fieldnames}, but must have {', '.join(COLUMNS)}."
        )
    return tuple(_row(number, row) for number, row in enumerate(rows, start=2))


@lru_cache(maxsize=1)
def shipped_reliability() -> tuple[Reliability, ...]:
    """Return the table that the package ships, made by `snakemake calibrate` from real records."""
    return read_reliability(
        Path(__file__).with_name("reliability.csv").read_text(encoding="utf-8").splitlines()
    )


def reliability_of(table: Iterable[Reliability], light: Light, frequency_ratio: float) -> Reliability | None:
    """Return the row that applies to a light and ω_g/p; None where the table holds no comparison like it."""
    return next(
        (
            row
            for row in table
            if row.light is light and row.frequency_ratio_from <= frequency_ratio < row.frequency_ratio_to
        ),
        None,
    )


def _row(number: int, row: dict[str, str]) -> Reliability:
    try:
        light = Light(row["light"])
        counts = {name: int(row[name]) for name in COLUMNS if Reliability.__annotations__[name] is int}
        ends = float(row["frequency_ratio_from"]), float(row["frequency_ratio_to"])
        shares = [float(row[name]) for name in ("within_factor_2", "median_ratio")]
    except (TypeError, ValueError) as error:
        raise PulseError(
            f"The reliability table, line {number}: {error}; give a number or a light."
        ) from None
    if not ends[0] < ends[1] or math.isnan(ends[0]) or min(counts.values()) < 0:
        raise PulseError(
            f"The reliability table, line {number}: the range is {ends[0]:g}–{ends[1]:g} and the counts are "
            f"{sorted(counts.values())}, but the range must ascend and counts be 0 or more."
        )
    within, median = (finite(PulseError, f"The reliability table, line {number}", share) for share in shares)
    return Reliability(light, *ends, within_factor_2=within, median_ratio=median, **counts)
