"""The rows of a study's fragility: responses at every level, curves, and what each comes down to."""

import math
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from scipy.special import ndtri

from rocking.assessment.rows import RECORD, PlacedRow
from rocking.earthquakes.sample import INTERVAL
from rocking.errors import ConfigurationError
from rocking.fragility.curves import Fragility, IncrementalDynamicAnalysis, explanation, factors_to
from rocking.fragility.hazard import REACHING, Hazard
from rocking.fragility.measures import MEASURES_IN_WORDS, IntensityMeasure, compared
from rocking.records import Accelerogram
from rocking.signal.measures import peak_velocity
from rocking.structures import Mechanism
from rocking.tables import Row, column, row

ROTATION_RATIOS = (0.1, 0.3, 0.5, math.inf)
"""Largest rotations over the critical one whose exceedance has a curve; inf: overturning."""
_MEASURE = f"Intensity measure: {MEASURES_IN_WORDS}"


@row("ida")
class IdaRow(PlacedRow):
    """One row per structure, record and level: incremental dynamic analysis."""

    record: str = column(RECORD)
    station: str = column("Event and station, which count as one independent record")
    intensity_measure: str = column(_MEASURE)
    level: float = column("Level to which the record is scaled")
    scale_factor: float = column("Factor on the record to reach the level")
    members: int = column("Number of members")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    overturning_share: float = column("Share of the members that overturn with the crack that governs")


