"""The symmetric rocking frame of equal columns under a rigid beam (Makris and Vassiliou 2013; theory: section 3)."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.structures.block import Block, corner_side
from rocking.structures.bodies import (
    Bodies,
    Contacts,
    MotionState,
    Restitution,
    UnknownContacts,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.drawing import Path, rectangle, span, turned
from rocking.structures.fields import Value, count, length, restitution_value
from rocking.structures.mechanism import Mechanism
from rocking.structures.structure import Structure

Columns = Annotated[int, count("How many columns", 4, 2, 1000)]
BeamMassRatio = Annotated[
    float, Value("Mass of the beam over that of all columns", 0.3, usual=(0, 20), letter="γ")
]
Balanced = Annotated[Restitution, restitution_value("momentum")]


@dataclass(frozen=True)
class Frame(Structure):
    """`columns` equal free-standing columns capped by a freely supported rigid beam; all turn by the same φ.

    column: one column. columns: how many, 2 or more. beam_mass_ratio: γ, the mass of the beam over that of all columns
    together. restitution: η in [0, 1], or "momentum" (the default), (1 − 1.5 sin²α + 3γ cos 2α)/(1 + 3γ); it needs
    columns so slender that the balance is positive. The column's own restitution plays no part.
    The rotation ends when the columns lie. Raises StructureError when it cannot stand.

    >>> column = rocking.Block.of_size(breadth=1.1, height=8.0)
    >>> rocking.Frame(column, columns=4, beam_mass_ratio=0.3).mechanism()
    Mechanism(λ = 0.1375, φ_cr = 0.1366 rad, p = 1.239 rad/s, η = 0.9678)
    """

    type_name: ClassVar[str] = "frame"
    described_as: ClassVar[dict[str, str]] = {
        "of_columns": "Symmetric frame of equal columns under a rigid beam"
    }

    column: Block
    columns: Columns
    beam_mass_ratio: BeamMassRatio
    restitution: Balanced = None

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.column, Block) or self.column.one_sided:
            raise StructureError(f"column is {self.column!r}, but must be a Block that rocks to both sides.")

    @classmethod
    def of_columns(
        cls,
        column_breadth: Annotated[float, length("Breadth of a column", 1.0, (0.05, 10), "b")],
        column_height: Annotated[float, length("Height of a column", 8.0, (0.5, 60), "h")],
        columns: Columns,
        beam_mass_ratio: BeamMassRatio,
        restitution: Balanced = None,
    ) -> "Frame":
        """Return the frame whose columns have that breadth and height [m]."""
        return cls(Block.of_size(column_breadth, column_height), columns, beam_mass_ratio, restitution)

    @property
    def column_breadth(self) -> float:
        """Breadth of a column, m."""
        return self.column.breadth

    @property
    def column_height(self) -> float:
        """Height of a column, m."""
        return self.column.height

    def _build(self) -> Mechanism:
        """I, G and B of one column and its share of the beam, divided by m R (1 + 2γ)."""
        share = (1 + 3 * self.beam_mass_ratio) / (1 + 2 * self.beam_mass_ratio)
        return Mechanism(
            corner_side(
                self.column.slenderness,
                inertia_length=4 * self.column.semi_diagonal / 3 * share,
                end_rotation=np.pi / 2,
                restitution=resolve_restitution(self.restitution, "momentum", self._momentum_balance),
            )
        )

    def bodies(self, rotation: float | np.ndarray) -> Bodies:
        """All columns, and the beam, whose centre is taken on its lower edge: it does not turn."""
        one = self.column.bodies(rotation)
        shape = (-1, *[1] * np.ndim(rotation))
        axes = self._axes.reshape(shape)
        top = self.column.breadth / 2 + 2 * self.column.semi_diagonal * 1j * np.exp(
            1j * (self.column.slenderness - np.asarray(rotation, dtype=float))
        )
        return Bodies(
            np.append(np.ones(self.columns), self.columns * self.beam_mass_ratio),
            np.append(np.full(self.columns, one.inertias[0]), 0.0),
            np.concatenate([axes + one.centres, top[None]]),
            np.concatenate([0 * axes + one.turns, 0 * one.turns]),
        )

    def contacts(self, state: MotionState) -> Contacts:
        """Not known: each column stands between two contacts that share its load as they like."""
        raise UnknownContacts("contact forces of a frame are statically indeterminate")

    def _outline(self, rotation: float) -> list[np.ndarray]:
        """Columns 0.6 of their height apart, and a beam of their material and breadth as deep as its mass asks."""
        half, height = self.column.breadth / 2, self.column.height
        column = rectangle(-half, half, 0.0, height)
        drawn = [turned(column + np.array([x, 0.0]), [x + half, 0.0], rotation) for x in self._axes]
        if self.beam_mass_ratio == 0:
            return drawn
        left, right = self._axes[0] - half, self._axes[-1] + half
        depth = self.beam_mass_ratio * self.columns * 2 * half * height / (right - left)
        beam = rectangle(left, right, height, height + depth)
        return [*drawn, beam + self._hinges(rotation)[-1] - [right - 2 * half, height]]

    def _hinges(self, rotation: float) -> np.ndarray:
        """The right bottom corner and the left top corner of every column, in two runs."""
        angle = self.column.slenderness - rotation
        bottom = np.stack([self._axes + self.column.breadth / 2, np.zeros(self.columns)], axis=1)
        return np.concatenate(
            [bottom, bottom + 2 * self.column.semi_diagonal * np.array([-np.sin(angle), np.cos(angle)])]
        )

    def _dimensions(self) -> dict[str, Path]:
        first, half, height = self._axes[0], self.column.breadth / 2, self.column.height
        apart = 0.06 * height
        return {
            "column_breadth": span([first - half, 0.0], [first + half, 0.0], [0.0, -apart]),
            "column_height": span([first - half, 0.0], [first - half, height], [-apart, 0.0]),
        }

    @property
    def _axes(self) -> np.ndarray:
        spacing = max(0.6 * self.column.height, 2 * self.column.breadth)
        return spacing * (np.arange(self.columns) - (self.columns - 1) / 2)

    def _momentum_balance(self) -> float:
        """One column (R = 1) and its share of the beam, which moves with the tops and does not turn."""
        across, up = np.sin(self.column.slenderness), np.cos(self.column.slenderness)
        before = np.array([[up, across, -1.0], [2 * up, 2 * across, 0.0]])
        return momentum_balance([1.0, self.beam_mass_ratio], [1 / 3, 0.0], before, before * [1.0, -1.0, 1.0])
