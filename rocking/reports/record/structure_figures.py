"""Drawings of the structures, to scale, at rest and displaced."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap

import numpy as np

from rocking.reports.dimension_lines import Across, Along, draw_dimensions, draw_marks
from rocking.reports.paper.canvas import SMALL, TEXT_WIDTH, Canvas
from rocking.reports.paper.letters import elided
from rocking.structures.structure import Structure

_COLUMNS = 5
_CELL_HEIGHT = 43.0
"""Height of one drawing with its title and its scale bar, mm."""
_DRAWN_WIDTH, _DRAWN_HEIGHT = 29.0, 23.5
"""Room for the structure itself, mm."""
_DRAWN_SHARE = 0.6
"""Share of the critical rotation at which the displaced structure is drawn; more where that is hard to see."""
_LINE = 25
"""Characters of a line below a label."""
_SEEN_ROTATION, _MOST_ROTATION = 0.12, 0.3
"""Rotation that can be seen at this size, and beyond which a structure is hard to recognise, rad."""
_THIN, _LOAD, _TIE = "#595959", "#009E73", "#0072B2"


@dataclass(frozen=True)
class _Paper:
    """The pen of dimension lines and marks on paper; places are in mm, y upwards from the upper edge."""

    canvas: Canvas

    def line(self, line: np.ndarray, colour: str, width: float) -> None:
        self.canvas.path(_down(line), colour, width)

    def thin(self, line: np.ndarray) -> None:
        self.line(line, _THIN, 0.4)

    def head(self, tip: np.ndarray, before: np.ndarray) -> None:
        self._head(tip, before, 1.2, _THIN)

    def arrow(self, tail: np.ndarray, tip: np.ndarray) -> None:
        self.line(np.stack([tail, tip], axis=1), _LOAD, 1.0)
        self._head(tip, tail, 2.2, _LOAD)

    def tie(self, ends: np.ndarray) -> None:
        self.line(ends, _TIE, 1.0)
        for place, half in zip(ends.T, (1.2, 0.9), strict=True):
            up = np.array([0, half])
            self.line(np.stack([place - up, place + up], axis=1), _TIE, 1.6)

    def letters(self, place: np.ndarray, text: str, across: Across, along: Along, paper: bool) -> None:
        air = 0.5 * np.array([{"left": 1, "middle": 0, "right": -1}[across], 0])
        self.canvas.text(
            _down((place + air)[:, np.newaxis])[0], text.strip(), SMALL, across, along, paper=paper
        )

    def _head(self, tip: np.ndarray, before: np.ndarray, length: float, colour: str) -> None:
        along = (before - tip) / max(float(np.hypot(*(before - tip))), 1e-12) * length
        side = 0.3 * np.array([-along[1], along[0]])
        self.canvas.areas([_down(np.stack([tip, tip + along + side, tip + along - side], axis=1))], colour)


def structure_drawings(structures: Sequence[tuple[str, Structure]]) -> Canvas:
    """Draw each (label, structure) to its own scale: at rest dashed, displaced in grey, hinges as circles.

    Dimension lines carry letters, and below the label stands what they measure; loads, thrusts and ties are drawn.
    """
    columns = min(_COLUMNS, len(structures))
    rows = math.ceil(len(structures) / columns)
    canvas = Canvas(TEXT_WIDTH, _CELL_HEIGHT * rows)
    width = TEXT_WIDTH / columns
    for place, (label, structure) in enumerate(structures):
        row, column = divmod(place, columns)
        middle, top = (column + 0.5) * width, row * _CELL_HEIGHT
        _draw(canvas, structure, np.array([middle, -top - _CELL_HEIGHT + 7.0]))
        canvas.text((middle, top + 1), elided(label, 22), across="middle", along="top")
        said = (f"{each.letter} = {each.text}".replace(" ", "\u00a0") for each in structure.dimensions())
        lines = wrap(elided(", ".join(said), 2 * _LINE), _LINE)[:2]
        for line, text in enumerate(lines):
            canvas.text((middle, top + 4.5 + 3.0 * line), text, SMALL, "middle", "top")
    return canvas


def _draw(canvas: Canvas, structure: Structure, foot: np.ndarray) -> None:
    """Draw one structure with the middle of its lower edge at `foot`, mm of paper, y upwards."""
    rotation = drawn_rotation(structure)
    displaced, rest = structure.outline(rotation), structure.outline()
    dimensions, marks = structure.dimensions(), structure.marks(rotation)
    lines = [each.line for each in dimensions] + [each.line for each in marks]
    points = np.vstack([*displaced, *rest, *lines])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = min(np.array([_DRAWN_WIDTH, _DRAWN_HEIGHT]) / (high - low))
    origin = np.array([(low[0] + high[0]) / 2, low[1]])

    def placed(at: np.ndarray) -> np.ndarray:
        return ((np.asarray(at) - origin) * scale + foot).T

    for outline in displaced:
        canvas.path(_down(placed(outline)), "#666666", 0.5, fill="#d9d9d9", closed=True)
    for outline in rest:
        canvas.path(_down(placed(outline)), "black", 0.7, "dashed", closed=True)
    pen = _Paper(canvas)
    draw_dimensions(pen, dimensions, placed, values=False)
    draw_marks(pen, marks, placed)
    for hinge in _down(placed(structure.hinges(rotation))):
        canvas.circle(hinge, 0.6, "black")
    _scale_bar(canvas, scale, foot)


def _down(line: np.ndarray) -> np.ndarray:
    """From (2, k) with y upwards to the (k, 2) of a canvas."""
    return (line * np.array([[1.0], [-1.0]])).T


def drawn_rotation(structure: Structure) -> float:
    """Return the rotation of the displaced drawing, rad: a share of φ_cr, more where that is hard to see."""
    side = structure.mechanism().positive
    wished = min(max(_DRAWN_SHARE * side.critical_rotation, _SEEN_ROTATION), _MOST_ROTATION)
    return min(wished, 0.8 * side.end_rotation)


def _scale_bar(canvas: Canvas, scale: float, foot: np.ndarray) -> None:
    length = round_length(0.5 * _DRAWN_WIDTH / scale)
    half, height = length * scale / 2, -foot[1] + 2
    canvas.path(np.array([[foot[0] - half, height], [foot[0] + half, height]]), "black", 1.5)
    canvas.text((foot[0], height + 0.7), f"{length:g} m", SMALL, "middle", "top")


def round_length(length: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that does not exceed `length`."""
    power = 10.0 ** math.floor(math.log10(length))
    return power * max(step for step in (1, 2, 5) if step * power <= length * (1 + 1e-12))
