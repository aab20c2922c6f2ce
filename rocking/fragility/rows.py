"""The rows of a study's fragility: responses at every level, curves, what each comes down to, and the hazard."""

import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import numpy as np
from scipy.special import stdtrit

from rocking.assessment.fidelity import peak_velocity
from rocking.assessment.rows.meanings import RECORD, STRUCTURE
from rocking.errors import ConfigurationError
from rocking.fragility.curves import Fragility, IncrementalDynamicAnalysis, explanation
from rocking.fragility.measures import (
    INTENSITY_MEASURES,
    MEASURES_IN_WORDS,
    IntensityMeasure,
)
from rocking.records import Accelerogram
from rocking.structures import Mechanism
from rocking.tables import Row, column, read_rows, read_whole, row

_STEPS = 400
"""Steps of the integral over the hazard curve, in equal parts of the logarithm of the level."""
_LARGEST_HAZARD = 1_000_000
"""Bytes of a hazard curve; fifty points take about one thousand."""
ROTATION_RATIOS = (0.1, 0.3, 0.5, math.inf)
"""Largest rotations over the critical one whose exceedance has a curve; inf: overturning."""
_MEASURE = f"Intensity measure: {MEASURES_IN_WORDS}"


@row("hazard")
class HazardRow(Row):
    """One row per level of the intensity measure, ascending."""

    intensity: float = column("Level, in the unit of the intensity measure")
    annual_rate: float = column("Annual rate of exceedance of the level", unit="1/year")


def read_hazard(path: Path) -> list[HazardRow]:
    """Return the points of a hazard curve from a CSV with the columns intensity and annual_rate.

    Raises ConfigurationError for fewer than two points, levels that do not ascend, or a rate that rises.
    """
    read_whole(path, _LARGEST_HAZARD, ConfigurationError)
    points = list(read_rows(HazardRow, path))
    if len(points) < 2:
        raise ConfigurationError(f"{path} holds {len(points)} points, but must hold at least 2.")
    for before, point in zip([None, *points], points, strict=False):
        at = f"{point.annual_rate:g} a year at {point.intensity:g}"
        if not (point.intensity > 0 and point.annual_rate > 0):
            raise ConfigurationError(f"{path} holds {at}, but both must be above 0.")
        if before and point.intensity <= before.intensity:
            raise ConfigurationError(
                f"{path} holds {point.intensity:g} after {before.intensity:g}, but intensity must ascend; sort it."
            )
        if before and point.annual_rate > before.annual_rate:
            raise ConfigurationError(
                f"{path} says {at}, more than {before.annual_rate:g} at {before.intensity:g}, but annual_rate must "
                "not rise."
            )
    return points


def annual_rate(fragility: Fragility, points: Sequence[HazardRow]) -> dict[str, float]:
    """Return ∫ P dν [1/year] over the hazard curve ν, by column of the summary; both are linear in the logarithm of the
    level between their points.

    The rate is the mean over the stations of the rate of each. Below its levels a station's curve counts as 0, above
    them as its last value, and where it was not tried as the share of the others; beyond the last point of the hazard
    curve all is counted there. The interval is that of `rate_interval`. annual_rate_remainder is the most that the rate
    may lack: because the curve ends below a probability of 1, and because levels below the first point of the hazard
    curve are left out, which occur as often as the hazard curve, continued by its first slope, says.
    """
    levels = np.log(fragility.levels)
    logs, log_rates = np.log([[point.intensity, point.annual_rate] for point in points]).T
    edges = np.linspace(logs[0], logs[-1], _STEPS + 1)
    rates = np.exp(np.interp(edges, logs, log_rates))
    occurring = np.append(rates[:-1] - rates[1:], rates[-1])
    middles = np.append((edges[1:] + edges[:-1]) / 2, edges[-1])

    tried = np.isfinite(fragility.probability)
    pooled = np.interp(levels, levels[tried], fragility.probability[tried])
    curves = _curves_of_stations(fragility, pooled)
    of_stations = np.array([np.interp(middles, levels, each, left=0.0) @ occurring for each in curves])
    rate = float(of_stations.mean())
    low, high = rate_interval(of_stations)

    above = (1 - pooled[-1]) * occurring[middles >= levels[-1]].sum()
    slope = (log_rates[0] - log_rates[1]) / (logs[1] - logs[0])
    lower = np.linspace(min(levels[0], logs[0]), logs[0], _STEPS + 1)
    continued = np.exp(log_rates[0] + slope * (logs[0] - lower))
    below = np.interp((lower[1:] + lower[:-1]) / 2, levels, pooled, left=0.0) @ -np.diff(continued)
    return {
        "annual_rate": rate,
        "annual_rate_low": min(low, rate),
        "annual_rate_high": max(rate, min(high, points[0].annual_rate)),
        "annual_rate_remainder": float(above + below),
    }


