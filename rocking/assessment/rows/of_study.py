"""Rows about a whole study: its structures, their blocks, its counts, its spectrum and what accuracy costs."""

import math
from collections import Counter
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from itertools import product
from statistics import median
from typing import TYPE_CHECKING, TypeVar

import numpy as np

from rocking.assessment.methods import Agreement, agreement, ratio, rests
from rocking.assessment.rows import of_motion as motion_rows
from rocking.assessment.rows import of_record as rows
from rocking.records import Accelerogram
from rocking.structures import Side, Structure
from rocking.structures.capacity import StaticCurve
from rocking.structures.equivalent_block import EquivalentBlock, Scale
from rocking.structures.structure import WEAK_MASONRY
from rocking.tables import Columns, Row, RowOf, row

if TYPE_CHECKING:
    pass

_P = "p of the equivalent block linearised about the critical rotation"
_ETA = "Ratio of angular velocities after and before an impact"
CAPACITY_POINTS = 21
"""Rotations of a capacity curve, from rest to the critical one."""


@dataclass(frozen=True)
class Named:
    """Anything about one structure of the list, whatever the records. structure: its name."""

    structure: str


N = TypeVar("N", bound=Named)
of_named = Columns(Named)


@row()
class StructureNameRow(RowOf[N]):
    """A row about one structure of the list."""

    structure: str = of_named(rows.STRUCTURE, lambda named: named.structure)


@dataclass(frozen=True)
class Placed(Named):
    """Anything about one structure where it stands.

    support_period: of the support, s; 0 on the ground below one, None where it has none.
    """

    support_period: float | None = field(default=None, kw_only=True)


L = TypeVar("L", bound=Placed)
of_placed = Columns(Placed)


@row()
class PlacedRow(StructureNameRow[L]):
    """A row about one structure of the list where it stands."""

    support_period_s: float | None = of_placed(rows.SUPPORT_PERIOD, lambda placed: placed.support_period)


@dataclass(frozen=True)
class ListedStructure(Named):
    """One structure of the list."""

    body: Structure

    @property
    def geometry(self) -> str:
        """Its sizes with their units."""
        return self.body.description

    @property
    def side(self) -> Side | None:
        """The positive side; None where it cannot overturn to it."""
        positive = self.body.mechanism().positive
        return positive if positive.can_overturn else None


of_listed = Columns(ListedStructure)
of_side = of_listed.optional(lambda of: of.side)
of_block_defects = of_listed.optional(lambda of: of.body.mechanism().block_defects if of.side else None)
of_crushing = of_listed.optional(lambda of: of.body.crushing(WEAK_MASONRY))


def of_block(scale: Scale) -> Columns[EquivalentBlock]:
    """Return the declaration of columns about an equivalent block, which what cannot overturn has not."""
    return of_listed.optional(lambda of: of.body.mechanism().equivalent_block(scale) if of.side else None)


