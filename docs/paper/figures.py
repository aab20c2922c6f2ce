"""The source paper's figures redrawn: panels of curves in one style, and the structures beside them."""

from collections import Counter
from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from docs.paper.curves import ROTATION, Curve
from rocking.reports.style import new_figure, plain_logarithmic, styled
from rocking.structures.arch import Arch

_PANEL_WIDTH, _PANEL_HEIGHT = 85.0, 54.0
_LEGEND_ROW = 6.0
"""Height of a legend below all panels, mm."""
_LABELLED_AMPLITUDE = 2.0
"""Amplitude over uplift acceleration at which the lines of the pulse map carry their numbers."""
_FEW_CURVES = 4
"""Curves of a panel whose legend finds room beside them."""
_LINES = ("-", "--", "-.", ":", (0, (6, 1, 1, 1, 1, 1)), (0, (1, 2)))
"""Line styles in turn, so that curves are told apart without colour."""


@styled
def panels(curves: Sequence[Curve], columns: int = 2) -> Figure:
    """Draw each panel's curves, told apart by line style; a curve with its own style keeps it.

    Panels of many curves of the same names share one legend, which stands where no curve is: in the place of a panel
    that is free, or in a row of its own below all.
    """
    names = list(dict.fromkeys(curve.panel for curve in curves))
    by_panel = {name: [curve for curve in curves if curve.panel == name] for name in names}
    shared = _shared_labels(list(by_panel.values()))
    rows = -(-len(names) // columns)
    free = rows * columns - len(names)
    below = _LEGEND_ROW if shared and not free else 0.0
    figure = new_figure(_PANEL_HEIGHT * rows + below, _PANEL_WIDTH * columns, margins=(13, 3, 9 + below, 5))
    figure.subplots_adjust(wspace=0.22, hspace=0.3)
    axes = figure.subplots(rows, columns, squeeze=False).ravel()
    for panel, name in zip(axes, names, strict=False):
        _panel(panel, name if len(names) > 1 else "", by_panel[name], shared)
    for panel in axes[len(names) :]:
        panel.set_axis_off()
    if shared:
        first = next(place for place, curves in enumerate(by_panel.values()) if _labels(curves) == shared)
        lines, labels = axes[first].get_legend_handles_labels()
        if free:
            axes[len(names)].legend(lines, labels, loc="center left")
        else:
            figure.legend(lines, labels, loc="lower center", ncols=len(labels))
    return figure


def _labels(curves: Sequence[Curve]) -> tuple[str, ...]:
    return tuple(curve.label for curve in curves)


def _shared_labels(by_panel: Sequence[Sequence[Curve]]) -> tuple[str, ...]:
    """Return the names of the curves that most panels draw alike; () where no two panels of many curves do."""
    counts = Counter(_labels(curves) for curves in by_panel if len(curves) > _FEW_CURVES)
    labels, count = max(counts.items(), key=lambda item: item[1], default=((), 0))
    return labels if count > 1 else ()


def _panel(panel: Axes, name: str, curves: Sequence[Curve], shared: tuple[str, ...] = ()) -> None:
    """Draw the curves of one panel; its legend too, unless that of all panels, of the names `shared`, tells them."""
    for place, curve in enumerate(curves):
        style = curve.style or _LINES[place % len(_LINES)]
        panel.plot(curve.x, curve.y, linestyle=style, color=f"C{place % 6}", label=curve.label)
    panel.set_title(f"({name})" if name else "")
    panel.set_xlabel(curves[0].x_quantity)
    panel.set_ylabel(curves[0].y_quantity)
    panel.margins(y=0.06)
    if _labels(curves) == shared:
        return
    if curves[0].y_quantity == ROTATION:  # which leaves no room of its own for a legend
        low, high = panel.get_ylim()
        panel.set_ylim(low - 0.45 * (high - low), high)
    legend = panel.legend(loc="lower right" if curves[0].y_quantity == ROTATION else "best")
    legend.set_frame_on(True)
    legend.get_frame().set(facecolor="white", edgecolor="none", alpha=0.85)


@styled
def arch_response(curves: Sequence[Curve], arch: Arch) -> Figure:
    """Draw Fig. 8: the arch with its thrust line at onset (a), the record (b) and the responses (c, d)."""
    figure = new_figure(2 * _PANEL_HEIGHT, 2 * _PANEL_WIDTH, margins=(13, 3, 9, 5))
    figure.subplots_adjust(wspace=0.22, hspace=0.3)
    axes = figure.subplots(2, 2).ravel()
    draw_arch(axes[0], arch)
    axes[0].set_title("(a)")
    for panel, name in zip(axes[1:], "bcd", strict=True):
        _panel(panel, name, [curve for curve in curves if curve.panel == name])
    return figure


def draw_arch(panel: Axes, arch: Arch) -> None:
    """Draw an arch at rest, displaced, its hinges and its thrust line at onset."""
    rotation = 0.6 * arch.mechanism().critical_rotation
    for outline in arch.outline(rotation):
        panel.fill(*outline.T, facecolor="0.88", edgecolor="0.5", linewidth=0.5)
    for outline in arch.outline():
        panel.fill(*outline.T, fill=False, linewidth=0.7, linestyle="--")
    panel.plot(*arch.thrust_line().T, color="#D55E00", linewidth=1.2, label="thrust line at onset")
    panel.plot(*np.asarray(arch.hinges()).T, "o", color="white", markeredgecolor="black", label="hinges")
    panel.set_aspect("equal", adjustable="datalim")
    panel.margins(0.05)
    panel.set_xlabel("[m]")
    panel.set_ylabel("[m]")
    panel.legend(loc="lower center")


@styled
def pulse_map(frequency_ratios: np.ndarray, amplitude_ratios: np.ndarray, ratios: np.ndarray) -> Figure:
    """Draw φ_max/φ_cr (m, n) under one sine over ω (m,) and a (n,): lines, and hatching where the block overturns."""
    figure = new_figure(90, 120)
    panel = figure.subplots()
    overturns = np.isinf(ratios)
    shown = np.where(overturns, np.nan, ratios).T
    # Before the lines, whose labels are placed and turned as the axes stand then.
    plain_logarithmic(panel, "x")
    plain_logarithmic(panel, "y")
    panel.set(xlim=frequency_ratios[[0, -1]], ylim=amplitude_ratios[[0, -1]])
    levels = [0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9]
    lines = panel.contour(
        frequency_ratios, amplitude_ratios, shown, levels=levels, colors="black", linewidths=0.5
    )
    # On one amplitude, where the lines lie apart: near the uplift acceleration they lie on top of each other.
    row = shown[np.abs(amplitude_ratios - _LABELLED_AMPLITUDE).argmin()]
    places = [
        (frequency_ratios[np.flatnonzero(row >= level)[-1]], _LABELLED_AMPLITUDE) for level in levels[1::2]
    ]
    panel.clabel(lines, levels[1::2], fontsize=7, fmt="%g", manual=places)
    field = overturns.T.astype(float)
    panel.contourf(
        frequency_ratios, amplitude_ratios, field, levels=[0.5, 1.5], colors="0.85", hatches=["///"]
    )
    panel.set_xlabel("ω = pulse frequency / frequency parameter [-]")
    panel.set_ylabel("a = pulse amplitude / uplift acceleration [-]")
    return figure
