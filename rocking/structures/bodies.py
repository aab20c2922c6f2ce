"""Rigid bodies that move as one mechanism: what they weigh, how they move with φ, and the impact that ends it.

Points are complex, x + iy. Restitution of the impact at φ = 0 is a number, or the momentum balance by name. Every
momentum balance here is one equation. Just before the impact the bodies move with the velocity field u of one
mechanism, just after with η times the field v of the other; the impulses act where the new mechanism turns and do no
work on it, so ⟨η v − u, v⟩ = 0 in the mass inner product and η = ⟨u, v⟩ / ⟨v, v⟩. For a block this is Housner's
1 − 1.5 sin²α, for the mid-height wall (1 − 4.5 sin²α)/(1 + 3 sin²α), for the frame Makris and Vassiliou's value.
"""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import wraps
from typing import NamedTuple, TypeVar, cast

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import StructureError, StructureWarning
from rocking.quantities import GRAVITY

Owner = TypeVar("Owner")
Found = TypeVar("Found")


@dataclass(frozen=True, eq=False)
class Bars:
    """Masses, centroids (complex, at rest) and inertias about the centroids of some rigid parts: (k,) each."""

    masses: np.ndarray = field(repr=False)
    centroids: np.ndarray = field(repr=False)
    inertias: np.ndarray = field(repr=False)


@dataclass(frozen=True, eq=False)
class Motion:
    """k bars at some rotations of the mechanism, and their first and second derivatives with φ.

    hinges: (h, ...) complex contact points. angles: (k, ...) counterclockwise turn of each bar from rest, rad; spins
    and spin_slopes: its derivatives. centroids, velocities, accelerations: (k, ...) complex, with their derivatives.
    """

    hinges: np.ndarray = field(repr=False)
    angles: np.ndarray = field(repr=False)
    spins: np.ndarray = field(repr=False)
    spin_slopes: np.ndarray = field(repr=False)
    centroids: np.ndarray = field(repr=False)
    velocities: np.ndarray = field(repr=False)
    accelerations: np.ndarray = field(repr=False)


class Bodies(NamedTuple):
    """Moving masses at a rotation (any shape, ...), up to one factor of mass; points complex, m.

    masses, inertias (about each centre of mass): (k,). centres: (k, ...). turns: (k, ...) counterclockwise, rad.
    """

    masses: np.ndarray
    inertias: np.ndarray
    centres: np.ndarray
    turns: np.ndarray


def keeps_last(method: Callable[[Owner, np.ndarray], Found]) -> Callable[[Owner, ArrayLike], Found]:
    """Let a method of a rotation keep what it found last: I, G and B of the same places are asked for in turn."""
    place = f"_last_{method.__name__}"

    @wraps(method)
    def keeping(self: Owner, rotation: ArrayLike) -> Found:
        asked = np.asarray(rotation, dtype=float)
        last = self.__dict__.get(place)
        if last is None or not np.array_equal(last[0], asked):
            last = self.__dict__[place] = asked.copy(), method(self, asked)
        return cast(Found, last[1])

    return keeping


def body_about(corner: float | complex, centre: complex, inertia: float, rotation: ArrayLike) -> Bodies:
    """Return one body of mass 1 that turns clockwise about `corner`; centre: of mass at rest. inertia: per mass, m²."""
    turn = -np.asarray(rotation, dtype=float)
    centres = corner + (centre - corner) * np.exp(1j * turn)
    return Bodies(np.ones(1), np.array([inertia]), centres[None], turn[None])


def cross(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the cross product of plane vectors given as complex numbers."""
    return one.real * other.imag - one.imag * other.real


def carried(
    bars: Bars, motion: Motion, bar: int, start: complex
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return how far a point fixed to a bar has moved from `start`, where it is at rest, and its two derivatives."""
    arm = (start - bars.centroids[bar]) * np.exp(1j * motion.angles[bar])
    spin = motion.spins[bar]
    return (
        motion.centroids[bar] + arm - start,
        motion.velocities[bar] + 1j * spin * arm,
        motion.accelerations[bar] + (1j * motion.spin_slopes[bar] - spin**2) * arm,
    )


class LinkedBars:
    """`bars` that move as one mechanism, lengths in `unit` [m]: I, I', G, G' and B over their masses and that unit.

    A subclass gives the motion.
    """

    bars: Bars
    unit: float = 1.0

    def motion(self, rotation: ArrayLike) -> Motion:
        """Return the bars at `rotation` ≥ 0 [rad], any shape."""
        raise NotImplementedError

    def inertia(self, rotation: ArrayLike) -> np.ndarray:
        """I = Σ m|r'|² + I_c ω², shape of `rotation`."""
        motion = self.motion(rotation)
        moving = _sum(self.bars.masses, np.abs(motion.velocities) ** 2)
        return self.unit * (moving + _sum(self.bars.inertias, motion.spins**2))

    def inertia_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dI/dφ = 2 Σ m r'·r'' + I_c ω ω'."""
        motion = self.motion(rotation)
        turning = _sum(self.bars.inertias, motion.spins * motion.spin_slopes)
        moving = _sum(self.bars.masses, (motion.velocities.conj() * motion.accelerations).real)
        return self.unit * (2 * (moving + turning))

    def gravity(self, rotation: ArrayLike) -> np.ndarray:
        """G = Σ m y'."""
        return _sum(self.bars.masses, self.motion(rotation).velocities.imag)

    def gravity_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dG/dφ = Σ m y''."""
        return _sum(self.bars.masses, self.motion(rotation).accelerations.imag)

    def ground(self, rotation: ArrayLike) -> np.ndarray:
        """B = Σ m x'."""
        return _sum(self.bars.masses, self.motion(rotation).velocities.real)


def _sum(weights: np.ndarray, terms: np.ndarray) -> np.ndarray:
    return np.tensordot(weights, terms, axes=1)


Restitution = float | str | None
"""η in [0, 1], the name of a balance, or None for the structure's default."""


def momentum_balance(masses: ArrayLike, inertias: ArrayLike, before: ArrayLike, after: ArrayLike) -> float:
    """Return η = ⟨u, v⟩ / ⟨v, v⟩, which may be negative.

    masses, inertias (about each centre of mass): (k,). before, after: (k, 3) velocities (vx, vy, ω) of the
    bodies' centres of mass for a unit angular velocity of arrival and of departure.
    """
    weights = np.stack([masses, masses, inertias], axis=1)
    arriving, leaving = np.asarray(before), np.asarray(after)
    return float((weights * arriving * leaving).sum() / (weights * leaving * leaving).sum())


def resolve_restitution(value: Restitution, default: float | str, balance: Callable[[], float]) -> float:
    """Return η in [0, 1]: `value`, or `default` when it is None; a name stands for `balance`.

    A balance below zero is not physical (the body would not reach the other side): η becomes 0 and a
    StructureWarning says so.
    """
    chosen = default if value is None else value
    if not isinstance(chosen, str):
        return float(chosen)
    found = balance()
    if found >= 0:
        return min(found, 1.0)
    warnings.warn(
        f"restitution by {chosen} balance is {found:.4g} for this geometry, which is not physical; 0 is "
        "used instead (the structure is too squat to rock from side to side), so give a measured value.",
        StructureWarning,
        stacklevel=4,
    )
    return 0.0


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
