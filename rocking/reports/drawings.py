"""Drawings of structures: at rest, turned, fallen; with dimension lines, loads, thrusts and ties."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon
from matplotlib.transforms import Transform

from rocking.structures import Structure
from rocking.structures.drawing import Dimension, Mark

_THIN = {"color": "0.35", "linewidth": 0.4}
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
_ARROW = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0}
_HEAD = _ARROW | _THIN | {"mutation_scale": 4}
_LOAD = _ARROW | {"color": "#009E73", "linewidth": 1.0, "mutation_scale": 7}
_TIE = "#0072B2"
_AT_REST: dict[str, Any] = {"fill": False, "edgecolor": "0.3", "linewidth": 0.5, "linestyle": "--"}
_HINGE: dict[str, Any] = {
    "color": "white",
    "markeredgecolor": "black",
    "markersize": 3,
    "markeredgewidth": 0.6,
}
_SIDES = {"load": ("center", "bottom"), "thrust": ("right", "center")}
_SEEN_ROTATION, _MOST_ROTATION = 0.12, 0.3
"""Rotation that can be seen in a small drawing, and beyond which a structure is hard to recognise, rad."""
_FALLEN, _FARTHEST = 3.0, 1.5
"""Times the critical rotation up to which a mechanism of several bodies is drawn as fallen, at most this, rad."""


def draw_structure(
    axes: Axes,
    structure: Structure,
    rotation: float = 0.0,
    *,
    look: dict[str, Any] | None = None,
    place: Transform | None = None,
) -> None:
    """Draw the parts at a signed `rotation` [rad]; displaced, also at rest (dashed) and with the hinges (circles).

    look: of the filled parts, as matplotlib.patches.Polygon takes it. place: from m to the units of the axes.
    """
    where = axes.transData if place is None else place + axes.transData
    filled = {"facecolor": "0.85", "edgecolor": "0.3", "linewidth": 0.8, "transform": where} | (look or {})
    for outline in structure.outline(rotation):
        axes.add_patch(Polygon(outline, closed=True, **filled))
    if rotation:
        for outline in structure.outline():
            axes.add_patch(Polygon(outline, closed=True, transform=where, **_AT_REST))
        axes.plot(*structure.hinges(rotation).T, "o", transform=where, **_HINGE)


def draw_dimensions(axes: Axes, dimensions: Sequence[Dimension]) -> None:
    """Draw dimension lines with their letters."""
    for each in dimensions:
        axes.plot(*each.line.T, **_THIN)  # type: ignore[arg-type]
        for end, before in ((0, 1), (-1, -2)):
            axes.annotate("", tuple(each.line[end]), tuple(each.line[before]), arrowprops=_HEAD)
            axes.plot(*np.stack([each.feet[end], each.line[end]], axis=1), **_THIN)  # type: ignore[arg-type]
        place, ha, va = _beside(each.line.T, each.feet.T)
        axes.text(place[0], place[1], f" {each.letter} ", ha=ha, va=va, zorder=4, bbox=_PAPER)


def _beside(line: np.ndarray, feet: np.ndarray) -> tuple[np.ndarray, str, str]:
    """Where the letter of a line stands, and which of its sides touches that place: outside, or left of a short one."""
    if line.shape[1] > 2:
        return line[:, line.shape[1] // 2], "center", "center"
    across, up = (line - feet).mean(axis=1)
    if across == up == 0 and line[1, 0] == line[1, 1]:
        return line[:, 0], "right", "center"
    if abs(across) > abs(up):
        return line.mean(axis=1), "left" if across > 0 else "right", "center"
    return line.mean(axis=1), "center", "center" if up == 0 else "bottom" if up > 0 else "top"


def draw_marks(axes: Axes, marks: Sequence[Mark], left: float | None = None) -> None:
    """Draw loads and thrusts as arrows, ties as lines to an anchorage.

    left: the left end of what they act on [m], for drawings with values: those of ties end there.
    """
    for mark in marks:
        tail, tip = mark.line
        if mark.kind == "tie":
            axes.plot(*mark.line.T, color=_TIE, linewidth=1.0, zorder=3)
            for place, size in zip(mark.line, (7, 5), strict=True):
                axes.plot(*place, marker="|", color=_TIE, markersize=size, markeredgewidth=1.6)
        else:
            axes.annotate("", tuple(tip), tuple(tail), arrowprops=_LOAD, zorder=5)
            axes.plot(*tail, alpha=0)  # arrows do not widen the limits of the axes
        if left is not None and mark.kind == "tie":
            text = mark.text.replace(", ", " \n") + " "
            axes.text(left, mark.line[0, 1], text, ha="right", va="bottom")
        elif left is not None:
            ha, va = _SIDES[mark.kind]
            axes.text(tail[0], tail[1], f" {mark.text} ", ha=ha, va=va)


def seen_rotation(structure: Structure) -> float:
    """Return the rotation of a drawing that shows the mechanism, rad: a share of φ_cr, more where it is small."""
    side = structure.mechanism().positive
    wished = min(max(0.6 * side.critical_rotation, _SEEN_ROTATION), _MOST_ROTATION)
    return min(wished, 0.8 * side.end_rotation)


def fallen_rotation(structure: Structure, sign: int) -> float:
    """Return the signed rotation at which a structure is drawn that fell to the side of `sign` (0 counts as 1), rad.

    A single body is drawn as it lies; one of several bodies on its way down, as far as its mechanism reaches.
    """
    mechanism = structure.mechanism()
    back = sign < 0 and not mechanism.one_sided
    side = mechanism.sides[-1 if back else 0]
    farthest = 0.98 * side.end_rotation
    if len(structure.outline()) > 1:
        farthest = min(farthest, _FALLEN * side.critical_rotation)
    return (-1 if back else 1) * min(farthest, _FARTHEST)


def round_length(length: float) -> float:
    """Return the largest of 1, 2 and 5 times a power of ten that does not exceed `length`."""
    power = 10.0 ** math.floor(math.log10(length))
    return power * max(step for step in (1, 2, 5) if step * power <= length * (1 + 1e-12))
