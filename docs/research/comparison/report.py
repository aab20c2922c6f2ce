"""Work against precision as one document: a table and a figure."""

from collections.abc import Sequence
from pathlib import Path
from statistics import median

from matplotlib.figure import Figure
from matplotlib.ticker import FuncFormatter, LogLocator, NullLocator

from docs.research.comparison import tables
from docs.research.comparison.rows import CodeRow
from docs.research.comparison.tables import STRUCTURES, rocks
from rocking.reports.document import compile_document
from rocking.reports.style import new_figure, shared_legend, styled, svg
from rocking.tables import read_table

SMALLEST_ERROR = 1e-15
"""Smaller errors, down to none, are drawn here."""
SAMPLED_CODES = ("LMGC90", "OpenSees")
"""How the names of the codes begin that take a sample."""
_COLOURS = ("#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7", "#56B4E9", "#E69F00", "#666666")
_MARKERS = "osD^vPXH"


def comparison_report(folder: Path) -> bytes:
    """Return the PDF of a comparison whose table stands in `folder`."""
    return compile_document(
        Path(__file__).with_name("comparison.typ"), comparison_data(read_table(CodeRow, folder))
    )


def comparison_data(rows: Sequence[CodeRow]) -> dict[str, object]:
    """Return what the template is given."""
    cases = {row.case: row for row in rows}
    slow = [row for row in rows if row.code.startswith(SAMPLED_CODES)]
    pulses = sum(row.motion == "pulse" for row in cases.values())
    return {
        "title": "Work against precision: the same cases through every code",
        "subtitle": f"{pulses} pulses and {len(cases) - pulses} stretches of records on a block, a frame and an arch "
        "of seven voussoirs; the reference is DOP853 of scipy at 1e-12, restarted at every sample and impact.",
        "table": tables.work([row for row in rows if not row.another_model]),
        "losses": tables.losses(slow),
        "slow": tables.case_by_case([row for row in slow if not row.another_model]),
        "another": tables.another_model([row for row in slow if row.another_model]),
        "figure": svg(work_figure(rows)),
        "alt": "Median error against median processor time of every code.",
    }


@styled
def work_figure(rows: Sequence[CodeRow]) -> Figure:
    """Draw error against processor time: small marks are cases, large ones the medians of a code and structure."""
    figure = new_figure(112, margins=(17, 4, 29, 6))
    panels = figure.subplots(1, len(STRUCTURES), sharex=True, sharey=True, gridspec_kw={"wspace": 0.06})
    names = list(dict.fromkeys(row.code for row in rows))
    for panel, structure in zip(panels, STRUCTURES, strict=True):
        for k, name in enumerate(names):
            own = [row for row in rows if (row.structure, row.code) == (structure, name) and rocks(row)]
            if not own or "reference" in name:
                continue
            times, errors = [r.duration_s for r in own], [max(r.error, SMALLEST_ERROR) for r in own]
            look = {"color": _COLOURS[k % 8], "marker": _MARKERS[k % 8], "linestyle": "none"}
            panel.plot(times, errors, markersize=1.8, alpha=0.35, markeredgewidth=0, **look)
            panel.plot(
                median(times), median(errors), markersize=6.5, markeredgecolor="white", label=name, **look
            )
        panel.set(xscale="log", yscale="log", title=structure, xlabel="processor time of a response (s)")
        for axis in (panel.xaxis, panel.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.0e}"))
            axis.set_major_locator(LogLocator(numticks=9))
            axis.set_minor_locator(NullLocator())
        panel.tick_params(axis="x", rotation=30)
        panel.margins(x=0.08)
        panel.grid(True)
        panel.set_axisbelow(True)
    panels[0].set_ylabel("error of the largest rotation, relative")
    shared_legend(figure, names, ncols=3)
    return figure
