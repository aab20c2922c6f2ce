"""Ties as a file describes them and as they must be, and what is said of them: shared by what they hold."""

from abc import abstractmethod
from dataclasses import dataclass, field

import numpy as np

from rocking.errors import StructureError
from rocking.structures.fields import Field, number_field
from rocking.structures.load_fields import check_inside
from rocking.structures.structure import Structure
from rocking.structures.ties import Tie


def tie_fields(height: float, stiffness: float) -> tuple[Field, ...]:
    """Return the fields of ties, with examples."""
    return (
        number_field("tie_heights", "Heights of the ties above the ground", "m", [height], (0.2, 60), "z"),
        number_field(
            "tie_stiffness",
            "Stiffness of each tie per metre of wall, kN/m per m",
            "kN/m²",
            stiffness,
            (1, 1e5),
            "k",
        ),
        number_field(
            "tie_pretension", "Force of each tie at rest; needs one_sided", "kN/m", 0.0, (0, 200), "T"
        ),
        number_field(
            "tie_strength",
            "Force at which each tie yields, or breaks where no plastic elongation is given; elastic without it",
            "kN/m",
            40.0,
            (1, 500),
            "F",
            bounds={"exclusiveMinimum": 0},
        ),
        number_field(
            "tie_plastic_elongation",
            "By how much each tie yields at its strength before it breaks; 0 is brittle",
            "m",
            0.05,
            (0, 0.5),
        ),
    )


@dataclass(frozen=True, repr=False)
class Tied(Structure):
    """A structure with a row of equal ties.

    tie_heights: of ties above the ground, m; tie_stiffness: of each, N/m per m; tie_pretension, N/m; tie_strength,
    N/m, None for elastic ties, and tie_plastic_elongation, m, by which they yield before they break. A tie pulls
    inwards only; one that is tightened needs a structure that cannot rock inwards.
    one_sided: it leans on cross walls and rocks outwards only; restitution must then be a number.
    """

    tie_heights: tuple[float, ...] = field(default=(), kw_only=True)
    tie_stiffness: float = field(default=0.0, kw_only=True)
    tie_pretension: float = field(default=0.0, kw_only=True)
    tie_strength: float | None = field(default=None, kw_only=True)
    tie_plastic_elongation: float = field(default=0.0, kw_only=True)
    one_sided: bool = field(default=False, kw_only=True)

    @abstractmethod
    def tie_stretches(self, rotation: float) -> dict[float, float]:
        """Return by how much each tie that moves is stretched [m], by height, at a signed `rotation` [rad]."""

    def tie_events(self, rotation: float) -> str:
        tie, said = self._tie(), []
        for height, stretch in self.tie_stretches(rotation).items():
            if stretch > tie.rupture_stretch:
                said.append(f"the tie at {height:.6g} m breaks")
            elif stretch > tie.yield_stretch:
                said.append(
                    f"the tie at {height:.6g} m yields by {stretch - tie.yield_stretch:.3g} m of "
                    f"{tie.plastic_elongation:.6g} m"
                )
        return "; ".join(said)

    def _tie(self, unit: float = 1.0) -> Tie:
        """Each tie, its forces in `unit` [N/m]."""
        strength = np.inf if self.tie_strength is None else self.tie_strength
        return Tie(
            self.tie_stiffness / unit,
            self.tie_pretension / unit,
            strength / unit,
            self.tie_plastic_elongation,
        )

    @property
    def _tie_text(self) -> str:
        """What a drawing says of each tie."""
        text = f"{self.tie_stiffness / 1e3:.6g} kN/m²"
        if self.tie_strength is None:
            return text
        does = "yields" if self.tie_plastic_elongation else "breaks"
        return f"{text}, {does} at {self.tie_strength / 1e3:.6g} kN/m"

    def _check_ties(self, top: float) -> None:
        """Refuse ties that do not hang together. top: of the wall, m."""
        stiffness, pretension, strength = self.tie_stiffness, self.tie_pretension, self.tie_strength
        for height in self.tie_heights:
            check_inside("tie_heights", height, top)
        if strength is not None and strength < pretension:
            raise StructureError(
                f"tie_strength is {strength!r} N/m, but must be at least the pretension of {pretension!r} N/m."
            )
        if strength is not None and not stiffness:
            raise StructureError(
                "tie_stiffness is 0 N/m², but must be greater than 0 for a tie with a tie_strength; give it."
            )
        if strength is None and self.tie_plastic_elongation:
            raise StructureError(
                f"tie_plastic_elongation is {self.tie_plastic_elongation!r} m, but needs a tie_strength at which the "
                "tie yields; give it."
            )
        if (stiffness or pretension) and not self.tie_heights:
            raise StructureError("tie_heights is empty, but must say where the ties are; give it.")
        if self.tie_heights and not (stiffness or pretension):
            raise StructureError(
                "tie_stiffness is 0 N/m², but must be greater than 0 for ties to hold; give it."
            )
        if pretension > 0 and not self.one_sided:
            raise StructureError(
                f"tie_pretension is {pretension!r} N/m, but must be 0 unless the wall is one_sided: moving inwards, a "
                "tightened tie goes slack."
            )
