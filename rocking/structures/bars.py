"""Rigid bars that move as one mechanism: what they weigh and how they move with φ. Points are complex, x + iy."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, eq=False)
class Bars:
    """Masses, centroids (complex, at rest) and inertias about the centroids of some rigid parts: (k,) each."""

    masses: np.ndarray
    centroids: np.ndarray
    inertias: np.ndarray


@dataclass(frozen=True, eq=False)
class Motion:
    """k bars at some rotations of the mechanism, and their first and second derivatives with φ.

    hinges: (h, ...) complex contact points. angles: (k, ...) counterclockwise turn of each bar from rest, rad; spins
    and spin_slopes: its derivatives. centroids, velocities, accelerations: (k, ...) complex, with their derivatives.
    """

    hinges: np.ndarray
    angles: np.ndarray
    spins: np.ndarray
    spin_slopes: np.ndarray
    centroids: np.ndarray
    velocities: np.ndarray
    accelerations: np.ndarray


def cross(one: np.ndarray, other: np.ndarray) -> np.ndarray:
    """Return the cross product of plane vectors given as complex numbers."""
    return one.real * other.imag - one.imag * other.real
