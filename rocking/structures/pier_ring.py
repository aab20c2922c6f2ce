"""The ring of an arch together with the piers it stands on: one more section below each springing.

The foot of the left pier is the section LEFT_FOOT before the left springing, that of the right one as far behind the
right springing; their contacts are the inner corner (as the intrados) and the outer corner (as the extrados).
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.arch_ring import Load, Ring
from rocking.structures.bars import Bars

FOOT = 1.0
"""Place of a foot beyond its springing, rad: a name for a section, not an angle."""


@dataclass(frozen=True)
class PierRing(Ring):
    """A ring on equal rectangular piers, flush with its intrados at the springings.

    pier_width, pier_height: over r. pier_density: over that of the arch.
    """

    pier_width: float = 0.0
    pier_height: float = 0.0
    pier_density: float = 1.0

    @property
    def pier_mass(self) -> float:
        """Of one pier, per t·r."""
        return self.pier_density * self.pier_width * self.pier_height / self.thickness

    @property
    def mass(self) -> float:
        """Of ring, fill and both piers, per t·r."""
        return super().mass + 2 * self.pier_mass

    @property
    def springing(self) -> complex:
        """The right springing's point on the intrados: the inner corner of the pier's head."""
        return complex((1 - self.thickness / 2) * 1j * np.exp(-0.5j * self.embrace_angle))

    def pier(self, side: float) -> np.ndarray:
        """The corners of the left (side −1) or right (1) pier, complex: inner and outer foot, outer and inner head."""
        inner, top = self.springing.real, self.springing.imag
        low = top - self.pier_height
        outer = inner + self.pier_width
        return np.array(
            [side * x + 1j * y for x, y in ((inner, low), (outer, low), (outer, top), (inner, top))]
        )

    def pier_centre(self, side: float) -> complex:
        """Its centre of mass."""
        return complex(self.pier(side).mean())

    def _foot(self, section: np.ndarray) -> np.ndarray:
        """−1 at the left foot, 1 at the right one, 0 on the ring."""
        beyond = np.abs(section) > self.embrace_angle / 2 + FOOT / 2
        return np.sign(section) * beyond

    def sections(self) -> np.ndarray:
        """Those of the ring, with the feet of both piers."""
        ring, edge = super().sections(), self.embrace_angle / 2 + FOOT
        return np.concatenate([[-edge], ring, [edge]])

    def kept(self, hinges: np.ndarray) -> np.ndarray:
        """Sections moved back onto the ring; feet stay."""
        foot = self._foot(hinges)
        return np.where(foot == 0, super().kept(hinges), foot * (self.embrace_angle / 2 + FOOT))

    def contact_points(self, section: np.ndarray, contact: ArrayLike) -> np.ndarray:
        """The points of the intrados (1) or extrados (−1), at a foot the inner or the outer corner, complex."""
        foot, contact = self._foot(np.asarray(section)), np.asarray(contact)
        inner, outer = self.pier(1.0)[:2]
        corner = np.where(contact > 0, inner.real, outer.real)
        return np.where(foot == 0, super().contact_points(section, contact), foot * corner + 1j * inner.imag)

    def loads(self, section: np.ndarray) -> tuple[Load, Load, Load]:
        """As for a ring; at a foot with its pier, and without change."""
        foot = self._foot(np.asarray(section))
        total, rate, change = super().loads(super().kept(np.asarray(section)))
        centre = np.where(foot < 0, self.pier_centre(-1.0), self.pier_centre(1.0))
        mass, still = foot * self.pier_mass, foot == 0
        added = Load(total.weight + mass, total.x + mass * centre.real, total.y + mass * centre.imag)
        return added, Load(*(still * value for value in rate)), Load(*(still * value for value in change))

    def gaps(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """As for a ring; at a foot about its corners."""
        return self.gap_rows(self.contact_points(section, contact), contact, self.loads(section)[0])

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """As for a ring; a foot does not move: no slope, and a curvature to divide by."""
        foot = (self._foot(section) != 0)[..., None]
        first, second = super().gap_slopes(section, contact)
        return np.where(foot, np.zeros(5), first), np.where(foot, [0.0, 0.0, 0.0, 0.0, 1.0], second)

    def bars(self, edges: np.ndarray) -> Bars:
        """Those of the ring, the first and the last with their pier where it rocks."""
        bars = super().bars(super().kept(edges))
        masses, moments = bars.masses.copy(), bars.masses * bars.centroids
        about = bars.inertias + bars.masses * np.abs(bars.centroids) ** 2
        for place, side in ((0, -1.0), (-1, 1.0)):
            if self._foot(edges[place : place + 1 or None])[0] == side:
                centre, mass = self.pier_centre(side), self.pier_mass
                masses[place] += mass
                moments[place] += mass * centre
                own = (self.pier_width**2 + self.pier_height**2) / 12
                about[place] += mass * (own + abs(centre) ** 2)
        centroids = moments / masses
        return Bars(masses, centroids, about - masses * np.abs(centroids) ** 2)
