"""A place on the earth, as the columns of a catalogue or a file give it, and what is wrong with what they give."""

import math
from dataclasses import dataclass

from rocking.records.kinds import RecordKind
from rocking.warnings import RockingWarning

_RADIUS = 6371.0088
"""Mean radius of the earth, km (IUGG)."""


@dataclass(frozen=True, kw_only=True)
class Coordinates:
    """A place. latitude: degrees north, -90 to 90. longitude: degrees east, -180 to 180."""

    latitude: float
    longitude: float

    def __str__(self) -> str:
        north, east = "NS"[self.latitude < 0], "EW"[self.longitude < 0]
        return f"{abs(self.latitude):.4f}° {north}, {abs(self.longitude):.4f}° {east}"

    def distance_to(self, other: "Coordinates") -> float:
        """Return the length of the great circle to another place, km, by the haversine formula."""
        here, there = math.radians(self.latitude), math.radians(other.latitude)
        turn = math.radians(other.longitude - self.longitude)
        part = math.sin((there - here) / 2) ** 2 + math.cos(here) * math.cos(there) * math.sin(turn / 2) ** 2
        return 2 * _RADIUS * math.asin(math.sqrt(min(part, 1.0)))


def place_of(
    *, latitude: float | None, longitude: float | None, of: str = "station"
) -> Coordinates | RockingWarning | None:
    """Return the place of two cells of a catalogue, in degrees, or what is wrong with them; None where both are empty.

    of: what the names of their columns begin with.
    """
    names = {"latitude": f"{of}_latitude_deg", "longitude": f"{of}_longitude_deg"}
    if latitude is None or longitude is None:
        if latitude is longitude:
            return None
        given, missing = names.values() if longitude is None else reversed(names.values())
        return RockingWarning.of(RecordKind.PLACE_HALF, given=given, missing=missing)
    if abs(latitude) <= 90 and abs(longitude) <= 180:
        return Coordinates(latitude=latitude, longitude=longitude)
    swapped = abs(latitude) <= 180 and abs(longitude) <= 90
    kind = RecordKind.PLACE_SWAPPED if swapped else RecordKind.PLACE_IMPOSSIBLE
    return RockingWarning.of(
        kind,
        latitude=names["latitude"],
        longitude=names["longitude"],
        north_deg=latitude,
        east_deg=longitude,
    )
