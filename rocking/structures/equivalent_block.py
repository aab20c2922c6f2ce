"""The equivalent block: a mechanism's motion made linear, and what that leaves out."""

from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Literal

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY, positive, within
from rocking.structures.arc import RotationMap

if TYPE_CHECKING:
    from rocking.structures.mechanism import Side

Scale = Literal["rest", "linearised", "uplift", "mean"]
"""Which equivalent block: exact at rest, or linearised about φ_cr with a_sc, a_sc,alt = φ_cr/λ, or their mean."""

_DEFECT_SAMPLES = 401


@dataclass(frozen=True)
class EquivalentBlock:
    """x'' = p² (x − 1 − s ü_g/(gλ)): the linear rocking block, with x = φ/φ_cr (Eq. 10) or a measure of the rotation.

    frequency_parameter: p, rad/s. critical_rotation: φ_cr, rad. acceleration_scale: a_sc = φ_cr/λ, -. restitution: η of
    the angular velocity, in [0, 1]. other_side: the block of the negative side when the two differ; None when they
    mirror each other. one_sided: rocks to the positive side only and is thrown back at φ = 0. rotation_map: the
    rotation as a function of the arc, where x is the arc over that of φ_cr (theory: section 9); None where x = φ/φ_cr.
    Whatever follows the block reads its answer back through the map, as φ/φ_cr of the structure.
    """

    frequency_parameter: float
    critical_rotation: float
    acceleration_scale: float
    restitution: float
    other_side: "EquivalentBlock | None" = None
    one_sided: bool = False
    rotation_map: RotationMap | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        for name, unit in (
            ("frequency_parameter", "rad/s"),
            ("critical_rotation", "rad"),
            ("acceleration_scale", ""),
        ):
            object.__setattr__(self, name, positive(StructureError, name, getattr(self, name), unit))
        object.__setattr__(self, "restitution", within(StructureError, "restitution", self.restitution, 0, 1))
        if self.other_side is not None and (self.one_sided or self.other_side.other_side is not None):
            raise StructureError(
                "other_side is given, but a one-sided block has none and another side has no further one."
            )

    @property
    def uplift_multiplier(self) -> float:
        """λ of the positive side = φ_cr/a_sc, the ground acceleration in g that starts rocking (Eq. 12)."""
        return self.critical_rotation / self.acceleration_scale

    @property
    def symmetric(self) -> bool:
        """Whether both directions are alike."""
        return self.other_side is None and not self.one_sided

    @property
    def sides(self) -> "tuple[EquivalentBlock, ...]":
        """The distinct sides, positive first."""
        return (self,) if self.other_side is None else (self, self.other_side)

    @cached_property
    def critical_arc(self) -> float:
        """The arc at φ_cr, rad: what x = 1 is, and what turns x' into an angular velocity at φ = 0."""
        if self.rotation_map is None:
            return self.critical_rotation
        return self.rotation_map.arc(self.critical_rotation)

    @cached_property
    def end(self) -> float:
        """x beyond which the mechanism ends; inf where x = φ/φ_cr, which has no end."""
        return np.inf if self.rotation_map is None else self.rotation_map.end / self.critical_arc

    @property
    def velocity_scale(self) -> float:
        """Angular velocity at φ = 0, rad/s, for each unit of dx/d(pt)."""
        return self.frequency_parameter * self.critical_arc

    def rotation_ratio(self, x: float) -> float:
        """Return φ/φ_cr of the positive side at one x; inf beyond the end of the mechanism."""
        if self.rotation_map is None:
            return x
        return self.rotation_map.rotation_at(x * self.critical_arc) / self.critical_rotation

    def rotation_ratios(self, x: np.ndarray) -> np.ndarray:
        """The same of many, any shape."""
        if self.rotation_map is None:
            return x
        return self.rotation_map.rotation(x * self.critical_arc) / self.critical_rotation


@dataclass(frozen=True)
class BlockDefects:
    """How far the equation of the block exact at rest is from the mechanism's, known without any ground motion.

    restoring: the largest difference between the two restoring accelerations up to φ_cr, over the one at rest. forcing:
    by how much the mechanism's response to the ground has grown at φ_cr, over that at rest; the block's stays as it is,
    so that a positive value errs on the unsafe side. Of two unlike sides, the worse (theory: section 9).
    """

    restoring: float
    forcing: float


def block_of(side: "Side", scale: Scale) -> EquivalentBlock:
    """Return the block of one side."""
    if scale == "rest":
        return _exact_at_rest(side)
    return EquivalentBlock(
        frequency_parameter=side.frequency_parameter,
        critical_rotation=side.critical_rotation,
        acceleration_scale=side.scaled_acceleration(scale),
        restitution=side.restitution,
    )


def _exact_at_rest(side: "Side") -> EquivalentBlock:
    """p² = g G(0)/(I(0) q_cr) and the true λ, in x = q/q_cr with the arc q (theory: section 9)."""
    arc, rotation_map = side.arc
    stiffness = GRAVITY * side.at("gravity", 0.0) / side.at("inertia", 0.0)
    return EquivalentBlock(
        frequency_parameter=float(np.sqrt(stiffness / arc.at(side.critical_rotation))),
        critical_rotation=side.critical_rotation,
        acceleration_scale=side.critical_rotation / side.uplift_multiplier,
        restitution=side.restitution,
        rotation_map=rotation_map,
    )


def defects_of(side: "Side") -> BlockDefects:
    """Return what the block exact at rest leaves out of one side."""
    arc, _ = side.arc
    rotation = np.linspace(0.0, side.critical_rotation, _DEFECT_SAMPLES)
    if side.remembers:
        bends = np.array([bend for bend in side.bends if bend < side.critical_rotation])
        rotation = np.unique([*rotation, *bends * (1 - 1e-12), *bends])  # before a tie breaks, and after
    x = arc.at(rotation) / arc.at(side.critical_rotation)
    stretch = arc.stretch(rotation)
    restoring = side.gravity(rotation) / side.at("gravity", 0.0) / stretch - (1 - x)
    forcing = side.at("ground", side.critical_rotation) / side.at("ground", 0.0) / stretch[-1] - 1
    return BlockDefects(float(np.abs(restoring).max()), float(forcing))
