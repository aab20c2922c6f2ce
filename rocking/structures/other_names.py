"""What things are called that are no `type`: the type that answers them and what that leaves out, or that none does.

Letters say nothing of a meaning: "retaining wall" is near to "wall", on which no earth presses.
"""

from typing import NamedTuple


class OtherName(NamedTuple):
    """The type that describes a thing, "" where none does; and what it leaves out, or why none does."""

    type: str
    but: str = ""

    @property
    def words(self) -> str:
        """It in words, to follow the types there are."""
        if not self.type:
            return f"not modelled: {self.but}; see docs/pages/limits.md"
        kind = self.type.replace("_", " ")
        described = f"it is described as {'an' if kind[0] in 'aeiou' else 'a'} {kind}, type: {self.type}"
        return f"{described}; {self.but}" if self.but else described


_ROLLS = "a round one that rolls on its rim is not modelled"
_ON_PEDESTAL = f"{_ROLLS}, nor that it falls with a pedestal on which it would stand alone (4 of 123)"
_LEAVES = (
    "one that carries floors is a facade with leaves_m, and one whose top is free a free_wall with leaves_m"
)
_RUBBLE = "masonry that comes apart falls before it rocks as a body"
_TOWER = "a tower bends and cracks before it rocks; what stands on it takes it as its support by stands_on"
_CANTILEVER = "it bears by its tail under the wall above, not by a face on which it could rock"

_NAMES = (
    ("boundary wall, garden wall, freestanding wall, fence wall", OtherName("free_wall")),
    ("balustrade, battlement, merlon, attic wall", OtherName("parapet")),
    ("chimney stack, smokestack", OtherName("chimney")),
    ("gable wall, pediment, tympanum", OtherName("gable")),
    ("counterfort", OtherName("buttress")),
    ("finial", OtherName("pinnacle")),
    ("steeple, fleche, obelisk", OtherName("spire")),
    ("monolith, stele, tombstone, gravestone, cabinet", OtherName("block")),
    ("statue, sculpture, vase, bust", OtherName("rigid_body", _ON_PEDESTAL)),
    ("column, pillar, pier", OtherName("block", f"it rocks in one piece, and {_ROLLS}")),
    ("facade wall, front, frontage", OtherName("facade")),
    ("partition, partition wall, infill, infill wall", OtherName("wall", "what holds its sides is left out")),
    ("bearing wall, load bearing wall", OtherName("loaded_wall")),
    (
        "vault, barrel vault, tunnel vault",
        OtherName("arch", "one metre of it, without what stiffens its ends"),
    ),
    ("triumphal arch, gateway, portal arch", OtherName("arch_on_piers")),
    (
        "portal, portico, colonnade, trilith, belfry, bell gable",
        OtherName("frame", "its columns in one plane, each in one piece, under one beam"),
    ),
    (
        "double leaf wall, two leaf wall, three leaf wall, multi leaf wall, veneer, cladding",
        OtherName("cavity_wall", _LEAVES),
    ),
    ("pushover curve, pushover, capacity curve", OtherName("capacity_curve")),
    ("drum column", OtherName("", "drums open and slide on each other, each with a rim on which it rolls")),
    ("dome, cupola, cloister vault", OtherName("", "a dome is held by its rings, which no section shows")),
    ("cross vault, groin vault, rib vault, fan vault", OtherName("", "it bears in two directions")),
    (
        "corner, corner wedge, quoin",
        OtherName(
            "", "a corner slides off in two directions at once, above all below the thrust of a hip rafter"
        ),
    ),
    ("tower, bell tower, campanile, minaret, lighthouse", OtherName("", _TOWER)),
    ("cornice, balcony, canopy, eaves, corbel, gargoyle", OtherName("", _CANTILEVER)),
    ("retaining wall, basement wall, quay wall, sea wall", OtherName("", "earth or water presses on it")),
    (
        "flying buttress",
        OtherName("", "a strut between two bodies that move apart, neither of which is given"),
    ),
    ("rubble wall, dry stone wall, drystone wall, adobe wall, earthen wall", OtherName("", _RUBBLE)),
    (
        "bridge, viaduct, aqueduct",
        OtherName("", "its spandrels, fill and piers act together; one arch of it is an arch"),
    ),
    ("building, house, church", OtherName("", "only its parts that rock are structures here")),
    ("wood frame, steel frame, concrete frame", OtherName("", "it bends and does not rock")),
)
OTHER_NAMES = {name: meant for names, meant in _NAMES for name in names.split(", ")}
"""By the name in small letters, its words parted by blanks."""


def answer(name: object) -> OtherName | None:
    """Return what is known of a name that is no type; None of one that is not in the table."""
    words = str(name).replace("_", " ").replace("-", " ").lower().split()
    spoken = " ".join(words)
    return OTHER_NAMES.get(spoken) or OTHER_NAMES.get(spoken.removesuffix("s"))
