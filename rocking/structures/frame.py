"""The symmetric rocking frame of equal columns under a rigid beam (Makris and Vassiliou 2013; theory: section 3)."""

from dataclasses import dataclass, field, replace
from typing import Annotated, Any, ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.structures.block import Block
from rocking.structures.crackable import Crushable
from rocking.structures.drawing import Path, plane, rectangle, span
from rocking.structures.fields import OptionalUnitWeight, Value, count, length, restitution_value, stated
from rocking.structures.kinds import StructureKind
from rocking.structures.linkage import (
    Contacts,
    Hung,
    Kinematics,
    MotionState,
    Parts,
    PointMotion,
    Restitution,
    Turning,
    UnknownContacts,
    inset,
    keeps_last,
)
from rocking.structures.stones import Stones, chain
from rocking.warnings import RockingWarning

Columns = Annotated[int, count("How many columns", 4, 2, 1000)]
BeamMassRatio = Annotated[
    float, Value("Mass of the beam over that of all columns", 0.3, usual=(0, 20), letter="γ")
]
Balanced = Annotated[Restitution, restitution_value("momentum")]


@stated
@dataclass(frozen=True, repr=False)
class Frame(Crushable):
    """`columns` equal free-standing columns capped by a freely supported rigid beam; all turn by the same φ.

    The rotation ends when the columns lie.

    Examples
    --------
    >>> column = rocking.Block.of_size(breadth=1.1, height=8.0)
    >>> rocking.Frame(column, columns=4, beam_mass_ratio=0.3).mechanism()
    Mechanism(λ = 0.1375, φ_cr = 0.1366 rad, p = 1.239 rad/s, η = 0.9678)
    """

    type_name: ClassVar[str] = "frame"
    _described_as: ClassVar[dict[str, str]] = {
        "of_columns": "Symmetric frame of equal columns under a rigid beam"
    }

    column: Annotated[Block, "One column; its own restitution plays no part"]
    columns: Columns
    beam_mass_ratio: BeamMassRatio
    restitution: Balanced = None
    unit_weight: OptionalUnitWeight = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        if not isinstance(self.column, Block) or self.column.one_sided:
            raise StructureError(
                f"column is {self.column!r}, but must be a Block that rocks to both sides.",
                column=self.column,
            )
        self._stand_crushed()

    @classmethod
    def of_columns(
        cls,
        column_breadth: Annotated[float, length("Breadth of a column", 1.0, (0.05, 10), "b")],
        column_height: Annotated[float, length("Height of a column", 8.0, (0.5, 60), "h")],
        columns: Columns,
        beam_mass_ratio: BeamMassRatio,
        restitution: Restitution = None,
        **options: Any,
    ) -> "Frame":
        """Return the frame whose columns have that breadth and height [m]; the others as for the class."""
        column = Block.of_size(column_breadth, column_height)
        return cls(column, columns, beam_mass_ratio, restitution, **options)

    @property
    def _leaves_out(self) -> RockingWarning:
        """What nobody knows of its contacts."""
        return RockingWarning(StructureKind.FRAME_CONTACTS)

    @property
    def column_breadth(self) -> float:
        """Breadth of a column, m."""
        return self.column.breadth

    @property
    def column_height(self) -> float:
        """Height of a column, m."""
        return self.column.height

    def _linkage(self, mirrored: bool) -> "FrameLinkage":
        breadth = self.column.breadth
        weight = (self.unit_weight or 0.0) * breadth * self.column.height
        beam = self.beam_mass_ratio * weight
        strength = self.compressive_strength
        insets = (
            inset(pressing=weight + beam, strength=strength, breadth=breadth),
            inset(pressing=beam, strength=strength, breadth=breadth),
        )
        return FrameLinkage(self.column, self._axes, self.beam_mass_ratio, insets)

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        """Columns 0.6 of their height apart, and a beam of their material and breadth as deep as its mass asks."""
        half = self.column.breadth / 2
        height = self.column.height
        column = rectangle(-half, half, 0.0, height)
        outlines = [(n, column + x) for n, x in enumerate(self._axes)]
        left = self._axes[0] - half
        right = self._axes[-1] + half
        depth = self.beam_mass_ratio * self.columns * 2 * half * height / (right - left)
        if self.beam_mass_ratio:
            outlines.append((self.columns, rectangle(left, right, height, height + depth)))
        return outlines

    @property
    def _joints_do(self) -> dict[str, Any]:
        """A beam on more than two columns is no chain."""
        return {"as_stones": "as columns and beam"} if self.columns == 2 and self.beam_mass_ratio else {}

    def stones(self, voussoirs: int | None = None) -> Stones:
        """Return the two columns and the beam on them, spaced as they are drawn; voussoirs: None, as it has none."""
        if not self.joints.as_stones or voussoirs is not None:
            raise StructureError(
                f"a frame of {self.columns} columns with a beam_mass_ratio of {self.beam_mass_ratio!r} is asked for as "
                f"{'stones' if voussoirs is None else f'{voussoirs} voussoirs'}, but only two columns below a beam are "
                "a chain of stones, which has no voussoirs.",
                columns=self.columns,
            )
        left, right, beam = (corners for _, corners in self._parts())
        foot, head = [0, 1], [3, 2]
        faces = [plane(left[foot]), plane(left[head]), plane(right[head[::-1]]), plane(right[foot[::-1]])]
        bodies = left, beam, right
        sizes = np.array([[np.ptp(body.real), np.ptp(body.imag)] for body in bodies])
        masses = sizes.prod(axis=1)
        centres = plane(np.array([body.mean() for body in bodies]))
        return chain(faces, masses, centres, masses * (sizes**2).sum(axis=1) / 12)

    def _dimensions(self) -> dict[str, Path]:
        first = self._axes[0]
        half = self.column.breadth / 2
        height = self.column.height
        apart = 0.06 * height
        return {
            "column_breadth": span([first - half, 0.0], [first + half, 0.0], [0.0, -apart]),
            "column_height": span([first - half, 0.0], [first - half, height], [-apart, 0.0]),
        }

    @property
    def _axes(self) -> np.ndarray:
        spacing = max(0.6 * self.column.height, 2 * self.column.breadth)
        return spacing * (np.arange(self.columns) - (self.columns - 1) / 2)