def ida_rows(
    structure: str,
    records: Sequence[str],
    analysis: IncrementalDynamicAnalysis,
    support_period: float | None = None,
) -> Iterator[IdaRow]:
    """Yield a row for each record and level that it reaches within the largest factor."""
    for place, record in enumerate(records):
        for step, ratios in enumerate(analysis.rotation_ratios[place]):
            if np.isnan(ratios).all():
                continue
            yield IdaRow(
                structure=structure,
                support_period_s=support_period,
                record=record,
                station=analysis.stations[place],
                intensity_measure=analysis.measure.name,
                level=float(analysis.levels[step]),
                scale_factor=float(analysis.factors[place, step]),
                members=ratios.size,
                # Of two in the middle the lower one.
                rotation_ratio_median=float(np.sort(ratios)[(ratios.size - 1) // 2]),
                overturning_share=float(np.isinf(ratios).mean()),
            )


@row()
class CurveRow(PlacedRow):
    """A row about the curve of a structure: for which intensity measure and rotation it holds."""

    intensity_measure: str = column(_MEASURE)
    threshold: float = column("Rotation over critical rotation that is exceeded; INF: overturning")


@row("fragility")
class FragilityRow(CurveRow):
    """One row per structure, rotation that is exceeded and level: the curves with their intervals."""

    level: float = column("Level of the intensity measure")
    stations: int = column("Number of stations whose records reach the level within the largest factor")
    probability: float = column("Share of the stations that exceed the rotation")
    probability_low: float = column(f"Lower end of the {INTERVAL} of the probability")
    probability_high: float = column(f"Upper end of the {INTERVAL} of the probability")
    lognormal: float = column("Probability by the lognormal curve of maximum likelihood")


def fragility_rows(
    structure: str, curve: Fragility, support_period: float | None = None
) -> Iterator[FragilityRow]:
    """Yield a row for each level."""
    along = (
        *(curve.levels, curve.probability, curve.probability_low, curve.probability_high),
        curve.lognormal,
    )
    for level, probability, low, high, lognormal in np.array(along).T.tolist():
        yield FragilityRow(
            structure=structure,
            support_period_s=support_period,
            intensity_measure=curve.measure,
            threshold=curve.threshold,
            level=level,
            stations=curve.reaching(level),
            probability=probability,
            probability_low=low,
            probability_high=high,
            lognormal=lognormal,
        )


@row("fragility_summary")
class FragilitySummaryRow(CurveRow):
    """One row per structure and rotation that is exceeded: what its curve comes down to."""

    records: int = column("Number of records")
    stations: int = column("Number of stations")
    earthquakes: int = column("Number of earthquakes of these; what names none counts as of one")
    stations_at_median: int = column(
        "Number of stations that reach the median within the largest factor; without one the highest level"
    )
    factor_for_median: float = column("Largest factor with which nine in ten stations reach the median")
    stations_out: int = column(
        "Number of stations that do not reach the highest level within the largest factor"
    )
    largest_scale_factor: float = column("Largest factor on a record that was used")
    median: float = column("Level at which the empirical curve crosses one half; INF: it does not")
    by: str = column("What the curve is of")
    median_upper: float = column(
        "The median of the curve in which what cannot be told falls; the median where all can be told"
    )
    median_low: float = column(f"Lower end of the {INTERVAL} of the median, by earthquakes; 0: there is none")
    median_high: float = column(f"Upper end of the {INTERVAL} of the median; INF: none at the levels tried")
    lognormal_median: float = column("Median of the lognormal curve, for those who need two parameters")
    dispersion: float = column("Standard deviation of the logarithm, lognormal curve")
    misfit: float = column("Largest distance of the lognormal from the empirical curve")
    reversals: int = column(
        "Number of records under which the structure stands again when they are scaled up further"
    )
    annual_rate: float = column(
        "Annual rate of exceedance; empty without a hazard curve, and where fewer than nine in ten stations reach the "
        "level at which half of it is made",
        unit="1/year",
    )
    annual_rate_low: float = column(
        f"Lower end of the {INTERVAL} of the rate, by earthquakes; of an empty rate, where what is not reached "
        "never overturns",
        unit="1/year",
    )
    annual_rate_high: float = column(
        f"Upper end of the {INTERVAL} of the rate, by earthquakes; of an empty rate, where what is not reached "
        "overturns at once",
        unit="1/year",
    )
    stations_at_half_rate: int | None = column(
        "Number of stations that reach the level at which half of the rate is made"
    )
    annual_rate_remainder: float = column(
        "Largest rate that may be missing beyond the ends of both curves", unit="1/year"
    )


def _summary_row(
    structure: str, curve: Fragility, hazard: Hazard | None, support_period: float | None
) -> FragilitySummaryRow:
    """The row of one curve. hazard: of its intensity measure or another; None without one."""
    rate = curve.annual_rate(hazard) if hazard is not None and hazard.is_of(curve.measure) else None
    highest = float(curve.levels[-1])
    factor_for_median = largest_scale_factor = math.nan
    if curve.analysis is not None:
        largest_scale_factor = float(curve.analysis.factors[np.isfinite(curve.exceedance)].max())
        factor_for_median = _factor_for_median(curve, curve.analysis)
    return FragilitySummaryRow(
        structure=structure,
        support_period_s=support_period,
        intensity_measure=curve.measure,
        threshold=curve.threshold,
        records=len(curve.stations),
        stations=curve.sample.count,
        earthquakes=curve.sample.earthquakes,
        stations_at_median=curve.reaching(min(curve.median, highest)),
        factor_for_median=factor_for_median,
        stations_out=curve.sample.count - curve.reaching(highest),
        largest_scale_factor=largest_scale_factor,
        median=curve.median,
        by=curve.by,
        median_upper=curve.upper.median if curve.upper else curve.median,
        median_low=curve.interval[0],
        median_high=curve.interval[1],
        lognormal_median=curve.lognormal_median,
        dispersion=curve.dispersion,
        misfit=curve.misfit,
        reversals=int((curve.reversals > 0).sum()),
        annual_rate=rate.value if rate else math.nan,
        annual_rate_low=rate.low if rate else math.nan,
        annual_rate_high=rate.high if rate else math.nan,
        stations_at_half_rate=rate.reaching if rate else None,
        annual_rate_remainder=rate.remainder if rate else math.nan,
    )


def _factor_for_median(curve: Fragility, analysis: IncrementalDynamicAnalysis) -> float:
    """The largest factor with which nine in ten stations reach the median; nan without one."""
    if not math.isfinite(curve.median):
        return math.nan
    needed: dict[str, float] = {}
    factors = factors_to(np.array([curve.median]), analysis.intensities, analysis.measure.power)
    for name, factor in zip(curve.stations, factors[:, 0].tolist(), strict=True):
        needed[name] = min(needed.get(name, math.inf), factor)
    return float(np.quantile(list(needed.values()), REACHING, method="higher"))


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
        yield _summary_row(structure, curve, hazard, support_period)


@row("intensity_measures")
class IntensityMeasureRow(PlacedRow):
    """One row per structure, intensity measure and other figure of the record: what explains overturning."""

    intensity_measure: str = column(_MEASURE)
    efficiency: float = column(
        "Dispersion of the level that overturns: standard deviation of its logarithm (of the root of arias)"
    )
    stations_needed: int | None = column(
        "Number of stations at which the 90 % interval of the median is ± 20 %"
    )
    figure: str = column(
        "Second quantity of the record that may matter: PGV/PGA, magnitude or ln of the distance"
    )
    records: int = column("Number of records with the measure and the figure")
    stations: int = column("Number of stations")
    earthquakes: int = column("Number of earthquakes of these")
    slope: float = column("Change of the logarithm of that level for one standard deviation of the figure")
    p_value: float = column("p-value of no change; below 0.05 the measure is not sufficient")
    power: float = column("Share of samples of as many earthquakes that would show such a slope at 5 %")


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
            yield IntensityMeasureRow(
                structure=structure,
                support_period_s=support_period,
                intensity_measure=measure.name,
                efficiency=explained.efficiency,
                stations_needed=stations_for(explained.efficiency),
                figure=figure,
                records=len(sample.stations),
                stations=sample.count,
                earthquakes=sample.earthquakes,
                slope=explained.slope,
                p_value=explained.p_value,
                power=explained.power,
            )


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
