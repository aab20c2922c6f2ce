"""The four-bar linkage A-B-C-D of a rocking arch, with exact derivatives of its loop (theory: section 5).

Points are complex numbers x + iy. φ is the clockwise rotation of bar AB about A; A and D follow the ground.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from rocking.structures.arch_ring import Ring
from rocking.structures.bars import Bars, Motion, cross, keeps_last
from rocking.structures.restitution import momentum_balance


@dataclass(frozen=True, eq=False)
class Linkage:
    """hinges: A, B, C, D at rest, (4,) complex m. bars: what they carry."""

    hinges: np.ndarray
    bars: Bars

    @keeps_last
    def motion(self, rotation: np.ndarray) -> Motion:
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
        return self._carried(turned, ab, spins, slopes)

    def _carried(self, turned: np.ndarray, ab: np.ndarray, spins: np.ndarray, slopes: np.ndarray) -> Motion:
        """Centroids carried by bars turned by the unit numbers `turned`: AB about A, BC about B, CD about D."""
        arms = turned * (self.bars.centroids - self.hinges[[0, 1, 3]]).reshape(3, *[1] * (turned.ndim - 1))
        zero = np.zeros_like(ab)
        pivots = np.stack([self.hinges[0] + zero, self.hinges[0] + ab, self.hinges[3] + zero])
        pivot_velocity = np.stack([zero, -1j * ab, zero])
        pivot_acceleration = np.stack([zero, -ab, zero])
        end = self.hinges[3] + zero
        return Motion(
            hinges=np.stack([pivots[0], pivots[1], end - turned[2] * self._at_rest[2], end]),
            angles=np.angle(turned),
            spins=spins,
            spin_slopes=slopes,
            centroids=pivots + arms,
            velocities=pivot_velocity + 1j * spins * arms,
            accelerations=pivot_acceleration + (1j * slopes - spins**2) * arms,
        )

    def _directions(self, rotation: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """AB, BC and CD at `rotation`: AB is turned, C is where the circles about B and D meet."""
        ab = self._at_rest[0] * np.exp(-1j * rotation)
        diagonal = self.hinges[3] - self.hinges[0] - ab
        length, (_, bc, cd) = np.abs(diagonal), np.abs(self._at_rest)
        along = (length**2 + bc**2 - cd**2) / (2 * length)
        across = self._branch * np.sqrt(bc**2 - along**2)
        to_c = (along + 1j * across) * diagonal / length
        return ab, to_c, diagonal - to_c

    @cached_property
    def _at_rest(self) -> np.ndarray:
        return np.diff(self.hinges)

    @cached_property
    def _branch(self) -> float:
        diagonal = self.hinges[3] - self.hinges[1]
        return float(np.sign(cross(diagonal, self._at_rest[1])))

    def inertia(self, rotation: ArrayLike) -> np.ndarray:
        """I = Σ m|r'|² + I_c ω², shape of `rotation`."""
        motion = self.motion(rotation)
        return _sum(self.bars.masses, np.abs(motion.velocities) ** 2) + _sum(
            self.bars.inertias, motion.spins**2
        )

    def inertia_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dI/dφ = 2 Σ m r'·r'' + I_c ω ω'."""
        motion = self.motion(rotation)
        turning = _sum(self.bars.inertias, motion.spins * motion.spin_slopes)
        return 2 * (_sum(self.bars.masses, (motion.velocities.conj() * motion.accelerations).real) + turning)

    def gravity(self, rotation: ArrayLike) -> np.ndarray:
        """G = Σ m y'."""
        return _sum(self.bars.masses, self.motion(rotation).velocities.imag)

    def gravity_slope(self, rotation: ArrayLike) -> np.ndarray:
        """dG/dφ = Σ m y''."""
        return _sum(self.bars.masses, self.motion(rotation).accelerations.imag)

    def ground(self, rotation: ArrayLike) -> np.ndarray:
        """B = Σ m x'."""
        return _sum(self.bars.masses, self.motion(rotation).velocities.real)

    def last_rotation(self) -> float:
        """The rotation [rad] up to which the motion is followed: A, B and C in line, or just before the bars lock."""
        end = self.straightening()
        places = np.linspace(0.0, end if np.isfinite(end) else np.pi / 2, 513)
        with np.errstate(all="ignore"):
            inertia = self.inertia(places)
        moves = np.isfinite(inertia) & (inertia > 0)
        if moves.all():
            return float(places[-1])
        return float(0.98 * places[int(np.argmin(moves)) - 1])

    def straightening(self) -> float:
        """The rotation [rad] at which A, B and C come into line: the linkage snaps through and CD turns back.

        The triangle A-C-D then has the sides |AB| + |BC|, |CD| and |AD|.
        """
        base = self.hinges[3] - self.hinges[0]
        first, second, third = np.abs(self._at_rest)
        side = first + second
        cosine = (abs(base) ** 2 + side**2 - third**2) / (2 * abs(base) * side)
        return float(np.angle(self._at_rest[0] / base) - np.arccos(cosine))


def _sum(weights: np.ndarray, terms: np.ndarray) -> np.ndarray:
    return np.tensordot(weights, terms, axes=1)


def mirror_balance(ring: Ring, linkage: Linkage, hinges: np.ndarray) -> float:
    """Return η = −⟨u, u_m⟩/⟨u_m, u_m⟩ of the velocity fields for φ' = 1 at φ = 0 of a ring and of its mirror image.

    hinges: (4,) sections, rad.
    """
    edges = np.unique(np.concatenate([hinges, -hinges, [-ring.embrace_angle / 2, ring.embrace_angle / 2]]))
    edges = edges[np.append(True, np.diff(edges) > 1e-12)]
    parts = ring.bars(edges)
    middles = (edges[1:] + edges[:-1]) / 2
    arriving = _velocities(linkage, hinges, middles, parts.centroids)
    mirrored = _velocities(linkage, hinges, -middles, -parts.centroids.conj()) * [-1.0, 1.0, -1.0]
    return momentum_balance(parts.masses, parts.inertias, -arriving, mirrored)


def _velocities(linkage: Linkage, hinges: np.ndarray, sections: np.ndarray, points: np.ndarray) -> np.ndarray:
    """(k, 3) velocities (vx, vy, ω) at φ = 0, φ' = 1 of the parts at `sections` with centroids `points`."""
    motion = linkage.motion(0.0)
    bar = np.searchsorted(hinges, sections) - 1
    moving = (bar >= 0) & (bar <= 2)
    bar = np.clip(bar, 0, 2)
    spins = motion.spins[bar]
    speed = motion.velocities[bar] + 1j * spins * (points - motion.centroids[bar])
    return np.stack([speed.real, speed.imag, spins], axis=1) * moving[:, None]
