"""The ring of a circular arch: sections, contacts, what loads and weighs it, fill and piers (theory: section 5).

The centreline radius is 1 and the thickness t/r; sections are angles v from the vertical through the crown,
clockwise, in [−β/2, β/2]. Masses and loads are per t·r. Points are complex numbers x + iy from the centre.

Piers add one more section below each springing: FOOT before the left springing and FOOT behind the right one; their
contacts are the inner corner (as the intrados) and the outer corner (as the extrados).
"""

from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.drawing import rectangle

Loads = tuple[np.ndarray, np.ndarray]
"""Weight, ∫ x and ∫ y of what loads the ring (3, ...), and their derivatives with the section."""


@dataclass(frozen=True, kw_only=True)
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
        level = outer + self.depth
        factor = self.density * outer / thickness
        v = np.clip(section, -np.pi / 2, np.pi / 2)
        sine = np.sin(v)
        cosine = np.cos(v)
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


INTRADOS = 1.0
"""Sign of a contact at the intrados, above which the thrust line stays."""
EXTRADOS = -1.0
"""Sign of a contact at the extrados, below which it stays."""

PATTERN = np.array([INTRADOS, EXTRADOS, INTRADOS, EXTRADOS])
"""Contacts of the hinges A, B, C, D when the inertia forces act to the right."""

FOOT = 1.0
"""Place of a foot beyond its springing, rad: a name for a section, not an angle."""

CONTINUOUS_SECTIONS = 49
"""Sections at which a continuous ring is first tried; the tangent sections between them are found exactly."""


class Bars(NamedTuple):
    """Masses, centroids (complex, at rest) and inertias about the centroids of some rigid parts: (k,) each."""

    masses: np.ndarray
    centroids: np.ndarray
    inertias: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Piers:
    """Two equal rectangular piers. springing: inner corner of the right one's head. width, height: over r.

    mass: of each, per t·r.
    """

    springing: complex
    width: float
    height: float
    mass: float

    @property
    def corners(self) -> np.ndarray:
        """The corners of the right pier, (4,) complex: inner and outer foot, outer and inner head."""
        inner = self.springing.real
        top = self.springing.imag
        return rectangle(inner, inner + self.width, top - self.height, top)

    @property
    def centre(self) -> complex:
        """Centre of mass of the right one."""
        return complex(self.corners.mean())


