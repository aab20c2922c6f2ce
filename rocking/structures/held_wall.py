"""A wall that something holds at several heights, and its family of mechanisms (theory: section 12).

x outwards, z up from the ground; forces per metre of wall. To first order the wall is a row of kinks: at a joint z_j
the part above turns against the part below by ω_j, outwards positive, about the edge in contact, so that a point moves
outwards by u(z) = Σ ω_j (z − z_j)₊. What rises is G(0), what is pushed B(0), and λ = G(0)/|B(0)|.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import KW_ONLY, dataclass, replace
from functools import cached_property
from itertools import pairwise
from operator import itemgetter
from typing import NamedTuple

import numpy as np

from rocking.structures.drawing import rectangle
from rocking.structures.joints import Joints
from rocking.structures.linkage import (
    HIGHEST_SHARE,
    STILL,
    Contacts,
    Hung,
    Kinematics,
    Linkage,
    MotionState,
    Parts,
    Turning,
    UnknownContacts,
    cross,
    inset,
    keeps_last,
)
from rocking.structures.mechanism import Tie
from rocking.warnings import Phrase

_MARGIN = 0.9
"""Share of the reach of either body that the motion may use: where one of them lies flat the linkage locks."""


class Chain(Linkage):
    """A lower body that turns about its foot, an upper one hinged to it, and perhaps one that stays upright on top.

    hinges: of the lower body on what stands still, and between the two bodies. held: the point of the upper body that
    only moves up and down; None: the upper body does not turn, and moves with its hinge. bodies: (k,) the body of each
    part: 0 the lower one, 1 the upper one, 2 what stays upright and rises with `held`, about which the upper body turns
    against it. forwards: whether the lower body turns towards the side of rocking; it kicks back where it does not.
    guided: whether the loads move up and down only.
    """

    def __init__(
        self,
        hinges: tuple[complex, complex],
        held: complex | None,
        parts: Parts,
        hung: Sequence[Hung] = (),
        *,
        bodies: Sequence[int] = (0, 1),
        forwards: bool = True,
        guided: bool = False,
    ) -> None:
        self._foot, self._hinge = hinges
        self._is_held = held is not None
        self._held = self._hinge + 1j if held is None else held
        self._lower = self._hinge - self._foot
        self._upper = self._held - self._hinge
        self._turn = -1.0 if forwards else 1.0
        self._guided = guided
        self._hang(parts, hung)
        self._bodies = np.array([*bodies, *(bodies[load.part] for load in self.loads)])
        self.unit = float(np.sum(parts.masses))

        # Neither arm may come to lie flat; from the reach of the upper one follows how far the lower one may lean.
        reach = abs(self._upper)
        across = self._upper.real
        if forwards:
            farthest = min(-_MARGIN * reach, across - _MARGIN * (reach + across))
        else:
            farthest = max(_MARGIN * reach, across + _MARGIN * (reach - across))
        if not self._is_held:
            farthest = self._turn * np.inf
        lean = (self._lower.real + across - farthest) / abs(self._lower)
        # The lower one may start as flat as it likes: only where it ends it must not lie flat.
        lying = np.arccos(np.clip(lean, *((-1.0, _MARGIN) if forwards else (-_MARGIN, 1.0))))
        self.end_rotation = float(min(abs(lying - np.angle(self._lower)), np.pi / 2))
        middles = self._foot + self._lower / 2, self._hinge + self._upper / 2
        if self._are_halves(middles):
            self.critical = float(abs(np.angle(self._lower) - np.pi / 2))

    def _are_halves(self, middles: tuple[complex, complex]) -> bool:
        """Whether it is two blocks alone that turn about their corners, from one edge to the other and back.

        Both are then upright at once, at the slenderness of the lower one, where no search leaves a rest of rounding.
        """
        if self.hung or self.rest.shape != (2,) or not self._is_held:
            return False
        asides = [*(self.rest - middles), (self._lower + self._upper).real]
        return bool(np.abs(asides).max() < _SAME * abs(self._lower))

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Kinematics:
        """Return the bodies at `rotation` ≥ 0, any shape; hinges at the foot, between the bodies and where it is held.

        With arms l₀ and l₁ turned by a₀ = ∓φ and a₁, Re(l₀ + l₁) stays what it is at rest; a₁ = 0 where none is held.
        """
        lower = self._lower * np.exp(1j * self._turn * rotation)
        # Re l₀ moves by −2 Im(…) of the half angle, without cancellation
        shift = (
            self._is_held
            * (
                2j * self._lower * np.sin(self._turn * rotation / 2) * np.exp(0.5j * self._turn * rotation)
            ).real
        )
        across = self._upper.real - shift
        up = np.sqrt(self._upper.imag**2 + shift * (self._upper.real + across))
        upper = across + 1j * up
        angle = np.angle(upper * self._upper.conjugate())
        spin = -self._is_held * self._turn * lower.imag / up
        bend = -self._is_held * (lower.real + spin**2 * across) / up

        hinge = self._foot + lower
        held = hinge + upper
        still = np.zeros_like(up)
        turning = 1j * self._turn
        rolling = 1j * bend - spin**2
        turns = np.array([self._turn * rotation, angle, still])
        spins = np.array([self._turn + still, spin, still])
        slopes = np.array([still, bend, still])
        moved = np.array([still, hinge - self._hinge, 1j * (held - self._held).imag])
        velocities = np.array([still, turning * lower, 1j * (turning * lower + 1j * spin * upper).imag])
        accelerations = np.array([still, -lower, 1j * (-lower + rolling * upper).imag])

        of = self._bodies
        fixed = np.array([self._foot, self._hinge, self._held])[of]
        arms = (self.rest - fixed).reshape(-1, *(1,) * up.ndim) * np.exp(1j * turns[of])
        motion = Kinematics(
            hinges=np.array([self._foot + still, hinge, held]),
            angles=turns[of],
            spins=spins[of],
            spin_slopes=slopes[of],
            centroids=fixed.reshape(-1, *(1,) * up.ndim) + moved[of] + arms,
            velocities=velocities[of] + 1j * spins[of] * arms,
            accelerations=accelerations[of] + (1j * slopes[of] - spins[of] ** 2) * arms,
        )
        return self._guided_loads(motion) if self._guided and self.loads else motion

    def _guided_loads(self, motion: Kinematics) -> Kinematics:
        """The motion where the loads, which are its last parts, rise with their bearings and move to no side."""
        loads = slice(-len(self.loads), None)
        centroids, velocities, accelerations = (
            quantity.copy() for quantity in (motion.centroids, motion.velocities, motion.accelerations)
        )
        starts = self.rest[loads].reshape(-1, *(1,) * (centroids.ndim - 1))
        centroids[loads] = starts.real + 1j * centroids[loads].imag
        velocities[loads] = 1j * velocities[loads].imag
        accelerations[loads] = 1j * accelerations[loads].imag
        return replace(motion, centroids=centroids, velocities=velocities, accelerations=accelerations)

    def contacts(self, state: MotionState) -> Contacts:
        """Return the contact forces at foot and hinge, per mass of the masonry that moves."""
        motion, forces, _, above = self._balanced(state)
        at_hinge = -(forces[1] + above)
        thrusts = np.stack([at_hinge - forces[0], at_hinge]) / self.unit
        upper = int(np.argmax(self._bodies == 1))
        joint = 1j * np.exp(1j * (motion.angles[0] + motion.angles[upper]) / 2)
        return Contacts.resolved(("foot", "hinge"), thrusts, np.stack([1j + 0 * joint, joint]))

    def holding(self, state: MotionState, stop: float | None) -> np.ndarray:
        """Return the forces that hold it back sideways, (2, k), in the unit of the masses times m/s².

        At the point that is held, and at the height `stop` [m] of the body that stays upright on top, where something
        keeps it from turning; 0 there without such a body. Against the side of rocking positive.
        """
        motion, forces, couple, above = self._balanced(state)
        turned_back = np.zeros_like(couple)
        if stop is not None and (self._bodies == 2).any():
            turned_back = -couple / (stop - motion.hinges[2].imag)
        return np.stack([forces[2].real - above.real - turned_back, turned_back])

    def _balanced(self, state: MotionState) -> tuple[Kinematics, list[np.ndarray], np.ndarray, np.ndarray]:
        """The motion, the forces on the three bodies, the couple on the third about what is held, and the force on the
        upper body there.

        What holds the upper body gives a horizontal force alone, which follows from its balance about the hinge.
        """
        if not self._is_held:
            raise UnknownContacts("the couple by which the slab keeps the wall upright is not known.")
        motion = self.motion(state.rotation)
        forces, couples = self.dalembert(state)
        places = motion.centroids.copy()
        if self._guided:
            for place, load in enumerate(self.loads, start=forces.shape[0] - len(self.loads)):
                forces[place] = 1j * forces[place].imag  # the floor holds them sideways
                places[place] = load.start + self.carried(load.part, load.start, motion).moved
        _, hinge, held = motion.hinges
        on_body = [forces[self._bodies == body].sum(axis=0) for body in range(3)]

        def about(point: np.ndarray, body: int) -> np.ndarray:
            own = self._bodies == body
            result: np.ndarray = (cross(places[own] - point, forces[own]) + couples[own]).sum(axis=0)
            return result

        carried = 1j * on_body[2].imag
        moment = about(hinge, 1) + cross(held - hinge, carried)
        above = carried + moment / (held - hinge).imag
        return motion, on_body, about(held, 2), above


_JOINTS = 12
"""Joints between two heights at which something changes; hinges move to where λ is least between them."""
_GRIPS = 1e-3
"""Movement back over which the friction at a top that has slipped comes to nothing, m."""
LEAST_STIFFNESS = 1e-12
"""The least stiffness of a tie, N/m²: below it the rotation at which it yields is no number any more."""
SLIDES = 0.5
"""Share of the thickness by which what an anchor grips slides out before it lets go of it."""
_SAME = 1e-9
"""Share of the height below which a movement is none, and two heights are one."""


@dataclass(frozen=True, kw_only=True)
class Opening:
    """One mechanism of a held wall: where it opens, and to which side it falls.

    foot: of the part that turns, m above the ground. hinge: where that part ends and another one turns back; None: one
    body, which turns about its foot. hold: of the point that only moves up and down, m; None where a slab that stays
    flat keeps the upper body from turning while it moves out. upright: what stands above the hold stays upright and
    rises; otherwise it turns with the upper body. outwards: the side of the forcing and of the
    fall. forwards: whether the lower part moves to that side; otherwise it kicks back, and the upper one falls.
    between: it falls between two ties of a row, where these hold nothing (theory: section 13.2). As one body with a
    `hold` it is a triangle: it turns about the line on its face from its foot, midway between the ties, to each of them
    at `hold`. Below a top that friction alone holds, and which slips, it is all of the wall.
    """

    foot: float
    hinge: float | None = None
    hold: float | None = None
    _: KW_ONLY
    upright: bool = False
    outwards: bool = True
    forwards: bool = True
    between: bool = False

    @property
    def is_triangle(self) -> bool:
        """Whether it is the triangle between two ties."""
        return self.between and self.hinge is None and self.hold is not None

    @property
    def kinks(self) -> tuple[tuple[float, float], ...]:
        """The height of each joint that opens [m] and its ω, outwards positive, where the lower part turns by 1."""
        turn = 1.0 if self.outwards == self.forwards else -1.0
        if self.hinge is None:
            return ((self.foot, turn),)
        back = 0.0 if self.hold is None else (self.hinge - self.foot) / (self.hold - self.hinge)
        bulge = ((self.foot, turn), (self.hinge, -turn * (1 + back)))
        return (*bulge, (self.hold, turn * back)) if self.upright and self.hold else bulge

    def body_at(self, height: float) -> int:
        """Return the body, from 0, on which what acts at `height` [m] above its foot acts: at a joint the lower one."""
        tops = [top for top in (self.hinge, self.hold if self.upright else None) if top is not None]
        return sum(height > top for top in tops)

    @property
    def lean_of_top(self) -> int:
        """The side to which the uppermost body leans, outwards 1, inwards −1; 0 where it stays upright."""
        return 0 if self.upright else int(np.sign(sum(turn for _, turn in self.kinks)))


class Storey(NamedTuple):
    """A rectangle of masonry from `low` to `high` and from `left` to `right`, m; its weight per height, N/m².

    narrows: the share of its breadth along the wall that is left at its top, as of a gable; `weight` is that at its
    foot, and forces per metre are those per metre of that.
    """

    low: float
    high: float
    left: float
    right: float
    weight: float
    narrows: float = 1.0

    def breadth(self, height: float) -> float:
        """Return the share of its breadth at a height [m]."""
        if self.narrows == 1:
            return 1.0
        return 1 - (1 - self.narrows) * (height - self.low) / (self.high - self.low)

    def cut(self, low: float, high: float) -> "Storey":
        """Return the part between two heights [m] on it."""
        foot = self.breadth(low)
        narrows = self.breadth(high) / foot if self.narrows != 1 else 1.0
        return self._replace(low=low, high=high, weight=self.weight * foot, narrows=narrows)

    @property
    def total(self) -> float:
        """Its weight, N per metre."""
        return self.weight * (self.high - self.low) * (1 + self.narrows) / 2

    @property
    def middle(self) -> float:
        """The height of its centre of mass, m."""
        if self.narrows == 1:
            return (self.low + self.high) / 2
        return self.low + (self.high - self.low) * (1 + 2 * self.narrows) / (3 * (1 + self.narrows))

    def inertia(self, lean: float) -> float:
        """Its moment of inertia about its centre of mass, sheared by `lean`, in weight, N m."""
        across = (self.right - self.left) ** 2 / 12
        # ∫ b z² − M z_m² of a breadth that runs from 1 to n: h²/18 (1 + 4n + n²)/(1 + n)², h²/12 of a rectangle.
        slope = (1 + 4 * self.narrows + self.narrows**2) / (1 + self.narrows) ** 2 / 18
        return self.total * ((self.high - self.low) ** 2 * slope * (1 + lean**2) + across)


class Load(NamedTuple):
    """A weight [N/m] that bears at x, z [m]; it rides sideways, or something else holds its mass.

    slab: half the distance of the edges on which it lies as a slab that stays flat, m; 0 on a bearing. moves: whether
    its mass moves, at least up and down; otherwise only its weight acts.
    """

    x: float
    z: float
    weight: float
    rides: bool
    slab: float = 0.0
    moves: bool = True


class Hold(NamedTuple):
    """A height [m] that something keeps from moving sideways, outwards and inwards up to a force [N/m], 0 for none."""

    height: float
    kind: str
    outwards: float
    inwards: float

    @property
    def gives(self) -> bool:
        """Whether it may move outwards after all, as a tie that stretches or a top that slips."""
        return self.kind == "tie" or bool(np.isfinite(self.outwards))

    @property
    def both_ways(self) -> bool:
        """Whether it stops the wall to both sides."""
        return self.outwards > 0 and self.inwards > 0


class TieRow(NamedTuple):
    """Equal ties at `heights` [m], and how their anchors hold the wall along its length.

    apart: whether they are so far apart along the wall that it may fall between them. gripped: height of the masonry
    that each anchor grips, m. gripped_share: of the length of the wall that all anchors of a row grip.
    """

    tie: Tie
    heights: tuple[float, ...]
    apart: bool
    gripped: float
    gripped_share: float


@dataclass(frozen=True, eq=False)
class HeldWall:
    """Masonry, what bears and pushes on it, and what holds it.

    storeys: from the ground up. thrusts: height [m] and force outwards [N/m]. backed: cross walls stand behind it, so
    that nothing moves inwards. strength: f_c at which the edges of joints crush, Pa; or None. lean: how far it stands
    out of plumb outwards, per height, whereas x is given in plumb.
    """

    storeys: tuple[Storey, ...]
    loads: tuple[Load, ...]
    holds: tuple[Hold, ...]
    thrusts: tuple[tuple[float, float], ...]
    _: KW_ONLY
    row: TieRow
    backed: bool
    strength: float | None
    lean: float
    joints: Joints

    @property
    def height(self) -> float:
        """Of all storeys, m."""
        return self.storeys[-1].high

    def faces(self, height: float) -> tuple[float, float]:
        """Return about which points the joint at `height` [m] opens, inwards and outwards, m.

        They are the edges of the thinner storey that ends there, or lie where what presses on them crushes the edge.
        Raises DoesNotStandError where all of the joint crushes.
        """
        meeting = [storey for storey in self.storeys if storey.low <= height <= storey.high]
        inner = max(storey.left for storey in meeting)
        outer = min(storey.right for storey in meeting)
        breadth = next((storey.breadth(height) for storey in meeting if storey.high > height), 1.0)
        aside = inset(pressing=self.pressing(height) / breadth, strength=self.strength, breadth=outer - inner)
        return inner + aside + self.lean * height, outer - aside + self.lean * height

    def pressing(self, height: float) -> float:
        """Return what presses on the joint at `height` [m], N per metre."""
        masonry = sum(
            storey.cut(max(storey.low, height), storey.high).total
            for storey in self.storeys
            if storey.high > height
        )
        return masonry + sum(
            load.weight for load in self.loads if load.z > height or (load.slab and load.z == height)
        )

    def grip(self, height: float) -> float:
        """Return the most that the wall gives around an anchor at `height` [m] by friction, N per metre.

        That of what lies above it, with the floor that bears there, and of the masonry that it grips.
        """
        floor = sum(load.weight for load in self.loads if load.z == height and not load.slab)
        pressing = self.pressing(height) + floor + self.row.gripped * self._storey_at(height).weight
        return self.joints.friction * self.row.gripped_share * pressing

    def _storey_at(self, height: float) -> Storey:
        """The storey on which something acts at `height` [m]; at a joint the one below."""
        return next(storey for storey in self.storeys if storey.low < height <= storey.high)

    def anchored(self, height: float) -> Tie:
        """Return its tie at `height` [m], pulling with no more than the wall around its anchor gives.

        What it grips then slides out with it, by SLIDES of the thickness until it lets go.
        """
        tie = self.row.tie
        grip = self.grip(height)
        if not tie.stiffness:
            return replace(tie, pretension=min(tie.pretension, grip))
        if tie.strength <= grip:
            return tie
        storey = self._storey_at(height)
        return replace(
            tie,
            pretension=min(tie.pretension, grip),
            strength=grip,
            plastic_elongation=SLIDES * (storey.right - storey.left),
        )

    @cached_property
    def anchors_slide_at(self) -> float:
        """The least λ at which what an anchor grips slides out and the wall with it; inf where no anchor does.

        By limit analysis, in which a tie holds no more than the wall around its anchor gives.
        """
        held = tuple(
            hold._replace(outwards=min(hold.outwards, self.grip(hold.height))) if hold.kind == "tie" else hold
            for hold in self.holds
        )
        if held == self.holds:
            return math.inf
        drawn = [
            multiplier
            for opening, multiplier in replace(self, holds=held, row=self.row._replace(apart=False)).family()
            if any(hold.kind == "tie" and self.moved(opening.kinks, hold.height) > 0 for hold in held)
        ]
        return min(drawn, default=math.inf)

    def joint(self, height: float) -> tuple[float, float, float]:
        """Return M⁺ and M⁻, the moments of all weights above about the outer and the inner edge, and S of the masses.

        height: of the joint, m. Per metre of wall, N.
        """
        known: dict[float, tuple[float, float, float]] = self.__dict__.setdefault("_joints", {})
        if height not in known:
            weight = moment = push = 0.0
            for storey in self.storeys:
                foot = max(storey.low, height)
                if foot < storey.high:
                    above = storey.cut(foot, storey.high)
                    own = above.total
                    weight += own
                    moment += own * ((storey.left + storey.right) / 2 + self.lean * above.middle)
                    push += own * (above.middle - height)
            for load in self.loads:
                if load.z > height:
                    weight += load.weight
                    moment += load.weight * (load.x + self.lean * load.z)
                    push += load.weight * (load.z - height) * load.rides
            inner, outer = self.faces(height)
            known[height] = outer * weight - moment, moment - inner * weight, push
        return known[height]

    def virtual_work(self, kinks: Sequence[tuple[float, float]]) -> tuple[float, float]:
        """Return G(0) and B(0) of a row of kinks: heights [m] and ω; ties that move outwards at what they yield at."""
        restoring = pushed = 0.0
        for height, turn in kinks:
            outer, inner, lever = self.joint(height)
            restoring += turn * outer if turn > 0 else -turn * inner
            pushed += turn * lever
        lean = abs(sum(turn for _, turn in kinks))
        restoring += lean * sum(load.weight * load.slab for load in self.loads)
        for height, force in self.thrusts:
            restoring -= force * self.moved(kinks, height)
        for hold in self.holds:
            outwards = self.moved(kinks, hold.height)
            held = hold.outwards if outwards > 0 else hold.inwards
            if held and outwards:
                restoring += held * abs(outwards)
        return restoring, pushed

    def moved(self, kinks: Sequence[tuple[float, float]], height: float) -> float:
        """Return u, how far a point at `height` [m] moves outwards; 0 where that is rounding."""
        outwards = sum(turn * (height - joint) for joint, turn in kinks if height > joint)
        return outwards if abs(outwards) > _SAME * self.height else 0.0

    def multiplier(self, opening: Opening) -> float:
        """λ of an opening by limit analysis; inf where a tie without a strength keeps it shut."""
        if opening.is_triangle:
            works = [
                (share, *self._between_ties.virtual_work(replace(opening, foot=foot).kinks))
                for foot, share in self._strips(opening)
            ]
            restoring = sum(share * lifted for share, lifted, _ in works)
            pushed = sum(share * along for share, _, along in works)
        else:
            restoring, pushed = (self._between_ties if opening.between else self).virtual_work(opening.kinks)
        return restoring / abs(pushed)

    @cached_property
    def _between_ties(self) -> "HeldWall":
        """The wall as it is midway between two ties of a row, which hold nothing there; a top by its friction alone."""
        holds = [hold for hold in self.holds if hold.kind != "tie"]
        # What a top holds inwards is what ties do not give.
        left = [hold._replace(outwards=hold.inwards) if hold.kind == "top" else hold for hold in holds]
        return replace(self, holds=tuple(left), row=self.row._replace(apart=False))

    def _strips(self, opening: Opening) -> list[tuple[float, float]]:
        """The upright strips of a triangle between two ties: the height at which each one turns, m, and its share.

        The triangle moves as u = φ (z − z_f), where the line about which it turns lies at z_f; every strip is a wall
        that turns about its own foot there. Works and inertias are cubic in z_f between two heights at which something
        changes, for which two points of Gauss are exact.
        """
        assert opening.hold is not None
        changes = {load.z for load in self.loads} | {storey.low for storey in self.storeys}
        inner = sorted(height for height in changes if opening.foot < height < opening.hold)
        strips = []
        for low, high in pairwise([opening.foot, *inner, opening.hold]):
            middle, half = (low + high) / 2, (high - low) / 2
            share = half / (opening.hold - opening.foot)
            strips += [(middle + sign * half / np.sqrt(3), share) for sign in (-1, 1)]
        return strips

    def admits(self, kinks: Sequence[tuple[float, float]]) -> bool:
        """Whether what stands behind the wall lets it move so."""
        floors = [hold.height for hold in self.holds if hold.inwards == np.inf]
        places = [self.height, *(height for height, _ in kinks)] if self.backed else []
        if any(self.moved(kinks, height) < 0 for height in (*floors, *places)):
            return False
        ends = [hold.height for hold in self.holds if hold.outwards and not hold.gives]
        return not any(self.moved(kinks, height) > 0 for height in ends)

    def openings(self, joints: Sequence[float], feet: Sequence[float]) -> Iterator[Opening]:
        """Return every mechanism of the family that can form, its joints among `joints`, m above the ground.

        feet: those of them on which a bulge may stand. One body about its foot, or a bulge below a hold, and each of
        them the other way round: a vertex of the linear programme of limit analysis has one kink more than it has
        holds that keep a point where it is.
        """
        stays: set[float | None] = {hold.height for hold in self.holds}
        if self.backed:
            stays.add(self.height)
        if any(load.slab for load in self.loads):
            stays.add(None)
        for foot in joints:
            spans: list[tuple[float | None, float | None]] = [(None, None)]
            spans += [
                (hold, hinge)
                for hold in stays
                for hinge in joints
                if foot in feet and foot < hinge < (hold or self.height) * (1 - _SAME)
            ]
            for hold, hinge in spans:
                stands_above = hold is not None and hold < self.height * (1 - _SAME)
                for upright in (False, True) if stands_above else (False,):
                    yield from self._ways(Opening(foot=foot, hinge=hinge, hold=hold, upright=upright))
        if self.row.apart:
            yield from self._openings_between_ties(joints, feet)

    def _openings_between_ties(self, joints: Sequence[float], feet: Sequence[float]) -> Iterator[Opening]:
        """The triangle below the uppermost ties, or, below a top that is held all along, the wall without its ties."""
        ties = [hold.height for hold in self.holds if hold.kind == "tie"]
        if any(hold.kind == "top" for hold in self.holds):
            for opening in self._between_ties.openings(joints, feet):
                apart = replace(opening, between=True)
                if opening.outwards and self.multiplier(apart) < self.multiplier(opening):
                    yield apart
            return
        # A bonder holds its leaf all along, so that the triangle stands above the uppermost one.
        lowest = max((hold.height for hold in self.holds if hold.kind == "bonder"), default=0.0)
        yield from (
            Opening(foot=foot, hold=max(ties), between=True) for foot in feet if lowest <= foot < max(ties)
        )

    def _ways(self, opening: Opening) -> Iterator[Opening]:
        """The opening with its lower part outwards and inwards, each to the side to which the ground pushes it."""
        _, pushed = self.virtual_work(opening.kinks)
        for outwards in (True, False):
            way = replace(opening, outwards=outwards, forwards=bool(pushed > 0))
            # What pushes the other way holds a bulge only where a tie that yields pulls on it.
            is_held = self._is_held(way) or self._yields(way.kinks)
            if pushed and is_held and self.admits(way.kinks):
                yield way

    def _is_held(self, opening: Opening) -> bool:
        """Whether what holds a bulge stops it to the side to which it falls; so is one body, which nothing holds."""
        hold = next((hold for hold in self.holds if hold.height == opening.hold), None)
        if opening.hinge is None or hold is None:
            return opening.hinge is None
        return (hold.outwards if opening.outwards else hold.inwards) > 0

    def _yields(self, kinks: Sequence[tuple[float, float]]) -> bool:
        """Whether a tie is drawn out, or a top slips."""
        moved = ((hold, self.moved(kinks, hold.height)) for hold in self.holds)
        return any(way and (hold.outwards if way > 0 else hold.inwards) for hold, way in moved)

    def is_bonded(self, opening: Opening) -> bool:
        """Whether a bonder, which gives to neither side, keeps it shut."""
        heights = (hold.height for hold in self.holds if hold.kind == "bonder")
        return any(self.moved(opening.kinks, height) for height in heights)

    @property
    def top_may_slip(self) -> bool:
        """Whether friction alone holds its top to one side at least."""
        return any(hold.kind == "top" and np.isfinite(hold.inwards) for hold in self.holds)

    def slip(self, opening: Opening) -> float:
        """Return how far its top slips outwards under what lies on it, as the lowest body turns by 1; 0: it holds."""
        return self.moved(opening.kinks, self.height) if self.top_may_slip else 0.0

    def other_way(self, opening: Opening) -> Opening | None:
        """Return what the wall does to the other side after an impact, or None where something stands there.

        The same joints open where the hold stops the wall to both sides. Where it only pulls, all above the foot goes
        the other way as one body, or as two where something else stops these higher up.
        """
        back = replace(opening, outwards=not opening.outwards)
        if opening.is_triangle:
            stopped = self.backed or any(hold.inwards and hold.height > opening.foot for hold in self.holds)
            return None if stopped else back
        whole = Opening(foot=opening.foot, outwards=back.outwards)
        stops = [hold.height for hold in self.holds if hold.both_ways]
        higher = [
            replace(back, hold=height, upright=False)
            for height in stops
            if opening.hold is not None and height > opening.hold and opening.forwards
        ]
        ways = [back, whole, *higher] if opening.hold in stops else [whole, *higher]
        return next((way for way in ways if self.admits(way.kinks)), None)

    def name(self, opening: Opening) -> str:
        """Return what it does, in words."""
        below = self._kind_at(opening.foot)
        inwards = "" if opening.outwards else " inwards"
        if opening.is_triangle:
            return "falls between two ties of a row"
        if opening.between:
            does = self._between_ties.name(replace(opening, between=False))
            return Phrase("{does}, between ties of a row", does=does)
        if opening.hinge is None:
            highest = max((hold.height for hold in self.holds if hold.outwards), default=np.inf)
            if opening.foot == 0:
                slips = ", its top slipping" if self.slip(opening) else ""
                return f"overturns{inwards} about its foot{slips}"
            if opening.foot >= highest:
                kind = next(hold.kind for hold in self.holds if hold.height == highest)
                return f"{inwards} above the {kind}".strip()
            feet = {storey.low for storey in self.storeys}
            place = "upper storey alone" if opening.foot in feet else "above a joint"
            return f"{inwards} {place}".strip()
        if opening.hold is None:
            return f"sways{inwards} under the slab"
        above = self._kind_at(opening.hold)
        ends = f"two {below}s" if below == above else Phrase("{below} and {above}", below=below, above=above)
        moves = ("bulges" if opening.forwards else "kicks back") + inwards
        words = Phrase("{moves} between {ends}", moves=moves, ends=ends)
        if opening.upright or opening.hold >= self.height * (1 - _SAME):
            return words
        turns = "the top turning back" if opening.forwards else "the top falling"
        return Phrase("{does}, {turns}", does=words, turns=turns)

    def _kind_at(self, height: float) -> str:
        """The kind of what is at a height [m]."""
        if height == 0:
            return "foot"
        kinds = [hold.kind for hold in self.holds if hold.height == height]
        return kinds[0] if kinds else "top" if height == self.height else "joint"

    @cached_property
    def stops(self) -> tuple[float, ...]:
        """The heights at which something changes: the ground, feet of storeys and holds, m."""
        heights = {storey.low for storey in self.storeys} | {hold.height for hold in self.holds}
        return tuple(sorted(heights - {self.height}))

    def family(self, joints: Sequence[float] = ()) -> tuple[tuple[Opening, float], ...]:
        """Return the opening of least λ by each name, with its λ, by their λ.

        joints: at which alone it may open, apart from feet of storeys and holds, m above the ground; without them it
        may open anywhere, and the hinge is where λ is least. What a tie without a strength keeps shut is left out,
        and, unless nothing to that side is weaker, what has its foot at no foot of a storey and at no hold, or bulges
        below something that only pushes it on.
        """
        stops = self.stops
        heights = feet = sorted({*stops, *joints})
        if not len(joints):
            # A bulge that stands elsewhere is not the weakest to its side.
            feet = list(stops)
            heights = [
                float(place)
                for low, high in pairwise([*stops, self.height])
                for place in np.linspace(low, high, _JOINTS + 1)[:-1]
            ]
        least: dict[tuple[str, bool], tuple[Opening, float]] = {}
        for opening in self.openings(heights, feet):
            if not len(joints) and opening.hinge not in stops and self._is_near_its_hold(opening):
                continue
            multiplier = self.multiplier(opening)
            kind = self.name(opening), opening.outwards
            if np.isfinite(multiplier) and (kind not in least or multiplier < least[kind][1] * (1 - _SAME)):
                least[kind] = opening, multiplier
        found = list(least.values())
        if not len(joints):
            found = [self._sharpened(*listed, heights) for listed in found]
        weakest = {
            outwards: min((listed[1] for listed in found if listed[0].outwards == outwards), default=np.inf)
            for outwards in (True, False)
        }
        listed = [
            listed
            for listed in found
            if listed[1] <= weakest[listed[0].outwards]
            or (listed[0].foot in stops and self._is_held(listed[0]))
        ]
        return tuple(sorted(listed, key=lambda listed: listed[1]))

    def _is_near_its_hold(self, opening: Opening) -> bool:
        """Whether its hinge lies beyond HIGHEST_SHARE of the span."""
        if opening.hinge is None:
            return False
        top = self.height if opening.hold is None else opening.hold
        return opening.hinge - opening.foot > HIGHEST_SHARE * (top - opening.foot)

    def _sharpened(
        self, opening: Opening, multiplier: float, heights: Sequence[float]
    ) -> tuple[Opening, float]:
        """The opening with its hinge where λ is least between the joints on either side of it.

        It goes up to HIGHEST_SHARE of the span, as the hinge of a wall between supports does.
        """
        from scipy.optimize import minimize_scalar  # slow to import, and needed here only

        if opening.hinge is None:
            return opening, multiplier
        place = heights.index(opening.hinge)
        top = self.height if opening.hold is None else opening.hold
        margin = (1 - HIGHEST_SHARE) * (top - opening.foot)
        low = max(heights[place - 1], opening.foot + margin)
        high = min((*heights, self.height)[place + 1], top - margin)
        if not low < high:
            return opening, multiplier

        def moved(hinge: float) -> Opening:
            return replace(opening, hinge=float(hinge))

        least = minimize_scalar(
            lambda hinge: self.multiplier(moved(hinge)),
            bounds=(low, high),
            method="bounded",
            options={"xatol": 1e-6 * (high - low)},
        )
        return min((opening, multiplier), (moved(least.x), float(least.fun)), key=itemgetter(1))

    def pieces(self, opening: Opening) -> list[Storey]:
        """Return the masonry cut at the joints of `opening`, from the ground up."""
        cuts = sorted(height for height, _ in opening.kinks)
        cut = []
        for storey in self.storeys:
            levels = [storey.low, *(cut for cut in cuts if storey.low < cut < storey.high), storey.high]
            cut += [storey.cut(low, high) for low, high in pairwise(levels)]
        return cut

    def part_at(self, opening: Opening, height: float) -> int:
        """Return the part of its linkage to which what acts at `height` [m] belongs, or STILL.

        At a joint it is the piece below.
        """
        moving = [piece for piece in self.pieces(opening) if piece.low >= opening.foot]
        return next((part for part, piece in enumerate(moving) if piece.low < height <= piece.high), STILL)

    def outlines(self, opening: Opening) -> list[tuple[int, np.ndarray]]:
        """Return the outlines of the pieces, each with its part of the linkage, or STILL."""
        return [
            (self.part_at(opening, piece.high), outline + self.lean * outline.imag)
            for piece in self.pieces(opening)
            for outline in (rectangle(piece.left, piece.right, piece.low, piece.high),)
        ]

    def _seen(self, x: float, z: float, outwards: bool = True) -> complex:
        """A point of the wall in plumb as it stands, seen from the side to which it falls."""
        stands = x + self.lean * z
        return complex(stands if outwards else -stands, z)

    def hung(self, way: Opening, cut: Opening) -> list[Hung]:
        """Return what acts on the pieces of `cut` as they move in `way`, seen from the side to which that falls.

        Inwards a tie goes slack, and a hold does not move.
        """
        outwards = 1.0 if way.outwards else -1.0
        slip = self.slip(way)
        hung = []
        for load in self.loads:
            part = self.part_at(cut, load.z)
            if part != STILL and load.weight:
                bearing = self._seen(load.x - way.lean_of_top * load.slab, load.z, way.outwards)
                # What a top slips under stays behind: it is carried, and not moved.
                weighs_only = bool(slip) or not load.moves
                force = -1j * load.weight if weighs_only else 0j
                mass = 0.0 if weighs_only else load.weight
                hung.append(Hung("load", bearing, part, force, mass=mass))
        for height, thrust in self.thrusts:
            start = self._seen(0.0, height, way.outwards)
            hung.append(Hung("thrust", start, self.part_at(cut, height), complex(outwards * thrust)))
        friction = next((hold.inwards for hold in self.holds if hold.kind == "top"), 0.0)
        if friction >= LEAST_STIFFNESS * _GRIPS and slip * outwards > 0:
            # It resists from the first movement on, until the wall has left what lies on it.
            breadth = self.storeys[-1].right - self.storeys[-1].left
            slides = Tie(
                stiffness=friction / _GRIPS,
                pretension=friction,
                strength=friction,
                plastic_elongation=breadth,
            )
            start = outwards * self._face(self.height, True).real + 1j * self.height
            hung.append(Hung("friction", start, self.part_at(cut, self.height), tie=slides))
        for height in self.row.heights:
            stays = way.between or height == way.hold
            stays |= way.upright and way.hold is not None and height > way.hold
            pulls = self.row.tie if way.outwards and not stays else None
            start = self._seen(self._storey_at(height).right, height, way.outwards)
            hung.append(Hung("tie", start, self.part_at(cut, height), tie=pulls))
        return hung

    def linkage(self, opening: Opening, cut: Opening, hung: Sequence[Hung]) -> Linkage:
        """Return the pieces of `cut` as they move in `opening`, seen from the side to which that falls.

        hung: what acts on it, as seen from there.
        """
        moving = [piece for piece in self.pieces(cut) if piece.low >= cut.foot]
        if opening.is_triangle:
            return self._triangle(opening, moving, hung)
        weights = np.array([piece.total for piece in moving])
        centres = [
            self._seen((piece.left + piece.right) / 2, piece.middle, opening.outwards) for piece in moving
        ]
        inertias = [piece.inertia(self.lean) for piece in moving]
        parts = Parts(weights, centres, inertias)
        points = [self._edge(height, turn) for height, turn in opening.kinks]
        if opening.hold is not None and not opening.upright:
            points.append(self._face(opening.hold, opening.outwards))
        foot, *others = (point if opening.outwards else -point.conjugate() for point in points)
        if opening.hinge is None:
            return Turning(foot, parts, hung)
        hinge, *held = others
        return Chain(
            (foot, hinge),
            held[0] if held else None,
            parts,
            hung,
            bodies=[opening.body_at(piece.high) for piece in moving],
            forwards=opening.forwards,
            guided=any(load.moves and not load.rides for load in self.loads),
        )

    def _triangle(self, opening: Opening, moving: Sequence[Storey], hung: Sequence[Hung]) -> Linkage:
        """The triangle between two ties as a body that turns about its foot; per metre between the ties.

        Each of its parts has the mass, the centre and the inertia of its strips, each seen from its own foot. What the
        halves on either side of the middle press on each other is left out, and that they turn along the wall, too.
        """
        turn = 1.0 if opening.outwards else -1.0
        corner = self._edge(opening.foot, turn)
        moments = np.zeros((len(moving) + len(hung), 3), dtype=complex)
        for foot, share in self._strips(opening):
            shift = corner - self._edge(foot, turn)
            for place, piece in enumerate(moving):
                if foot < piece.high:
                    above = piece.cut(max(piece.low, foot), piece.high)
                    centre = self._seen((above.left + above.right) / 2, above.middle) + shift
                    about = above.inertia(self.lean) + above.total * abs(centre - corner) ** 2
                    moments[place] += share * np.array([above.total, above.total * centre, about])
            for place, load in enumerate(hung, start=len(moving)):
                if load.start.imag > foot and not load.tie:
                    start = complex(turn * load.start.real, load.start.imag) + shift
                    moments[place] += share, share * start, share * abs(start - corner) ** 2
        shares = moments[:, 0].real
        centres = moments[:, 1] / np.where(shares > 0, shares, 1.0)
        inertias = moments[:, 2].real - shares * np.abs(centres - corner) ** 2
        seen = turn * centres.real + 1j * centres.imag

        masonry = len(moving)
        bodies = [(shares[place], seen[place], inertias[place]) for place in range(masonry)]
        pulls = []
        for place, load in enumerate(hung, start=masonry):
            if load.mass and shares[place]:
                bodies.append((load.mass * shares[place], seen[place], load.mass * inertias[place]))
            elif load.force and shares[place]:
                force = load.force * shares[place]
                pulls.append(load._replace(start=complex(seen[place]), part=0, force=force))
        parts = Parts(*(np.array(values) for values in zip(*bodies, strict=True)))
        return Turning(complex(turn * corner.real, corner.imag), parts, pulls)

    def _edge(self, height: float, turn: float) -> complex:
        """The edge about which the joint at `height` [m] opens: the outer one where what is above turns outwards."""
        inner, outer = self.faces(height)
        return complex(outer if turn > 0 else inner, height)

    def _face(self, height: float, outwards: bool) -> complex:
        """The point at which the wall is held at `height` [m] on its outer or its inner face, or by what lies on it."""
        if any(hold.height == height and hold.kind == "top" for hold in self.holds):
            return self._edge(height, 1.0 if outwards else -1.0)
        storey = self._storey_at(height)
        return self._seen(storey.right if outwards else storey.left, height)
