"""Rows about fragility: the responses at every level, the curves, and what each comes down to."""

import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import compress

import numpy as np

from rocking.assessment.fragility import (
    INTENSITY_MEASURES,
    Fragility,
    IncrementalDynamicAnalysis,
    IntensityMeasure,
)
from rocking.assessment.fragility.curve import CURVES
from rocking.assessment.fragility.hazard import HazardRow, annual_rate
from rocking.assessment.fragility.sufficiency import sufficiency
from rocking.assessment.rows import meanings
from rocking.errors import ConfigurationError
from rocking.records import Accelerogram
from rocking.records.measures import record_measures
from rocking.structures import Mechanism
from rocking.tables import Row, column, row

ROTATION_RATIOS = (0.1, 0.3, 0.5, math.inf)
"""Largest rotations over the critical one whose exceedance has a curve; inf: overturning."""
_THRESHOLD = "Rotation over critical rotation that is exceeded; INF: overturning"
_MEASURE = "Intensity measure: pga [g], pgv [m/s], p_pgv [-], pulse [-] or sa1 [g]"


@row("ida", "One row per structure, record and level: incremental dynamic analysis")
class IdaRow(Row):
    """One record at one level."""

    structure: str = column(meanings.STRUCTURE)
    record: str = column(meanings.RECORD)
    station: str = column("Event and station; what counts as one independent record")
    intensity_measure: str = column(_MEASURE)
    level: float = column("Level to which the record is scaled")
    scale_factor: float = column("What the record is multiplied by to reach it")
    members: int = column("Members that were followed")
    rotation_ratio: float = column("Median of their largest rotation over critical rotation; INF overturns")
    overturning_probability: float = column("Share of them that overturn")


@row(
    "fragility", "One row per structure, rotation that is exceeded and level: the curves with 90 % intervals"
)
class FragilityRow(Row):
    """One point of one curve."""

    structure: str = column(meanings.STRUCTURE)
    intensity_measure: str = column(_MEASURE)
    rotation_ratio: float = column(_THRESHOLD)
    level: float = column("Level of the intensity measure")
    probability: float = column("Share of the records that exceed the rotation")
    probability_low: float = column("Lower end of its 90 % interval, by stations")
    probability_high: float = column("Upper end of its 90 % interval, by stations")
    lognormal: float = column("Lognormal curve fitted by maximum likelihood")
    lognormal_low: float = column("Lower end of its 90 % interval, by resampling stations")
    lognormal_high: float = column("Upper end of its 90 % interval, by resampling stations")


@row("fragility_summary", "One row per structure and rotation that is exceeded: what its curve comes down to")
class FragilitySummaryRow(Row):
    """One curve."""

    structure: str = column(meanings.STRUCTURE)
    intensity_measure: str = column(_MEASURE)
    rotation_ratio: float = column(_THRESHOLD)
    records: int = column("Records behind it")
    stations: int = column("Stations behind it")
    mechanism_runs: int | None = column(
        "Cases of the multi-fidelity sample that the mechanism was followed in; empty where it was in every case"
    )
    median: float = column("Level that half of the records exceed it at, of the lognormal where it holds")
    median_low: float = column("Lower end of the 90 % interval of the median")
    median_high: float = column("Upper end of the 90 % interval of the median")
    dispersion: float = column("Of the lognormal: standard deviation of the logarithm")
    misfit: float = column("Largest distance of the lognormal from the empirical curve")
    lognormal_holds: bool = column(
        "Whether chance would take them so far apart; else use the empirical curve"
    )
    reversals: int = column("Records that, scaled up, let stand again what they had overturned")
    annual_rate: float = column("Of exceedance, with the hazard curve; empty without one", unit="1/year")
    annual_rate_low: float = column("From the lower ends of the curve's interval", unit="1/year")
    annual_rate_high: float = column("From the upper ends of the curve's interval", unit="1/year")


@row(
    "intensity_measures",
    "One row per structure and intensity measure: which of them explains overturning most",
)
class IntensityMeasureRow(Row):
    """One measure."""

    structure: str = column(meanings.STRUCTURE)
    intensity_measure: str = column(_MEASURE)
    records: int = column("Records that have the measure and overturn it at some level")
    efficiency: float = column(
        "Standard deviation of the logarithm of the level that first overturns; less is better"
    )
    sufficiency: float = column(
        "p-value, by stations, of a dependence of that level on PGV/PGA; below 0.05 it does not suffice"
    )


