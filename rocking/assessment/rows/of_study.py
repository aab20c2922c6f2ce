"""Rows about a whole study: its counts and its spectrum."""

import math
from collections import Counter
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import product
from statistics import median

import numpy as np

from rocking.assessment.rows import of_inputs as inputs
from rocking.assessment.rows import of_record as rows
from rocking.earthquakes.sample import MADE, TAIL, UNNAMED, Sample
from rocking.records import Accelerogram
from rocking.tables import Columns, Row, RowOf, row


def named_records(
    records: Iterable[inputs.RecordRow], each_unnamed: bool = False
) -> dict[str, tuple[str, str]]:
    """Return station and earthquake of each record, by its identifier. each_unnamed: as of `Sample.of`."""
    names, sample = sample_of_records(records, each_unnamed)
    return dict(zip(names, zip(sample.stations, sample.events, strict=True), strict=True))


def sample_of_records(
    records: Iterable[inputs.RecordRow], each_unnamed: bool = False
) -> tuple[list[str], Sample]:
    """Return the identifiers of the records (r,), and their sample with what there is to say of it."""
    firsts: dict[str, inputs.RecordRow] = {}
    for component in records:
        firsts.setdefault(component.record, component)
    return list(firsts), Sample.of(list(firsts.values()), rows=list(firsts), each_unnamed=each_unnamed)


def made_records(records: Iterable[inputs.RecordRow]) -> set[str]:
    """Return the identifiers of the records that nobody recorded."""
    return {component.record for component in records if component.event == MADE}


def counted_apart(
    comparison: Iterable[rows.ComparisonRow], made: Container[str]
) -> tuple[list[rows.ComparisonRow], list[rows.ComparisonRow]]:
    """Return the cases under what was recorded, and those under made records; where all were made, they come first."""
    recorded: list[rows.ComparisonRow] = []
    beside: list[rows.ComparisonRow] = []
    for case in comparison:
        (beside if case.record in made else recorded).append(case)
    return (recorded, beside) if recorded else (beside, [])


@dataclass(frozen=True, eq=False)
class CountedCases:
    """The cases of one structure ("": of all) that have both ratios.

    names: station and earthquake of each record. made: whether they are those under made records.
    """

    structure: str
    cases: Sequence[rows.ComparisonRow]
    names: Mapping[str, tuple[str, str]]
    made: bool = False

    @cached_property
    def sample(self) -> Sample:
        """Of the cases."""
        return Sample.named(self.names.get(row.record, (row.record, UNNAMED)) for row in self.cases)

    @cached_property
    def within_bounds(self) -> tuple[float, float]:
        """The 90 % interval, by earthquakes, of the share of those that rock in both with a ratio from 1/2 to 2."""
        both_rock = [place for place, row in enumerate(self.cases) if row.within_factor_two is not None]
        if not both_rock:
            return math.nan, math.nan
        sample = self.sample.of_records(np.array(both_rock))
        within = sample.by_station(
            np.array([float(bool(self.cases[place].within_factor_two)) for place in both_rock])
        )
        low, high = sample.share_bounds(within)
        return float(low), float(high)

    @property
    def within_factor_two_low(self) -> float:
        """The lower end."""
        return self.within_bounds[0]

    @property
    def within_factor_two_high(self) -> float:
        """The upper end."""
        return self.within_bounds[1]

    @property
    def stations(self) -> int:
        """The number of stations of these cases."""
        return self.sample.count

    @property
    def earthquakes(self) -> int:
        """The number of their earthquakes."""
        return self.sample.earthquakes

    @property
    def overturning(self) -> int:
        """How many overturn in the integration."""
        return sum(math.isinf(row.integrated_rotation_ratio) for row in self.cases)

    @cached_property
    def agreements(self) -> Counter[str]:
        """How many falls the closed form sees (hits), how many not (misses); how many it sees alone (false_alarms)."""
        hits = sum(row.sees_fall for row in self.cases)
        false = sum(
            row.integrated_rotation_ratio < row.predicted_rotation_ratio == math.inf for row in self.cases
        )
        return Counter(hits=hits, misses=self.overturning - hits, false_alarms=false)

    @property
    def rock_ratios(self) -> list[float]:
        """Predicted over integrated rotation of those that rock in both."""
        both_rock = (row for row in self.cases if row.within_factor_two is not None)
        return [row.predicted_rotation_ratio / row.integrated_rotation_ratio for row in both_rock]


of_cases = Columns(CountedCases)


