"""The ring of a circular arch: sections, contacts, what loads and weighs it, fill and piers (theory: section 5).

The centreline radius is 1 and the thickness t/r; sections are angles v from the vertical through the crown,
clockwise, in [−β/2, β/2]. Masses and loads are per t·r. Points are complex numbers x + iy from the centre.

Piers add one more section below each springing: FOOT before the left springing and FOOT behind the right one; their
contacts are the inner corner (as the intrados) and the outer corner (as the extrados).
"""

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

Loads = tuple[np.ndarray, np.ndarray]
"""Weight, ∫ x and ∫ y of what loads the ring (3, ...), and their derivatives with the section."""


@dataclass(frozen=True)
class Fill:
    """Level fill over the whole arch. depth: above the extrados at the crown, over r. density: over the masonry's.

    Each vertical column bears on the extrados below it: its weight and its mass act there. What stands beyond the
    widest point of an arch of more than 180° does not bear on it.
    """

    depth: float
    density: float

    def loads(self, thickness: float, section: np.ndarray) -> Loads:
        """Return what lies from the crown to `section` [rad from the vertical].

        Per t·r of the ring, whose centreline radius is 1 and thickness `thickness`.
        """
        outer = 1 + thickness / 2
        level, factor = outer + self.depth, self.density * outer / thickness
        v = np.clip(section, -np.pi / 2, np.pi / 2)
        sine, cosine = np.sin(v), np.cos(v)
        square = v / 2 + sine * cosine / 2  # ∫ cos²
        total = factor * np.stack(
            [
                level * sine - outer * square,
                outer * (level * sine**2 / 2 + outer * cosine**3 / 3),
                outer * (level * square - outer * (sine - sine**3 / 3)),
            ]
        )
        weight = factor * (np.abs(section) < np.pi / 2) * (level - outer * cosine) * cosine
        return total, weight * np.stack([np.ones_like(sine), outer * sine, outer * cosine])


INTRADOS, EXTRADOS = 1.0, -1.0
"""Sign of a contact: the thrust line stays above the intrados and below the extrados."""

PATTERN = np.array([INTRADOS, EXTRADOS, INTRADOS, EXTRADOS])
"""Contacts of the hinges A, B, C, D when the inertia forces act to the right."""

CONTINUOUS_SECTIONS = 49
"""Sections at which a continuous ring is first tried; the tangent sections between them are found exactly."""


class Bars(NamedTuple):
    """Masses, centroids (complex, at rest) and inertias about the centroids of some rigid parts: (k,) each."""

    masses: np.ndarray
    centroids: np.ndarray
    inertias: np.ndarray