def _curves_of_stations(fragility: Fragility, pooled: np.ndarray) -> np.ndarray:
    """The curve of each station, (s, k): the mean of its records, and where none was tried the pooled one (k,)."""
    stations = np.asarray(fragility.stations)
    curves = []
    for name in dict.fromkeys(fragility.stations):
        own = fragility.exceedance[stations == name]
        tried = np.isfinite(own)
        count = tried.sum(axis=0)
        mean = np.where(tried, own, 0.0).sum(axis=0) / np.maximum(count, 1)
        curves.append(np.where(count > 0, mean, pooled))
    return np.array(curves)


def rate_interval(of_stations: np.ndarray) -> tuple[float, float]:
    """Return the 90 % interval of the mean of the rates (s,) of stations.

    Rates scatter by orders of magnitude, as the hazard curve raises a level to a power of 2 to 4. Resampling of 8 to 35
    stations seldom meets the few that make up the mean, and its interval holds the truth in 56 to 92 % only
    (docs/pages/fragility.md). The interval is therefore that of the mean of a lognormal, by Student's law for few
    stations (Cox's method: Zhou & Gao 1997, Confidence intervals for the log-normal mean, Stat. Med. 16, 783-790),
    times the share of the stations that have a rate at all. Where rates are no lognormal, that mean is not theirs; the
    interval therefore also holds that of the mean itself, by Student's law for its logarithm.
    """
    positive = np.log(of_stations[of_stations > 0])
    count = positive.size
    if count < 2:
        return 0.0, math.inf
    share = count / of_stations.size
    variance = float(positive.var(ddof=1))
    middle = math.log(share) + float(positive.mean()) + variance / 2
    error = math.sqrt((1 - share) / count + variance / count + variance**2 / (2 * (count - 1)))
    reach = float(stdtrit(count - 1, 0.95)) * error

    mean = float(of_stations.mean())
    relative_error = float(of_stations.std(ddof=1)) / mean / math.sqrt(of_stations.size)
    own_reach = float(stdtrit(of_stations.size - 1, 0.95)) * relative_error

    low = min(middle - reach, math.log(mean) - own_reach)
    high = max(middle + reach, math.log(mean) + own_reach)
    return math.exp(low), math.exp(min(high, 700.0))


@row("ida")
class IdaRow(Row):
    """One row per structure, record and level: incremental dynamic analysis."""

    structure: str = column(STRUCTURE)
    record: str = column(RECORD)
    station: str = column("Event and station, which count as one independent record")
    intensity_measure: str = column(_MEASURE)
    level: float = column("Level to which the record is scaled")
    scale_factor: float = column("Factor on the record to reach the level")
    members: int = column("Number of members")
    rotation_ratio_median: float = column("Median of largest rotation over critical rotation")
    overturning_share: float = column("Share of the members that overturn")
    governing_overturning_share: float = column("Share of the members that overturn with the worst crack")


@row()
class CurveRow(Row):
    """A row about the curve of a structure: for which crack, intensity measure and rotation it holds."""

    structure: str = column(STRUCTURE)
    governing: bool = column("Whether the worst crack that may form counts, not that of statics")
    intensity_measure: str = column(_MEASURE)
    threshold: float = column("Rotation over critical rotation that is exceeded; INF: overturning")


