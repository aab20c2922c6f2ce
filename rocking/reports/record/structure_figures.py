"""Drawings of the structures, to scale, at rest and displaced."""

import math
from collections.abc import Sequence
from textwrap import wrap

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.reports.dimension_lines import draw_dimensions, draw_marks
from rocking.reports.style import TEXT_WIDTH, elided, new_figure, styled
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
_SMALL = 7.0
"""Size of the letters of dimensions and of what they measure, points."""
_SEEN_ROTATION, _MOST_ROTATION = 0.12, 0.3
"""Rotation that can be seen at this size, and beyond which a structure is hard to recognise, rad."""


@styled
def structure_drawings(structures: Sequence[tuple[str, Structure]]) -> Figure:
    """Draw each (label, structure) to its own scale: at rest dashed, displaced in grey, hinges as circles.

    Dimension lines carry letters, and below the label stands what they measure; loads, thrusts and ties are drawn.

    One panel holds them all, in millimetres of paper.
    """
    rows = math.ceil(len(structures) / _COLUMNS)
    figure = new_figure(_CELL_HEIGHT * rows, margins=(0, 0, 0, 0))
    panel = figure.subplots()
    panel.set(xlim=(0, TEXT_WIDTH), ylim=(-_CELL_HEIGHT * rows, 0))
    panel.axis("off")
    width = TEXT_WIDTH / _COLUMNS
    for place, (label, structure) in enumerate(structures):
        row, column = divmod(place, _COLUMNS)
        foot = np.array([(column + 0.5) * width, -(row + 1) * _CELL_HEIGHT + 7.0])
        _draw(panel, structure, foot)
        panel.text(foot[0], -row * _CELL_HEIGHT - 1, elided(label, 22), ha="center", va="top")
        said = (f"{each.letter} = {each.text}".replace(" ", "\u00a0") for each in structure.dimensions())
        sizes = ", ".join(said)
        lines = wrap(elided(sizes, 2 * _LINE), _LINE)[:2]
        panel.text(
            foot[0], -row * _CELL_HEIGHT - 4.5, "\n".join(lines), ha="center", va="top", fontsize=_SMALL
        )
    return figure


def _draw(panel: Axes, structure: Structure, foot: np.ndarray) -> None:
    """Draw one structure with the middle of its lower edge at `foot`, mm of paper."""
    rotation = drawn_rotation(structure)
    displaced, rest = structure.outline(rotation), structure.outline()
    dimensions, marks = structure.dimensions(), structure.marks(rotation)
    lines = [each.line for each in dimensions] + [each.line for each in marks]
    points = np.vstack([*displaced, *rest, *lines])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = min(np.array([_DRAWN_WIDTH, _DRAWN_HEIGHT]) / (high - low))
    origin = np.array([(low[0] + high[0]) / 2, low[1]])
    for outline in displaced:
        panel.fill(*_placed(outline, origin, scale, foot), facecolor="0.85", edgecolor="0.4", linewidth=0.5)
    for outline in rest:
        panel.fill(*_placed(outline, origin, scale, foot), fill=False, linewidth=0.7, linestyle="--")
    draw_dimensions(
        panel, dimensions, lambda at: _placed(at, origin, scale, foot), values=False, fontsize=_SMALL
    )
    draw_marks(panel, marks, lambda at: _placed(at, origin, scale, foot), values=False)
    hinges = _placed(structure.hinges(rotation), origin, scale, foot)
    panel.plot(*hinges, "o", color="white", markeredgecolor="black", markersize=3.5)
    _scale_bar(panel, scale, foot)


def _placed(points: np.ndarray, origin: np.ndarray, scale: float, foot: np.ndarray) -> np.ndarray:
    """Points (k, 2) in m as (2, k) in mm of paper."""
    return ((np.asarray(points) - origin) * scale + foot).T


def drawn_rotation(structure: Structure) -> float:
    """Return the rotation of the displaced drawing, rad: a share of φ_cr, more where that is hard to see."""
    side = structure.mechanism().positive
    wished = min(max(_DRAWN_SHARE * side.critical_rotation, _SEEN_ROTATION), _MOST_ROTATION)
    return min(wished, 0.8 * side.end_rotation)


def _scale_bar(panel: Axes, scale: float, foot: np.ndarray) -> None:
    length = round_length(0.5 * _DRAWN_WIDTH / scale)
    half = length * scale / 2
    panel.plot([foot[0] - half, foot[0] + half], [foot[1] - 2] * 2, color="black", linewidth=1.5)
    panel.text(foot[0], foot[1] - 2.7, f"{length:g} m", ha="center", va="top")


def round_length(length: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that does not exceed `length`."""
    power = 10.0 ** math.floor(math.log10(length))
    return power * max(step for step in (1, 2, 5) if step * power <= length * (1 + 1e-12))
