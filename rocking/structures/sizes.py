"""Sizes checked at birth: positive, and of a magnitude that double precision and masonry both know."""

from rocking.checks import positive, within
from rocking.errors import StructureError

_SMALLEST, _LARGEST = 1e-4, 1e5
"""Lengths from a tenth of a millimetre to a hundred kilometres, m."""


def length(field: str, value: float) -> float:
    """Return `value` as a length in m, or raise StructureError naming `field` and the bounds."""
    return within(
        StructureError, field, positive(StructureError, field, value, "m"), _SMALLEST, _LARGEST, "m"
    )


def squared_length(field: str, value: float) -> float:
    """Return `value` as a squared length in m², or raise StructureError naming `field` and the bounds."""
    checked = positive(StructureError, field, value, "m²")
    return within(StructureError, field, checked, _SMALLEST**2, _LARGEST**2, "m²")
