"""Dimension lines, loads, thrusts and ties on the drawing of a structure, on any axes."""

from collections.abc import Callable, Sequence

import numpy as np
from matplotlib.axes import Axes

from rocking.structures.drawing import Dimension, Mark

Placed = Callable[[np.ndarray], np.ndarray]
"""From points (k, 2) in m to (2, k) on the axes."""

_THIN = {"color": "0.35", "linewidth": 0.4}
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
_HEAD = {
    "arrowstyle": "-|>",
    "color": "0.35",
    "linewidth": 0.4,
    "mutation_scale": 4,
    "shrinkA": 0,
    "shrinkB": 0,
}
_LOAD = {
    "arrowstyle": "-|>",
    "color": "C3",
    "linewidth": 1.0,
    "mutation_scale": 7,
    "shrinkA": 0,
    "shrinkB": 0,
}


def draw_dimensions(
    axes: Axes,
    dimensions: Sequence[Dimension],
    placed: Placed,
    values: bool = True,
    fontsize: float | None = None,
) -> None:
    """Draw dimension lines with their letters, and with `values` also what they measure."""
    for dimension in dimensions:
        line, feet = placed(dimension.line), placed(dimension.feet)
        axes.plot(*line, **_THIN)  # type: ignore[arg-type]
        for end, before in ((0, 1), (-1, -2)):
            axes.annotate("", tuple(line[:, end]), tuple(line[:, before]), arrowprops=_HEAD)
        for end in (0, -1):
            axes.plot(*np.stack([feet[:, end], line[:, end]], axis=1), **_THIN)  # type: ignore[arg-type]
        text = f"{dimension.letter} = {dimension.text}" if values else dimension.letter
        place, ha, va = _beside(line, feet)
        axes.text(place[0], place[1], f" {text} ", fontsize=fontsize, bbox=_PAPER, zorder=4, ha=ha, va=va)


def draw_marks(axes: Axes, marks: Sequence[Mark], placed: Placed, values: bool = True) -> None:
    """Draw loads and thrusts as arrows, ties as lines to an anchorage."""
    for mark in marks:
        tail, head = placed(mark.line).T
        if mark.kind == "tie":
            axes.plot(*np.stack([tail, head], axis=1), color="C0", linewidth=1.0, zorder=3)
            axes.plot(*tail, marker="|", color="C0", markersize=7, markeredgewidth=1.6)
            axes.plot(*head, marker="|", color="C0", markersize=5, markeredgewidth=1.6)
        else:
            axes.annotate("", tuple(head), tuple(tail), arrowprops=_LOAD, zorder=5)
            axes.plot(*tail, alpha=0)  # arrows do not widen the limits of the axes
        if values:
            ha, va = {"load": ("center", "bottom"), "thrust": ("right", "center"), "tie": ("left", "bottom")}[
                mark.kind
            ]
            axes.text(tail[0], tail[1], f" {mark.text} ", ha=ha, va=va)


def _beside(line: np.ndarray, feet: np.ndarray) -> tuple[np.ndarray, str, str]:
    """Where the text of a line stands, and which of its sides touches that place: outside, or left of a short one."""
    if line.shape[1] > 2:
        return line[:, line.shape[1] // 2], "center", "center"
    across, up = (line - feet).mean(axis=1)
    if across == up == 0 and line[1, 0] == line[1, 1]:
        return line[:, 0], "right", "center"
    if abs(across) > abs(up):
        return line.mean(axis=1), "left" if across > 0 else "right", "center"
    return line.mean(axis=1), "center", "center" if up == 0 else "bottom" if up > 0 else "top"
