"""What hangs on a structure besides its own mass: weights, thrusts and ties at points that move with it.

A constant force and an elastic tie have a potential, so they add to G(φ); a mass that moves along adds to I and B. All
forces are in the unit of the structure's weights (kN per metre of wall, say), which cancels. Points are complex, m.

A tie is elastic, brittle or yields until it breaks, and pulls only. Its force depends on how far its point has moved
and on how far it ever was. Since its point moves outwards all the time with the rotation φ, the largest rotation so far
is all that a side has to remember, whatever the number of ties.
"""

from dataclasses import dataclass, replace
from typing import NamedTuple, Protocol

import numpy as np

from rocking.quantities import GRAVITY
from rocking.structures.bodies import MotionState
from rocking.structures.equivalent_block import Function


class PointMotion(NamedTuple):
    """A point at rotations of any shape: how far it moved from rest, and the derivatives with φ; complex, m."""

    moved: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


@dataclass(frozen=True)
class Tie:
    """A tie that stays horizontal, being long: force `pretension` + `stiffness` · u up to `strength`.

    u ≥ 0 is how far its point moved towards the side of rocking. At its strength it yields, by `plastic_elongation` [m]
    until it breaks; 0 is brittle. Unloading is elastic, with the plastic elongation taken off u, and where that leaves
    no tension it is slack. A side on which it would slacken from the start has no tie.
    """

    stiffness: float
    pretension: float = 0.0
    strength: float = np.inf
    plastic_elongation: float = 0.0

    @property
    def yield_stretch(self) -> float:
        """u at which it reaches its strength, m."""
        if np.isinf(self.strength):
            return np.inf
        return (self.strength - self.pretension) / self.stiffness

    @property
    def rupture_stretch(self) -> float:
        """u beyond which it is broken, m."""
        return self.yield_stretch + self.plastic_elongation

    def over(self, unit: float) -> "Tie":
        """The same tie with its forces in multiples of `unit`."""
        return replace(
            self,
            stiffness=self.stiffness / unit,
            pretension=self.pretension / unit,
            strength=self.strength / unit,
        )

    def tension(self, stretch: np.ndarray, largest: np.ndarray | None = None) -> np.ndarray:
        """The force at u = `stretch`, where u was `largest` at most before; None: never beyond `stretch`."""
        elastic = self.pretension + self.stiffness * stretch
        if np.isinf(self.strength):
            return elastic
        largest = stretch if largest is None else np.maximum(stretch, largest)
        plastic = np.maximum(largest - self.yield_stretch, 0.0)
        force = np.clip(elastic - self.stiffness * plastic, 0.0, self.strength)
        return np.where(largest > self.rupture_stretch, 0.0, force)

    def work(self, point: PointMotion) -> np.ndarray:
        """What was done against it since rest, on the way out."""
        stretch = np.minimum(point.moved.real, self.rupture_stretch)
        elastic = np.minimum(stretch, self.yield_stretch)
        work = self.pretension * elastic + self.stiffness * elastic**2 / 2
        return work if np.isinf(self.strength) else work + self.strength * (stretch - elastic)

    def force(self, point: PointMotion) -> np.ndarray:
        """Derivative of `work` with φ."""
        return self.tension(point.moved.real) * point.velocity.real

    def slope(self, point: PointMotion) -> np.ndarray:
        """Second derivative of `work` with φ, between yield and rupture that of the force it keeps."""
        stretch = point.moved.real
        stiffness = np.where(stretch <= self.yield_stretch, self.stiffness, 0.0)
        return self.tension(stretch) * point.acceleration.real + stiffness * point.velocity.real**2


@dataclass(frozen=True)
class SideTie:
    """A tie on one side of a mechanism: u [m] and du/dφ as functions of the rotation, which grow with it.

    The forces of `tie` are in the unit of the side's G per m, so that the tie adds T(u) du/dφ to G.
    """

    tie: Tie
    stretch: Function
    stretch_slope: Function

    def moment(self, rotation: np.ndarray, largest: np.ndarray) -> np.ndarray:
        """Return what it adds to G at `rotation`, the largest rotation so far being `largest` [rad]."""
        force = self.tie.tension(self.stretch(rotation), self.stretch(largest))
        return force * self.stretch_slope(rotation)

    def bends(self, end_rotation: float) -> list[float]:
        """Return the rotations below `end_rotation` at which it yields and breaks, rad."""
        return [
            rotation
            for stretch in dict.fromkeys((self.tie.yield_stretch, self.tie.rupture_stretch))
            if (rotation := self.rotation(stretch, end_rotation)) < np.inf
        ]

    def rotation(self, stretch: float, end_rotation: float) -> float:
        """Return the rotation [rad] at which u is `stretch`; inf beyond `end_rotation`."""
        from scipy.optimize import brentq  # slow to import, and needed by ties with a strength only

        def beyond(rotation: float) -> float:
            return float(self.stretch(np.asarray(rotation))) - stretch

        if stretch <= 0:
            return 0.0
        if not beyond(end_rotation) > 0:
            return np.inf
        return float(brentq(beyond, 0.0, end_rotation, xtol=1e-18, rtol=1e-15))


