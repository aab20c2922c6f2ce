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

OTHER_NAMES: dict[str, OtherName] = {
    **dict.fromkeys(
        ("boundary wall", "garden wall", "freestanding wall", "fence wall"), OtherName("free_wall")
    ),
    **dict.fromkeys(("balustrade", "battlement", "merlon", "attic wall"), OtherName("parapet")),
    **dict.fromkeys(("chimney stack", "smokestack"), OtherName("chimney")),
    **dict.fromkeys(("gable wall", "pediment", "tympanum"), OtherName("gable")),
    **dict.fromkeys(("counterfort",), OtherName("buttress")),
    **dict.fromkeys(("finial",), OtherName("pinnacle")),
    **dict.fromkeys(("steeple", "fleche", "obelisk"), OtherName("spire")),
    **dict.fromkeys(("monolith", "stele", "tombstone", "gravestone", "cabinet"), OtherName("block")),
    **dict.fromkeys(("statue", "sculpture", "vase", "bust"), OtherName("rigid_body", _ON_PEDESTAL)),
    **dict.fromkeys(("column", "pillar", "pier"), OtherName("block", f"it rocks in one piece, and {_ROLLS}")),
    **dict.fromkeys(("facade wall", "front", "frontage"), OtherName("facade")),
    **dict.fromkeys(
        ("partition", "partition wall", "infill", "infill wall"),
        OtherName("wall", "what holds its sides is left out"),
    ),
    **dict.fromkeys(("bearing wall", "load bearing wall"), OtherName("loaded_wall")),
    **dict.fromkeys(
        ("vault", "barrel vault", "tunnel vault"),
        OtherName("arch", "one metre of it, without what stiffens its ends"),
    ),
    **dict.fromkeys(("triumphal arch", "gateway", "portal arch"), OtherName("arch_on_piers")),
    **dict.fromkeys(
        ("portal", "portico", "colonnade", "trilith", "belfry", "bell gable"),
        OtherName("frame", "its columns in one plane, each in one piece, under one beam"),
    ),
    **dict.fromkeys(
        (
            "double leaf wall",
            "two leaf wall",
            "three leaf wall",
            "multi leaf wall",
            "veneer",
            "cladding",
        ),
        OtherName("cavity_wall", _LEAVES),
    ),
    **dict.fromkeys(("pushover curve", "pushover", "capacity curve"), OtherName("capacity_curve")),
    # What nothing here describes.
    "drum column": OtherName("", "drums open and slide on each other, each with a rim on which it rolls"),
    **dict.fromkeys(
        ("dome", "cupola", "cloister vault"),
        OtherName("", "a dome is held by its rings, which no section shows"),
    ),
    **dict.fromkeys(
        ("cross vault", "groin vault", "rib vault", "fan vault"), OtherName("", "it bears in two directions")
    ),
    **dict.fromkeys(
        ("corner", "corner wedge", "quoin"),
        OtherName(
            "", "a corner slides off in two directions at once, above all below the thrust of a hip rafter"
        ),
    ),
    **dict.fromkeys(("tower", "bell tower", "campanile", "minaret", "lighthouse"), OtherName("", _TOWER)),
    **dict.fromkeys(
        ("cornice", "balcony", "canopy", "eaves", "corbel", "gargoyle"), OtherName("", _CANTILEVER)
    ),
    **dict.fromkeys(
        ("retaining wall", "basement wall", "quay wall", "sea wall"),
        OtherName("", "earth or water presses on it"),
    ),
    "flying buttress": OtherName("", "a strut between two bodies that move apart, neither of which is given"),
    **dict.fromkeys(
        ("rubble wall", "dry stone wall", "drystone wall", "adobe wall", "earthen wall"),
        OtherName("", _RUBBLE),
    ),
    **dict.fromkeys(
        ("bridge", "viaduct", "aqueduct"),
        OtherName("", "its spandrels, fill and piers act together; one arch of it is an arch"),
    ),
    **dict.fromkeys(
        ("building", "house", "church"), OtherName("", "only its parts that rock are structures here")
    ),
    **dict.fromkeys(
        ("wood frame", "steel frame", "concrete frame"), OtherName("", "it bends and does not rock")
    ),
}
"""By the name in small letters, its words parted by blanks."""


def answer(name: object) -> OtherName | None:
    """Return what is known of a name that is no type; None of one that is not in the table."""
    words = str(name).replace("_", " ").replace("-", " ").lower().split()
    spoken = " ".join(words)
    return OTHER_NAMES.get(spoken) or OTHER_NAMES.get(spoken.removesuffix("s"))
