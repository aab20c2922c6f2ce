"""Dimension lines, loads, thrusts and ties on the drawing of a structure, with any pen."""

from collections.abc import Callable, Sequence
from typing import Literal, Protocol

import numpy as np

from rocking.structures.drawing import Dimension, Mark

Placed = Callable[[np.ndarray], np.ndarray]
"""From points (k, 2) in m to (2, k) where the pen draws, with y upwards."""
Across = Literal["left", "middle", "right"]
Along = Literal["bottom", "middle", "top"]


class Pen(Protocol):
    """What lines and letters are drawn with; places are (2,), lines (2, k)."""

    def thin(self, line: np.ndarray) -> None:
        """Draw a line of a dimension."""

    def head(self, tip: np.ndarray, before: np.ndarray) -> None:
        """Draw the head of a dimension line that comes from `before`."""

    def arrow(self, tail: np.ndarray, tip: np.ndarray) -> None:
        """Draw a load or a thrust."""

    def tie(self, ends: np.ndarray) -> None:
        """Draw a tie (2, 2) with the plate of its anchorage at the first end."""

    def letters(self, place: np.ndarray, text: str, across: Across, along: Along, paper: bool) -> None:
        """Write a text. across, along: which part of it stands at `place`. paper: white behind it."""


def draw_dimensions(pen: Pen, dimensions: Sequence[Dimension], placed: Placed, values: bool = True) -> None:
    """Draw dimension lines with their letters, and with `values` also what they measure."""
    for dimension in dimensions:
        line, feet = placed(dimension.line), placed(dimension.feet)
        pen.thin(line)
        for end, before in ((0, 1), (-1, -2)):
            pen.head(line[:, end], line[:, before])
        for end in (0, -1):
            pen.thin(np.stack([feet[:, end], line[:, end]], axis=1))
        text = f"{dimension.letter} = {dimension.text}" if values else dimension.letter
        pen.letters(*_beside(line, feet, f" {text} "), paper=True)


def draw_marks(pen: Pen, marks: Sequence[Mark], placed: Placed, beside: float | None = None) -> None:
    """Draw loads and thrusts as arrows, ties as lines to an anchorage.

    beside: the left end of what they act on [m], for drawings with values: those of ties end there.
    """
    sides: dict[str, tuple[Across, Along]] = {"load": ("middle", "bottom"), "thrust": ("right", "middle")}
    for mark in marks:
        ends = placed(mark.line)
        if mark.kind == "tie":
            pen.tie(ends)
        else:
            pen.arrow(*ends.T)
        if beside is not None and mark.kind == "tie":
            end = placed(np.array([[beside, mark.line[0, 1]]]))[:, 0]
            pen.letters(end, mark.text.replace(", ", " \n") + " ", "right", "bottom", paper=False)
        elif beside is not None:
            pen.letters(ends[:, 0], f" {mark.text} ", *sides[mark.kind], paper=False)


def _beside(line: np.ndarray, feet: np.ndarray, text: str) -> tuple[np.ndarray, str, Across, Along]:
    """Where the text of a line stands, and which of its sides touches that place: outside, or left of a short one."""
    if line.shape[1] > 2:
        return line[:, line.shape[1] // 2], text, "middle", "middle"
    across, up = (line - feet).mean(axis=1)
    if across == up == 0 and line[1, 0] == line[1, 1]:
        return line[:, 0], text, "right", "middle"
    if abs(across) > abs(up):
        return line.mean(axis=1), text, "left" if across > 0 else "right", "middle"
    return line.mean(axis=1), text, "middle", "middle" if up == 0 else "bottom" if up > 0 else "top"
