"""Walls of units in running bond in three dimensions: rigid boxes that press, slide and lift at their corners.

An oracle of `between_ties.py`, which shares no code with the package. Where two units share an area, its four corners
press on each other by stiff springs and dashpots that never pull, and hold by Coulomb friction; ties pull at points of
the outer face, and what stands behind pushes at points of the inner one. Coordinates move with the ground: x along the
wall, y outwards from the inner face, z up. Steps are explicit, velocities before places.
"""

import math
from dataclasses import dataclass, field
from itertools import pairwise
from typing import NamedTuple

import numpy as np
from numba import njit

from rocking.quantities import GRAVITY

STIFFNESS = 1e9
"""Of a joint per area that is pressed, N/m³: units of 0.4 m are then as stiff as masonry of 0.4 GPa."""
DAMPED = 1.0
"""Dashpots over springs, in the inverse of the highest frequency of a unit."""
SAFE_STEP = 0.9
"""Time step over the longest stable one."""
SUNK = 0.5
"""Of the height of a unit: a centre that sinks by more has fallen."""
THROWN = 3.0
"""Of the thickness: a centre that moves by more has fallen."""
QUIET = 2e-3
"""Speed below which all is at rest on still ground, m/s."""
AFTERWARDS = 6.0
"""Longest time that a wall is followed on still ground, s."""


class Units(NamedTuple):
    """n units. mass: (n,) kg, weight: (n,) with what presses on them, N. inertia: (n, 3) about their own axes, kg m².

    centres: (n, 3) m.
    """

    mass: np.ndarray
    weight: np.ndarray
    inertia: np.ndarray
    centres: np.ndarray


class Touching(NamedTuple):
    """k points at which units may touch.

    pairs: (k, 2) the unit that bears, -1 the ground, and the one that is borne. normal: (k,) axis along which the
    latter leaves. arms: (k, 2, 3) of the point from both centres, m; the first from the point itself on the ground.
    stiffness: (k,) N/m.
    """

    pairs: np.ndarray
    normal: np.ndarray
    arms: np.ndarray
    stiffness: np.ndarray


class Props(NamedTuple):
    """k points that something holds along y. unit: (k,). arm: (k, 3) m. stiffness: (k,) N/m. damping: (k,) N s/m.

    way: (k,) 1 of a tie, which pulls inwards once its point has moved outwards; -1 of what stands behind.
    """

    unit: np.ndarray
    arm: np.ndarray
    stiffness: np.ndarray
    damping: np.ndarray
    way: np.ndarray


