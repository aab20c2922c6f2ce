"""Every record at every scale: the largest rotations of one structure, and the levels that are worth knowing."""

import os
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np

from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, drawn
from rocking.assessment.ensemble.design import lattice
from rocking.assessment.fragility.intensity import INTENSITY_MEASURES
from rocking.assessment.intensity import per_velocity
from rocking.errors import ConfigurationError
from rocking.motion.batch import integrate_batch
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock, Mechanism

LEVELS, COARSE, MOST_SPREAD = 40, 20, 30
"""Levels in all; those spread evenly over the range of the curve, at first and where it reaches farther. The others are
put where it moves."""
SEVERE = 3.0
"""p PGV/(gλ) from which nearly every structure overturns under nearly every record."""
NEARLY_ALL = 0.95
"""Share that overturns at the highest level."""
MEMBERS = 16
"""Of each ensemble, where a case is not taken as it is."""


@dataclass(frozen=True, eq=False)
class Cases:
    """One mechanism or block under each record at any scale. intensities: (r,) of the records as they are."""

    records: Sequence[Accelerogram]
    mechanism: Mechanism | EquivalentBlock
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
        reduced = self.mechanism
        block = reduced if isinstance(reduced, EquivalentBlock) else reduced.equivalent_block("rest")
        velocities = np.array([INTENSITY_MEASURES["pgv"].remembered(record) for record in self.records])
        return np.asarray(self.intensities * SEVERE / (per_velocity(block) * velocities))

    def members_at(self, record: int, levels: np.ndarray, members: np.ndarray) -> np.ndarray:
        """(k,) of one record at levels (k,), each as the member (k,) of its ensemble; as it is without an ensemble."""
        factors = levels / self.intensities[record]
        if self.ensemble is None:
            motion = self.records[record]
            return integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance)[0]
        points = lattice(MEMBERS, CAUSES)[members]
        drawn = (
            self._drawn(self.ensemble, record, *one) for one in zip(factors, points[:, None], strict=True)
        )
        return np.concatenate(list(drawn))

    def _ratios(self, record: int, factors: np.ndarray) -> np.ndarray:
        """(k, m) at each scale factor."""
        if self.ensemble is None:
            motion = self.records[record]
            found = integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance, workers=1)
            return found[0][:, None]
        points = lattice(MEMBERS, CAUSES)
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
