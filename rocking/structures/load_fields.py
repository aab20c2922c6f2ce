"""Loads and ties as a file describes them and as they must be: shared by the structures that carry them."""

from rocking.errors import StructureError
from rocking.quantities import finite, length, positive
from rocking.structures.fields import Field, choice_field, number_field

UNIT_WEIGHT = number_field(
    "unit_weight_kN_m3",
    "unit_weight",
    "Weight of the masonry",
    "kN/m³",
    20.0,
    (8, 30),
    bounds={"exclusiveMinimum": 0},
    required=True,
)
ECCENTRICITY = number_field(
    "eccentricity_m",
    "eccentricity",
    "Distance of the bearing inwards from the middle of the wall",
    "m",
    0.05,
    (-1, 1),
    "e",
    {},
)
TOP_SLAB = choice_field(
    "top_slab",
    "Whether the uppermost load rests on a bearing or as a slab that stays flat",
    ("hinged", "flat"),
    "{value} top slab",
)


def tie_fields(height: float, stiffness: float) -> tuple[Field, ...]:
    """Return the fields of ties, with examples."""
    return (
        number_field(
            "tie_heights_m",
            "tie_heights",
            "Heights of the ties above the ground",
            "m",
            [height],
            (0.2, 60),
            "z",
        ),
        number_field(
            "tie_stiffness_kN_m2",
            "tie_stiffness",
            "Stiffness of each tie per metre of wall, kN/m per m",
            "kN/m²",
            stiffness,
            (1, 1e5),
            "k",
        ),
        number_field(
            "tie_pretension_kN_m",
            "tie_pretension",
            "Force of each tie at rest; needs one_sided",
            "kN/m",
            0.0,
            (0, 200),
            "T",
        ),
        number_field(
            "tie_strength_kN_m",
            "tie_strength",
            "Force that each tie bears; a motion that asks for more is reported, and the tie stays elastic in it",
            "kN/m",
            40.0,
            (1, 500),
            bounds={"exclusiveMinimum": 0},
        ),
    )


def checked_ties(
    heights: tuple[float, ...],
    stiffness: float,
    pretension: float,
    strength: float | None,
    top: float,
    one_sided: bool,
) -> dict[str, object]:
    """Return the fields of ties as they are kept. top: of the wall, m."""
    checked: dict[str, object] = {
        "tie_heights": tuple(inside("tie_heights", z, top) for z in heights),
        "tie_stiffness": not_negative("tie_stiffness", stiffness, "N/m²"),
        "tie_pretension": not_negative("tie_pretension", pretension, "N/m"),
    }
    if strength is not None:
        checked["tie_strength"] = positive(StructureError, "tie_strength", strength, "N/m")
        if strength < pretension:
            raise StructureError(
                f"tie_strength is {strength!r} N/m, but must be at least the pretension of {pretension!r} N/m."
            )
    if (stiffness or pretension) and not heights:
        raise StructureError("tie_heights is empty, but must say where the ties are; give it.")
    if heights and not (stiffness or pretension):
        raise StructureError("tie_stiffness is 0 N/m², but must be greater than 0 for ties to hold; give it.")
    if pretension > 0 and not one_sided:
        raise StructureError(
            f"tie_pretension is {pretension!r} N/m, but must be 0 unless the wall is one_sided: moving inwards, a "
            "tightened tie goes slack."
        )
    return checked


def overstressed(forces: dict[float, float], strength: float | None) -> str:
    """Return the sentence on the tie that is asked for most beyond its strength, or nothing. forces: N/m by height."""
    if strength is None or not forces:
        return ""
    height, force = max(forces.items(), key=lambda tie: tie[1])
    if force <= strength:
        return ""
    return f"the tie at {height:.6g} m would need {force / 1e3:.4g} kN/m, but bears {strength / 1e3:.6g} kN/m"


def checked_eccentricity(value: float, thickness: float) -> float:
    """Return the distance of a bearing from the middle of a wall of that thickness [m]."""
    eccentricity = finite(StructureError, "eccentricity", value, "m")
    if abs(eccentricity) > thickness / 2:
        raise StructureError(
            f"eccentricity is {value!r} m, but must lie within half the thickness, {thickness / 2!r} m, for the load "
            "to bear on the wall."
        )
    return eccentricity


def check_slab(value: object) -> None:
    """Refuse a top slab that is none of the two."""
    if value not in ("hinged", "flat"):
        raise StructureError(f"top_slab is {value!r}, but must be hinged or flat.")


def lengths(field: str, values: object) -> tuple[float, ...]:
    """Return lengths in m, one or more."""
    if not isinstance(values, tuple | list) or not values:
        raise StructureError(
            f"{field} is {values!r}, but must be a list of lengths; give one for each storey."
        )
    return tuple(length(field, value) for value in values)


def not_negative(field: str, value: float, unit: str) -> float:
    """Return a finite number of 0 or more."""
    number = finite(StructureError, field, value, unit)
    if number < 0:
        raise StructureError(f"{field} is {value!r} {unit}, but must be 0 or more.")
    return number


def inside(field: str, value: float, height: float) -> float:
    """Return a height above the ground, on the wall."""
    number = finite(StructureError, field, value, "m")
    if not 0 < number <= height:
        raise StructureError(
            f"{field} is {value!r} m, but must lie on the wall, above 0 and up to {height:.6g} m."
        )
    return number


def whole(field: str, value: float, low: int, high: int) -> int:
    """Return a whole number from `low` to `high`."""
    number = finite(StructureError, field, value)
    if number != int(number) or not low <= number <= high:
        raise StructureError(f"{field} is {value!r}, but must be a whole number from {low} to {high}.")
    return int(number)
