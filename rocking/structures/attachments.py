"""What hangs on a structure besides its own mass: weights, thrusts and ties at points that move with it.

A constant force and an elastic tie have a potential, so they add to G(φ); a mass that moves along adds to I and B. All
forces are in the unit of the structure's weights (kN per metre of wall, say), which cancels. Points are complex, m.

A tie is elastic, brittle or yields until it breaks, and pulls only. Its force depends on how far its point has moved
and on how far it ever was. Since its point moves outwards all the time with the rotation φ, the largest rotation so far
is all that a side has to remember, whatever the number of ties.
"""

from abc import abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import NamedTuple

import numpy as np

from rocking.errors import StructureError
from rocking.structures.fields import Field, choice_field, number_field
from rocking.structures.mechanism import Function, Side
from rocking.structures.structure import Structure


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


UNIT_WEIGHT = number_field(
    "unit_weight",
    "Weight of the masonry",
    "kN/m³",
    20.0,
    (8, 30),
    bounds={"exclusiveMinimum": 0},
    required=True,
)
ECCENTRICITY = number_field(
    "eccentricity", "Distance of the bearing inwards from the middle of the wall", "m", 0.05, (-1, 1), "e", {}
)
TOP_SLAB = choice_field(
    "top_slab",
    "Whether the uppermost load rests on a bearing or as a slab that stays flat",
    ("hinged", "flat"),
    "{value} top slab",
)


def check_eccentricity(value: float, thickness: float) -> None:
    """Refuse a bearing beyond the edge of a wall of that thickness [m]."""
    if abs(value) > thickness / 2:
        raise StructureError(
            f"eccentricity is {value!r} m, but must lie within half the thickness, {thickness / 2!r} m, for the load "
            "to bear on the wall."
        )


def check_inside(field: str, value: float, height: float) -> None:
    """Refuse a height above the ground [m] that is not on a wall of that `height`."""
    if not 0 < value <= height:
        raise StructureError(
            f"{field} is {value!r} m, but must lie on the wall, above 0 and up to {height:.6g} m."
        )


def tie_fields(height: float, stiffness: float) -> tuple[Field, ...]:
    """Return the fields of ties, with examples."""
    return (
        number_field("tie_heights", "Heights of the ties above the ground", "m", [height], (0.2, 60), "z"),
        number_field(
            "tie_stiffness",
            "Stiffness of each tie per metre of wall, kN/m per m",
            "kN/m²",
            stiffness,
            (1, 1e5),
            "k",
        ),
        number_field(
            "tie_pretension", "Force of each tie at rest; needs one_sided", "kN/m", 0.0, (0, 200), "T"
        ),
        number_field(
            "tie_strength",
            "Force at which each tie yields, or breaks where no plastic elongation is given; elastic without it",
            "kN/m",
            40.0,
            (1, 500),
            "F",
            bounds={"exclusiveMinimum": 0},
        ),
        number_field(
            "tie_plastic_elongation",
            "By how much each tie yields at its strength before it breaks; 0 is brittle",
            "m",
            0.05,
            (0, 0.5),
        ),
    )


@dataclass(frozen=True, repr=False)
class Tied(Structure):
    """A structure with a row of equal ties.

    tie_heights: of ties above the ground, m; tie_stiffness: of each, N/m per m; tie_pretension, N/m; tie_strength,
    N/m, None for elastic ties, and tie_plastic_elongation, m, by which they yield before they break. A tie pulls
    inwards only; one that is tightened needs a structure that cannot rock inwards.
    one_sided: it leans on cross walls and rocks outwards only; restitution must then be a number.
    """

    tie_heights: tuple[float, ...] = field(default=(), kw_only=True)
    tie_stiffness: float = field(default=0.0, kw_only=True)
    tie_pretension: float = field(default=0.0, kw_only=True)
    tie_strength: float | None = field(default=None, kw_only=True)
    tie_plastic_elongation: float = field(default=0.0, kw_only=True)
    one_sided: bool = field(default=False, kw_only=True)

    @abstractmethod
    def tie_stretches(self, rotation: float) -> dict[float, float]:
        """Return by how much each tie that moves is stretched [m], by height, at a signed `rotation` [rad]."""

    def tie_events(self, rotation: float) -> str:
        tie, said = self._tie(), []
        for height, stretch in self.tie_stretches(rotation).items():
            if stretch > tie.rupture_stretch:
                said.append(f"the tie at {height:.6g} m breaks")
            elif stretch > tie.yield_stretch:
                said.append(
                    f"the tie at {height:.6g} m yields by {stretch - tie.yield_stretch:.3g} m of "
                    f"{tie.plastic_elongation:.6g} m"
                )
        return "; ".join(said)

    def _tie(self, unit: float = 1.0) -> Tie:
        """Each tie, its forces in `unit` [N/m]."""
        strength = np.inf if self.tie_strength is None else self.tie_strength
        return Tie(
            self.tie_stiffness / unit,
            self.tie_pretension / unit,
            strength / unit,
            self.tie_plastic_elongation,
        )

    @property
    def _tie_text(self) -> str:
        """What a drawing says of each tie."""
        text = f"{self.tie_stiffness / 1e3:.6g} kN/m²"
        if self.tie_strength is None:
            return text
        does = "yields" if self.tie_plastic_elongation else "breaks"
        return f"{text}, {does} at {self.tie_strength / 1e3:.6g} kN/m"

    def _check_ties(self, top: float) -> None:
        """Refuse ties that do not hang together. top: of the wall, m."""
        stiffness, pretension, strength = self.tie_stiffness, self.tie_pretension, self.tie_strength
        for height in self.tie_heights:
            check_inside("tie_heights", height, top)
        if strength is not None and strength < pretension:
            raise StructureError(
                f"tie_strength is {strength!r} N/m, but must be at least the pretension of {pretension!r} N/m."
            )
        if strength is not None and not stiffness:
            raise StructureError(
                "tie_stiffness is 0 N/m², but must be greater than 0 for a tie with a tie_strength; give it."
            )
        if strength is None and self.tie_plastic_elongation:
            raise StructureError(
                f"tie_plastic_elongation is {self.tie_plastic_elongation!r} m, but needs a tie_strength at which the "
                "tie yields; give it."
            )
        if (stiffness or pretension) and not self.tie_heights:
            raise StructureError("tie_heights is empty, but must say where the ties are; give it.")
        if self.tie_heights and not (stiffness or pretension):
            raise StructureError(
                "tie_stiffness is 0 N/m², but must be greater than 0 for ties to hold; give it."
            )
        if pretension > 0 and not self.one_sided:
            raise StructureError(
                f"tie_pretension is {pretension!r} N/m, but must be 0 unless the wall is one_sided: moving inwards, a "
                "tightened tie goes slack."
            )
