"""Rigid parts that move with one rotation φ ≥ 0 to one side, and what acts on them: all of a side follows from these.

Points are complex, x + iy, x towards the side of rocking; the negative side is seen in the mirror. A constant force and
an elastic tie have a potential, so they add to G(φ); a mass that moves along adds to I, G and B. Masses and forces are
in one unit (weights in N per metre of wall, say), which cancels.

Every momentum balance is one equation. Just before the impact at φ = 0 the parts move with the velocity field u of one
side, just after with η times the field v of the other; the impulses act where the new mechanism turns and do no work on
it, so ⟨η v − u, v⟩ = 0 in the mass inner product and η = ⟨u, v⟩ / ⟨v, v⟩. For a block this is Housner's
1 − 1.5 sin²α, for the mid-height wall (1 − 4.5 sin²α)/(1 + 3 sin²α), for the frame Makris and Vassiliou's value.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Literal, NamedTuple, Self, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from rocking.errors import DoesNotStandError, StructureError
from rocking.quantities import GRAVITY
from rocking.structures.kinds import StructureKind
from rocking.structures.mechanism import Mechanism, Side, SideTie, Tie
from rocking.warnings import RockingWarning


class UnknownContacts(StructureError):
    """Contact forces that the mechanism alone does not determine; the message says why."""


class MotionState(NamedTuple):
    """A structure at k instants, each seen from the side to which it rocks: (k,) each.

    sign: the side. rotation ≥ 0 [rad], velocity [rad/s], acceleration [rad/s²] and ground ü_g [m/s²] are times the
    sign; vertical is ü_v [m/s²]. largest: the largest rotation on that side so far [rad], which ties remember. resting:
    whether it is at rest and nothing says that it accelerates.
    """

    sign: np.ndarray
    rotation: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    ground: np.ndarray
    vertical: np.ndarray
    largest: np.ndarray
    resting: np.ndarray

    @classmethod
    def of(
        cls,
        mechanism: Mechanism,
        rotation: ArrayLike,
        velocity: ArrayLike,
        acceleration: ArrayLike | None = None,
        ground: ArrayLike = 0.0,
        vertical: ArrayLike = 0.0,
        largest: ArrayLike | None = None,
    ) -> Self:
        """Return the states of signed rotations, velocities and accelerations; at rest the velocity gives the side.

        acceleration None: that of the mechanism, 0 at rest. largest None: within the states given.
        """
        states = np.broadcast_arrays(rotation, velocity, ground, vertical)
        phi, speed, push, lift = (np.atleast_1d(np.asarray(values, dtype=float)) for values in states)
        so_far = largest_so_far(phi) if largest is None else np.maximum(np.abs(phi), largest)
        resting = np.full(phi.shape, acceleration is None) & (phi == 0) & (speed == 0)
        if acceleration is None:
            moving = mechanism.angular_acceleration(phi, speed, push, lift, so_far)
            acceleration = np.where(resting, 0.0, moving)
        sign = mechanism.side_of(phi, speed)
        turn = np.broadcast_to(np.asarray(acceleration, dtype=float), phi.shape)
        return cls(sign, phi * sign, speed * sign, turn * sign, push * sign, lift, so_far, resting)

    @property
    def pull(self) -> np.ndarray:
        """ü_g + i (ü_v + g), what the ground's motion and gravity ask of every mass."""
        result: np.ndarray = self.ground + 1j * (self.vertical + GRAVITY)
        return result


def largest_so_far(rotation: np.ndarray) -> np.ndarray:
    """Return the largest rotation [rad] so far on the side of each of the signed `rotation`, (k,)."""
    to_positive = np.maximum.accumulate(np.maximum(rotation, 0.0))
    to_negative = np.maximum.accumulate(np.maximum(-rotation, 0.0))
    return np.where(rotation < 0, to_negative, to_positive)


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


Owner = TypeVar("Owner")


