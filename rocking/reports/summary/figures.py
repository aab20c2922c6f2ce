"""Figures over many records."""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.assessment.verdict import NEGLIGIBLE
from rocking.reports.style import new_figure, plain_logarithmic, styled

if TYPE_CHECKING:
    from pandas import DataFrame

_SMALLEST = NEGLIGIBLE
"""Rotation ratio below which a point is set on the edge of the figure."""
_FALLEN = 1.6
"""Where overturning is set, beyond the critical rotation."""


_MOST_DRAWN = 5000
"""Points that are drawn as shapes; more become a picture, whose size does not grow with them."""


@styled
def prediction_scatter(comparison: "DataFrame") -> Figure:
    """Draw predicted against integrated rotation ratio, from the comparison table, with factor-two lines.

    A case without one of the two is left out, and so is one that neither lifts.
    """
    figure = new_figure(95, 115, margins=(20, 3, 13, 3))
    panel = figure.subplots()
    span = np.array([_SMALLEST, 1.0])
    panel.plot(span, span, color="black", linewidth=0.7)
    for factor in (0.5, 2.0):
        panel.plot(span, factor * span, color="black", linewidth=0.6, linestyle="--")
    ratios = comparison[["integrated_rotation_ratio", "predicted_rotation_ratio"]]
    shown = ratios.notna().all(axis="columns") & (ratios.max(axis="columns") > 0)
    places = ratios[shown].clip(lower=0.7 * _SMALLEST).replace(np.inf, _FALLEN)
    panel.plot(
        *places.to_numpy().T,
        "o",
        color="none",
        markeredgecolor="#0072B2",
        markeredgewidth=0.8,
        markersize=4,
        rasterized=len(places) > _MOST_DRAWN,
        label=f"cases ({len(places)})",
    )
    _frame(panel)
    return figure


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
