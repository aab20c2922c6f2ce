"""Figures over many records."""

import math
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.reports.style import LIGHT_COLOURS, LIGHT_MARKERS, new_figure, plain_logarithmic, styled

_SMALLEST = 1e-3
"""Rotation ratio below which a point is set on the edge of the figure."""
_FALLEN = 1.6
"""Where overturning is set, beyond the critical rotation."""


@styled
def prediction_scatter(cases: Sequence[tuple[float, float, str]]) -> Figure:
    """Draw predicted against integrated rotation ratio for (predicted, integrated, light), with factor-two lines.

    A case with a nan is left out.
    """
    figure = new_figure(95, 115, margins=(20, 3, 13, 3))
    panel = figure.subplots()
    span = np.array([_SMALLEST, 1.0])
    panel.plot(span, span, color="black", linewidth=0.7)
    for factor in (0.5, 2.0):
        panel.plot(span, factor * span, color="black", linewidth=0.6, linestyle="--")
    known = [case for case in cases if not math.isnan(case[0] + case[1])]
    for light, colour in LIGHT_COLOURS.items():
        points = [(_place(i), _place(p)) for p, i, of in known if of == light and (p > 0 or i > 0)]
        x, y = zip(*points, strict=True) if points else ((), ())
        panel.plot(
            x,
            y,
            LIGHT_MARKERS[light],
            color="none",
            markeredgecolor=colour,
            markeredgewidth=0.8,
            markersize=4,
            label=f"{light} light ({len(points)})",
        )
    _frame(panel)
    return figure


def _place(ratio: float) -> float:
    return _FALLEN if math.isinf(ratio) else max(ratio, 0.7 * _SMALLEST)


def _frame(panel: Axes) -> None:
    for which in ("x", "y"):
        plain_logarithmic(panel, which)
    for line in (panel.axvline, panel.axhline):
        line(1.25, color="0.5", linewidth=0.5)
        line(0.85 * _SMALLEST, color="0.5", linewidth=0.5)
    limits = 0.55 * _SMALLEST, 2.1
    ticks = [0.7 * _SMALLEST, 0.001, 0.01, 0.1, 1.0]
    names = ["", "0.001", "0.01", "0.1", "1"]
    panel.set(xlim=limits, ylim=limits)
    panel.set_xticks([*ticks, _FALLEN], [*names, "\noverturns"])
    panel.set_yticks([*ticks, _FALLEN], [*names, "overturns"])
    panel.set_xlabel("rotation / critical rotation, full integration [-]")
    panel.set_ylabel("rotation / critical rotation, closed form [-]")
    panel.legend(loc="upper left", bbox_to_anchor=(0.03, 0.88))
