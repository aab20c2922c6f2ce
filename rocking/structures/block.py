"""The free-standing rectangular block (Housner 1963)."""

from dataclasses import dataclass

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import finite, length
from rocking.structures.mechanism import Mechanism
from rocking.structures.restitution import (
    Restitution,
    check_restitution,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.single_body import corner_side
from rocking.structures.structure import Structure, turned


@dataclass(frozen=True)
class Block(Structure):
    """A homogeneous rectangular block that rocks about its two bottom corners.

    semi_diagonal: R, m. slenderness: α, rad, in (0, π/2); tan α = breadth/height.
    restitution: η in [0, 1]; "momentum" or "housner" (the same balance, 1 − 1.5 sin²α, the default). A
    one-sided block leans on something that no balance of the block alone describes, so it needs a number.
    one_sided: it rocks away from what it leans on only, and is thrown back at every impact.
    Raises StructureError when it cannot stand.
    """

    semi_diagonal: float
    slenderness: float
    restitution: Restitution = None
    one_sided: bool = False

    def __post_init__(self) -> None:
        object.__setattr__(self, "semi_diagonal", length("semi_diagonal", self.semi_diagonal))
        slenderness = finite(StructureError, "slenderness", self.slenderness, "rad")
        if not 0 < slenderness < np.pi / 2:
            raise StructureError(
                f"slenderness is {slenderness!r} rad, but must lie between 0 and π/2 = 1.5708 rad "
                "for a block to stand."
            )
        object.__setattr__(self, "slenderness", slenderness)
        check_restitution(self.restitution, ("momentum", "housner"), self.one_sided)

    @classmethod
    def of_size(
        cls, breadth: float, height: float, restitution: Restitution = None, one_sided: bool = False
    ) -> "Block":
        """Return the block of that breadth and height [m]."""
        breadth, height = length("breadth", breadth), length("height", height)
        return cls(np.hypot(breadth, height) / 2, np.arctan2(breadth, height), restitution, one_sided)

    @property
    def breadth(self) -> float:
        """2R sin α, m."""
        return 2 * self.semi_diagonal * np.sin(self.slenderness)

    @property
    def height(self) -> float:
        """2R cos α, m."""
        return 2 * self.semi_diagonal * np.cos(self.slenderness)

    def _build(self) -> Mechanism:
        balances = {"momentum": self._momentum_balance, "housner": self._momentum_balance}
        side = corner_side(
            self.slenderness,
            inertia_length=4 * self.semi_diagonal / 3,
            end_rotation=np.pi / 2,  # it lies on its side
            restitution=resolve_restitution(self.restitution, "housner", balances),
        )
        return Mechanism(side, one_sided=self.one_sided)

    def _outline(self, rotation: float) -> list[np.ndarray]:
        half, height = self.breadth / 2, self.height
        corners = [[-half, 0.0], [half, 0.0], [half, height], [-half, height]]
        return [turned(corners, self._hinges(rotation)[0], rotation)]

    def _hinges(self, rotation: float) -> np.ndarray:
        return np.array([[self.breadth / 2, 0.0]])

    def _momentum_balance(self) -> float:
        across, up = np.sin(self.slenderness), np.cos(self.slenderness)
        return momentum_balance([1.0], [1 / 3], [[up, across, -1.0]], [[up, -across, -1.0]])