@dataclass(frozen=True, eq=False)
class Kinematics:
    """k parts at some rotations of the mechanism, and their first and second derivatives with φ.

    hinges: (h, ...) complex contact points. angles: (k, ...) counterclockwise turn of each part from rest, rad; spins
    and spin_slopes: its derivatives. centroids, velocities, accelerations: (k, ...) complex, with their derivatives.
    """

    hinges: np.ndarray = field(repr=False)
    angles: np.ndarray = field(repr=False)
    spins: np.ndarray = field(repr=False)
    spin_slopes: np.ndarray = field(repr=False)
    centroids: np.ndarray = field(repr=False)
    velocities: np.ndarray = field(repr=False)
    accelerations: np.ndarray = field(repr=False)


class PointMotion(NamedTuple):
    """Points at rotations of any shape: how far they moved from rest, and the derivatives with φ; complex, m."""

    moved: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


_FOLLOWED = 0.99
"""Share of the rotation where the geometry ends by which rotations are measured that can overturn nothing."""

STILL = -1
"""The number of a part that does not move."""

HIGHEST_SHARE = 0.95
"""Share of the height, or of the span between two supports, up to which a crack or a hinge is moved; a hinge also stays
that far above the lower support."""


class Hung(NamedTuple):
    """What acts on a part at a point: a constant force, a tie, or a mass that moves along.

    start: the point at rest. part: its number, or STILL. force: towards the side of rocking and upwards, growing and
    falling with g + ü_v. tie: None where it does not act on this side; friction pulls as one that yields at once.
    """

    kind: Literal["load", "thrust", "tie", "friction"]
    start: complex
    part: int
    force: complex = 0j
    mass: float = 0.0
    tie: Tie | None = None

    @property
    def acts(self) -> bool:
        """Whether it does anything on this side."""
        return self.part != STILL and bool(self.force or self.mass or self.tie)


def keeps_last(method: Callable[[Owner, np.ndarray], Kinematics]) -> Callable[[Owner, ArrayLike], Kinematics]:
    """Let `motion` keep what it returned last: I, G and B of the same places are asked for in turn."""

    @wraps(method)
    def keeping(self: Owner, rotation: ArrayLike) -> Kinematics:
        places = np.asarray(rotation, dtype=float)
        last: tuple[np.ndarray, Kinematics] | None = self.__dict__.get("_last")
        if last is None or not np.array_equal(last[0], places):
            last = self.__dict__["_last"] = places.copy(), method(self, places)
        return last[1]

    return keeping


