"""Rows about a whole study: its counts and its spectrum."""

import math
from collections.abc import Collection, Container, Iterable, Iterator, Mapping, Sequence
from itertools import product
from statistics import median

import numpy as np

from rocking.assessment.rows import of_inputs as inputs
from rocking.assessment.rows import of_record as rows
from rocking.earthquakes.sample import INTERVAL, MADE, TAIL, UNNAMED, ClusterSample
from rocking.records import Accelerogram
from rocking.tables import Row, column, row


def named_records(records: Iterable[inputs.RecordRow], each_unnamed: bool) -> dict[str, tuple[str, str]]:
    """Return station and earthquake of each record, by its identifier. each_unnamed: as of `ClusterSample.of`."""
    names, sample = sample_of_records(records, each_unnamed)
    return dict(zip(names, zip(sample.stations, sample.events, strict=True), strict=True))


def sample_of_records(
    records: Iterable[inputs.RecordRow], each_unnamed: bool
) -> tuple[list[str], ClusterSample]:
    """Return the identifiers of the records (r,), and their sample with what there is to say of it."""
    firsts: dict[str, inputs.RecordRow] = {}
    for component in records:
        firsts.setdefault(component.record, component)
    return list(firsts), ClusterSample.of(list(firsts.values()), rows=list(firsts), each_unnamed=each_unnamed)


def made_records(records: Iterable[inputs.RecordRow]) -> set[str]:
    """Return the identifiers of the records that nobody recorded."""
    return {component.record for component in records if component.event == MADE}


def counted_apart(
    comparison: Iterable[rows.ComparisonRow], made: Container[str]
) -> tuple[list[rows.ComparisonRow], list[rows.ComparisonRow]]:
    """Return the cases under what was recorded, and those under made records; where all were made, they come first."""
    recorded: list[rows.ComparisonRow] = []
    of_made: list[rows.ComparisonRow] = []
    for case in comparison:
        (of_made if case.record in made else recorded).append(case)
    return (recorded, of_made) if recorded else (of_made, [])


@row("agreement")
class AgreementRow(Row):
    """One row per structure and one for all: the closed form under the dominant pulse against the full integration.

    A structure on a support counts once under each component, at the period that its verdict takes.
    """

    structure: str = column("Name of the structure in the structure list; empty for all together")
    made: bool = column(
        "Whether of the made records alone, which no other row counts together with recorded ones"
    )
    records: int = column("Number of records")
    stations: int = column("Number of stations of these")
    earthquakes: int = column("Number of earthquakes of these; what names none counts as of one")
    cases: int = column("Number of cases with a prediction and an integration")
    both_rock: int = column("Number of cases in which both rock")
    within_factor_two: int = column("Number of these with a ratio between 1/2 and 2")
    within_factor_two_low: float = column(
        f"Lower end of the {INTERVAL} of the share of these, by earthquakes; 0 to 1 of one earthquake"
    )
    within_factor_two_high: float = column("Its upper end")
    median_ratio: float = column("Median of predicted over integrated rotation where both rock")
    overturning: int = column("Number of cases that overturn in the integration")
    overturning_hits: int = column(
        "Number of these that the closed form sees: it overturns by a pulse that begins before the fall"
    )
    overturning_misses: int = column("Number of these that it does not see")
    overturning_false_alarms: int = column("Number of cases that overturn in the closed form alone")


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
    yield _agreement("", recorded, names)
    if of_made:
        yield _agreement("", of_made, names, made=True)
    of_each: dict[str, list[rows.ComparisonRow]] = {}
    for case in recorded:
        of_each.setdefault(case.structure, []).append(case)
    for structure, cases in of_each.items():
        yield _agreement(structure, cases, names)


def _agreement(
    structure: str,
    cases: Sequence[rows.ComparisonRow],
    names: Mapping[str, tuple[str, str]],
    made: bool = False,
) -> AgreementRow:
    """The counts of the cases of one structure ("": of all) that have both ratios; the rest as of `agreement_rows`."""
    sample = ClusterSample.named(names.get(row.record, (row.record, UNNAMED)) for row in cases)
    both_rock = [place for place, row in enumerate(cases) if row.within_factor_two is not None]
    within = np.array([float(bool(cases[place].within_factor_two)) for place in both_rock])
    low = high = math.nan
    if both_rock:
        of_both = sample.of_records(np.array(both_rock))
        low, high = map(float, of_both.share_bounds(of_both.by_station(within)))
    ratios = [
        cases[place].predicted_rotation_ratio / cases[place].integrated_rotation_ratio for place in both_rock
    ]
    overturning = sum(math.isinf(row.integrated_rotation_ratio) for row in cases)
    hits = sum(row.sees_fall for row in cases)
    alone = sum(row.integrated_rotation_ratio < row.predicted_rotation_ratio == math.inf for row in cases)
    return AgreementRow(
        structure=structure,
        made=made,
        records=len({row.record for row in cases}),
        stations=sample.count,
        earthquakes=sample.earthquakes,
        cases=len(cases),
        both_rock=len(both_rock),
        within_factor_two=int(within.sum()),
        within_factor_two_low=low,
        within_factor_two_high=high,
        median_ratio=median(ratios) if ratios else math.nan,
        overturning=overturning,
        overturning_hits=hits,
        overturning_misses=overturning - hits,
        overturning_false_alarms=alone,
    )


