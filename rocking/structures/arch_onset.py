"""Where an arch hinges and at which horizontal multiplier: limit analysis by the static theorem (theory: section 5).

Inertia forces act to the right. The loads are 1 downwards and λ to the right on each radian of the ring, at
the radius of an element's centroid.

λ is the largest multiplier whose thrust line stays inside the ring. With the reaction at the left springing
u = (M₀, V, H) that is a linear programme in (u, λ), solved by exchange of the four sections where the line touches;
between joints (a continuous ring) each touching section then slides to where the line is tangent. The tests compare
it with the smallest multiplier over all four-hinge mechanisms, by virtual work.
"""

from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from rocking.errors import StructureError
from rocking.structures.arch_fill import Fill
from rocking.structures.arch_ring import CONTINUOUS_SECTIONS, EXTRADOS, INTRADOS, PATTERN, Ring

_DOWN = np.array([0.0, 0.0, 0.0, -1.0])
_ROUNDS = 100
_CLEARANCE = 1e-12
"""A gap (of order t/r) that is zero to rounding."""
_APART = 1e-6
"""Nearer than this [rad] two hinges are one section, on which the ring would slide."""


@dataclass(frozen=True, eq=False)
class Onset:
    """The mechanism at which an arch starts to rock.

    multiplier: λ. hinges: (4,) angles of A, B, C, D from the left springing, rad.
    reaction: (3,) moment about the centre, V and H at the left springing, in units of the ring (r = t·r = 1).
    """

    multiplier: float
    hinges: np.ndarray
    reaction: np.ndarray


class TooThin(StructureError):
    """No thrust line fits inside the ring, even without a horizontal load."""


class NoMechanism(StructureError):
    """No four-hinge mechanism exists: the ring would slide, or carry any horizontal load."""


def static_onset(ring: Ring) -> Onset:
    """Return the largest multiplier whose thrust line stays inside the ring, and where it touches.

    Raises TooThin when no thrust line fits, NoMechanism when no four alternating hinges limit the multiplier.
    """
    sections, contacts = np.tile(ring.sections(), 2), np.repeat([INTRADOS, EXTRADOS], ring.sections().size)
    rows = ring.gaps(sections, contacts)
    basis = _first_basis(rows)
    for _ in range(_ROUNDS):
        basis, unknowns = _exchange(rows, basis)
        basis = basis[np.argsort(sections[basis])]
        hinges = sections[basis]
        if not np.array_equal(contacts[basis], PATTERN):
            raise NoMechanism
        if ring.voussoirs is None:
            hinges, unknowns = _slide_to_tangency(ring, hinges)
        if np.any(np.diff(hinges) < _APART):
            raise NoMechanism
        if ring.voussoirs is not None or (rows @ unknowns).min() > -_CLEARANCE:
            break
        basis = sections.size + np.arange(4)
        sections, contacts = np.append(sections, hinges), np.append(contacts, PATTERN)
        rows = ring.gaps(sections, contacts)
    if not unknowns[3] > 0:
        raise TooThin
    return Onset(float(unknowns[3]), hinges + ring.embrace_angle / 2, unknowns[:3])