def ida_rows(structure: str, records: Sequence[str], found: IncrementalDynamicAnalysis) -> Iterator[IdaRow]:
    """Yield a row for each record and level that was followed."""
    for name, station, intensity, by_level in zip(
        records, found.stations, found.intensities, found.rotation_ratios, strict=True
    ):
        for level, ratios in zip(found.levels.tolist(), by_level, strict=True):
            if np.isnan(ratios).all():
                continue
            yield IdaRow(
                structure=structure,
                record=name,
                station=station,
                intensity_measure=found.measure.name,
                level=level,
                scale_factor=level / float(intensity),
                members=ratios.size,
                rotation_ratio=float(np.sort(ratios)[(ratios.size - 1) // 2]),
                overturning_probability=float(np.isinf(ratios).mean()),
            )


def fragility_rows(structure: str, curve: Fragility) -> Iterator[FragilityRow]:
    """Yield a row for each level."""
    for place, level in enumerate(curve.levels.tolist()):
        yield FragilityRow(
            structure=structure,
            intensity_measure=curve.measure,
            rotation_ratio=curve.threshold,
            level=level,
            **{name: float(getattr(curve, name)[place]) for name in CURVES},
        )


def fragility_summary_row(
    structure: str, curve: Fragility, hazard: Sequence[HazardRow] | None
) -> FragilitySummaryRow:
    """Return what the curve comes down to. hazard: in the unit of its measure."""
    rate = annual_rate(curve, hazard) if hazard else None
    return FragilitySummaryRow(
        structure=structure,
        intensity_measure=curve.measure,
        rotation_ratio=curve.threshold,
        records=len(curve.stations),
        stations=curve.independent,
        mechanism_runs=curve.mechanism_runs,
        median=curve.median,
        median_low=curve.interval[0],
        median_high=curve.interval[1],
        dispersion=curve.dispersion,
        misfit=curve.misfit,
        lognormal_holds=curve.lognormal_holds,
        reversals=int((curve.reversals > 0).sum()),
        annual_rate=rate.rate if rate else math.nan,
        annual_rate_low=rate.low if rate else math.nan,
        annual_rate_high=rate.high if rate else math.nan,
    )


def intensity_measure_rows(
    structure: str, mechanism: Mechanism, records: Sequence[Accelerogram], found: IncrementalDynamicAnalysis
) -> Iterator[IntensityMeasureRow]:
    """Yield how well each measure orders the records, by the scale at which each first overturns the structure."""
    factors = _first_overturning(found)
    shapes = np.log([_velocity_over_acceleration(record) for record in records])
    for measure in INTENSITY_MEASURES.values():
        capacities = np.log([_or_nan(measure, record, mechanism) for record in records] * factors)
        known = np.isfinite(capacities)
        yield IntensityMeasureRow(
            structure=structure,
            intensity_measure=measure.name,
            records=int(known.sum()),
            efficiency=float(capacities[known].std(ddof=1)) if known.sum() > 1 else math.nan,
            sufficiency=sufficiency(shapes[known], capacities[known], list(compress(found.stations, known))),
        )


def _or_nan(measure: IntensityMeasure, record: Accelerogram, mechanism: Mechanism) -> float:
    try:
        return measure.of(record, mechanism)
    except ConfigurationError:
        return math.nan


def _first_overturning(found: IncrementalDynamicAnalysis) -> np.ndarray:
    """Scale factor at which more than half of the members first overturn, (r,); nan where they never do."""
    falls = np.isinf(found.rotation_ratios).mean(axis=2) > 0.5
    first = np.where(falls.any(axis=1), found.levels[falls.argmax(axis=1)], np.nan)
    return np.asarray(first / found.intensities)


def _velocity_over_acceleration(record: Accelerogram) -> float:
    measures = record_measures(record)
    return measures.peak_velocity / measures.peak_acceleration


FRAGILITY_TABLES: Mapping[str, type[Row]] = {
    each.table.name: each for each in (IdaRow, FragilityRow, FragilitySummaryRow, IntensityMeasureRow)
}
"""The tables of the fragility of a study, by name."""