@row("spectrum")
class SpectrumRow(Row):
    """One row per component and equivalent block under the whole record; written by rocking spectrum."""

    component: str = column(inputs.COMPONENT)
    frequency_parameter_rad_s: float = column(inputs.FREQUENCY_PARAMETER, equation="Eq. 11")
    uplift_multiplier: float = column("Uplift acceleration of the equivalent block in g", equation="Eq. 12")
    restitution: float = column(inputs.RESTITUTION, equation="Eq. 2")
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")
    scale_factor: float = column(inputs.SCALE_FACTOR)
    record_sha256: str = column(inputs.RECORD_SHA256)


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
            yield SpectrumRow(
                component=accelerogram.component,
                frequency_parameter_rad_s=frequency_parameter,
                uplift_multiplier=uplift_multiplier,
                restitution=restitution,
                rotation_ratio=rotation_ratio,
                scale_factor=accelerogram.scale_factor,
                record_sha256=accelerogram.source.sha256,
            )


@row("expected_falls")
class ExpectedFallsRow(Row):
    """One row per record and one for all: how many of the structures, variants apart, are expected to fall."""

    record: str = column("Record; empty for the mean over all records")
    structures: int = column("Number of structures")
    expected_falls: float = column("Sum of the shares that overturn, of the structures that have one")
    expected_falls_low: float = column(
        f"Low end of the {INTERVAL} of the mean over more such earthquakes; where none, or all, are expected to fall "
        "under most of them it holds for any, and is wide",
        default=math.nan,
    )
    expected_falls_high: float = column("High end of that interval", default=math.nan)
    without_share: float = column("Number of structures that have no share")
    stations: int = column("Number of stations", default=1)
    earthquakes: int = column(
        "Number of earthquakes of these; what names none counts as of one; 0 of a made record, which the mean over all "
        "leaves out unless all are made",
        default=1,
    )
    still: int = column(
        "Number of these stations at which nothing lifts any structure, so that they say nothing about stronger "
        "shaking",
        default=0,
    )


def falls_under(
    verdicts: Iterable["rows.VerdictRow"], variants: Collection[str] = (), made: Container[str] = ()
) -> ExpectedFallsRow | None:
    """Return how many structures are expected to fall under one record; None without a verdict.

    Expectations add whatever the structures have in common. variants: names of structures that stand for another one,
    and are not counted. made: the records that nobody recorded.
    """
    worst = [row for row in rows.worst_period_each(verdicts) if row.structure not in variants]
    if not worst:
        return None
    shares = [row.overturning_share for row in worst]
    without_share = sum(
        math.isnan(row.overturning_share) and not row.decision.verdict.stays_up for row in worst
    )
    still = all(row.rotation_ratio == 0 for row in worst)
    return ExpectedFallsRow(
        record=worst[0].record,
        structures=len(worst),
        expected_falls=float(np.nansum(shares)),
        without_share=without_share,
        earthquakes=int(worst[0].record not in made),
        still=int(still),
    )


def falls_recorded(falls: Iterable[ExpectedFallsRow]) -> list[ExpectedFallsRow]:
    """Return the rows of single records that an earthquake shook; where all records were made, of all of them."""
    of_records = [row for row in falls if row.record]
    return [row for row in of_records if row.earthquakes] or of_records


def falls_over(
    falls: Iterable[ExpectedFallsRow], names: Mapping[str, tuple[str, str]]
) -> ExpectedFallsRow | None:
    """Return the mean over the stations, with the interval of `interval_of_mean`; None without any.

    names: station and earthquake of each record. What falls under one record falls together or not at all, so that each
    record is one observation, however many structures there are; and the stations of one earthquake are no independent
    ones. Made records are counted as of `falls_recorded`.
    """
    records = falls_recorded(falls)
    if not records:
        return None
    sample = ClusterSample.named(names[row.record] for row in records)
    structures = max(row.structures for row in records)
    falls = sample.by_station(np.array([row.expected_falls for row in records]))
    still = sample.by_station(np.array([float(row.still) for row in records]))
    without_share = float(np.mean([row.without_share for row in records]))
    low = high = math.nan
    if len(records) > 1:
        low, high = interval_of_mean(falls, structures, sample)
    return ExpectedFallsRow(
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


def hardly_spread(parts: np.ndarray, structures: int) -> bool:
    """Whether the parts of a class that fall (n,) say too little of what further earthquakes would do: under most of
    them fewer than half a structure falls, or stands, or all are equal.
    """
    falls = structures * parts
    are_between = (falls >= 0.5) & (falls <= structures - 0.5)
    return bool(2 * are_between.sum() < falls.size or np.ptp(falls) == 0)


def interval_of_mean(falls: np.ndarray, structures: int, sample: ClusterSample) -> tuple[float, float]:
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
    # Where one earthquake has nearly all stations, the least quantiles are 0 to double precision.
    quantiles = np.maximum(chdtri(n - 1, middles), np.finfo(float).tiny)
    deviations = shaking.deviation * np.sqrt((n - 1) / quantiles)
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
    rows.WarningRow,
    rows.TimingRow,
)
"""The rows of the tables of the summary folder."""
