"""The figure of the rocking spectrum, with the structures on it."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from contourpy import ContourGenerator, FillType, LineType, contour_generator

from rocking.reports.paper.canvas import SMALL, TEXT_WIDTH, Box, Canvas, text_box
from rocking.reports.paper.labels import draw_labels, placed_labels
from rocking.reports.paper.panel import Panel
from rocking.reports.paper.scales import Scale

_LEVELS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)
"""Rotation ratios of the shades of a spectrum; the lines are those between."""
_GREYS = ("#f9f9f9", "#f3f3f3", "#ececec", "#e6e6e6", "#e0e0e0", "#dadada", "#d4d4d4", "#cecece", "#c8c8c8")
_OVERTURNED = 1.5
_MARK = 0.9
"""Radius of the mark of a structure, mm."""
_LONG = 12.0
"""Length of a line that is worth a number, mm."""

Placed = tuple[str, float, float]


def rocking_spectrum_figure(
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    ratios: np.ndarray,
    structures: Sequence[Placed],
    width: float = TEXT_WIDTH,
) -> Canvas:
    """Draw rotation ratios (m, n) over p (m,) [rad/s] and λ (n,) with structures (number, p, λ) on them."""
    canvas = Canvas(width, 54)
    axes = frequency_parameters, uplift_multipliers
    scales = [Scale(float(axis[0]), float(axis[-1]), logarithmic=True) for axis in axes]
    panel = Panel(canvas, Box(14, 1, width - 2, 45.5), *scales)
    across = panel.places(frequency_parameters, uplift_multipliers[0])[:, 0]
    up = panel.places(frequency_parameters[0], uplift_multipliers)[:, 1]
    falls = np.isinf(ratios).T
    shown = _contours(across, up, np.where(falls, _OVERTURNED, np.minimum(ratios.T, _OVERTURNED)))
    edges = (0.0, *_LEVELS, _OVERTURNED)
    for grey, low, high in zip(_GREYS, edges, edges[1:], strict=False):
        panel.areas(_outlines(shown, low, high), grey)
    if falls.any():
        panel.areas(
            _outlines(_contours(across, up, falls.astype(float)), 0.5, _OVERTURNED), canvas.hatching()
        )
    places = panel.places(*(np.array([place[axis] for place in structures]) for axis in (1, 2)))
    labels = placed_labels(places, [int(place[0]) for place in structures], panel.box)
    marks = [Box(x - _MARK, y - _MARK, x + _MARK, y + _MARK) for x, y in places]
    _lines(panel, shown, marks + [label.box for label in labels])
    panel.frame("frequency parameter p [rad/s]", "uplift acceleration λ [g]")
    panel.marks(places, "black", _MARK)
    draw_labels(canvas, labels)
    return canvas


def _contours(across: np.ndarray, up: np.ndarray, heights: np.ndarray) -> ContourGenerator:
    """Contours of heights (n, m) on the paper, where the axes are as they are seen."""
    return contour_generator(across, up, heights, line_type=LineType.Separate, fill_type=FillType.OuterOffset)


def _outlines(contours: ContourGenerator, low: float, high: float) -> list[np.ndarray]:
    found: Any = contours.filled(low, high)  # (points, offsets), as its fill type says
    parts = zip(*found, strict=True)
    return [piece for outline, ends in parts for piece in np.split(outline, ends[1:-1].astype(int))]


def _lines(panel: Panel, contours: ContourGenerator, taken: list[Box]) -> None:
    """Draw the lines between the shades, the longest of each with its number where there is room for it."""
    numbers: list[tuple[np.ndarray, str]] = []
    for level in _LEVELS[1:-1]:
        lines: Any = contours.lines(level)  # a list of (k, 2), as its line type says
        for line in lines:
            panel.canvas.path(line, "black", 0.5)
        longest = max(lines, key=_length, default=np.empty((0, 2)))
        if _length(longest) < _LONG:
            continue
        name = f"{level:g}"
        for share in (0.5, 0.35, 0.65, 0.2, 0.8):
            place = longest[int(share * (len(longest) - 1))]
            box = text_box(place, name, SMALL, "middle", "middle")
            if panel.box.holds(box) and not any(box.meets(other) for other in taken):
                taken.append(box)
                numbers.append((place, name))
                break
    for place, name in numbers:
        panel.canvas.text(place, name, SMALL, "middle", "middle", paper=True)


def _length(line: np.ndarray) -> float:
    return float(np.hypot(*np.diff(line, axis=0).T).sum())