@row("structures")
class StructureRow(StructureNameRow[ListedStructure]):
    """One row per structure: its mechanism and its equivalent block."""

    type: str = of_listed(
        "Type of the structure, as in the structure list", lambda of: of.body.described.type_name
    )
    geometry: str = of_listed("Sizes of the structure with their units", lambda of: of.geometry)
    crack: str = of_listed(
        "Hinge or crack, whose place is open; empty where none is", lambda of: of.body.crack_name
    )
    frequency_parameter_rad_s: float = of_side(_P, lambda side: side.frequency_parameter, equation="Eq. 11")
    frequency_parameter_at_rest_rad_s: float = of_block("rest")(
        "p of the block exact at rest, which predicts unless the settings name another one",
        lambda block: block.frequency_parameter,
    )
    critical_rotation_rad: float = of_side(
        "Critical rotation; empty to a side it cannot overturn to", lambda side: side.critical_rotation
    )
    uplift_multiplier: float = of_listed(
        "Uplift acceleration in g", lambda of: of.body.mechanism().uplift_multiplier, equation="Eq. 7"
    )
    static_multiplier: float = of_listed(
        "Least uplift acceleration in g over all cracks", lambda of: of.body.static_multiplier
    )
    static_multiplier_crushing: float = of_crushing(
        "The same if the edges of its joints crush at 2 MPa; empty where it states a strength or would not stand",
        lambda crushed: crushed.static_multiplier,
    )
    acceleration_scale_linearised: float = of_block("linearised")(
        "Scale a_sc of the linearised block",
        lambda block: block.acceleration_scale,
        equation="Eq. 11",
    )
    acceleration_scale_uplift: float = of_block("uplift")(
        "Scale a_sc,alt of the true uplift",
        lambda block: block.acceleration_scale,
        equation="Eq. 13",
    )
    restitution: float = of_listed(
        _ETA, lambda of: of.body.mechanism().positive.restitution, equation="Eq. 2"
    )
    restoring_defect: float = of_block_defects(
        "Largest error of the block's restoring force, relative", lambda defects: defects.restoring
    )
    forcing_defect: float = of_block_defects(
        "Growth of the forcing up to φ_cr; unsafe where above 0", lambda defects: defects.forcing
    )


def structure_rows(structures: Mapping[str, Structure]) -> Iterator[StructureRow]:
    """Yield the row of each structure."""
    for each in structures.items():
        yield StructureRow.of(ListedStructure(*each))


@dataclass(frozen=True)
class CapacityPoint(Named):
    """One point of the capacity curve of one side. place: its place on the curve."""

    side: str
    curve: StaticCurve
    place: int


of_point = Columns(CapacityPoint)


@row("capacity")
class CapacityRow(StructureNameRow[CapacityPoint]):
    """One row per structure, side and rotation: the static load multiplier against displacement."""

    side: str = of_point("Side of the rotation: positive or negative", lambda at: at.side)
    rotation_rad: float = of_point("Rotation", lambda at: float(at.curve.rotation[at.place]))
    multiplier: float = of_point(
        "Horizontal acceleration in g that holds the balance",
        lambda at: float(at.curve.multiplier[at.place]),
        equation="G/B",
    )
    displacement_m: float = of_point(
        "Displacement of the corner that moves farthest sideways",
        lambda at: float(at.curve.displacement[at.place]),
    )
    effective_displacement_m: float = of_point(
        "Displacement d* = d_k Σ P δ²/(δ_k Σ P δ)",
        lambda at: float(at.curve.effective_displacement[at.place]),
    )
    participating_mass_ratio: float = of_point(
        "Mass ratio e* = (Σ P δ)²/(Σ P · Σ P δ²)", lambda at: at.curve.participating_mass_ratio
    )


def capacity_rows(structures: Mapping[str, Structure]) -> Iterator[CapacityRow]:
    """Yield the capacity curve of each side of each structure, at CAPACITY_POINTS rotations."""
    for name, structure in structures.items():
        both = {"positive": 1, "negative": -1}
        for side, sign in list(both.items())[: len(structure.mechanism().sides)]:
            curve = structure.capacity_curve(sign, CAPACITY_POINTS)
            for place in range(curve.rotation.size):
                yield CapacityRow.of(CapacityPoint(name, side, curve, place))


@dataclass(frozen=True, eq=False)
class CountedCases:
    """The cases of one structure ("": of all) that have both ratios."""

    structure: str
    support_period: float | None
    cases: Sequence[rows.ComparisonRow]

    @property
    def overturning(self) -> int:
        """How many overturn in the integration."""
        return sum(math.isinf(row.integrated_rotation_ratio) for row in self.cases)

    @cached_property
    def told(self) -> Counter[str]:
        """How many fall in both (hits), in the integration alone (misses), in the closed form alone (false_alarms)."""
        names = {(True, True): "hits", (False, True): "misses", (True, False): "false_alarms"}
        falls = (
            (math.isinf(row.predicted_rotation_ratio), math.isinf(row.integrated_rotation_ratio))
            for row in self.cases
        )
        return Counter(names[each] for each in falls if each in names)

    @property
    def rock_ratios(self) -> list[float]:
        """Predicted over integrated rotation of those that rock in both."""
        both_rock = (row for row in self.cases if row.within_factor_two is not None)
        return [row.predicted_rotation_ratio / row.integrated_rotation_ratio for row in both_rock]


