"""Contact forces along a response, and whether the model holds: no sliding, no bouncing, hinges pressed together.

Forces are per mass of the structure (N/kg = m/s²) and follow from the accelerations of the bodies (d'Alembert), so
they need φ'' too; `angular_acceleration` gives it from the standard form.
"""

from dataclasses import dataclass
from functools import singledispatch

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError
from rocking.quantities import GRAVITY
from rocking.structures.arch import Arch
from rocking.structures.bars import Bars, Motion, cross
from rocking.structures.block import Block
from rocking.structures.mechanism import Mechanism
from rocking.structures.rigid_body import RigidBody
from rocking.structures.spire import Spire
from rocking.structures.structure import Structure
from rocking.structures.wall import Wall


@dataclass(frozen=True, eq=False)
class Contacts:
    """Contact forces at h hinges over k instants, per mass of the structure [m/s²].

    names: (h,) what the hinges are called. normal: (h, k), positive in compression. tangential: (h, k), along the
    joint.
    """

    names: tuple[str, ...]
    normal: np.ndarray
    tangential: np.ndarray

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

    def slides(self, friction: float) -> np.ndarray:
        """Whether a contact needs more friction than the coefficient `friction`, (h, k)."""
        return self.friction_needed > friction


def angular_acceleration(
    mechanism: Mechanism,
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    ground: ArrayLike = 0.0,
    vertical: ArrayLike = 0.0,
) -> np.ndarray:
    """Return the signed φ'' [rad/s²] of a mechanism in motion (the standard form, with gravity g + ü_v).

    rotation [rad] and angular_velocity [rad/s] are signed; ground and vertical are ü_g and ü_v [m/s²]; all broadcast.
    """
    rotation, velocity, ground, vertical = np.broadcast_arrays(rotation, angular_velocity, ground, vertical)
    result = np.empty(rotation.shape)
    signs = _sign(mechanism, rotation, velocity)
    for sign, side in ((1.0, mechanism.sides[0]), (-1.0, mechanism.sides[-1])):
        here = signs == sign
        phi = np.abs(rotation[here])
        pull = side.inertia_slope(phi) / 2 * velocity[here] ** 2 + side.gravity(phi) * (
            GRAVITY + vertical[here]
        )
        result[here] = -sign * (pull + sign * side.ground(phi) * ground[here]) / side.inertia(phi)
    return result


def contact_forces(
    structure: Structure,
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    angular_acceleration: ArrayLike,
    ground: ArrayLike = 0.0,
    vertical: ArrayLike = 0.0,
) -> Contacts:
    """Return the contact forces of a structure in motion.

    rotation, angular_velocity, angular_acceleration: signed, (k,). ground, vertical: ü_g and ü_v, (k,) m/s².
    At rotation 0 the side is that of the velocity. Tangential forces are positive towards the side it rocks to.
    Raises StructureError for a structure whose contacts are not known (a frame's are statically indeterminate).
    """
    given = np.broadcast_arrays(rotation, angular_velocity, angular_acceleration, ground, vertical)
    state = [np.atleast_1d(np.asarray(values, dtype=float)) for values in given]
    sign = _sign(structure.mechanism(), state[0], state[1])
    phi, velocity, acceleration, push = (values * sign for values in state[:4])
    return _contacts(structure, sign, phi, velocity, acceleration, push, state[4])


def contact_history(
    structure: Structure,
    rotation: ArrayLike,
    angular_velocity: ArrayLike,
    ground: ArrayLike,
    vertical: ArrayLike = 0.0,
) -> Contacts:
    """Return the contact forces along a response, (k,) each, with φ'' from the structure's own mechanism.

    At rest a single body carries the ground's whole acceleration; the joints of a wall or an arch are then statically
    indeterminate and their forces nan.
    """
    state = np.broadcast_arrays(rotation, angular_velocity, ground, vertical)
    phi, velocity, push, lift = (np.atleast_1d(np.asarray(values, dtype=float)) for values in state)
    resting = (phi == 0) & (velocity == 0)
    acceleration = np.where(
        resting, 0.0, angular_acceleration(structure.mechanism(), phi, velocity, push, lift)
    )
    found = contact_forces(structure, phi, velocity, acceleration, push, lift)
    if len(found.names) == 1:
        return found
    unknown = np.where(resting, np.nan, 0.0)
    return Contacts(found.names, found.normal + unknown, found.tangential + unknown)


