"""Structures: a geometry in, a Mechanism out."""

from rocking.structures.arch import Arch as Arch
from rocking.structures.arch import ArchOnPiers as ArchOnPiers
from rocking.structures.block import Block as Block
from rocking.structures.block import RigidBody as RigidBody
from rocking.structures.block import Spire as Spire
from rocking.structures.capacity_curve import CapacityCurve as CapacityCurve
from rocking.structures.facade import Facade as Facade
from rocking.structures.frame import Frame as Frame
from rocking.structures.joints import Joints as Joints
from rocking.structures.mechanism import EquivalentBlock as EquivalentBlock
from rocking.structures.mechanism import Mechanism as Mechanism
from rocking.structures.mechanism import Outcome as Outcome
from rocking.structures.mechanism import Side as Side
from rocking.structures.stack import Stack as Stack
from rocking.structures.stones import Stones as Stones
from rocking.structures.structure import Structure as Structure
from rocking.structures.structure_list import structure_from_config as structure_from_config
from rocking.structures.wall import LoadedWall as LoadedWall
from rocking.structures.wall import Wall as Wall
