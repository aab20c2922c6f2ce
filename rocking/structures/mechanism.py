"""The standard form of every rocking structure, ties included, and what may become of it.

On the side s = ±1 to which it rocks, with the rotation φ ≥ 0 (theory: section 1, "One standard form"):

    I(φ) φ'' + J(φ) φ'² + G(φ) (g + ü_v) = −s B(φ) ü_g ,   J = I'/2

Uplift from rest to the side s = −sign(ü_g) when |ü_g| / (g + ü_v) exceeds G(0)/B(0). At φ = 0 an impact ends the
motion on this side; the angular velocity of the next flight is `restitution` times the one of arrival.

A tie pulls only, with a force that depends on how far its point has moved and on how far it ever was. As the point
moves outwards all the time with φ, the largest rotation so far is all that a side remembers.
"""

import math
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cached_property
from operator import methodcaller
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from rocking.drawn import Drawn
from rocking.errors import StructureError
from rocking.quantities import GRAVITY, four_digits, positive, within
from rocking.structures.equivalent_block import (
    Arc,
    BlockDefects,
    Function,
    RotationMap,
    Scale,
    arc_of,
    rotation_map,
)
from rocking.structures.equivalent_block import EquivalentBlock as EquivalentBlock

_ARC_ACCURACY = 2e-14
_MAP_ACCURACY = 1e-14
CUTS = (0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.2, 0.4)
"""Shares that may be cut off beyond φ_cr, where a mechanism locks and its inertia has no bound."""
_DEFECT_SAMPLES = 401