@dataclass(frozen=True, kw_only=True)
class Ring:
    """A circular ring of centreline radius 1: thickness t/r, embrace_angle β [rad], voussoirs (None: continuous).

    fill: what lies on its extrados and moves with it, or None. piers: below its springings, or None. crushed: by a
    line of thrust, where contacts lie half the depth pressed inside the ring: γ t/(1.7 f_c), then M₀, V, H and λ of
    the line; None where nothing crushes.
    """

    thickness: float
    embrace_angle: float
    voussoirs: int | None = None
    fill: Fill | None = None
    piers: Piers | None = None
    crushed: tuple[float, ...] | None = None

    @property
    def ends(self) -> np.ndarray:
        """The springings, (2,) angles from the vertical; on piers their feet."""
        springings: np.ndarray = np.array([-0.5, 0.5]) * self.embrace_angle
        return springings if self.piers is None else springings + np.array([-FOOT, FOOT])

    @property
    def centroid_radius(self) -> float:
        """Radius of the centroid of an element between two near sections."""
        return 1 + self.thickness**2 / 12

    @property
    def mass(self) -> float:
        """The mass of ring, fill and piers, per t·r."""
        return float(self.bars(self.ends).masses.sum())

    def sections(self) -> np.ndarray:
        """The joints, or the sections at which a continuous ring is first tried: angles from the vertical."""
        count = CONTINUOUS_SECTIONS if self.voussoirs is None else self.voussoirs + 1
        joints = np.linspace(-self.embrace_angle / 2, self.embrace_angle / 2, count)
        return joints if self.piers is None else np.array([self.ends[0], *joints, self.ends[1]])

    def feet(self, section: ArrayLike) -> np.ndarray:
        """Return −1 for the left foot, 1 for the right one, 0 for a section of the ring."""
        return np.sign(section) * (np.abs(section) > self.embrace_angle / 2 + FOOT / 2)

    def on_arch(self, section: ArrayLike) -> np.ndarray:
        """Sections moved back between the springings."""
        return np.clip(section, -self.embrace_angle / 2, self.embrace_angle / 2)

    def on_ring(self, section: np.ndarray) -> np.ndarray:
        """Sections moved back onto the ring; feet stay."""
        foot = self.feet(section)
        return np.where(foot == 0, self.on_arch(section), foot * self.ends[1])

    def contact_points(self, section: np.ndarray, contact: ArrayLike) -> np.ndarray:
        """The points of the intrados (contact = 1) or extrados (−1), at a foot the inner or outer corner; complex.

        Of a ring that is crushed they lie inside, where the part that is pressed has its middle.
        """
        contact = np.asarray(contact)
        aside = self._insets(section)[0]
        points = (1 - contact * (self.thickness / 2 - aside)) * 1j * np.exp(-1j * section)
        if self.piers is None:
            return points
        foot = self.feet(section)
        inner, outer = self.piers.corners[:2]
        corner = np.where(contact > 0, inner.real + aside, outer.real - aside)
        return np.where(foot == 0, points, foot * corner + 1j * inner.imag)

    def _insets(self, section: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """How far in contacts lie at `section`, over r, and the derivative with the section."""
        if self.crushed is None:
            return np.zeros(np.shape(section)), np.zeros(np.shape(section))
        softness, *line = self.crushed
        unknowns = np.array([*line, 1.0])
        foot = self.feet(section)
        across = self._across(section)
        load, load_rate = self.loads(section)
        normal = -_moment(0.0, across, load) @ unknowns
        turned = _moment(0.0, np.where(foot == 0, -1j * across, 0.0), load)
        slope = -(turned + _OF_LOADS * _moment(0.0, across, load_rate)) @ unknowns
        return softness * normal, softness * slope

    def _across(self, section: np.ndarray) -> np.ndarray:
        """The joints from extrados to intrados, complex, of length 1.

        Moments about points so far apart differ by the normal force.
        """
        foot = self.feet(section)
        return np.where(foot == 0, -1j * np.exp(-1j * section), -foot)

    def sector(self, first: float, last: float) -> np.ndarray:
        """The outline of the ring between two sections, complex, an arc of points every two degrees."""
        sections = np.linspace(first, last, max(2, int((last - first) / np.radians(2)) + 2))
        whole = replace(self, crushed=None)
        inner, outer = (whole.contact_points(sections, contact) for contact in (INTRADOS, EXTRADOS))
        return np.concatenate([inner, outer[::-1]])

    def bars(self, edges: np.ndarray) -> Bars:
        """The annular sectors between successive sections `edges` (k + 1,), with the fill and the pier on each."""
        on_arch = self.on_arch(edges)
        masses = np.diff(on_arch)
        # a pier that turns about its springing has no part of the ring: 0/0
        turns = np.diff(np.exp(-1j * on_arch))
        centroids: np.ndarray = -self.centroid_radius * turns / np.where(masses > 0, masses, 1.0)
        about_centre = masses * (1 + self.thickness**2 / 4)
        if self.fill is not None:
            weight, x, y = np.diff(self.fill.loads(self.thickness, on_arch)[0])
            moments = masses * centroids + x + 1j * y
            masses = masses + weight
            centroids = moments / np.where(masses > 0, masses, 1.0)
            about_centre = about_centre + weight * (1 + self.thickness / 2) ** 2
        if self.piers is not None:
            at_ends = np.zeros((2, masses.size))
            centre = self.piers.centre
            at_ends[[0, 1], [0, -1]] = np.abs(self.feet(edges)[[0, -1]]) * self.piers.mass
            moments = masses * centroids + at_ends[0] * -centre.conjugate() + at_ends[1] * centre
            masses = masses + at_ends.sum(axis=0)
            centroids = moments / masses
            own = (self.piers.width**2 + self.piers.height**2) / 12
            about_centre = about_centre + at_ends.sum(axis=0) * (own + abs(centre) ** 2)
        return Bars(masses, centroids, about_centre - masses * np.abs(centroids) ** 2)

    def loads(self, section: np.ndarray) -> Loads:
        """Return what lies left of `section`; at a foot with its pier, and without change."""
        at = self.on_arch(section)
        start = -self.embrace_angle / 2
        radius = self.centroid_radius
        sine = np.sin(at)
        cosine = np.cos(at)
        total = np.stack([at - start, radius * (np.cos(start) - cosine), radius * (sine - np.sin(start))])
        rate = np.stack([np.ones_like(sine), radius * sine, radius * cosine])
        if self.fill is not None:
            (filled, more), (before, _) = (
                self.fill.loads(self.thickness, np.asarray(angle)) for angle in (at, start)
            )
            total = total + (filled.T - before).T
            rate = rate + more
        if self.piers is not None:
            foot = self.feet(section)
            centre = self.piers.centre
            one = np.ones_like(foot)
            total = total + self.piers.mass * np.stack(
                [foot, one * np.abs(foot) * centre.real, foot * centre.imag]
            )
            rate = (foot == 0) * rate
        return total, rate

    def gaps(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Rows (a, b) with gap = a·(M₀, V, H, λ) + b, shape (k, 5).

        The gap is minus (intrados) or plus (extrados) the moment about the contact point of all that acts
        left of the section; it is the normal force times the distance from the thrust to that point, so it
        may not be negative.
        """
        point = self.contact_points(section, contact)
        result: np.ndarray = -contact[..., None] * _moment(1.0, point, self.loads(section)[0])
        return result

    def friction_left(self, section: np.ndarray, coefficient: float) -> np.ndarray:
        """Rows (a, b) with a·(M₀, V, H, λ) + b the friction left at `section` to either side, shape (2k, 5).

        It is the coefficient times the normal force, less the force along the joint, and may not be negative.
        """
        across = self._across(section)
        load, _ = self.loads(section)
        most = -coefficient * _moment(0.0, across, load)
        along = _moment(0.0, 1j * across, load)
        return np.concatenate([most - along, most + along])

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Derivatives of `gaps` with the section, (k, 5); 0 for a foot, which does not move."""
        load, load_rate = self.loads(section)
        point = self.contact_points(section, contact)
        # A point of the ring turns clockwise as the angle from the left springing grows.
        point_rate = -1j * point + contact * self._insets(section)[1] * 1j * np.exp(-1j * section)

        by_point = _moment(0.0, point_rate, load)
        by_loads = _OF_LOADS * _moment(1.0, point, load_rate)

        slopes = -contact[..., None] * (by_point + by_loads)
        is_foot = self.feet(section) != 0
        return np.where(is_foot[..., None], 0.0, slopes)


_OF_LOADS = np.array([0.0, 0.0, 0.0, 1.0, 1.0])
"""The columns of `_moment` that hold the loads; the others do not change with them."""


def _moment(one: float, point: np.ndarray, load: np.ndarray) -> np.ndarray:
    """(k, 5) moments about points of M₀, V, H, of the loads times λ and of the loads; one: 0 for derivatives."""
    x = point.real
    y = point.imag
    weight, of_x, of_y = load
    return np.stack([np.full_like(x, one), -x, y, y * weight - one * of_y, x * weight - one * of_x], axis=-1)
