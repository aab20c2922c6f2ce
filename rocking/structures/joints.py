"""Joints: what all joints of a structure have alike and may do, one object with one default, which it carries."""

import math
from dataclasses import dataclass, field

from rocking.errors import StructureError
from rocking.quantities import within


@dataclass(frozen=True)
class Joints:
    """The joints of a structure. Raises StructureError.

    All but the friction follows from the structure, which sets it.

    Parameters
    ----------
    friction : float, default 0.6
        Coulomb coefficient, beyond which a contact slides; from 0 to 10.
    courses_taper : bool, default False
        Whether courses grow smaller upwards, so that each rocks by itself and throws what stands on it.
    courses_are_given : bool, default False
        Whether its description says how many courses there are.
    hinges_migrate : bool, default False
        Whether its hinges would move in flight, while the mechanism leaves them.
    fall_by_sliding : bool, default False
        Whether it comes apart where they slide, though nothing lifts.
    stand_on_friction : float, default inf
        Friction from which on it stands as loose stones where its mechanism does, though a joint of that needs
        more; inf where nobody has shown it.
    as_stones : str, default ""
        As what chain of stones contact dynamics follows it, "as voussoirs"; "" where as a stack.
    need_stones : bool, default False
        Whether it may fall as stones where its mechanism stands, so that only these may say that it does.

    Examples
    --------
    >>> rocking.Arch(5.0, 0.9, 2.6, 11).on_joints(rocking.Joints(friction=0.4)).joints
    Joints(friction=0.4)
    """

    friction: float = 0.6
    courses_taper: bool = field(default=False, repr=False, kw_only=True)
    courses_are_given: bool = field(default=False, repr=False, kw_only=True)
    hinges_migrate: bool = field(default=False, repr=False, kw_only=True)
    fall_by_sliding: bool = field(default=False, repr=False, kw_only=True)
    stand_on_friction: float = field(default=math.inf, repr=False, kw_only=True)
    as_stones: str = field(default="", repr=False, kw_only=True)
    need_stones: bool = field(default=False, repr=False, kw_only=True)

    def __post_init__(self) -> None:
        within(StructureError, "friction", self.friction, low=0.0, high=10.0)


USUAL = Joints()
"""The joints of a structure of which nothing is said, and those of the codes."""
