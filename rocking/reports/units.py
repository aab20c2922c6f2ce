"""The units in which a report shows accelerations, velocities and lengths; the tables are in SI units."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import Any

from rocking.quantities import GRAVITY

SI = "SI"


@dataclass(frozen=True)
class Unit:
    """A unit as it is printed; size: one of it, in SI units."""

    name: str
    size: float


_SENTENCES = {
    SI: "SI units and radians",
    "g and cm": "Accelerations in g, velocities in cm/s, displacements in cm; sizes in m, angles in radians",
}
_IN_PLACE_OF: dict[str, dict[str, Unit]] = {
    SI: {},
    "g and cm": {
        "m/s²": Unit("g", GRAVITY),
        "m/s": Unit("cm/s", 0.01),
        "m": Unit("cm", 0.01),
    },
}
_CHOSEN: ContextVar[str] = ContextVar("display units", default=SI)


def unit_of(si: str) -> Unit:
    """Return the unit that the report at hand shows in place of the SI unit "m/s²", "m/s", "m", or any other."""
    return _IN_PLACE_OF[_CHOSEN.get()].get(si, Unit(si, 1.0))


def units_in_words() -> str:
    """Return the units of the report at hand, for the foot of a page."""
    return _SENTENCES[_CHOSEN.get()]


@contextmanager
def displaying(settings: Mapping[str, Any]) -> Iterator[None]:
    """Show in the units that "display_units" of the settings of a study names; without it, in SI units."""
    token = _CHOSEN.set(settings.get("display_units", SI))
    try:
        yield
    finally:
        _CHOSEN.reset(token)