of_cases = Columns(CountedCases)


@row("agreement")
class AgreementRow(RowOf[CountedCases]):
    """One row per structure and one for all: the closed form under the dominant pulse against the full integration."""

    structure: str = of_cases(
        "Name of the structure in the structure list; empty for all together", lambda of: of.structure
    )
    support_period_s: float | None = of_cases(rows.SUPPORT_PERIOD, lambda of: of.support_period)
    records: int = of_cases("Number of records", lambda of: len({row.record for row in of.cases}))
    cases: int = of_cases("Number of cases with a prediction and an integration", lambda of: len(of.cases))
    both_rock: int = of_cases("Number of cases in which both rock", lambda of: len(of.rock_ratios))
    within_factor_two: int = of_cases(
        "Number of these with a ratio between 1/2 and 2",
        lambda of: sum(bool(row.within_factor_two) for row in of.cases),
    )
    median_ratio: float = of_cases(
        "Median of predicted over integrated rotation where both rock",
        lambda of: median(of.rock_ratios) if of.rock_ratios else math.nan,
    )
    overturning: int = of_cases(
        "Number of cases that overturn in the integration",
        lambda of: of.overturning,
    )
    overturning_hits: int = of_cases(
        "Number of these that overturn in the closed form", lambda of: of.told["hits"]
    )
    overturning_misses: int = of_cases(
        "Number of these that stand in the closed form", lambda of: of.told["misses"]
    )
    overturning_false_alarms: int = of_cases(
        "Number of cases that overturn in the closed form alone", lambda of: of.told["false_alarms"]
    )


def agreement_rows(comparison: Iterable[rows.ComparisonRow]) -> Iterator[AgreementRow]:
    """Yield the counts of all and of each structure."""
    compared = [
        row
        for row in comparison
        if not (math.isnan(row.predicted_rotation_ratio) or math.isnan(row.integrated_rotation_ratio))
    ]
    yield AgreementRow.of(CountedCases("", None, compared))
    by_scene: dict[tuple[str, float | None], list[rows.ComparisonRow]] = {}
    for each in compared:
        by_scene.setdefault((each.structure, each.support_period_s), []).append(each)
    for (structure, period), cases in by_scene.items():
        yield AgreementRow.of(CountedCases(structure, period, cases))


@dataclass(frozen=True)
class BlockUnderRecord:
    """One equivalent block under one component of a whole record."""

    accelerogram: Accelerogram
    frequency_parameter: float
    uplift_multiplier: float
    restitution: float
    rotation_ratio: float


of_spectrum = Columns(BlockUnderRecord)


@row("spectrum")
class SpectrumRow(RowOf[BlockUnderRecord]):
    """One row per component and equivalent block under the whole record; written by rocking spectrum."""

    component: str = of_spectrum(motion_rows.COMPONENT, lambda of: of.accelerogram.component)
    frequency_parameter_rad_s: float = of_spectrum(_P, lambda of: of.frequency_parameter, equation="Eq. 11")
    uplift_multiplier: float = of_spectrum(
        "Uplift acceleration of the equivalent block in g", lambda of: of.uplift_multiplier, equation="Eq. 12"
    )
    restitution: float = of_spectrum(_ETA, lambda of: of.restitution, equation="Eq. 2")
    rotation_ratio: float = of_spectrum(
        "Largest rotation over critical rotation; INF if it overturns", lambda of: of.rotation_ratio
    )
    scale_factor: float = of_spectrum(motion_rows.SCALE_FACTOR, lambda of: of.accelerogram.scale_factor)
    record_sha256: str = of_spectrum(motion_rows.RECORD_SHA256, lambda of: of.accelerogram.source.sha256)