@dataclass(frozen=True, kw_only=True)
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
    def yield_force(self) -> float:
        """The force with which limit analysis lets it pull; inf of one that never yields."""
        return self.strength if self.stiffness else self.pretension

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

    def slope(self, stretch: np.ndarray, velocity: np.ndarray, acceleration: np.ndarray) -> np.ndarray:
        """Derivative of T du/dφ with φ, from those of u; beyond yield that of the force it keeps."""
        stiffness = np.where(stretch <= self.yield_stretch, self.stiffness, 0.0)
        result: np.ndarray = self.tension(stretch) * acceleration + stiffness * velocity**2
        return result


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
        stretch = self.stretch(rotation)
        farthest = stretch if largest is rotation else self.stretch(largest)
        return self.tie.tension(stretch, farthest) * self.stretch_slope(rotation)

    def bends(self, end_rotation: float) -> list[float]:
        """Return the rotations below `end_rotation` at which it yields and breaks, rad."""
        stretches = self.tie.yield_stretch, self.tie.rupture_stretch
        bends = [self.rotation(stretch, end_rotation) for stretch in stretches]
        return [bend for bend in bends if bend < np.inf]

    def rotation(self, stretch: float, end_rotation: float) -> float:
        """Return the rotation [rad] at which u is `stretch`; inf beyond `end_rotation`."""
        # Yield and rupture are asked for by the mechanism, its capacity and the checks.
        known: dict[tuple[float, float], float] = self.__dict__.setdefault("_rotations", {})
        asked = stretch, end_rotation
        if asked not in known:
            known[asked] = self._rotation_at_stretch(stretch, end_rotation)
        return known[asked]

    def _rotation_at_stretch(self, stretch: float, end_rotation: float) -> float:
        from scipy.optimize import brentq  # slow to import, and needed by ties with a strength only

        def beyond(rotation: float) -> float:
            return float(self.stretch(np.asarray(rotation))) - stretch

        if stretch <= 0:
            return 0.0
        if not beyond(end_rotation) > 0:
            return np.inf
        return float(brentq(beyond, 0.0, end_rotation, xtol=1e-18, rtol=1e-15))


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Side:
    """One direction of rocking: I [m], I' [m/rad], G [-], G' [1/rad], B [-] as functions of φ on [0, end_rotation].

    All five may carry one common factor (a mass, say), which cancels. G is what restores on the way out from
    rest.

    Parameters
    ----------
    inertia : callable
        I, m, as a function of φ.
    inertia_slope : callable
        I', m/rad.
    gravity : callable
        G, dimensionless.
    gravity_slope : callable
        G', 1/rad.
    ground : callable
        B, dimensionless.
    critical_rotation : float
        φ_cr, where G vanishes, rad.
    end_rotation : float
        Rotation where the geometry of the mechanism ends, rad, above φ_cr.
    restitution : float
        η of the impact that ends rocking on this side, in [0, 1].
    ties : tuple of SideTie, optional
        Ties that are part of G.
    untied_gravity : callable or None, optional
        G without the ties, needed where there are ties. Its weights grow and fall with g + ü_v; the ties do
        not, and they remember the largest rotation.
    can_overturn : bool, default True
        False where G vanishes nowhere, as what restrains it never yields; critical_rotation is then the rotation
        just below the end, and whatever reaches the end counts as overturned all the same.
    kinks : tuple of float, optional
        Rotations up to φ_cr at which G bends, while it runs straight between them and I and B are constant,
        rad; () of a G that is smooth.

    Raises
    ------
    StructureError
        When G(0) ≤ 0, B ≤ 0 or I ≤ 0 where it matters, or a rotation is out of order.

    Examples
    --------
    >>> round(rocking.Block(2.0, 0.2).mechanism().positive.uplift_multiplier, 4)
    0.2027
    """

    inertia: Function
    inertia_slope: Function
    gravity: Function
    gravity_slope: Function
    ground: Function
    critical_rotation: float
    end_rotation: float
    restitution: float
    ties: tuple[SideTie, ...] = ()
    untied_gravity: Function | None = None
    can_overturn: bool = True
    kinks: tuple[float, ...] = ()

    def __post_init__(self) -> None:
        if self.ties and self.untied_gravity is None:
            raise StructureError(
                "untied_gravity is missing, but must be given with ties; it is G without them.",
                untied_gravity=None,
            )
        critical = positive(StructureError, "critical_rotation", self.critical_rotation, "rad")
        if not self.end_rotation > critical:
            raise StructureError(
                f"end_rotation is {self.end_rotation!r} rad, but must exceed critical_rotation = {critical!r} rad.",
                end_rotation=self.end_rotation,
            )
        object.__setattr__(
            self, "restitution", within(StructureError, "restitution", self.restitution, low=0, high=1)
        )
        for at, names in ((0.0, ("inertia", "gravity", "ground")), (critical, ("inertia", "ground"))):
            for name in names:
                value = self.at(name, at)
                if not value > 0:
                    raise StructureError(
                        f"{name} is {value!r} at a rotation of {at!r} rad, but must be positive there.",
                        **{name: value},
                    )

    def __repr__(self) -> str:
        return f"Side({self.described})"

    @property
    def described(self) -> str:
        """Its four numbers, for a reader."""
        restitution = four_digits(self.restitution)
        if not self.can_overturn:
            return f"λ = {four_digits(self.uplift_multiplier)}, cannot overturn, η = {restitution}"
        frequency = four_digits(self.frequency_parameter, "rad/s")
        rotation = four_digits(self.critical_rotation, "rad")
        return f"λ = {four_digits(self.uplift_multiplier)}, φ_cr = {rotation}, p = {frequency}, η = {restitution}"

    def at(self, name: str, rotation: float) -> float:
        """Return one of the five functions, by name, at one rotation [rad], as a float."""
        return float(getattr(self, name)(np.float64(rotation)))

    @cached_property
    def bends(self) -> tuple[float, ...]:
        """Rotations between rest and φ_cr at which G has a kink, or a tie yields or breaks, in order, rad."""
        bends = {*self.kinks, *(bend for tie in self.ties for bend in tie.bends(self.end_rotation))}
        return tuple(sorted(bend for bend in bends if 0 < bend < self.critical_rotation))

    def restoring(self, rotation: np.ndarray, largest: np.ndarray, weight: np.ndarray | float) -> np.ndarray:
        """Return G (g + ü_v) of weights and G g of ties, at `rotation` after `largest` [rad]; weight: g + ü_v."""
        if not self.ties or self.untied_gravity is None:
            return self.gravity(rotation) * weight
        tied = sum((tie.moment(rotation, largest) for tie in self.ties), np.zeros(np.shape(rotation)))
        return self.untied_gravity(rotation) * weight + tied * GRAVITY

    @cached_property
    def uplift_multiplier(self) -> float:
        """λ = G(0)/B(0), the ground acceleration in g that starts rocking to this side (Eq. 7)."""
        return self.at("gravity", 0.0) / self.at("ground", 0.0)

    @cached_property
    def frequency_parameter(self) -> float:
        """p = sqrt(−g G'(φ_cr)/I(φ_cr)), rad/s (Eq. 11); that of the block exact at rest where it cannot overturn."""
        critical = self.critical_rotation
        if not self.can_overturn:
            stiffness = GRAVITY * self.at("gravity", 0.0) / self.at("inertia", 0.0)
            return float(np.sqrt(stiffness / critical))
        return float(np.sqrt(-GRAVITY * self.at("gravity_slope", critical) / self.at("inertia", critical)))

    @cached_property
    def acceleration_scale(self) -> float:
        """a_sc = −B(φ_cr)/G'(φ_cr) (Eq. 11); φ_cr/λ (Eq. 13) where it cannot overturn."""
        critical = self.critical_rotation
        if not self.can_overturn:
            return critical / self.uplift_multiplier
        return -self.at("ground", critical) / self.at("gravity_slope", critical)

    @property
    def arc(self) -> tuple[Arc, RotationMap]:
        """The arc q = ∫ √(I/I(0)) dφ as far as it is smooth, and its inverse.

        Raises StructureError where it is not smooth even near φ_cr.
        """
        if self._arc is None:
            raise StructureError(
                f"the mechanism's inertia is not smooth up to {self.critical_rotation:.4g} rad, its critical_rotation, "
                "but must be to be followed, or for a block exact at rest; take the block linearised about φ_cr."
            )
        return self._arc

    @cached_property
    def _arc(self) -> tuple[Arc, RotationMap] | None:
        beyond = self.end_rotation - self.critical_rotation
        for cut in CUTS:
            with np.errstate(all="ignore"):
                arc = arc_of(self.inertia, self.end_rotation - cut * beyond, _ARC_ACCURACY)
                inverse = None if arc is None else rotation_map(arc, _MAP_ACCURACY)
            if arc is not None and inverse is not None:
                return arc, inverse
        return None

    def equivalent_block(self, scale: Scale = "exact_at_rest") -> EquivalentBlock:
        """Return the linear block that stands for this side alone; see Mechanism.equivalent_block."""
        linearised = self.acceleration_scale
        alternative = self.critical_rotation / self.uplift_multiplier  # a_sc,alt (Eq. 13)
        mean = (linearised + alternative) / 2
        scales = {"exact_at_rest": alternative, "linearised": linearised, "uplift": alternative, "mean": mean}
        if scale not in scales:
            raise StructureError(f"scale is {scale!r}, but must be one of {', '.join(scales)}.", scale=scale)
        block = EquivalentBlock(
            frequency_parameter=self.frequency_parameter,
            critical_rotation=self.critical_rotation,
            acceleration_scale=scales[scale],
            restitution=self.restitution,
        )
        if scale != "exact_at_rest":
            return block
        # p² = g G(0)/(I(0) q_cr) in x = q/q_cr with the arc q (theory: section 9)
        arc, inverse = self.arc
        stiffness = GRAVITY * self.at("gravity", 0.0) / self.at("inertia", 0.0)
        frequency = float(np.sqrt(stiffness / arc.at(self.critical_rotation)))
        return replace(block, frequency_parameter=frequency, rotation_map=inverse)

    @cached_property
    def block_defects(self) -> BlockDefects:
        """The defects of the block exact at rest."""
        arc, _ = self.arc
        steps = np.linspace(0.0, self.critical_rotation, _DEFECT_SAMPLES)
        bends = np.array(self.bends)
        rotation = np.unique([*steps, *bends * (1 - 1e-12), *bends])  # before a tie breaks, and after
        x = arc.at(rotation) / arc.at(self.critical_rotation)
        stretch = arc.stretch(rotation)
        restoring = self.gravity(rotation) / self.at("gravity", 0.0) / stretch - (1 - x)
        forcing = self.at("ground", self.critical_rotation) / self.at("ground", 0.0) / stretch[-1] - 1
        return BlockDefects(restoring=float(np.abs(restoring).max()), forcing=float(forcing))


