"""Figures of the ground motion and of the responses to it."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.pulses.pulse import Pulse
from rocking.records.accelerogram import Accelerogram
from rocking.reports.style import TEXT_WIDTH, elided, new_figure, plain_logarithmic, styled, thinned

_PANEL_COLUMNS = 3
_PANEL_HEIGHT = 25.0
_MARGIN_HEIGHT = 6.0
_LEVELS = (0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)
"""Rotation ratios of the lines of a spectrum."""
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.6, "alpha": 0.85}
"""Behind a text that lines may cross."""
_STILL = 0.01
"""Share of the largest rotation below which a history is cut from the figure."""


@dataclass(frozen=True, eq=False)
class History:
    """One response as a panel shows it: rotation over critical rotation against time, and what was predicted.

    times: (k,) s. ratio: (k,) signed; both empty where there is no uplift. predicted: largest rotation ratio of the
    closed form (inf if it overturns, nan if there is none). remark: what the curve does not show.
    """

    label: str
    times: np.ndarray
    ratio: np.ndarray
    predicted: float
    remark: str = ""


@styled
def ground_motion(
    accelerogram: Accelerogram, pulse: Pulse | None, uplift: Sequence[float], height: float = 58.0
) -> Figure:
    """Draw acceleration with pulse and uplift accelerations [m/s²], and what the pulse leaves of it."""
    figure = new_figure(height, margins=(17, 2, 8.5, 5))
    figure.subplots_adjust(hspace=0.12)
    axes = figure.subplots(2, 1, sharex=True, sharey=True)
    times = accelerogram.times
    residual = (
        accelerogram.acceleration if pulse is None else accelerogram.acceleration - pulse.acceleration(times)
    )
    for panel, trace, label in zip(
        axes, (accelerogram.acceleration, residual), ("record", "residual"), strict=True
    ):
        panel.plot(*thinned(times, trace), color="0.35", linewidth=0.5, label="record")
        panel.axhline(0, color="0.6", linewidth=0.3)
        panel.set_ylabel(label)
        panel.yaxis.set_label_coords(-0.04, 0.5)
        panel.set_xlim(0, accelerogram.duration)
        if pulse is not None:
            panel.axvspan(pulse.start_time, pulse.end_time, color="0.93", linewidth=0, zorder=0)
    if pulse is not None:
        inside = np.linspace(pulse.start_time, pulse.end_time, 121)
        axes[0].plot(
            inside, pulse.acceleration(inside), color="#D55E00", linewidth=1.5, label="dominant pulse"
        )
    _uplift_lines(axes[0], uplift, accelerogram.peak_acceleration)
    axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=3)
    axes[-1].set_xlabel("time after the first sample [s]")
    figure.text(0.006, 0.55, "acceleration [m/s²]", va="center", rotation="vertical")
    return figure


def _uplift_lines(panel: Axes, uplift: Sequence[float], peak: float) -> None:
    """Draw the outermost across the panel, those between as marks at its ends: many lines would hide the record."""
    levels = sorted({value for value in uplift if value <= 1.3 * peak})
    for place, level in enumerate(levels):
        outermost = place in (0, len(levels) - 1)
        spans = [(0.0, 1.0)] if outermost else [(0.0, 0.012), (0.988, 1.0)]
        for signed in (level, -level):
            label = "uplift accelerations" if place == 0 and signed > 0 else "_"
            for left, right in spans:
                line = panel.axhline(signed, left, right, color="#0072B2", linewidth=0.6, label=label)
                line.set_linestyle(":" if outermost else "-")


@styled
def response_histories(histories: Sequence[History]) -> Figure:
    """Draw each response in its own panel: the integration solid, the predicted maximum dash-dot (as Fig. 8)."""
    columns = min(_PANEL_COLUMNS, len(histories))
    rows = math.ceil(len(histories) / columns)
    figure = new_figure(_PANEL_HEIGHT * rows + _MARGIN_HEIGHT, margins=(16, 2, 9.5, 4))
    figure.subplots_adjust(wspace=0.3, hspace=0.34)
    axes = figure.subplots(rows, columns, sharex=True, squeeze=False).ravel()
    begin, end = _window(histories)
    for panel, history in zip(axes, histories, strict=False):
        _history_panel(panel, history)
        panel.set_xlim(begin, end)
    for panel in axes[len(histories) :]:
        panel.remove()
    for panel in axes[max(0, len(histories) - columns) : len(histories)]:
        panel.tick_params(labelbottom=True)
    figure.text(0.5, 0.5 / figure.get_figheight() / 25.4, "time after the first sample [s]", ha="center")
    label = "rotation / critical rotation [-]" if rows > 1 else "rotation ratio [-]"
    figure.text(0.006, 0.5, label, va="center", rotation="vertical")
    return figure


def _history_panel(panel: Axes, history: History) -> None:
    panel.set_title(elided(history.label, 30))
    panel.axhline(0, color="0.6", linewidth=0.3)
    if history.times.size:
        panel.plot(*thinned(history.times, history.ratio, 1500), color="black", linewidth=0.7)
    if 0 < history.predicted < math.inf:
        for level in (history.predicted, -history.predicted):
            panel.axhline(level, color="#0072B2", linewidth=1.0, linestyle="-.")
    reach = _reach(history)
    panel.set_ylim(-reach, reach)
    panel.locator_params(axis="y", nbins=5)
    panel.ticklabel_format(axis="y", style="plain", useOffset=False)
    if history.remark:
        panel.text(
            0.99,
            0.02,
            history.remark,
            transform=panel.transAxes,
            ha="right",
            va="bottom",
            fontsize=7,
            bbox=_PAPER,
        )


def _reach(history: History) -> float:
    """Half the height of a panel: enough for the response and the prediction, no further than 1.4 φ_cr."""
    levels = [float(np.abs(history.ratio).max())] if history.ratio.size else []
    if 0 < history.predicted < math.inf:
        levels.append(history.predicted)
    return min(1.25 * max(levels), 1.4) if levels and max(levels) > 0 else 1.0


def _window(histories: Sequence[History]) -> tuple[float, float]:
    """The span of time in which anything moves."""
    begins, ends = [], []
    for history in histories:
        size = np.abs(history.ratio)
        moving = np.flatnonzero(size > _STILL * size.max()) if size.size else np.empty(0, int)
        if moving.size:
            begins.append(history.times[moving[0]])
            ends.append(history.times[moving[-1]])
    if not begins:
        return 0.0, 1.0
    margin = 0.05 * (max(ends) - min(begins)) + 1e-3
    return max(0.0, min(begins) - margin), max(ends) + margin


@styled
def rocking_spectrum_figure(
    frequency_parameters: np.ndarray,
    uplift_multipliers: np.ndarray,
    ratios: np.ndarray,
    structures: Sequence[tuple[str, float, float]],
    width: float = TEXT_WIDTH,
) -> Figure:
    """Draw rotation ratios (m, n) over p (m,) [rad/s] and λ (n,) with structures (label, p, λ) on them."""
    figure = new_figure(54, width, margins=(14, 2, 8.5, 1))
    panel = figure.subplots()
    shown = np.where(np.isfinite(ratios), np.minimum(ratios, 1.5), 1.5).T
    overturned = np.isinf(ratios).T.astype(float)
    panel.contourf(
        frequency_parameters,
        uplift_multipliers,
        shown,
        levels=[0, *_LEVELS, 1.5],
        cmap="Greys",
        vmin=0,
        vmax=4,
    )
    lines = panel.contour(
        frequency_parameters, uplift_multipliers, shown, levels=_LEVELS[1:-1], colors="black", linewidths=0.5
    )
    panel.clabel(lines, fontsize=7, fmt="%g")
    if overturned.any():
        panel.contourf(
            frequency_parameters,
            uplift_multipliers,
            overturned,
            levels=[0.5, 1.5],
            colors="none",
            hatches=["///"],
        )
    plain_logarithmic(panel, "x")
    plain_logarithmic(panel, "y")
    _place(panel, structures)
    panel.set_xlabel("frequency parameter p [rad/s]")
    panel.set_ylabel("uplift acceleration λ [g]")
    return figure


def _place(panel: Axes, structures: Sequence[tuple[str, float, float]]) -> None:
    for label, frequency_parameter, uplift_multiplier in structures:
        panel.plot(
            frequency_parameter, uplift_multiplier, "o", color="white", markeredgecolor="black", markersize=5
        )
        panel.annotate(
            elided(label, 24),
            (frequency_parameter, uplift_multiplier),
            xytext=(5, 3),
            textcoords="offset points",
            bbox=_PAPER,
        )
