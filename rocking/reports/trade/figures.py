"""Error against time of every method: of one response, and of the fragility of one structure."""

import math
from collections.abc import Sequence
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, NullLocator

from rocking.assessment.rows.of_trade import TradeFragilityRow, TradeMethod, TradeMethodRow
from rocking.reports.style import new_figure, shared_legend, styled

SMALLEST_ERROR = 1e-8
"""Smaller errors, down to none at all, are drawn here."""
_LOOKS: dict[str, tuple[str, str]] = {
    TradeMethod.ONE_SINE: ("o", "#E69F00"),
    TradeMethod.SINES: ("p", "#D55E00"),
    TradeMethod.BLOCK: ("s", "#0072B2"),
    TradeMethod.MULTI_FIDELITY: ("P", "#56B4E9"),
    TradeMethod.MECHANISM: ("D", "#000000"),
    TradeMethod.ENSEMBLE: ("*", "#009E73"),
    TradeMethod.RK45: ("^", "#CC79A7"),
    TradeMethod.DOP853: ("v", "#666666"),
}
"""Marker and colour of each method; the marker alone tells it in print."""
_UNITS = {1e-6: "µs", 1e-3: "ms", 1.0: "s", 1e3: "ks"}


@styled
def trade_figure(methods: Sequence[TradeMethodRow], curves: Sequence[TradeFragilityRow]) -> Figure:
    """Draw what each method errs against what it costs.

    Left: medians of the cases; a line leads to the time with the preparation of record and structure. Right: the error
    of the fragility median, small for each structure, large for their median.
    """
    figure = new_figure(88, margins=(16, 4, 22, 6))
    response, fragility = figure.subplots(1, 2, gridspec_kw={"wspace": 0.36})
    for row in methods:
        marker, colour = _LOOKS[row.method]
        look: dict[str, Any] = {"marker": marker, "color": colour, "linestyle": "none"}
        if not math.isnan(row.error):
            error = max(row.error, SMALLEST_ERROR)
            whole = row.cpu_s + row.preparation_record_s + row.preparation_structure_s
            response.plot([row.cpu_s, whole], [error, error], color=colour, linewidth=0.8)
            response.plot(row.cpu_s, error, markersize=6, label=row.method, **look)
        own = [each for each in curves if each.method == row.method]
        if own:
            errors = [max(abs(each.error), SMALLEST_ERROR) for each in own]
            fragility.plot([each.cpu_s for each in own], errors, markersize=2.2, alpha=0.5, **look)
            median = max(row.fragility_error, SMALLEST_ERROR)
            fragility.plot(row.fragility_cpu_s, median, markersize=6, label=row.method, **look)
    _frame(response, "one response", "error of the largest rotation")
    _frame(fragility, "fragility of one structure", "error of the fragility median")
    shared_legend(figure, list(_LOOKS), ncols=4)
    return figure


def _frame(panel: Axes, title: str, label: str) -> None:
    panel.set(xscale="log", yscale="log", title=title, ylabel=label, xlabel="processor time")
    panel.margins(x=0.12)
    errors = {
        1e-8: "≤ 1e-8",
        1e-6: "1e-6",
        1e-4: "0.01 %",
        1e-3: "0.1 %",
        1e-2: "1 %",
        0.1: "10 %",
        1.0: "100 %",
    }
    panel.set_ylim(SMALLEST_ERROR / 2, 5)
    panel.yaxis.set_major_locator(FixedLocator(list(errors)))
    panel.set_yticks(list(errors), list(errors.values()))
    low, high = panel.get_xlim()
    steps = (1, 3) if high < 100 * low else (1,)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    ticks = [tick for power in powers for step in steps if low <= (tick := step * 10.0**power) <= high]
    panel.set_xticks(ticks, [duration(tick) for tick in ticks])
    panel.set_xlim(low, high)
    for axis in (panel.xaxis, panel.yaxis):
        axis.set_minor_locator(NullLocator())
    panel.grid(True)
    panel.set_axisbelow(True)


def duration(seconds: float) -> str:
    """Return a time to two digits in the unit that suits it."""
    if math.isnan(seconds):
        return "–"
    scale = max((unit for unit in _UNITS if unit <= seconds * 1.0000001), default=1e-6)
    value = seconds / scale
    return f"{value:.2g} {_UNITS[scale]}" if value < 99.5 else f"{value:.0f} {_UNITS[scale]}"
