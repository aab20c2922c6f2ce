"""Limit analysis of rigid blocks with friction (Livesley 1978): equilibrium of each block, and nothing of the product.

Each joint bears at its two ends, by two forces that press and share the friction along it.
"""

from collections.abc import Sequence

import numpy as np
from scipy.optimize import linprog


def sector(inner: float, outer: float, first: float, last: float) -> tuple[float, np.ndarray]:
    """Area [m²] and centroid (2,) of an annular sector, by quadrature over its polar coordinates."""
    radii, of_radius = np.polynomial.legendre.leggauss(4)
    radii = (outer + inner) / 2 + (outer - inner) / 2 * radii
    angles, of_angle = np.polynomial.legendre.leggauss(20)
    angles = (last + first) / 2 + (last - first) / 2 * angles
    weights = np.outer(of_radius * radii, of_angle) * (outer - inner) / 2 * (last - first) / 2
    x = weights * np.outer(radii, np.sin(angles))
    y = weights * np.outer(radii, np.cos(angles))
    area = weights.sum()
    return float(area), np.array([x.sum(), y.sum()]) / area


def columns(outer: float, level: float, first: float, last: float) -> tuple[float, np.ndarray]:
    """Area [m²] of what lies between an arc and a level, and where it bears: in vertical columns, on the arc below."""
    angles, weights = np.polynomial.legendre.leggauss(20)
    angles = (last + first) / 2 + (last - first) / 2 * angles
    areas = weights * (last - first) / 2 * outer * np.cos(angles) * (level - outer * np.cos(angles))
    points = outer * np.stack([np.sin(angles), np.cos(angles)], axis=1)
    return float(areas.sum()), areas @ points / areas.sum()


def rectangle(width: float, height: float) -> tuple[float, np.ndarray]:
    """Area [m²] and centre (2,) of a rectangle on the middle of its foot."""
    return width * height, np.array([0.0, height / 2])


def together(parts: Sequence[tuple[float, np.ndarray]]) -> tuple[float, np.ndarray]:
    """Mass and centre (2,) of some parts."""
    masses = np.array([mass for mass, _ in parts])
    return float(masses.sum()), masses @ np.array([centre for _, centre in parts]) / masses.sum()


def greatest_multiplier(
    joints: np.ndarray, masses: np.ndarray, centres: np.ndarray, friction: float
) -> float:
    """The largest push to the right over the weight that a chain of blocks bears; nan where it does not stand.

    joints: (n + 1, 2, 2) both ends of each, from one ground to the other. masses: (n,). centres: (n, 2).
    """
    count = len(masses)
    variables = 4 * (count + 1) + 1  # at each end of a joint the force across it and along it; the multiplier
    balance, loads = np.zeros((3 * count, variables)), np.zeros(3 * count)
    cones = []
    for joint, ends in enumerate(joints):
        along = ends[1] - ends[0]
        along = along / np.linalg.norm(along)
        across = np.array([-along[1], along[0]])
        if joint < count:
            across = across * np.sign(across @ (centres[joint] - ends[0]))
        else:
            across = across * np.sign(across @ (ends[0] - centres[joint - 1]))
        for end, point in enumerate(ends):
            place = 4 * joint + 2 * end
            for column, force in ((place, across), (place + 1, along)):
                for block, sign in ((joint, 1.0), (joint - 1, -1.0)):
                    if 0 <= block < count:
                        arm = point - centres[block]
                        balance[3 * block : 3 * block + 2, column] += sign * force
                        balance[3 * block + 2, column] += sign * (arm[0] * force[1] - arm[1] * force[0])
            for sign in (1.0, -1.0):
                row = np.zeros(variables)
                row[place], row[place + 1] = -friction, sign
                cones.append(row)
    balance[0::3, -1] = masses
    loads[1::3] = masses
    bounds = [(0, None), (None, None)] * (2 * (count + 1)) + [(None, None)]
    goal = np.zeros(variables)
    goal[-1] = -1.0
    solved = linprog(goal, np.array(cones), np.zeros(len(cones)), balance, loads, bounds)
    return float(solved.x[-1]) if solved.status == 0 else float("nan")