def spectrum_rows(
    accelerograms: Iterable[Accelerogram],
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    restitution: float,
) -> Iterator[SpectrumRow]:
    """Yield the rocking spectrum of each component over p (m,) [rad/s] and λ (n,)."""
    from rocking.motion.batch import rocking_spectrum  # else who reads a table would load numba

    for accelerogram in accelerograms:
        ratios = rocking_spectrum(accelerogram, frequency_parameters, uplift_multipliers, restitution)
        blocks = product(frequency_parameters.tolist(), uplift_multipliers.tolist())
        for block, rotation_ratio in zip(blocks, np.ravel(ratios).tolist(), strict=True):
            yield SpectrumRow.of(BlockUnderRecord(accelerogram, *block, restitution, rotation_ratio))


@dataclass(frozen=True)
class CountedFalls:
    """How many structures are expected to fall under one record, or on average under several.

    record: its identifier; "" for the mean over all. expected_falls: the sum of the shares of those that have one;
    its low and high ends: of the 90 % interval of the mean. without_share: how many have none.
    """

    record: str
    structures: int
    expected_falls: float
    without_share: float
    expected_falls_low: float = math.nan
    expected_falls_high: float = math.nan


of_falls = Columns(CountedFalls)


@row("expected_falls")
class ExpectedFallsRow(RowOf[CountedFalls]):
    """One row per record and one for all: how many of the structures, variants apart, are expected to fall."""

    record: str = of_falls("Record; empty for the mean over all records", lambda of: of.record)
    structures: int = of_falls("Number of structures", lambda of: of.structures)
    expected_falls: float = of_falls(
        "Sum of the shares that overturn, of the structures that have one", lambda of: of.expected_falls
    )
    expected_falls_low: float = of_falls(
        "Low end of the 90 % interval of the mean, by the spread over the records",
        lambda of: of.expected_falls_low,
    )
    expected_falls_high: float = of_falls("High end of that interval", lambda of: of.expected_falls_high)
    without_share: float = of_falls("Number of structures that have no share", lambda of: of.without_share)


def falls_under(
    verdicts: Iterable["rows.VerdictRow"], variants: Collection[str] = ()
) -> ExpectedFallsRow | None:
    """Return how many structures are expected to fall under one record; None without a verdict.

    Expectations add whatever the structures have in common. variants: names of structures that stand for another one,
    and are not counted.
    """
    worst = [row for row in rows.worst_period_each(verdicts) if row.structure not in variants]
    if not worst:
        return None
    shares = [row.overturning_share for row in worst]
    untold = sum(math.isnan(row.overturning_share) and not row.decision.word.stays_up for row in worst)
    return ExpectedFallsRow.of(CountedFalls(worst[0].record, len(worst), float(np.nansum(shares)), untold))


def falls_over(records: Sequence[ExpectedFallsRow]) -> ExpectedFallsRow | None:
    """Return the mean over the records; None without any.

    What falls under one record falls together or not at all, so that each record is one observation: the interval is
    Student's of their mean, on the log odds of the mean part that falls, for that keeps between none and all. Without
    two records, or where all or none fall, there is none.
    """
    if not records:
        return None
    structures = max(row.structures for row in records)
    falls = np.array([row.expected_falls for row in records])
    mean = float(falls.mean())
    low = high = math.nan
    if len(records) > 1 and 0 < mean < structures:
        from scipy.special import expit, logit, stdtrit  # which who reads a table has no need of

        error = falls.std(ddof=1) / math.sqrt(len(records))
        half = stdtrit(len(records) - 1, 0.95) * error * structures / (mean * (structures - mean))
        low, high = (structures * expit(logit(mean / structures) + half * np.array([-1, 1]))).tolist()
    untold = float(np.mean([row.without_share for row in records]))
    return ExpectedFallsRow.of(CountedFalls("", structures, mean, untold, low, high))