@row("fragility")
class FragilityRow(CurveRow):
    """One row per structure, rotation that is exceeded and level: the curves with 90 % intervals."""

    level: float = column("Level of the intensity measure")
    stations: int = column("Number of stations whose records reach the level within the largest factor")
    probability: float = column("Share of the stations that exceed the rotation")
    probability_low: float = column("Lower end of the 90 % interval of the probability")
    probability_high: float = column("Upper end of the 90 % interval of the probability")
    lognormal: float = column("Probability by the lognormal curve of maximum likelihood")


@row("fragility_summary")
class FragilitySummaryRow(CurveRow):
    """One row per structure and rotation that is exceeded: what its curve comes down to."""

    records: int = column("Number of records")
    stations: int = column("Number of stations")
    stations_out: int = column(
        "Number of stations that do not reach the highest level within the largest factor"
    )
    largest_scale_factor: float = column("Largest factor on a record that was used")
    median: float = column("Level at which the empirical curve crosses one half; INF: it does not")
    median_low: float = column("Lower end of the 90 % interval of the median, by resampling stations")
    median_high: float = column("Upper end of the 90 % interval of the median; INF: none at the levels tried")
    lognormal_median: float = column("Median of the lognormal curve, for those who need two parameters")
    dispersion: float = column("Standard deviation of the logarithm, lognormal curve")
    misfit: float = column("Largest distance of the lognormal from the empirical curve")
    reversals: int = column("Number of records that, scaled up, let the structure stand again")
    annual_rate: float = column("Annual rate of exceedance; empty without a hazard curve", unit="1/year")
    annual_rate_low: float = column("Lower end of the 90 % interval of the rate, by stations", unit="1/year")
    annual_rate_high: float = column("Upper end of the 90 % interval of the rate, by stations", unit="1/year")
    annual_rate_remainder: float = column("Most that the rate may lack beyond both curves", unit="1/year")


@row("intensity_measures")
class IntensityMeasureRow(Row):
    """One row per structure, intensity measure and other figure of the record: what explains overturning."""

    structure: str = column(STRUCTURE)
    intensity_measure: str = column(_MEASURE)
    efficiency: float = column("Dispersion of the level that overturns: standard deviation of its logarithm")
    figure: str = column("Figure of the record that may say more: PGV/PGA, magnitude or ln of the distance")
    records: int = column("Number of records with the measure and the figure")
    stations: int = column("Number of stations")
    slope: float = column("Change of the logarithm of that level for one standard deviation of the figure")
    p_value: float = column("p-value of no change; below 0.05 the measure does not suffice")
    power: float = column("Share of samples of as many stations that would show such a slope at 5 %")