@dataclass(frozen=True)
class Ring:
    """A circular ring of centreline radius 1: thickness t/r, embrace_angle β [rad], voussoirs (None: continuous).

    fill: what lies on its extrados and moves with it, or None.
    """

    thickness: float
    embrace_angle: float
    voussoirs: int | None = None
    fill: Fill | None = None

    @property
    def centroid_radius(self) -> float:
        """Radius of the centroid of an element between two near sections."""
        return 1 + self.thickness**2 / 12

    @property
    def mass(self) -> float:
        """Of ring and fill, per t·r."""
        edge = self.embrace_angle / 2
        return float(self.bars(np.array([-edge, edge])).masses.sum())

    def sections(self) -> np.ndarray:
        """The joints, or the sections at which a continuous ring is first tried: angles from the vertical."""
        count = CONTINUOUS_SECTIONS if self.voussoirs is None else self.voussoirs + 1
        return np.linspace(-self.embrace_angle / 2, self.embrace_angle / 2, count)

    def contact_radius(self, contact: ArrayLike) -> np.ndarray:
        """Radius of the intrados (contact = 1) or extrados (−1)."""
        return 1 - np.asarray(contact) * self.thickness / 2

    def contact_points(self, section: np.ndarray, contact: ArrayLike) -> np.ndarray:
        """The points of the intrados (contact = 1) or extrados (−1) on those sections, complex."""
        return self.contact_radius(contact) * 1j * np.exp(-1j * section)

    def sector(self, first: float, last: float) -> np.ndarray:
        """The outline of the ring between two sections, complex, an arc of points every two degrees."""
        sections = np.linspace(first, last, max(2, int((last - first) / np.radians(2)) + 2))
        inner, outer = (self.contact_points(sections, contact) for contact in (INTRADOS, EXTRADOS))
        return np.concatenate([inner, outer[::-1]])

    def bars(self, edges: np.ndarray) -> Bars:
        """The annular sectors between successive sections `edges` (k + 1,), each with the fill on it."""
        masses = np.diff(edges)
        # a pier that turns about its springing has no part of the ring: 0/0
        turns = np.diff(np.exp(-1j * edges))
        centroids: np.ndarray = -self.centroid_radius * turns / np.where(masses > 0, masses, 1.0)
        about_centre = masses * (1 + self.thickness**2 / 4)
        if self.fill is not None:
            weight, x, y = np.diff(self.fill.loads(self.thickness, edges)[0])
            moments = masses * centroids + x + 1j * y
            masses = masses + weight
            centroids = moments / np.where(masses > 0, masses, 1.0)
            about_centre = about_centre + weight * (1 + self.thickness / 2) ** 2
        return Bars(masses, centroids, about_centre - masses * np.abs(centroids) ** 2)

    def loads(self, section: np.ndarray) -> Loads:
        """Return what lies left of `section`."""
        start, radius = -self.embrace_angle / 2, self.centroid_radius
        sine, cosine = np.sin(section), np.cos(section)
        total = np.stack(
            [section - start, radius * (np.cos(start) - cosine), radius * (sine - np.sin(start))]
        )
        rate = np.stack([np.ones_like(sine), radius * sine, radius * cosine])
        if self.fill is None:
            return total, rate
        (filled, more), (before, _) = (
            self.fill.loads(self.thickness, np.asarray(each)) for each in (section, start)
        )
        return total + (filled.T - before).T, rate + more

    def gaps(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Rows (a, b) with gap = a·(M₀, V, H, λ) + b, shape (k, 5).

        The gap is minus (intrados) or plus (extrados) the moment about the contact point of all that acts
        left of the section; it is the normal force times the distance from the thrust to that point, so it
        may not be negative.
        """
        point = self.contact_points(section, contact)
        return -contact[..., None] * _moment(1.0, point, self.loads(section)[0])

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Derivatives of `gaps` with the section, (k, 5)."""
        load, rate = self.loads(section)
        point = self.contact_points(section, contact)
        of_loads = np.array([0.0, 0.0, 0.0, 1.0, 1.0]) * _moment(1.0, point, rate)
        return -contact[..., None] * (_moment(0.0, -1j * point, load) + of_loads)  # type: ignore[no-any-return]

    def kept(self, hinges: np.ndarray) -> np.ndarray:
        """Sections moved back onto the ring."""
        edge = self.embrace_angle / 2
        return np.clip(hinges, -edge, edge)


def _moment(one: float, point: np.ndarray, load: np.ndarray) -> np.ndarray:
    """(k, 5) moments about points of M₀, V, H, of the loads times λ and of the loads; one: 0 for derivatives."""
    x, y = point.real, point.imag
    weight, of_x, of_y = load
    return np.stack([np.full_like(x, one), -x, y, y * weight - one * of_y, x * weight - one * of_x], axis=-1)


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

    def loads(self, section: np.ndarray) -> Loads:
        """As for a ring; at a foot with its pier, and without change."""
        foot = self._foot(np.asarray(section))
        total, rate = super().loads(super().kept(np.asarray(section)))
        centre = np.where(foot < 0, self.pier_centre(-1.0), self.pier_centre(1.0))
        pier = foot * self.pier_mass * np.stack([np.ones_like(foot), centre.real, centre.imag])
        return total + pier, (foot == 0) * rate

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """As for a ring; a foot does not move."""
        return np.where((self._foot(section) != 0)[..., None], 0.0, super().gap_slopes(section, contact))

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
