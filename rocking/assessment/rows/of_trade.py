"""Rows about the trade of error for time: case by case, for a fragility, and what it comes down to."""

from collections.abc import Mapping
from enum import StrEnum

from rocking.assessment.rows import meanings
from rocking.tables import Row, column, row


class TradeMethod(StrEnum):
    """What is compared, the cheapest response first."""

    ONE_SINE = "one sine"
    """The closed form under the dominant sine."""
    SINES = "five sines"
    """The closed form under the one of the five best-ranked sines that turns the structure farthest."""
    BLOCK = "block on record"
    MULTI_FIDELITY = "multi-fidelity"
    """The block in every case of a fragility, the mechanism in one of ten."""
    MECHANISM = "mechanism on record"
    ENSEMBLE = "ensemble"
    """The mechanism with all that is not known of a case."""
    RK45 = "scipy RK45"
    DOP853 = "scipy DOP853"


METHOD = "What was computed with"
_CPU = "Processor time"


@row("trade", "One row per case, method and tolerance: error and time of one response; differs between runs")
class TradeRow(Row):
    """One method at one tolerance on one case."""

    record: str = column(meanings.RECORD)
    component: str = column(meanings.COMPONENT)
    structure: str = column(meanings.STRUCTURE)
    samples: int = column("Samples that the method was given: all, or the strongest stretch beside scipy")
    method: str = column(METHOD)
    tolerance: float = column("Relative tolerance of the method; empty where it has none")
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    beside_scipy: bool = column(
        "Whether the reference is scipy, on a stretch, and not the mechanism at 1e-12"
    )
    reference_rotation_ratio: float = column(
        "The same of the mechanism at 1e-12; of scipy: by DOP853 at 1e-12, restarted at each sample"
    )
    error: float = column("Magnitude of the relative error where both rock; 0 where neither does")
    verdict_agrees: bool | None = column("Whether it rocks, overturns or stays as the reference says")
    cpu_s: float = column(f"{_CPU} of one response, median of the repeats, with all preparations at hand")
    preparation_record_s: float = column(f"{_CPU} spent once on the record: on its pulses")
    preparation_structure_s: float = column(f"{_CPU} spent once on the structure: on its block or table")
    reason: str = column("Why there is no number")


@row(
    "trade_fragility",
    "One row per structure and method: error and time of a whole fragility; differs between runs",
)
class TradeFragilityRow(Row):
    """One method for one structure."""

    structure: str = column(meanings.STRUCTURE)
    method: str = column(METHOD)
    intensity_measure: str = column("Of the levels")
    records: int = column("Components that were scaled")
    stations: int = column("Stations they come from")
    responses: int = column("Responses that were computed of what names the method")
    median: float = column("Level at which half overturn")
    reference_median: float = column("The same of the mechanism at 1e-9")
    error: float = column("Median over that of the reference, less one")
    curve_error: float = column("Mean error of P(overturns) over the levels where it is open")
    interval_ratio: float = column("Upper over lower end of the 90 % interval of the median")
    cpu_s: float = column(f"{_CPU} of all responses")
    preparation_s: float = column(f"{_CPU} spent on the pulses of all records before")


@row(
    "trade_multifidelity",
    "One row per structure and number of runs: 200 samples held against the answer of all runs",
)
class MultiFidelityRow(Row):
    """What few runs of the mechanism buy with its block at hand, and without."""

    structure: str = column(meanings.STRUCTURE)
    cases: int = column("Records times levels: runs of the mechanism for the answer of all")
    runs: int = column("Runs of the mechanism in each sample")
    repeats: int = column("Samples")
    curve_width: float = column(
        "Width of 90 % of the samples of P(overturns), mean of the levels where it is open"
    )
    curve_bias: float = column("Mean of |mean of the samples less the answer| over it, there")
    curve_gain: float = column(
        "Times as many runs as that width takes without the block, in records at all levels"
    )
    median_width: float = column(
        "Width of 90 % of the samples of the logarithm of the median of the lognormal"
    )
    median_bias: float = column("|Mean of the samples less the answer| of it, over that width")
    median_gain: float = column(
        "Times as many runs as that width takes without the block, in records at all levels"
    )
    median_gain_cases: float = column("The same with other records at each level")
    correlation_block: float = column(
        "Correlation of overturning of block and mechanism where the curve is open"
    )
    correlation_sine: float = column("The same of the closed form under the dominant sine")
    cost_ratio: float = column("Processor time of a run of the mechanism over one of the block")
    cpu_gain: float = column("Processor time for the width of the curve without the block over that with it")
    two_level_gain: float = column(
        "The same for plain control variates at the best share of block and mechanism runs; below 1: never use them"
    )


@row("trade_methods", "One row per method: what it errs, what it costs, and when it pays")
class TradeMethodRow(Row):
    """The trade of one method."""

    method: str = column(METHOD)
    cases: int = column("Cases in which it has an answer, and it or the reference lifts")
    error: float = column("Median error of the largest rotation where both rock")
    wrong_verdicts: int = column("Cases that rest, rock or overturn otherwise than the reference")
    fragility_structures: int = column("Structures with a fragility")
    fragility_error: float = column(
        "Median over the structures of the magnitude of the error of the fragility median"
    )
    fragility_error_worst: float = column("The largest of them")
    cpu_s: float = column(f"{_CPU} of one response, median of the cases")
    preparation_record_s: float = column(f"{_CPU} once for a record, median")
    preparation_structure_s: float = column(f"{_CPU} once for a structure, median")
    fragility_cpu_s: float = column(
        f"{_CPU} of the fragility of one structure, preparation of the records left out"
    )
    pays_from: float = column(
        "Structures a record from which it costs less than the mechanism, preparation counted; INF: never"
    )
    pays_from_fragility: float = column(
        "The same where each structure meets each record at all levels of a fragility"
    )


TRADE_TABLES: Mapping[str, type[Row]] = {
    each.table.name: each for each in (TradeRow, TradeFragilityRow, MultiFidelityRow, TradeMethodRow)
}
"""The tables of the trade, by name."""
