"""Joints: what all joints of a structure have alike, one object with one default, which the structure carries."""

from dataclasses import dataclass

from rocking.errors import StructureError
from rocking.quantities import within


@dataclass(frozen=True)
class Joints:
    """The joints of a structure. Raises StructureError.

    Parameters
    ----------
    friction : float, default 0.6
        Coulomb coefficient, beyond which a contact slides; from 0 to 10.

    Examples
    --------
    >>> rocking.Arch(5.0, 0.9, 2.6, 11).on_joints(rocking.Joints(friction=0.4)).joints
    Joints(friction=0.4)
    """

    friction: float = 0.6

    def __post_init__(self) -> None:
        within(StructureError, "friction", self.friction, low=0.0, high=10.0)


USUAL = Joints()
"""The joints of a structure of which nothing is said, and those of the codes."""
