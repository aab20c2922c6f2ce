"""Contact forces at the hinges of a structure in motion."""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY


class UnknownContacts(StructureError):
    """Contact forces that the mechanism alone does not tell; the message says why."""


class MotionState(NamedTuple):
    """A structure at k instants, each seen from the side to which it rocks: (k,) each.

    sign: the side. rotation ≥ 0 [rad], velocity [rad/s], acceleration [rad/s²] and ground ü_g [m/s²] are times the
    sign; vertical is ü_v [m/s²]. largest: the largest rotation on that side so far [rad], which ties remember.
    """

    sign: np.ndarray
    rotation: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    ground: np.ndarray
    vertical: np.ndarray
    largest: np.ndarray

    @property
    def pull(self) -> np.ndarray:
        """ü_g + i (ü_v + g), what the ground's motion and gravity ask of every mass."""
        result: np.ndarray = self.ground + 1j * (self.vertical + GRAVITY)
        return result


@dataclass(frozen=True, eq=False)
class Contacts:
    """Contact forces at h hinges over k instants, per mass of the structure [m/s²].

    names: (h,) what the hinges are called. normal: (h, k), positive in compression. tangential: (h, k), along the
    joint.
    """

    names: tuple[str, ...]
    normal: np.ndarray = field(repr=False)
    tangential: np.ndarray = field(repr=False)

    @classmethod
    def resolved(cls, names: tuple[str, ...], thrusts: np.ndarray, normals: np.ndarray) -> "Contacts":
        """Return complex thrusts on the part that follows each hinge, along unit `normals` and across them."""
        along = thrusts * normals.conj()
        return cls(names, along.real, along.imag)

    @property
    def required_friction(self) -> np.ndarray:
        """Smallest friction coefficient that prevents sliding, (h, k); inf where not pressed, nan where not known."""
        pressed = self.normal > 0
        ratio = np.abs(self.tangential) / np.where(pressed, self.normal, 1.0)
        return np.where(pressed | np.isnan(self.normal), ratio, np.inf)

    @property
    def opens(self) -> np.ndarray:
        """Whether a contact would have to pull, (h, k): the structure bounces there."""
        return self.normal < 0
