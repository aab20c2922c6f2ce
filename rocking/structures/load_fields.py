"""Loads as a file describes them and as they must be: shared by the structures that carry them."""

from rocking.errors import StructureError
from rocking.quantities import finite, length
from rocking.structures.fields import choice_field, number_field

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
