"""Fragility from records: scaled to common levels (incremental dynamic analysis), or left as recorded (cloud)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, drawn
from rocking.assessment.ensemble.design import lattice
from rocking.assessment.fragility.curve import Fragility, fragility_of
from rocking.assessment.fragility.intensity import IntensityMeasure
from rocking.assessment.fragility.intensity import intensity_measure as measure_named
from rocking.errors import ConfigurationError
from rocking.motion.batch import integrate_batch
from rocking.motion.integration import Rocking, reduce
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock, Mechanism

COARSE, FINE = 20, 20
"""Levels spread evenly over the range of the curve, and levels put where it moves."""
LARGEST_UPLIFT = 64.0
"""Times the uplift acceleration to which records are scaled in search of the level at which all overturn."""
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


def fragility(
    records: Sequence[Accelerogram],
    structure: Rocking,
    *,
    intensity_measure: str = "pga",
    levels: Sequence[float] | np.ndarray | None = None,
    stations: Sequence[str] | None = None,
    threshold: float = np.inf,
    method: Literal["scaling", "cloud"] = "scaling",
    ensemble: EnsembleSettings | None = None,
    tolerance: float = 1e-6,
) -> Fragility:
    """Return the fragility of `structure` under `records`: the curve above `threshold` of their incremental analysis.

    threshold: rotation ratio that is exceeded; inf: overturning. What else it takes, and the errors that it raises, are
    those of `incremental_dynamic_analysis`.
    """
    found = incremental_dynamic_analysis(
        records,
        structure,
        intensity_measure=intensity_measure,
        levels=levels,
        stations=stations,
        method=method,
        ensemble=ensemble,
        tolerance=tolerance,
    )
    return found.fragility(threshold)


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
    mechanism = reduce(structure)
    if isinstance(mechanism, EquivalentBlock):
        raise ConfigurationError("structure is an equivalent block, but must be a structure or a mechanism.")
    measure, names = measure_named(intensity_measure), _stations(records, stations)
    intensities = np.array([measure.of(record, mechanism) for record in records])
    cases = _Cases(records, mechanism, intensities, ensemble, tolerance)
    if method == "cloud":
        if levels is not None:
            raise ConfigurationError(
                "levels are given, but a cloud has those of its records; leave them out."
            )
        chosen, ratios = cases.cloud()
    elif levels is not None:
        chosen = _checked(levels)
        ratios = cases.at_levels(chosen)
    else:
        chosen, ratios = cases.at_adapted_levels()
    return IncrementalDynamicAnalysis(measure, chosen, ratios, intensities, tuple(names))


class _Cases:
    """One mechanism under each record at any scale."""

    def __init__(
        self,
        records: Sequence[Accelerogram],
        mechanism: Mechanism,
        intensities: np.ndarray,
        ensemble: EnsembleSettings | None,
        tolerance: float,
    ) -> None:
        self.records, self.mechanism, self.intensities = records, mechanism, intensities
        self.ensemble, self.tolerance = ensemble, tolerance

    def cloud(self) -> tuple[np.ndarray, np.ndarray]:
        """The levels of the records, and (r, r, m) with each record at its own level alone."""
        order = np.argsort(self.intensities, kind="stable")
        alone = np.array([self._ratios(k, np.ones(1))[0] for k in range(order.size)])
        ratios = np.full((order.size, *alone.shape), np.nan)
        ratios[order, np.arange(order.size)] = alone[order]
        # Equal intensities are moved apart by rounding size, so that each stays a level of its own.
        return self.intensities[order] * (1 + 1e-12 * np.arange(order.size)), ratios

    def at_levels(self, levels: np.ndarray) -> np.ndarray:
        """(r, k, m) for every record scaled to every level. Raises ConfigurationError where one cannot be followed."""
        found = np.array([self._ratios(k, levels / im) for k, im in enumerate(self.intensities)])
        failed = np.flatnonzero(np.isnan(found).any(axis=(1, 2)))
        if failed.size:
            record = self.records[int(failed[0])]
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} cannot be followed at every level; leave it out."
            )
        return found

    def at_adapted_levels(self) -> tuple[np.ndarray, np.ndarray]:
        """Levels spread from the first uplift to where all overturn, then as many more where the share moves."""
        coarse = self._coarse_levels()
        ratios = self.at_levels(coarse)
        between = _where_it_moves(coarse, np.isinf(ratios).mean(axis=(0, 2)))
        levels, both = np.concatenate([coarse, between]), np.hstack([ratios, self.at_levels(between)])
        order = np.argsort(levels)
        return levels[order], both[:, order]

    def _coarse_levels(self) -> np.ndarray:
        peaks = np.array([record.peak_acceleration for record in self.records])
        uplift = self.intensities * self.mechanism.uplift_multiplier * GRAVITY / peaks
        lowest, highest = float(uplift.min()), float(uplift.min())
        while highest < LARGEST_UPLIFT * uplift.max():
            highest *= 1.5
            if np.isinf(self.at_levels(np.array([highest]))).all():
                break
        return np.geomspace(lowest, highest, COARSE)

    def _ratios(self, record: int, factors: np.ndarray) -> np.ndarray:
        """(k, m) at each scale factor."""
        motion = self.records[record]
        if self.ensemble is None:
            return integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance)[0][:, None]
        members = []
        for factor in factors:
            motions = GroundMotions.of(motion.scaled(float(factor)))
            found = drawn(
                self.mechanism, motions, lattice(MEMBERS, CAUSES), self.ensemble, tolerance=self.tolerance
            )
            members.append(found.rotation_ratios)
        return np.array(members)


def _where_it_moves(levels: np.ndarray, share: np.ndarray) -> np.ndarray:
    """FINE levels at equal steps of how far the curve has moved, up or down."""
    moved = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(share)) + 1e-3)])
    places = (np.arange(FINE) + 0.5) / FINE * moved[-1]
    return np.asarray(np.exp(np.interp(places, moved, np.log(levels))))


def _stations(records: Sequence[Accelerogram], stations: Sequence[str] | None) -> list[str]:
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
    return [str(name) for name in stations]


def _checked(levels: Sequence[float] | np.ndarray) -> np.ndarray:
    array = np.asarray(levels, dtype=float)
    if array.ndim != 1 or array.size < 2 or not np.all(np.isfinite(array)) or not np.all(array > 0):
        raise ConfigurationError("levels must be at least two finite numbers greater than 0.")
    if np.any(np.diff(array) <= 0):
        place = int(np.flatnonzero(np.diff(array) <= 0)[0])
        raise ConfigurationError(
            f"levels hold {array[place + 1]:g} after {array[place]:g}, but must ascend; sort them."
        )
    return array
