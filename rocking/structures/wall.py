"""The masonry wall that bends out of plane about a hinge at any height (Fig. 2; theory: section 4)."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import finite, length
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.restitution import (
    Restitution,
    check_restitution,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.structure import Structure, turned
from rocking.structures.wall_linkage import WallLinkage


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
            object.__setattr__(self, name, length(name, getattr(self, name)))
        check_restitution(self.restitution, ("momentum",))

    @classmethod
    def hinged_at(
        cls, height: float, hinge_height: float, thickness: float, restitution: Restitution = None
    ) -> "Wall":
        """Return the wall of that total height whose hinge lies at `hinge_height` [m] above the base."""
        height = length("height", height)
        hinge = finite(StructureError, "hinge_height", hinge_height, "m")
        if not 0 < hinge < height:
            raise StructureError(
                f"hinge_height is {hinge!r} m, but must lie inside the wall, "
                f"between 0 and its height of {height!r} m."
            )
        return cls(hinge, height - hinge, thickness, restitution)

    @property
    def height(self) -> float:
        """h₁ + h₂, m."""
        return self.lower_height + self.upper_height

    def _build(self) -> Mechanism:
        linkage = self.linkage
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
    def linkage(self) -> WallLinkage:
        """The two blocks as a linkage on the side of positive rotation."""
        return WallLinkage(self.lower_height, self.upper_height, self.thickness)

    def _momentum_balance(self) -> float:
        """Velocities (vx, vy, clockwise ω) at φ = 0; the mirrored mechanism continues the same turn."""
        h1, h2, t = self.lower_height, self.upper_height, self.thickness
        ratio = h1 / h2
        lower = [h1 / 2, t / 2, 1.0]
        upper = [h1 / 2, t + ratio * t / 2, -ratio]
        inertias = [h1 * (h1**2 + t**2) / 12, h2 * (h2**2 + t**2) / 12]
        before = np.array([lower, upper])
        return momentum_balance([h1, h2], inertias, before, before * [1.0, -1.0, 1.0])

    def candidates(self, hinge_heights: Iterable[float]) -> dict[float, "Wall"]:
        """Return this wall hinged at each of `hinge_heights` [m] above the base instead, by height."""
        return {
            float(hinge): Wall.hinged_at(self.height, hinge, self.thickness, restitution=self.restitution)
            for hinge in hinge_heights
        }

    def _outline(self, rotation: float) -> list[np.ndarray]:
        half, psi = self.thickness / 2, self.linkage.motion(rotation).angles[1]
        base, hinge, _ = self._hinges(rotation)
        lower = [[-half, 0.0], [half, 0.0], [half, self.lower_height], [-half, self.lower_height]]
        upper = hinge + np.array(
            [[0.0, 0.0], [2 * half, 0.0], [2 * half, self.upper_height], [0.0, self.upper_height]]
        )
        return [turned(lower, base, rotation), turned(upper, hinge, -psi)]

    def _hinges(self, rotation: float) -> np.ndarray:
        """Right corner of the base, left edge at the hinge, right corner of the top."""
        hinges = self.linkage.motion(rotation).hinges
        return np.stack([hinges.real, hinges.imag], axis=1)
