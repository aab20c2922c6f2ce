"""What accuracy costs, drawn: error against time of every method."""

import io
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from rocking.assessment.method import Method
from rocking.assessment.rows import TradeRow
from rocking.reports.style import new_figure, styled, svg
from rocking.tables import frame, write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

SMALLEST_ERROR = 1e-14
"""Smaller errors, down to none at all, are drawn here: they are the rounding of the reference."""
_LOOKS = {
    Method.PRINTED: ("Eq. 15 as printed", "X", "#D55E00", "above"),
    Method.CLOSED_FORM: ("closed form, exact", "o", "#E69F00", "right"),
    Method.BLOCK_ON_RECORD: ("equivalent block on the record", "s", "#0072B2", "right"),
    Method.MECHANISM_ON_RECORD: ("mechanism on the record", "D", "#000000", "right"),
    "scipy RK45": ("scipy RK45", "^", "#CC79A7", "left"),
    "scipy DOP853": ("scipy DOP853", "v", "#009E73", "right"),
}
"""Name, marker, colour and side of the label of each method; the marker alone tells it in print."""
_SIDES: dict[str, dict[str, Any]] = {
    "above": {"xytext": (-7, 7), "ha": "left", "va": "bottom"},
    "right": {"xytext": (7, 0), "ha": "left", "va": "center"},
    "left": {"xytext": (-7, 0), "ha": "right", "va": "center"},
}
_TIMES = {
    1e-6: "1 µs",
    1e-5: "10 µs",
    1e-4: "0.1 ms",
    1e-3: "1 ms",
    1e-2: "10 ms",
    0.1: "0.1 s",
    1.0: "1 s",
    10.0: "10 s",
    100.0: "100 s",
}
_ERRORS = {
    1e-14: "≤ 1e-14",
    1e-12: "1e-12",
    1e-9: "1e-9",
    1e-6: "1e-6",
    1e-4: "0.01 %",
    1e-2: "1 %",
    1: "100 %",
}


def write_trade_figure(table: Path, *targets: Path) -> None:
    """Draw `table`, a trade.csv, into each of `targets`, as the PDF or SVG that its name asks for."""
    figure = trade_figure(frame(TradeRow, table))
    for target in targets:
        write_whole(target, pdf(figure) if target.suffix == ".pdf" else svg(figure).encode())


@styled
def trade_figure(trade: "DataFrame") -> Figure:
    """Draw the error of the largest rotation against the time of one response, from the table of the trade.

    Small markers are cases, large ones the medians of a method at one tolerance; a line joins a method's tolerances.
    """
    timed = trade[trade["duration_s"].notna()]
    figure = new_figure(118, 170, margins=(19, 5, 12, 5))
    panel = figure.subplots()
    unplaced = []
    for method, look in _LOOKS.items():
        of_method = timed[timed["method"] == method]
        if len(of_method) and not _draw(panel, of_method, *look):
            unplaced.append(_label(look[0], of_method).replace("\n", " "))
    panel.text(0.99, 0.01, "\n".join(unplaced), transform=panel.transAxes, ha="right", va="bottom")
    _frame(panel, timed)
    return figure


@styled
def pdf(figure: Figure) -> bytes:
    """Return the figure as PDF, the same bytes for the same figure."""
    stream = io.BytesIO()
    figure.savefig(stream, format="pdf", metadata={"CreationDate": None})
    return stream.getvalue()


def _draw(panel: Axes, rows: "DataFrame", name: str, marker: str, colour: str, side: str) -> bool:
    """Draw one method and say whether it has an error to draw."""
    placed = rows.assign(error=rows["error"].clip(lower=SMALLEST_ERROR)).dropna(subset="error")
    if placed.empty:
        return False
    points = placed[["tolerance", "duration_s", "error"]].groupby("tolerance", dropna=False, sort=False)
    for _, found in points:
        panel.plot(
            found["duration_s"],
            found["error"],
            marker,
            color=colour,
            markersize=2.2,
            alpha=0.35,
            markeredgewidth=0,
        )
    medians = points.median()
    times, errors = medians["duration_s"].to_numpy(), medians["error"].to_numpy()
    panel.plot(times, errors, color=colour, linewidth=1.0)
    panel.plot(
        times, errors, marker, color=colour, markersize=6, markeredgecolor="white", markeredgewidth=0.6
    )
    place = times[errors.argmax()], errors.max()
    panel.annotate(_label(name, rows), place, textcoords="offset points", fontsize=7.5, **_SIDES[side])
    return True


def _label(name: str, rows: "DataFrame") -> str:
    tolerances = rows["tolerance"].dropna()
    spread = f",\ntolerance {tolerances.max():.0e} to {tolerances.min():.0e}" if len(tolerances) else ""
    wrong = int((~rows["verdict_agrees"].dropna()).sum())
    return name + spread + (f",\nwrong verdict in {wrong} of {len(rows)}" if wrong else "")


def _frame(panel: Axes, rows: "DataFrame") -> None:
    shortest, longest = (rows["duration_s"].min(), rows["duration_s"].max()) if len(rows) else (1e-6, 1.0)
    low, high = 10 ** math.floor(math.log10(shortest)), 10 ** math.ceil(math.log10(longest))
    panel.set(xscale="log", yscale="log", xlim=(low / 2, high * 2), ylim=(SMALLEST_ERROR / 3, 30))
    ticks = [time for time in _TIMES if low <= time <= high]
    panel.set_xticks(ticks, [_TIMES[time] for time in ticks])
    panel.yaxis.set_major_locator(FixedLocator(list(_ERRORS)))
    panel.set_yticks(list(_ERRORS), list(_ERRORS.values()))
    panel.xaxis.set_minor_locator(NullLocator())
    panel.yaxis.set_minor_locator(NullLocator())
    panel.grid(True)
    panel.set_axisbelow(True)
    panel.set_xlabel("time of one response, with the pulse and the tables at hand: to the left is faster")
    panel.set_ylabel("error of the largest rotation: lower is more accurate")
    cases = len(rows[["record", "component", "structure"]].drop_duplicates())
    panel.set_title(
        f"{cases} cases (small marks) and their medians (large); a line joins the tolerances of a method"
    )
