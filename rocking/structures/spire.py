"""The masonry spire, a cone or pyramid, that cracks at some height and rocks above the crack (theory: section 2)."""

from dataclasses import dataclass, replace
from typing import Annotated, ClassVar, Literal

import numpy as np

from rocking.errors import StructureError
from rocking.structures.drawing import Path, span
from rocking.structures.fields import OneSided, Value, length, restitution_value
from rocking.structures.linkage import STILL, Restitution, Turning
from rocking.structures.structure import Crackable

_SPREAD = {"circular": 3 / 20, "square": 1 / 5}
"""Mean square of one horizontal coordinate over a solid cone or pyramid, in squares of its half width."""


@dataclass(frozen=True)
class Spire(Crackable):
    """A cone (plan "circular") or a square pyramid ("square") that rocks about the edge of a horizontal crack.

    width: at the base, diameter or side, m. height: of the whole spire, m. wall_thickness: horizontal thickness of a
    hollow one, m, the inner surface parallel to the outer; None when it is solid. crack_height: above the base, m.
    restitution, one_sided: as for a RigidBody.
    Raises StructureError when it cannot stand, or the crack lies outside it.

    >>> rocking.Spire(width=3.0, height=15.0, wall_thickness=0.25, crack_height=5.0).mechanism()
    Mechanism(λ = 0.3383, φ_cr = 0.3262 rad, p = 1.458 rad/s, η = 0.861)
    """

    type_name: ClassVar[str] = "spire"
    crack_name: ClassVar[str] = "crack"
    described_as: ClassVar[dict[str, str]] = {
        "": "Cone or square pyramid, solid or hollow, that rocks above a horizontal crack"
    }

    width: Annotated[float, length("Diameter or side at the base", 3.0, (0.2, 20), "b")]
    height: Annotated[float, length("Height of the whole spire", 15.0, (0.5, 100), "h")]
    wall_thickness: Annotated[
        float | None, length("Horizontal thickness of the wall of a hollow one", 0.25, (0.05, 3), "t")
    ] = None
    plan: Annotated[
        Literal["circular", "square"],
        Value("Shape of a horizontal section", "circular", phrase="{value} plan"),
    ] = "circular"
    crack_height: Annotated[float, Value("Height of the crack above the base", 5.0, "m", (0, 95), "z")] = 0.0
    restitution: Annotated[Restitution, restitution_value("momentum", "housner")] = None
    one_sided: OneSided = False

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.wall_thickness is not None and self.wall_thickness >= self.width / 2:
            raise StructureError(
                f"wall_thickness is {self.wall_thickness!r} m, but must be less than half the width, "
                f"{self.width / 2!r} m; leave it out for a solid spire."
            )
        if self.crack_height >= self.height:
            raise StructureError(
                f"crack_height is {self.crack_height!r} m, but must lie on the spire, "
                f"from 0 to below its height of {self.height!r} m."
            )

    @property
    def half_width(self) -> float:
        """Half the width at the crack, m."""
        return self.width / 2 * (1 - self.crack_height / self.height)

    def _linkage(self, mirrored: bool) -> Turning:
        """All above the crack, the outer solid less the similar inner one, until the flank lies on the ground."""
        solid = self._solid(self.half_width)
        if self.wall_thickness is not None:
            solid -= self._solid(max(self.half_width - self.wall_thickness, 0.0))
        mass, first, second, across = solid
        centre = first / mass
        return Turning(
            self.half_width + 1j * self.crack_height,
            [1.0],
            [1j * (self.crack_height + centre)],
            [(second + across) / mass - centre**2],
            end_rotation=float(np.pi - np.arctan2(2 * self.height, self.width)),
        )

    def _solid(self, half_width: float) -> np.ndarray:
        """Volume and integrals of z, z² and x² of a solid of that half width and this spire's slope, up to a factor."""
        height = 2 * half_width / self.width * self.height
        moments = np.array([1.0, height / 4, height**2 / 10, _SPREAD[self.plan] * half_width**2])
        return half_width**2 * height * moments

    def cracked_at(self, height: float) -> "Spire":
        return replace(self, crack_height=height)

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        base, half, crack = self.width / 2, self.half_width, 1j * self.crack_height
        top = np.array([-half + crack, half + crack, 1j * self.height])
        still = np.array([-base, base, half + crack, -half + crack])
        return [(STILL, still), (0, top)][0 if self.crack_height else 1 :]

    def _dimensions(self) -> dict[str, Path]:
        half, apart = self.width / 2, 0.06 * self.height
        paths = {
            "width": span([-half, 0.0], [half, 0.0], [0.0, -apart]),
            "height": span([-half, 0.0], [-half, self.height], [-apart, 0.0]),
        }
        if self.crack_height > 0:
            paths["crack_height"] = span([half, 0.0], [half, self.crack_height], [apart, 0.0])
        if self.wall_thickness is not None:
            paths["wall_thickness"] = span([half - self.wall_thickness, 0.0], [half, 0.0])
        return paths
