"""The ring of a circular arch: sections, contacts, what loads and weighs it (theory: section 5).

The centreline radius is 1 and the thickness t/r; sections are angles v from the vertical through the crown,
clockwise, in [−β/2, β/2]. Masses and loads are per t·r. Points are complex numbers x + iy from the centre.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.bars import Bars

INTRADOS, EXTRADOS = 1.0, -1.0
"""Sign of a contact: the thrust line stays above the intrados and below the extrados."""

PATTERN = np.array([INTRADOS, EXTRADOS, INTRADOS, EXTRADOS])
"""Contacts of the hinges A, B, C, D when the inertia forces act to the right."""

CONTINUOUS_SECTIONS = 49
"""Sections at which a continuous ring is first tried; the tangent sections between them are found exactly."""


@dataclass(frozen=True)
class Ring:
    """A circular ring of centreline radius 1: thickness t/r, embrace_angle β [rad], voussoirs (None: continuous)."""

    thickness: float
    embrace_angle: float
    voussoirs: int | None = None

    @property
    def centroid_radius(self) -> float:
        """Radius of the centroid of an element between two near sections."""
        return 1 + self.thickness**2 / 12

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
        """The annular sectors between successive sections `edges` (k + 1,)."""
        masses = np.diff(edges)
        centroids = -self.centroid_radius * np.diff(np.exp(-1j * edges)) / masses
        about_centre = masses * (1 + self.thickness**2 / 4)
        return Bars(masses, centroids, about_centre - masses * np.abs(centroids) ** 2)

    def gaps(self, section: np.ndarray, contact: np.ndarray) -> np.ndarray:
        """Rows (a, b) with gap = a·(M₀, V, H, λ) + b, shape (k, 5).

        The gap is minus (intrados) or plus (extrados) the moment about the contact point of all that acts
        left of the section; it is the normal force times the distance from the thrust to that point, so it
        may not be negative.
        """
        start = -self.embrace_angle / 2
        x = self.contact_radius(contact) * np.sin(section)
        y = self.contact_radius(contact) * np.cos(section)
        load = section - start
        load_x = self.centroid_radius * (np.cos(start) - np.cos(section))
        load_y = self.centroid_radius * (np.sin(section) - np.sin(start))
        moment = np.stack([np.ones_like(x), -x, y, y * load - load_y, x * load - load_x], axis=-1)
        return -contact[..., None] * moment

    def gap_slopes(self, section: np.ndarray, contact: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """First and second derivatives of `gaps` with the section, each (k, 5)."""
        load = section + self.embrace_angle / 2
        x = self.contact_radius(contact) * np.sin(section)
        y = self.contact_radius(contact) * np.cos(section)
        heavy_x = self.centroid_radius * np.sin(section)
        heavy_y = self.centroid_radius * np.cos(section)
        zero = np.zeros_like(x)
        first = [zero, -y, -x, -x * load + y - heavy_y, y * load + x - heavy_x]
        second = [zero, x, -y, -y * load - 2 * x + heavy_x, -x * load + 2 * y - heavy_y]
        sign = -contact[..., None]
        return sign * np.stack(first, axis=-1), sign * np.stack(second, axis=-1)
