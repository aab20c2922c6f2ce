"""Contact forces between rigid bodies in motion, per mass of the structure (N/kg = m/s²).

They follow from the accelerations of the bodies (d'Alembert); each structure's own file says how.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.bodies import Bars, Motion
from rocking.structures.mechanism import Mechanism

if TYPE_CHECKING:
    from rocking.structures.structure import Structure


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


def angular_acceleration(
    mechanism: Mechanism,
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    ground: ArrayLike = 0.0,
    vertical: ArrayLike = 0.0,
    largest: ArrayLike = 0.0,
) -> np.ndarray:
    """Return the signed φ'' [rad/s²] of a mechanism in motion (the standard form, with gravity g + ü_v).

    rotation [rad] and angular_velocity [rad/s] are signed; ground and vertical are ü_g and ü_v [m/s²]; largest is the
    largest rotation on that side so far [rad], where it was beyond `rotation`; all broadcast.
    """
    rotation, velocity, ground, vertical, largest = np.broadcast_arrays(
        rotation, angular_velocity, ground, vertical, largest
    )
    result = np.empty(rotation.shape)
    signs = _sign(mechanism, rotation, velocity)
    for sign, side in ((1.0, mechanism.sides[0]), (-1.0, mechanism.sides[-1])):
        here = signs == sign
        phi = np.abs(rotation[here])
        restoring = side.restoring(phi, np.maximum(largest[here], phi), GRAVITY + vertical[here])
        pull = side.inertia_slope(phi) / 2 * velocity[here] ** 2 + restoring
        result[here] = -sign * (pull + sign * side.ground(phi) * ground[here]) / side.inertia(phi)
    return result


def contact_forces(
    structure: "Structure",
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    angular_acceleration: ArrayLike,
    ground: ArrayLike = 0.0,
    vertical: ArrayLike = 0.0,
    largest: ArrayLike = 0.0,
) -> Contacts:
    """Return the contact forces of a structure in motion.

    rotation, angular_velocity, angular_acceleration: signed, (k,). ground, vertical: ü_g and ü_v, (k,) m/s². largest:
    the largest rotation on that side so far [rad], where it was beyond `rotation`, (k,).
    At rotation 0 the side is that of the velocity. Tangential forces are positive towards the side it rocks to.
    Raises UnknownContacts, in words, for a structure whose contacts are not known (a frame's are indeterminate).
    """
    given = np.broadcast_arrays(rotation, angular_velocity, angular_acceleration, ground, vertical, largest)
    state = [np.atleast_1d(np.asarray(values, dtype=float)) for values in given]
    sign = _sign(structure.mechanism(), state[0], state[1])
    phi, velocity, acceleration, push = (values * sign for values in state[:4])
    so_far = np.maximum(phi, state[5])
    return structure.contacts(MotionState(sign, phi, velocity, acceleration, push, state[4], so_far))


def contact_history(
    structure: "Structure",
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    ground: ArrayLike,
    vertical: ArrayLike = 0.0,
    largest: ArrayLike | None = None,
) -> Contacts:
    """Return the contact forces along a response, (k,) each, with φ'' from the structure's own mechanism.

    largest: the largest rotation on that side so far [rad], (k,); None: within the states given.

    At rest a single body carries the ground's whole acceleration; the joints of a wall or an arch are then statically
    indeterminate and their forces nan.
    """
    state = np.broadcast_arrays(rotation, angular_velocity, ground, vertical)
    phi, velocity, push, lift = (np.atleast_1d(np.asarray(values, dtype=float)) for values in state)
    resting = (phi == 0) & (velocity == 0)
    so_far = largest_so_far(phi) if largest is None else np.broadcast_to(largest, phi.shape)
    acceleration = np.where(
        resting, 0.0, angular_acceleration(structure.mechanism(), phi, velocity, push, lift, so_far)
    )
    found = contact_forces(structure, phi, velocity, acceleration, push, lift, so_far)
    if len(found.names) == 1:
        return found
    unknown = np.where(resting, np.nan, 0.0)
    return Contacts(found.names, found.normal + unknown, found.tangential + unknown)


def largest_so_far(rotation: np.ndarray) -> np.ndarray:
    """Return the largest rotation [rad] so far on the side of each of the signed `rotation`, (k,)."""
    out, back = (np.maximum.accumulate(np.maximum(each, 0.0)) for each in (rotation, -rotation))
    return np.where(rotation < 0, back, out)


def _sign(mechanism: Mechanism, rotation: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """The side of each state: the sign of the rotation, at 0 that of the velocity; positive at rest."""
    if mechanism.one_sided:
        if (rotation < 0).any():
            raise StructureError(
                "rotation is negative, but a one-sided mechanism rocks to the positive side only."
            )
        return np.ones(rotation.shape)
    return np.where((rotation < 0) | ((rotation == 0) & (velocity < 0)), -1.0, 1.0)
