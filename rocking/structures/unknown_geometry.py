"""A mechanism alone, of which no geometry is known, as a structure that can be followed and nothing else."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from rocking.errors import StructureError
from rocking.structures.linkage import Linkage
from rocking.structures.mechanism import Mechanism
from rocking.structures.structure import Structure


@dataclass(frozen=True, repr=False)
class UnknownGeometry(Structure):
    """A mechanism that somebody gives without its geometry: it has one crack, no outline and unknown contacts."""

    type_name: ClassVar[str] = "mechanism alone"
    _contacts_unknown: ClassVar[str] = "a mechanism alone has no contacts that are known"

    of: Mechanism

    def mechanism(self) -> Mechanism:
        """Return the mechanism itself."""
        return self.of

    @property
    def symmetric(self) -> bool:
        """Whether the negative side is the mirror image of the positive one."""
        return self.of.symmetric

    @property
    def linkages(self) -> tuple[Linkage, ...]:
        """None: no moving part is known."""
        return ()

    def _linkage(self, mirrored: bool) -> Linkage:
        raise StructureError(
            "a mechanism alone has no moving parts that are known; give the structure itself."
        )

    def _parts(self) -> list[tuple[int, np.ndarray]]:
        return []


def as_structure(followed: Structure | Mechanism) -> Structure:
    """Return what is to be followed as a structure."""
    return UnknownGeometry(followed) if isinstance(followed, Mechanism) else followed
