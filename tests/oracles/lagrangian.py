"""The equation of motion of one degree of freedom from positions and potential energy alone, with thirty digits.

It knows where every mass is at a rotation and what energy is stored; derivatives are mpmath's. Nothing here knows of I,
J, G or B.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from mpmath import mp, mpf

mp.dps = 30


@dataclass(frozen=True)
class Lagrangian:
    """places(φ): for each mass (mass, inertia, x, y, angle). stored(φ): energy in springs, loads and thrusts, J.

    stretches(φ): of the springs.
    """

    places: Callable[[mpf], Sequence[tuple]]
    stored: Callable[[mpf], mpf] = lambda phi: mpf(0)
    stretches: Callable[[mpf], Sequence[mpf]] = lambda phi: ()

    def acceleration(self, rotation: float, velocity: float, ground: float, gravity: float) -> float:
        """φ'' from d/dt ∂T/∂φ' − ∂T/∂φ + ∂V/∂φ = −Σ m x' ü_g."""

        def speeds(phi):
            masses = self.places(phi)
            rates = [
                [mp.diff(lambda angle, k=k, c=c: self.places(angle)[k][c], phi) for c in (2, 3, 4)]
                for k in range(len(masses))
            ]
            return masses, rates

        def kinetic(phi):
            masses, rates = speeds(phi)
            pairs = zip(masses, rates, strict=True)
            return sum(m[0] * (r[0] ** 2 + r[1] ** 2) + m[1] * r[2] ** 2 for m, r in pairs)

        at = mpf(rotation)
        masses, rates = speeds(at)
        weight = sum(m[0] * r[1] for m, r in zip(masses, rates, strict=True)) * mpf(gravity)
        push = sum(m[0] * r[0] for m, r in zip(masses, rates, strict=True)) * mpf(ground)
        inertia, slope = kinetic(at), mp.diff(kinetic, at)
        return float(-(slope * mpf(velocity) ** 2 / 2 + weight + mp.diff(self.stored, at) + push) / inertia)


def turned(point, pivot, angle):
    """`point` turned clockwise by `angle` about `pivot`."""
    x, y = point[0] - pivot[0], point[1] - pivot[1]
    c, s = mp.cos(angle), mp.sin(angle)
    return pivot[0] + c * x + s * y, pivot[1] - s * x + c * y
