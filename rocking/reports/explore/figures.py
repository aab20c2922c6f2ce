"""Figures of the page: drawn once, then pointed at by its script."""

from collections.abc import Sequence

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from rocking.assessment.intensity import INTENSITY_MEASURES
from rocking.reports.style import elided, new_figure, plain_logarithmic, styled
from rocking.reports.summary.figures import prediction_scatter

CASES = "cases"
"""Name, in the SVG, of the group of points, one for each case in the order given."""
MOST_CURVES = 10
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#000000")
_STYLES = ("-", "--")


def scatter(integrated: Sequence[float], predicted: Sequence[float]) -> Figure:
    """Draw predicted against integrated rotation ratio; every case must have both, and lift in one."""
    columns = {"integrated_rotation_ratio": integrated, "predicted_rotation_ratio": predicted}
    figure = prediction_scatter(pd.DataFrame(columns, dtype=float))
    (points,) = (line for line in figure.axes[0].lines if str(line.get_label()).startswith("cases"))
    points.set_gid(CASES)
    return figure


@styled
def fragility_curves(curves: pd.DataFrame) -> Figure:
    """Draw the probability of overturning over the intensity measure, with its 90 % interval, for each structure.

    curves: columns structure, intensity_measure, rotation_ratio, level, probability, probability_low, probability_high.
    """
    figure = new_figure(95, 115, margins=(16, 3, 13, 3))
    panel = figure.subplots()
    measure = str(curves["intensity_measure"].iloc[0])
    shown = curves[np.isinf(curves["rotation_ratio"]) & (curves["intensity_measure"] == measure)]
    for place, (name, curve) in enumerate(shown.groupby("structure", sort=False)):
        if place == MOST_CURVES:
            break
        colour, line = _COLOURS[place % len(_COLOURS)], _STYLES[place // len(_COLOURS)]
        panel.plot(
            curve["level"],
            curve["probability"],
            line,
            color=colour,
            linewidth=1.2,
            label=elided(str(name), 30),
        )
        panel.fill_between(
            curve["level"], curve["probability_low"], curve["probability_high"], color=colour, alpha=0.1
        )
    plain_logarithmic(panel, "x")
    panel.set_ylim(0, 1)
    panel.set_xlabel(f"intensity measure {measure} [{INTENSITY_MEASURES[measure].unit or '-'}]")
    panel.set_ylabel("probability of overturning [-]")
    panel.legend(loc="upper left", fontsize=7)
    return figure
