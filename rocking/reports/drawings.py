"""Drawings of structures: at rest, turned, fallen; with dimension lines, loads, thrusts and ties; and of records.

What every report has is drawn by hand as shapes of SVG: matplotlib takes half a second to import and 25 ms for the
least of figures.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rocking.reports.pages import Picture
from rocking.reports.style import PULSE
from rocking.signal.measures import record_measures
from rocking.structures import Structure
from rocking.structures.drawing import Mark, plane, rectangle
from rocking.structures.tied import Tied

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from rocking.pulses import Pulse
    from rocking.signal.accelerogram import Accelerogram


class Line(NamedTuple):
    """How a line is drawn: as SVG, and by matplotlib."""

    by_hand: str
    on_axes: dict[str, Any]


_THIN = {"color": "0.35", "linewidth": 0.4}
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.4}
_ARROW = {"arrowstyle": "-|>", "shrinkA": 0, "shrinkB": 0}
_HEAD = _ARROW | _THIN | {"mutation_scale": 4}
_GREEN = "#009E73"
_LOAD = _ARROW | {"color": _GREEN, "linewidth": 1.0, "mutation_scale": 7}
_TIE = "#0072B2"
_AT_REST: dict[str, Any] = {"fill": False, "edgecolor": "0.3", "linewidth": 0.5, "linestyle": "--"}
_HINGE: dict[str, Any] = {
    "color": "white",
    "markeredgecolor": "black",
    "markersize": 3,
    "markeredgewidth": 0.6,
}
_SUPPORT: dict[str, Any] = {"color": "0.45", "linewidth": 2.2, "solid_capstyle": "butt", "zorder": 3}
_LEAVES = {
    "leaf": Line('stroke="#4d4d4d" stroke-width="0.18"', {"color": "0.3", "linewidth": 0.6, "zorder": 2}),
    "bonder": Line(
        'stroke="#595959" stroke-width="0.78"',
        {"color": "0.35", "linewidth": 2.2, "solid_capstyle": "butt", "zorder": 2},
    ),
}
"""The faces between leaves, and the stones that hold these together."""
_BESIDE = Line(
    'fill="#f4f4f4" stroke="#b3b3b3" stroke-width="0.12"',
    {"facecolor": "0.96", "edgecolor": "0.7", "linewidth": 0.5, "zorder": 0.5},
)
"""The rest of a wall of which a leaf falls alone."""
_FRONT: dict[str, Any] = {"fill": False, "edgecolor": "0.3", "linewidth": 0.6}
_FALLS: dict[str, Any] = {"facecolor": "0.85", "edgecolor": "0.3", "linewidth": 0.8}
"""The front of a wall, and what of it falls between two ties."""
_SIDES = {"load": ("center", "bottom"), "thrust": ("right", "center")}
"""The side of its value that touches the end of an arrow, horizontally and vertically."""
_FALLEN = 3.0
"""Times the critical rotation up to which a mechanism of several bodies is drawn as fallen."""
_FARTHEST = 1.5
"""Rotation at which it is drawn at most, rad."""


MOST_POINTS = 4000
"""Points of a trace; a longer one keeps the least and the largest value of each stretch."""
_BESIDE_SHAKING = 0.15
"""Share of the strong shaking that is drawn before and after it."""


# By hand --------------------------------------------------------------------------------------------------


def drawn_by_hand(shapes: Sequence[str], width: float, height: float, alt: str) -> Picture:
    """Return a picture of shapes of SVG in mm, as the templates take it."""
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{width:g}mm" height="{height:g}mm"'
    return Picture(svg=f'{head} viewBox="0 0 {width:g} {height:g}">{"".join(shapes)}</svg>', alt=alt)


def svg_path(points: np.ndarray, height: float, look: str, closed: bool = False) -> str:
    """Return a line through points (k, 2) in mm from the lower left corner of a picture of that height, as SVG."""
    places = " ".join(
        f"{x:.3f},{y:.3f}" for x, y in np.column_stack([points[:, 0], height - points[:, 1]]).tolist()
    )
    return f'<poly{"gon" if closed else "line"} points="{places}" {look}/>'


def sine_lines(points: np.ndarray, height: float, width: float = 0.5) -> list[str]:
    """Return a sine through points (k, 2) over a record, as `svg_path` takes them: on white, to be seen in grey too."""
    looks = (("white", 2.6 * width), (PULSE, width))
    return [
        svg_path(points, height, f'fill="none" stroke="{ink}" stroke-width="{size:g}"') for ink, size in looks
    ]


@dataclass(frozen=True, eq=False)
class Trace:
    """One component of the ground with its ranked pulses, the dominant one first."""

    accelerogram: Accelerogram
    pulses: Sequence[Pulse]

    @cached_property
    def span(self) -> tuple[float, float]:
        """The time of 5 to 95 % of the Arias intensity with a margin, and of the dominant pulse, s."""
        begin, end = record_measures(self.accelerogram).significant_times
        for pulse in self.pulses[:1]:
            begin = min(begin, pulse.start_time)
            end = max(end, pulse.end_time)
        if not end > begin:  # nothing shakes
            return 0.0, self.accelerogram.duration
        margin = _BESIDE_SHAKING * (end - begin)
        return max(0.0, begin - margin), min(self.accelerogram.duration, end + margin)


def thinned(times: np.ndarray, values: np.ndarray, most: int = MOST_POINTS) -> tuple[np.ndarray, np.ndarray]:
    """Return the envelope of a trace in at most `most` points: least and largest value of each stretch, in order.

    No peak is lost, or moved by more than a stretch; a trace of few samples stays as it is.
    """
    size = values.size
    if size <= most:
        return times, values
    stretch = math.ceil(2 * size / most)
    padded = np.pad(values, (0, -size % stretch), mode="edge").reshape(-1, stretch)
    begins = np.arange(len(padded)) * stretch
    places = np.unique(np.concatenate([begins + padded.argmin(axis=1), begins + padded.argmax(axis=1)]))
    places = places[places < size]
    return times[places], values[places]


def room(
    structure: Structure, rotation: float, width: float, height: float, rest: Sequence[np.ndarray] = ()
) -> tuple[float, np.ndarray]:
    """Return the scale [mm/m] at which `sketch` fills a picture of that size in mm, and the middle (2,), m, of it."""
    every = np.vstack([*structure.outline(rotation), *structure.outline(), *rest])
    bottom, top = every.min(axis=0), every.max(axis=0)
    scale = min((np.array([width, height]) - 1.3) / (top - bottom))  # circles stand over the edges
    return float(scale), (bottom + top) / 2


def sketch(
    structure: Structure,
    rotation: float,
    width: float,
    height: float,
    scale: float = 0.0,
    rest: Sequence[np.ndarray] = (),
) -> list[str]:
    """Return a structure at a signed `rotation` [rad] and dashed at rest, as shapes of SVG that fill a picture in mm.

    With its hinges (circles), loads (arrows), ties and supports (lines), as `draw_structure` draws them. scale: mm/m;
    0: that at which it fills the picture. rest: the others of the wall of which it is a leaf, drawn lightly.
    """
    largest, middle = room(structure, rotation, width, height, rest)
    scale = scale or largest
    filled = 'fill="#c7c7c7" stroke="#595959" stroke-width="0.18"'
    dashed = 'fill="none" stroke="#4d4d4d" stroke-width="0.18" stroke-dasharray="0.65 0.28"'
    circled = 'fill="white" stroke="black" stroke-width="0.21"'
    around = np.array([[np.cos(turn), np.sin(turn)] for turn in np.linspace(0, 2 * np.pi, 13)])

    areas = [(shape, _BESIDE.by_hand) for shape in rest]
    areas += [(part, filled) for part in structure.outline(rotation)]
    areas += [(part, dashed) for part in structure.outline()]
    areas += [(hinge + 0.53 / scale * around, circled) for hinge in structure.hinges(rotation)]
    paths = [(points, look, True) for points, look in areas]
    for mark in structure.marks(rotation):
        tail, tip = mark.line
        if mark.kind == "support":
            paths.append((mark.line, 'stroke="#737373" stroke-width="0.78"', False))
        elif mark.kind in _LEAVES:
            paths.append((mark.line, _LEAVES[mark.kind].by_hand, False))
        elif mark.kind == "tie":
            paths.append((mark.line, f'stroke="{_TIE}" stroke-width="0.35"', False))
            for end, size in zip(mark.line, (2.4, 1.8), strict=True):
                plate = end + np.array([[0.0, -size / 2], [0.0, size / 2]]) / scale
                paths.append((plate, f'stroke="{_TIE}" stroke-width="0.56"', False))
        elif (length := float(np.hypot(*(tip - tail)))) > 0:
            back = (tail - tip) / length * 1.2 / scale
            aside = 0.35 * np.array([-back[1], back[0]])
            head = np.stack([tip, tip + back + aside, tip + back - aside])
            paths.append((mark.line, f'stroke="{_GREEN}" stroke-width="0.35"', False))
            paths.append((head, f'fill="{_GREEN}"', True))

    centre = np.array([width, height]) / 2
    return [
        svg_path((points - middle) * scale + centre, height, f'{look} stroke-linejoin="round"', closed)
        for points, look, closed in paths
    ]


# On axes --------------------------------------------------------------------------------------------------


def draw_structure(
    axes: Axes,
    structure: Structure,
    rotation: float = 0.0,
    *,
    values: bool = False,
    rest: Sequence[np.ndarray] = (),
) -> None:
    """Draw the parts at a signed `rotation` [rad], and the loads, thrusts (arrows) and ties (lines) that act on them.

    Displaced, it is drawn also at rest (dashed), and with the hinges (circles). values: write the value of each load
    and tie next to it. rest: the others of the wall of which it is a leaf, drawn lightly.
    """
    from matplotlib.patches import Polygon

    parts = structure.outline(rotation)
    at_rest = structure.outline() if rotation else []
    for outline in rest:
        axes.add_patch(Polygon(outline, closed=True, **_BESIDE.on_axes))
    for outline in parts:
        axes.add_patch(Polygon(outline, closed=True, facecolor="0.85", edgecolor="0.3", linewidth=0.8))
    for outline in at_rest:
        axes.add_patch(Polygon(outline, closed=True, **_AT_REST))
    if rotation:
        axes.plot(*structure.hinges(rotation).T, "o", **_HINGE)
    left = min(float(part[:, 0].min()) for part in (*parts, *at_rest))
    top = max(float(part[:, 1].max()) for part in parts)
    for mark in structure.marks(rotation):
        _draw_mark(axes, mark, (left, top) if values else None)


def _draw_mark(axes: Axes, mark: Mark, corner: tuple[float, float] | None) -> None:
    """Draw a load or thrust as an arrow, a tie as a line to its anchorage, a support as the edge of a floor.

    corner: left end and top of the structure, m, next to which values stand; None draws no values.
    """
    tail, tip = mark.line
    if mark.kind == "support":
        axes.plot(*mark.line.T, **_SUPPORT)
        if corner is not None:
            axes.text(tail[0], tail[1], f" {mark.text}", ha="left", va="center")
        return
    if mark.kind in _LEAVES:
        axes.plot(*mark.line.T, **_LEAVES[mark.kind].on_axes)
        return
    if mark.kind == "tie":
        axes.plot(*mark.line.T, color=_TIE, linewidth=1.0, zorder=3)
        for end, size in zip(mark.line, (7, 5), strict=True):
            axes.plot(*end, marker="|", color=_TIE, markersize=size, markeredgewidth=1.6)
    else:
        axes.annotate("", tip, tail, arrowprops=_LOAD, zorder=5)
        axes.plot(*tail, alpha=0)  # arrows do not widen the limits of the axes
    if corner is None:
        return
    left, top = corner
    if mark.kind == "tie":
        text = mark.text.replace(", ", " \n") + " "
        # Below the line of the tie; a thrust is written above it.
        axes.annotate(text, (left, tail[1]), (0, -3), textcoords="offset points", ha="right", va="top")
    elif mark.kind == "load" and tail[1] < top:
        # Of a floor: above the arrow stands the next storey, with its thickness.
        axes.text(left, tip[1], f"{mark.text} ", ha="right", va="bottom")
    else:
        ha, va = _SIDES[mark.kind]
        axes.text(tail[0], tail[1], f" {mark.text} ", ha=ha, va=va, zorder=4, bbox=_PAPER)


def draw_dimensions(
    axes: Axes, structure: Structure, *, values: bool = False, written: Callable[[str], str] = str
) -> None:
    """Draw the front of a structure where it is known, and its dimension lines with their letters.

    values: write the value of each behind its letter, as `written` writes a number.
    """
    from matplotlib.patches import Polygon

    front = structure.described.front
    if len(front):
        axes.add_patch(Polygon(front, closed=True, **_FRONT))
    for dimension in structure.dimensions():
        axes.plot(*dimension.line.T, **_THIN)  # type: ignore[arg-type]
        for end, before in ((0, 1), (-1, -2)):
            axes.annotate("", tuple(dimension.line[end]), tuple(dimension.line[before]), arrowprops=_HEAD)
            axes.plot(*np.stack([dimension.feet[end], dimension.line[end]], axis=1), **_THIN)  # type: ignore[arg-type]
        place, ha, va = _beside(dimension.line.T, dimension.feet.T)
        text = f"{dimension.letter} = {written(dimension.text)}" if values else dimension.letter
        if values and dimension.line.shape[0] > 2:
            va = "top"  # within the arc, clear of the radius
        axes.text(place[0], place[1], f" {text} ", ha=ha, va=va, zorder=4, bbox=_PAPER)


_ASIDE = 0.5
"""Distance of the front of a bay from the section, in heights of the wall: what stands between is the dimensions."""
_BESIDE_A_BAY = 0.08
"""What is drawn of the bays beside it, in spacings."""


@dataclass(frozen=True, eq=False)
class Bay:
    """A wall between two ties of a row as it is seen from the front, next to its section, in m.

    outline: (k, 2) of the bay and a little of those beside it. falls: outlines (j, 2) of what may fall between the
    ties. ties: (m, 2) where they hold it.
    """

    outline: np.ndarray = field(repr=False)
    falls: tuple[np.ndarray, ...] = field(repr=False)
    ties: np.ndarray = field(repr=False)


def bay_of(structure: Structure) -> Bay | None:
    """Return the front between two ties of a row, of a wall that may fall there; else None."""
    if not isinstance(structure, Tied) or not structure.ties_apart or structure.tie_spacing is None:
        return None
    spacing, top = structure.tie_spacing, structure.height
    left = max(float(outline[:, 0].max()) for outline in structure.outline()) + _ASIDE * top
    ends = left + _BESIDE_A_BAY * spacing + np.array([0.0, spacing])
    right = float(ends[1]) + _BESIDE_A_BAY * spacing
    openings = [structure.opening]
    if structure.opening is None:
        openings = [candidate.opening for candidate in structure.mechanisms().of_all]
    falls = []
    for opening in openings:
        if opening is None or not opening.between:
            continue
        # Not a triangle: all of the bay above its foot, as if no tie held it.
        hold = opening.hold if opening.is_triangle and opening.hold is not None else opening.foot
        heights = [opening.foot, hold, top, top, hold]
        falls.append(np.stack([[ends.mean(), ends[1], ends[1], ends[0], ends[0]], heights], axis=1))
    if not falls:
        return None
    ties = np.array([[end, height] for end in ends for height in structure.tie_heights])
    return Bay(plane(rectangle(left, right, 0.0, top)), tuple(falls), ties)


def draw_bay(axes: Axes, bay: Bay) -> None:
    """Draw the front between two ties of a row, with what may fall there and the ties (crosses)."""
    from matplotlib.patches import Polygon

    axes.add_patch(Polygon(bay.outline, closed=True, **_FRONT))
    for outline in bay.falls:
        axes.add_patch(Polygon(outline, closed=True, **_FALLS))
    axes.plot(*bay.ties.T, "x", color=_TIE, markersize=6, markeredgewidth=1.6, zorder=3)


def _beside(line: np.ndarray, feet: np.ndarray) -> tuple[np.ndarray, str, str]:
    """The place of the letter of a line, and its side that touches the place: outside, or left of a short one."""
    if line.shape[1] > 2:
        return line[:, line.shape[1] // 2], "center", "center"
    across, up = (line - feet).mean(axis=1)
    if across == up == 0 and line[1, 0] == line[1, 1]:
        return line[:, 0], "right", "center"
    if abs(across) > abs(up):
        return line.mean(axis=1), "left" if across > 0 else "right", "center"
    return line.mean(axis=1), "center", "center" if up == 0 else "bottom" if up > 0 else "top"


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
