"""The free-standing rectangular block (Housner 1963)."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import length
from rocking.structures.bars import Bodies, body_about
from rocking.structures.contacts import Contacts, MotionState, corner
from rocking.structures.drawing import Path, rectangle, span, swept, turned
from rocking.structures.fields import ONE_SIDED, Form, length_field, number_field, restitution_field
from rocking.structures.mechanism import Mechanism
from rocking.structures.restitution import Restitution, momentum_balance, resolve_restitution
from rocking.structures.single_body import corner_side
from rocking.structures.structure import Structure

_OPTIONS = (restitution_field("momentum", "housner"), ONE_SIDED)


@dataclass(frozen=True)
class Block(Structure):
    """A homogeneous rectangular block that rocks about its two bottom corners.

    semi_diagonal: R, m. slenderness: α, rad, in (0, π/2); tan α = breadth/height.
    restitution: η in [0, 1]; "momentum" or "housner" (the same balance, 1 − 1.5 sin²α, the default). A
    one-sided block leans on something that no balance of the block alone describes, so it needs a number.
    one_sided: it rocks away from what it leans on only, and is thrown back at every impact.
    Raises StructureError when it cannot stand.
    """

    type_name: ClassVar[str] = "block"
    forms: ClassVar[tuple[Form, ...]] = (
        Form(
            "Rectangular block by its size",
            (
                length_field("breadth", "Breadth", 0.6, (0.02, 20), "b"),
                length_field("height", "Height", 4.0, (0.1, 100), "h"),
                *_OPTIONS,
            ),
            make="of_size",
        ),
        Form(
            "Rectangular block by half its diagonal and its slenderness",
            (
                length_field(
                    "semi_diagonal", "Half the diagonal", 2.0, (0.05, 50), "R", phrase="semi-diagonal {value}"
                ),
                number_field(
                    "slenderness",
                    "Angle between the vertical and the diagonal",
                    "°",
                    10.0,
                    (1, 45),
                    "α",
                    {"exclusiveMinimum": 0, "exclusiveMaximum": 90},
                    required=True,
                ),
                *_OPTIONS,
            ),
        ),
    )

    semi_diagonal: float
    slenderness: float
    restitution: Restitution = None
    one_sided: bool = False

    def __post_init__(self) -> None:
        super().__post_init__()
        if not 0 < self.slenderness < np.pi / 2:
            raise StructureError(
                f"slenderness is {self.slenderness!r} rad, but must lie between 0 and π/2 = 1.5708 rad "
                "for a block to stand."
            )

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
