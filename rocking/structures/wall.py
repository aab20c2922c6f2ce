"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rocking.checks import finite, positive
from rocking.errors import StructureError
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.restitution import (
    Restitution,
    check_restitution,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.structure import Structure

_LINKAGE_MARGIN = 0.9
"""Share of the reach of the shorter half that the motion may use: the linkage locks at 1, where ψ' is
infinite, and by 0.9 the hinge has moved so far past the upright position that the wall has fallen."""


@dataclass(frozen=True)
class Wall(Structure):
    """A wall cracked into two blocks; base and top follow the ground, the top support slides vertically.

    lower_height, upper_height: h₁ below and h₂ above the hinge, m. thickness: 2b, m. The rotation φ is the
    lower block's. restitution: η in [0, 1] or "momentum" (the default): the impulses at the hinges of the
    mirrored mechanism do no work on it. For equal blocks that is (1 − 4.5 sin²α)/(1 + 3 sin²α), which
    reaches 0 at sin²α = 2/9; squatter walls get 0 and a StructureWarning.
    Raises StructureError when it cannot stand.
    """

    lower_height: float
    upper_height: float
    thickness: float
    restitution: Restitution = None

    def __post_init__(self) -> None:
        for name in ("lower_height", "upper_height", "thickness"):
            object.__setattr__(self, name, positive(StructureError, name, getattr(self, name), "m"))
        check_restitution(self.restitution, ("momentum",))

    @classmethod
    def hinged_at(cls, height: float, hinge_height: float, thickness: float, **options) -> "Wall":
        """Return the wall of that total height whose hinge lies at `hinge_height` [m] above the base."""
        height = positive(StructureError, "height", height, "m")
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        if not 0 < hinge < height:
            raise StructureError(
                f"hinge_height is {hinge!r} m, but must lie inside the wall, "
                f"between 0 and its height of {height!r} m."
            )
        return cls(hinge, height - hinge, thickness, **options)

    @property
    def height(self) -> float:
        """h₁ + h₂, m."""
        return self.lower_height + self.upper_height

    def _build(self) -> Mechanism:
        linkage = self._linkage
        return Mechanism(
            Side(
                inertia=linkage.inertia,
                inertia_slope=linkage.inertia_slope,
                gravity=linkage.gravity,
                gravity_slope=linkage.gravity_slope,
                ground=linkage.ground,
                critical_rotation=linkage.slenderness,
                end_rotation=linkage.end_rotation,
                restitution=resolve_restitution(
                    self.restitution, "momentum", {"momentum": self._momentum_balance}
                ),
            )
        )

    @cached_property
    def _linkage(self) -> "_Linkage":
        return _Linkage(self.lower_height, self.upper_height, self.thickness)

    def _momentum_balance(self) -> float:
        """Velocities (vx, vy, clockwise ω) at φ = 0; the mirrored mechanism continues the same turn."""
        h1, h2, t = self.lower_height, self.upper_height, self.thickness
        ratio = h1 / h2
        lower = [h1 / 2, t / 2, 1.0]
        upper = [h1 / 2, t + ratio * t / 2, -ratio]
        inertias = [h1 * (h1**2 + t**2) / 12, h2 * (h2**2 + t**2) / 12]
        before = np.array([lower, upper])
        return momentum_balance([h1, h2], inertias, before, before * [1.0, -1.0, 1.0])


class _Linkage:
    """I, I', G, G', B of the two blocks, divided by the wall's mass and R₁ (so that G and B are numbers)."""

    def __init__(self, lower_height: float, upper_height: float, thickness: float) -> None:
        self.lower_diagonal = np.hypot(lower_height, thickness) / 2
        self.upper_diagonal = np.hypot(upper_height, thickness) / 2
        self.slenderness = float(np.arctan2(thickness, lower_height))
        height = lower_height + upper_height
        self.lower_mass = lower_height / height / self.lower_diagonal
        self.upper_mass = upper_height / height / self.lower_diagonal
        reach = min(1.0, self.upper_diagonal / self.lower_diagonal)
        lying = np.pi / 2
        self.end_rotation = float(min(lying, self.slenderness + np.arcsin(_LINKAGE_MARGIN * reach)))

    def _position(self, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """S and C of the lower half diagonal, ψ' and ψ''."""
        angle = self.slenderness - rotation
        across = self.lower_diagonal * np.sin(angle)
        up = self.lower_diagonal * np.cos(angle)
        upper_up = np.sqrt(self.upper_diagonal**2 - across**2)
        ratio = up / upper_up
        return across, up, ratio, across * (1 - ratio**2) / upper_up

    def inertia(self, rotation: np.ndarray) -> np.ndarray:
        """4/3 m₁R₁² + 1/3 m₂R₂²ψ'² + m₂[C² + S²(2 + ψ')²]."""
        across, up, ratio, _ = self._position(rotation)
        spin = 4 / 3 * self.lower_mass * self.lower_diagonal**2
        return spin + self.upper_mass * (
            self.upper_diagonal**2 * ratio**2 / 3 + up**2 + (across * (2 + ratio)) ** 2
        )

    def inertia_slope(self, rotation: np.ndarray) -> np.ndarray:
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

    def gravity(self, rotation: np.ndarray) -> np.ndarray:
        """S (m₁ + 2m₂ + m₂ψ')."""
        across, _, ratio, _ = self._position(rotation)
        return across * (self.lower_mass + self.upper_mass * (2 + ratio))

    def gravity_slope(self, rotation: np.ndarray) -> np.ndarray:
        """dG/dφ."""
        across, up, ratio, curvature = self._position(rotation)
        return self.upper_mass * across * curvature - up * (self.lower_mass + self.upper_mass * (2 + ratio))

    def ground(self, rotation: np.ndarray) -> np.ndarray:
        """(m₁ + m₂) C."""
        return (self.lower_mass + self.upper_mass) * self._position(rotation)[1]
