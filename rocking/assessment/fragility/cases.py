"""Every record at every scale: the largest rotations of one structure, and the levels that are worth knowing."""

from collections.abc import Sequence

import numpy as np

from rocking.assessment.ensemble import CAUSES, EnsembleSettings, GroundMotions, drawn
from rocking.assessment.ensemble.design import lattice
from rocking.errors import ConfigurationError
from rocking.motion.batch import integrate_batch
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import EquivalentBlock, Mechanism

COARSE, FINE = 20, 20
"""Levels spread evenly over the range of the curve, and levels put where it moves."""
LARGEST_UPLIFT = 64.0
"""Times the uplift acceleration to which records are scaled in search of the level at which all overturn."""
MEMBERS = 16
"""Of each ensemble, where a case is not taken as it is."""


class Cases:
    """One mechanism or block under each record at any scale. intensities: (r,) of the records as they are."""

    def __init__(
        self,
        records: Sequence[Accelerogram],
        mechanism: Mechanism | EquivalentBlock,
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
        return np.array(
            [self.followed(k, self._ratios(k, levels / im)) for k, im in enumerate(self.intensities)]
        )

    def followed(self, record: int, ratios: np.ndarray) -> np.ndarray:
        """The ratios of a record. Raises ConfigurationError where one of them is nan."""
        if np.isnan(ratios).any():
            source = self.records[record]
            raise ConfigurationError(
                f"{source.source.path or source.station or 'a record'} cannot be followed at every level; leave it out."
            )
        return ratios

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
        standing = list(range(len(self.records)))
        while standing and highest < LARGEST_UPLIFT * uplift.max():
            highest *= 1.5
            standing = [k for k in standing if not self._overturns(k, highest)]
        return np.geomspace(lowest, highest, COARSE)

    def _overturns(self, record: int, level: float) -> bool:
        factor = level / self.intensities[record]
        found = integrate_batch([self.mechanism], self.records[record], [factor], tolerance=self.tolerance)
        return bool(np.isinf(found[0, 0]))

    def members_at(self, record: int, levels: np.ndarray, members: np.ndarray) -> np.ndarray:
        """(k,) of one record at levels (k,), each as the member (k,) of its ensemble; as it is without an ensemble."""
        factors = levels / self.intensities[record]
        if self.ensemble is None:
            return integrate_batch([self.mechanism], self.records[record], factors, tolerance=self.tolerance)[
                0
            ]
        points = lattice(MEMBERS, CAUSES)
        return np.array(
            [
                self._drawn(self.ensemble, record, factor, points[[k]])[0]
                for factor, k in zip(factors, members, strict=True)
            ]
        )

    def _ratios(self, record: int, factors: np.ndarray) -> np.ndarray:
        """(k, m) at each scale factor."""
        if self.ensemble is None:
            motion = self.records[record]
            return integrate_batch([self.mechanism], motion, factors, tolerance=self.tolerance)[0][:, None]
        points = lattice(MEMBERS, CAUSES)
        return np.array([self._drawn(self.ensemble, record, factor, points) for factor in factors])

    def _drawn(
        self, ensemble: EnsembleSettings, record: int, factor: float, points: np.ndarray
    ) -> np.ndarray:
        motions = GroundMotions.of(self.records[record].scaled(float(factor)))
        return drawn(self.mechanism, motions, points, ensemble, tolerance=self.tolerance).rotation_ratios


def _where_it_moves(levels: np.ndarray, share: np.ndarray) -> np.ndarray:
    """FINE levels at equal steps of how far the curve has moved, up or down."""
    moved = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(share)) + 1e-3)])
    places = (np.arange(FINE) + 0.5) / FINE * moved[-1]
    return np.asarray(np.exp(np.interp(places, moved, np.log(levels))))