@row("agreement")
class AgreementRow(RowOf[CountedCases]):
    """One row per structure and one for all: the closed form under the dominant pulse against the full integration.

    A structure on a support counts once under each component, at the period that its verdict takes.
    """

    structure: str = of_cases(
        "Name of the structure in the structure list; empty for all together", lambda of: of.structure
    )
    made: bool = of_cases(
        "Whether of the made records alone, which no other row counts together with recorded ones",
        lambda of: of.made,
    )
    records: int = of_cases("Number of records", lambda of: len({row.record for row in of.cases}))
    stations: int = of_cases("Number of stations of these", lambda of: of.stations)
    earthquakes: int = of_cases(
        "Number of earthquakes of these; what names none counts as of one", lambda of: of.earthquakes
    )
    cases: int = of_cases("Number of cases with a prediction and an integration", lambda of: len(of.cases))
    both_rock: int = of_cases("Number of cases in which both rock", lambda of: len(of.rock_ratios))
    within_factor_two: int = of_cases(
        "Number of these with a ratio between 1/2 and 2",
        lambda of: sum(bool(row.within_factor_two) for row in of.cases),
    )
    within_factor_two_low: float = of_cases(
        "Lower end of the 90 % interval of the share of these, by earthquakes; 0 to 1 of one earthquake",
        lambda of: of.within_factor_two_low,
    )
    within_factor_two_high: float = of_cases("Its upper end", lambda of: of.within_factor_two_high)
    median_ratio: float = of_cases(
        "Median of predicted over integrated rotation where both rock",
        lambda of: median(of.rock_ratios) if of.rock_ratios else math.nan,
    )
    overturning: int = of_cases(
        "Number of cases that overturn in the integration",
        lambda of: of.overturning,
    )
    overturning_hits: int = of_cases(
        "Number of these that the closed form sees: it overturns by a pulse that begins before the fall",
        lambda of: of.agreements["hits"],
    )
    overturning_misses: int = of_cases(
        "Number of these that it does not see", lambda of: of.agreements["misses"]
    )
    overturning_false_alarms: int = of_cases(
        "Number of cases that overturn in the closed form alone", lambda of: of.agreements["false_alarms"]
    )


def agreement_rows(
    comparison: Iterable[rows.ComparisonRow],
    names: Mapping[str, tuple[str, str]],
    made: Container[str] = (),
) -> Iterator[AgreementRow]:
    """Yield the counts of all, of all under made records where there are any, and of each structure.

    comparison: the cases that are counted, of all records. names: station and earthquake of each record. made: the
    records that nobody recorded.
    """
    compared = [
        row
        for row in comparison
        if not (math.isnan(row.predicted_rotation_ratio) or math.isnan(row.integrated_rotation_ratio))
    ]
    recorded, of_made = counted_apart(compared, made)
    yield AgreementRow.of(CountedCases("", recorded, names))
    if of_made:
        yield AgreementRow.of(CountedCases("", of_made, names, made=True))
    of_each: dict[str, list[rows.ComparisonRow]] = {}
    for case in recorded:
        of_each.setdefault(case.structure, []).append(case)
    for structure, cases in of_each.items():
        yield AgreementRow.of(CountedCases(structure, cases, names))


@dataclass(frozen=True, kw_only=True)
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

    component: str = of_spectrum(inputs.COMPONENT, lambda of: of.accelerogram.component)
    frequency_parameter_rad_s: float = of_spectrum(
        inputs.FREQUENCY_PARAMETER, lambda of: of.frequency_parameter, equation="Eq. 11"
    )
    uplift_multiplier: float = of_spectrum(
        "Uplift acceleration of the equivalent block in g", lambda of: of.uplift_multiplier, equation="Eq. 12"
    )
    restitution: float = of_spectrum(inputs.RESTITUTION, lambda of: of.restitution, equation="Eq. 2")
    rotation_ratio: float = of_spectrum(
        "Largest rotation over critical rotation; INF if it overturns", lambda of: of.rotation_ratio
    )
    scale_factor: float = of_spectrum(inputs.SCALE_FACTOR, lambda of: of.accelerogram.scale_factor)
    record_sha256: str = of_spectrum(inputs.RECORD_SHA256, lambda of: of.accelerogram.source.sha256)


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
        for (frequency_parameter, uplift_multiplier), rotation_ratio in zip(
            blocks, np.ravel(ratios).tolist(), strict=True
        ):
            yield SpectrumRow.of(
                BlockUnderRecord(
                    accelerogram=accelerogram,
                    frequency_parameter=frequency_parameter,
                    uplift_multiplier=uplift_multiplier,
                    restitution=restitution,
                    rotation_ratio=rotation_ratio,
                )
            )


@dataclass(frozen=True, kw_only=True)
class CountedFalls:
    """How many structures are expected to fall under one record, or on average under several.

    record: its identifier; "" for the mean over all. expected_falls: the sum of the shares of those that have one;
    its low and high ends: of the 90 % interval of the mean. without_share: how many have none. still: of one record 1
    where nothing lifts any of the structures, of all the stations of which that holds.
    """

    record: str
    structures: int
    expected_falls: float
    without_share: float
    expected_falls_low: float = math.nan
    expected_falls_high: float = math.nan
    stations: int = 1
    earthquakes: int = 1
    still: int = 0


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
        "Low end of the 90 % interval of the mean over more such earthquakes; where none, or all, are expected to fall "
        "under most of them it holds for any, and is wide",
        lambda of: of.expected_falls_low,
    )
    expected_falls_high: float = of_falls("High end of that interval", lambda of: of.expected_falls_high)
    without_share: float = of_falls("Number of structures that have no share", lambda of: of.without_share)
    stations: int = of_falls("Number of stations", lambda of: of.stations)
    earthquakes: int = of_falls(
        "Number of earthquakes of these; what names none counts as of one", lambda of: of.earthquakes
    )
    still: int = of_falls(
        "Number of these stations at which nothing lifts any structure, so that they say nothing about stronger "
        "shaking",
        lambda of: of.still,
    )


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
    without_share = sum(math.isnan(row.overturning_share) and not row.decision.word.stays_up for row in worst)
    still = all(row.rotation_ratio == 0 for row in worst)
    return ExpectedFallsRow.of(
        CountedFalls(
            record=worst[0].record,
            structures=len(worst),
            expected_falls=float(np.nansum(shares)),
            without_share=without_share,
            still=int(still),
        )
    )


