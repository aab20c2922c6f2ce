"""The two blocks of a wall hinged between its supports, with exact derivatives (theory: section 4)."""

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.bars import Bars, Motion

_LINKAGE_MARGIN = 0.9
"""Share of the reach of the shorter half that the motion may use: the linkage locks at 1, where ψ' is
infinite, and by 0.9 the hinge has moved so far past the upright position that the wall has fallen."""


class WallLinkage:
    """I, I', G, G', B of the two blocks, divided by the wall's mass and R₁ (so that G and B are numbers)."""

    def __init__(self, lower_height: float, upper_height: float, thickness: float) -> None:
        self.lower_diagonal = np.hypot(lower_height, thickness) / 2
        self.upper_diagonal = np.hypot(upper_height, thickness) / 2
        self.slenderness = float(np.arctan2(thickness, lower_height))
        height = lower_height + upper_height
        self.lower_mass = lower_height / height / self.lower_diagonal
        self.upper_mass = upper_height / height / self.lower_diagonal
        self._half_thickness, self._lower_half, self._upper_half = (
            thickness / 2,
            lower_height / 2,
            upper_height / 2,
        )
        self._upper_slenderness = np.arctan2(thickness, upper_height)
        reach = min(1.0, self.upper_diagonal / self.lower_diagonal)
        lying = np.pi / 2
        self.end_rotation = float(min(lying, self.slenderness + np.arcsin(_LINKAGE_MARGIN * reach)))

    def _position(self, rotation: ArrayLike) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """S and C of the lower half diagonal, ψ' and ψ''."""
        sine, cosine = np.sin(rotation), np.cos(rotation)
        across = self._half_thickness * cosine - self._lower_half * sine
        up = self._lower_half * cosine + self._half_thickness * sine
        # R₂² − S² = (h₂/2)² + (b − S)(b + S), without the cancellation of a flat upper block
        moved = 2 * self._half_thickness * np.sin(np.asarray(rotation) / 2) ** 2 + self._lower_half * sine
        upper_up = np.sqrt(self._upper_half**2 + moved * (self._half_thickness + across))
        ratio = up / upper_up
        return across, up, ratio, across * (1 - ratio**2) / upper_up

    @property
    def bars(self) -> Bars:
        """The lower and the upper block at rest, per mass of the wall."""
        masses = np.array([self.lower_mass, self.upper_mass]) * self.lower_diagonal
        diagonals = np.array([self.lower_diagonal, self.upper_diagonal])
        return Bars(masses, self.motion(0.0).centroids, masses * diagonals**2 / 3)

    def motion(self, rotation: ArrayLike) -> Motion:
        """Return the blocks at `rotation` ≥ 0, any shape; hinges at the base, between the blocks and at the top.

        The lower block turns clockwise about its right bottom corner, the upper one back about the left edge.
        """
        across, up, ratio, curvature = self._position(rotation)
        lower, upper = -across + 1j * up, across + 1j * up / ratio
        base = self._half_thickness + np.zeros_like(lower)
        psi = self._upper_slenderness - np.arctan2(upper.real, upper.imag)
        one = np.ones_like(across)
        return Motion(
            hinges=np.stack([base, base + 2 * lower, base + 2 * lower + 2 * upper]),
            angles=np.stack([-np.asarray(rotation) * one, psi]),
            spins=np.stack([-one, ratio]),
            spin_slopes=np.stack([0 * one, curvature]),
            centroids=np.stack([base + lower, base + 2 * lower + upper]),
            velocities=np.stack([-1j * lower, -2j * lower + 1j * ratio * upper]),
            accelerations=np.stack([-lower, -2 * lower + (1j * curvature - ratio**2) * upper]),
        )

    def inertia(self, rotation: ArrayLike) -> np.ndarray:
        """4/3 m₁R₁² + 1/3 m₂R₂²ψ'² + m₂[C² + S²(2 + ψ')²]."""
        across, up, ratio, _ = self._position(rotation)
        spin = 4 / 3 * self.lower_mass * self.lower_diagonal**2
        return spin + self.upper_mass * (
            self.upper_diagonal**2 * ratio**2 / 3 + up**2 + (across * (2 + ratio)) ** 2
        )

    def inertia_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dI/dφ, with S' = −C, C' = S."""
        across, up, ratio, curvature = self._position(rotation)
        lift = 2 + ratio
        return (
            2
            * self.upper_mass
            * (
                self.upper_diagonal**2 * ratio * curvature / 3
                + up * across
                + across * lift * (across * curvature - up * lift)
            )
        )

    def gravity(self, rotation: ArrayLike) -> np.ndarray:
        """S (m₁ + 2m₂ + m₂ψ')."""
        across, _, ratio, _ = self._position(rotation)
        return across * (self.lower_mass + self.upper_mass * (2 + ratio))

    def gravity_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dG/dφ."""
        across, up, ratio, curvature = self._position(rotation)
        return self.upper_mass * across * curvature - up * (self.lower_mass + self.upper_mass * (2 + ratio))

    def ground(self, rotation: ArrayLike) -> np.ndarray:
        """(m₁ + m₂) C."""
        return (self.lower_mass + self.upper_mass) * self._position(rotation)[1]
