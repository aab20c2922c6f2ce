"""Structures: a geometry in, a Mechanism out."""

from rocking.structures.arch import Arch
from rocking.structures.arch_on_piers import ArchOnPiers
from rocking.structures.block import Block
from rocking.structures.config import structure_from_config
from rocking.structures.facade import Facade
from rocking.structures.frame import Frame
from rocking.structures.loaded_wall import LoadedWall
from rocking.structures.mechanism import EquivalentBlock, Mechanism, Side
from rocking.structures.rigid_body import RigidBody
from rocking.structures.spire import Spire
from rocking.structures.structure import Structure
from rocking.structures.structure_list import load_structures
from rocking.structures.wall import Wall

__all__ = [
    "Arch",
    "ArchOnPiers",
    "Block",
    "EquivalentBlock",
    "Facade",
    "Frame",
    "LoadedWall",
    "Mechanism",
    "RigidBody",
    "Side",
    "Spire",
    "Structure",
    "Wall",
    "load_structures",
    "structure_from_config",
]