SUMMARY_TABLES: tuple[type[Row], ...] = (
    motion_rows.RecordRow,
    motion_rows.PulseRow,
    rows.ComparisonRow,
    rows.VerdictRow,
    rows.SupportRow,
    rows.MechanismRow,
    rows.VariationRow,
    ExpectedFallsRow,
    AgreementRow,
    StructureRow,
    CapacityRow,
    rows.FailureRow,
    rows.TimingRow,
)
"""The rows of the tables of the summary folder."""


class TradeMethod(StrEnum):
    """The methods of the trade, the cheapest response first."""

    ONE_SINE = "one sine"
    """The closed form under the dominant sine."""
    RULING_SINE = "one sine, half the energy"
    """The same, under the records of whose energy that sine explains at least half."""
    SINES = "five sines"
    """The closed form under the one of the five best-ranked sines that turns the structure farthest."""
    BLOCK = "block on record"
    MECHANISM = "mechanism on record"
    COARSE = "mechanism, 1e-3"
    """The same at a tolerance a thousand times coarser."""
    ENSEMBLE = "ensemble"
    """The mechanism with its uncertain inputs; its rotation is the median of the members."""


@dataclass(frozen=True)
class TimedAnswer:
    """The answer of one method to one record beside the reference: largest rotations over the critical one, and times.

    cpu: of the response, s. preparation: of the search for the record's sines, s.
    """

    rotation_ratio: float
    reference: float
    cpu: float
    preparation: float


@dataclass(frozen=True)
class TriedMethod:
    """One method with its answers for one structure ("": for all). machine: the processor that was timed."""

    method: TradeMethod
    structure: str
    answers: Sequence[TimedAnswer]
    machine: str

    @cached_property
    def moving(self) -> list[tuple[float, float]]:
        """Answer and reference of the cases in which one of the two does not rest."""
        pairs = [(each.rotation_ratio, each.reference) for each in self.answers]
        return [pair for pair in pairs if not all(map(rests, pair))]

    @property
    def cases(self) -> int:
        """Their number."""
        return len(self.moving)

    @cached_property
    def errors(self) -> list[float]:
        """Relative errors of the rotation where both rock."""
        ratios = [ratio(*pair) for pair in self.moving]
        return [abs(each - 1) for each in ratios if not math.isnan(each)]

    @cached_property
    def agreements(self) -> list[Agreement]:
        """The outcome of each of these cases against that of the reference."""
        return [agreement(*pair) for pair in self.moving]

    @property
    def error(self) -> float:
        """The median error; nan without any."""
        return median(self.errors) if self.errors else math.nan

    @property
    def error_high(self) -> float:
        """The 95 % quantile of the errors; nan without any."""
        return float(np.quantile(self.errors, 0.95)) if self.errors else math.nan

    @property
    def wrong_verdicts(self) -> int:
        """The number of cases with another outcome than the reference."""
        return sum(each is not Agreement.SAME for each in self.agreements)

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
        "Records in which the method has an answer, and it or the reference does not rest",
        lambda of: of.cases,
    )
    error: float = of_tried(
        "Median relative error of the largest rotation where method and reference rock", lambda of: of.error
    )
    error_high: float = of_tried("95 % quantile of that error", lambda of: of.error_high)
    wrong_verdicts: int = of_tried(
        "Cases that rest, rock or overturn otherwise than the reference", lambda of: of.wrong_verdicts
    )
    unsafe_verdicts: int = of_tried(
        "Those in which the method says less than the reference", lambda of: of.unsafe_verdicts
    )
    cpu_s: float = of_tried(
        "Processor time of one response, median, with all preparations at hand",
        lambda of: median(each.cpu for each in of.answers),
    )
    preparation_record_s: float = of_tried(
        "Processor time once for each record, median: search for its sines",
        lambda of: median(each.preparation for each in of.answers),
    )
    machine: str = of_tried("Processor that was timed", lambda of: of.machine)
