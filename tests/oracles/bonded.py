"""Limit analysis in three dimensions of a wall of rigid units in running bond, by equilibrium and linear programming.

Units touch at the corners of the areas that they share: what presses there is not negative, and friction stays within a
pyramid of eight sides in the cone of Coulomb. x along the wall, y outwards from the inner face, z up.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import csr_matrix

FRICTION = 0.6
_DIRECTIONS = np.column_stack([np.cos(np.arange(8) * np.pi / 4), np.sin(np.arange(8) * np.pi / 4)])


@dataclass
class BondedWall:
    """A wall of that length, height and thickness in m, of units of that length and height; forces in kN.

    unit_weight: kN/m³. load: kN per m on its top, at mid-thickness; rides: whether its mass pushes, too. ties: x of
    each at the top. held: whether it is held outwards all along the top, too. ends_stay: whether its ends cannot
    spread.
    """

    length: float
    height: float
    thickness: float
    unit: tuple[float, float]
    unit_weight: float
    load: float
    ties: tuple[float, ...]
    held: bool = False
    rides: bool = False
    ends_stay: bool = False

    def multiplier(self) -> float:
        """The largest λ of inertia forces outwards that can be resisted."""
        units = self._units()
        rows, columns, values, cost, bounds = [], [], [], [], []
        fixed = np.zeros(6 * len(units))

        def column(low, high, price=0.0):
            cost.append(price)
            bounds.append((low, high))
            return len(cost) - 1

        def act(number, unit, point, force):
            x, z, width, rise = units[unit]
            arm = np.asarray(point) - (x + width / 2, self.thickness / 2, z + rise / 2)
            for place, value in enumerate([*force, *np.cross(arm, force)]):
                if value:
                    rows.append(6 * unit + place)
                    columns.append(number)
                    values.append(value)

        inertia = column(0, None, -1.0)
        top = max(z + rise for _, z, _, rise in units)
        for place, (x, z, width, rise) in enumerate(units):
            weight = self.unit_weight * width * rise * self.thickness
            middle = (x + width / 2, self.thickness / 2, z + rise / 2)
            fixed[6 * place + 2] -= weight
            act(inertia, place, middle, (0, weight, 0))
            if z + rise > top - 1e-9:
                fixed[6 * place + 2] -= self.load * width
                head = (x + width / 2, self.thickness / 2, top)
                act(inertia, place, head, (0, self.load * width * self.rides, 0))
                last = x + width == self.length
                at = [tie for tie in self.ties if x <= tie < x + width or (last and tie == self.length)]
                at += [x + width / 2] if self.held else []
                for one_place in at:
                    act(column(0, None), place, (one_place, self.thickness, top), (0, -1, 0))

        for place, (x, z, width, rise) in enumerate(units if self.ends_stay else []):
            for end, push in ((0.0, 1.0), (self.length, -1.0)):
                if end in (x, x + width):
                    for corner in [(end, y, e) for y in (0.0, self.thickness) for e in (z, z + rise)]:
                        act(column(0, None), place, corner, (push, 0, 0))

        for one, other, corners, normal, along in self._contacts(units):
            for corner in corners:
                for side in _DIRECTIONS:
                    force = np.array(normal) + FRICTION * (
                        side[0] * np.array(along[0]) + side[1] * np.array(along[1])
                    )
                    number = column(0, None)
                    act(number, one, corner, force)
                    if other is not None:
                        act(number, other, corner, -force)
        matrix = csr_matrix((values, (rows, columns)), shape=(6 * len(units), len(cost)))
        solved = linprog(cost, A_eq=matrix, b_eq=-fixed, bounds=bounds, method="highs")
        assert solved.status == 0, solved.message
        return float(-solved.fun)

    def _units(self):
        """x, z, width and rise of each unit."""
        wide, tall = self.unit
        units = []
        for course in range(round(self.height / tall)):
            first = wide / 2 if course % 2 else 0.0
            joints = [0.0, *np.arange(first or wide, self.length - 1e-9, wide), self.length]
            units += [(low, course * tall, high - low, tall) for low, high in pairwise(joints)]
        return units

    def _contacts(self, units):
        """Each contact: the unit it presses on, the other one or None, its corners, the normal, and along it."""
        faces = (0.0, self.thickness)
        for one, (x, z, width, rise) in enumerate(units):
            if z == 0:
                yield (
                    one,
                    None,
                    [(e, y, 0.0) for e in (x, x + width) for y in faces],
                    (0, 0, 1),
                    ((1, 0, 0), (0, 1, 0)),
                )
            for other, (left, foot, breadth, tall) in enumerate(units):
                low, high = max(x, left), min(x + width, left + breadth)
                if abs(foot + tall - z) < 1e-9 and high - low > 1e-9:
                    corners = [(e, y, z) for e in (low, high) for y in faces]
                    yield one, other, corners, (0, 0, 1), ((1, 0, 0), (0, 1, 0))
                if abs(foot - z) < 1e-9 and abs(left + breadth - x) < 1e-9:
                    corners = [(x, y, e) for e in (z, z + rise) for y in faces]
                    yield one, other, corners, (1, 0, 0), ((0, 1, 0), (0, 0, 1))