def _first_basis(rows: np.ndarray) -> np.ndarray:
    """Four rows that limit λ at all: hinges I, E, I, E on a coarse choice of sections."""
    count = len(rows) // 2
    last = count - 1
    tries = sorted({0, 1, 2, 3, *(round(last * share / 12) for share in range(1, 12))} & set(range(last)))
    for first in tries[: len(tries) // 2 + 1]:
        for second, third in combinations([k for k in reversed(tries) if k > first], 2):
            basis = np.array([first, count + third, second, count + last])
            if _multipliers(rows, basis).min() >= 0:
                return basis
    raise NoMechanism


def _multipliers(rows: np.ndarray, basis: np.ndarray) -> np.ndarray:
    """Lagrange multipliers of four touching rows: the relative rotations of the hinges, up to a factor."""
    try:
        return np.linalg.solve(rows[basis, :4].T, _DOWN)
    except np.linalg.LinAlgError:
        return np.full(4, -np.inf)


def _touching_line(rows: np.ndarray) -> np.ndarray:
    """The thrust line that touches four contacts: (M₀, V, H, λ, 1)."""
    try:
        return np.append(np.linalg.solve(rows[:, :4], -rows[:, 4]), 1.0)
    except np.linalg.LinAlgError:
        raise NoMechanism from None


def _exchange(rows: np.ndarray, basis: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Dual simplex: let the row most violated replace one of the basis until none is. Returns (basis, unknowns)."""
    basis = basis.copy()
    for _ in range(_ROUNDS):
        touching = rows[basis]
        unknowns = _touching_line(touching)
        gaps = rows @ unknowns
        entering = int(np.argmin(gaps))
        if gaps[entering] > -_CLEARANCE or entering in basis:
            return basis, unknowns
        columns = np.stack([_DOWN, rows[entering, :4]], axis=1)
        try:
            multipliers, change = np.linalg.solve(touching[:, :4].T, columns).T
        except np.linalg.LinAlgError:
            raise NoMechanism from None
        if not (change > 0).any():
            raise TooThin
        ratios = np.where(change > 0, multipliers / np.where(change > 0, change, 1.0), np.inf)
        basis[int(np.argmin(ratios))] = entering
    raise NoMechanism


def _slide_to_tangency(ring: Ring, hinges: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Newton's method on the sections where the gap of a continuous ring is smallest. Returns (hinges, unknowns)."""
    spacing = ring.embrace_angle / (CONTINUOUS_SECTIONS - 1)
    coincident = np.diff(hinges, prepend=-np.inf) <= 0  # two on one section would be singular
    hinges = hinges + spacing / 2 * coincident
    for _ in range(_ROUNDS):
        rows = ring.gaps(hinges, PATTERN)
        if hinges[1] - hinges[0] < _APART:
            raise NoMechanism
        unknowns = _touching_line(rows)
        slope, curvature = (derivative @ unknowns for derivative in ring.gap_slopes(hinges, PATTERN))
        step = np.where(
            curvature > 0, -slope / np.where(curvature > 0, curvature, 1.0), -np.sign(slope) * spacing
        )
        moved = ring.kept(hinges + np.clip(step, -spacing, spacing))
        if np.abs(moved - hinges).max() < 1e-13:
            break
        hinges = moved
    return hinges, unknowns


def thrust_line(ring: Ring, onset: Onset, sections: np.ndarray) -> np.ndarray:
    """Return where the thrust of a static onset crosses `sections` (k,): (k,) complex points.

    From the gap at the intrados, the normal force times the distance of the thrust from it.
    """
    unknowns = np.array([*onset.reaction, onset.multiplier, 1.0])
    gap = ring.gaps(sections, np.full(sections.shape, INTRADOS)) @ unknowns
    _, vertical, horizontal = onset.reaction
    load = ring.loads(sections)[0].weight
    normal = (horizontal + onset.multiplier * load) * np.cos(sections) - (vertical - load) * np.sin(sections)
    return (ring.contact_radius(INTRADOS) + gap / normal) * 1j * np.exp(-1j * sections)


def minimum_thickness(embrace_angle: float, voussoirs: int | None = None, fill: Fill | None = None) -> float:
    """Return the smallest t/r at which the ring stands under its own weight (λ = 0), to 1e-13."""
    return _boundary(Ring(1.0, embrace_angle, voussoirs, fill), TooThin, below=True)


def maximum_thickness(embrace_angle: float, voussoirs: int | None = None, fill: Fill | None = None) -> float:
    """Return the largest t/r at which a four-hinge mechanism exists; a thicker ring slides instead, to 1e-13."""
    return _boundary(Ring(1.0, embrace_angle, voussoirs, fill), NoMechanism, below=False)


def _boundary(ring: Ring, failure: type[StructureError], below: bool) -> float:
    """Bisect the t/r at which static_onset starts (below) or stops (above) to fail in one way."""

    def fails(thickness: float) -> bool:
        try:
            static_onset(replace(ring, thickness=thickness))
        except (TooThin, NoMechanism) as reason:
            return isinstance(reason, failure)
        return False

    low, high = 0.0, 2.0
    while high - low > 1e-13:
        middle = (low + high) / 2
        low, high = (middle, high) if fails(middle) == below else (low, middle)
    return (low + high) / 2
