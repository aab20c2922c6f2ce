"""Fragility from records: scaled to common levels (incremental dynamic analysis), or left as recorded (cloud)."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from rocking.assessment.design import lattice
from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, drawn
from rocking.assessment.fragility.curve import Fragility, fragility_of
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
    """Return the fragility of `structure` under `records`.

    intensity_measure: a name of INTENSITY_MEASURES. method: scaling takes every record to every level; cloud leaves it
    as recorded, and the levels are then those of the records. levels: ascending, in the unit of the measure; by default
    40 that lie where the curve moves. stations: what counts as one independent record, by default event and station.
    threshold: rotation ratio that is exceeded; inf: overturning. ensemble: what is not known of a case, whose share of
    MEMBERS members then counts instead of a 0 or a 1.
    Raises ConfigurationError for fewer than two stations, levels out of order, or a measure that a record lacks.
    """
    reduced = reduce(structure)
    measure, names = measure_named(intensity_measure), _stations(records, stations)
    mechanism = structure if isinstance(structure, Mechanism) else reduced
    if isinstance(mechanism, EquivalentBlock):
        raise ConfigurationError("structure is an equivalent block, but must be a structure or a mechanism.")
    intensities = np.array([measure.of(record, mechanism) for record in records])
    cases = _Cases(records, mechanism, threshold, ensemble, tolerance)
    said = {"measure": measure.name, "unit": measure.unit, "threshold": threshold}
    if method == "cloud":
        if levels is not None:
            raise ConfigurationError(
                "levels are given, but a cloud has those of its records; leave them out."
            )
        order = np.argsort(intensities, kind="stable")
        found = np.array([cases.exceedance(int(k), np.ones(1))[0] for k in order])
        chosen, tried = _distinct(intensities[order]), np.eye(order.size)
        return fragility_of(chosen, np.diag(found), [names[k] for k in order], tried=tried, **said)  # type: ignore[arg-type]
    chosen = _checked(levels) if levels is not None else cases.coarse_levels(intensities)
    exceedance = cases.at_levels(chosen, intensities)
    if levels is None:
        between = _where_it_moves(chosen, exceedance.mean(axis=0))
        exceedance = np.hstack([exceedance, cases.at_levels(between, intensities)])
        order = np.argsort(np.concatenate([chosen, between]))
        chosen, exceedance = np.concatenate([chosen, between])[order], exceedance[:, order]
    return fragility_of(chosen, exceedance, names, **said)  # type: ignore[arg-type]


class _Cases:
    """One mechanism under each record at any scale."""

    def __init__(
        self,
        records: Sequence[Accelerogram],
        mechanism: Mechanism,
        threshold: float,
        ensemble: EnsembleSettings | None,
        tolerance: float,
    ) -> None:
        self.records, self.mechanism, self.threshold = records, mechanism, threshold
        self.ensemble, self.tolerance = ensemble, tolerance

    def exceedance(self, record: int, factors: np.ndarray) -> np.ndarray:
        """Share of the members that exceed the threshold at each scale factor, (k,); nan where none can be followed."""
        motion = self.records[record]
        if self.ensemble is None:
            ratios = integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance)[0]
            return _exceeds(ratios, self.threshold)
        points = lattice(MEMBERS, CAUSES)
        shares = []
        for factor in factors:
            motions = GroundMotions.of(motion.scaled(float(factor)))
            members = drawn(self.mechanism, motions, points, self.ensemble, tolerance=self.tolerance)
            shares.append(float(np.nanmean(_exceeds(members.rotation_ratios, self.threshold))))
        return np.array(shares)

    def at_levels(self, levels: np.ndarray, intensities: np.ndarray) -> np.ndarray:
        """(r, k) for every record scaled to every level. Raises ConfigurationError where one cannot be followed."""
        found = np.array([self.exceedance(k, levels / im) for k, im in enumerate(intensities)])
        failed = np.flatnonzero(np.isnan(found).any(axis=1))
        if failed.size:
            record = self.records[int(failed[0])]
            raise ConfigurationError(
                f"{record.source.path or record.station or 'a record'} cannot be followed at every level; leave it out."
            )
        return found

    def coarse_levels(self, intensities: np.ndarray) -> np.ndarray:
        """Levels from the first uplift to where all records exceed the threshold, evenly spaced in the logarithm."""
        peaks = np.array([record.peak_acceleration for record in self.records])
        uplift = intensities * self.mechanism.uplift_multiplier * GRAVITY / peaks
        lowest, highest = float(uplift.min()), float(uplift.min())
        while highest < LARGEST_UPLIFT * uplift.max():
            highest *= 1.5
            if self.at_levels(np.array([highest]), intensities).min() == 1:
                break
        return np.geomspace(lowest, highest, COARSE)


def _exceeds(ratios: np.ndarray, threshold: float) -> np.ndarray:
    above = np.isinf(ratios) if np.isinf(threshold) else ratios > threshold
    return np.where(np.isnan(ratios), np.nan, above.astype(float))


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


def _distinct(values: np.ndarray) -> np.ndarray:
    """Ascending values with equal ones moved apart by rounding size, so that each stays a level of its own."""
    return np.asarray(values * (1 + 1e-12 * np.arange(values.size)))
