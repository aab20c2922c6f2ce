"""The rows of the trade of error for time: what each method costs and errs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from statistics import median

import numpy as np

from rocking.assessment.methods import Agreement, agreement, ratio, rests
from rocking.earthquakes.sample import Sample
from rocking.tables import Row, column, row


class TradeMethod(StrEnum):
    """The methods of the trade, the cheapest response first."""

    PRINTED = "Eq. 15 as printed"
    """The source paper's equation with its block, under the dominant sine."""
    ONE_SINE = "one sine"
    """The closed form under the dominant sine."""
    DOMINANT_SINE = "one sine, half the energy"
    """The same, under the records of whose energy that sine explains at least half."""
    SINES = "five sines"
    """The closed form under the one of the five best-ranked sines that turns the structure farthest."""
    BLOCK = "block on record"
    MECHANISM = "mechanism on record"
    COARSE = "mechanism, 1e-3"
    """The same at a tolerance a thousand times coarser."""
    ENSEMBLE = "ensemble"
    """The mechanism with its uncertain inputs; its rotation is the median of the members."""


@dataclass(frozen=True, kw_only=True)
class TimedAnswer:
    """The answer of one method to one record and the reference: largest rotations over the critical one, and times.

    cpu: of the response, s. preparation: of the search for the record's sines, s. record: its place among the records.
    """

    rotation_ratio: float
    reference: float
    cpu: float
    preparation: float
    record: int = 0


@row("trade")
class TradeRow(Row):
    """One row per method and structure, and one of all structures: error and time of one response.

    The reference is the mechanism at a tolerance of 1e-12.
    """

    method: TradeMethod = column("Method")
    structure: str = column("Name of the structure; empty: all structures together")
    cases: int = column("Records in which the method has a result, and it or the reference does not rest")
    error: float = column("Median relative error of the largest rotation where method and reference rock")
    error_high: float = column("95 % quantile of that error")
    falls: int = column("Cases that the reference overturns")
    falls_found: int = column("Those that the method overturns too")
    false_alarms: int = column("Cases that the method alone overturns")
    wrong_verdicts: int = column("Cases that do not rest, rock or overturn as the reference does")
    wrong_share_low: float = column(
        "Lower end of the 90 % interval of the share of these, by earthquakes; 0 to 1 of one earthquake"
    )
    wrong_share_high: float = column("Its upper end")
    stations: int = column("Number of stations of the cases")
    earthquakes: int = column("Number of earthquakes of these; what names none counts as of one")
    unsafe_verdicts: int = column("Those in which the method predicts less than the reference")
    cpu_s: float = column("Processor time of one response, median, with all preparations at hand")
    preparation_record_s: float = column("Processor time once for each record, median: search for its sines")
    machine: str = column("Processor that was timed")


def trade_row(
    method: TradeMethod, structure: str, answers: Sequence[TimedAnswer], machine: str, sample: Sample
) -> TradeRow:
    """Return the row about one method by its answers for one structure ("": for all).

    machine: the processor that was timed. sample: of the records.
    """
    moving = [answer for answer in answers if not (rests(answer.rotation_ratio) and rests(answer.reference))]
    pairs = [(answer.rotation_ratio, answer.reference) for answer in moving]
    agreements = [agreement(predicted=answer, integrated=reference) for answer, reference in pairs]
    ratios = [ratio(predicted=answer, integrated=reference) for answer, reference in pairs]
    errors = [abs(ratio - 1) for ratio in ratios if not math.isnan(ratio)]
    of_moving = sample.of_records(np.array([answer.record for answer in moving], dtype=int))
    wrong = np.array([float(agreement is not Agreement.SAME) for agreement in agreements])
    low, high = of_moving.share_bounds(of_moving.by_station(wrong)) if moving else (math.nan, math.nan)
    return TradeRow(
        method=method,
        structure=structure,
        cases=len(moving),
        error=median(errors) if errors else math.nan,
        error_high=float(np.quantile(errors, 0.95)) if errors else math.nan,
        falls=sum(reference == math.inf for _, reference in pairs),
        falls_found=sum(answer == reference == math.inf for answer, reference in pairs),
        false_alarms=sum(answer == math.inf > reference for answer, reference in pairs),
        wrong_verdicts=sum(agreement is not Agreement.SAME for agreement in agreements),
        wrong_share_low=float(low),
        wrong_share_high=float(high),
        stations=of_moving.count,
        earthquakes=of_moving.earthquakes,
        unsafe_verdicts=agreements.count(Agreement.TOO_LOW),
        cpu_s=median(answer.cpu for answer in answers),
        preparation_record_s=median(answer.preparation for answer in answers),
        machine=machine,
    )
