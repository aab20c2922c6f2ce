"""The hinges of an arch, the horizontal multiplier at which they open, and its motion then (theory: section 5).

Inertia forces act to the right. The loads are 1 downwards and λ to the right on each radian of the ring, at
the radius of an element's centroid. λ is the largest multiplier whose thrust line stays inside the ring. With the
reaction at the left springing u = (M₀, V, H) that is a linear programme in (u, λ), which gives the four sections where
the line touches; between joints (a continuous ring) each of them then slides to where the line is tangent. The tests
compare it with the smallest multiplier over all four-hinge mechanisms, by virtual work. On joints of little friction
the line has to stay within their cones as well (`multiplier_on_friction`).

The hinges make a four-bar linkage A-B-C-D; φ is the clockwise rotation of bar AB about A; A and D follow the ground.
"""

from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import combinations

import numpy as np

from rocking.errors import StructureError
from rocking.structures.arch_ring import CONTINUOUS_SECTIONS, EXTRADOS, INTRADOS, PATTERN, Bars, Ring
from rocking.structures.linkage import Contacts, Kinematics, Linkage, MotionState, cross, keeps_last
from rocking.structures.stones import greatest_multiplier


class FourBar(Linkage):
    """hinges: A, B, C, D at rest, (4,) complex, m, with the bars between them.

    mass: of the structure, in the unit of the bars. radius: that divides I, G and B, m. joints: (4,) angles [rad] at
    which the thrust runs square through the joints of the hinges, from left to right.
    """

    def __init__(
        self, hinges: np.ndarray, bars: Bars, radius: float, mass: float, joints: np.ndarray
    ) -> None:
        self.hinges = hinges
        self._mass = mass
        self._joints = joints
        self.unit = radius
        self.masses, self.rest, self.inertias = bars
        self._at_rest = np.diff(hinges)
        self._branch = float(np.sign(cross(hinges[3] - hinges[1], self._at_rest[1])))
        self.end_rotation = self._last_rotation()

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Kinematics:
        """Return the bars at `rotation` [rad], any shape, short of the dead point."""
        ab, bc, cd = self._directions(rotation)
        closing = cross(bc, cd)
        spins = np.stack([-np.ones_like(closing), cross(ab, cd) / closing, cross(ab, bc) / -closing])
        # ω₁ = −1: ω₁ AB + ω₂ BC + ω₃ CD = 0. Once more: Σ (α − i ω²)·bar = 0 with α₁ = 0 gives the slopes.
        residual = -1j * (ab + spins[1] ** 2 * bc + spins[2] ** 2 * cd)
        slopes = np.stack(
            [np.zeros_like(closing), cross(residual, cd) / closing, cross(residual, bc) / -closing]
        )
        turned = np.stack([ab, bc, cd]) / self._at_rest.reshape(3, *[1] * np.ndim(rotation))
        # AB is carried by A, BC by B, CD by D
        arms = turned * (self.rest - self.hinges[[0, 1, 3]]).reshape(3, *[1] * np.ndim(rotation))
        zero = np.zeros_like(ab)
        pivots = np.stack([self.hinges[0] + zero, self.hinges[0] + ab, self.hinges[3] + zero])
        return Kinematics(
            hinges=np.stack([pivots[0], pivots[1], pivots[2] - turned[2] * self._at_rest[2], pivots[2]]),
            angles=np.angle(turned),
            spins=spins,
            spin_slopes=slopes,
            centroids=pivots + arms,
            velocities=np.stack([zero, -1j * ab, zero]) + 1j * spins * arms,
            accelerations=np.stack([zero, -ab, zero]) + (1j * slopes - spins**2) * arms,
        )

    def _directions(self, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """AB, BC and CD at `rotation`: AB is turned, C is where the circles about B and D meet."""
        ab = self._at_rest[0] * np.exp(-1j * rotation)
        diagonal = self.hinges[3] - self.hinges[0] - ab
        length = np.abs(diagonal)
        _, bc, cd = np.abs(self._at_rest)
        along = (length**2 + bc**2 - cd**2) / (2 * length)
        across = self._branch * np.sqrt(bc**2 - along**2)
        to_c = (along + 1j * across) * diagonal / length
        return ab, to_c, diagonal - to_c

    def contacts(self, state: MotionState) -> Contacts:
        """The thrust at B follows from the moments of AB about A and of BC about C; it runs from left to right."""
        motion = self.motion(state.rotation)
        forces, couples = self.dalembert(state)
        a, b, c, _ = motion.hinges
        about_a = cross(motion.centroids[0] - a, forces[0]) + couples[0]
        about_c = cross(motion.centroids[1] - c, forces[1]) + couples[1]
        # The thrust T at B has (b − a) × T = about_a and (b − c) × T = −about_c.
        at_b = ((b - c) * about_a + (b - a) * about_c) / cross(b - a, b - c)
        at_a = at_b - forces[0]
        at_c = at_b + forces[1]
        thrusts = np.stack([at_a, at_b, at_c, at_c + forces[2]])

        # A joint turns by the mean of the bars at its sides; the springings do not turn.
        fixed = np.zeros_like(motion.angles[:1])
        turns = np.concatenate([fixed, motion.angles, fixed])
        halfway = (turns[1:] + turns[:-1]) / 2
        tangents = np.exp(1j * (halfway + self._joints[:, None]))
        return Contacts.resolved(("A", "B", "C", "D"), thrusts / self._mass, tangents)

    def _last_rotation(self) -> float:
        """The rotation [rad] up to which the motion is followed: A, B and C in line, or just before the bars lock."""
        # with A, B and C in line the triangle A-C-D has the sides |AB| + |BC|, |CD| and |AD|; nan where none closes
        base = self.hinges[3] - self.hinges[0]
        first, second, third = np.abs(self._at_rest)
        side = first + second
        cosine = (abs(base) ** 2 + side**2 - third**2) / (2 * abs(base) * side)
        with np.errstate(all="ignore"):
            in_line = float(np.angle(self._at_rest[0] / base) - np.arccos(cosine))
            places = np.linspace(0.0, in_line if np.isfinite(in_line) else np.pi / 2, 513)
            inertia = self.inertia(places)
        moves = np.isfinite(inertia) & (inertia > 0)
        return float(places[-1] if moves.all() else 0.98 * places[int(np.argmin(moves)) - 1])


_DOWN = np.array([0.0, 0.0, 0.0, -1.0])
_ROUNDS = 100
_SUBDIVISIONS = 4
"""Parts of the spacing of a continuous ring's sections, between which its joints may slide."""
_INFEASIBLE = 2
"""The status of scipy's linear programme for constraints that contradict each other."""
_CLEARANCE = 1e-12
"""A gap (of order t/r) that is zero to rounding."""
_ASIDE = 1e-5
"""Rotation of a section [rad] over which the slope of a gap is differenced: Newton's steps need few digits of it."""
_MOST_SECTIONS = 25
"""Sections at most between which the hinges of other mechanisms are searched: 15 thousand mechanisms."""
_APART = 1e-6
"""Nearer than this [rad] two hinges are one section, on which the ring would slide."""


@dataclass(frozen=True, eq=False)
class Onset:
    """The mechanism at which an arch starts to rock.

    multiplier: λ. hinges: (4,) angles of A, B, C, D from the left springing, rad.
    reaction: (3,) moment about the centre, V and H at the left springing, in units of the ring (r = t·r = 1).
    """

    multiplier: float
    hinges: np.ndarray
    reaction: np.ndarray


class TooThin(StructureError):
    """No thrust line fits inside the ring, even without a horizontal load."""


class NoMechanism(StructureError):
    """No four-hinge mechanism exists: the ring would slide, or carry any horizontal load."""


@lru_cache(maxsize=64)
def static_onset(ring: Ring) -> Onset:
    """Return the largest multiplier whose thrust line stays inside the ring, and where it touches.

    Raises TooThin when no thrust line fits, NoMechanism when no four alternating hinges limit the multiplier.
    """
    sections = np.tile(ring.sections(), 2)
    contacts = np.repeat([INTRADOS, EXTRADOS], ring.sections().size)
    for _ in range(_ROUNDS):
        rows = ring.gaps(sections, contacts)
        touching = _weakest(rows)
        touching = touching[np.argsort(sections[touching], kind="stable")]
        if not np.array_equal(contacts[touching], PATTERN):
            raise NoMechanism
        hinges = sections[touching]
        unknowns = _touching_line(rows[touching])
        if ring.voussoirs is None:
            hinges, unknowns = _slide_to_tangency(ring, hinges)
        if np.any(np.diff(hinges) < _APART):
            raise NoMechanism
        if ring.voussoirs is not None or (rows @ unknowns).min() > -_CLEARANCE:
            break
        sections = np.append(sections, hinges)
        contacts = np.append(contacts, PATTERN)
    if not unknowns[3] > 0:
        raise TooThin
    return Onset(float(unknowns[3]), hinges + ring.embrace_angle / 2, unknowns[:3])


@lru_cache(maxsize=256)
def multiplier_on_friction(ring: Ring, coefficient: float) -> float:
    """Return the largest multiplier whose thrust line stays in the ring and in the cone of friction at every joint.

    That of a ring that rocks, or less, where joints of this coefficient slide before; 0 where it does not stand at
    rest, as it would not under any multiplier then: a line for λ and its mirror image have a line for 0 between them.
    Raises as `static_onset` does of a continuous ring.
    """
    sections = ring.sections()
    if ring.voussoirs is None:
        on_arch = sections[ring.feet(sections) == 0]
        finer = np.linspace(on_arch[0], on_arch[-1], _SUBDIVISIONS * (on_arch.size - 1) + 1)
        sections = np.unique([*sections, *finer, *(static_onset(ring).hinges - ring.embrace_angle / 2)])
    both = np.tile(sections, 2)
    contacts = np.repeat([INTRADOS, EXTRADOS], sections.size)
    rows = np.concatenate([ring.gaps(both, contacts), ring.friction_left(sections, coefficient)])
    solved = greatest_multiplier(rows)
    return max(float(solved.x[3]), 0.0) if solved.status == 0 else 0.0


def onset_at(ring: Ring, hinges: np.ndarray) -> Onset:
    """Return the onset of the mechanism with A, B, C, D at `hinges` (4,), angles from the left springing [rad].

    Raises NoMechanism where a hinge lies outside the ring or would have to close, TooThin where nothing has to push.
    """
    sections = hinges - ring.embrace_angle / 2
    outside = sections.shape != (4,) or np.abs(ring.on_ring(sections) - sections).max() > _CLEARANCE
    if outside or np.any(np.diff(hinges) < _APART):
        raise NoMechanism
    rows = ring.gaps(sections, PATTERN)
    unknowns = _touching_line(rows)
    if np.linalg.solve(rows[:, :4].T, _DOWN).min() < 0:
        raise NoMechanism
    if not unknowns[3] > 0:
        raise TooThin
    return Onset(float(unknowns[3]), hinges, unknowns[:3])


def other_hinges(ring: Ring, onset: Onset, count: int) -> list[np.ndarray]:
    """Return the hinges of up to `count` mechanisms other than that of a static `onset`, of the least multiplier first.

    Hinges open at voussoir joints, or in a continuous ring at _MOST_SECTIONS sections; of two mechanisms some
    hinge is at least one of these apart. λ is the dual of the linear programme: by virtual work.
    """
    static = onset.hinges - ring.embrace_angle / 2
    sections = ring.sections()
    coarse = sections[:: -(-sections.size // _MOST_SECTIONS)]
    sections = np.unique(np.concatenate([coarse, sections[-1:], static]))
    spacing = 0.99 * np.diff(coarse).max()
    places = np.array(list(combinations(range(sections.size), 4)))
    at_each = [ring.gaps(sections, np.full(sections.shape, contact)) for contact in PATTERN]
    rows = np.stack([gaps[places[:, k]] for k, gaps in enumerate(at_each)], axis=1)
    regular = np.abs(np.linalg.det(rows[..., :4])) > _CLEARANCE
    rows = rows[regular]
    hinges = sections[places[regular]]

    turns = np.linalg.solve(rows[..., :4].transpose(0, 2, 1), _DOWN[None, :, None])[..., 0]
    multipliers = (turns * rows[..., 4]).sum(axis=1)
    moves = (turns > 0).all(axis=1) & (multipliers > onset.multiplier)
    mechanisms = [static]
    for four in hinges[moves][np.argsort(multipliers[moves])]:
        if len(mechanisms) <= count and all(np.abs(four - listed).max() >= spacing for listed in mechanisms):
            mechanisms.append(four)
    return [hinge_angles + ring.embrace_angle / 2 for hinge_angles in mechanisms[1:]]


def _touching_line(rows: np.ndarray) -> np.ndarray:
    """The thrust line that touches four contacts: (M₀, V, H, λ, 1)."""
    try:
        return np.append(np.linalg.solve(rows[:, :4], -rows[:, 4]), 1.0)
    except np.linalg.LinAlgError:
        raise NoMechanism from None


def _weakest(rows: np.ndarray) -> np.ndarray:
    """The four rows that limit λ, in order: those whose dual does not vanish."""
    solved = greatest_multiplier(rows)
    if solved.status:
        raise TooThin if solved.status == _INFEASIBLE else NoMechanism
    return np.sort(np.argsort(solved.ineqlin.marginals)[:4])


def _slide_to_tangency(ring: Ring, hinges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Newton's method on the sections where the gap of a continuous ring is smallest. Returns (hinges, unknowns)."""
    spacing = ring.embrace_angle / (CONTINUOUS_SECTIONS - 1)
    coincident = np.diff(hinges, prepend=-np.inf) <= 0  # two on one section would be singular
    hinges = hinges + spacing / 2 * coincident
    for _ in range(_ROUNDS):
        rows = ring.gaps(hinges, PATTERN)
        if hinges[1] - hinges[0] < _APART:
            raise NoMechanism
        unknowns = _touching_line(rows)
        before, slope, after = (
            ring.gap_slopes(hinges + aside, PATTERN) @ unknowns for aside in (-_ASIDE, 0.0, _ASIDE)
        )
        curvature = (after - before) / (2 * _ASIDE)
        step = np.where(
            curvature > 0, -slope / np.where(curvature > 0, curvature, 1.0), -np.sign(slope) * spacing
        )
        following = ring.on_ring(hinges + np.clip(step, -spacing, spacing))
        if np.abs(following - hinges).max() < 1e-13:
            break
        hinges = following
    return hinges, unknowns


def limiting_thickness(ring: Ring, failure: type[StructureError]) -> float:
    """Return the t/r of a ring like `ring` up to which (TooThin) or from which (NoMechanism) it fails so, to 1e-13.

    TooThin: the smallest at which the ring stands under its own weight. NoMechanism: the largest at which it rocks on
    four hinges; a thicker ring slides instead.
    """
    fails, passes = (0.0, 2.0) if failure is TooThin else (2.0, 0.0)
    while abs(passes - fails) > 1e-13:
        middle = (fails + passes) / 2
        try:
            static_onset(replace(ring, thickness=middle))
            passes = middle
        except (TooThin, NoMechanism) as reason:
            fails, passes = (middle, passes) if isinstance(reason, failure) else (fails, middle)
    return (fails + passes) / 2
