"""The symmetric rocking frame of equal columns under a rigid beam (Makris and Vassiliou 2013; theory: section 3)."""

from dataclasses import dataclass

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import finite
from rocking.structures.block import Block
from rocking.structures.mechanism import Mechanism
from rocking.structures.restitution import (
    Restitution,
    check_restitution,
    momentum_balance,
    resolve_restitution,
)
from rocking.structures.single_body import corner_side
from rocking.structures.structure import Structure, turned

_MOST_COLUMNS = 1000


@dataclass(frozen=True)
class Frame(Structure):
    """`columns` equal free-standing columns capped by a freely supported rigid beam; all turn by the same φ.

    column: one column. columns: how many, 2 or more. beam_mass_ratio: γ, the mass of the beam over that of all columns
    together. restitution: η in [0, 1], or "momentum" (the default), (1 − 1.5 sin²α + 3γ cos 2α)/(1 + 3γ); it needs
    columns so slender that the balance is positive. The column's own restitution plays no part.
    The rotation ends when the columns lie. Raises StructureError when it cannot stand.
    """

    column: Block
    columns: int
    beam_mass_ratio: float
    restitution: Restitution = None

    def __post_init__(self) -> None:
        if not isinstance(self.column, Block) or self.column.one_sided:
            raise StructureError(f"column is {self.column!r}, but must be a Block that rocks to both sides.")
        count = finite(StructureError, "columns", self.columns)
        if count != int(count) or not 2 <= count <= _MOST_COLUMNS:
            raise StructureError(
                f"columns is {self.columns!r}, but must be a whole number from 2 to {_MOST_COLUMNS}."
            )
        object.__setattr__(self, "columns", int(count))
        ratio = finite(StructureError, "beam_mass_ratio", self.beam_mass_ratio)
        if ratio < 0:
            raise StructureError(f"beam_mass_ratio is {self.beam_mass_ratio!r}, but must be 0 or more.")
        object.__setattr__(self, "beam_mass_ratio", ratio)
        check_restitution(self.restitution, ("momentum",))

    def _build(self) -> Mechanism:
        """I, G and B of one column and its share of the beam, divided by m R (1 + 2γ)."""
        share = (1 + 3 * self.beam_mass_ratio) / (1 + 2 * self.beam_mass_ratio)
        balances = {"momentum": self._momentum_balance}
        return Mechanism(
            corner_side(
                self.column.slenderness,
                inertia_length=4 * self.column.semi_diagonal / 3 * share,
                end_rotation=np.pi / 2,
                restitution=resolve_restitution(self.restitution, "momentum", balances),
            )
        )

    def _outline(self, rotation: float) -> list[np.ndarray]:
        """Columns 0.6 of their height apart, and a beam of their material and breadth as deep as its mass asks."""
        half, height = self.column.breadth / 2, self.column.height
        column = np.array([[-half, 0.0], [half, 0.0], [half, height], [-half, height]])
        drawn = [turned(column + np.array([x, 0.0]), [x + half, 0.0], rotation) for x in self._axes]
        if self.beam_mass_ratio == 0:
            return drawn
        left, right = self._axes[0] - half, self._axes[-1] + half
        depth = self.beam_mass_ratio * self.columns * 2 * half * height / (right - left)
        beam = np.array([[left, height], [right, height], [right, height + depth], [left, height + depth]])
        return [*drawn, beam + self._hinges(rotation)[-1] - [right - 2 * half, height]]

    def _hinges(self, rotation: float) -> np.ndarray:
        """The right bottom corner and the left top corner of every column, in two runs."""
        angle = self.column.slenderness - rotation
        bottom = np.stack([self._axes + self.column.breadth / 2, np.zeros(self.columns)], axis=1)
        return np.concatenate(
            [bottom, bottom + 2 * self.column.semi_diagonal * np.array([-np.sin(angle), np.cos(angle)])]
        )

    @property
    def _axes(self) -> np.ndarray:
        spacing = max(0.6 * self.column.height, 2 * self.column.breadth)
        return spacing * (np.arange(self.columns) - (self.columns - 1) / 2)

    def _momentum_balance(self) -> float:
        """One column (R = 1) and its share of the beam, which moves with the tops and does not turn."""
        across, up = np.sin(self.column.slenderness), np.cos(self.column.slenderness)
        before = np.array([[up, across, -1.0], [2 * up, 2 * across, 0.0]])
        return momentum_balance([1.0, self.beam_mass_ratio], [1 / 3, 0.0], before, before * [1.0, -1.0, 1.0])
