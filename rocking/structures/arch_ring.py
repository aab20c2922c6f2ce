"""The ring of a circular arch: sections, contacts, what loads and weighs it (theory: section 5).

The centreline radius is 1 and the thickness t/r; sections are angles v from the vertical through the crown,
clockwise, in [−β/2, β/2]. Masses and loads are per t·r. Points are complex numbers x + iy from the centre.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.arch_fill import Fill
from rocking.structures.bars import Bars

INTRADOS, EXTRADOS = 1.0, -1.0
"""Sign of a contact: the thrust line stays above the intrados and below the extrados."""

PATTERN = np.array([INTRADOS, EXTRADOS, INTRADOS, EXTRADOS])
"""Contacts of the hinges A, B, C, D when the inertia forces act to the right."""

CONTINUOUS_SECTIONS = 49
"""Sections at which a continuous ring is first tried; the tangent sections between them are found exactly."""


class Load(NamedTuple):
    """What loads the ring left of a section: weight, and its first moments ∫ x and ∫ y, any shape; or derivatives."""

    weight: np.ndarray
    x: np.ndarray
    y: np.ndarray


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
        centroids = -self.centroid_radius * np.diff(np.exp(-1j * edges)) / masses
        about_centre = masses * (1 + self.thickness**2 / 4)
        if self.fill is not None:
            weight, x, y = (np.diff(values) for values in self.fill.loads(self.thickness, edges)[0])
            moments = masses * centroids + x + 1j * y
            masses = masses + weight
            centroids = moments / masses
            about_centre = about_centre + weight * (1 + self.thickness / 2) ** 2
        return Bars(masses, centroids, about_centre - masses * np.abs(centroids) ** 2)

    def loads(self, section: np.ndarray) -> tuple[Load, Load, Load]:
        """Weight and first moments of all left of `section`, and their first and second derivatives with it."""
        start, radius, zero = -self.embrace_angle / 2, self.centroid_radius, np.zeros_like(section)
        sine, cosine = np.sin(section), np.cos(section)
        total = Load(section - start, radius * (np.cos(start) - cosine), radius * (sine - np.sin(start)))
        rate = Load(zero + 1, radius * sine, radius * cosine)
        change = Load(zero, radius * cosine, -radius * sine)
        if self.fill is None:
            return total, rate, change
        filled = self.fill.loads(self.thickness, section)
        before = self.fill.loads(self.thickness, np.asarray(start))[0]
        since = (value - at for value, at in zip(filled[0], before, strict=True))
        return _added(total, since), _added(rate, filled[1]), _added(change, filled[2])

    def gaps(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Rows (a, b) with gap = a·(M₀, V, H, λ) + b, shape (k, 5).

        The gap is minus (intrados) or plus (extrados) the moment about the contact point of all that acts
        left of the section; it is the normal force times the distance from the thrust to that point, so it
        may not be negative.
        """
        load, *_ = self.loads(section)
        point = self.contact_radius(contact) * (np.sin(section) + 1j * np.cos(section))
        return self.gap_rows(point, contact, load)

    @staticmethod
    def gap_rows(point: np.ndarray, contact: np.ndarray, load: Load) -> np.ndarray:
        """The rows of `gaps` for contact points (k,), complex, and the loads left of them."""
        x, y = point.real, point.imag
        moment = np.stack(
            [np.ones_like(x), -x, y, y * load.weight - load.y, x * load.weight - load.x], axis=-1
        )
        return -contact[..., None] * moment

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """First and second derivatives of `gaps` with the section, each (k, 5)."""
        load, rate, change = self.loads(section)
        x = self.contact_radius(contact) * np.sin(section)
        y = self.contact_radius(contact) * np.cos(section)
        zero = np.zeros_like(x)
        first = [
            zero,
            -y,
            -x,
            -x * load.weight + y * rate.weight - rate.y,
            y * load.weight + x * rate.weight - rate.x,
        ]
        second = [
            zero,
            x,
            -y,
            -y * load.weight - 2 * x * rate.weight + y * change.weight - change.y,
            -x * load.weight + 2 * y * rate.weight + x * change.weight - change.x,
        ]
        sign = -contact[..., None]
        return sign * np.stack(first, axis=-1), sign * np.stack(second, axis=-1)

    def kept(self, hinges: np.ndarray) -> np.ndarray:
        """Sections moved back onto the ring."""
        edge = self.embrace_angle / 2
        return np.clip(hinges, -edge, edge)


def _added(load: Load, more: Iterable[np.ndarray]) -> Load:
    return Load(*(one + other for one, other in zip(load, more, strict=True)))
