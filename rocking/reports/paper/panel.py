"""A pair of axes on the paper, and what is drawn within them."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from rocking.reports.paper.canvas import SIZE, SMALL, Box, Canvas
from rocking.reports.paper.letters import text_width
from rocking.reports.paper.scales import Scale, tick_label

GREY, PALE, GRID = "#595959", "#ededed", "#999999"
_TICK, _GAP = 0.9, 0.5
"""Length of a tick, and air between it and its number, mm."""
RESOLVED = 25.4 / 300
"""What a printer and an eye tell apart, mm."""
_BEYOND = 20.0
"""Widths of a panel beyond which nothing is drawn, as it would be cut off anyway."""

Ticks = Sequence[tuple[float, str]]
"""Values with what stands beside them."""


@dataclass(eq=False)
class Panel:
    """A box of the paper with a scale along each of its lower and its left edge."""

    canvas: Canvas
    box: Box
    x: Scale
    y: Scale
    _clip: str = field(init=False)

    def __post_init__(self) -> None:
        self._clip = self.canvas.clip(self.box)

    def places(self, x: np.ndarray | float, y: np.ndarray | float) -> np.ndarray:
        """Return where values stand on the paper, (k, 2) mm."""
        across, up = np.broadcast_arrays(np.atleast_1d(self.x.shares(x)), np.atleast_1d(self.y.shares(y)))
        across, up = np.clip(across, -_BEYOND, _BEYOND), np.clip(up, -_BEYOND, _BEYOND)
        return np.column_stack(
            (self.box.left + across * self.box.width, self.box.bottom - up * self.box.height)
        )

    def line(self, x: np.ndarray, y: np.ndarray, colour: str, width: float = 0.8, dash: str = "") -> None:
        """Draw a line through values, cut off at the edges."""
        self.canvas.path(self.places(x, y), colour, width, dash, clip=self._clip)

    def trace(self, times: np.ndarray, values: np.ndarray, colour: str, width: float = 0.5) -> None:
        """Draw a trace of many samples as far as it can be resolved."""
        self.line(*thinned(times, values, self.box.width), colour, width)

    def level(
        self, y: float, colour: str, width: float = 0.6, dash: str = "", span: Sequence[float] = (0, 1)
    ) -> None:
        """Draw a line across at `y`, over shares of the width."""
        begin, end = (self.box.left + share * self.box.width for share in span)
        (_, height) = self.places(self.x.low, y)[0]
        self.canvas.path(np.array([[begin, height], [end, height]]), colour, width, dash, clip=self._clip)

    def upright(self, x: float, colour: str, width: float = 0.9, dash: str = "") -> None:
        """Draw a line from the lower to the upper edge."""
        (place, _) = self.places(x, self.y.low)[0]
        ends = np.array([[place, self.box.bottom], [place, self.box.top]])
        self.canvas.path(ends, colour, width, dash, clip=self._clip)

    def band(self, begin: float, end: float, fill: str = PALE) -> None:
        """Fill what lies between two values of x."""
        shares = np.clip(self.x.shares(np.array([begin, end])), 0.0, 1.0)
        left, right = self.box.left + shares * self.box.width
        self.canvas.rectangle(Box(left, self.box.top, right, self.box.bottom), fill)

    def areas(self, outlines: Sequence[np.ndarray], fill: str) -> None:
        """Fill outlines (k, 2) of the paper, cut off at the edges."""
        self.canvas.areas(outlines, fill, self._clip)

    def marks(self, places: np.ndarray, edge: str, radius: float = 0.75) -> None:
        """Draw a circle at each of `places` (k, 2) of the paper."""
        for place in places:
            self.canvas.circle(place, radius, edge)

    def frame(
        self,
        x_label: str = "",
        y_label: str = "",
        x_ticks: Ticks | None = None,
        y_ticks: Ticks | None = None,
        aside: float | None = None,
        numbered: bool = True,
    ) -> None:
        """Draw the two axes with their ticks, numbers and labels.

        Ticks: found where none are given. numbered: whether the lower axis has numbers.
        aside: from the left axis to its label, mm; beside the numbers if None.
        """
        across = self._found(self.x, self.box.width, 9.0) if x_ticks is None else x_ticks
        self._across(across if numbered else [(value, "") for value, _ in across], x_label)
        self._upwards(
            self._found(self.y, self.box.height, 4.5) if y_ticks is None else y_ticks, y_label, aside
        )

    def title(self, text: str) -> None:
        """Write above the upper left corner."""
        self.canvas.text((self.box.left, self.box.top - 0.8), text)

    def legend(self, entries: Sequence[tuple[str, str, float, str]]) -> None:
        """Name lines (name, colour, width, dash) in a row that ends above the upper right corner."""
        right = self.box.right
        for name, colour, width, dash in reversed(entries):
            self.canvas.text((right, self.box.top - 2.2), name, SMALL, "right", "middle")
            right -= text_width(name, SMALL) + 1.0
            ends = np.array([[right - 6.5, self.box.top - 2.2], [right, self.box.top - 2.2]])
            self.canvas.path(ends, colour, width, dash)
            right -= 9.5

    @staticmethod
    def _found(scale: Scale, length: float, apart: float) -> Ticks:
        return [(value, tick_label(value)) for value in scale.ticks(max(2, int(length / apart)))]

    def _across(self, ticks: Ticks, label: str) -> None:
        left, right, bottom = self.box.left, self.box.right, self.box.bottom
        self.canvas.path(np.array([[left, bottom], [right, bottom]]), "black", 0.5)
        named = any(name for _, name in ticks)
        for value, name in ticks:
            (place, _) = self.places(value, self.y.low)[0]
            self.canvas.path(np.array([[place, bottom], [place, bottom + _TICK]]), "black", 0.5)
            if name:
                self.canvas.text((place, bottom + _TICK + _GAP), name, SMALL, "middle", "top")
        if label:
            below = bottom + _TICK + _GAP + (3.0 if named else 0.5)
            self.canvas.text(((left + right) / 2, below), label, SIZE, "middle", "top")

    def _upwards(self, ticks: Ticks, label: str, aside: float | None) -> None:
        left, top, bottom = self.box.left, self.box.top, self.box.bottom
        self.canvas.path(np.array([[left, bottom], [left, top]]), "black", 0.5)
        for value, name in ticks:
            (_, place) = self.places(self.x.low, value)[0]
            self.canvas.path(np.array([[left - _TICK, place], [left, place]]), "black", 0.5)
            if name:
                self.canvas.text((left - _TICK - _GAP, place), name, SMALL, "right", "middle")
        if label:
            widest = max((text_width(name, SMALL) for _, name in ticks), default=0.0)
            beside = _TICK + 2 * _GAP + 0.5 + widest if aside is None else aside
            self.canvas.text(
                (left - beside, (top + bottom) / 2), label, SIZE, "middle", "bottom", turned=True
            )


def panels_in(box: Box, rows: int, columns: int, gap: tuple[float, float]) -> list[Box]:
    """Return the boxes of a grid of panels, row by row. gap: between columns and between rows, mm."""
    width = (box.width - gap[0] * (columns - 1)) / columns
    height = (box.height - gap[1] * (rows - 1)) / rows
    lefts = [box.left + column * (width + gap[0]) for column in range(columns)]
    tops = [box.top + row * (height + gap[1]) for row in range(rows)]
    return [Box(left, top, left + width, top + height) for top in tops for left in lefts]


def thinned(times: np.ndarray, values: np.ndarray, width: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the envelope of a trace that is `width` mm wide: least and largest value of each stretch, in order.

    A stretch is no wider than what is resolved, so that no peak is lost or moved by more than that; a trace of few
    samples stays as it is.
    """
    size = values.size
    stretch = math.ceil(size * RESOLVED / width)
    if stretch < 3:
        return times, values
    padded = np.pad(values, (0, -size % stretch), mode="edge").reshape(-1, stretch)
    begins = np.arange(len(padded)) * stretch
    kept = np.unique(np.concatenate([begins + padded.argmin(axis=1), begins + padded.argmax(axis=1)]))
    return times[kept], values[kept]