def cross(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the cross product of plane vectors given as complex numbers."""
    result: np.ndarray = one.real * other.imag - one.imag * other.real
    return result


def _sum(weights: np.ndarray, terms: np.ndarray) -> np.ndarray:
    """Σ weight · term over the k parts, of terms (k, ...): as numpy.tensordot does, in a fifth of its time."""
    result: np.ndarray = (weights @ terms.reshape(weights.size, -1)).reshape(terms.shape[1:])
    return result


class Parts(NamedTuple):
    """Rigid parts at rest, (k,) each: their masses, centres of mass, complex, and inertias about these."""

    masses: ArrayLike
    centres: ArrayLike
    inertias: ArrayLike


class Linkage(ABC):
    """Parts that move as one mechanism on one side; a subclass gives their motion and the force at their hinges.

    masses, inertias (about the centroids): (k,), those of `hung` masses last. rest: (k,) centroids at rest, m. unit:
    what I, I', G, G' and B are divided by. end_rotation: where the geometry ends, rad. critical: φ_cr where it has a
    formula, rad; None: where G first vanishes.
    """

    masses: np.ndarray
    inertias: np.ndarray
    rest: np.ndarray
    end_rotation: float
    unit: float = 1.0
    critical: float | None = None
    hung: tuple[Hung, ...] = ()

    def _hang(self, parts: Parts, hung: Sequence[Hung]) -> None:
        """Take the rigid parts and what of `hung` acts; its `loads`, whose mass moves along, are the last parts."""
        self.hung = tuple(force for force in hung if force.acts)
        self.loads = [hung for hung in self.hung if hung.mass]
        self.masses = np.append(parts.masses, [load.mass for load in self.loads])
        self.rest = np.append(parts.centres, [load.start for load in self.loads])
        self.inertias = np.append(parts.inertias, np.zeros(len(self.loads)))

    @abstractmethod
    def motion(self, rotation: ArrayLike) -> Kinematics:
        """Return the parts at `rotation` ≥ 0 [rad], any shape."""

    @abstractmethod
    def contacts(self, state: MotionState) -> Contacts:
        """Return the contact forces in a state on this side; raises UnknownContacts, which says why, without them."""

    def carried(self, part: int, start: complex | np.ndarray, motion: Kinematics) -> PointMotion:
        """Return how points fixed to a part have moved from `start`, where they are at rest."""
        arm = (start - self.rest[part]) * np.exp(1j * motion.angles[part])
        spin = motion.spins[part]
        return PointMotion(
            motion.centroids[part] + arm - start,
            motion.velocities[part] + 1j * spin * arm,
            motion.accelerations[part] + (1j * motion.spin_slopes[part] - spin**2) * arm,
        )

    def point(self, part: int, start: complex | np.ndarray, rotation: ArrayLike) -> PointMotion:
        """Return how points fixed to a part have moved at `rotation` [rad] from `start`, where they are at rest."""
        return self.carried(part, start, self.motion(rotation))

    def moved_from_bearings(self, rotation: ArrayLike) -> np.ndarray:
        """Return how far it has moved sideways below what bears or pushes on it, m, shape of `rotation`.

        Of several floors, beams or vaults the farthest; 0 of what bears none.
        """
        bearing = [hung for hung in self.hung if hung.kind in ("load", "thrust")]
        moved = [np.abs(self.point(hung.part, hung.start, rotation).moved.real) for hung in bearing]
        result: np.ndarray = np.max([np.zeros(np.shape(rotation)), *moved], axis=0)
        return result

    def inertia(self, rotation: ArrayLike) -> np.ndarray:
        """I = Σ m|r'|² + I_c ω², shape of `rotation`."""
        motion = self.motion(rotation)
        moving = _sum(self.masses, np.abs(motion.velocities) ** 2)
        result: np.ndarray = (moving + _sum(self.inertias, motion.spins**2)) / self.unit
        return result

    def inertia_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dI/dφ = 2 Σ m r'·r'' + I_c ω ω'."""
        motion = self.motion(rotation)
        turning = _sum(self.inertias, motion.spins * motion.spin_slopes)
        moving = _sum(self.masses, (motion.velocities.conj() * motion.accelerations).real)
        result: np.ndarray = 2 * (moving + turning) / self.unit
        return result

    def weight(self, rotation: ArrayLike) -> np.ndarray:
        """Σ m y', the part of G that is the weight of the masses."""
        return _sum(self.masses, self.motion(rotation).velocities.imag) / self.unit

    def ground(self, rotation: ArrayLike) -> np.ndarray:
        """B = Σ m x'."""
        return _sum(self.masses, self.motion(rotation).velocities.real) / self.unit

    def gravity(self, rotation: ArrayLike) -> np.ndarray:
        """G: what masses, forces and ties restore, where the rotation was never larger."""
        at = np.asarray(rotation, dtype=float)
        return sum((tie.moment(at, at) for tie in self.ties), self.untied_gravity(at))

    def untied_gravity(self, rotation: ArrayLike) -> np.ndarray:
        """G without the ties."""
        powers = [
            (hung.force.conjugate() * self.point(hung.part, hung.start, rotation).velocity).real
            for hung in self.hung
            if hung.force
        ]
        return self.weight(rotation) - sum(powers, np.zeros(())) / self.unit

    def gravity_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dG/dφ; of a tie between yield and rupture that of the force it keeps."""
        slopes = []
        for hung in self.hung:
            point = self.point(hung.part, hung.start, rotation)
            if hung.tie:
                slopes.append(hung.tie.slope(*(coordinate.real for coordinate in point)))
            elif hung.force:
                slopes.append(-(hung.force.conjugate() * point.acceleration).real)
        weight = _sum(self.masses, self.motion(rotation).accelerations.imag) / self.unit
        return weight + sum(slopes, np.zeros(())) / self.unit

    @cached_property
    def ties(self) -> tuple[SideTie, ...]:
        """The ties as the side has them, in the unit of G per m."""

        def side_tie(hung: Hung, tie: Tie) -> SideTie:
            def point(rotation: np.ndarray) -> PointMotion:
                return self.point(hung.part, hung.start, rotation)

            return SideTie(
                tie.over(self.unit), lambda phi: point(phi).moved.real, lambda phi: point(phi).velocity.real
            )

        return tuple(side_tie(hung, hung.tie) for hung in self.hung if hung.tie)

    def side(self, restitution: float) -> Side:
        """Return the side of rocking. Raises DoesNotStandError where nothing restores at rest."""
        if not self.gravity(0.0) > 0:
            raise DoesNotStandError.saying(RockingWarning(StructureKind.FALLS_AT_REST))
        critical = self._first_zero() if self.critical is None else self.critical
        return Side(
            inertia=self.inertia,
            inertia_slope=self.inertia_slope,
            gravity=self.gravity,
            gravity_slope=self.gravity_slope,
            ground=self.ground,
            critical_rotation=self.end_rotation * _FOLLOWED if critical is None else critical,
            end_rotation=self.end_rotation,
            restitution=restitution,
            ties=self.ties,
            untied_gravity=self.untied_gravity,
            can_overturn=critical is not None,
        )

    def _first_zero(self) -> float | None:
        """The rotation at which G first vanishes within (0, end_rotation), or a tie lets it fall below zero, rad.

        None where it does not vanish.
        """
        from scipy.optimize import brentq  # slow to import, and not needed by what has a formula

        bends = [bend for tie in self.ties for bend in tie.bends(self.end_rotation)]
        steps = np.linspace(0.0, self.end_rotation, 513)
        places = np.unique(np.concatenate([steps, bends, np.nextafter(bends, np.inf)]))
        falls = np.flatnonzero(self.gravity(places) <= 0)
        if not falls.size:
            return None
        before = places[falls[0] - 1]
        after = places[falls[0]]
        # Where a tie breaks, a rotation alone may be rounded otherwise than in a row.
        while bends and self.gravity(before) <= 0:
            before, after = np.nextafter(before, 0.0), before
        while bends and self.gravity(after) > 0:
            after = np.nextafter(after, np.inf)
        critical = float(brentq(self.gravity, before, after, xtol=1e-16, rtol=1e-15))
        while bends and critical < after and self.gravity(critical) > 0:
            critical = float(np.nextafter(critical, np.inf))  # where a tie breaks, the far side of the fall
        return critical

    def dalembert(self, state: MotionState) -> tuple[np.ndarray, np.ndarray]:
        """Return weight, inertia and what acts on each part in motion: forces (k, n), complex, and couples (k, n)."""
        motion = self.motion(state.rotation)
        furthest = self.motion(state.largest)
        centre = motion.accelerations * state.velocity**2 + motion.velocities * state.acceleration
        spin = motion.spin_slopes * state.velocity**2 + motion.spins * state.acceleration
        forces = -self.masses[:, None] * (centre + state.pull)
        couples = -self.inertias[:, None] * spin
        for hung in self.hung:
            point = self.carried(hung.part, hung.start, motion)
            force: np.ndarray = hung.force * state.pull.imag
            if hung.tie:
                largest = self.carried(hung.part, hung.start, furthest).moved
                force = -hung.tie.tension(point.moved.real, largest.real) * GRAVITY + 0j
            forces[hung.part] += force
            couples[hung.part] += cross(hung.start + point.moved - motion.centroids[hung.part], force)
        return forces, couples


class Turning(Linkage):
    """Parts that turn together about a `corner` to the right of their centre of mass, clockwise, until they lie.

    slenderness: of that centre, rad, where it is given rather than the centre; end_rotation: where they lie, rad.
    inertia_length: I_O over the static moment, m.
    """

    def __init__(
        self,
        corner: complex,
        parts: Parts,
        hung: Sequence[Hung] = (),
        *,
        slenderness: float | None = None,
        end_rotation: float = np.pi / 2,
    ) -> None:
        self.corner = corner
        self.end_rotation = end_rotation
        self._hang(parts, hung)
        moment = complex(self.masses @ (self.rest - corner))
        self.unit = abs(moment)
        self.slenderness = (
            float(np.arctan2(-moment.real, moment.imag)) if slenderness is None else slenderness
        )
        self.critical = None if any(hung.force or hung.tie for hung in self.hung) else self.slenderness
        inertia = self.inertias.sum() + self.masses @ np.abs(self.rest - corner) ** 2
        self.inertia_length = float(inertia / self.unit)

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Kinematics:
        """Return the parts at `rotation` ≥ 0, any shape; the corner is the hinge."""
        arms = np.multiply.outer(self.rest - self.corner, np.exp(-1j * rotation))
        spins = -np.ones(arms.shape)
        return Kinematics(
            hinges=np.full((1, *rotation.shape), self.corner),
            angles=spins * rotation,
            spins=spins,
            spin_slopes=np.zeros_like(spins),
            centroids=self.corner + arms,
            velocities=-1j * arms,
            accelerations=-arms,
        )

    def carried(self, part: int, start: complex | np.ndarray, motion: Kinematics) -> PointMotion:
        """Return how points have moved; small rotations keep their relative accuracy."""
        return self._turned(start, motion.angles[part])

    def point(self, part: int, start: complex | np.ndarray, rotation: ArrayLike) -> PointMotion:
        """Return how points have moved, without the motion of the parts: all turn together."""
        return self._turned(start, -np.asarray(rotation, dtype=float))

    def _turned(self, start: complex | np.ndarray, angle: np.ndarray) -> PointMotion:
        """The movement of points at `start` as all has turned by `angle` [rad], counterclockwise."""
        arm = start - self.corner
        half = np.exp(0.5j * angle)
        turn = np.exp(1j * angle)
        return PointMotion(2j * arm * np.sin(angle / 2) * half, -1j * arm * turn, -arm * turn)

    def inertia(self, rotation: ArrayLike) -> np.ndarray:
        """I_O over the static moment; 4R/3 for a rectangular block (Eq. 1)."""
        return np.full(np.shape(rotation), self.inertia_length)

    def inertia_slope(self, rotation: ArrayLike) -> np.ndarray:
        return np.zeros(np.shape(rotation))

    def weight(self, rotation: ArrayLike) -> np.ndarray:
        """sin(α − φ)."""
        return np.sin(self.slenderness - np.asarray(rotation))

    def ground(self, rotation: ArrayLike) -> np.ndarray:
        """cos(α − φ)."""
        return np.cos(self.slenderness - np.asarray(rotation))

    def contacts(self, state: MotionState) -> Contacts:
        """Return the force at the corner, per mass of all that moves."""
        forces, _ = self.dalembert(state)
        total = -forces.sum(axis=0, keepdims=True) / self.masses.sum()
        return Contacts(("corner",), total.imag, total.real)


Restitution = float | str | None
"""η in [0, 1], the name of a balance, or None for the structure's default."""


def momentum_balance(
    masses: np.ndarray,
    inertias: np.ndarray,
    arriving: tuple[np.ndarray, np.ndarray],
    leaving: tuple[np.ndarray, np.ndarray],
) -> float:
    """Return η = ⟨u, v⟩ / ⟨v, v⟩, which may be negative.

    masses, inertias (about each centre of mass): (k,). arriving, leaving: complex velocities of the centres and spins
    (k,) each for φ' = 1 on the one side and, seen in the mirror, on the other.
    """
    u, turn = arriving
    v, turn_after = leaving
    shared = masses @ (u * v).real + inertias @ (turn * turn_after)
    return float(shared / (masses @ np.abs(v) ** 2 + inertias @ turn_after**2))


PRESSED = 0.85
"""Share of the compressive strength at which the edge of a joint is pressed all over."""


def inset(*, pressing: float, strength: float | None, breadth: float) -> float:
    """Return how far in from its edge a hinge lies, m: N/(1.7 f_c), the middle of what is pressed at .85 f_c.

    pressing: N on the joint, N per metre of edge. strength: f_c, Pa; None where nothing crushes. breadth: of the joint,
    m. Raises DoesNotStandError where all of it is pressed.

    >>> round(inset(62680.0, 1.5e6, 0.35), 6)
    0.02458
    """
    if strength is None:
        return 0.0
    depth = pressing / (PRESSED * strength)
    check_pressed(pressed=depth, whole=breadth)
    return depth / 2


def check_pressed(*, pressed: float, whole: float) -> None:
    """Refuse a joint of which the part that is pressed at rest is not less than the whole, both in m or in m²."""
    if not pressed < whole:
        raise DoesNotStandError(
            "the structure does not stand: at rest its weight crushes a joint over "
            f"{pressed / whole:.4g} times its breadth; correct compressive_strength, or the sizes and loads above it.",
            compressive_strength=None,
        )


IMPACTS = 2.8
"""Largest force of a tie in motion over that at rest, as the wall strikes it: 10–90 % are 1.9 to 4.8 (theory: section
12.4)."""
GRIPPED = 0.2
"""Height of the course that an anchor grips, m."""


class Reaction(NamedTuple):
    """What holds a wall sideways at a height [m]: a "tie", a "floor" or the "top", with its force, (k,) N per metre."""

    kind: str
    height: float
    force: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Restraint:
    """A height at which a tie or what lies on its top keeps a wall from moving outwards; forces in N per metre.

    kind: "tie" or "top". holds: the mechanism that it holds back, in words. needed: the force that this asks for at
    rest, as it starts (theory: section 12.4). friction: that of what presses on it. coefficient: of that friction, or
    of the joints around an anchor. ties: the force at which they yield, inf of such as have no strength. weight: of the
    wall per metre; 1 where that is not known, so that `needed` is a share of it. grip: the most that the wall gives
    around a tie, by friction above and below the course that it grips (theory: section 13.3); inf of what is no tie.
    spacing: of the ties along the wall, m; None where it is not known.
    """

    kind: str
    height: float
    holds: str
    needed: float
    friction: float
    coefficient: float
    ties: float
    weight: float
    grip: float
    spacing: float | None

    @property
    def gives(self) -> float:
        """The force up to which it holds, N per metre."""
        return self.friction + self.ties

    @property
    def lets_go(self) -> bool:
        """Whether it moves before the wall behind it does."""
        return self.needed > self.gives

    @property
    def most(self) -> float:
        """The most that a tie may get, N per metre: the force at which it yields, or else that of the impacts."""
        return self.ties if self.ties < float("inf") else IMPACTS * self.needed

    @property
    def warnings(self) -> tuple[RockingWarning, ...]:
        """What it needs and gives, per metre and of each tie, and whether its anchor may slide out."""
        each = []
        if self.spacing is not None:
            forces = {
                "needed_kN": self.needed * self.spacing / 1e3,
                "grip_kN": self.grip * self.spacing / 1e3,
            }
            about = {"height_m": self.height, "spacing_m": self.spacing}
            each.append(RockingWarning.of(StructureKind.EACH_TIE, self.holds, **about, **forces))
        return (self.warning, *each, *filter(None, [self.slides_out]))

    @property
    def slides_out(self) -> RockingWarning | None:
        """A warning where a tie may get more than the wall around it gives; None where not."""
        if not self.most > self.grip:
            return None
        facts = {"height_m": self.height, "most_kN_m": self.most / 1e3, "grip_kN_m": self.grip / 1e3}
        return RockingWarning.of(StructureKind.ANCHOR_SLIDES, self.holds, **facts, friction=self.coefficient)

    @property
    def warning(self) -> RockingWarning:
        """The two forces, and what follows from them."""
        about = self.holds
        facts = {"height_m": self.height, "needed_kN_m": self.needed / 1e3}
        given = facts | {"gives_kN_m": self.gives / 1e3}
        if self.kind == "tie":
            if self.ties == float("inf"):
                return RockingWarning.of(StructureKind.TIE_MUST_BEAR, about, **facts)
            return RockingWarning.of(
                StructureKind.TIE_YIELDS if self.lets_go else StructureKind.TIE_BEARS, about, **given
            )
        if self.gives == float("inf"):
            if self.weight == 1.0:
                return RockingWarning.of(StructureKind.TOP_TAKEN_AS_HELD, about, share=self.needed)
            return RockingWarning.of(StructureKind.TOP_MUST_BE_HELD, about, **facts)
        kind = StructureKind.TOP_SLIPS if self.lets_go else StructureKind.TOP_HOLDS
        more = {"tie_kN_m": (self.needed - self.friction) / 1e3} if self.lets_go else {}
        return RockingWarning.of(kind, about, **given, friction=self.coefficient, **more)
