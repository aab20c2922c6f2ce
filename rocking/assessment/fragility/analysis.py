"""Fragility from records: scaled to common levels (incremental dynamic analysis), or left as recorded (cloud)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility.cases import Cases
from rocking.assessment.fragility.curve import Fragility, fragility_of
from rocking.assessment.fragility.intensity import IntensityMeasure
from rocking.assessment.fragility.intensity import intensity_measure as measure_named
from rocking.errors import ConfigurationError
from rocking.motion.integration import Rocking, reduce
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock, Mechanism


@dataclass(frozen=True, eq=False, repr=False)
class IncrementalDynamicAnalysis:
    """The largest rotations of one mechanism under records at levels of an intensity measure.

    measure: of the levels. levels: (k,) ascending. rotation_ratios: (r, k, m) of every record, level and member;
    inf overturns, nan where a cloud holds no such case. intensities: (r,) of the records as they are.
    stations: (r,) what counts as one independent record.
    """

    measure: IntensityMeasure
    levels: np.ndarray
    rotation_ratios: np.ndarray
    intensities: np.ndarray
    stations: tuple[str, ...]

    def __repr__(self) -> str:
        records, levels, members = self.rotation_ratios.shape
        shape = f"{records} records at {levels} levels of {self.measure.name}, {members} members each"
        return f"<IncrementalDynamicAnalysis: {shape}>"

    def fragility(self, threshold: float = np.inf) -> Fragility:
        """Return the curve of exceeding a rotation ratio; inf: of overturning."""
        known = np.isfinite(self.rotation_ratios) | np.isinf(self.rotation_ratios)
        ratios = np.where(known, self.rotation_ratios, 0.0)
        above = np.isinf(ratios) if np.isinf(threshold) else ratios > threshold
        return fragility_of(
            self.levels,
            above.mean(axis=2),
            self.stations,
            tried=known.all(axis=2).astype(float),
            measure=self.measure.name,
            unit=self.measure.unit,
            threshold=threshold,
        )


def incremental_dynamic_analysis(
    records: Sequence[Accelerogram],
    structure: Rocking,
    *,
    intensity_measure: str = "pga",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    method: Literal["scaling", "cloud"] = "scaling",
    ensemble: EnsembleSettings | None = None,
    tolerance: float = 1e-6,
) -> IncrementalDynamicAnalysis:
    """Follow `structure` through `records` at levels of an intensity measure.

    intensity_measure: a name of INTENSITY_MEASURES. method: scaling takes every record to every level; cloud leaves it
    as recorded, and the levels are then those of the records. levels: ascending, in the unit of the measure; by default
    40 that lie where the probability of overturning moves. stations: what counts as one independent record, by default
    event and station. ensemble: what is not known of a case, which then has MEMBERS members instead of itself.
    Raises ConfigurationError for fewer than two stations, levels out of order, a measure that a record lacks, or a
    record that cannot be followed.
    """
    if method == "cloud" and levels is not None:
        raise ConfigurationError("levels are given, but a cloud has those of its records; leave them out.")
    mechanism, measure, intensities, names = measured(records, structure, intensity_measure, stations)
    cases = Cases(records, mechanism, intensities, ensemble, tolerance)
    chosen, ratios = cases.cloud() if method == "cloud" else cases.at(levels)
    return IncrementalDynamicAnalysis(measure, chosen, ratios, intensities, names)


def measured(
    records: Sequence[Accelerogram],
    structure: Rocking,
    intensity_measure: str,
    stations: Sequence[str] | None,
) -> tuple[Mechanism, IntensityMeasure, np.ndarray, tuple[str, ...]]:
    """Return the mechanism, the measure of that name, that of each record (r,), and the stations (r,).

    Raises ConfigurationError as `incremental_dynamic_analysis` does.
    """
    mechanism = reduce(structure)
    if isinstance(mechanism, EquivalentBlock):
        raise ConfigurationError("structure is an equivalent block, but must be a structure or a mechanism.")
    measure, names = measure_named(intensity_measure), _checked_stations(records, stations)
    return mechanism, measure, np.array([measure.of(record, mechanism) for record in records]), names


def _checked_stations(records: Sequence[Accelerogram], stations: Sequence[str] | None) -> tuple[str, ...]:
    """The stations, those of the records by default. Raises ConfigurationError for fewer than two."""
    if stations is None:
        stations = [
            f"{record.event}; {record.station}" if record.event or record.station else f"record {place}"
            for place, record in enumerate(records)
        ]
    if len(stations) != len(records):
        raise ConfigurationError(
            f"stations names {len(stations)}, but must name one for each of {len(records)} records."
        )
    if len(set(stations)) < 2:
        raise ConfigurationError(
            f"the records come from {len(set(stations))} station, but a fragility needs at least 2; add records."
        )
    return tuple(map(str, stations))
