"""Free rigid bars joined by constraint multipliers: the formula-free oracle for mechanisms.

Knows masses, inertias and pins only. Every bar has three coordinates (x, y, angle); every pin holds a point of a bar to
the ground or to a point of another bar, in one or two directions. Accelerations and pin forces come from one linear
system, M a + Cᵀ f = loads, C a = −(quadratic velocity terms); nothing here knows of φ, I, J, G or B.
"""

from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp


@dataclass(frozen=True)
class Bar:
    """mass, inertia about the centre, centre (2,) at rest."""

    mass: float
    inertia: float
    centre: np.ndarray


@dataclass(frozen=True)
class Pin:
    """A point (2,) at rest, shared by bar `first` and bar `second` (None: the ground), held in `directions`."""

    point: np.ndarray
    first: int
    second: int | None = None
    directions: tuple[int, ...] = (0, 1)


def _turn(angle):
    return np.array([[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]])


@dataclass(frozen=True)
class Multibody:
    """Bars and pins, in the frame of the ground; gravity and the ground's acceleration act as body forces."""

    bars: tuple[Bar, ...]
    pins: tuple[Pin, ...]
    gravity: float

    def _constraints(self, angles, spins):
        """C (c, 3n) and the quadratic velocity terms (c,)."""
        rows, terms = [], []
        for pin in self.pins:
            matrix, term = np.zeros((2, 3 * len(self.bars))), np.zeros(2)
            for bar, sign in ((pin.first, 1.0), (pin.second, -1.0)):
                if bar is None:
                    continue
                arm = _turn(angles[bar]) @ (pin.point - self.bars[bar].centre)
                matrix[:, 3 * bar : 3 * bar + 2] = sign * np.eye(2)
                matrix[:, 3 * bar + 2] = sign * np.array([-arm[1], arm[0]])
                term -= sign * arm * spins[bar] ** 2
            rows.append(matrix[list(pin.directions)])
            terms.append(term[list(pin.directions)])
        return np.concatenate(rows), np.concatenate(terms)

    def solve(self, angles, spins, ground, vertical):
        """Accelerations (3n,) and forces of the pins on their first bars, in the order of pins and directions."""
        constraints, terms = self._constraints(angles, spins)
        masses = np.concatenate([[bar.mass, bar.mass, bar.inertia] for bar in self.bars])
        loads = np.concatenate(
            [[-bar.mass * ground, -bar.mass * (self.gravity + vertical), 0] for bar in self.bars]
        )
        size, count = masses.size, terms.size
        system = np.block([[np.diag(masses), -constraints.T], [constraints, np.zeros((count, count))]])
        solution = np.linalg.solve(system, np.concatenate([loads, -terms]))
        return solution[:size], solution[size:]

    def spins_for(self, angles, spin):
        """Angular velocities of all bars when the first has `spin`."""
        constraints, _ = self._constraints(angles, np.zeros(len(self.bars)))
        leading = np.zeros(constraints.shape[1])
        leading[2] = 1.0
        matrix = np.vstack([constraints, leading])
        return np.linalg.lstsq(matrix, np.append(np.zeros(len(constraints)), spin), rcond=None)[0][2::3]

    def simulate(self, spin, times, ground, vertical):
        """Angles and spins, (len(times), n) each, from rest position; the first bar starts at `spin`."""
        count = len(self.bars)

        def rate(time, state):
            accelerations, _ = self.solve(state[:count], state[count:], ground(time), vertical(time))
            return np.concatenate([state[count:], accelerations[2::3]])

        start = np.concatenate([np.zeros(count), self.spins_for(np.zeros(count), spin)])
        solution = solve_ivp(rate, (times[0], times[-1]), start, "DOP853", times, rtol=1e-12, atol=1e-13)
        return solution.y[:count].T, solution.y[count:].T