@dataclass(frozen=True)
class ConstantForce:
    """A force on its point, complex, towards the side of rocking and upwards; it scales with g + ü_v."""

    vector: complex

    def work(self, point: PointMotion) -> np.ndarray:
        """What was done against it since rest."""
        return self._against(point.moved)

    def force(self, point: PointMotion) -> np.ndarray:
        """Derivative of `work` with φ."""
        return self._against(point.velocity)

    def slope(self, point: PointMotion) -> np.ndarray:
        """Second derivative of `work` with φ."""
        return self._against(point.acceleration)

    def _against(self, way: np.ndarray) -> np.ndarray:
        return -(self.vector.conjugate() * way).real


class Path(Protocol):
    """Where a point goes with the rotation φ ≥ 0 [rad] of one side; `start`: where it is at rest, complex, m."""

    @property
    def start(self) -> complex: ...

    def __call__(self, rotation: np.ndarray) -> PointMotion: ...


@dataclass(frozen=True)
class Attached:
    """What hangs at a point: a force, or the weight of a `mass` that moves with the point.

    sideways: whether that mass also moves horizontally; False where something else holds it in that direction.
    """

    path: Path
    force: ConstantForce | Tie | None = None
    mass: float = 0.0
    sideways: bool = True

    def acting(self, state: MotionState) -> tuple[np.ndarray, np.ndarray]:
        """Return where it pulls at its body and with which force, (k,) complex, in a motion."""
        point = self.path(state.rotation)
        if isinstance(self.force, Tie):
            tension = self.force.tension(point.moved.real, self.path(state.largest).moved.real)
            force = -tension * GRAVITY + 0j
        elif self.force is not None:
            force = self.force.vector * state.pull.imag
        else:
            rise = point.velocity.imag * state.acceleration + point.acceleration.imag * state.velocity**2
            force = -1j * self.mass * (rise + state.pull.imag)
        return self.path.start + point.moved, force

    def side_tie(self, divisor: float) -> SideTie:
        """Return its tie as a side has it, the forces over `divisor`."""
        assert isinstance(self.force, Tie)
        path = self.path
        return SideTie(
            self.force.over(divisor),
            lambda phi: path(phi).moved.real,
            lambda phi: path(phi).velocity.real + 0.0 * np.asarray(phi),
        )

    def kinetic(self, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """What its mass adds to I, I', B and G."""
        _, velocity, acceleration = self.path(rotation)
        if not self.sideways:
            velocity, acceleration = 1j * velocity.imag, 1j * acceleration.imag
        return (
            self.mass * np.abs(velocity) ** 2,
            2 * self.mass * (velocity.conjugate() * acceleration).real,
            self.mass * velocity.real,
            self.mass * velocity.imag,
        )


@dataclass(frozen=True, eq=False, repr=False)
class LoadedForm:
    """I, I', G, G' and B of bare functions and what is attached, as methods; in the unit of the bare ones' weight.

    bare: I, I', G, G', B in weights, m. divisor: common factor that all five are divided by.
    """

    bare: tuple[Function, Function, Function, Function, Function]
    attached: tuple[Attached, ...]
    divisor: float

    def inertia(self, rotation: np.ndarray) -> np.ndarray:
        """I(φ)."""
        masses = [each.kinetic(rotation)[0] for each in self.attached if each.mass]
        return sum(masses, self.bare[0](rotation)) / self.divisor

    def inertia_slope(self, rotation: np.ndarray) -> np.ndarray:
        """I'(φ)."""
        masses = [each.kinetic(rotation)[1] for each in self.attached if each.mass]
        return sum(masses, self.bare[1](rotation)) / self.divisor

    def gravity(self, rotation: np.ndarray) -> np.ndarray:
        """G(φ), where the rotation was never larger."""
        masses = [each.kinetic(rotation)[3] for each in self.attached if each.mass]
        forces = [each.force.force(each.path(rotation)) for each in self.attached if each.force]
        return sum(masses + forces, self.bare[2](rotation)) / self.divisor

    def gravity_slope(self, rotation: np.ndarray) -> np.ndarray:
        """G'(φ)."""
        masses = [each.mass * each.path(rotation).acceleration.imag for each in self.attached if each.mass]
        forces = [each.force.slope(each.path(rotation)) for each in self.attached if each.force]
        return sum(masses + forces, self.bare[3](rotation)) / self.divisor

    def ground(self, rotation: np.ndarray) -> np.ndarray:
        """B(φ)."""
        masses = [each.kinetic(rotation)[2] for each in self.attached if each.mass]
        return sum(masses, self.bare[4](rotation)) / self.divisor

    def held_work(self, rotation: np.ndarray) -> np.ndarray:
        """Return the work done since rest against all forces that are no moving mass, in weights, m."""
        return sum(
            (each.force.work(each.path(rotation)) for each in self.attached if each.force),
            np.zeros(np.shape(rotation)),
        )

    @property
    def untied(self) -> "LoadedForm":
        """The same without its ties."""
        return replace(
            self, attached=tuple(each for each in self.attached if not isinstance(each.force, Tie))
        )

    @property
    def ties(self) -> tuple[SideTie, ...]:
        """Its ties."""
        return tuple(each.side_tie(self.divisor) for each in self.attached if isinstance(each.force, Tie))
