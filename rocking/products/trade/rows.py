"""The rows of the trade of error for time: what each method costs and errs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from statistics import mean, median

import numpy as np

from rocking.assessment.methods import Agreement, agreement, ratio, rests
from rocking.earthquakes.sample import INTERVAL, ClusterSample
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

    cpu: of the response, s. preparation: of the search for the record's sines, s. record: its place among the motions.
    is_late: whether it rests on a pulse that begins after the fall of the reference, which it then has not found.
    """

    rotation_ratio: float
    reference: float
    cpu: float
    preparation: float
    record: int = 0
    is_late: bool = False

    @property
    def moves(self) -> bool:
        """Whether one of the two does not rest."""
        return not (rests(self.rotation_ratio) and rests(self.reference))

    @property
    def finds_fall(self) -> bool:
        """Whether the method finds the fall of the reference."""
        return self.rotation_ratio == self.reference == math.inf and not self.is_late

    @property
    def agreement(self) -> Agreement:
        """The outcome compared with that of the reference."""
        of_both = agreement(predicted=self.rotation_ratio, integrated=self.reference)
        return Agreement.TOO_LOW if of_both is Agreement.SAME and self.is_late else of_both


@row("trade")
class TradeRow(Row):
    """One row per method and structure, and one of all structures: error and time of one response.

    Of a study the cases are those of agreement.csv under recorded motions, and the reference is their integration; from
    Python it is the mechanism at a tolerance of 1e-12.
    """

    method: TradeMethod = column("Method")
    structure: str = column("Name of the structure; empty: all structures together")
    cases: int = column("Records in which the method has a result, and it or the reference does not rest")
    error: float = column("Median relative error of the largest rotation where method and reference rock")
    error_high: float = column("95 % quantile of that error")
    falls: int = column("Cases that the reference overturns")
    falls_found: int = column("Those that the method overturns too, by a pulse that begins before the fall")
    false_alarms: int = column("Cases that the method alone overturns")
    wrong_verdicts: int = column(
        "Cases that do not rest, rock or overturn as the reference does, with falls that are not found"
    )
    wrong_share_low: float = column(
        f"Lower end of the {INTERVAL} of the share of these, by earthquakes; 0 to 1 of one earthquake"
    )
    wrong_share_high: float = column("Its upper end")
    stations: int = column("Number of stations of the cases")
    earthquakes: int = column("Number of earthquakes of these; what names none counts as of one")
    unsafe_verdicts: int = column("Those in which the method predicts less than the reference")
    cpu_s: float = column("Processor time of one response, median, with all preparations at hand")
    preparation_record_s: float = column("Processor time once for each record, median: search for its sines")
    break_even: float = column(
        "Structures under one motion from which on it costs no more than the mechanism on the record, median over the "
        "motions; INF: never; empty of a method without a search"
    )
    break_even_low: float = column("5 % quantile of that number over the motions")
    break_even_high: float = column("95 % quantile of that number over the motions")
    machine: str = column("Processor that was timed")

    @property
    def break_even_in_words(self) -> str:
        """That number: "17 structures per record (7 to 53, by the record)"."""
        middle, low, high = (
            "\N{INFINITY}" if number == math.inf else f"{number:.0f}"
            for number in (self.break_even, self.break_even_low, self.break_even_high)
        )
        return f"{middle} structures per record ({low} to {high}, by the record)"


def trade_row(
    method: TradeMethod,
    structure: str,
    answers: Sequence[TimedAnswer],
    by_mechanism: Sequence[TimedAnswer],
    machine: str,
    sample: ClusterSample,
) -> TradeRow:
    """Return the row about one method by its answers for one structure ("": for all).

    by_mechanism: the answers of the mechanism on the record. machine: the processor that was timed. sample: of the
    motions.
    """
    moving = [answer for answer in answers if answer.moves]
    pairs = [(answer.rotation_ratio, answer.reference) for answer in moving]
    agreements = [answer.agreement for answer in moving]
    ratios = [ratio(predicted=answer, integrated=reference) for answer, reference in pairs]
    errors = [abs(ratio - 1) for ratio in ratios if not math.isnan(ratio)]
    of_moving = sample.of_records(np.array([answer.record for answer in moving], dtype=int))
    wrong = np.array([float(agreement is not Agreement.SAME) for agreement in agreements])
    low, high = of_moving.share_bounds(of_moving.by_station(wrong)) if moving else (math.nan, math.nan)
    even_low, even, even_high = _break_even(moving, by_mechanism)
    return TradeRow(
        method=method,
        structure=structure,
        cases=len(moving),
        error=median(errors) if errors else math.nan,
        error_high=float(np.quantile(errors, 0.95)) if errors else math.nan,
        falls=sum(reference == math.inf for _, reference in pairs),
        falls_found=sum(answer.finds_fall for answer in moving),
        false_alarms=sum(answer == math.inf > reference for answer, reference in pairs),
        wrong_verdicts=sum(agreement is not Agreement.SAME for agreement in agreements),
        wrong_share_low=float(low),
        wrong_share_high=float(high),
        stations=of_moving.count,
        earthquakes=of_moving.earthquakes,
        unsafe_verdicts=agreements.count(Agreement.TOO_LOW),
        cpu_s=median(answer.cpu for answer in answers),
        preparation_record_s=median(answer.preparation for answer in answers),
        break_even=even,
        break_even_low=even_low,
        break_even_high=even_high,
        machine=machine,
    )


def _break_even(
    answers: Sequence[TimedAnswer], by_mechanism: Sequence[TimedAnswer]
) -> tuple[float, float, float]:
    """The 5, 50 and 95 % quantiles over the motions of the number of structures under one, from which on the answers
    cost no more than those of the mechanism: inf where they always do, nan of a method without a search.
    """
    numbers = []
    for motion in dict.fromkeys(answer.record for answer in answers if answer.preparation):
        own, usual = (
            [answer for answer in some if answer.record == motion] for some in (answers, by_mechanism)
        )
        saved = sum(answer.cpu for answer in usual) / max(len(usual), 1) - mean(answer.cpu for answer in own)
        numbers.append(math.ceil(own[0].preparation / saved) if saved > 0 else math.inf)
    low, middle, high = np.quantile(numbers or [math.nan], (0.05, 0.5, 0.95), method="nearest").tolist()
    return low, middle, high
