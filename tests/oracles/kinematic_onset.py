"""Kinematic limit analysis of an arch, the oracle of the static one: the smallest multiplier over all mechanisms.

By virtual work alone; it shares the ring's contact points and bars with the product and nothing else.
"""

from itertools import combinations

import numpy as np
from scipy.optimize import minimize

from rocking.structures.arch_mechanism import NoMechanism, Onset
from rocking.structures.arch_ring import PATTERN, Ring
from rocking.structures.linkage import cross


def kinematic_onset(ring: Ring) -> Onset:
    """Return the smallest multiplier over all admissible mechanisms with D at the right springing.

    The reaction is not a kinematic quantity and is left nan. Raises NoMechanism when no mechanism is
    admissible.
    """
    sections = ring.sections()[:: 1 if ring.voussoirs else 2]
    hinges = np.array([(*triple, sections.size - 1) for triple in combinations(range(sections.size - 1), 3)])
    hinges = sections[hinges]
    multipliers = mechanism_multiplier(ring, hinges)
    best = int(np.argmin(multipliers))
    multiplier, found = float(multipliers[best]), hinges[best]
    if not np.isfinite(multiplier):
        raise NoMechanism
    if ring.voussoirs is None:
        # Minimise over A, B and C within two sections of the first guess; inadmissible there is no barrier.
        edge, reach = ring.embrace_angle / 2, 2 * (sections[1] - sections[0])
        result = minimize(
            lambda free: _virtual_work(ring, np.append(free, edge))[0],
            found[:3],
            jac="3-point",
            method="L-BFGS-B",
            bounds=[(max(section - reach, -edge), min(section + reach, edge)) for section in found[:3]],
            options={"ftol": 1e-16, "gtol": 1e-10},
        )
        found = np.append(result.x, edge)
        multiplier = float(mechanism_multiplier(ring, found))
    return Onset(multiplier, found + ring.embrace_angle / 2, np.full(3, np.nan))


def mechanism_multiplier(ring: Ring, hinges: np.ndarray) -> np.ndarray:
    """Return λ of the mechanism with hinges A, B, C, D at sections `hinges` (..., 4): (...), inf if inadmissible."""
    multiplier, admissible = _virtual_work(ring, hinges)
    return np.where(admissible, multiplier, np.inf)


def _virtual_work(ring: Ring, hinges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """λ = Σ m v_y / Σ m v_x of the three bars for ω₁ = −1, and whether every hinge opens and the load does work."""
    points = ring.contact_points(hinges, PATTERN)
    bars = np.diff(points, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        second = cross(bars[..., 0], bars[..., 2]) / cross(bars[..., 1], bars[..., 2])
        third = cross(bars[..., 0], bars[..., 1]) / cross(bars[..., 2], bars[..., 1])
    spins = np.stack([-np.ones_like(second), second, third], axis=-1)
    masses = np.diff(hinges, axis=-1)
    moments = -ring.centroid_radius * np.diff(np.exp(-1j * hinges), axis=-1)
    pivots = points[..., [0, 1, 3]]
    hinge_speed = np.zeros_like(pivots)
    hinge_speed[..., 1] = -1j * bars[..., 0]
    speed = (1j * spins * (moments - masses * pivots) + masses * hinge_speed).sum(axis=-1)
    opening = PATTERN * np.diff(spins, axis=-1, prepend=0, append=0)
    works = speed.real != 0
    multiplier = np.where(works, speed.imag / np.where(works, speed.real, 1.0), np.inf)
    return multiplier, (opening <= 0).all(axis=-1) & (speed.real > 0)
