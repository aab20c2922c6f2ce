"""The report of the trade of error for time, from its rows."""

from collections.abc import Mapping, Sequence
from itertools import islice
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.products.trade.measure import what_follows
from rocking.products.trade.rows import TradeMethod, TradeRow
from rocking.quantities import counted
from rocking.reports import printing
from rocking.reports.pages import Panel, Picture, PlainPage, Section
from rocking.reports.printing import Figures, write_document
from rocking.reports.style import PREDICTED, RECORD, new_figure, picture, plain_logarithmic, styled, svg
from rocking.tables import Row, rows_of, write_whole

_LOOKS = {
    TradeMethod.ONE_SINE: (PREDICTED, "-"),
    TradeMethod.SINES: (PREDICTED, "--"),
    TradeMethod.BLOCK: (RECORD, "--"),
    TradeMethod.MECHANISM: ("black", "-"),
    TradeMethod.ENSEMBLE: ("black", ":"),
}
"""Colour and line of the methods whose cost is drawn."""
_UNSAFE = "#A44517"
_EXACT = 1e-6
"""Median error below which a method is that of the reference for whoever reads a figure."""
_MOST_STRUCTURES = 1000
"""Structures a record up to which the cost is drawn."""


def write_trade_report(
    tables: Mapping[type[Row], Sequence[Row]], pdf: Path, image: Path, figures: Figures = "none"
) -> None:
    """Set the rows of the trade and of its faults as the files `pdf` and `image` (SVG), and its figure next to them."""
    rows = rows_of(TradeRow, tables)
    of_all = [row for row in rows if row.structure == ""]
    table = printing.table_of(
        of_all,
        ("Method", "2.2", "l", lambda row: row.method),
        ("Cases", "0.7", "r", lambda row: str(row.cases)),
        ("Median error [%]", "1.1", "r", lambda row: printing.number(100 * row.error, 2)),
        ("95 % quantile [%]", "1.2", "r", lambda row: printing.number(100 * row.error_high, 2)),
        ("Wrong", "0.8", "r", lambda row: str(row.wrong_verdicts)),
        ("Unsafe", "0.8", "r", lambda row: str(row.unsafe_verdicts)),
        ("Falls", "0.7", "r", lambda row: str(row.falls)),
        ("Falls found", "0.8", "r", lambda row: str(row.falls_found)),
        ("False falls", "0.7", "r", lambda row: str(row.false_alarms)),
        ("Response [ms]", "1.2", "r", lambda row: printing.number(1e3 * row.cpu_s, 2)),
        ("Record [ms]", "0.9", "r", lambda row: printing.number(1e3 * row.preparation_record_s, 2)),
    )
    sample = max(of_all, key=lambda row: row.stations, default=None)
    of_stations = (
        f", {counted(sample.stations, 'station')} of {counted(sample.earthquakes, 'earthquake')}"
        if sample
        else ""
    )
    caption = (
        f"Over all structures{of_stations}; of each structure in trade.csv. Cases: those of the agreement of the "
        "summary (the crack that governs, at the period of the verdict, recorded motions alone) in which the method or "
        "the reference, the integration of the study, does not rest. Error: of the largest rotation where both rock, "
        "its median and its 95 % quantile. Wrong: verdicts unlike the reference; unsafe: those that say less. Falls: "
        "of the reference, those that the method finds (a sine that begins after the fall has not found it), and those "
        "that it alone says. Record: the search for its sines. One ensemble serves all cases of a structure; its error "
        "is that of its median."
    )
    machine = rows[0].machine if rows else "no machine"
    of_figure = (
        "Left: processor time of a record against the number of structures that are followed under it, "
        "with the number from which on one sine costs less and its 5\N{EN DASH}95 % over the records. Right: share of "
        f"the cases in which a method errs, over all structures, with its median error. Measured on {machine}."
    )
    drawn = [Section(pictures=(_picture(of_all),), caption=of_figure)] if of_all else []
    parts = [
        Section(text="".join(islice(what_follows(rows), 1))),
        *drawn,
        Section(table=table, caption=caption),
    ]
    if faults := printing.faults_in_words(tables):
        parts.append(Section(sentences=tuple(faults)))
    subtitle = f"Processor times of {machine}, on the records and structures of the study."
    page = PlainPage(title="What accuracy costs", subtitle=subtitle, parts=tuple(parts))
    write_document(pdf, page, figures)
    write_whole(image, svg(trade_figure(rows)).encode())


