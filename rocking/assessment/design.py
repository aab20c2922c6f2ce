"""A deterministic design of what is not known: rank-1 lattices, the smaller ones contained in the larger."""

from functools import lru_cache

import numpy as np

SIZES = (16, 64, 256, 1024, 4096)
"""Numbers of points that a design may have; each is contained in the next."""
_GENERATOR = 1773
"""Korobov generator of the largest lattice. Modulo 64 it is 45, whose probabilities of overturning were nearest to the
truth on half of the recording sites (rocking.calibration.ensembles). Modulo 256 it is 237, one of two that were alike
there; it was taken with all sites in view, so no site is left out of that choice."""
_SHIFT = 0.25 / 64 + 0.5 / SIZES[-1]
"""Of all points, chosen with the generator; half a step of the largest lattice leaves none on a border."""


@lru_cache(maxsize=16)
def lattice(size: int, dimensions: int) -> np.ndarray:
    """Return `size` points in (0, 1), (size, dimensions), read-only; the first of them are those of a smaller lattice.

    size: one of SIZES. A point k has the coordinates k (1, g, g², …)/size modulo 1, moved by _SHIFT. Those of the
    lattice of a quarter the size come first.
    """
    largest = SIZES[-1]
    powers = [pow(_GENERATOR, power, largest) for power in range(dimensions)]
    steps = (_order(size)[:, None] * np.array(powers) * (largest // size)) % largest
    points = (steps / largest + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


def _order(size: int) -> np.ndarray:
    """The numbers below `size`, those that a quarter of the points would have before the others."""
    if size <= SIZES[0]:
        return np.arange(size)
    coarse = _order(size // 4) * 4
    return np.concatenate([coarse, np.setdiff1d(np.arange(size), coarse)])
