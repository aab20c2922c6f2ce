"""Drawings of the structures, to scale, at rest and displaced."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.reports.style import elided, new_figure, styled

_COLUMNS = 5
_DRAWN_SHARE = 0.6
"""Share of the critical rotation at which the displaced structure is drawn; magnified where that is hard to see."""
_SEEN_ROTATION = 0.12
"""Rotation that can be seen at this size, rad."""


@styled
def structure_drawings(structures: Sequence[tuple[str, object]]) -> Figure:
    """Draw each (label, structure) to its own scale: at rest in outline, displaced in grey, hinges as circles."""
    columns = min(_COLUMNS, max(len(structures), 3))
    rows = math.ceil(len(structures) / columns)
    figure = new_figure(38.0 * rows)
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for panel, (label, structure) in zip(axes, structures, strict=False):
        _draw(panel, structure)
        panel.set_title(elided(label, 22), loc="center")
    for panel in axes[len(structures) :]:
        panel.remove()
    return figure


def _draw(panel: Axes, structure) -> None:
    rotation = drawn_rotation(structure)
    for outline in structure.outline(rotation):
        panel.fill(*outline.T, facecolor="0.85", edgecolor="0.4", linewidth=0.5)
    for outline in structure.outline(0.0):
        panel.fill(*outline.T, facecolor="none", edgecolor="black", linewidth=0.7, linestyle="--")
    hinges = np.asarray(structure.hinges(rotation))
    panel.plot(hinges[:, 0], hinges[:, 1], "o", color="white", markeredgecolor="black", markersize=3.5)
    panel.set_aspect("equal", adjustable="datalim")
    panel.margins(0.08)
    panel.axis("off")
    _scale_bar(panel, structure)


def drawn_rotation(structure) -> float:
    """Return the rotation of the displaced drawing, rad: a share of φ_cr, more where that is hard to see."""
    side = structure.mechanism().positive
    return min(max(_DRAWN_SHARE * side.critical_rotation, _SEEN_ROTATION), 0.8 * side.end_rotation)


def _scale_bar(panel: Axes, structure) -> None:
    points = np.vstack(structure.outline(0.0))
    low, high = points.min(axis=0), points.max(axis=0)
    length = round_length(0.4 * float((high - low).max()))
    drop = 0.08 * float((high - low).max())
    middle = (low[0] + high[0]) / 2
    panel.plot([middle - length / 2, middle + length / 2], [low[1] - drop] * 2, color="black", linewidth=1.5)
    panel.annotate(
        f"{length:g} m",
        (middle, low[1] - drop),
        xytext=(0, -2),
        textcoords="offset points",
        ha="center",
        va="top",
    )


def round_length(length: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that does not exceed `length`."""
    power = 10.0 ** math.floor(math.log10(length))
    return power * max(step for step in (1, 2, 5) if step * power <= length * (1 + 1e-12))
