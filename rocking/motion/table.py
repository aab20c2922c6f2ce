"""A Mechanism as the kernel sees it: the tables of its sides, stacked and remembered."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from weakref import WeakKeyDictionary

import numpy as np

from rocking.motion.compiled import REST_ENERGY
from rocking.motion.forcing import Forcing
from rocking.motion.nonlinear_kernel import Sides, Ties
from rocking.motion.side_table import DEGREE, SideTable, linear_side, side_table
from rocking.structures.mechanism import EquivalentBlock, Mechanism


@dataclass(frozen=True, eq=False)
class Table:
    """What the kernel takes of a mechanism, stacked over its sides (positive first; one if they mirror)."""

    sides: tuple[SideTable, ...]
    one_sided: bool
    kernel: Sides
    """What the kernel takes of them."""
    restitution: tuple[float, float]
    """η of the positive and of the negative side."""

    def kernel_of(self, forcing: Forcing) -> Sides:
        """What the kernel takes under `forcing`: its steps resolve a sine as well."""
        frequency = forcing.ground.circular_frequency
        if frequency == 0:
            return self.kernel
        return self.kernel._replace(longest_step=np.minimum(self.kernel.longest_step, 1 / frequency))

    def side(self, sign: int) -> SideTable:
        """The table of the side of this sign."""
        return self.sides[0 if sign > 0 else -1]


_REMEMBERED: WeakKeyDictionary[Mechanism, dict[bool, Table]] = WeakKeyDictionary()


def table_of(mechanism: Mechanism, vertical: bool = False) -> Table:
    """Return the table of a mechanism, remembered as long as the mechanism lives.

    vertical: for a vertical component, with which ties do not grow and fall. Ties are then kept apart from G, as they
    are where they yield or break.
    Raises MotionError when it cannot be tabulated.
    """
    apart = mechanism.remembers or (vertical and mechanism.tied)
    known = _REMEMBERED.setdefault(mechanism, {})
    if apart not in known:
        known[apart] = _stacked(
            tuple(side_table(side, apart) for side in mechanism.sides), mechanism.one_sided
        )
    return known[apart]


@lru_cache(maxsize=1024)
def linear_table(block: EquivalentBlock) -> Table:
    """Return the table of an equivalent block: exact, and without an end unless its rotation_map has one."""
    return _stacked(tuple(linear_side(each) for each in block.sides), block.one_sided)


def _stacked(sides: tuple[SideTable, ...], one_sided: bool) -> Table:
    most = max(side.pieces.shape[0] for side in sides)
    pieces, hold = np.zeros((len(sides), most, 2 * DEGREE + 2)), np.zeros((len(sides), most))
    for k, side in enumerate(sides):
        pieces[k, : side.hold.size], hold[k, : side.hold.size] = side.pieces, side.hold
    names = ("grid", "lift", "critical", "end", "reaching_speed", "longest_step", "near")
    stacked = {name: np.array([getattr(side, name) for side in sides], dtype=float) for name in names}
    stacked["rest_speed"] = stacked.pop("reaching_speed") * REST_ENERGY**0.5
    ties = stacked_ties([side.ties for side in sides], most)
    kernel = Sides(pieces=pieces, hold=hold, one_sided=one_sided, ties=ties, **stacked)
    return Table(sides, one_sided, kernel, (sides[0].restitution, sides[-1].restitution))


def stacked_ties(sides: Sequence[Ties | None], pieces: int) -> Ties | None:
    """Return the ties of one side or two with as many pieces each; a tie that one side lacks has no force there."""
    count = max((each.law.shape[1] for each in sides if each is not None), default=0)
    if not count:
        return None
    pieces_of, law = np.zeros((len(sides) * count, pieces, 24)), np.zeros((len(sides), count, 9))
    law[:, :, 2:6] = np.inf
    for k, each in enumerate(sides):
        if each is not None:
            own = each.law.shape[1]
            pieces_of[k * count : k * count + own, : each.pieces.shape[1]] = each.pieces
            law[k, :own] = each.law[0]
    return Ties(pieces_of, law)
