"""Rows about the trade of error for time."""

from enum import StrEnum

from rocking.tables import Row, column, row


class TradeMethod(StrEnum):
    """The methods of the trade, the cheapest response first."""

    ONE_SINE = "one sine"
    """The closed form under the dominant sine."""
    SINES = "five sines"
    """The closed form under the one of the five best-ranked sines that turns the structure farthest."""
    BLOCK = "block on record"
    COARSE = "mechanism, 1e-3"
    MECHANISM = "mechanism, 1e-6"
    FINE = "mechanism, 1e-9"
    ENSEMBLE = "ensemble"
    """The mechanism with all that is not known of a case; its rotation is the median."""


@row("trade", "One row per method and structure, and one of all structures: error and time of one response")
class TradeRow(Row):
    """The trade of one method. The reference is the mechanism at a tolerance of 1e-12."""

    method: TradeMethod = column("Method")
    structure: str = column("Name of the structure; empty: all structures together")
    cases: int = column("Records in which the method has an answer, and it or the reference does not rest")
    error: float = column("Median relative error of the largest rotation where method and reference rock")
    error_high: float = column("95 % quantile of that error")
    wrong_verdicts: int = column("Cases that rest, rock or overturn otherwise than the reference")
    unsafe_verdicts: int = column("Those in which the method says less than the reference")
    cpu_s: float = column("Processor time of one response, median, with all preparations at hand")
    preparation_record_s: float = column("Processor time once for each record, median: search for its pulses")