def ida_rows(
    structure: str, records: Sequence[str], analysis: IncrementalDynamicAnalysis
) -> Iterator[IdaRow]:
    """Yield a row for each record and level that it reaches."""
    worst = analysis.governing_ratios
    for place, (record, station) in enumerate(zip(records, analysis.stations, strict=True)):
        for step, level in enumerate(analysis.levels.tolist()):
            ratios = analysis.rotation_ratios[place, step]
            if np.isnan(ratios).all():
                continue  # the record does not reach the level within the largest factor
            scale_factor = level / float(analysis.intensities[place])
            rotation_ratio_median = float(np.sort(ratios)[(ratios.size - 1) // 2])
            overturning_share = float(np.isinf(ratios).mean())
            governing_overturning_share = math.nan
            if worst is not None:
                governing_overturning_share = float(np.isinf(worst[place, step]).mean())
            yield IdaRow(
                structure=structure,
                record=record,
                station=station,
                intensity_measure=analysis.measure.name,
                level=level,
                scale_factor=scale_factor,
                members=ratios.size,
                rotation_ratio_median=rotation_ratio_median,
                overturning_share=overturning_share,
                governing_overturning_share=governing_overturning_share,
            )


def fragility_rows(structure: str, curve: Fragility, governing: bool) -> Iterator[FragilityRow]:
    """Yield a row for each level. governing: whether it is the curve with the worst of the cracks that may form."""
    tried = np.isfinite(curve.exceedance)
    for place, level in enumerate(curve.levels.tolist()):
        reaching = {name for name, each in zip(curve.stations, tried[:, place], strict=True) if each}
        yield FragilityRow(
            structure=structure,
            governing=governing,
            intensity_measure=curve.measure,
            threshold=curve.threshold,
            level=level,
            stations=len(reaching),
            probability=float(curve.probability[place]),
            probability_low=float(curve.probability_low[place]),
            probability_high=float(curve.probability_high[place]),
            lognormal=float(curve.lognormal[place]),
        )


def fragility_summary_row(
    structure: str, curve: Fragility, governing: bool, hazard: Sequence[HazardRow] | None
) -> FragilitySummaryRow:
    """Return what a curve comes down to. hazard: of its intensity measure."""
    rates = annual_rate(curve, hazard) if hazard else {}
    records = len(curve.stations)  # the station of each is named
    at_the_top = np.isfinite(curve.exceedance[:, -1])
    reaching = {name for name, each in zip(curve.stations, at_the_top, strict=True) if each}
    stations_out = curve.independent - len(reaching)
    median_low, median_high = curve.interval
    reversals = int((curve.reversals > 0).sum())
    largest = math.nan
    if curve.analysis is not None:
        factors = curve.levels / curve.analysis.intensities[:, None]
        largest = float(factors[np.isfinite(curve.exceedance)].max())
    return FragilitySummaryRow(
        structure=structure,
        governing=governing,
        intensity_measure=curve.measure,
        threshold=curve.threshold,
        records=records,
        stations=curve.independent,
        stations_out=stations_out,
        largest_scale_factor=largest,
        median=curve.median,
        median_low=median_low,
        median_high=median_high,
        lognormal_median=curve.lognormal_median,
        dispersion=curve.dispersion,
        misfit=curve.misfit,
        reversals=reversals,
        annual_rate=rates.get("annual_rate", math.nan),
        annual_rate_low=rates.get("annual_rate_low", math.nan),
        annual_rate_high=rates.get("annual_rate_high", math.nan),
        annual_rate_remainder=rates.get("annual_rate_remainder", math.nan),
    )


def intensity_measure_rows(
    structure: str,
    mechanism: Mechanism,
    records: Sequence[Accelerogram],
    analysis: IncrementalDynamicAnalysis,
) -> Iterator[IntensityMeasureRow]:
    """Yield how well each measure explains which records overturn the structure at which level."""
    factors = np.log(analysis.levels) - np.log(analysis.intensities)[:, None]
    ratios = analysis.rotation_ratios
    falls = np.where(np.isnan(ratios), np.nan, np.isinf(ratios)).mean(axis=2)
    for measure in INTENSITY_MEASURES.values():
        logs = np.log([_or_nan(measure, record, mechanism) for record in records])
        for figure, values in _figures(records).items():
            both = np.isfinite(logs) & np.isfinite(values)
            stations = np.array(analysis.stations)[both].tolist()
            records_with_both = len(stations)
            if len(set(stations)) < 2:
                continue
            levels = logs[both, None] + factors[both]
            explained = explanation(levels, falls[both], values[both], stations)
            yield IntensityMeasureRow(
                structure=structure,
                intensity_measure=measure.name,
                efficiency=explained["efficiency"],
                figure=figure,
                records=records_with_both,
                stations=len(set(stations)),
                slope=explained.get("slope", math.nan),
                p_value=explained.get("p_value", math.nan),
                power=explained.get("power", math.nan),
            )


def _figures(records: Sequence[Accelerogram]) -> dict[str, np.ndarray]:
    """Figures of each record that the level of overturning may depend on beside its intensity; nan where unknown."""
    return {
        "PGV/PGA": np.log([peak_velocity(each) / each.peak_acceleration for each in records]),
        "magnitude": np.array([each.magnitude for each in records], dtype=float),
        "ln distance": np.log([each.epicentral_distance or math.nan for each in records]),
    }


def _or_nan(measure: IntensityMeasure, record: Accelerogram, mechanism: Mechanism) -> float:
    try:
        return measure.of(record, mechanism)
    except ConfigurationError:
        return math.nan


FRAGILITY_TABLES: Mapping[str, type[Row]] = {
    each.table.name: each for each in (IdaRow, FragilityRow, FragilitySummaryRow, IntensityMeasureRow)
}
"""The tables of the fragility of a study, by name."""
