"""The reliability table: how often prediction by the pulse agreed with the whole record, by light and by ω_g/p."""

from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from rocking.errors import PulseError
from rocking.pulses.evidence import Light
from rocking.quantities import finite
from rocking.tables import Row, column, read_rows, row


@row(
    "reliability",
    "One row per light and class of frequency ratio: how often the prediction agreed with the whole record",
)
class Reliability(Row):
    """One cell of the table. Raises PulseError where the class does not ascend or a share is not finite."""

    light: Light = column("green, amber or red")
    frequency_ratio_from: float = column("Lower edge of the class, included")
    frequency_ratio_to: float = column("Upper edge of the class, left out")
    records: int = column("Independent records (sites) behind the row")
    comparisons: int = column("Records x structures x scales in which the structure rocked or overturned")
    within_factor_2: float = column("Share within a factor 2, where both rock")
    median_ratio: float = column("Median of predicted over integrated rotation, where both rock")
    overturnings_found: int = column("Overturnings under the record that the pulse finds")
    overturnings_missed: int = column("Overturnings under the record that the pulse misses")


def read_reliability(path: Path) -> tuple[Reliability, ...]:
    """Return the rows of a reliability table. Raises RockingError where it is another one, PulseError where it errs."""
    found = tuple(read_rows(Reliability, path))
    for each in found:
        low, high = each.frequency_ratio_from, each.frequency_ratio_to
        counts = (each.records, each.comparisons, each.overturnings_found, each.overturnings_missed)
        if not low < high or min(counts) < 0:
            raise PulseError(
                f"{path}: the range is {low:g}–{high:g} and the counts are {sorted(counts)}, but the range must ascend "
                "and counts be 0 or more."
            )
        for share in (each.within_factor_2, each.median_ratio):
            finite(PulseError, str(path), share)
    return found


@lru_cache(maxsize=1)
def shipped_reliability() -> tuple[Reliability, ...]:
    """Return the table that the package ships, made by `snakemake calibrate` from real records."""
    return read_reliability(Path(__file__).with_name("reliability.csv"))


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
