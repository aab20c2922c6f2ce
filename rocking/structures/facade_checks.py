"""What a façade must satisfy, each refusal one sentence that names the field, its value and the bound."""

from typing import TYPE_CHECKING

from rocking.errors import StructureError
from rocking.quantities import finite, positive, within
from rocking.structures.load_fields import (
    check_slab,
    checked_eccentricity,
    inside,
    lengths,
    not_negative,
    whole,
)
from rocking.structures.restitution import check_restitution
from rocking.structures.tie_fields import checked_ties

if TYPE_CHECKING:
    from rocking.structures.facade import Facade

_MOST_STOREYS = 50


def checked_facade(facade: "Facade") -> dict[str, object]:
    """Return the fields of a façade as they are kept: floats, and a value for each storey."""
    heights = lengths("storey_heights", facade.storey_heights)
    thicknesses = lengths("thicknesses", facade.thicknesses)
    if len(heights) > _MOST_STOREYS:
        raise StructureError(
            f"storey_heights has {len(heights)} values, but must have {_MOST_STOREYS} at most."
        )
    _same_number("thicknesses", thicknesses, heights)
    loads = tuple(not_negative("floor_loads", load, "N/m") for load in facade.floor_loads)
    if loads:
        _same_number("floor_loads", loads, heights)
    check_restitution(facade.restitution, ("momentum",), facade.one_sided)
    check_slab(facade.top_slab)
    bearing = min((t for load, t in zip(loads, thicknesses, strict=False) if load), default=min(thicknesses))
    checked: dict[str, object] = {
        "storey_heights": heights,
        "thicknesses": thicknesses,
        "unit_weight": positive(StructureError, "unit_weight", facade.unit_weight, "N/m³"),
        "floor_loads": loads,
        "eccentricity": checked_eccentricity(facade.eccentricity, bearing),
        "thrust": finite(StructureError, "thrust", facade.thrust, "N/m"),
        "crack_storey": whole("crack_storey", facade.crack_storey, 1, len(heights)),
        **checked_ties(facade, sum(heights)),
    }
    if facade.thrust_height is not None:
        checked["thrust_height"] = inside("thrust_height", facade.thrust_height, sum(heights))
    if facade.inward_restitution is not None:
        checked["inward_restitution"] = within(
            StructureError, "inward_restitution", facade.inward_restitution, 0, 1
        )
    return checked


def _same_number(field: str, values: tuple[float, ...], heights: tuple[float, ...]) -> None:
    if len(values) != len(heights):
        raise StructureError(
            f"{field} has {len(values)} values, but must have {len(heights)}, one for each storey."
        )
