"""What hangs on a structure besides its own mass: weights, thrusts and ties at points that move with it.

A constant force and an elastic tie have a potential, so they add to G(φ); a mass that moves along adds to I and B. All
forces are in the unit of the structure's weights (kN per metre of wall, say), which cancels. Points are complex, m.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from rocking.errors import StructureError
from rocking.structures.mechanism import Function, Side
from rocking.structures.ties import PointMotion, SideTie, Tie

Path = Callable[[np.ndarray], PointMotion]
"""Where a point goes with the rotation φ ≥ 0 [rad] of one side."""


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


@dataclass(frozen=True)
class Attached:
    """A force and a path, and the weight of the mass that moves along the path (0 for none).

    sideways: whether that mass also moves horizontally; False where something else holds it in that direction.
    """

    path: Path
    force: ConstantForce | Tie | None = None
    mass: float = 0.0
    sideways: bool = True

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
        return tuple(_side_tie(each, self.divisor) for each in self.attached if isinstance(each.force, Tie))

    def side(self, end_rotation: float, restitution: float) -> Side:
        """Return the side of rocking with these functions, up to `end_rotation` [rad]."""
        bends = [bend for tie in self.ties for bend in tie.bends(end_rotation)]
        return Side(
            inertia=self.inertia,
            inertia_slope=self.inertia_slope,
            gravity=self.gravity,
            gravity_slope=self.gravity_slope,
            ground=self.ground,
            critical_rotation=critical_rotation(self.gravity, end_rotation, bends),
            end_rotation=end_rotation,
            restitution=restitution,
            ties=self.ties,
            untied_gravity=self.untied.gravity,
        )


def _side_tie(attached: Attached, divisor: float) -> SideTie:
    tie, path = attached.force, attached.path
    assert isinstance(tie, Tie)
    scaled = replace(
        tie,
        stiffness=tie.stiffness / divisor,
        pretension=tie.pretension / divisor,
        strength=tie.strength / divisor,
    )
    return SideTie(
        scaled, lambda phi: path(phi).moved.real, lambda phi: path(phi).velocity.real + 0.0 * np.asarray(phi)
    )


def critical_rotation(gravity: Function, end_rotation: float, bends: Sequence[float] = ()) -> float:
    """Return where G first vanishes on (0, end_rotation), or falls below zero at one of its `bends`, rad.

    Raises StructureError when G does not restore at rest, or does not vanish.
    """
    from scipy.optimize import brentq  # slow to import, and needed by loaded structures only

    places = np.linspace(0.0, end_rotation, 513)
    if bends:
        places = np.unique(np.concatenate([places, bends, np.nextafter(bends, np.inf)]))
    falls = np.flatnonzero(gravity(places) <= 0)
    if not falls.size:
        raise StructureError(
            f"the structure has no unstable equilibrium up to a rotation of {end_rotation:.6g} rad: "
            "what holds it never lets go; make it weaker."
        )
    if falls[0] == 0:
        raise StructureError("the structure does not stand: what acts on it at rest turns it over.")
    before, after = places[falls[0] - 1], places[falls[0]]

    def restoring(phi: float) -> float:
        return float(gravity(np.asarray(phi)))

    while bends and restoring(after) > 0:
        after = np.nextafter(after, np.inf)  # rounded otherwise alone than in a row
    found = float(brentq(restoring, before, after, xtol=1e-16, rtol=1e-15))
    while bends and found < after and restoring(found) > 0:
        found = float(np.nextafter(found, np.inf))  # where a tie breaks, the far side of the fall
    return found
