"""The equivalent block: a mechanism's motion made linear, and what that leaves out.

It is linear in the arc q = ∫ √(I(φ)/I(0)) dφ, a measure of rotation in which the kinetic energy is I(0) q'²/2.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Literal

import numpy as np
from numpy.polynomial import chebyshev, legendre

from rocking.errors import StructureError
from rocking.quantities import positive, within

Function = Callable[[np.ndarray], np.ndarray]
"""A function of the rotation φ [rad], any shape in, the same shape out."""

_ORDER = 15
_MOST_PIECES = 4096
_NODES = chebyshev.chebpts1(_ORDER + 1)
_GAUSS, _WEIGHTS = legendre.leggauss(12)
_ONE = np.ones((1, 1))
"""The series of q/φ of a rigid body."""
_SQUARED_IS_ROUNDING = 1e-9
"""Newton's method squares the error: after a relative step this small none is left."""


@dataclass(frozen=True, eq=False)
class Arc:
    """The arc of one side over the rotations [0, last].

    stretch: dq/dφ at a rotation. means: Chebyshev coefficients (16, m) of q/φ over m equal pieces of rotation, which
    keep the relative accuracy of small rotations; (1, 1) for a rigid body, whose q is φ.
    """

    stretch: Function
    last: float
    means: np.ndarray

    def at(self, rotation: np.ndarray | float) -> np.ndarray:
        """Return the arc at `rotation` [rad], any shape."""
        rotation = np.asarray(rotation, dtype=float)
        result: np.ndarray = rotation * _evaluated(self.means, rotation / self.last)
        return result

    def rotation(self, arc: np.ndarray) -> np.ndarray:
        """Return the rotation [rad] at `arc`, any shape, by Newton's method."""
        arc = np.asarray(arc, dtype=float)
        if self.means.size == 1:
            clipped: np.ndarray = np.clip(arc, 0.0, self.last)
            return clipped
        ends = np.linspace(0.0, self.last, self.means.shape[1] + 1)
        rotation = np.interp(arc, self.at(ends), ends)
        for _ in range(6):
            mean = _evaluated(self.means, rotation / self.last)
            slope = mean + rotation * _evaluated(self._rise, rotation / self.last)
            step = (rotation * mean - arc) / slope
            rotation = np.clip(rotation - step, 0.0, self.last)
            if np.all(np.abs(step) <= _SQUARED_IS_ROUNDING * rotation):
                break
        found: np.ndarray = rotation
        return found

    @cached_property
    def _rise(self) -> np.ndarray:
        """d(q/φ)/dφ, as `means`."""
        result: np.ndarray = chebyshev.chebder(self.means) * 2 * self.means.shape[1] / self.last
        return result


def arc_of(inertia: Function, last: float, accuracy: float) -> Arc | None:
    """Return the arc over the rotations [0, last], or None where it is not smooth enough for `accuracy` (relative)."""
    rest = float(inertia(np.zeros(())))

    def stretch(rotation: np.ndarray) -> np.ndarray:
        return np.sqrt(inertia(np.asarray(rotation, dtype=float)) / rest)

    series = _pieces(stretch, last, accuracy, 8)
    if series is None:
        return None
    coefficients, values = series
    if np.all(values == 1):
        return Arc(stretch, last, _ONE)
    count = coefficients.shape[1]
    integrals = chebyshev.chebint(coefficients, lbnd=-1) * (last / count / 2)
    starts = np.concatenate([[0.0], np.cumsum(integrals.sum(axis=0))[:-1]])
    rotations = (2 * np.arange(count)[:, None] + 1 + _NODES) * (last / count / 2)
    means = (starts[:, None] + chebyshev.chebval(_NODES, integrals)) / rotations
    # In the first piece by Gauss, whose relative error is no larger near rest.
    means[0] = stretch(rotations[0][:, None] * (_GAUSS + 1) / 2) @ _WEIGHTS / 2
    return Arc(stretch, last, chebyshev.chebfit(_NODES, means.T, _ORDER))


