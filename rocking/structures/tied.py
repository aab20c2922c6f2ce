"""Structures that carry loads and a row of ties: how a file describes these, how they must be, what is said of them."""

from abc import abstractmethod
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Annotated, Literal

import numpy as np

from rocking.errors import StructureError
from rocking.structures.equivalent_block import Function
from rocking.structures.fields import OneSided, Value
from rocking.structures.mechanism import Side
from rocking.structures.structure import Crackable
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


UnitWeight = Annotated[float, Value("Weight of the masonry", 20.0, "kN/m³", (8, 30), bounds={"gt": 0})]
Eccentricity = Annotated[
    float,
    Value("Distance of the bearing inwards from the middle of the wall", 0.05, "m", (-1, 1), "e", bounds={}),
]
TopSlab = Annotated[
    Literal["hinged", "flat"],
    Value(
        "Whether the uppermost load rests on a bearing or as a slab that stays flat",
        "hinged",
        phrase="{value} top slab",
    ),
]


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


@dataclass(frozen=True, repr=False)
class Tied(Crackable):
    """A structure with a row of equal ties.

    tie_heights: of ties above the ground, m; tie_stiffness: of each, N/m per m; tie_pretension, N/m; tie_strength,
    N/m, None for elastic ties, and tie_plastic_elongation, m, by which they yield before they break. A tie pulls
    inwards only; one that is tightened needs a structure that cannot rock inwards.
    one_sided: it leans on cross walls and rocks outwards only; restitution must then be a number.
    """

    tie_heights: Annotated[
        tuple[float, ...], Value("Heights of the ties above the ground", [1.6], "m", (0.2, 60), "z")
    ] = field(default=(), kw_only=True)
    tie_stiffness: Annotated[
        float,
        Value("Stiffness of each tie per metre of wall, kN/m per m", 50.0, "kN/m²", (1, 1e5), "k"),
    ] = field(default=0.0, kw_only=True)
    tie_pretension: Annotated[
        float, Value("Force of each tie at rest; needs one_sided", 0.0, "kN/m", (0, 200), "T")
    ] = field(default=0.0, kw_only=True)
    tie_strength: Annotated[
        float | None,
        Value(
            "Force at which each tie yields, or breaks where no plastic elongation is given; elastic without it",
            40.0,
            "kN/m",
            (1, 500),
            "F",
            bounds={"gt": 0},
        ),
    ] = field(default=None, kw_only=True)
    tie_plastic_elongation: Annotated[
        float,
        Value(
            "By how much each tie yields at its strength before it breaks; 0 is brittle", 0.05, "m", (0, 0.5)
        ),
    ] = field(default=0.0, kw_only=True)
    one_sided: OneSided = field(default=False, kw_only=True)

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