@dataclass(frozen=True)
class BondedUnits:
    """A wall of units in running bond.

    length, height, thickness: m. unit: length and height of a unit, m. density: kg/m³. load: N per m on its top at
    mid-thickness; rides: whether its mass moves along. ties: x and z of each, m, and tie_stiffness, N/m. behind:
    "cross_walls" all over, "floors" along its top, or "nothing"; with the restitution of its impact. friction:
    coefficient.
    """

    length: float
    height: float
    thickness: float
    unit: tuple[float, float]
    density: float
    load: float = 0.0
    rides: bool = True
    ties: tuple[tuple[float, float], ...] = ()
    tie_stiffness: float = 2e7
    behind: str = "nothing"
    restitution: float = 0.5
    friction: float = 0.6
    stiffness: float = field(default=STIFFNESS)

    def boxes(self) -> list[tuple[float, float, float]]:
        """Return x, z and length of each unit."""
        wide, tall = self.unit
        boxes = []
        for course in range(round(self.height / tall)):
            first = wide / 2 if course % 2 else wide
            joints = [0.0, *np.arange(first, self.length - 1e-9, wide).tolist(), self.length]
            boxes += [(low, course * tall, high - low) for low, high in pairwise(joints)]
        return boxes

    def units(self) -> Units:
        """Return masses and weights, a load that rides as a line on the top of the units that bear it."""
        tall = self.unit[1]
        of_units = []
        for x, z, wide in self.boxes():
            own = self.density * wide * tall * self.thickness
            on_top = self.load * wide if z + tall > self.height - 1e-9 else 0.0
            carried = on_top / GRAVITY if self.rides else 0.0
            up = carried * tall / 2 / (own + carried)
            square = np.array([self.thickness**2 + tall**2, wide**2 + tall**2, wide**2 + self.thickness**2])
            line = np.array([0.0, wide**2 / 12, wide**2 / 12])
            lever = np.array([1.0, 1.0, 0.0])
            inertia = own * (square / 12 + lever * up**2) + carried * (line + lever * (tall / 2 - up) ** 2)
            centre = [x + wide / 2, self.thickness / 2, z + tall / 2 + up]
            of_units.append((own + carried, own * GRAVITY + on_top, inertia, centre))
        return Units(*(np.array(values) for values in zip(*of_units, strict=True)))

    def touching(self, units: Units) -> Touching:
        """Return the corners of the areas at which units touch each other and the ground."""
        tall = self.unit[1]
        boxes = self.boxes()
        faces = (0.0, self.thickness)
        points: list[tuple[int, int, int, tuple[float, float, float], float]] = []
        for upper, (x, z, wide) in enumerate(boxes):
            if z == 0:
                area = wide * self.thickness / 4
                points += [(-1, upper, 2, (end, face, 0.0), area) for end in (x, x + wide) for face in faces]
            for lower, (left, foot, breadth) in enumerate(boxes):
                low, high = max(x, left), min(x + wide, left + breadth)
                if abs(foot + tall - z) < 1e-9 and high - low > 1e-9:
                    area = (high - low) * self.thickness / 4
                    points += [
                        (lower, upper, 2, (end, face, z), area) for end in (low, high) for face in faces
                    ]
                if abs(foot - z) < 1e-9 and abs(left + breadth - x) < 1e-9:
                    area = tall * self.thickness / 4
                    points += [(lower, upper, 0, (x, face, e), area) for face in faces for e in (z, z + tall)]
        arms = [
            [np.array(at) - (units.centres[bears] if bears >= 0 else at), at - units.centres[borne]]
            for bears, borne, _, at, _ in points
        ]
        return Touching(
            np.array([point[:2] for point in points]),
            np.array([point[2] for point in points]),
            np.array(arms),
            self.stiffness * np.array([point[4] for point in points]),
        )

    def props(self, units: Units) -> Props:
        """Return ties, and what stands behind: as stiff as a joint, with the dashpots of its restitution."""
        tall = self.unit[1]
        lost = -math.log(min(max(self.restitution, 1e-3), 1.0))
        ratio = lost / math.hypot(math.pi, lost)
        found: list[tuple[int, np.ndarray, float, float, float]] = []
        for place, (x, z, wide) in enumerate(self.boxes()):
            end = x + wide > self.length - 1e-9
            for along, height in self.ties:
                inside = x <= along < x + wide or (end and along >= self.length)
                if inside and z < height <= z + tall + 1e-9:
                    at = np.array([along, self.thickness, height])
                    found.append((place, at - units.centres[place], self.tie_stiffness, 0.0, 1.0))
            if self.behind == "nothing" or (self.behind == "floors" and z + tall < self.height - 1e-9):
                continue
            heights = (z, z + tall) if self.behind == "cross_walls" else (z + tall,)
            corners = [(e, height) for e in (x, x + wide) for height in heights]
            # What hits: the strip behind which the stop stands, or a third of the wall below a floor.
            mass = units.mass[place] if self.behind == "cross_walls" else self._per_metre * wide / 3
            stiffness = self.stiffness * wide * tall / len(corners)
            damping = 2 * ratio * math.sqrt(stiffness * len(corners) * mass) / len(corners)
            for along, height in corners:
                arm = np.array([along, 0.0, height]) - units.centres[place]
                found.append((place, arm, stiffness, damping, -1.0))
        if not found:
            return Props(np.zeros(0, int), np.zeros((0, 3)), *(np.zeros(0) for _ in range(3)))
        return Props(*(np.array(values) for values in zip(*found, strict=True)))

    @property
    def _per_metre(self) -> float:
        return self.density * self.height * self.thickness + self.load / GRAVITY * self.rides


