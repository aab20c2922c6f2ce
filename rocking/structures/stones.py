"""Stones: an arch, an arch on piers or a portal as a chain of rigid bodies between two grounds, for contact dynamics.

x to the right, z up, m. Each stone touches the one before it and the one behind it by a plane face; the chain runs from
the left ground to the right one, and the first end of every face is the one on its left, which lies outside.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from rocking.errors import StructureError
from rocking.quantities import GRAVITY, whole
from rocking.structures.stack import ROUGH, BodiesAtRest, Held

if TYPE_CHECKING:
    from scipy.optimize import OptimizeResult

MOST_VOUSSOIRS = 60
"""Voussoirs that an arch may be followed as; one of more is followed as well by these."""
VOUSSOIRS = 21
"""Voussoirs of an arch that does not say how many it has: from 13 to 40 its limit shows no trend."""
_SOFTNESS = 1e-8
"""Share by which a contact gives more than a rigid one: of many impulses in equilibrium it decides which act."""
_FALLEN = 0.6
"""Turn of a stone from which none comes back, rad."""
_SETTLED = 2e-3
"""Turn below which stones on still ground have come to rest, rad."""
_DROPPED = 0.5
"""Share of its shorter face by which a stone has dropped that has slipped out."""
_GAP = 1e-9
"""Distance between two faces that counts as none, over their length."""
_ACCURATELY = {"primal_feasibility_tolerance": 1e-10, "dual_feasibility_tolerance": 1e-10}


@dataclass(frozen=True)
class Stone:
    """One rigid body of a chain.

    corners: (4, 2) of its faces at rest, counterclockwise, m: first the face to the stone before it from the left end
    to the right one, then the face to the one behind it from the right end to the left one; its other sides
    touch nothing. mass. centre: of mass, m. inertia: about it, mass · m². Raises StructureError.
    """

    corners: tuple[tuple[float, float], ...]
    mass: float
    centre: tuple[float, float]
    inertia: float

    def __post_init__(self) -> None:
        numbers = np.array([*np.ravel(self.corners), *self.centre, self.mass, self.inertia])
        lengths = self.faces if len(self.corners) == 4 else (0.0,)
        if not np.all(np.isfinite(numbers)) or min(*lengths, self.mass, self.inertia) <= 0:
            raise StructureError(
                f"a stone has the corners {self.corners!r} m, the mass {self.mass!r}, its centre at {self.centre!r} m "
                f"and the inertia {self.inertia!r}, but must have four corners, and faces, mass and inertia above 0; "
                "correct them."
            )

    @property
    def faces(self) -> tuple[float, float]:
        """The lengths of both faces, m."""
        first, second, third, last = np.array(self.corners, dtype=float)
        return float(np.hypot(*(second - first))), float(np.hypot(*(last - third)))


@dataclass(frozen=True)
class Stones:
    """Stones on moving ground, in a chain from the left ground to the right one.

    The ground goes on to both sides of the first and of the last face, by their length.

    Parameters
    ----------
    stones : tuple of Stone
        Stones, from the left ground on.
    friction : float, default 5.0
        Friction coefficient at every joint.

    Raises
    ------
    StructureError
        For fewer than two stones, too many, or stones whose faces do not meet.

    Examples
    --------
    >>> arch = rocking.Arch(radius=10.0, thickness=1.5, embrace_angle=2.75)
    >>> len(arch.stones(voussoirs=13).stones)
    13
    """

    stones: tuple[Stone, ...]
    friction: float = ROUGH

    def __post_init__(self) -> None:
        most = MOST_VOUSSOIRS + 2
        if not 2 <= len(self.stones) <= most:
            raise StructureError(
                f"the chain has {len(self.stones)} stones, but must have 2 to {most}; join some."
            )
        if not self.friction >= 0:
            raise StructureError(
                f"friction is {self.friction!r}, but must be 0 or more; give the coefficient of the joints.",
                friction=self.friction,
            )
        for number, (one, other) in enumerate(pairwise(self.stones), start=1):
            ends = np.array(one.corners)[[3, 2]] - np.array(other.corners)[[0, 1]]
            if np.abs(ends).max() > _GAP * max(one.faces):
                raise StructureError(
                    f"stones {number} and {number + 1} of the chain are {np.abs(ends).max():.6g} m apart, but their "
                    "faces must meet; give stones that touch."
                )

    @property
    def count(self) -> int:
        """The number of bodies that move."""
        return len(self.stones)

    @property
    def held(self) -> tuple[Held, ...]:
        """Nothing acts on stones but weight, ground and their neighbours."""
        return ()

    @property
    def joints(self) -> np.ndarray:
        """Both ends of every joint (n + 1, 2, 2), from the left ground to the right one, m."""
        faces = [np.array(stone.corners)[:2] for stone in self.stones]
        return np.array([*faces, np.array(self.stones[-1].corners)[[3, 2]]])

    @property
    def at_rest(self) -> BodiesAtRest:
        """The stones between their grounds."""
        joints = self.joints
        first = _ground(joints[0], -1.0)
        last = _ground(joints[-1], 1.0)[::-1]
        corners = np.array([first, *(np.array(stone.corners) for stone in self.stones), last])
        centres = np.array(
            [first.mean(axis=0), *(np.array(stone.centre) for stone in self.stones), last.mean(axis=0)]
        )
        still = [0.0, 0.0, 0.0]
        mobility = [[1 / stone.mass, 1 / stone.mass, 1 / stone.inertia] for stone in self.stones]
        drops = [_DROPPED * min(stone.faces) for stone in self.stones]
        return BodiesAtRest(
            centres,
            corners - centres[:, None],
            np.array([still, *mobility, still]),
            drops=np.array([np.inf, *drops, np.inf]),
            softness=_SOFTNESS,
        )

    @property
    def fallen_turn(self) -> float:
        """The turn [rad] from which no stone comes back."""
        return _FALLEN

    @property
    def settled_turn(self) -> float:
        """The turn [rad] below which stones on still ground rest."""
        return _SETTLED

    @cached_property
    def resting_multiplier(self) -> float:
        """The horizontal acceleration over g at which stones at rest slide or lift, by statics with friction.

        To the side to which they do so first; 0 where they do not stand.
        """
        rows = self._rows
        found = [greatest_multiplier(rows * [1, 1, 1, sign, 1]) for sign in (1.0, -1.0)]
        if any(solution.status for solution in found):
            return 0.0
        return max(float(min(solution.x[3] for solution in found)), 0.0)

    @property
    def _rows(self) -> np.ndarray:
        """What may not be negative, for `greatest_multiplier`: moments about the ends of joints, and friction left.

        Of weight 1 in all; the unknowns before λ are force and moment with which the left ground pushes.
        """
        masses = np.array([stone.mass for stone in self.stones])
        masses = masses / masses.sum()
        joints = self.joints
        unit = np.linalg.norm(joints[0, 1] - joints[0, 0])
        origin = joints[0, 0]
        joints = (joints - origin) / unit
        places = (np.array([stone.centre for stone in self.stones]) - origin) / unit
        zero = np.zeros(1)
        weight = np.concatenate([zero, np.cumsum(masses)])
        of_x, of_z = (np.concatenate([zero, np.cumsum(masses * coordinate)]) for coordinate in places.T)
        count = weight.size
        # What pushes the stones behind each joint, per (X, Z, M, λ, 1): of the ground, and the loads up to there.
        force_x, force_z, moment = (np.zeros((count, 5)) for _ in range(3))
        force_x[:, 0] = 1.0
        force_x[:, 3] = weight
        force_z[:, 1] = 1.0
        force_z[:, 4] = -weight
        moment[:, 2] = 1.0
        moment[:, 3] = -of_z
        moment[:, 4] = -of_x
        along = joints[:, 1] - joints[:, 0]
        along = along / np.linalg.norm(along, axis=1)[:, None]
        of_end = [
            sign * (moment - end[:, :1] * force_z + end[:, 1:] * force_x)
            for sign, end in ((1.0, joints[:, 0]), (-1.0, joints[:, 1]))
        ]
        sliding = along[:, :1] * force_x + along[:, 1:] * force_z
        pressing = -along[:, 1:] * force_x + along[:, :1] * force_z
        most = self.friction * pressing
        return np.concatenate([*of_end, most - sliding, most + sliding])

    @property
    def longest_step(self) -> float:
        """The longest time step [s]: a twentieth of the time in which the smallest stone falls over, 1/p."""
        radii = [
            np.linalg.norm(np.array(stone.corners) - stone.centre, axis=1).min() for stone in self.stones
        ]
        return float(0.05 * np.sqrt(4 * min(radii) / (3 * GRAVITY)))


def _ground(face: np.ndarray, side: float) -> np.ndarray:
    """A ground three times as wide as a face (2, 2), behind it (−1) or before it (1): its corners (4, 2)."""
    along = face[1] - face[0]
    inwards = side * np.array([-along[1], along[0]])
    left = face[0] - along
    right = face[1] + along
    return np.array([left + inwards, right + inwards, right, left])


def greatest_multiplier(rows: np.ndarray) -> "OptimizeResult":
    """Return the linear programme of the largest λ for which no row is negative.

    rows: (k, 5), each times (three unknown forces, λ, 1).
    """
    from scipy.optimize import linprog  # slow to import, and needed by arches only

    goal = np.array([0.0, 0.0, 0.0, -1.0])
    return linprog(
        goal, -rows[:, :4], rows[:, 4], bounds=(None, None), method="highs-ds", options=_ACCURATELY
    )


def counted_voussoirs(number: int | None, own: int | None) -> int:
    """Return the number of voussoirs to lay; where none is given its `own`, as many as can be followed, or VOUSSOIRS.

    Raises StructureError.
    """
    if number is not None:
        return whole("voussoirs", number, 3, MOST_VOUSSOIRS)
    return VOUSSOIRS if own is None else min(own, MOST_VOUSSOIRS)


def chain(
    faces: Sequence[np.ndarray], masses: np.ndarray, centres: np.ndarray, inertias: np.ndarray
) -> Stones:
    """Return the stones between successive faces (2, 2), from left to right end; centres (n, 2)."""
    return Stones(
        tuple(
            Stone(
                tuple(map(tuple, np.array([before[0], before[1], behind[1], behind[0]]).tolist())),
                float(mass),
                tuple(centre.tolist()),
                float(inertia),
            )
            for (before, behind), mass, centre, inertia in zip(
                pairwise(faces), masses, centres, inertias, strict=True
            )
        )
    )
