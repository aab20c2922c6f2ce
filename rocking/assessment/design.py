"""A deterministic design of what is not known: rank-1 lattices, the smaller ones contained in the larger."""

from functools import lru_cache

import numpy as np

SIZES = (16, 64, 256, 1024, 4096)
"""Numbers of points that a design may have; each is contained in the next."""
_GENERATOR = 1767
"""Korobov generator of the largest lattice. Modulo 64 it is 39 and modulo 256 it is 231, which did best on verdicts."""


@lru_cache(maxsize=16)
def lattice(size: int, dimensions: int) -> np.ndarray:
    """Return `size` points in (0, 1), (size, dimensions), read-only; the first of them are those of a smaller lattice.

    size: one of SIZES. A point k has the coordinates k (1, g, g², …)/size modulo 1, moved by half a step of 64 points,
    to lie amid their strata, and of the largest lattice, to lie on no border. Those of a quarter the size come first.
    """
    largest = SIZES[-1]
    powers = [pow(_GENERATOR, power, largest) for power in range(dimensions)]
    steps = (_order(size)[:, None] * np.array(powers) * (largest // size)) % largest
    points = (steps + 0.5) / largest + 0.5 / 64
    points %= 1.0
    points.setflags(write=False)
    return points


def _order(size: int) -> np.ndarray:
    """The numbers below `size`, those that a quarter of the points would have before the others."""
    if size <= SIZES[0]:
        return np.arange(size)
    coarse = _order(size // 4) * 4
    return np.concatenate([coarse, np.setdiff1d(np.arange(size), coarse)])
