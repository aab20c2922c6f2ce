"""What accuracy costs, drawn: error against time of every method."""

import io
import math
from collections.abc import Iterable, Mapping
from statistics import median

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from rocking.reports.style import new_figure, styled

SMALLEST_ERROR = 1e-14
"""Smaller errors, down to none at all, are drawn here: they are the rounding of the reference."""
_LOOKS = {
    "printed": ("Eq. 15 as printed", "X", "#D55E00"),
    "closed form": ("closed form, exact", "o", "#E69F00"),
    "block on record": ("equivalent block on the record", "s", "#0072B2"),
    "mechanism on record": ("mechanism on the record", "D", "#000000"),
    "scipy RK45": ("scipy RK45 with events", "^", "#CC79A7"),
    "scipy DOP853": ("scipy DOP853 with events", "v", "#009E73"),
}
"""Name, marker and colour (told apart by colour-blind readers) of each method; the marker alone tells it in print."""
_TIMES = {1e-6: "1 µs", 1e-5: "10 µs", 1e-4: "0.1 ms", 1e-3: "1 ms", 1e-2: "10 ms", 0.1: "0.1 s", 1: "1 s", 10: "10 s", 100: "100 s"}  # fmt: skip
_ERRORS = {
    1e-14: "≤ 1e-14",
    1e-12: "1e-12",
    1e-9: "1e-9",
    1e-6: "1e-6",
    1e-4: "0.01 %",
    1e-2: "1 %",
    1: "100 %",
}
Row = Mapping[str, str]
"""A row of trade.csv as text."""


@styled
def trade_figure(rows: Iterable[Row]) -> Figure:
    """Draw the error of the largest rotation against the time of one response, from the rows of trade.csv.

    Small markers are cases, large ones the medians of a method at one tolerance; a line joins a method's tolerances.
    """
    rows = [row for row in rows if row["duration_s"]]
    figure = new_figure(118, 170, margins=(19, 5, 12, 5))
    panel = figure.subplots()
    for method, look in _LOOKS.items():
        _draw(panel, [row for row in rows if row["method"] == method], *look)
    _frame(panel, rows)
    return figure


@styled
def pdf(figure: Figure) -> bytes:
    """Return the figure as PDF, the same bytes for the same figure."""
    stream = io.BytesIO()
    figure.savefig(stream, format="pdf", metadata={"CreationDate": None})
    return stream.getvalue()


def _draw(panel: Axes, rows: list[Row], name: str, marker: str, colour: str) -> None:
    medians = []
    for tolerance in dict.fromkeys(row["tolerance"] for row in rows):
        found = [row for row in rows if row["tolerance"] == tolerance and row["error"]]
        points = [(float(row["duration_s"]), max(float(row["error"]), SMALLEST_ERROR)) for row in found]
        if points:
            times, errors = zip(*points, strict=True)
            panel.plot(times, errors, marker, color=colour, markersize=2.2, alpha=0.35, markeredgewidth=0)
            medians.append((median(times), median(errors)))
    if not medians:
        return
    panel.plot(*zip(*medians, strict=True), color=colour, linewidth=1.0)
    panel.plot(*zip(*medians, strict=True), marker, color=colour, markersize=6, markeredgecolor="white", markeredgewidth=0.6)  # fmt: skip
    wrong = [row for row in rows if row["verdict_agrees"] == "false"]
    said = f"\nwrong verdict in {len(wrong)} of {len(rows)} runs" if wrong else ""
    place = max(medians, key=lambda point: point[1])
    panel.annotate(
        name + said, place, (0, 7), textcoords="offset points", ha="center", va="bottom", color=colour, fontsize=7.5
    )  # fmt: skip


def _frame(panel: Axes, rows: list[Row]) -> None:
    times = [float(row["duration_s"]) for row in rows] or [1e-6, 1.0]
    low, high = 10 ** math.floor(math.log10(min(times))), 10 ** math.ceil(math.log10(max(times)))
    panel.set(xscale="log", yscale="log", xlim=(low / 2, high * 2), ylim=(SMALLEST_ERROR / 3, 30))
    ticks = [time for time in _TIMES if low <= time <= high]
    panel.set_xticks(ticks, [_TIMES[time] for time in ticks])
    panel.yaxis.set_major_locator(FixedLocator(list(_ERRORS)))
    panel.set_yticks(list(_ERRORS), list(_ERRORS.values()))
    panel.xaxis.set_minor_locator(NullLocator())
    panel.yaxis.set_minor_locator(NullLocator())
    panel.grid(True)
    panel.set_axisbelow(True)
    panel.set_xlabel("time of one response: to the left is faster")
    panel.set_ylabel("error of the largest rotation: lower is more accurate")
    cases = len({(row["record"], row["component"], row["structure"]) for row in rows})
    panel.set_title(
        f"{cases} records and structures: small marks are cases, large ones medians, a line joins the tolerances of a method"
    )
