"""What a façade must satisfy, each refusal one sentence that names the field, its value and the bound."""

from typing import TYPE_CHECKING

from rocking.errors import StructureError
from rocking.quantities import whole
from rocking.structures.load_fields import checked_eccentricity, inside
from rocking.structures.tie_fields import checked_ties

if TYPE_CHECKING:
    from rocking.structures.facade import Facade

_MOST_STOREYS = 50


def checked_facade(facade: "Facade") -> dict[str, object]:
    """Return the fields of a façade that hang together as they are kept: floats, and a value for each storey."""
    heights, thicknesses, loads = facade.storey_heights, facade.thicknesses, facade.floor_loads
    if len(heights) > _MOST_STOREYS:
        raise StructureError(
            f"storey_heights has {len(heights)} values, but must have {_MOST_STOREYS} at most."
        )
    _same_number("thicknesses", thicknesses, heights)
    if loads:
        _same_number("floor_loads", loads, heights)
    bearing = min((t for load, t in zip(loads, thicknesses, strict=False) if load), default=min(thicknesses))
    checked: dict[str, object] = {
        "eccentricity": checked_eccentricity(facade.eccentricity, bearing),
        "crack_storey": whole("crack_storey", facade.crack_storey, 1, len(heights)),
        **checked_ties(facade, sum(heights)),
    }
    if facade.thrust_height is not None:
        checked["thrust_height"] = inside("thrust_height", facade.thrust_height, sum(heights))
    return checked


def _same_number(field: str, values: tuple[float, ...], heights: tuple[float, ...]) -> None:
    if len(values) != len(heights):
        raise StructureError(
            f"{field} has {len(values)} values, but must have {len(heights)}, one for each storey."
        )
