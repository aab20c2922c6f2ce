"""Structures that carry loads and a row of ties: how a file describes these, how they must be, what is said of them."""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rocking.errors import StructureError
from rocking.structures.equivalent_block import Function
from rocking.structures.fields import Field, choice_field, number_field
from rocking.structures.mechanism import Side
from rocking.structures.structure import Structure
from rocking.structures.ties import LoadedForm, Tie


def loaded_side(form: LoadedForm, end_rotation: float, restitution: float) -> Side:
    """Return the side of rocking with the functions of `form`, up to `end_rotation` [rad]."""
    bends = [bend for tie in form.ties for bend in tie.bends(end_rotation)]
    critical = critical_rotation(form.gravity, end_rotation, bends)
    return Side.of(form, critical, end_rotation, restitution, form.ties, form.untied.gravity)


def critical_rotation(gravity: Function, end_rotation: float, bends: Sequence[float] = ()) -> float:
    """Return where G first vanishes on (0, end_rotation), or falls below zero at one of its `bends`, rad.

    Raises StructureError when G does not restore at rest, or does not vanish.
    """
    from scipy.optimize import brentq  # slow to import, and needed by loaded structures only

    places = np.linspace(0.0, end_rotation, 513)
    if bends:
        places = np.unique(np.concatenate([places, bends, np.nextafter(bends, np.inf)]))
    falls = np.flatnonzero(gravity(places) <= 0)
    if not falls.size:
        raise StructureError(
            f"the structure has no unstable equilibrium up to a rotation of {end_rotation:.6g} rad: "
            "what holds it never lets go; make it weaker."
        )
    if falls[0] == 0:
        raise StructureError("the structure does not stand: what acts on it at rest turns it over.")
    before, after = places[falls[0] - 1], places[falls[0]]

    def restoring(phi: float) -> float:
        return float(gravity(np.asarray(phi)))

    while bends and restoring(after) > 0:
        after = np.nextafter(after, np.inf)  # rounded otherwise alone than in a row
    found = float(brentq(restoring, before, after, xtol=1e-16, rtol=1e-15))
    while bends and found < after and restoring(found) > 0:
        found = float(np.nextafter(found, np.inf))  # where a tie breaks, the far side of the fall
    return found


UNIT_WEIGHT = number_field(
    "unit_weight",
    "Weight of the masonry",
    "kN/m³",
    20.0,
    (8, 30),
    bounds={"exclusiveMinimum": 0},
    required=True,
)
ECCENTRICITY = number_field(
    "eccentricity", "Distance of the bearing inwards from the middle of the wall", "m", 0.05, (-1, 1), "e", {}
)
TOP_SLAB = choice_field(
    "top_slab",
    "Whether the uppermost load rests on a bearing or as a slab that stays flat",
    ("hinged", "flat"),
    "{value} top slab",
)


def check_eccentricity(value: float, thickness: float) -> None:
    """Refuse a bearing beyond the edge of a wall of that thickness [m]."""
    if abs(value) > thickness / 2:
        raise StructureError(
            f"eccentricity is {value!r} m, but must lie within half the thickness, {thickness / 2!r} m, for the load "
            "to bear on the wall."
        )


def check_inside(field: str, value: float, height: float) -> None:
    """Refuse a height above the ground [m] that is not on a wall of that `height`."""
    if not 0 < value <= height:
        raise StructureError(
            f"{field} is {value!r} m, but must lie on the wall, above 0 and up to {height:.6g} m."
        )


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
