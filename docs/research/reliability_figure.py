"""The reliability diagram of the ensembles: what few members say against what thousands of draws find."""

from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from rocking.reports.style import new_figure, styled, svg
from rocking.tables import write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

_MARKERS = {"stands": ("o", "C0"), "undecided": ("x", "C7"), "overturns": ("s", "C3")}


@styled
def reliability(trials: "DataFrame") -> Figure:
    """Draw the probability of each ensemble against that of the draws, by its verdict; the diagonal is right."""
    figure = new_figure(95, 115, margins=(16, 3, 13, 3))
    panel = figure.subplots()
    panel.plot([0, 1], [0, 1], color="black", linewidth=0.7)
    for verdict, (marker, colour) in _MARKERS.items():
        cases = trials[trials["verdict"] == verdict]
        panel.plot(
            cases["probability_drawn"],
            cases["probability"],
            marker,
            color="none",
            markeredgecolor=colour,
            markersize=4,
            label=f"{verdict} ({len(cases)})",
        )
    draws = int(trials["draws"].max())
    panel.set_xlabel(f"share of {draws} random draws that overturn [-]")
    panel.set_ylabel("share of the ensemble that overturns [-]")
    panel.set_xlim(-0.03, 1.03)
    panel.set_ylim(-0.03, 1.03)
    panel.set_aspect("equal")
    panel.legend(loc="upper left")
    return figure


def write_reliability(trials: "DataFrame", target: Path) -> None:
    """Draw `trials` into the SVG file `target`."""
    write_whole(target, svg(reliability(trials)).encode())
