"""The rows of a study's fragility: responses at every level, curves, and what each comes down to."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TypeVar

import numpy as np
from scipy.special import ndtri

from rocking.assessment.rows import RECORD, Placed, PlacedRow
from rocking.earthquakes.sample import INTERVAL, ClusterSample
from rocking.errors import ConfigurationError
from rocking.fragility.curves import (
    Explanation,
    Fragility,
    IncrementalDynamicAnalysis,
    explanation,
    factors_to,
)
from rocking.fragility.hazard import REACHING, AnnualRate, Hazard
from rocking.fragility.measures import (
    MEASURES_IN_WORDS,
    IntensityMeasure,
    compared,
)
from rocking.records import Accelerogram
from rocking.signal.measures import peak_velocity
from rocking.structures import Mechanism
from rocking.tables import Columns, Row, row

ROTATION_RATIOS = (0.1, 0.3, 0.5, math.inf)
"""Largest rotations over the critical one whose exceedance has a curve; inf: overturning."""
_MEASURE = f"Intensity measure: {MEASURES_IN_WORDS}"


@dataclass(frozen=True, kw_only=True)
class ScaledRecord(Placed):
    """One record scaled to one level. place, step: of record and level in the analysis."""

    record: str
    analysis: IncrementalDynamicAnalysis
    place: int
    step: int

    @property
    def level(self) -> float:
        """The level to which it is scaled."""
        return float(self.analysis.levels[self.step])

    @property
    def rotation_ratios(self) -> np.ndarray:
        """(m,) rotation ratios of the members; nan for all where the record does not reach the level."""
        of_members: np.ndarray = self.analysis.rotation_ratios[self.place, self.step]
        return of_members

    @property
    def members(self) -> int:
        """Their number."""
        return self.rotation_ratios.size

    @property
    def rotation_ratio_median(self) -> float:
        """The median of these, the lower of the two in the middle."""
        return float(np.sort(self.rotation_ratios)[(self.rotation_ratios.size - 1) // 2])

    @property
    def overturning_share(self) -> float:
        """The share of the members that overturn."""
        return float(np.isinf(self.rotation_ratios).mean())


of_scaled = Columns(ScaledRecord)


@row("ida")
class IdaRow(PlacedRow[ScaledRecord]):
    """One row per structure, record and level: incremental dynamic analysis."""

    record: str = of_scaled(RECORD, lambda of: of.record)
    station: str = of_scaled(
        "Event and station, which count as one independent record",
        lambda of: of.analysis.stations[of.place],
    )
    intensity_measure: str = of_scaled(_MEASURE, lambda of: of.analysis.measure.name)
    level: float = of_scaled("Level to which the record is scaled", lambda of: of.level)
    scale_factor: float = of_scaled(
        "Factor on the record to reach the level",
        lambda of: float(of.analysis.factors[of.place, of.step]),
    )
    members: int = of_scaled("Number of members", lambda of: of.members)
    rotation_ratio_median: float = of_scaled(
        "Median of largest rotation over critical rotation",
        lambda of: of.rotation_ratio_median,
    )
    overturning_share: float = of_scaled(
        "Share of the members that overturn with the crack that governs", lambda of: of.overturning_share
    )


def ida_rows(
    structure: str,
    records: Sequence[str],
    analysis: IncrementalDynamicAnalysis,
    support_period: float | None = None,
) -> Iterator[IdaRow]:
    """Yield a row for each record and level that it reaches within the largest factor."""
    for place, record in enumerate(records):
        for step, _ in enumerate(analysis.levels):
            scaled = ScaledRecord(
                structure=structure,
                record=record,
                analysis=analysis,
                place=place,
                step=step,
                support_period=support_period,
            )
            if not np.isnan(scaled.rotation_ratios).all():
                yield IdaRow.of(scaled)


@dataclass(frozen=True)
class DrawnCurve(Placed):
    """The curve of one structure."""

    curve: Fragility

    def stations_reaching(self, place: int) -> int:
        """Return how many stations have a record that reaches the level at `place` within the largest factor."""
        tried = np.isfinite(self.curve.exceedance[:, place])
        return len({name for name, reached in zip(self.curve.stations, tried, strict=True) if reached})


D = TypeVar("D", bound=DrawnCurve)
of_curve = Columns(DrawnCurve)


@row()
class CurveRow(PlacedRow[D]):
    """A row about the curve of a structure: for which intensity measure and rotation it holds."""

    intensity_measure: str = of_curve(_MEASURE, lambda of: of.curve.measure)
    threshold: float = of_curve(
        "Rotation over critical rotation that is exceeded; INF: overturning", lambda of: of.curve.threshold
    )


@dataclass(frozen=True)
class CurvePoint(DrawnCurve):
    """One level of a curve. place: of the level."""

    place: int


of_point = Columns(CurvePoint)


@row("fragility")
class FragilityRow(CurveRow[CurvePoint]):
    """One row per structure, rotation that is exceeded and level: the curves with 90 % intervals."""

    level: float = of_point("Level of the intensity measure", lambda of: float(of.curve.levels[of.place]))
    stations: int = of_point(
        "Number of stations whose records reach the level within the largest factor",
        lambda of: of.stations_reaching(of.place),
    )
    probability: float = of_point(
        "Share of the stations that exceed the rotation", lambda of: float(of.curve.probability[of.place])
    )
    probability_low: float = of_point(
        f"Lower end of the {INTERVAL} of the probability",
        lambda of: float(of.curve.probability_low[of.place]),
    )
    probability_high: float = of_point(
        f"Upper end of the {INTERVAL} of the probability",
        lambda of: float(of.curve.probability_high[of.place]),
    )
    lognormal: float = of_point(
        "Probability by the lognormal curve of maximum likelihood",
        lambda of: float(of.curve.lognormal[of.place]),
    )


def fragility_rows(
    structure: str, curve: Fragility, support_period: float | None = None
) -> Iterator[FragilityRow]:
    """Yield a row for each level."""
    for place, _ in enumerate(curve.levels):
        yield FragilityRow.of(CurvePoint(structure, curve, place, support_period=support_period))


@dataclass(frozen=True)
class SummarisedCurve(DrawnCurve):
    """One curve with the hazard curve of its intensity measure, where there is one."""

    hazard: Hazard | None

    @cached_property
    def rate(self) -> AnnualRate | None:
        """The annual rate of exceedance; None without a hazard curve of the measure."""
        if self.hazard is None or not self.hazard.is_of(self.curve.measure):
            return None
        return self.curve.annual_rate(self.hazard)

    @property
    def records(self) -> int:
        """The number of its records."""
        return len(self.curve.stations)

    @property
    def stations(self) -> int:
        """The number of their stations."""
        return self.curve.sample.count

    @property
    def stations_at_median(self) -> int:
        """The number of those that reach the median; where there is none, the highest level."""
        return self.curve.reaching(min(self.curve.median, float(self.curve.levels[-1])))

    @property
    def factor_for_median(self) -> float:
        """The largest factor with which nine in ten stations reach the median; nan without one."""
        analysis = self.curve.analysis
        if analysis is None or not math.isfinite(self.curve.median):
            return math.nan
        needed: dict[str, float] = {}
        factors = factors_to(np.array([self.curve.median]), analysis.intensities, analysis.measure.power)
        for name, factor in zip(self.curve.stations, factors[:, 0].tolist(), strict=True):
            needed[name] = min(needed.get(name, math.inf), factor)
        return float(np.quantile(list(needed.values()), REACHING, method="higher"))

    @property
    def stations_out(self) -> int:
        """The number of those that do not reach the highest level."""
        return self.stations - self.stations_reaching(-1)

    @property
    def median_low(self) -> float:
        """The lower end of the interval of the median."""
        return self.curve.interval[0]

    @property
    def median_high(self) -> float:
        """Its upper end."""
        return self.curve.interval[1]

    @property
    def largest_scale_factor(self) -> float:
        """The largest factor on a record that was used; nan of outcomes alone."""
        if self.curve.analysis is None:
            return math.nan
        return float(self.curve.analysis.factors[np.isfinite(self.curve.exceedance)].max())


of_summary = Columns(SummarisedCurve)


@row("fragility_summary")
class FragilitySummaryRow(CurveRow[SummarisedCurve]):
    """One row per structure and rotation that is exceeded: what its curve comes down to."""

    records: int = of_summary("Number of records", lambda of: of.records)
    stations: int = of_summary("Number of stations", lambda of: of.stations)
    earthquakes: int = of_summary(
        "Number of earthquakes of these; what names none counts as of one",
        lambda of: of.curve.sample.earthquakes,
    )
    stations_at_median: int = of_summary(
        "Number of stations that reach the median within the largest factor; without one the highest level",
        lambda of: of.stations_at_median,
    )
    factor_for_median: float = of_summary(
        "Largest factor with which nine in ten stations reach the median", lambda of: of.factor_for_median
    )
    stations_out: int = of_summary(
        "Number of stations that do not reach the highest level within the largest factor",
        lambda of: of.stations_out,
    )
    largest_scale_factor: float = of_summary(
        "Largest factor on a record that was used", lambda of: of.largest_scale_factor
    )
    median: float = of_summary(
        "Level at which the empirical curve crosses one half; INF: it does not", lambda of: of.curve.median
    )
    by: str = of_summary("What the curve is of", lambda of: of.curve.by)
    median_upper: float = of_summary(
        "The median of the curve in which what cannot be told falls; the median where all can be told",
        lambda of: of.curve.upper.median if of.curve.upper else of.curve.median,
    )
    median_low: float = of_summary(
        f"Lower end of the {INTERVAL} of the median, by earthquakes; 0: there is none",
        lambda of: of.median_low,
    )
    median_high: float = of_summary(
        f"Upper end of the {INTERVAL} of the median; INF: none at the levels tried",
        lambda of: of.median_high,
    )
    lognormal_median: float = of_summary(
        "Median of the lognormal curve, for those who need two parameters",
        lambda of: of.curve.lognormal_median,
    )
    dispersion: float = of_summary(
        "Standard deviation of the logarithm, lognormal curve", lambda of: of.curve.dispersion
    )
    misfit: float = of_summary(
        "Largest distance of the lognormal from the empirical curve", lambda of: of.curve.misfit
    )
    reversals: int = of_summary(
        "Number of records under which the structure stands again when they are scaled up further",
        lambda of: int((of.curve.reversals > 0).sum()),
    )
    annual_rate: float = of_summary(
        "Annual rate of exceedance; empty without a hazard curve, and where fewer than nine in ten stations reach the "
        "level at which half of it is made",
        lambda of: of.rate.value if of.rate else math.nan,
        unit="1/year",
    )
    annual_rate_low: float = of_summary(
        f"Lower end of the {INTERVAL} of the rate, by earthquakes; of an empty rate, where what is not reached "
        "never overturns",
        lambda of: of.rate.low if of.rate else math.nan,
        unit="1/year",
    )
    annual_rate_high: float = of_summary(
        f"Upper end of the {INTERVAL} of the rate, by earthquakes; of an empty rate, where what is not reached "
        "overturns at once",
        lambda of: of.rate.high if of.rate else math.nan,
        unit="1/year",
    )
    stations_at_half_rate: int | None = of_summary(
        "Number of stations that reach the level at which half of the rate is made",
        lambda of: of.rate.reaching if of.rate else None,
    )
    annual_rate_remainder: float = of_summary(
        "Largest rate that may be missing beyond the ends of both curves",
        lambda of: of.rate.remainder if of.rate else math.nan,
        unit="1/year",
    )


def curve_rows(
    structure: str,
    records: Sequence[str],
    analysis: IncrementalDynamicAnalysis,
    hazard: Hazard | None,
    support_period: float | None = None,
) -> Iterator[IdaRow | FragilityRow | FragilitySummaryRow]:
    """Yield the rows of the responses of a structure, and of its curve for each of ROTATION_RATIOS."""
    yield from ida_rows(structure, records, analysis, support_period)
    for threshold in ROTATION_RATIOS:
        curve = analysis.fragility(threshold)
        yield from fragility_rows(structure, curve, support_period)
        yield FragilitySummaryRow.of(SummarisedCurve(structure, curve, hazard, support_period=support_period))


@dataclass(frozen=True)
class ExplainedOverturning(Placed):
    """One intensity measure, and one other figure of the record, that may explain which records overturn a structure.

    sample: of the records that have both.
    """

    measure: IntensityMeasure
    figure: str
    sample: ClusterSample
    explanation: Explanation

    @property
    def records(self) -> int:
        """The number of these records."""
        return len(self.sample.stations)

    @property
    def stations(self) -> int:
        """The number of their stations."""
        return self.sample.count


of_explained = Columns(ExplainedOverturning)


@row("intensity_measures")
class IntensityMeasureRow(PlacedRow[ExplainedOverturning]):
    """One row per structure, intensity measure and other figure of the record: what explains overturning."""

    intensity_measure: str = of_explained(_MEASURE, lambda of: of.measure.name)
    efficiency: float = of_explained(
        "Dispersion of the level that overturns: standard deviation of its logarithm (of the root of arias)",
        lambda of: of.explanation.efficiency,
    )
    stations_needed: int | None = of_explained(
        "Number of stations at which the 90 % interval of the median is ± 20 %",
        lambda of: stations_for(of.explanation.efficiency),
    )
    figure: str = of_explained(
        "Second quantity of the record that may matter: PGV/PGA, magnitude or ln of the distance",
        lambda of: of.figure,
    )
    records: int = of_explained("Number of records with the measure and the figure", lambda of: of.records)
    stations: int = of_explained("Number of stations", lambda of: of.stations)
    earthquakes: int = of_explained("Number of earthquakes of these", lambda of: of.sample.earthquakes)
    slope: float = of_explained(
        "Change of the logarithm of that level for one standard deviation of the figure",
        lambda of: of.explanation.slope,
    )
    p_value: float = of_explained(
        "p-value of no change; below 0.05 the measure is not sufficient", lambda of: of.explanation.p_value
    )
    power: float = of_explained(
        "Share of samples of as many earthquakes that would show such a slope at 5 %",
        lambda of: of.explanation.power,
    )


MARGIN = 0.2
"""Half of the 90 % interval of a median that a study is to reach, as a share of it."""


def stations_for(scatter: float) -> int | None:
    """Return how many stations give a median to ± MARGIN, 90 %; None of an unknown scatter.

    The logarithm of a sample median of n scatters by √(π/2) times the scatter over √n, a normal law supposed.
    """
    if not math.isfinite(scatter):
        return None
    reach = float(ndtri(0.95)) * math.sqrt(math.pi / 2) * scatter / math.log(1 + MARGIN)
    return max(2, math.ceil(reach**2))


def intensity_measure_rows(
    structure: str,
    mechanism: Mechanism,
    records: Sequence[Accelerogram],
    analysis: IncrementalDynamicAnalysis,
    support_period: float | None = None,
) -> Iterator[IntensityMeasureRow]:
    """Yield how well each measure explains which records overturn the structure at which level."""
    factors = np.log(analysis.factors)
    ratios = analysis.rotation_ratios
    falls = np.where(np.isnan(ratios), np.nan, np.isinf(ratios)).mean(axis=2)
    for measure in compared(mechanism):
        logs = np.log([_or_nan(measure, record, mechanism) for record in records]) / measure.power
        for figure, values in _figures(records).items():
            both = np.isfinite(logs) & np.isfinite(values)
            sample = analysis.sample.of_records(both)
            if sample.count < 2:
                continue
            levels = logs[both, None] + factors[both]
            explained = explanation(levels, falls[both], values[both], sample)
            of_measure = ExplainedOverturning(
                structure, measure, figure, sample, explained, support_period=support_period
            )
            yield IntensityMeasureRow.of(of_measure)


def _figures(records: Sequence[Accelerogram]) -> dict[str, np.ndarray]:
    """Figures of each record that the level of overturning may depend on besides its intensity; nan where unknown."""
    return {
        "PGV/PGA": np.log([peak_velocity(record) / record.peak_acceleration for record in records]),
        "magnitude": np.array([record.magnitude for record in records], dtype=float),
        "ln distance": np.log([record.epicentral_distance or math.nan for record in records]),
    }


def _or_nan(measure: IntensityMeasure, record: Accelerogram, mechanism: Mechanism) -> float:
    try:
        return measure.of(record, mechanism)
    except ConfigurationError:
        return math.nan


FRAGILITY_TABLES: Mapping[str, type[Row]] = {
    row_class.table.name: row_class
    for row_class in (IdaRow, FragilityRow, FragilitySummaryRow, IntensityMeasureRow)
}
"""The tables of the fragility of a study, by name."""
