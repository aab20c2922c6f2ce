"""The fragility curves of a study: a panel for each structure, with intervals and what decides between the curves."""

import io
import math
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from rocking.assessment.fragility.rows import FragilityRow, FragilitySummaryRow
from rocking.reports.style import elided, new_figure, plain_logarithmic, styled, svg
from rocking.tables import frame, write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

_COLUMNS = 2
_HEIGHT = 52.0
"""Of a row of panels, mm."""
_UNITS = {
    "pga": "PGA [g]",
    "pgv": "PGV [m/s]",
    "p_pgv": "p·PGV/(gλ) [-]",
    "pulse": "a_g/(gλ) [-]",
    "sa1": "Sa(1 s) [g]",
}
_NAME_WIDTH = 62.0
"""Room for a structure's name, mm."""

_EXPLAINED = "full: share of the records; grey: 90 % interval for overturning, by stations; dashed: lognormal"
"""Below the figure where no caption stands."""


@styled
def fragility_figure(curves: "DataFrame", summary: "DataFrame") -> Figure:
    """Draw the curves of each structure from the tables fragility and fragility_summary."""
    names = list(dict.fromkeys(curves["structure"]))
    rows = math.ceil(len(names) / _COLUMNS)
    figure = new_figure(_HEIGHT * rows + 20, margins=(16, 3, 12, 11))
    panels = figure.subplots(
        rows, _COLUMNS, squeeze=False, sharey=True, gridspec_kw={"hspace": 0.45, "wspace": 0.08}
    )
    for panel in panels.flat[len(names) :]:
        panel.set_axis_off()
    for name, panel in zip(names, panels.flat, strict=False):
        _draw(panel, name, curves[curves["structure"] == name], summary[summary["structure"] == name])
    for panel in panels[:, 0]:
        panel.set_ylabel("probability [-]")
    return figure


def _draw(panel: Axes, name: str, curves: "DataFrame", summary: "DataFrame") -> None:
    for place, (threshold, curve) in enumerate(curves.groupby("rotation_ratio")):
        overturns = math.isinf(float(threshold))  # type: ignore[arg-type]
        colour = "black" if overturns else f"C{place + 1}"
        label = "overturns" if overturns else f"φ > {threshold:g} φ_cr".replace("φ_cr", "φcr")
        levels = curve["level"]
        if overturns:
            panel.fill_between(
                levels, curve["probability_low"], curve["probability_high"], color="0.8", linewidth=0
            )
            panel.plot(levels, curve["lognormal"], "--", color="black", linewidth=0.7)
        panel.plot(levels, curve["probability"], color=colour, linewidth=1.0, label=label)
    falls = summary[summary["rotation_ratio"] == math.inf].iloc[0]
    law = f"dispersion {falls['dispersion']:.2f}"
    median = f"{falls['median']:.2g} ({falls['median_low']:.2g}–{falls['median_high']:.2g})"
    panel.set_title(f"{elided(name, _NAME_WIDTH)}\nmedian {median}, {law}", fontsize=8)
    panel.set_xscale("log")
    plain_logarithmic(panel, "x")
    panel.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    panel.set_ylim(0, 1)
    panel.set_xlabel(_UNITS[falls["intensity_measure"]])
    panel.legend(loc="upper left", fontsize=7)


def write_fragility_figure(folder: Path, pdf: Path, picture: Path) -> None:
    """Draw the tables in `folder` into the files `pdf` and `picture` (SVG)."""
    curves, summary = (
        frame(each, folder / each.table.file_name) for each in (FragilityRow, FragilitySummaryRow)
    )
    figure = fragility_figure(curves, summary)
    figure.text(0.5, 0.0, _EXPLAINED, ha="center", va="bottom", fontsize=7)
    stream = io.BytesIO()
    figure.savefig(stream, format="pdf", metadata={"CreationDate": None})
    write_whole(pdf, stream.getvalue())
    write_whole(picture, svg(figure).encode())
