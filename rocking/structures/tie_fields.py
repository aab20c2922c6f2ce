"""Ties as a file describes them and as they must be, and what is said of them: shared by what they hold."""

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import not_negative, positive
from rocking.structures.fields import Field, number_field
from rocking.structures.load_fields import inside
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


class Tied(Protocol):
    """A structure with a row of equal ties, in SI."""

    @property
    def tie_heights(self) -> tuple[float, ...]: ...
    @property
    def tie_stiffness(self) -> float: ...
    @property
    def tie_pretension(self) -> float: ...
    @property
    def tie_strength(self) -> float | None: ...
    @property
    def tie_plastic_elongation(self) -> float: ...
    @property
    def one_sided(self) -> bool: ...


def checked_ties(wall: Tied, top: float) -> dict[str, object]:
    """Return the fields of the ties of `wall` as they are kept. top: of the wall, m."""
    stiffness, pretension, strength = wall.tie_stiffness, wall.tie_pretension, wall.tie_strength
    checked: dict[str, object] = {
        "tie_heights": tuple(inside("tie_heights", z, top) for z in wall.tie_heights),
        "tie_stiffness": not_negative("tie_stiffness", stiffness, "N/m²"),
        "tie_pretension": not_negative("tie_pretension", pretension, "N/m"),
        "tie_plastic_elongation": not_negative("tie_plastic_elongation", wall.tie_plastic_elongation, "m"),
    }
    if strength is not None:
        checked["tie_strength"] = _checked_strength(strength, pretension, stiffness)
    elif wall.tie_plastic_elongation:
        raise StructureError(
            f"tie_plastic_elongation is {wall.tie_plastic_elongation!r} m, but needs a tie_strength at which the tie "
            "yields; give it."
        )
    if (stiffness or pretension) and not wall.tie_heights:
        raise StructureError("tie_heights is empty, but must say where the ties are; give it.")
    if wall.tie_heights and not (stiffness or pretension):
        raise StructureError("tie_stiffness is 0 N/m², but must be greater than 0 for ties to hold; give it.")
    if pretension > 0 and not wall.one_sided:
        raise StructureError(
            f"tie_pretension is {pretension!r} N/m, but must be 0 unless the wall is one_sided: moving inwards, a "
            "tightened tie goes slack."
        )
    return checked


def _checked_strength(strength: float, pretension: float, stiffness: float) -> float:
    strength = positive(StructureError, "tie_strength", strength, "N/m")
    if strength < pretension:
        raise StructureError(
            f"tie_strength is {strength!r} N/m, but must be at least the pretension of {pretension!r} N/m."
        )
    if not stiffness:
        raise StructureError(
            "tie_stiffness is 0 N/m², but must be greater than 0 for a tie with a tie_strength; give it."
        )
    return strength


def tie_of(wall: Tied, unit: float = 1.0) -> Tie:
    """Return each tie of `wall`, its forces in `unit` [N/m]."""
    strength = np.inf if wall.tie_strength is None else wall.tie_strength
    return Tie(
        wall.tie_stiffness / unit, wall.tie_pretension / unit, strength / unit, wall.tie_plastic_elongation
    )


def tie_text(wall: Tied) -> str:
    """Return what a drawing says of each tie."""
    text = f"{wall.tie_stiffness / 1e3:.6g} kN/m²"
    if wall.tie_strength is None:
        return text
    does = "yields" if wall.tie_plastic_elongation else "breaks"
    return f"{text}, {does} at {wall.tie_strength / 1e3:.6g} kN/m"


def tie_events(wall: Tied, stretches: Mapping[float, float]) -> str:
    """Return what has become of the ties of `wall` that were stretched so far [m, by height in m], in words."""
    tie, said = tie_of(wall), []
    for height, stretch in stretches.items():
        if stretch > tie.rupture_stretch:
            said.append(f"the tie at {height:.6g} m breaks")
        elif stretch > tie.yield_stretch:
            said.append(
                f"the tie at {height:.6g} m yields by {stretch - tie.yield_stretch:.3g} m of "
                f"{tie.plastic_elongation:.6g} m"
            )
    return "; ".join(said)
