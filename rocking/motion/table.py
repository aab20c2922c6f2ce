"""A Mechanism as the kernel sees it: piecewise polynomials of the arc, one table per side.

The arc q = ∫ √(I(φ)/I(0)) dφ measures rotation so that the kinetic energy is I(0) q'²/2 and the term J φ'² drops out
of the equation of motion (theory: section 1; J = I'/2). For a rigid body I is constant and q = φ.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.polynomial import chebyshev

from rocking.errors import MotionError
from rocking.structures.mechanism import EquivalentBlock, Function, Mechanism, Side
from rocking.units import GRAVITY

DEGREE = 7
ACCURACY = 1e-12
"""Largest error of a table, relative to the largest magnitude of the quantity."""

_AIM = 2e-15
_MOST_PIECES = 4096
_NODES = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
_TO_POWERS = np.linalg.inv(np.vander(_NODES, increasing=True))
_ENDS = (0.0, 1e-9, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.2, 0.4)
"""Shares of the range that may be cut off its end, where a mechanism locks and its inertia has no bound."""


@dataclass(frozen=True, eq=False)
class SideTable:
    """One side: G̃ and B̃ by powers of the distance from the centre of each of m pieces over [0, end].

    pieces: (m, 16), G̃ and B̃ alternating. width and end: of a piece and of the table, in arc. lift: G̃(0), B̃(0).
    hold: (m,) smallest −G/|B| from that piece on: a smaller ground acceleration, in g, cannot bring the side back.
    """

    pieces: np.ndarray
    width: float
    end: float
    critical: float
    lift: tuple[float, float]
    hold: np.ndarray
    restitution: float
    rest_speed_scale: float
    """Speed along the arc at φ = 0 that just reaches φ_cr, rad/s."""
    pace: float
    critical_rotation: float
    rotation: Function
    """Rotation [rad] at an arc."""
    arc: Function
    """Arc at a rotation [rad]."""
    stretch: Function
    """dq/dφ at a rotation [rad]."""


@dataclass(frozen=True, eq=False)
class Table:
    """What the kernel takes of a mechanism, stacked over its sides (positive first; one if they mirror)."""

    sides: tuple[SideTable, ...]
    one_sided: bool
    arrays: tuple[np.ndarray, ...]
    """pieces, width, lift, hold, critical, end, restitution, speed that reaches φ_cr, pace."""

    def side(self, sign: int) -> SideTable:
        """The table of the side of this sign."""
        return self.sides[0 if sign > 0 else -1]


@lru_cache(maxsize=256)
def table_of(mechanism: Mechanism) -> Table:
    """Return the table of a mechanism, remembered per object. Raises MotionError when it cannot be tabulated."""
    return _stacked(tuple(_side_table(side) for side in mechanism.sides), mechanism.one_sided)


@lru_cache(maxsize=256)
def linear_table(block: EquivalentBlock) -> Table:
    """Return the table of an equivalent block: exact, and without an end to its rotation."""
    others = () if block.other_side is None else (block.other_side,)
    return _stacked(tuple(_linear_side(each) for each in (block, *others)), block.one_sided)


def _stacked(sides: tuple[SideTable, ...], one_sided: bool) -> Table:
    most = max(side.pieces.shape[0] for side in sides)
    pieces = np.zeros((len(sides), most, 2 * DEGREE + 2))
    hold = np.zeros((len(sides), most))
    for k, side in enumerate(sides):
        count = side.pieces.shape[0]
        pieces[k, :count], hold[k, :count] = side.pieces, side.hold
        # Beyond its own last piece a side goes on as that piece does.
        for j in range(count, most):
            pieces[k, j], hold[k, j] = _moved(side.pieces[-1], (j - count + 1) * side.width), side.hold[-1]
    columns = [
        np.array([getattr(side, name) for side in sides])
        for name in ("width", "lift", "critical", "end", "restitution", "rest_speed_scale", "pace")
    ]
    width, lift, critical, end, restitution, speed, pace = columns
    return Table(sides, one_sided, (pieces, width, lift, hold, critical, end, restitution, speed, pace))


def _moved(piece: np.ndarray, distance: float) -> np.ndarray:
    moved = np.empty_like(piece)
    for odd in range(2):
        polynomial = np.polynomial.Polynomial(piece[odd::2])
        shifted = polynomial(np.polynomial.Polynomial([distance, 1.0])).coef
        moved[odd::2] = np.pad(shifted, (0, DEGREE + 1 - shifted.size))
    return moved


def _linear_side(block: EquivalentBlock) -> SideTable:
    square = block.frequency_parameter**2 / GRAVITY
    critical, scale = block.critical_rotation, block.acceleration_scale
    width, count = critical / 8, 512
    centres = (np.arange(count) + 0.5) * width
    pieces = np.zeros((count, 2 * DEGREE + 2))
    pieces[:, 0], pieces[:, 2], pieces[:, 1] = square * (critical - centres), -square, square * scale
    return SideTable(
        pieces=pieces,
        width=width,
        end=np.inf,
        critical=critical,
        lift=(square * critical, square * scale),
        hold=(centres - width / 2 - critical) / scale,
        restitution=block.restitution,
        rest_speed_scale=block.frequency_parameter * critical,
        pace=1 / block.frequency_parameter,
        critical_rotation=critical,
        rotation=np.asarray,
        arc=np.asarray,
        stretch=np.ones_like,
    )


def _side_table(side: Side) -> SideTable:
    for cut in _ENDS:
        last = side.end_rotation - cut * (side.end_rotation - side.critical_rotation)
        with np.errstate(all="ignore"):
            found = _tabulated(side, last)
        if found is not None:
            return found
    raise MotionError(
        f"the mechanism's functions cannot be tabulated to {ACCURACY:g} of their maximum up to a rotation of {last!r} rad; "
        "they must be smooth beyond critical_rotation."
    )


def _tabulated(side: Side, last: float) -> SideTable | None:
    """The table over rotations up to `last`, or None where it cannot reach ACCURACY."""
    rest_inertia = side.at("inertia", 0.0)

    def stretch(rotation: np.ndarray) -> np.ndarray:
        return np.sqrt(side.inertia(np.asarray(rotation, dtype=float)) / rest_inertia)

    measured = _antiderivative(stretch, last)
    if measured is None:
        return None
    arc, rotation = measured

    def functions(rotations: np.ndarray) -> np.ndarray:
        scale = np.sqrt(side.inertia(rotations) * rest_inertia)
        return np.stack([side.gravity(rotations) / scale, side.ground(rotations) / scale])

    end = float(arc(np.float64(last)))
    fitted = _fitted(lambda arcs: functions(rotation(arcs)), end)
    if fitted is None:
        return None
    pieces, width = fitted
    critical = float(arc(np.float64(side.critical_rotation)))
    slope = -side.at("gravity_slope", side.critical_rotation) / side.at("inertia", side.critical_rotation)
    lift = functions(np.zeros(1))[:, 0]
    return SideTable(
        pieces=pieces,
        width=width,
        end=end,
        critical=critical,
        lift=(float(lift[0]), float(lift[1])),
        hold=_hold(side, rotation, width, pieces.shape[0], end),
        restitution=side.restitution,
        rest_speed_scale=_reaching_speed(side, rest_inertia),
        pace=1 / np.sqrt(GRAVITY * max(slope, lift[0] / critical)),
        critical_rotation=side.critical_rotation,
        rotation=rotation,
        arc=arc,
        stretch=stretch,
    )


def _reaching_speed(side: Side, rest_inertia: float) -> float:
    """√(2 g ∫ G dφ / I(0)) from 0 to φ_cr."""
    nodes, weights = np.polynomial.legendre.leggauss(40)
    half = side.critical_rotation / 2
    return float(np.sqrt(2 * GRAVITY * half * (weights @ side.gravity(half * (nodes + 1))) / rest_inertia))


def _hold(side: Side, rotation: Function, width: float, count: int, end: float) -> np.ndarray:
    """(m,) smallest −G/|B| from each piece on, lowered by the largest change between neighbouring samples."""
    rotations = rotation(np.minimum(np.arange(8 * count + 1) * (width / 8), end))
    balance = -side.gravity(rotations) / np.maximum(np.abs(side.ground(rotations)), 1e-300)
    lower = np.minimum(balance[:-1], balance[1:]) - np.abs(np.diff(balance))
    each = lower.reshape(count, 8).min(axis=1)
    return np.minimum.accumulate(each[::-1])[::-1]


def _antiderivative(stretch: Function, last: float) -> tuple[Function, Function] | None:
    """The arc as a function of rotation, and its inverse, from Chebyshev pieces of dq/dφ."""
    order = 15
    nodes = chebyshev.chebpts1(order + 1)
    count = 8
    while True:
        half = last / count / 2
        centres = (2 * np.arange(count) + 1) * half
        values = stretch(centres[:, None] + half * nodes)
        if not np.all(np.isfinite(values)):
            return None
        coefficients = chebyshev.chebfit(nodes, values.T, order)
        # The last two coefficients of each piece tell what a longer expansion would add.
        if np.abs(coefficients[-2:]).max() <= 4 * _AIM * np.abs(values).max():
            break
        count *= 2
        if count > _MOST_PIECES:
            return None
    integrals = chebyshev.chebint(coefficients, lbnd=-1) * half
    starts = np.concatenate([[0.0], np.cumsum(integrals.sum(axis=0))])

    def arc(rotation: np.ndarray) -> np.ndarray:
        rotation = np.asarray(rotation, dtype=float)
        piece = np.clip((rotation / (2 * half)).astype(int), 0, count - 1)
        place = (rotation - centres[piece]) / half
        return starts[piece] + _clenshaw(integrals[:, piece], place)

    def rotation_at(arcs: np.ndarray) -> np.ndarray:
        arcs = np.asarray(arcs, dtype=float)
        rotation = np.interp(arcs, starts, np.append(centres - half, last))
        for _ in range(6):
            rotation = np.clip(rotation - (arc(rotation) - arcs) / stretch(rotation), 0.0, last)
        return rotation

    return arc, rotation_at


def _clenshaw(coefficients: np.ndarray, x: np.ndarray) -> np.ndarray:
    later = latest = np.zeros_like(x)
    for c in coefficients[:0:-1]:
        later, latest = c + 2 * x * later - latest, later
    return coefficients[0] + x * later - latest


def _fitted(functions: Callable[[np.ndarray], np.ndarray], end: float) -> tuple[np.ndarray, float] | None:
    """Pieces (m, 16) and their width, with errors at most ACCURACY up to a quarter piece beyond each piece."""
    best, best_error, count = None, np.inf, 16
    probes = np.concatenate([np.linspace(-1.5, 1.5, 13), [-0.97, 0.97]])
    while count <= _MOST_PIECES:
        half = end / count / 2
        centres = (2 * np.arange(count) + 1) * half
        values = functions(centres[:, None] + half * _NODES)
        if not np.all(np.isfinite(values)):
            return None
        powers = values @ _TO_POWERS.T
        arcs = centres[:, None] + half * probes
        inside = (arcs >= 0) & (arcs <= end)
        truth = functions(np.where(inside, arcs, 0.0))
        fit = np.einsum("fmp,qp->fmq", powers, np.vander(probes, DEGREE + 1, increasing=True))
        error = np.where(inside, np.abs(fit - truth), 0.0).max(axis=(1, 2)) / np.abs(values).max(axis=(1, 2))
        if error.max() < best_error:
            best, best_error = (powers / half ** np.arange(DEGREE + 1), 2 * half), error.max()
        elif best_error <= ACCURACY:
            break  # more pieces no longer help: the functions' own rounding
        if best_error <= _AIM:
            break
        count *= 2
    if best is None or best_error > ACCURACY:
        return None
    powers, width = best
    return np.ascontiguousarray(powers.transpose(1, 2, 0).reshape(powers.shape[1], -1)), width
