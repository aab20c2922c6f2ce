"""The load that a mechanism bears at rest, by virtual work: multiplier and displacement by rotation on one side.

The displacement of the equivalent system of one degree of freedom and its participating mass are those of the virtual
displacements at rest.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import itemgetter

import numpy as np
from numpy.typing import ArrayLike

from rocking.drawn import Drawn
from rocking.structures.drawing import plane
from rocking.structures.linkage import Linkage
from rocking.structures.mechanism import Side

_STILL = 1e-12
"""Share of the largest virtual displacement below which one is rounding: at what is held."""


@dataclass(frozen=True, eq=False)
class StaticCurve(Drawn):
    """Static load multiplier against displacement, at k rotations from rest to the critical one; `plot` draws it.

    By virtual work a horizontal body force λ g that just holds the structure at φ has λ(φ) = G(φ)/B(φ). It starts at
    the uplift multiplier and falls to 0 at the critical rotation.
    rotation: (k,) rad. multiplier: (k,) λ. displacement: (k,) horizontal, of the control point, m. control_point: (2,)
    where it is at rest, m: of all corners of the drawing the one that moves furthest sideways.
    effective_displacement: (k,) d* = d_k Σ P δ²/(δ_k Σ P δ), m, with the virtual horizontal displacements δ of the
    weights P at rest. participating_mass_ratio: (Σ P δ)²/(Σ P · Σ P δ²).
    """

    rotation: np.ndarray = field(repr=False)
    multiplier: np.ndarray = field(repr=False)
    displacement: np.ndarray = field(repr=False)
    effective_displacement: np.ndarray = field(repr=False)
    control_point: tuple[float, float]
    participating_mass_ratio: float


@dataclass(frozen=True, eq=False)
class StaticCapacity:
    """The static capacity of one side of a structure.

    control_part, control_corner: the point whose displacement counts, a corner of the drawing as this side sees it.
    place: where it is at rest, m. displacement_factor: d*/d_k. participating_mass_ratio: as of StaticCurve, of the
    weights that move sideways at rest; mass_ratio_of_all: of those too that something else holds sideways.
    rounding: the displacement of the control point at rest, m, which is taken off.
    """

    side: Side
    linkage: Linkage
    control_part: int
    control_corner: complex
    place: tuple[float, float]
    displacement_factor: float
    participating_mass_ratio: float
    mass_ratio_of_all: float
    rounding: float

    @classmethod
    def of(
        cls, side: Side, linkage: Linkage, parts: Sequence[tuple[int, np.ndarray]], mirrored: bool
    ) -> "StaticCapacity":
        """Return that of a side whose moving outlines are `parts`; the control point moves furthest half-way out."""
        farthest = []
        for part, corners in parts:
            shifts = linkage.point(part, corners, side.critical_rotation / 2).moved.real
            corner = int(shifts.argmax())
            farthest.append((float(shifts[corner]), part, complex(corners[corner])))
        _, control_part, control_corner = max(farthest, key=itemgetter(0))
        place = plane(np.asarray(control_corner), mirrored)

        # a mass that something else holds sideways, as that of a load that only rises, has no part
        at_rest = linkage.motion(0.0)
        across = at_rest.velocities.real
        masses = np.where(np.abs(across) < _STILL * np.abs(across).max(), 0.0, linkage.masses)
        first = masses @ across
        second = masses @ across**2
        control = linkage.point(control_part, control_corner, 0.0)
        speed = float(control.velocity.real)
        return cls(
            side=side,
            linkage=linkage,
            control_part=control_part,
            control_corner=control_corner,
            place=(float(place[0]), float(place[1])),
            displacement_factor=float(second / (speed * first)),
            participating_mass_ratio=float(first**2 / (masses.sum() * second)),
            mass_ratio_of_all=float(first**2 / (linkage.masses.sum() * second)),
            rounding=float(control.moved.real),
        )

    def multiplier(self, rotation: ArrayLike) -> np.ndarray:
        """Return λ(φ) = G(φ)/B(φ) at `rotation` [rad], of any shape."""
        at = np.asarray(rotation, dtype=float)
        return self.side.gravity(at) / self.side.ground(at)

    def displacement(self, rotation: ArrayLike) -> np.ndarray:
        """Return the horizontal displacement of the control point, m."""
        moved = self.linkage.point(self.control_part, self.control_corner, rotation).moved.real
        return moved - self.rounding

    def curve(self, count: int) -> StaticCurve:
        """Return it at `count` equal steps of rotation, and where ties yield or break and just beyond."""
        steps = np.linspace(0.0, self.side.critical_rotation, count)
        bends = np.array(self.side.bends)
        rotation = np.unique([*steps, *bends, *bends * (1 + 1e-12)])
        displacement = self.displacement(rotation)
        displacement = displacement - displacement[0]  # which is rounding
        return StaticCurve(
            rotation=rotation,
            multiplier=self.multiplier(rotation),
            displacement=displacement,
            effective_displacement=displacement * self.displacement_factor,
            control_point=self.place,
            participating_mass_ratio=self.participating_mass_ratio,
        )
