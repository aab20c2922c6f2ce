"""Scene: a structure at a place under the terms of a code. Everything above the case is asked of scenes."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from rocking.assessment.check_terms import CheckTerms
from rocking.floors.place import GROUND, Place
from rocking.structures import Mechanism, Structure
from rocking.structures.alone import as_structure


@dataclass(frozen=True)
class Scene:
    """One structure of a list, where it stands, and what its list says for the checks of a code.

    name: in the list, in every table and report. place: the ground, or a support whose periods are an axis of the
    result.
    """

    name: str
    structure: Structure
    place: Place = GROUND
    terms: CheckTerms = field(default_factory=CheckTerms)


def on_the_ground(structures: Mapping[str, Structure | Mechanism]) -> dict[str, Scene]:
    """Return the scenes of structures that no list puts anywhere, by name."""
    return {name: Scene(name, as_structure(each)) for name, each in structures.items()}
