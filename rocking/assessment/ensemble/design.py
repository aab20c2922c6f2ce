"""A deterministic design of what is not known: rank-1 lattices, the smaller ones contained in the larger."""

from functools import lru_cache

import numpy as np

SIZES = (16, 64, 256, 1024, 4096)
"""Numbers of points that a design may have; each is contained in the next."""
_GENERATOR = (1, 182667, 469891, 377, 1723, 1677)
"""Amplitude, restitution and polarity have the first components of the vector exod2_base2_m20 of Cools, Kuo & Nuyens
(2006), Constructing embedded lattice rules for multivariate integration, SIAM J. Sci. Comput. 28, 2162-2188, published
before any record here was seen. Its next component is that of the amplitude again at 64 points, so the others,
direction, processing and vertical, follow from the same criterion for SIZES: of all numbers, one after the other, the
one whose pairs with those before it have the least worst-case error (unanchored Sobolev space, order 2), relative to
the best at each size, at the worst size. No record takes part in it, so every site is left out of the choice."""
_SHIFT = 0.5 / 64 + 0.5 / SIZES[-1]
"""Of all points: the first coordinate of the 64 that are usual stands in the middle of its strata, but for half a step
of the largest lattice, which leaves no point of it on a border."""


@lru_cache(maxsize=16)
def lattice(size: int, dimensions: int) -> np.ndarray:
    """Return `size` points in (0, 1), (size, dimensions), read-only; the first of them are those of a smaller lattice.

    size: one of SIZES. dimensions: at most 6. A point k has the coordinates k z/size modulo 1 with the generating
    vector z, moved by _SHIFT. Those of the lattice of a quarter the size come first.
    """
    generator = np.array(_GENERATOR[:dimensions]) % size
    points = (_order(size)[:, None] * generator % size / size + _SHIFT) % 1.0
    points.setflags(write=False)
    return points


def _order(size: int) -> np.ndarray:
    """The numbers below `size`, those that a quarter of the points would have before the others."""
    if size <= SIZES[0]:
        return np.arange(size)
    coarse = _order(size // 4) * 4
    return np.concatenate([coarse, np.setdiff1d(np.arange(size), coarse)])
