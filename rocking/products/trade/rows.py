"""The rows of the trade of error for time: what each method costs and errs."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from statistics import median

import numpy as np

from rocking.assessment.methods import Agreement, agreement, ratio, rests
from rocking.earthquakes.sample import Sample
from rocking.tables import Columns, RowOf, row


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


@dataclass(frozen=True)
class TriedMethod:
    """One method with its answers for one structure ("": for all).

    machine: the processor that was timed. sample: of the records.
    """

    method: TradeMethod
    structure: str
    answers: Sequence[TimedAnswer]
    machine: str
    sample: Sample

    @cached_property
    def of_moving(self) -> Sample:
        """The sample of the cases in which one of the two does not rest."""
        places = [
            answer.record
            for answer in self.answers
            if not rests(answer.rotation_ratio) or not rests(answer.reference)
        ]
        return self.sample.of_records(np.array(places, dtype=int))

    @cached_property
    def wrong_bounds(self) -> tuple[float, float]:
        """The 90 % interval, by earthquakes, of the share of those cases with another outcome than the reference."""
        if not self.agreements:
            return math.nan, math.nan
        wrong = self.of_moving.by_station(
            np.array([float(agreement is not Agreement.SAME) for agreement in self.agreements])
        )
        low, high = self.of_moving.share_bounds(wrong)
        return float(low), float(high)

    @property
    def wrong_share_low(self) -> float:
        """The lower end."""
        return self.wrong_bounds[0]

    @property
    def wrong_share_high(self) -> float:
        """The upper end."""
        return self.wrong_bounds[1]

    @property
    def stations(self) -> int:
        """The number of stations of these cases."""
        return self.of_moving.count

    @property
    def earthquakes(self) -> int:
        """The number of their earthquakes."""
        return self.of_moving.earthquakes

    @cached_property
    def moving(self) -> list[tuple[float, float]]:
        """Answer and reference of the cases in which one of the two does not rest."""
        pairs = [(answer.rotation_ratio, answer.reference) for answer in self.answers]
        return [pair for pair in pairs if not all(map(rests, pair))]

    @property
    def cases(self) -> int:
        """Their number."""
        return len(self.moving)

    @cached_property
    def errors(self) -> list[float]:
        """Relative errors of the rotation where both rock."""
        ratios = [ratio(predicted=answer, integrated=reference) for answer, reference in self.moving]
        return [abs(ratio - 1) for ratio in ratios if not math.isnan(ratio)]

    @cached_property
    def agreements(self) -> list[Agreement]:
        """The outcome of each of these cases against that of the reference."""
        return [agreement(predicted=answer, integrated=reference) for answer, reference in self.moving]

    @property
    def error(self) -> float:
        """The median error; nan without any."""
        return median(self.errors) if self.errors else math.nan

    @property
    def error_high(self) -> float:
        """The 95 % quantile of the errors; nan without any."""
        return float(np.quantile(self.errors, 0.95)) if self.errors else math.nan

    @property
    def falls(self) -> int:
        """The number of cases that the reference overturns."""
        return sum(reference == math.inf for _, reference in self.moving)

    @property
    def falls_found(self) -> int:
        """The number of those that the method overturns too."""
        return sum(answer == reference == math.inf for answer, reference in self.moving)

    @property
    def false_alarms(self) -> int:
        """The number of cases that the method alone overturns."""
        return sum(answer == math.inf > reference for answer, reference in self.moving)

    @property
    def wrong_verdicts(self) -> int:
        """The number of cases with another outcome than the reference."""
        return sum(agreement is not Agreement.SAME for agreement in self.agreements)

    @property
    def unsafe_verdicts(self) -> int:
        """The number of those in which the method says less."""
        return self.agreements.count(Agreement.TOO_LOW)


of_tried = Columns(TriedMethod)


@row("trade")
class TradeRow(RowOf[TriedMethod]):
    """One row per method and structure, and one of all structures: error and time of one response.

    The reference is the mechanism at a tolerance of 1e-12.
    """

    method: TradeMethod = of_tried("Method", lambda of: of.method)
    structure: str = of_tried(
        "Name of the structure; empty: all structures together", lambda of: of.structure
    )
    cases: int = of_tried(
        "Records in which the method has a result, and it or the reference does not rest",
        lambda of: of.cases,
    )
    error: float = of_tried(
        "Median relative error of the largest rotation where method and reference rock", lambda of: of.error
    )
    error_high: float = of_tried("95 % quantile of that error", lambda of: of.error_high)
    falls: int = of_tried("Cases that the reference overturns", lambda of: of.falls)
    falls_found: int = of_tried("Those that the method overturns too", lambda of: of.falls_found)
    false_alarms: int = of_tried("Cases that the method alone overturns", lambda of: of.false_alarms)
    wrong_verdicts: int = of_tried(
        "Cases that do not rest, rock or overturn as the reference does", lambda of: of.wrong_verdicts
    )
    wrong_share_low: float = of_tried(
        "Lower end of the 90 % interval of the share of these, by earthquakes; 0 to 1 of one earthquake",
        lambda of: of.wrong_share_low,
    )
    wrong_share_high: float = of_tried("Its upper end", lambda of: of.wrong_share_high)
    stations: int = of_tried("Number of stations of the cases", lambda of: of.stations)
    earthquakes: int = of_tried(
        "Number of earthquakes of these; what names none counts as of one",
        lambda of: of.earthquakes,
    )
    unsafe_verdicts: int = of_tried(
        "Those in which the method predicts less than the reference", lambda of: of.unsafe_verdicts
    )
    cpu_s: float = of_tried(
        "Processor time of one response, median, with all preparations at hand",
        lambda of: median(answer.cpu for answer in of.answers),
    )
    preparation_record_s: float = of_tried(
        "Processor time once for each record, median: search for its sines",
        lambda of: median(answer.preparation for answer in of.answers),
    )
    machine: str = of_tried("Processor that was timed", lambda of: of.machine)
