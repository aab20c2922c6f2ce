"""Pieces of a drawing: dimension lines, and what acts on a structure."""

from dataclasses import dataclass, field
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike


@dataclass(frozen=True, eq=False)
class Dimension:
    """A dimension line of a structure at rest, in m, x to the right, y up.

    letter: what it is called (h₁). text: its value with unit, as it was given. line: (k, 2) from end to end, straight
    or an arc. feet: (2, 2) the points it measures, from which extension lines run to its ends.
    """

    letter: str
    text: str
    line: np.ndarray = field(repr=False)
    feet: np.ndarray = field(repr=False)


@dataclass(frozen=True, eq=False)
class Mark:
    """A load, thrust, tie or support that acts on a structure, as a drawing shows it, in m.

    kind: "load" or "thrust", an arrow along `line`, "tie", a line to its anchorage, "support", the edge of a floor that
    holds it, "leaf", the face of a leaf, or "bonder", a stone that holds leaves together. text: its value with unit.
    line: (2, 2), its second point is where it acts.
    """

    kind: Literal["load", "thrust", "tie", "support", "leaf", "bonder"]
    text: str
    line: np.ndarray = field(repr=False)


Path = tuple[np.ndarray, np.ndarray]
"""The line and the feet of a dimension."""


def plane(points: np.ndarray, mirrored: bool = False) -> np.ndarray:
    """Return complex `points` (k,) as (k, 2), or their mirror image."""
    return np.stack([-points.real if mirrored else points.real, points.imag], axis=-1)


def span(first: ArrayLike, last: ArrayLike, offset: ArrayLike = (0.0, 0.0)) -> Path:
    """Return the dimension from `first` (2,) to `last` (2,), its line moved by `offset` (2,)."""
    feet = np.array([first, last], dtype=float)
    return feet + np.asarray(offset, dtype=float), feet


def swept(centre: ArrayLike, radius: float, start: float, end: float) -> Path:
    """Return the dimension of the angle from `start` to `end` [rad], clockwise from the vertical, about `centre`."""
    angles = np.linspace(start, end, 25)
    line = np.asarray(centre, dtype=float) + radius * np.stack([np.sin(angles), np.cos(angles)], axis=1)
    return line, line[[0, -1]]


def rectangle(left: float, right: float, bottom: float, top: float) -> np.ndarray:
    """Return the corners (4,), complex, of an upright rectangle, counterclockwise."""
    return np.array([left + 1j * bottom, right + 1j * bottom, right + 1j * top, left + 1j * top])