def trade_panel(of_each: Sequence[TradeRow]) -> Panel | None:
    """Return the figure over all structures and what follows, for the summary; None where none was followed."""
    rows = [row for row in of_each if row.structure == ""]
    if not rows:
        return None
    caption = (
        "Error against processor time of every method, measured on this study and on the machine that ran it; "
        "trade.pdf explains it."
    )
    drawn = Section(pictures=(_picture(rows),), caption=caption)
    return Panel("What accuracy costs", (drawn, Section(text="".join(islice(what_follows(rows), 1)))))


def _picture(rows: Sequence[TradeRow]) -> Picture:
    return picture(
        trade_figure(rows), "Processor time of a record against the number of structures, and errors."
    )


@styled
def trade_figure(rows: Sequence[TradeRow]) -> Figure:
    """Draw what a record costs by each method for any number of structures, and how often each is wrong."""
    of_all = {row.method: row for row in rows if row.structure == ""}
    figure = new_figure(62, margins=(14, 3, 11, 7))
    cost, errors = figure.subplots(1, 2, width_ratios=(1.25, 1))
    _draw_costs(cost, of_all)
    _draw_errors(errors, of_all)
    figure.subplots_adjust(wspace=0.62)
    return figure


def _draw_costs(panel: Axes, of_all: dict[TradeMethod, TradeRow]) -> None:
    structures = np.geomspace(1, _MOST_STRUCTURES, 60)
    for method, (colour, line) in _LOOKS.items():
        if row := of_all.get(method):
            spent = 1e3 * (row.preparation_record_s + structures * row.cpu_s)
            panel.plot(structures, spent, color=colour, linestyle=line, label=method)
    sine, mechanism = of_all.get(TradeMethod.ONE_SINE), of_all.get(TradeMethod.MECHANISM)
    if sine and mechanism and 1 <= sine.break_even <= _MOST_STRUCTURES:
        both = 1e3 * sine.break_even * mechanism.cpu_s
        ends = [min(sine.break_even_low, sine.break_even), min(sine.break_even_high, _MOST_STRUCTURES)]
        panel.plot(ends, [both, both], color=PREDICTED, linewidth=2.2, solid_capstyle="butt")
        panel.plot(sine.break_even, both, "o", color=PREDICTED, markersize=5, fillstyle="none")
        panel.annotate(
            f"{sine.break_even:.0f} structures",
            (sine.break_even, both),
            xytext=(5, -9),
            textcoords="offset points",
            color=PREDICTED,
        )
    plain_logarithmic(panel, "x")
    plain_logarithmic(panel, "y")
    panel.set_xlabel("structures a record")
    panel.set_ylabel("processor time of a record [ms]")
    panel.grid(True)
    panel.legend(fontsize=6)


def _draw_errors(panel: Axes, of_all: dict[TradeMethod, TradeRow]) -> None:
    shown = [row for method, row in of_all.items() if row.cases and method is not TradeMethod.COARSE]
    for place, row in enumerate(reversed(shown)):
        wrong = 100 * row.wrong_verdicts / row.cases
        unsafe = 100 * row.unsafe_verdicts / row.cases
        panel.barh(place, wrong, color="0.75", height=0.6)
        panel.barh(place, unsafe, color=_UNSAFE, height=0.6)
        error = f", error {printing.number(100 * row.error, 2)} %" if row.error > _EXACT else ""
        panel.text(
            wrong + 0.6, place, f"{row.wrong_verdicts} of {row.cases}{error}", va="center", fontsize=6.5
        )
    panel.set_yticks(range(len(shown)), [row.method for row in reversed(shown)])
    panel.set_ylim(-0.6, max(len(shown), 1) - 0.4)
    most = max([100 * row.wrong_verdicts / row.cases for row in shown], default=0.0)
    panel.set_xlim(0, 1.9 * max(most, 5.0))
    panel.set_xlabel("wrong verdicts [%], of them unsafe (brown)")
