"""Figures over many records."""

import math
from array import array
from collections.abc import Iterable

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.reports.printing import Row
from rocking.reports.style import LIGHT_COLOURS, LIGHT_MARKERS, new_figure, plain_logarithmic, styled

_SMALLEST = 1e-3
"""Rotation ratio below which a point is set on the edge of the figure."""
_FALLEN = 1.6
"""Where overturning is set, beyond the critical rotation."""


_MOST_DRAWN = 5000
"""Points that are drawn as shapes; more become a picture, whose size does not grow with them."""


@styled
def prediction_scatter(comparison: Iterable[Row]) -> Figure:
    """Draw predicted against integrated rotation ratio, from the rows of the comparison table, with factor-two lines.

    A case without one of the two is left out, and so is one that neither lifts.
    """
    figure = new_figure(95, 115, margins=(20, 3, 13, 3))
    panel = figure.subplots()
    span = np.array([_SMALLEST, 1.0])
    panel.plot(span, span, color="black", linewidth=0.7)
    for factor in (0.5, 2.0):
        panel.plot(span, factor * span, color="black", linewidth=0.6, linestyle="--")
    points = _points(comparison)
    many = sum(len(integrated) for integrated, _ in points.values()) > _MOST_DRAWN
    for light, colour in LIGHT_COLOURS.items():
        integrated, predicted = points[light]
        panel.plot(
            integrated,
            predicted,
            LIGHT_MARKERS[light],
            color="none",
            markeredgecolor=colour,
            markeredgewidth=0.8,
            markersize=4,
            rasterized=many,
            label=f"{light} light ({len(integrated)})",
        )
    _frame(panel)
    return figure


def _points(comparison: Iterable[Row]) -> dict[str, tuple[array, array]]:
    """By light, where the cases stand: integrated and predicted rotation ratio."""
    points = {light: (array("d"), array("d")) for light in LIGHT_COLOURS}
    for row in comparison:
        predicted, integrated = (
            float(row[name] or "nan") for name in ("predicted_rotation_ratio", "integrated_rotation_ratio")
        )
        if max(predicted, integrated) > 0 and not math.isnan(predicted + integrated):
            points[row["light"]][0].append(_place(integrated))
            points[row["light"]][1].append(_place(predicted))
    return points


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
