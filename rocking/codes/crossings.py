"""Crossings: the levels of a design spectrum at which what mechanisms are asked reaches what they bear."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Self

import numpy as np

Demand = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""The demands (k, m) on the mechanisms at places (k,), at levels (k, m) [m/s²] of the spectrum."""

_TRIED = np.geomspace(0.1, 10.0, 401)
"""Levels over a first guess among which the first crossing is searched for: on soft soil S_S falls as a_g grows."""

_WIDER = 10.0
"""The factor by which the guess is moved where the crossing is not among them."""

_SECTIONS = 5
_SHARES = np.linspace(0.0, 1.0, 257)
"""A bracket of 1.2 % is cut into 256 parts five times, to 1e-14 of a level."""


@dataclass(frozen=True, eq=False)
class Crossings:
    """The least levels [m/s²] at which the demands on n mechanisms reach their capacities: between `low` and `high`.

    A capacity of 0 is reached at once, one of inf never. On soft soil one may be reached more than once.
    """

    demand: Demand
    capacities: np.ndarray
    low: np.ndarray = field(repr=False)
    high: np.ndarray = field(repr=False)

    @classmethod
    def of(cls, demand: Demand, capacities: np.ndarray, level: float) -> Self:
        """Return those of `capacities` (n,). level: where the search begins, m/s²."""
        low = np.where(capacities > 0, capacities, 0.0)
        high = low.copy()
        finite = np.flatnonzero((capacities > 0) & np.isfinite(capacities))
        if finite.size:
            low[finite], high[finite] = _bracketed(demand, finite, capacities[finite], level)
        return cls(demand, capacities, low, high)

    def levels(self, places: np.ndarray) -> np.ndarray:
        """Return the levels themselves [m/s²] of the mechanisms at `places` (k,): (k,)."""
        found: np.ndarray = self.high[places]
        are_between = self.high[places] > self.low[places]
        rows = places[are_between]
        low = self.low[rows]
        high = self.high[rows]
        for _ in range(_SECTIONS):
            levels = low[:, None] + (high - low)[:, None] * _SHARES
            reached = self.demand(rows, levels) >= self.capacities[rows, None]
            reached[:, 0] = False
            reached[:, -1] = True
            low, high = _first(levels, reached)
        found[are_between] = high
        return found


def _bracketed(
    demand: Demand, places: np.ndarray, capacities: np.ndarray, level: float
) -> tuple[np.ndarray, np.ndarray]:
    """Two levels of those that are tried, (k,) each, between which each capacity is reached first."""
    asked = demand(places, np.full((places.size, 1), level))[:, 0]
    guess = level * capacities / asked
    while True:
        levels = guess[:, None] * _TRIED
        reached = demand(places, levels) >= capacities[:, None]
        at_once = reached[:, 0]
        never = ~reached.any(axis=1)
        if not (at_once | never).any():
            return _first(levels, reached)
        guess = np.where(at_once, guess / _WIDER, np.where(never, guess * _WIDER, guess))


def _first(levels: np.ndarray, reached: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The last of the ascending `levels` (k, m) before the first at which it is reached, and that one: (k,) each."""
    first = reached.argmax(axis=1)
    rows = np.arange(len(levels))
    return levels[rows, first - 1], levels[rows, first]
