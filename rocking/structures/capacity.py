"""The capacity curve of a mechanism: the static load multiplier against displacement, what codes start from.

Virtual work at a rotation φ: a horizontal body force λ g that just holds the structure there has λ(φ) = G(φ)/B(φ). It
starts at the uplift multiplier and falls to 0 at the critical rotation.
"""

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from rocking.errors import StructureError

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from rocking.structures.structure import Structure

_STEP = 1e-5
"""Rotation over which velocities at rest are differenced, rad: errors of 1e-10 of a length."""


@dataclass(frozen=True, eq=False)
class CapacityCurve:
    """Load multiplier and displacements of one side at k rotations from rest to the critical one.

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

    def plot(self, axes: "Axes | None" = None) -> "Axes":
        """Draw the multiplier against the displacement of the control point; return the axes."""
        from rocking import plot  # the drawing stands above everything

        return plot(self, axes)


def capacity_curve(structure: "Structure", side: int = 1, count: int = 41) -> CapacityCurve:
    """Return the curve of the positive (1) or negative (−1) side of `structure` at `count` equal steps of rotation.

    Where ties yield or break on the way there is a point more, and just beyond it another.
    Raises StructureError for a side to which it does not rock, or fewer than two points.
    """
    mechanism = structure.mechanism()
    if side not in (1, -1) or (side == -1 and mechanism.one_sided):
        raise StructureError(
            f"side is {side!r}, but must be 1, or -1 where the structure rocks to both sides."
        )
    if count < 2:
        raise StructureError(f"count is {count!r}, but must be 2 or more.")
    of = mechanism.sides[0 if side > 0 else -1]
    rotation = np.linspace(0.0, of.critical_rotation, count)
    if of.remembers:
        bends = np.array([bend for bend in of.bends if bend < of.critical_rotation])
        rotation = np.unique(np.concatenate([rotation, bends, bends * (1 + 1e-12)]))
    control_point, displacement, control_speed = _control(structure, side * rotation)
    across, masses = _virtual_displacements(structure)
    first, second = masses @ across, masses @ across**2
    return CapacityCurve(
        rotation=rotation,
        multiplier=of.gravity(rotation) / of.ground(rotation),
        displacement=displacement,
        effective_displacement=displacement * second / (control_speed * first),
        control_point=control_point,
        participating_mass_ratio=float(first**2 / (masses.sum() * second)),
    )


def _control(structure: "Structure", rotations: np.ndarray) -> tuple[tuple[float, float], np.ndarray, float]:
    """The corner that moves furthest sideways: where it is at rest, how far it moves, and its speed for φ' = 1."""
    sign = np.sign(rotations[-1])
    rotations = np.append(rotations, [sign * _STEP, sign * 2 * _STEP])
    places = np.array([np.vstack(structure.outline(rotation or sign * 1e-300)) for rotation in rotations])
    moved = np.abs(places[:, :, 0] - places[0, :, 0])
    corner = int(np.argmax(moved[(len(rotations) - 2) // 2]))
    once, twice = moved[-2:, corner]
    x, y = places[0, corner]
    return (float(x), float(y)), moved[:-2, corner], float(2 * once - twice / 2) / _STEP


def _virtual_displacements(structure: "Structure") -> tuple[np.ndarray, np.ndarray]:
    """Horizontal velocity of each moving mass at rest for φ' = 1, and the masses."""
    masses = structure.bodies(0.0).masses
    places = structure.bodies(np.array([-_STEP, _STEP])).centres.real
    return (places[:, 1] - places[:, 0]) / (2 * _STEP), masses
