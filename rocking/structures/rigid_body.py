"""Any rigid body that rocks about two corners, its mass off centre if need be (theory: section 2)."""

from dataclasses import dataclass, replace
from typing import ClassVar

import numpy as np

from rocking.quantities import LENGTHS
from rocking.structures.bars import Bodies, body_about
from rocking.structures.contacts import Contacts, MotionState, corner
from rocking.structures.drawing import Path, span, turned
from rocking.structures.fields import ONE_SIDED, Form, length_field, number_field, restitution_field
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.restitution import Restitution, momentum_balance, resolve_restitution
from rocking.structures.single_body import corner_side
from rocking.structures.structure import Structure


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
    """

    type_name: ClassVar[str] = "rigid_body"
    forms: ClassVar[tuple[Form, ...]] = (
        Form(
            "Any body by its centre of mass and its inertia about it per mass",
            (
                length_field("left", "Distance of the left corner", 0.4, (0.01, 20), "l"),
                length_field("right", "Distance of the right corner", 0.6, (0.01, 20), "r"),
                length_field("centre_height", "Height of the centre of mass", 2.0, (0.05, 50), "z"),
                number_field(
                    "inertia",
                    "Inertia about the centre of mass per mass",
                    "m²",
                    1.5,
                    (1e-4, 1e3),
                    bounds={"minimum": LENGTHS[0] ** 2, "maximum": LENGTHS[1] ** 2},
                    required=True,
                ),
                restitution_field("momentum", "housner"),
                ONE_SIDED,
            ),
        ),
    )

    left: float
    right: float
    centre_height: float
    inertia: float
    restitution: Restitution = None
    one_sided: bool = False

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
