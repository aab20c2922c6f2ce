"""Rigid bodies that rock about a corner: the rectangular block (Housner 1963), and any other (theory: section 2)."""

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

import numpy as np

from rocking.structures.drawing import Path, rectangle, span, swept
from rocking.structures.fields import OneSided, Value, length, restitution_value
from rocking.structures.linkage import Restitution, Turning
from rocking.structures.structure import Structure

Balanced = Annotated[Restitution, restitution_value("momentum", "housner")]


@dataclass(frozen=True)
class Block(Structure):
    """A homogeneous rectangular block that rocks about its two bottom corners.

    semi_diagonal: R, m. slenderness: α, rad, in (0, π/2); tan α = breadth/height.
    restitution: η in [0, 1]; "momentum" or "housner" (the same balance, 1 − 1.5 sin²α, the default). A
    one-sided block leans on something that no balance of the block alone describes, so it needs a number.
    one_sided: it rocks away from what it leans on only, and is thrown back at every impact.
    Raises StructureError when it cannot stand.

    >>> rocking.Block(semi_diagonal=2.0, slenderness=0.2).mechanism()
    Mechanism(λ = 0.2027, φ_cr = 0.2 rad, p = 1.918 rad/s, η = 0.9408)
    """

    type_name: ClassVar[str] = "block"
    described_as: ClassVar[dict[str, str]] = {
        "of_size": "Rectangular block by its size",
        "": "Rectangular block by half its diagonal and its slenderness",
    }

    semi_diagonal: Annotated[
        float, length("Half the diagonal", 2.0, (0.05, 50), "R", "semi-diagonal {value}")
    ]
    slenderness: Annotated[
        float,
        Value(
            "Angle between the vertical and the diagonal", 10.0, "°", (1, 45), "α", bounds={"gt": 0, "lt": 90}
        ),
    ]
    restitution: Balanced = None
    one_sided: OneSided = False

    @classmethod
    def of_size(
        cls,
        breadth: Annotated[float, length("Breadth", 0.6, (0.02, 20), "b")],
        height: Annotated[float, length("Height", 4.0, (0.1, 100), "h")],
        *values: Any,
        **options: Any,
    ) -> "Block":
        """Return the block of that breadth and height [m]; values and options as for the class."""
        cls.check_values("of_size", breadth=breadth, height=height)
        return cls(np.hypot(breadth, height) / 2, np.arctan2(breadth, height), *values, **options)

    @property
    def breadth(self) -> float:
        """2R sin α, m."""
        return 2 * self.semi_diagonal * np.sin(self.slenderness)

    @property
    def height(self) -> float:
        """2R cos α, m."""
        return 2 * self.semi_diagonal * np.cos(self.slenderness)

    def _linkage(self, mirrored: bool) -> Turning:
        inertia = (self.breadth**2 + self.height**2) / 12
        return Turning(self.breadth / 2, [1.0], [0.5j * self.height], [inertia], slenderness=self.slenderness)

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        return [(0, rectangle(-self.breadth / 2, self.breadth / 2, 0.0, self.height))]

    def _dimensions(self) -> dict[str, Path]:
        half, height, apart = self.breadth / 2, self.height, 0.06 * self.height
        foot = np.array([half, 0.0])
        return {
            "breadth": span([-half, height], [half, height], [0.0, apart]),
            "height": span([-half, 0.0], [-half, height], [-apart, 0.0]),
            "semi_diagonal": span(foot, [0.0, height / 2]),
            "slenderness": swept(foot, 0.7 * self.semi_diagonal, -self.slenderness, 0.0),
        }


@dataclass(frozen=True)
class RigidBody(Structure):
    """A body known by its centre of mass and inertia; it rocks about the right corner on the positive side.

    left, right: horizontal distance of the left and the right corner from the centre of mass, m. centre_height: height
    of the centre of mass above the corners, m. inertia: about the centre of mass, per mass, m².
    restitution: η in [0, 1] on both sides, or "momentum" or "housner" (the same balance, the default): angular momentum
    about the corner to come, which differs from side to side. A one-sided body needs a number.
    one_sided: it rocks about the right corner only, and is thrown back at every impact.
    Its outline is not known, so each side is followed until the centre of mass is level with the corner.
    Raises StructureError when it cannot stand.

    >>> body = rocking.RigidBody(left=0.4, right=0.6, centre_height=1.5, inertia=1.0)
    >>> body.mechanism().negative
    Side(λ = 0.2667, φ_cr = 0.2606 rad, p = 2.113 rad/s, η = 0.8338)
    """

    type_name: ClassVar[str] = "rigid_body"
    described_as: ClassVar[dict[str, str]] = {
        "": "Any body by its centre of mass and its inertia about it per mass"
    }

    left: Annotated[float, length("Distance of the left corner", 0.4, (0.01, 20), "l")]
    right: Annotated[float, length("Distance of the right corner", 0.6, (0.01, 20), "r")]
    centre_height: Annotated[float, length("Height of the centre of mass", 2.0, (0.05, 50), "z")]
    inertia: Annotated[
        float,
        Value(
            "Inertia about the centre of mass per mass",
            1.5,
            "m²",
            (1e-4, 1e3),
            bounds={"ge": 1e-8, "le": 1e10},
        ),
    ]
    restitution: Balanced = None
    one_sided: OneSided = False

    @property
    def symmetric(self) -> bool:
        """Whether the centre of mass is in the middle."""
        return self.left == self.right

    def _linkage(self, mirrored: bool) -> Turning:
        """Until the centre of mass is level with the corner."""
        corner, centre = self.left if mirrored else self.right, 1j * self.centre_height
        end = np.arctan2(corner, self.centre_height) + np.pi / 2
        return Turning(corner, [1.0], [centre], [self.inertia], end_rotation=float(end))

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """The parallelogram with these corners and this centre of mass, for want of the true outline."""
        top = 2j * self.centre_height
        return [(0, np.array([-self.left, self.right, self.left + top, -self.right + top]))]

    def _dimensions(self) -> dict[str, Path]:
        apart, centre = np.array([0.0, -0.12 * self.centre_height]), [0.0, self.centre_height]
        return {
            "left": span([-self.left, 0.0], [0.0, 0.0], apart),
            "right": span([0.0, 0.0], [self.right, 0.0], 2 * apart),
            "centre_height": span([0.0, 0.0], centre),
        }
