"""The figure of the responses: the rotation of each structure in its own panel."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocking.reports.paper.canvas import SIZE, SMALL, TEXT_WIDTH, Box, Canvas
from rocking.reports.paper.letters import elided
from rocking.reports.paper.panel import GRID, Panel, panels_in
from rocking.reports.paper.scales import Scale

_PREDICTED = "#0072B2"
_COLUMNS = 3
_PANEL_HEIGHT, _ALONE_HEIGHT, _MARGIN_HEIGHT = 24.0, 38.0, 6.0
"""Of a row among several, of a single one, and of what stands below them, mm."""
_STILL = 0.01
"""Share of the largest rotation below which a history is cut from the figure."""
_HIGHEST = 1.4
"""Share of the critical rotation beyond which nothing is drawn."""


@dataclass(frozen=True, eq=False)
class History:
    """One response as a panel shows it: rotation over critical rotation against time, and what was predicted.

    times: (k,) s. ratio: (k,) signed; both empty where there is no uplift. predicted: largest rotation ratio of the
    closed form (inf if it overturns, nan if there is none). remark: what the curve does not show.
    """

    label: str
    times: np.ndarray
    ratio: np.ndarray
    predicted: float
    remark: str = ""


def response_histories(histories: Sequence[History]) -> Canvas:
    """Draw each response in its own panel: the integration solid, the predicted maximum dash-dot (as Fig. 8)."""
    columns = min(_COLUMNS, len(histories))
    rows = math.ceil(len(histories) / columns)
    height = (_PANEL_HEIGHT * rows if rows > 1 else _ALONE_HEIGHT) + _MARGIN_HEIGHT
    canvas = Canvas(TEXT_WIDTH, height)
    boxes = panels_in(Box(15, 4, TEXT_WIDTH - 2, height - 9.5), rows, columns, (13, 6.5))
    time = Scale(*_window(histories))
    for place, (box, history) in enumerate(zip(boxes, histories, strict=False)):
        lowest = place + columns >= len(histories)
        _draw(Panel(canvas, box, time, _height(history)), history, lowest)
    canvas.text((TEXT_WIDTH / 2, height - 0.3), "time after the first sample [s]", SIZE, "middle", "bottom")
    label = "rotation / critical rotation [-]" if rows > 1 else "rotation ratio [-]"
    canvas.text((3.2, (height - 5.5) / 2), label, SIZE, "middle", "bottom", turned=True)
    return canvas


def _draw(panel: Panel, history: History, lowest: bool) -> None:
    panel.title(elided(history.label, 30))
    panel.level(0.0, GRID, 0.3)
    panel.trace(history.times, history.ratio, "black", 0.7)
    if 0 < history.predicted < math.inf:
        for level in (history.predicted, -history.predicted):
            panel.level(level, _PREDICTED, 1.0, "dash-dot")
    panel.frame(numbered=lowest)
    if history.remark:
        corner = (panel.box.right - 0.3, panel.box.bottom - 0.3)
        panel.canvas.text(corner, history.remark, SMALL, "right", "bottom", paper=True)


def _height(history: History) -> Scale:
    """The height of a panel: enough for the response and the prediction, no further than 1.4 φ_cr to either side."""
    levels = [float(np.abs(history.ratio).max())] if history.ratio.size else []
    if 0 < history.predicted < math.inf:
        levels.append(history.predicted)
    reach = min(1.25 * max(levels), _HIGHEST) if levels and max(levels) > 0 else 1.0
    return Scale(-reach, reach)


def _window(histories: Sequence[History]) -> tuple[float, float]:
    """The span of time in which anything moves."""
    begins, ends = [], []
    for history in histories:
        size = np.abs(history.ratio)
        moving = np.flatnonzero(size > _STILL * size.max()) if size.size else np.empty(0, int)
        if moving.size:
            begins.append(history.times[moving[0]])
            ends.append(history.times[moving[-1]])
    if not begins:
        return 0.0, 1.0
    margin = 0.05 * (max(ends) - min(begins)) + 1e-3
    return max(0.0, min(begins) - margin), max(ends) + margin