@dataclass(frozen=True, eq=False, repr=False)
class RotationMap:
    """φ as a function of the arc q over [0, end], the inverse of an Arc without its functions.

    coefficients: Chebyshev coefficients (16, m) of φ/q over m equal pieces of the arc; (1, 1) where φ is q.
    """

    coefficients: np.ndarray
    end: float

    def rotation(self, arc: np.ndarray) -> np.ndarray:
        """Return the rotation [rad] at `arc`, any shape; inf beyond the end."""
        arc = np.asarray(arc, dtype=float)
        ratio = _evaluated(self.coefficients, arc / self.end)
        return np.where(arc > self.end, np.inf, np.minimum(arc, self.end) * ratio)

    def rotation_at(self, arc: float) -> float:
        """The same of one arc, in a microsecond or two."""
        if not 0 < arc <= self.end:
            return np.inf if arc > self.end else arc
        pieces = self._pieces
        place = arc / self.end * len(pieces)
        index = min(int(place), len(pieces) - 1)
        x = 2 * (place - index) - 1
        later = 0.0
        latest = 0.0
        first, *others = pieces[index]
        for coefficient in reversed(others):
            later, latest = coefficient + 2 * x * later - latest, later
        return arc * (first + x * later - latest)

    def slope(self, arc: np.ndarray) -> np.ndarray:
        """Return dφ/dq at `arc`, any shape; that of the end beyond it."""
        arc = np.minimum(arc, self.end)
        ratio = _evaluated(self.coefficients, arc / self.end)
        slope = _evaluated(chebyshev.chebder(self.coefficients), arc / self.end)
        result: np.ndarray = ratio + arc * slope * 2 * self.coefficients.shape[1] / self.end
        return result

    def arc(self, rotation: float) -> float:
        """Return the arc at one rotation [rad], up to the end, by Newton's method."""
        arc = min(rotation, self.end)
        for _ in range(50):
            step = (self.rotation_at(arc) - rotation) / float(self.slope(np.array(arc)))
            arc = min(max(arc - step, 0.0), self.end)
            if abs(step) <= _SQUARED_IS_ROUNDING * arc:
                break
        return arc

    @cached_property
    def _pieces(self) -> list[list[float]]:
        return self.coefficients.T.tolist()  # type: ignore[no-any-return]