@singledispatch
def _contacts(structure: Structure, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    kind = type(structure).__name__
    raise StructureError(
        f"structure is a {kind}, but contact forces are known for single bodies, walls and arches only; choose one."
    )


@_contacts.register
def _(structure: Block, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    half, up = structure.breadth / 2, structure.height / 2
    return _corner(half + 0 * sign, up, rotation, velocity, acceleration, ground, vertical)


@_contacts.register
def _(structure: RigidBody, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    across = np.where(sign > 0, structure.right, structure.left)
    return _corner(across, structure.centre_height, rotation, velocity, acceleration, ground, vertical)


@_contacts.register
def _(structure: Spire, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    return _contacts(structure.body, sign, rotation, velocity, acceleration, ground, vertical)


def _corner(across, up, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    """One body: the ground's force is m(a + g) of its centre of mass, which lies at −across + i·up from the corner."""
    arm = (-across + 1j * up) * np.exp(-1j * rotation)
    total = -1j * arm * acceleration - arm * velocity**2 + ground + 1j * (vertical + GRAVITY)
    return Contacts(("corner",), total.imag[None], total.real[None])


@_contacts.register
def _(structure: Wall, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    """The top support carries no vertical force: the thrust at the hinge follows from the upper block alone."""
    motion = structure.linkage.motion(rotation)
    pull = ground + 1j * (vertical + GRAVITY)
    forces, couples = _dalembert(structure.linkage.bars, motion, velocity, acceleration, pull)
    _, hinge, top = motion.hinges
    turning = cross(motion.centroids[1] - top, forces[1]) + couples[1]
    arm = hinge - top
    across = (arm.real * -forces[1].imag + turning) / arm.imag
    at_hinge = across - 1j * forces[1].imag
    joint = 1j * np.exp(1j * (motion.angles[0] + motion.angles[1]) / 2)
    return _resolved(
        ("base", "hinge"), np.stack([at_hinge - forces[0], at_hinge]), np.stack([1j + 0 * joint, joint])
    )


@_contacts.register
def _(structure: Arch, sign, rotation, velocity, acceleration, ground, vertical) -> Contacts:
    """The thrust at B follows from the moments of AB about A and of BC about C; it runs from left to right."""
    bars, radius = structure.linkage.bars, structure.radius
    motion = structure.linkage.motion(rotation)
    pull = (ground + 1j * (vertical + GRAVITY)) / radius  # the linkage has a radius of 1
    forces, couples = _dalembert(bars, motion, velocity, acceleration, pull)
    a, b, c, _ = motion.hinges
    first = cross(motion.centroids[0] - a, forces[0]) + couples[0]
    second = cross(motion.centroids[1] - c, forces[1]) + couples[1]
    # (b − a) × T = first and (b − c) × T = −second
    at_b = ((b - c) * first + (b - a) * second) / cross(b - a, b - c)
    thrusts = np.stack([at_b - forces[0], at_b, at_b + forces[1], at_b + forces[1] + forces[2]])
    sections = structure.onset.hinges - structure.embrace_angle / 2
    fixed = np.zeros_like(motion.angles[:1])
    faces = np.concatenate([fixed, motion.angles, fixed])
    tangents = np.exp(1j * ((faces[1:] + faces[:-1]) / 2 - sections[:, None]))
    mass = structure.embrace_angle / radius
    return _resolved(("A", "B", "C", "D"), thrusts / mass, tangents)


def _dalembert(bars: Bars, motion: Motion, velocity, acceleration, pull) -> tuple[np.ndarray, np.ndarray]:
    """Weight and inertia of each bar in motion: forces (bars, k), complex, and couples (bars, k).

    pull: ü_g + i (ü_v + g), what the ground's motion and gravity ask of every mass.
    """
    masses, inertias = bars.masses[:, None], bars.inertias[:, None]
    centre = motion.accelerations * velocity**2 + motion.velocities * acceleration
    spin = motion.spin_slopes * velocity**2 + motion.spins * acceleration
    return -masses * (centre + pull), -inertias * spin


def _resolved(names: tuple[str, ...], thrusts: np.ndarray, normals: np.ndarray) -> Contacts:
    """Thrusts on the part that follows the hinge, resolved along unit `normals` and across them."""
    turned = thrusts * normals.conj()
    return Contacts(names, turned.real, turned.imag)


def _sign(mechanism: Mechanism, rotation: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """The side of each state: the sign of the rotation, at 0 that of the velocity; positive at rest."""
    if mechanism.one_sided:
        if (rotation < 0).any():
            raise StructureError(
                "rotation is negative, but a one-sided mechanism rocks to the positive side only."
            )
        return np.ones(rotation.shape)
    return np.where((rotation < 0) | ((rotation == 0) & (velocity < 0)), -1.0, 1.0)
