"""Fragility from records: scaled to common levels (incremental dynamic analysis), or left as recorded (cloud)."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from rocking.assessment.ensemble import EnsembleSettings, GroundMotions, drawn, lattice
from rocking.assessment.fragility.curve import Fragility, fragility_of
from rocking.assessment.intensity import INTENSITY_MEASURES, IntensityMeasure, per_velocity
from rocking.assessment.intensity import intensity_measure as measure_named
from rocking.assessment.variations import cracks
from rocking.errors import ConfigurationError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import Rocking, reduce
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock, Mechanism, Structure

LEVELS, COARSE, MOST_SPREAD = 40, 20, 30
"""Levels in all; those spread evenly over the range of the curve, at first and where it reaches farther. The others are
put where it moves."""
SEVERE = 3.0
"""p PGV/(gλ) from which nearly every structure overturns under nearly every record."""
NEARLY_ALL = 0.95
"""Share that overturns at the highest level."""
MEMBERS = 16
"""Of each ensemble, where a case is not taken as it is."""


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
    intensity_measure: str = "pgv",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    method: Literal["scaling", "cloud"] = "scaling",
    ensemble: EnsembleSettings | None = None,
    over_cracks: bool = False,
    tolerance: float = 1e-6,
) -> IncrementalDynamicAnalysis:
    """Follow `structure` through `records` at levels of an intensity measure.

    intensity_measure: a name of INTENSITY_MEASURES. method: scaling takes every record to every level; cloud leaves it
    as recorded, and the levels are then those of the records. levels: ascending, in the unit of the measure; by default
    40 that lie where the probability of overturning moves. stations: what counts as one independent record, by default
    event and station. ensemble: what is not known of a case, which then has MEMBERS members instead of itself.
    over_cracks: whether each member counts with the worst of the cracks that may form, instead of with the one that
    statics chooses.
    Raises ConfigurationError for fewer than two stations, levels out of order, a measure that a record lacks, or a
    record that cannot be followed.
    """
    if method == "cloud" and levels is not None:
        raise ConfigurationError("levels are given, but a cloud has those of its records; leave them out.")
    (mechanism, *others), measure, intensities, names = _measured(
        records, structure, intensity_measure, stations
    )
    cases = _Cases(records, mechanism, intensities, ensemble, tolerance)
    chosen, ratios = cases.cloud() if method == "cloud" else cases.at(levels)
    for other in others if over_cracks else ():
        cracked = replace(cases, mechanism=other)
        more = cracked.cloud()[1] if method == "cloud" else cracked.at_levels(chosen)
        ratios = np.maximum(ratios, more)
    return IncrementalDynamicAnalysis(measure, chosen, ratios, intensities, names)


def fragility(
    records: Sequence[Accelerogram],
    structure: Rocking,
    *,
    intensity_measure: str = "pgv",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    threshold: float = np.inf,
    method: Literal["scaling", "cloud"] = "scaling",
    ensemble: EnsembleSettings | None = None,
    over_cracks: bool = False,
    tolerance: float = 1e-6,
) -> Fragility:
    """Return the fragility of `structure` under `records`: of the mechanism that statics chooses where cracks may form.

    threshold: rotation ratio that is exceeded; inf: overturning. What else it takes, and the errors that it raises, are
    those of `incremental_dynamic_analysis`.

    >>> pulses = [rocking.Pulse(1.0, frequency, 0.5) for frequency in (4.0, 6.0, 9.0)]
    >>> times = np.arange(400) * 0.01
    >>> records = [rocking.Accelerogram(pulse.acceleration(times), 0.01) for pulse in pulses]
    >>> rocking.fragility(records, rocking.Block(2.0, 0.2), levels=[0.2, 0.4, 0.8, 1.6]).probability.tolist()
    [0.0, 0.0, 0.0, 1.0]
    """
    found = incremental_dynamic_analysis(
        records,
        structure,
        intensity_measure=intensity_measure,
        levels=levels,
        stations=stations,
        method=method,
        ensemble=ensemble,
        over_cracks=over_cracks,
        tolerance=tolerance,
    )
    return found.fragility(threshold)


def _measured(
    records: Sequence[Accelerogram],
    structure: Rocking,
    intensity_measure: str,
    stations: Sequence[str] | None,
) -> tuple[list[Mechanism], IntensityMeasure, np.ndarray, tuple[str, ...]]:
    """Return the mechanisms that may form, that of statics first, the measure of that name, that of each record (r,),
    and the stations (r,).

    Raises ConfigurationError as `incremental_dynamic_analysis` does.
    """
    reduced = reduce(structure)
    if isinstance(reduced, EquivalentBlock):
        raise ConfigurationError("structure is an equivalent block, but must be a structure or a mechanism.")
    measure, names = measure_named(intensity_measure), _checked_stations(records, stations)
    may_form = cracks(structure) if isinstance(structure, Structure) else (("", reduced),)
    mechanisms = [mechanism for _, mechanism in may_form]
    return mechanisms, measure, np.array([measure.of(record, mechanisms[0]) for record in records]), names


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


@dataclass(frozen=True, eq=False)
class _Cases:
    """One mechanism under each record at any scale. intensities: (r,) of the records as they are."""

    records: Sequence[Accelerogram]
    mechanism: Mechanism
    intensities: np.ndarray
    ensemble: EnsembleSettings | None
    tolerance: float

    def cloud(self) -> tuple[np.ndarray, np.ndarray]:
        """The levels of the records, and (r, r, m) with each record at its own level alone."""
        order = np.argsort(self.intensities, kind="stable")
        alone = np.array([self._ratios(k, np.ones(1))[0] for k in range(order.size)])
        ratios = np.full((order.size, *alone.shape), np.nan)
        ratios[order, np.arange(order.size)] = alone[order]
        # Equal intensities are moved apart by rounding size, so that each stays a level of its own.
        return self.intensities[order] * (1 + 1e-12 * np.arange(order.size)), ratios

    def at(self, levels: Sequence[float] | np.ndarray | None) -> tuple[np.ndarray, np.ndarray]:
        """Return levels (k,), those that adapt if none are given, and (r, k, m) there. Raises ConfigurationError."""
        if levels is None:
            return self._at_adapted_levels()
        checked = _checked_levels(levels)
        return checked, self.at_levels(checked)

    def at_levels(self, levels: np.ndarray) -> np.ndarray:
        """(r, k, m) for every record scaled to every level. Raises ConfigurationError where one cannot be followed."""

        def follow(record: int) -> np.ndarray:
            return self.followed(record, self._ratios(record, levels / self.intensities[record]))

        with ThreadPoolExecutor(os.cpu_count() or 1) as pool:
            return np.array(list(pool.map(follow, range(len(self.records)))))

    def followed(self, record: int, ratios: np.ndarray) -> np.ndarray:
        """The ratios of a record. Raises ConfigurationError where one of them is nan."""
        if np.isnan(ratios).any():
            source = self.records[record]
            raise ConfigurationError(
                f"{source.source.path or source.station or 'a record'} cannot be followed at every level; leave it out."
            )
        return ratios

    def _at_adapted_levels(self) -> tuple[np.ndarray, np.ndarray]:
        """LEVELS: spread from the first uplift to where nearly all overturn, and the rest where the share moves."""
        levels, ratios = self._spread_levels()
        between = _where_it_moves(levels, np.isinf(ratios).mean(axis=(0, 2)), LEVELS - levels.size)
        levels, ratios = np.concatenate([levels, between]), np.hstack([ratios, self.at_levels(between)])
        order = np.argsort(levels)
        return levels[order], ratios[:, order]

    def _spread_levels(self) -> tuple[np.ndarray, np.ndarray]:
        peaks = np.array([record.peak_acceleration for record in self.records])
        uplift = self.intensities * self.mechanism.uplift_multiplier * GRAVITY / peaks
        lowest = float(uplift.min())
        levels = np.geomspace(lowest, max(float(self._likely_overturning().max()), 2 * lowest), COARSE)
        ratios = self.at_levels(levels)
        while np.isinf(ratios[:, -1]).mean() < NEARLY_ALL and levels.size < MOST_SPREAD:
            more = levels[-1] * np.array([1.5, 2.25])
            levels, ratios = np.concatenate([levels, more]), np.hstack([ratios, self.at_levels(more)])
        return levels, ratios

    def _likely_overturning(self) -> np.ndarray:
        """(r,) level at which p PGV/(gλ) reaches SEVERE, up to which levels are spread at first."""
        block = self.mechanism.equivalent_block("rest")
        velocities = np.array([INTENSITY_MEASURES["pgv"].of_record(record) for record in self.records])
        return np.asarray(self.intensities * SEVERE / (per_velocity(block) * velocities))

    def _ratios(self, record: int, factors: np.ndarray) -> np.ndarray:
        """(k, m) at each scale factor."""
        if self.ensemble is None:
            motion = self.records[record]
            found = integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance, workers=1)
            return found[0][:, None]
        points = lattice(MEMBERS)
        return np.array([self._drawn(self.ensemble, record, factor, points) for factor in factors])

    def _drawn(
        self, ensemble: EnsembleSettings, record: int, factor: float, points: np.ndarray
    ) -> np.ndarray:
        motions = GroundMotions.of(self.records[record].scaled(float(factor)))
        return drawn(self.mechanism, motions, points, ensemble, tolerance=self.tolerance).rotation_ratios


def _where_it_moves(levels: np.ndarray, share: np.ndarray, count: int) -> np.ndarray:
    """`count` levels at equal steps of how far the curve has moved, up or down."""
    moved = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(share)) + 1e-3)])
    places = (np.arange(count) + 0.5) / count * moved[-1]
    return np.asarray(np.exp(np.interp(places, moved, np.log(levels))))


def _checked_levels(levels: Sequence[float] | np.ndarray) -> np.ndarray:
    """The levels as an array. Raises ConfigurationError unless they ascend and are greater than 0."""
    array = np.asarray(levels, dtype=float)
    if array.ndim != 1 or array.size < 2 or not np.all(np.isfinite(array)) or not np.all(array > 0):
        raise ConfigurationError("levels must be at least two finite numbers greater than 0.")
    if np.any(np.diff(array) <= 0):
        place = int(np.flatnonzero(np.diff(array) <= 0)[0])
        raise ConfigurationError(
            f"levels hold {array[place + 1]:g} after {array[place]:g}, but must ascend; sort them."
        )
    return array