def rotation_map(arc: Arc, accuracy: float) -> RotationMap | None:
    """Return the inverse of an arc, or None where it is not smooth enough for `accuracy` (relative)."""
    end = float(arc.at(arc.last))
    if arc.means.size == 1:
        return RotationMap(_ONE, end)
    # It takes about as many pieces as the arc itself.
    series = _pieces(lambda arcs: arc.rotation(arcs) / arcs, end, accuracy, max(arc.means.shape[1] // 2, 1))
    return None if series is None else RotationMap(series[0], end)


def _pieces(
    function: Function, last: float, accuracy: float, count: int
) -> tuple[np.ndarray, np.ndarray] | None:
    """Chebyshev coefficients (16, m) of a function on m ≥ count pieces of [0, last], and its values at the nodes."""
    while count <= _MOST_PIECES:
        half = last / count / 2
        values = function((2 * np.arange(count)[:, None] + 1) * half + half * _NODES)
        if not np.all(np.isfinite(values)):
            return None
        coefficients = chebyshev.chebfit(_NODES, values.T, _ORDER)
        # The last two coefficients of each piece show what a longer expansion would add.
        if np.abs(coefficients[-2:]).max() <= accuracy * np.abs(values).max():
            return coefficients, values
        count *= 2
    return None


def _evaluated(coefficients: np.ndarray, share: np.ndarray) -> np.ndarray:
    """The sum of the m pieces' series (16, m) at each `share` of their interval, 0 to 1, by Clenshaw's recurrence.

    It goes row by row, as the coefficients of all places at once would fill memory.
    """
    count = coefficients.shape[1]
    place = np.clip(share * count, 0, count)
    piece = np.minimum(place.astype(int), count - 1)
    x = 2 * (place - piece) - 1
    twice = 2 * x
    later = np.zeros_like(x)
    latest = np.zeros_like(x)
    for row in coefficients[:0:-1]:
        later, latest = row[piece] + twice * later - latest, later
    result: np.ndarray = coefficients[0][piece] + x * later - latest
    return result


Scale = Literal["exact_at_rest", "linearised", "uplift", "mean"]
"""The kind of equivalent block: exact at rest, or linearised about φ_cr with a_sc, a_sc,alt = φ_cr/λ or their mean."""


@dataclass(frozen=True, kw_only=True)
class EquivalentBlock:
    """The linear rocking block, x'' = p² (x − 1 − s ü_g/(gλ)), with x = φ/φ_cr (Eq. 10) or a measure of the rotation.

    Parameters
    ----------
    frequency_parameter : float
        p, rad/s.
    critical_rotation : float
        φ_cr, rad.
    acceleration_scale : float
        a_sc = φ_cr/λ.
    restitution : float
        η of the angular velocity, in [0, 1].
    other_side : EquivalentBlock or None, optional
        The block of the negative side when the two differ; None when they mirror each other.
    one_sided : bool, default False
        Whether it rocks to the positive side only and is thrown back at φ = 0.
    rotation_map : RotationMap or None, optional
        The rotation as a function of the arc, where x is the arc over that of φ_cr (theory: section 9); None
        where x = φ/φ_cr. Whatever follows the block reads its answer back through the map, as φ/φ_cr of the
        structure.

    Examples
    --------
    >>> block = rocking.Block(2.0, 0.2).mechanism().equivalent_block()
    >>> round(block.frequency_parameter, 3)
    1.911
    """

    frequency_parameter: float
    critical_rotation: float
    acceleration_scale: float
    restitution: float
    other_side: "EquivalentBlock | None" = None
    one_sided: bool = False
    rotation_map: RotationMap | None = field(default=None, repr=False)

    def __post_init__(self) -> None:
        units = {"frequency_parameter": "rad/s", "critical_rotation": "rad", "acceleration_scale": ""}
        for name, unit in units.items():
            object.__setattr__(self, name, positive(StructureError, name, getattr(self, name), unit))
        object.__setattr__(
            self, "restitution", within(StructureError, "restitution", self.restitution, low=0, high=1)
        )
        if self.other_side is not None and (self.one_sided or self.other_side.other_side is not None):
            raise StructureError(
                "other_side is given, but a one-sided block has none and another side has no further one."
            )

    @cached_property
    def uplift_multiplier(self) -> float:
        """λ of the positive side = φ_cr/a_sc, the ground acceleration in g that starts rocking (Eq. 12)."""
        return self.critical_rotation / self.acceleration_scale

    @property
    def symmetric(self) -> bool:
        """Whether both directions are alike."""
        return self.other_side is None and not self.one_sided

    @property
    def sides(self) -> "tuple[EquivalentBlock, ...]":
        """The distinct sides, positive first."""
        return (self,) if self.other_side is None else (self, self.other_side)

    @cached_property
    def critical_arc(self) -> float:
        """The arc at φ_cr, rad: what x = 1 is, and what turns x' into an angular velocity at φ = 0."""
        if self.rotation_map is None:
            return self.critical_rotation
        return self.rotation_map.arc(self.critical_rotation)

    @cached_property
    def end(self) -> float:
        """x beyond which the mechanism ends; inf where x = φ/φ_cr, which has no end."""
        return np.inf if self.rotation_map is None else self.rotation_map.end / self.critical_arc

    @cached_property
    def velocity_scale(self) -> float:
        """Angular velocity at φ = 0, rad/s, for each unit of dx/d(pt)."""
        return self.frequency_parameter * self.critical_arc

    def rotation_ratio(self, x: float) -> float:
        """Return φ/φ_cr of the positive side at one x; inf beyond the end of the mechanism."""
        if self.rotation_map is None:
            return x
        return self.rotation_map.rotation_at(x * self.critical_arc) / self.critical_rotation

    def rotation_ratios(self, x: np.ndarray) -> np.ndarray:
        """The same of many, any shape."""
        if self.rotation_map is None:
            return x
        return self.rotation_map.rotation(x * self.critical_arc) / self.critical_rotation


@dataclass(frozen=True, kw_only=True)
class BlockDefects:
    """The distance of the equation of the block exact at rest from the mechanism's, known without any ground motion.

    restoring: the largest difference between the two restoring accelerations up to φ_cr, over the one at rest. forcing:
    by how much the mechanism's response to the ground has grown at φ_cr, over that at rest; the block's stays as it is,
    so that a positive value errs on the unsafe side. Of two unlike sides, the worse (theory: section 9).
    """

    restoring: float
    forcing: float