class UnitsResponse(NamedTuple):
    """falls: whether a unit fell. farthest: outwards that a centre moved, m. steps: that were followed. ended: s."""

    falls: bool
    farthest: float
    steps: int
    ended: float


def follow_units(wall: BondedUnits, acceleration: np.ndarray, time_step: float) -> UnitsResponse:
    """Return how a wall responds to a ground acceleration outwards (n,) [m/s²], linear between its samples."""
    units = wall.units()
    touching, props = wall.touching(units), wall.props(units)
    highest = _highest_frequency(units, touching, props)
    damping = DAMPED / highest
    # Stable: ω² dt² + 2 β ω² dt < 4, with dashpots of β times the springs.
    step = SAFE_STEP * (math.sqrt(damping**2 + 4 / highest**2) - damping)
    limits = np.array([SUNK * wall.unit[1], THROWN * wall.thickness, QUIET, AFTERWARDS])
    fell, farthest, steps = _followed(
        units,
        touching,
        props,
        np.asarray(acceleration, float),
        time_step,
        wall.friction,
        damping,
        step,
        limits,
    )
    return UnitsResponse(bool(fell), float(farthest), int(steps), float(steps * step))


def _highest_frequency(units: Units, touching: Touching, props: Props) -> float:
    """A bound of the highest angular frequency: of any unit between neighbours that move against it, rad/s."""
    count = units.mass.size
    along = np.zeros(count)
    about = np.zeros((count, 3))
    for pair, arms, stiffness in zip(touching.pairs, touching.arms, touching.stiffness, strict=True):
        for unit, arm in zip(pair, arms, strict=True):
            if unit >= 0:
                along[unit] += stiffness
                about[unit] += stiffness * (arm @ arm - arm**2)
    for unit, arm, stiffness in zip(props.unit, props.arm, props.stiffness, strict=True):
        along[unit] += stiffness
        about[unit] += stiffness * (arm @ arm - arm**2)
    squares = np.maximum(along / units.mass, (about / units.inertia).max(axis=1))
    return math.sqrt(2 * float(squares.max()))


