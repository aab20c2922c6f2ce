"""Limit analysis of a wall of rigid courses by linear programming: equilibrium alone, without a mechanism.

Every course is in equilibrium under its weight, λ times its mass sideways, what bears on it and what holds it. A joint
presses at its two edges only and does not slide. The largest λ for which such forces exist is the multiplier.
"""

from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import linprog

_ACCURATELY = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}


@dataclass
class Courses:
    """levels: (n + 1,) of the joints, m, the ground first. left, right: (n,) faces of the courses, m. weight: (n,).

    loads: (x, z, weight, rides). slab: (weight, rides) of a flat one on top. ties: (z, force). floors, backs: heights
    at which something behind pushes outwards. stops: heights that are held both ways, up to `friction`.
    thrusts: (z, force). strength: of the masonry, kPa; joints press at points N/(1.7 f_c) in from their edges.
    All forces in kN per m. A height belongs to the course below it.
    """

    levels: np.ndarray
    left: np.ndarray
    right: np.ndarray
    weight: np.ndarray
    loads: list = field(default_factory=list)
    slab: tuple | None = None
    ties: list = field(default_factory=list)
    floors: list = field(default_factory=list)
    stops: list = field(default_factory=list)
    friction: float = np.inf
    thrusts: list = field(default_factory=list)
    strength: float = np.inf

    def multiplier(self, direction: int) -> float:
        """The largest λ with the ground's inertia forces to `direction`, 1 outwards; inf where none is too large."""
        n = len(self.weight)
        bounds, columns = [], []

        def column(low, high):
            columns.append(np.zeros(3 * n + 2))  # two more for a slab: sideways and upwards
            bounds.append((low, high))
            return columns[-1]

        def act(into, course, x, z, across, up):
            into[3 * course] += across
            into[3 * course + 1] += up
            into[3 * course + 2] += x * up - z * across

        def course_of(z):
            return int(np.searchsorted(self.levels, z - 1e-9, side="left")) - 1

        fixed = np.zeros(3 * n + 2)
        inertia = column(0, None)
        for k in range(n):
            x, z = (self.left[k] + self.right[k]) / 2, (self.levels[k] + self.levels[k + 1]) / 2
            act(fixed, k, x, z, 0, -self.weight[k])
            act(inertia, k, x, z, direction * self.weight[k], 0)
        for x, z, weight, rides in self.loads:
            act(fixed, course_of(z), x, z, 0, -weight)
            act(inertia, course_of(z), x, z, direction * weight * rides, 0)
        for z, force in self.thrusts:
            act(fixed, course_of(z), 0, z, force, 0)
        for k in range(n):
            inner = max(self.left[k], self.left[k - 1]) if k else self.left[0]
            outer = min(self.right[k], self.right[k - 1]) if k else self.right[0]
            # what presses on a joint is all that stands above it, for no hold bears weight
            above = self.weight[k:].sum() + sum(p for _, z, p, _ in self.loads if z > self.levels[k] + 1e-9)
            aside = (above + (self.slab[0] if self.slab else 0.0)) / (1.7 * self.strength)
            for x in (inner + aside, outer - aside):
                press = column(0, None)
                act(press, k, x, self.levels[k], 0, 1)
                if k:
                    act(press, k - 1, x, self.levels[k], 0, -1)
            shear = column(None, None)
            act(shear, k, 0, self.levels[k], 1, 0)
            if k:
                act(shear, k - 1, 0, self.levels[k], -1, 0)
        if self.slab:
            weight, rides = self.slab
            top = self.levels[-1]
            aside = weight / (1.7 * self.strength)
            for x in (self.left[-1] + aside, self.right[-1] - aside):
                press = column(0, None)
                act(press, n - 1, x, top, 0, -1)
                press[-1] += 1
            shear = column(None, None)
            act(shear, n - 1, 0, top, -1, 0)
            shear[-2] += 1
            fixed[-1] -= weight
            inertia[-2] += direction * weight * rides
        for z, force in self.ties:
            act(column(0, None if np.isinf(force) else force), course_of(z), 0, z, -1, 0)
        for z in self.floors:
            act(column(0, None), course_of(z), 0, z, 1, 0)
        for z in self.stops:
            up_to = None if np.isinf(self.friction) else self.friction
            act(column(None if up_to is None else -up_to, up_to), course_of(z), 0, z, 1, 0)
        rows = np.array(columns).T
        cost = np.zeros(len(columns))
        cost[0] = -1
        scale = np.abs(fixed).max()
        solved = linprog(
            cost,
            A_eq=rows / scale,
            b_eq=-fixed / scale,
            bounds=bounds,
            method="highs-ds",
            options=_ACCURATELY,
        )
        if solved.status == 2:
            return -np.inf  # it does not stand at rest
        if solved.status == 3:
            return np.inf
        assert solved.status == 0, solved.message
        return float(-solved.fun)
