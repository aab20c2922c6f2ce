"""Rigid bodies that rock about a corner: the rectangular block (Housner 1963), and any other (theory: section 2)."""

from dataclasses import dataclass, replace
from typing import Annotated, ClassVar

import numpy as np

from rocking.structures.bodies import (
    Bodies,
    Contacts,
    MotionState,
    Restitution,
    body_about,
    corner,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.drawing import Path, rectangle, span, swept, turned
from rocking.structures.fields import OneSided, Value, length, restitution_value
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.structure import Structure


def corner_side(slenderness: float, inertia_length: float, end_rotation: float, restitution: float) -> Side:
    """Return the Side of a body whose centre of mass lies at a distance R from the corner.

    slenderness: α, angle between the vertical and the line from the corner to the centre of mass, rad.
    inertia_length: I_O/(mR), m; 4R/3 for a rectangular block.
    I = I_O/(mR), G = sin(α − φ), B = cos(α − φ), φ_cr = α (Eq. 1).
    """
    return Side(
        inertia=lambda rotation: np.full_like(rotation, inertia_length, dtype=float),
        inertia_slope=lambda rotation: np.zeros_like(rotation, dtype=float),
        gravity=lambda rotation: np.sin(slenderness - rotation),
        gravity_slope=lambda rotation: -np.cos(slenderness - rotation),
        ground=lambda rotation: np.cos(slenderness - rotation),
        critical_rotation=slenderness,
        end_rotation=end_rotation,
        restitution=restitution,
    )


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
        restitution: Balanced = None,
        one_sided: OneSided = False,
    ) -> "Block":
        """Return the block of that breadth and height [m]."""
        cls.check_values("of_size", breadth=breadth, height=height)
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
        side = corner_side(
            self.slenderness,
            inertia_length=4 * self.semi_diagonal / 3,
            end_rotation=np.pi / 2,  # it lies on its side
            restitution=resolve_restitution(self.restitution, "housner", self._momentum_balance),
        )
        return Mechanism(side, one_sided=self.one_sided)

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        return body_about(
            self.breadth / 2, 0.5j * self.height, (self.breadth**2 + self.height**2) / 12, rotation
        )

    def contacts(self, state: MotionState) -> Contacts:
        return corner(self.breadth / 2, self.height / 2, state)

    def _outline(self, rotation: float) -> list[np.ndarray]:
        half = self.breadth / 2
        return [turned(rectangle(-half, half, 0.0, self.height), self._hinges(rotation)[0], rotation)]

    def _hinges(self, rotation: float) -> np.ndarray:
        return np.array([[self.breadth / 2, 0.0]])

    def _dimensions(self) -> dict[str, Path]:
        half, height, apart = self.breadth / 2, self.height, 0.06 * self.height
        foot = np.array([half, 0.0])
        return {
            "breadth": span([-half, height], [half, height], [0.0, apart]),
            "height": span([-half, 0.0], [-half, height], [-apart, 0.0]),
            "semi_diagonal": span(foot, [0.0, height / 2]),
            "slenderness": swept(foot, 0.7 * self.semi_diagonal, -self.slenderness, 0.0),
        }

    def _momentum_balance(self) -> float:
        across, up = np.sin(self.slenderness), np.cos(self.slenderness)
        return momentum_balance([1.0], [1 / 3], [[up, across, -1.0]], [[up, -across, -1.0]])


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

    def _build(self) -> Mechanism:
        positive_side = self.side(self.right, self.left)
        if self.one_sided or self.left == self.right:
            return Mechanism(positive_side, one_sided=self.one_sided)
        return Mechanism(positive_side, self.side(self.left, self.right))

    def side(self, corner: float, other: float, end_rotation: float | None = None) -> Side:
        """Return the Side of rocking about the corner at distance `corner` [m], landing on the one at `other`."""
        slenderness = float(np.arctan2(corner, self.centre_height))
        semi_diagonal = float(np.hypot(corner, self.centre_height))
        return corner_side(
            slenderness,
            inertia_length=(self.inertia + semi_diagonal**2) / semi_diagonal,
            end_rotation=slenderness + np.pi / 2 if end_rotation is None else end_rotation,
            restitution=resolve_restitution(
                self.restitution, "momentum", lambda: self._momentum_balance(corner, other)
            ),
        )

    def _mirrored(self) -> "RigidBody":
        return replace(self, left=self.right, right=self.left)

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        return body_about(self.right, 1j * self.centre_height, self.inertia, rotation)

    def contacts(self, state: MotionState) -> Contacts:
        return corner(np.where(state.sign > 0, self.right, self.left), self.centre_height, state)

    def _outline(self, rotation: float) -> list[np.ndarray]:
        """The parallelogram with these corners and this centre of mass, for want of the true outline."""
        top = 2 * self.centre_height
        corners = [[-self.left, 0.0], [self.right, 0.0], [self.left, top], [-self.right, top]]
        return [turned(corners, self._hinges(rotation)[0], rotation)]

    def _hinges(self, rotation: float) -> np.ndarray:
        return np.array([[self.right, 0.0]])

    def _dimensions(self) -> dict[str, Path]:
        apart, centre = np.array([0.0, -0.12 * self.centre_height]), [0.0, self.centre_height]
        return {
            "left": span([-self.left, 0.0], [0.0, 0.0], apart),
            "right": span([0.0, 0.0], [self.right, 0.0], 2 * apart),
            "centre_height": span([0.0, 0.0], centre),
        }

    def _momentum_balance(self, corner: float, other: float) -> float:
        up = self.centre_height
        return momentum_balance([1.0], [self.inertia], [[up, corner, -1.0]], [[up, -other, -1.0]])
