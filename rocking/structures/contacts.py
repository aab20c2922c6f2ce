"""Contact forces between rigid bodies in motion, per mass of the structure (N/kg = m/s²).

They follow from the accelerations of the bodies (d'Alembert); each structure's own file says how.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.bars import Bars, Motion


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
        return self.ground + 1j * (self.vertical + GRAVITY)


@dataclass(frozen=True, eq=False)
class Contacts:
    """Contact forces at h hinges over k instants, per mass of the structure [m/s²].

    names: (h,) what the hinges are called. normal: (h, k), positive in compression. tangential: (h, k), along the
    joint.
    """

    names: tuple[str, ...]
    normal: np.ndarray = field(repr=False)
    tangential: np.ndarray = field(repr=False)

    @property
    def friction_needed(self) -> np.ndarray:
        """Smallest friction coefficient that prevents sliding, (h, k); inf where not pressed, nan where not known."""
        pressed = self.normal > 0
        needed = np.abs(self.tangential) / np.where(pressed, self.normal, 1.0)
        return np.where(pressed | np.isnan(self.normal), needed, np.inf)

    @property
    def opens(self) -> np.ndarray:
        """Whether a contact would have to pull, (h, k): the structure bounces there."""
        return self.normal < 0


def corner(across: np.ndarray | float, up: float, state: MotionState) -> Contacts:
    """Return the force of the ground on one body whose centre of mass lies at −across + i·up from its corner."""
    arm = (-across + 1j * up) * np.exp(-1j * state.rotation)
    total = -1j * arm * state.acceleration - arm * state.velocity**2 + state.pull
    return Contacts(("corner",), total.imag[None], total.real[None])


def on_side(state: MotionState, positive: Contacts, negative: Contacts) -> Contacts:
    """Return of two sides' contacts those of the side on which each state is."""
    there = state.sign > 0
    normal = np.where(there, positive.normal, negative.normal)
    return Contacts(positive.names, normal, np.where(there, positive.tangential, negative.tangential))


def dalembert(
    bars: Bars, motion: Motion, state: MotionState, pull: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return weight and inertia of each bar in motion: forces (bars, k), complex, and couples (bars, k).

    pull: ü_g + i (ü_v + g) in the length unit of the bars.
    """
    masses, inertias = bars.masses[:, None], bars.inertias[:, None]
    velocity, acceleration = state.velocity, state.acceleration
    centre = motion.accelerations * velocity**2 + motion.velocities * acceleration
    spin = motion.spin_slopes * velocity**2 + motion.spins * acceleration
    return -masses * (centre + pull), -inertias * spin


def resolved(names: tuple[str, ...], thrusts: np.ndarray, normals: np.ndarray) -> Contacts:
    """Return thrusts on the part that follows each hinge, resolved along unit `normals` and across them."""
    along = thrusts * normals.conj()
    return Contacts(names, along.real, along.imag)
