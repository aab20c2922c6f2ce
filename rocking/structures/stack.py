"""The stack: a member as rigid courses in the plane, one on the other, for contact dynamics (theory: section 11).

x to the right, z up, m. Masses and forces are in one unit per mass: kg and N, or kg per metre of wall and N per metre.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY, whole
from rocking.structures.mechanism import Tie

MOST_COURSES = 40
"""Courses that a stack may have: its cost grows with their number, and a wall of more is followed as well by these."""
COURSES = 6
"""Courses of a member that does not say how many it has."""
ROUGH = 5.0
"""Friction coefficient at the joints: more than courses that only rock need, so that none slides."""
STEP = 5e-4
"""Time step of contact dynamics, s: the target `stack` of docs/research says how far a rotation is then off."""
_STOP_STEPS = 0.25
"""Circular frequency of a mass on its stop, times that step."""
_LEAST_RETURNED = 0.01
"""Share of its velocity that a stop returns at least: less needs a dashpot that the step does not follow."""
_GAP = 1e-9
"""Distance between two courses that counts as none, over the height of the stack."""


@dataclass(frozen=True, kw_only=True)
class Course:
    """One rigid body of a stack.

    bottom, top: left and right edge of its lower and its upper face, m. base, height: of its lower face above the foot
    of the stack, and of the body, m. mass. centre: of mass, m. inertia: about the centre of mass, mass · m².
    guided: it moves sideways with the ground and does not turn, as a slab that floors hold; it is free to rise.
    upright: it does not turn, as a slab that stays flat, but moves to the side with what it lies on.
    """

    bottom: tuple[float, float]
    top: tuple[float, float]
    base: float
    height: float
    mass: float
    centre: tuple[float, float]
    inertia: float
    guided: bool = False
    upright: bool = False

    def __post_init__(self) -> None:
        numbers = (*self.bottom, *self.top, self.base, self.height, self.mass, *self.centre, self.inertia)
        if not np.all(np.isfinite(numbers)):
            raise StructureError(
                f"a course of the stack is {numbers!r}, but all its numbers must be finite; correct them."
            )
        narrow = self.bottom[1] <= self.bottom[0] or self.top[1] < self.top[0]
        if narrow or min(self.height, self.mass, self.inertia) <= 0:
            raise StructureError(
                f"a course of the stack has the faces {self.bottom!r} and {self.top!r} m, the height {self.height!r} "
                f"m, the mass {self.mass!r} and the inertia {self.inertia!r}, but its breadth, height, mass and "
                "inertia must be positive; correct them."
            )

    @property
    def corners(self) -> np.ndarray:
        """The corners (4, 2) at rest from the lower left one, counterclockwise, m."""
        low = self.base
        high = self.base + self.height
        left, right = self.bottom
        return np.array([[left, low], [right, low], [self.top[1], high], [self.top[0], high]])

    @property
    def slenderness(self) -> float:
        """The angle at which it lies on its own edge, rad."""
        lever = min(self.centre[0] - self.bottom[0], self.bottom[1] - self.centre[0])
        return float(np.arctan2(max(lever, 0.0), self.centre[1] - self.base))


@dataclass(frozen=True, kw_only=True)
class Stop:
    """What stands still behind a point: it pushes to the right once the point has moved to the left, and never pulls.

    stiffness: force per m. damping: force per m/s.
    """

    stiffness: float
    damping: float

    @classmethod
    def of_mass(cls, mass: float, restitution: float, thrown: float | None = None) -> "Stop":
        """Return the stop behind a `mass`, as stiff as a step of contact dynamics allows.

        restitution: with which it throws back the mass that leans on it, or `thrown`, of which that is a part. What
        hits a spring and a dashpot, and may leave them, keeps e^(−πζ/√(1−ζ²)) of its velocity.
        """
        lost = -np.log(np.clip(restitution, _LEAST_RETURNED, 1.0))
        ratio = float(lost / np.hypot(np.pi, lost))
        stiffness = mass * (_STOP_STEPS / STEP) ** 2
        return cls(stiffness=stiffness, damping=2 * ratio * math.sqrt(stiffness * (thrown or mass)))


@dataclass(frozen=True)
class Held:
    """What acts on a course at a point: a constant force, which grows with gravity, a tie, or a stop.

    course: its place in the stack from the lowest one, 0. point: at rest, m. force: to the right and upwards. tie:
    pulls to the left once its point has moved to the right. stop: pushes to the right once it has moved to the left.
    """

    course: int
    point: tuple[float, float]
    force: tuple[float, float] = (0.0, 0.0)
    tie: Tie | None = None
    stop: Stop | None = None


@dataclass(frozen=True, eq=False)
class BodiesAtRest:
    """Rigid bodies in a chain as contact dynamics takes them, the ground first, and last where they stand on two.

    centres: (n, 2) of mass, m. corners: (n, 4, 2) from the centre, counterclockwise: those of the face to the body
    before it, then those of the face to the one behind it, m. mobility: (n, 3) inverse inertias along x, z and the
    turn, 0 where a body is held. drops: (n,) by how much a centre sinks whose body has fallen, m; inf where turns alone
    count. softness: share by which a contact gives more than a rigid one. pinned: x, z from the centre of the last body
    of the point that is held sideways; nan where none is.
    """

    centres: np.ndarray
    corners: np.ndarray
    mobility: np.ndarray
    drops: np.ndarray
    softness: float = 0.0
    pinned: tuple[float, float] = (np.nan, np.nan)


@dataclass(frozen=True)
class Stack:
    """Courses on moving ground, from the lowest one up.

    The ground goes on to both sides of the foot.

    Parameters
    ----------
    courses : tuple of Course
        Courses, from the lowest one up.
    held : tuple of Held, optional
        Forces and ties that hold courses.
    top_held_at : tuple of (float, float) or None, optional
        Point of the uppermost course that something holds to the ground sideways only, m; None: its top is
        free.
    friction : float, default 5.0
        Friction coefficient at every joint.

    Raises
    ------
    StructureError
        For no course, more than MOST_COURSES, or courses that do not lie on one another.

    Examples
    --------
    >>> from rocking import Block
    >>> len(Block.of_size(breadth=0.6, height=4.0).stack().courses)
    1
    """

    courses: tuple[Course, ...]
    held: tuple[Held, ...] = field(default=())
    top_held_at: tuple[float, float] | None = None
    friction: float = ROUGH

    def __post_init__(self) -> None:
        if not 1 <= len(self.courses) <= MOST_COURSES:
            raise StructureError(
                f"the stack has {len(self.courses)} courses, but must have 1 to {MOST_COURSES}; join some."
            )
        slack = _GAP * self.height
        for lower, upper in pairwise(self.courses):
            apart = upper.base - (lower.base + lower.height)
            overlap = min(lower.top[1], upper.bottom[1]) - max(lower.top[0], upper.bottom[0])
            if abs(apart) > slack or overlap <= 0:
                raise StructureError(
                    f"a course of the stack at {upper.base:.6g} m does not lie on the one beneath it, which ends at "
                    f"{lower.base + lower.height:.6g} m; give courses that touch."
                )
        if not self.friction >= 0:
            raise StructureError(
                f"friction is {self.friction!r}, but must be 0 or more; give the coefficient of the joints.",
                friction=self.friction,
            )
        for held in self.held:
            if not 0 <= held.course < len(self.courses):
                raise StructureError(
                    f"a force acts on course {held.course} of the stack, but there are {len(self.courses)}, "
                    "counted from 0; correct it."
                )

    @property
    def height(self) -> float:
        """From the foot of the lowest course to the top of the uppermost one, m."""
        first = self.courses[0]
        last = self.courses[-1]
        return last.base + last.height - first.base

    @property
    def count(self) -> int:
        """The number of bodies that move."""
        return len(self.courses)

    @property
    def at_rest(self) -> BodiesAtRest:
        """The courses on the ground."""
        first, last = self.courses[0], self.courses[-1]
        left, right = first.bottom
        left, right = 2 * left - right, 2 * right - left
        depth = self.height
        low, high = first.base - depth, first.base
        ground = np.array([[left, low], [right, low], [right, high], [left, high]])
        centres = np.array([[0.0, first.base - depth / 2], *(course.centre for course in self.courses)])
        corners = np.array([ground, *(course.corners for course in self.courses)]) - centres[:, None]
        mobility = [[0.0, 0.0, 0.0]]
        for course in self.courses:
            across = 0.0 if course.guided else 1 / course.mass
            turning = 0.0 if course.guided or course.upright else 1 / course.inertia
            mobility.append([across, 1 / course.mass, turning])
        pinned = np.nan, np.nan
        if self.top_held_at is not None:
            pinned = self.top_held_at[0] - last.centre[0], self.top_held_at[1] - last.centre[1]
        drops = np.full(len(centres), np.inf)
        return BodiesAtRest(centres, corners, np.array(mobility), drops, pinned=pinned)

    @property
    def settled_turn(self) -> float:
        """The turn [rad] below which a stack on still ground rests."""
        return (
            min(course.slenderness for course in self.courses if not (course.guided or course.upright)) / 30
        )

    @cached_property
    def fallen_turn(self) -> float:
        """The turn [rad] from which no course comes back: twice what all above any joint bear as one body."""
        return 2 * max(0.3, *(self._slenderness_above(place) for place in range(len(self.courses))))

    def _slenderness_above(self, place: int) -> float:
        """The angle at which all courses from `place` up, as one body, stand on their edge, rad."""
        above = [course for course in self.courses[place:] if not course.guided]
        if not above:
            return 0.0
        masses = np.array([course.mass for course in above])
        centre = masses @ np.array([course.centre for course in above]) / masses.sum()
        left, right = above[0].bottom
        lever = min(centre[0] - left, right - centre[0])
        return float(np.arctan2(max(lever, 0.0), centre[1] - above[0].base))

    @cached_property
    def resting_multiplier(self) -> float:
        """A horizontal acceleration over g below which nothing at rest lifts: all above any joint as one free body.

        A support of the top and a tie only hold; 0 where a force acts, which may push.
        """
        if any(any(held.force) for held in self.held):
            return 0.0
        slenderness = [
            self._slenderness_above(place) for place, course in enumerate(self.courses) if not course.guided
        ]
        return float(np.tan(min(slenderness)))

    @property
    def longest_step(self) -> float:
        """The longest time step [s] that follows it.

        A twentieth of the time in which the shortest course falls over, 1/p, and half of the time in which its
        stiffest tie moves the mass it is fixed to, √(m/k), beyond which an explicit force gains energy.
        """
        radii = [np.hypot(*(np.array(course.centre) - course.corners[0])) for course in self.courses]
        steps = [0.05 * np.sqrt(4 * min(radii) / (3 * GRAVITY))]
        for held in self.held:
            if held.tie is not None and held.tie.stiffness > 0:
                steps.append(0.5 * np.sqrt(self.courses[held.course].mass / held.tie.stiffness))
        return float(min(steps))


def loaded(course: Course, point: tuple[float, float], mass: float) -> Course:
    """Return the course with a mass fixed to it at a point [m], as a floor that bears on a hinge and moves along."""
    return replace(course, **_together([(course.mass, course.centre, course.inertia), (mass, point, 0.0)]))


def _together(bodies: Sequence[tuple[float, tuple[float, float], float]]) -> dict[str, Any]:
    """Mass, centre and inertia about it of bodies that move as one, from those of each, as a course takes them."""
    masses, places, inertias = (np.array(values) for values in zip(*bodies, strict=True))
    centre = masses @ places / masses.sum()
    inertia = inertias.sum() + masses @ ((places - centre) ** 2).sum(axis=1)
    return {"mass": float(masses.sum()), "centre": tuple(centre.tolist()), "inertia": float(inertia)}


def joined(courses: Sequence[Course]) -> Course:
    """Return courses that stay together as one body."""
    first = courses[0]
    last = courses[-1]
    height = last.base + last.height - first.base
    moments = _together([(course.mass, course.centre, course.inertia) for course in courses])
    return Course(bottom=first.bottom, top=last.top, base=first.base, height=height, **moments)


def slab(left: float, right: float, base: float, load: float, **how: bool) -> Course:
    """Return a slab of the weight `load` on top of a stack, a tenth as high as it is broad; how: guided or upright."""
    height = 0.1 * (right - left)
    mass = load / GRAVITY
    inertia = mass * ((right - left) ** 2 + height**2) / 12
    middle = ((left + right) / 2, base + height / 2)
    return Course(
        bottom=(left, right),
        top=(left, right),
        base=base,
        height=height,
        mass=mass,
        centre=middle,
        inertia=inertia,
        **how,
    )


def course_at(courses: Sequence[Course], height: float) -> int:
    """Return the place of the course that `height` [m] lies on, the lower one at a joint."""
    tops = np.array([course.base + course.height for course in courses])
    return min(int(np.searchsorted(tops, height - _GAP * tops[-1])), len(courses) - 1)


def counted_courses(number: int | None) -> int:
    """Return the number of courses, COURSES where none is given. Raises StructureError beyond MOST_COURSES."""
    return COURSES if number is None else whole("courses", number, 1, MOST_COURSES)


def joints_between(stops: Sequence[float], courses: float) -> list[float]:
    """Return levels [m] with a joint at each of `stops`, from the lowest to the highest one, and evenly between them.

    courses: as many in all, or somewhat more where stops are many.
    """
    levels = list(stops[:1])
    for low, high in pairwise(stops):
        number = max(1, math.ceil(courses * (high - low) / (stops[-1] - stops[0]) - 1e-9))
        levels += np.linspace(low, high, number + 1)[1:].tolist()
    return levels


def courses_between(
    levels: Sequence[float], faces: Sequence[tuple[float, float]], density: float, depths: Sequence[float]
) -> tuple[Course, ...]:
    """Return courses with straight flanks, one between each two of `levels` [m].

    faces: left and right edge at each level, m. density: mass per m³. depths: of each course, m.
    """
    made = []
    for (low, high), (lower, upper), depth in zip(pairwise(levels), pairwise(faces), depths, strict=True):
        mass, centre, inertia = _trapezium(lower, upper, high - low)
        place = (centre[0], low + centre[1])
        weight = density * depth
        made.append(
            Course(
                bottom=lower,
                top=upper,
                base=low,
                height=high - low,
                mass=weight * mass,
                centre=place,
                inertia=weight * inertia,
            )
        )
    return tuple(made)


def _trapezium(
    lower: tuple[float, float], upper: tuple[float, float], height: float
) -> tuple[float, tuple[float, float], float]:
    """Area [m²], centroid above the lower face [m] and second moment about it [m⁴]: exact, by Gauss's three points."""
    nodes = np.array([0.5 - np.sqrt(0.15), 0.5, 0.5 + np.sqrt(0.15)])
    weights = np.array([5, 8, 5]) / 18 * height
    left = lower[0] + nodes * (upper[0] - lower[0])
    right = lower[1] + nodes * (upper[1] - lower[1])
    width = right - left
    middle = (right + left) / 2
    z = nodes * height
    area = float(weights @ width)
    across = float(weights @ (width * middle)) / area
    up = float(weights @ (width * z)) / area
    squares = weights @ (width * ((middle - across) ** 2 + width**2 / 12 + (z - up) ** 2))
    return area, (across, up), float(squares)


def stops_behind(courses: Sequence[Course], restitution: float) -> tuple[Held, ...]:
    """Return the stops of what `courses` lean on, all along their inner faces.

    Each throws back its part of a course with the `restitution` of the impact on what stands behind, so that no foot
    need slide; the impacts of the foot come on top.
    """
    stops = []
    for place, course in enumerate(courses):
        number = max(2, math.ceil(2 * course.height / (course.bottom[1] - course.bottom[0])))
        stop = Stop.of_mass(course.mass / number, restitution)
        for share in (np.arange(number) + 0.5) / number:
            x = course.bottom[0] + share * (course.top[0] - course.bottom[0])
            stops.append(Held(place, (float(x), float(course.base + share * course.height)), stop=stop))
    return tuple(stops)