class FrameLinkage(Turning):
    """Columns of mass 1 that all turn by the same φ as the first does, and the beam that rests on their heads.

    The beam does not turn: it moves as its point at the left top corner of the first column. insets: how far the
    corners at the feet and the heads move in as they crush, m.
    """

    def __init__(
        self,
        column: Block,
        axes: np.ndarray,
        beam_mass_ratio: float,
        insets: tuple[float, float],
    ) -> None:
        half = column.breadth / 2
        height = column.height
        number = axes.size
        self._apart = axes - axes[0]
        self._head = axes[0] - half + insets[1] + 1j * height
        super().__init__(
            axes[0] + half - insets[0],
            Parts([number], [axes[0] + 0.5j * height], [number * ((2 * half) ** 2 + height**2) / 12]),
            [Hung("load", self._head, 0, mass=number * beam_mass_ratio)],
            slenderness=None if insets[0] else column.slenderness,
        )

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Kinematics:
        """Return the first column and the beam; hinges at the feet and the heads of all columns, in two runs."""
        first = super().motion(rotation)
        foot = self.corner
        head = self.corner + (self._head - self.corner) * np.exp(-1j * rotation)
        runs = [np.add.outer(self._apart, start + 0 * rotation) for start in (foot, head)]
        return replace(first, hinges=np.concatenate(runs))

    def carried(self, part: int, start: complex | np.ndarray, motion: Kinematics) -> PointMotion:
        """Return how points of a column, by its number, or of the beam, whose number is the next, have moved."""
        if part == self._apart.size:
            return super().carried(0, self._head + 0 * start, motion)
        return super().carried(0, start - self._apart[part], motion)

    def contacts(self, state: MotionState) -> Contacts:
        """Raise UnknownContacts: each column stands between two contacts that share its load as they like."""
        raise UnknownContacts("contact forces of a frame are statically indeterminate")
