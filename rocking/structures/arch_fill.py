"""The fill above the extrados of an arch, as mass that lies on it and moves with it."""

from dataclasses import dataclass

import numpy as np

Moments = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Weight, ∫ x and ∫ y of it."""


@dataclass(frozen=True)
class Fill:
    """Level fill over the whole arch. depth: above the extrados at the crown, over r. density: over the masonry's.

    Each vertical column bears on the extrados below it: its weight and its mass act there. What stands beyond the
    widest point of an arch of more than 180° does not bear on it.
    """

    depth: float
    density: float

    def loads(self, thickness: float, section: np.ndarray) -> tuple[Moments, Moments, Moments]:
        """Return weight, ∫ x, ∫ y from the crown to `section` [rad from the vertical], and two derivatives with it.

        Per t·r of the ring, whose centreline radius is 1 and thickness `thickness`.
        """
        outer = 1 + thickness / 2
        level, factor = outer + self.depth, self.density * outer / thickness
        inside = np.abs(section) < np.pi / 2
        v = np.clip(section, -np.pi / 2, np.pi / 2)
        sine, cosine = np.sin(v), np.cos(v)
        square = v / 2 + sine * cosine / 2  # ∫ cos²
        total = (
            factor * (level * sine - outer * square),
            factor * outer * (level * sine**2 / 2 + outer * cosine**3 / 3),
            factor * outer * (level * square - outer * (sine - sine**3 / 3)),
        )
        weight = factor * inside * (level - outer * cosine) * cosine
        change = factor * inside * (2 * outer * cosine - level) * sine
        rate = (weight, weight * outer * sine, weight * outer * cosine)
        slope = (
            change,
            outer * (change * sine + weight * cosine),
            outer * (change * cosine - weight * sine),
        )
        return total, rate, slope