def falls_over(records: Sequence[ExpectedFallsRow], sample: Sample) -> ExpectedFallsRow | None:
    """Return the mean over the stations, with the interval of `interval_of_mean`; None without any.

    sample: of the records. What falls under one record falls together or not at all, so that each record is one
    observation, however many structures there are; and the stations of one earthquake are no independent ones.
    """
    if not records:
        return None
    structures = max(row.structures for row in records)
    falls = sample.by_station(np.array([row.expected_falls for row in records]))
    still = sample.by_station(np.array([float(row.still) for row in records]))
    without_share = float(np.mean([row.without_share for row in records]))
    low = high = math.nan
    if len(records) > 1:
        low, high = interval_of_mean(falls, structures, sample)
    return ExpectedFallsRow.of(
        CountedFalls(
            record="",
            structures=structures,
            expected_falls=float(falls.mean()),
            without_share=without_share,
            expected_falls_low=low,
            expected_falls_high=high,
            stations=sample.count,
            earthquakes=sample.earthquakes,
            still=int((still == 1).sum()),
        )
    )


def hardly_spread(parts: np.ndarray, structures: int) -> bool:
    """Whether the parts of a class that fall (n,) say too little of what further earthquakes would do: under most of
    them fewer than half a structure falls, or stands, or all are equal.
    """
    falls = structures * parts
    are_between = (falls >= 0.5) & (falls <= structures - 0.5)
    return bool(2 * are_between.sum() < falls.size or np.ptp(falls) == 0)


def interval_of_mean(falls: np.ndarray, structures: int, sample: Sample) -> tuple[float, float]:
    """Return the 90 % interval of the mean number that falls, of the numbers (s,) at the stations of a sample.

    What counts as one is an earthquake with the mean of its stations. The part of a class that falls is the normal
    distribution of a quantity that all structures share, which is normal over the earthquakes (Vasicek 2002, Risk
    15(12), 160-162): that of lognormal fragilities under lognormal shaking. The interval of its mean is the generalised
    one (Krishnamoorthy & Mathew 2003, J. Stat. Plan. Inference 115, 103-121), joined with Student's of the mean itself
    on its log odds, which does not need that law. Where the earthquakes are `hardly_spread`, neither sees what none of
    them has shown; the interval is then that of Clopper and Pearson for the sum of the parts, as of earthquakes under
    which all fall or none does, which vary more than any others of that mean. One earthquake says nothing of others.
    """
    from scipy.special import betaincinv, chdtri, expit, logit, ndtr, ndtri  # slow to import

    spread = sample.spread(falls / structures)
    parts = spread.values
    n = spread.count
    mean = spread.mean
    if parts.size < 2:
        return 0.0, float(structures)
    if hardly_spread(parts, structures):
        fell = n * mean
        low = float(betaincinv(fell, n - fell + 1, TAIL)) if fell > 0 else 0.0
        high = float(betaincinv(fell + 1, n - fell, 1 - TAIL)) if fell < n else 1.0
        return structures * low, structures * high

    # Half a member of the 64 of one structure: the least that could have been seen.
    least = 1 / (128 * structures)
    shaking = spread.of(ndtri(np.clip(parts, least, 1 - least)))
    middles = (np.arange(100) + 0.5) / 100
    deviations = shaking.deviation * np.sqrt((n - 1) / chdtri(n - 1, middles))
    means = shaking.mean + ndtri(middles)[:, None] * deviations / math.sqrt(n)
    of_law = np.quantile(ndtr(means / np.sqrt(1 + deviations**2)), [TAIL, 1 - TAIL])

    half = spread.reach() / (mean * (1 - mean))
    of_mean = expit(logit(mean) + half * np.array([-1, 1]))
    low, high = min(of_law[0], of_mean[0]), max(of_law[1], of_mean[1])
    return structures * float(low), structures * float(high)


SUMMARY_TABLES: tuple[type[Row], ...] = (
    inputs.RecordRow,
    inputs.PulseRow,
    rows.ComparisonRow,
    rows.VerdictRow,
    rows.SupportRow,
    rows.MechanismRow,
    rows.VariationRow,
    ExpectedFallsRow,
    AgreementRow,
    inputs.StructureRow,
    inputs.CapacityRow,
    rows.FailureRow,
    rows.RemarkRow,
    rows.TimingRow,
)
"""The rows of the tables of the summary folder."""
