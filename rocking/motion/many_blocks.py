"""Many equivalent blocks under one record, exactly, in one compiled call."""

from collections.abc import Callable, Sequence
from typing import TypeGuard

import numpy as np

from rocking.motion import linear_kernel as kernel
from rocking.motion.forcing import Forcing
from rocking.motion.linear import solvable_exactly
from rocking.quantities import GRAVITY
from rocking.structures import EquivalentBlock


def all_solvable(structures: Sequence[object], forcing: Forcing) -> TypeGuard[Sequence[EquivalentBlock]]:
    """Whether `follow_blocks` takes them: equivalent blocks that rock to both sides, each with a closed form."""
    return all(
        isinstance(each, EquivalentBlock) and not each.one_sided and solvable_exactly(each, forcing)
        for each in structures
    )


def follow_blocks(blocks: Sequence[EquivalentBlock], forcing: Forcing) -> np.ndarray:
    """Return φ_max/φ_cr, (m,), of every block; inf overturns, 0 does not lift, nan: too many impacts."""
    status, peaks = np.zeros(len(blocks), dtype=np.int64), np.zeros((len(blocks), 2))
    kernel.rock_linear_blocks(
        _by_side(blocks, lambda side: side.frequency_parameter),
        _by_side(blocks, lambda side: 1 / (GRAVITY * side.uplift_multiplier)),
        _by_side(blocks, lambda side: side.critical_arc),
        _by_side(blocks, lambda side: side.restitution),
        forcing.ground.horizontal * forcing.factor,
        forcing.ground.time_step,
        status,
        peaks,
    )
    for peak, block in zip(peaks, blocks, strict=True):
        peak[:] = [side.rotation_ratio(x) for side, x in zip(_both(block), peak.tolist(), strict=True)]
    ratios = peaks.max(axis=1)
    ratios[status == kernel.OVERTURNS] = np.inf
    ratios[status > kernel.OVERTURNS] = np.nan
    return ratios


def _by_side(blocks: Sequence[EquivalentBlock], read: Callable[[EquivalentBlock], float]) -> np.ndarray:
    """(m, 2), the positive side first."""
    rows = [[read(side) for side in _both(block)] for block in blocks]
    return np.array(rows, dtype=float).reshape(-1, 2)


def _both(block: EquivalentBlock) -> tuple[EquivalentBlock, EquivalentBlock]:
    return block.sides[0], block.sides[-1]