@njit(cache=True, fastmath={"contract"}, error_model="numpy")
def _followed(units, touching, props, ground, spacing, friction, damping, step, limits):  # type: ignore[no-untyped-def]
    mass, weight, inertia, _ = units
    pairs, normals, arms, springs = touching
    count = mass.size
    points = springs.size
    moved = np.zeros((count, 3))
    speed = np.zeros((count, 3))
    spin = np.zeros((count, 3))
    momentum = np.zeros((count, 3))
    turned = np.zeros((count, 3, 3))
    for i in range(count):
        for a in range(3):
            turned[i, a, a] = 1.0
    slid = np.zeros((points, 2))
    force = np.zeros((count, 3))
    couple = np.zeros((count, 3))
    rest = np.zeros((points, 3))
    for p in range(points):
        for a in range(3):
            rest[p, a] = arms[p, 0, a] - arms[p, 1, a]
    sunk, thrown, quiet, afterwards = limits
    last = (ground.size - 1) * spacing
    steps = int((last + afterwards) / step)
    farthest = 0.0
    calm = 0
    for number in range(steps):
        time = number * step
        place = int(time / spacing)
        pushed = 0.0
        if place < ground.size - 1:
            part = time / spacing - place
            pushed = ground[place] * (1 - part) + ground[place + 1] * part
        for i in range(count):
            force[i, 0] = 0.0
            force[i, 1] = -mass[i] * pushed
            force[i, 2] = -weight[i]
            couple[i, 0] = 0.0
            couple[i, 1] = 0.0
            couple[i, 2] = 0.0
        for p in range(points):
            i = pairs[p, 0]
            j = pairs[p, 1]
            # The point of the unit that is borne, and where the other one has carried the same point.
            b0 = (
                turned[j, 0, 0] * arms[p, 1, 0]
                + turned[j, 0, 1] * arms[p, 1, 1]
                + turned[j, 0, 2] * arms[p, 1, 2]
            )
            b1 = (
                turned[j, 1, 0] * arms[p, 1, 0]
                + turned[j, 1, 1] * arms[p, 1, 1]
                + turned[j, 1, 2] * arms[p, 1, 2]
            )
            b2 = (
                turned[j, 2, 0] * arms[p, 1, 0]
                + turned[j, 2, 1] * arms[p, 1, 1]
                + turned[j, 2, 2] * arms[p, 1, 2]
            )
            a0 = arms[p, 0, 0]
            a1 = arms[p, 0, 1]
            a2 = arms[p, 0, 2]
            n = normals[p]
            if i >= 0:
                c0 = turned[i, 0, 0] * a0 + turned[i, 0, 1] * a1 + turned[i, 0, 2] * a2
                c1 = turned[i, 1, 0] * a0 + turned[i, 1, 1] * a1 + turned[i, 1, 2] * a2
                c2 = turned[i, 2, 0] * a0 + turned[i, 2, 1] * a1 + turned[i, 2, 2] * a2
                d0 = moved[j, 0] - moved[i, 0] + b0 - c0 + rest[p, 0]
                d1 = moved[j, 1] - moved[i, 1] + b1 - c1 + rest[p, 1]
                d2 = moved[j, 2] - moved[i, 2] + b2 - c2 + rest[p, 2]
                n0 = turned[i, 0, n]
                n1 = turned[i, 1, n]
                n2 = turned[i, 2, n]
            else:
                c0 = 0.0
                c1 = 0.0
                c2 = 0.0
                d0 = moved[j, 0] + b0 - arms[p, 1, 0]
                d1 = moved[j, 1] + b1 - arms[p, 1, 1]
                d2 = moved[j, 2] + b2 - arms[p, 1, 2]
                n0 = 1.0 if n == 0 else 0.0
                n1 = 0.0
                n2 = 1.0 if n == 2 else 0.0
            gap = d0 * n0 + d1 * n1 + d2 * n2
            first = 1 if n == 0 else 0
            second = 2 if n == 0 else 1
            if i >= 0:
                s0 = turned[i, 0, first]
                s1 = turned[i, 1, first]
                s2 = turned[i, 2, first]
                t0 = turned[i, 0, second]
                t1 = turned[i, 1, second]
                t2 = turned[i, 2, second]
            else:
                s0 = 1.0 if first == 0 else 0.0
                s1 = 1.0 if first == 1 else 0.0
                s2 = 0.0
                t0 = 0.0
                t1 = 1.0 if second == 1 else 0.0
                t2 = 1.0 if second == 2 else 0.0
            side = d0 * s0 + d1 * s1 + d2 * s2
            other = d0 * t0 + d1 * t1 + d2 * t2
            if gap >= 0.0:
                slid[p, 0] = side
                slid[p, 1] = other
                continue
            v0 = speed[j, 0] + spin[j, 1] * b2 - spin[j, 2] * b1
            v1 = speed[j, 1] + spin[j, 2] * b0 - spin[j, 0] * b2
            v2 = speed[j, 2] + spin[j, 0] * b1 - spin[j, 1] * b0
            if i >= 0:
                # The arm of the lower unit to where the force acts.
                c0 += d0
                c1 += d1
                c2 += d2
                v0 -= speed[i, 0] + spin[i, 1] * c2 - spin[i, 2] * c1
                v1 -= speed[i, 1] + spin[i, 2] * c0 - spin[i, 0] * c2
                v2 -= speed[i, 2] + spin[i, 0] * c1 - spin[i, 1] * c0
            k = springs[p]
            pressing = -k * (gap + damping * (v0 * n0 + v1 * n1 + v2 * n2))
            if pressing <= 0.0:
                slid[p, 0] = side
                slid[p, 1] = other
                continue
            along = -k * (side - slid[p, 0] + damping * (v0 * s0 + v1 * s1 + v2 * s2))
            across = -k * (other - slid[p, 1] + damping * (v0 * t0 + v1 * t1 + v2 * t2))
            most = friction * pressing
            size = math.sqrt(along * along + across * across)
            if size > most:
                along *= most / size
                across *= most / size
                # The spring is left with what friction holds.
                slid[p, 0] = side + along / k
                slid[p, 1] = other + across / k
            f0 = pressing * n0 + along * s0 + across * t0
            f1 = pressing * n1 + along * s1 + across * t1
            f2 = pressing * n2 + along * s2 + across * t2
            force[j, 0] += f0
            force[j, 1] += f1
            force[j, 2] += f2
            couple[j, 0] += b1 * f2 - b2 * f1
            couple[j, 1] += b2 * f0 - b0 * f2
            couple[j, 2] += b0 * f1 - b1 * f0
            if i >= 0:
                force[i, 0] -= f0
                force[i, 1] -= f1
                force[i, 2] -= f2
                couple[i, 0] -= c1 * f2 - c2 * f1
                couple[i, 1] -= c2 * f0 - c0 * f2
                couple[i, 2] -= c0 * f1 - c1 * f0
        for q in range(props.unit.size):
            j = props.unit[q]
            r0 = props.arm[q, 0]
            r1 = props.arm[q, 1]
            r2 = props.arm[q, 2]
            b0 = turned[j, 0, 0] * r0 + turned[j, 0, 1] * r1 + turned[j, 0, 2] * r2
            b1 = turned[j, 1, 0] * r0 + turned[j, 1, 1] * r1 + turned[j, 1, 2] * r2
            b2 = turned[j, 2, 0] * r0 + turned[j, 2, 1] * r1 + turned[j, 2, 2] * r2
            out = props.way[q] * (moved[j, 1] + b1 - r1)
            if out <= 0.0:
                continue
            rate = props.way[q] * (speed[j, 1] + spin[j, 2] * b0 - spin[j, 0] * b2)
            held = props.stiffness[q] * out + props.damping[q] * rate
            if held <= 0.0:
                continue
            held *= -props.way[q]
            force[j, 1] += held
            couple[j, 0] -= b2 * held
            couple[j, 2] += b0 * held
        fastest = 0.0
        for i in range(count):
            for a in range(3):
                speed[i, a] += step * force[i, a] / mass[i]
                moved[i, a] += step * speed[i, a]
                momentum[i, a] += step * couple[i, a]
                fastest = max(fastest, abs(speed[i, a]))
            # ω = R I⁻¹ Rᵀ L, and the turn of a step about it by Rodrigues' formula.
            m0 = 0.0
            m1 = 0.0
            m2 = 0.0
            for a in range(3):
                m0 += turned[i, a, 0] * momentum[i, a]
                m1 += turned[i, a, 1] * momentum[i, a]
                m2 += turned[i, a, 2] * momentum[i, a]
            m0 /= inertia[i, 0]
            m1 /= inertia[i, 1]
            m2 /= inertia[i, 2]
            for a in range(3):
                spin[i, a] = turned[i, a, 0] * m0 + turned[i, a, 1] * m1 + turned[i, a, 2] * m2
            w0 = spin[i, 0] * step
            w1 = spin[i, 1] * step
            w2 = spin[i, 2] * step
            angle2 = w0 * w0 + w1 * w1 + w2 * w2
            if angle2 > 0.0:
                sine = 1.0 - angle2 / 6.0
                versed = 0.5 - angle2 / 24.0
                for a in range(3):
                    x = turned[i, 0, a]
                    y = turned[i, 1, a]
                    z = turned[i, 2, a]
                    p0 = w1 * z - w2 * y
                    p1 = w2 * x - w0 * z
                    p2 = w0 * y - w1 * x
                    turned[i, 0, a] = x + sine * p0 + versed * (w1 * p2 - w2 * p1)
                    turned[i, 1, a] = y + sine * p1 + versed * (w2 * p0 - w0 * p2)
                    turned[i, 2, a] = z + sine * p2 + versed * (w0 * p1 - w1 * p0)
            farthest = max(farthest, moved[i, 1])
            if moved[i, 2] < -sunk or abs(moved[i, 1]) > thrown or not math.isfinite(speed[i, 2]):
                return True, farthest, number + 1
        if time > last:
            calm = calm + 1 if fastest < quiet else 0
            if calm * step > 0.5:
                return False, farthest, number + 1
    return False, farthest, steps
