"""Loads as a file describes them and as they must be: shared by the structures that carry them."""

from rocking.errors import StructureError
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
