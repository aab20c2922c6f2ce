"""The arc q = ∫ √(I(φ)/I(0)) dφ: a measure of rotation in which the kinetic energy is I(0) q'²/2."""

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import chebyshev, legendre

from rocking.structures.mechanism import Function, Side

_ORDER = 15
_MOST_PIECES = 4096
_NODES = chebyshev.chebpts1(_ORDER + 1)
_GAUSS, _WEIGHTS = legendre.leggauss(12)
_SQUARED_IS_ROUNDING = 1e-9
"""Newton's method squares the error: after a relative step this small none is left."""


@dataclass(frozen=True, eq=False)
class Arc:
    """The arc of one side over the rotations [0, last].

    stretch: dq/dφ at a rotation. integrals: Chebyshev coefficients (16, m) of the arc over m equal pieces of rotation,
    starts: (m + 1,) the arc at their ends. rigid: dq/dφ is 1 throughout, so that q = φ.
    """

    stretch: Function
    last: float
    integrals: np.ndarray
    starts: np.ndarray
    rigid: bool

    def at(self, rotation: np.ndarray | float) -> np.ndarray:
        """Return the arc at `rotation` [rad], any shape; small rotations keep their relative accuracy."""
        rotation = np.asarray(rotation, dtype=float)
        if self.rigid:
            return rotation
        count = self.starts.size - 1
        place = np.clip(rotation / self.last * count, 0, count)
        piece = np.minimum(place.astype(int), count - 1)
        arc = self.starts[piece] + _clenshaw(self.integrals[:, piece], 2 * (place - piece) - 1)
        first = piece == 0
        if np.any(first):
            small = rotation[first]
            arc = np.array(arc)
            arc[first] = small * (self.stretch(small[..., None] * (_GAUSS + 1) / 2) @ _WEIGHTS / 2)
        return arc

    def rotation(self, arc: np.ndarray) -> np.ndarray:
        """Return the rotation [rad] at `arc`, any shape, by Newton's method."""
        arc = np.asarray(arc, dtype=float)
        if self.rigid:
            return np.clip(arc, 0.0, self.last)
        rotation = np.interp(arc, self.starts, np.linspace(0.0, self.last, self.starts.size))
        for _ in range(6):
            step = (self.at(rotation) - arc) / self.stretch(rotation)
            rotation = np.clip(rotation - step, 0.0, self.last)
            if np.all(np.abs(step) <= _SQUARED_IS_ROUNDING * rotation):
                break
        return rotation


def arc_of(side: Side, last: float, accuracy: float) -> Arc | None:
    """Return the arc of a side over [0, last], or None where dq/dφ is not smooth enough for `accuracy` (relative)."""
    rest = side.at("inertia", 0.0)

    def stretch(rotation: np.ndarray) -> np.ndarray:
        return np.sqrt(side.inertia(np.asarray(rotation, dtype=float)) / rest)

    count = 8
    while count <= _MOST_PIECES:
        half = last / count / 2
        values = stretch((2 * np.arange(count)[:, None] + 1) * half + half * _NODES)
        if not np.all(np.isfinite(values)):
            return None
        coefficients = chebyshev.chebfit(_NODES, values.T, _ORDER)
        # The last two coefficients of each piece tell what a longer expansion would add.
        if np.abs(coefficients[-2:]).max() <= accuracy * np.abs(values).max():
            integrals = chebyshev.chebint(coefficients, lbnd=-1) * half
            starts = np.concatenate([[0.0], np.cumsum(integrals.sum(axis=0))])
            return Arc(stretch, last, integrals, starts, bool(np.all(values == 1)))
        count *= 2
    return None


def _clenshaw(coefficients: np.ndarray, x: np.ndarray) -> np.ndarray:
    later = latest = np.zeros_like(x)
    for c in coefficients[:0:-1]:
        later, latest = c + 2 * x * later - latest, later
    return coefficients[0] + x * later - latest