@dataclass(frozen=True, eq=False, repr=False)
class Mechanism(Drawn):
    """A structure as the motion sees it: a Side for each direction of rocking; `plot` draws I, G and B over φ.

    Parameters
    ----------
    positive : Side
        The side of positive rotation, taken when the ground accelerates in the negative direction.
    negative : Side or None, optional
        The other side; None when it mirrors the positive one.
    one_sided : bool, default False
        The structure leans on something (a façade against side walls) and rocks to the positive side only; an
        impact then throws it back to the same side.
    restitution_range : float or None, optional
        η is known to plus or minus this much on every side; None: nothing is said of it.

    Examples
    --------
    >>> wall = rocking.Wall(1.6, 1.6, 0.25).mechanism()
    >>> rocking.Mechanism(wall.positive, wall.positive, one_sided=False).symmetric
    False
    """

    positive: Side
    negative: Side | None = None
    one_sided: bool = field(default=False, kw_only=True)
    restitution_range: float | None = field(default=None, kw_only=True)

    def __post_init__(self) -> None:
        if self.one_sided and self.negative is not None:
            raise StructureError(
                "negative is given, but a one-sided mechanism has the positive side only; leave it out.",
                negative=self.negative,
            )

    def __repr__(self) -> str:
        if self.negative is not None:
            return f"Mechanism(positive side: {self.positive.described}; negative side: {self.negative.described})"
        return f"Mechanism({self.positive.described}{', one-sided' if self.one_sided else ''})"

    def __reduce__(self) -> Any:
        """A mechanism of a structure is built again from it in another process: its functions cannot be pickled."""
        structure = self.__dict__.get("structure")
        return super().__reduce__() if structure is None else (methodcaller("mechanism"), (structure,))

    @cached_property
    def tied(self) -> bool:
        """Whether ties hold it."""
        return any(side.ties for side in self.sides)

    @cached_property
    def remembers(self) -> bool:
        """Whether a tie can yield or break, so that what restores depends on the largest rotation so far."""
        return any(tie.tie.strength < np.inf for side in self.sides for tie in side.ties)

    @property
    def symmetric(self) -> bool:
        """Whether both directions share one Side."""
        return self.negative is None and not self.one_sided

    @property
    def sides(self) -> tuple[Side, ...]:
        """The distinct sides, positive first."""
        return (self.positive,) if self.negative is None else (self.positive, self.negative)

    @property
    def can_overturn(self) -> bool:
        """Whether it can overturn to any side; where ties never yield it may not."""
        return any(side.can_overturn for side in self.sides)

    @property
    def never_overturns_because(self) -> str:
        """Why it cannot overturn, in words; "" where it can."""
        if self.can_overturn:
            return ""
        end = max(side.end_rotation for side in self.sides)
        return (
            f"lifts at {self.uplift_multiplier:.3g} g, and what restrains it does not yield up to {end:.3g} rad, where "
            "its geometry ends (ties without a tie_strength count as unbreakable)"
        )

    @property
    def critical_rotation(self) -> float:
        """φ_cr of the positive side, rad."""
        return self.positive.critical_rotation

    @property
    def uplift_multiplier(self) -> float:
        """λ: the smallest ground acceleration in g that starts rocking, over the sides."""
        return min(side.uplift_multiplier for side in self.sides)

    @property
    def restitution(self) -> float:
        """η of the positive side."""
        return self.positive.restitution

    def equivalent_block(self, scale: Scale = "exact_at_rest") -> EquivalentBlock:
        """Return the linear block that stands for this mechanism.

        scale: "exact_at_rest", exact as it lifts and in the place of its unstable equilibrium (theory: section 9);
        or the paper's, linearised about φ_cr (Eqs. 9–13), with the acceleration scale "linearised", "uplift" or
        "mean" (Eq. 13).
        The same object at every call, as it caches what it computes of itself.
        Raises StructureError for another scale.
        """
        known: dict[str, EquivalentBlock] = self.__dict__.setdefault("_blocks", {})
        if scale not in known:
            block = self.positive.equivalent_block(scale)
            other = None if self.negative is None else self.negative.equivalent_block(scale)
            known[scale] = replace(block, other_side=other, one_sided=self.one_sided)
        return known[scale]

    @cached_property
    def block_defects(self) -> BlockDefects:
        """The defects of the block exact at rest, of the worse side."""
        defects = [side.block_defects for side in self.sides]
        return BlockDefects(
            restoring=max(defect.restoring for defect in defects),
            forcing=max((defect.forcing for defect in defects), key=abs),
        )

    def angular_acceleration(
        self,
        rotation: ArrayLike,
        angular_velocity: ArrayLike,
        ground: ArrayLike = 0.0,
        vertical: ArrayLike = 0.0,
        largest: ArrayLike = 0.0,
    ) -> np.ndarray:
        """Return the signed φ'' [rad/s²] in motion (the standard form, with gravity g + ü_v).

        rotation [rad] and angular_velocity [rad/s] are signed; ground and vertical are ü_g and ü_v [m/s²]; largest is
        the largest rotation on that side so far [rad], where it was beyond `rotation`; all broadcast.
        """
        rotation, velocity, ground, vertical, largest = np.broadcast_arrays(
            rotation, angular_velocity, ground, vertical, largest
        )
        result = np.empty(rotation.shape)
        signs = self.side_of(rotation, velocity)
        for sign, side in ((1.0, self.sides[0]), (-1.0, self.sides[-1])):
            here = signs == sign
            phi = np.abs(rotation[here])
            restoring = side.restoring(phi, np.maximum(largest[here], phi), GRAVITY + vertical[here])
            pull = side.inertia_slope(phi) / 2 * velocity[here] ** 2 + restoring
            result[here] = -sign * (pull + sign * side.ground(phi) * ground[here]) / side.inertia(phi)
        return result

    def side_of(self, rotation: np.ndarray, velocity: np.ndarray) -> np.ndarray:
        """Return the side of each state, 1 or −1: the sign of the rotation, at 0 of the velocity; positive at rest."""
        if self.one_sided and (rotation < 0).any():
            raise StructureError(
                "rotation is negative, but a one-sided mechanism rocks to the positive side only.",
                rotation=rotation,
            )
        negative = (rotation < 0) | ((rotation == 0) & (velocity < 0) & (not self.one_sided))
        return np.where(negative, -1.0, 1.0)


PRINTED_SCALE: Scale = "uplift"
"""The block of the source paper (its section 4): p of Eq. 11, linearised about φ_cr, and λ of Eq. 7."""


class Outcome(StrEnum):
    """Outcome of a prediction or an integration.

    Examples
    --------
    >>> rocking.integrate(rocking.Block(2.0, 0.2), rocking.Pulse(amplitude=3.0, circular_frequency=8.0)).outcome
    <Outcome.ROCKS: 'rocks'>
    """

    NO_UPLIFT = "no uplift"
    ROCKS = "rocks"
    OVERTURNS = "overturns"
    FAILED = "failed"

    @classmethod
    def at(cls, rotation_ratio: float) -> "Outcome":
        """The outcome of a largest rotation over the critical one: inf overturns, 0 does not lift."""
        if math.isinf(rotation_ratio):
            return cls.OVERTURNS
        return cls.ROCKS if rotation_ratio > 0 else cls.NO_UPLIFT

    def of(self, rotation_ratio: float) -> str:
        """The outcome in a few words; one that rocks with its largest rotation over φ_cr."""
        return f"rocks to {rotation_ratio:.4g} φ_cr" if self is Outcome.ROCKS else str(self)
