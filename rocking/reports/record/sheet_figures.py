"""The record sheet: spectrum, pulse, energy, velocity and displacement of one component in one figure."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import LogLocator

from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import RecordMeasures
from rocking.records.processing import displacement, velocity
from rocking.records.response_spectrum import ResponseSpectrum
from rocking.reports.style import elided, new_figure, plain_logarithmic, styled, thinned

SHEET_HEIGHTS = (105.0, 72.0)
"""Height of the sheet of a single component, and of each of several, mm: two stand on a page with their table."""
ZOOM_PERIODS = 2.0
"""Periods of the pulse that are shown before and after its middle."""
_PULSE, _VELOCITY_PULSE, _UPLIFT = "#D55E00", "#009E73", "#0072B2"
_TRACE_POINTS = 2000
_PERIOD_TICKS = (0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0)
_LABEL_SIZE = (0.3, 0.3)
"""Width and height of a label on the logarithmic axes of the spectrum: nearer structures share one."""
_PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 0.4, "alpha": 0.8}

Place = tuple[float, float]


@dataclass(frozen=True, eq=False)
class RecordSheet:
    """What the sheet of one component shows.

    structures: (label, frequency parameter p [rad/s], uplift multiplier λ) of each equivalent block. velocity_pulse:
    T_p and the time of its middle, s; None where there is none.
    """

    accelerogram: Accelerogram
    measures: RecordMeasures
    spectrum: ResponseSpectrum
    pulse: Pulse | None
    velocity_pulse: Place | None
    structures: Sequence[tuple[str, float, float]]


@styled
def record_sheet(sheet: RecordSheet, height: float = SHEET_HEIGHTS[0]) -> Figure:
    """Draw the spectrum with the structures on it, the pulse, and Husid plot, velocity and displacement over time."""
    figure = new_figure(height, margins=(14, 2, 8.5, 5))
    halves = figure.add_gridspec(1, 2, wspace=0.22, width_ratios=[1, 1.02])
    spectrum, zoom = np.asarray(halves[0].subgridspec(2, 1, hspace=0.42, height_ratios=[1.7, 1]).subplots())
    energy, *traces = np.asarray(halves[1].subgridspec(3, 1, hspace=0.14).subplots(sharex=True))
    _spectrum_panel(spectrum, sheet)
    _pulse_panel(zoom, sheet.accelerogram, sheet.pulse)
    _husid_panel(energy, sheet)
    integrals = _integrals(sheet.accelerogram)
    for panel, (label, trace) in zip(traces, integrals, strict=True):
        _trace_panel(panel, sheet, label, trace)
    if sheet.pulse is not None:
        _pulse_integrals(traces, sheet.pulse, sheet.accelerogram, [trace for _, trace in integrals])
    _pulse_spans(traces[0], sheet)
    for panel in (energy, *traces):
        panel.yaxis.set_label_coords(-0.135, 0.5)
    traces[-1].set_xlabel("time after the first sample [s]")
    return figure


def _spectrum_panel(panel: Axes, sheet: RecordSheet) -> None:
    periods, acceleration = sheet.spectrum.periods, sheet.spectrum.pseudo_acceleration
    panel.plot(periods, acceleration, color="black", linewidth=1.0)
    places = [(2 * math.pi / p, GRAVITY * multiplier) for _, p, multiplier in sheet.structures]
    levels = [level for _, level in places]
    _uplift_levels(panel, levels)
    for label, place in _labelled(places, [label for label, _, _ in sheet.structures]):
        above = (3, 11 if "," in label else 4)  # a joined label clears those of single neighbours
        panel.annotate(
            elided(label, 20), place, xytext=above, textcoords="offset points", ha="right", bbox=_PAPER
        )
    panel.plot(*np.array(places).reshape(-1, 2).T, "o", color="white", markeredgecolor=_UPLIFT, markersize=4)
    _period_lines(panel, sheet)
    reached = [value for value in (acceleration.min(), acceleration.max(), *levels) if value > 0] or [1.0]
    panel.set_ylim(0.7 * min(reached), 1.6 * max(reached))
    longest = max([periods[-1], *(1.25 * period for period, _ in places)])
    panel.set_xlim(periods[0], longest)
    for which in "xy":
        plain_logarithmic(panel, which)
    panel.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
    panel.set_xticks([period for period in _PERIOD_TICKS if periods[0] < period < longest])
    panel.set_xlabel("period T, or 2π/p of a structure [s]")
    panel.set_ylabel(f"PSA, {100 * sheet.spectrum.damping:g} % [m/s²]")


def _labelled(places: Sequence[Place], labels: Sequence[str]) -> list[tuple[str, Place]]:
    """Return the labels with their places; those of neighbours are joined above the rightmost, lest they overlap."""
    groups: list[list[int]] = []
    for number in sorted(range(len(places)), key=lambda number: places[number]):
        near = (group for group in groups if _touch(places[number], places[group[-1]]))
        group = next(near, None)
        if group is None:
            groups.append([number])
        else:
            group.append(number)
    return [
        (
            ", ".join(labels[number] for number in sorted(group)),
            (places[group[-1]][0], max(places[number][1] for number in group)),
        )
        for group in groups
    ]


def _touch(one: Place, other: Place) -> bool:
    return all(abs(math.log(a / b)) < size for a, b, size in zip(one, other, _LABEL_SIZE, strict=True))


def _uplift_levels(panel: Axes, levels: Sequence[float]) -> None:
    """The lowest and the highest across the panel: all of them would hide the spectrum, and each has its mark."""
    for level in {min(levels), max(levels)} if levels else ():
        panel.axhline(level, color=_UPLIFT, linewidth=0.6, linestyle=":")
    if levels:
        panel.annotate(
            "uplift gλ",
            (0.01, min(levels)),
            xycoords=("axes fraction", "data"),
            xytext=(0, 1.5),
            textcoords="offset points",
            color=_UPLIFT,
        )


def _period_lines(panel: Axes, sheet: RecordSheet) -> None:
    """The periods of sine and velocity pulse, the shorter named to the left of its line."""
    drawn = []
    if sheet.pulse is not None:
        drawn.append((sheet.pulse.period, "$T_g$", _PULSE, "-."))
    if sheet.velocity_pulse is not None:
        drawn.append((sheet.velocity_pulse[0], "$T_p$", _VELOCITY_PULSE, "--"))
    for side, (period, name, colour, style) in zip(("right", "left"), sorted(drawn), strict=False):
        panel.axvline(period, color=colour, linewidth=0.9, linestyle=style)
        panel.annotate(
            name,
            (period, 1.0),
            xycoords=("data", "axes fraction"),
            xytext=(0, 1.5),
            textcoords="offset points",
            ha=side,
            color=colour,
            parse_math=True,
        )


def _pulse_panel(panel: Axes, accelerogram: Accelerogram, pulse: Pulse | None) -> None:
    panel.axhline(0, color="0.6", linewidth=0.3)
    panel.set_ylabel("accel. [m/s²]")
    panel.set_xlabel("time, two periods before and after the pulse [s]")
    if pulse is None:
        panel.text(0.5, 0.6, "no pulse could be sought", transform=panel.transAxes, ha="center")
        return
    middle, reach = (pulse.start_time + pulse.end_time) / 2, ZOOM_PERIODS * pulse.period
    begin, end = middle - reach, middle + reach
    times = accelerogram.times
    shown = (times >= begin) & (times <= end)
    panel.plot(
        *thinned(times[shown], accelerogram.acceleration[shown], _TRACE_POINTS), color="0.35", linewidth=0.6
    )
    inside = np.linspace(pulse.start_time, pulse.end_time, 121)
    panel.plot(inside, pulse.acceleration(inside), color=_PULSE, linewidth=1.5)
    panel.axvspan(pulse.start_time, pulse.end_time, color="0.93", linewidth=0, zorder=0)
    panel.set_xlim(begin, end)


def _husid_panel(panel: Axes, sheet: RecordSheet) -> None:
    measures = sheet.measures
    panel.plot(*thinned(sheet.accelerogram.times, measures.husid, _TRACE_POINTS), color="black")
    _significant(panel, measures)
    panel.set_ylim(0, 1.05)
    panel.set_yticks([0.05, 0.5, 0.95], ["5 %", "50 %", "95 %"])
    panel.set_ylabel("Arias share")
    panel.set_title(
        f"$I_A$ = {measures.arias_intensity:.3g} m/s, $D_{{5–95}}$ = {measures.significant_duration:.3g} s",
        parse_math=True,
    )


def _integrals(accelerogram: Accelerogram) -> list[tuple[str, np.ndarray]]:
    return [("vel. [m/s]", velocity(accelerogram)), ("displ. [m]", displacement(accelerogram))]


def _pulse_integrals(
    panels: Sequence[Axes], pulse: Pulse, accelerogram: Accelerogram, traces: Sequence[np.ndarray]
) -> None:
    """Velocity and displacement of the pulse, which start from those of the record."""
    times = np.linspace(pulse.start_time, pulse.end_time, 121)
    after, omega = times - pulse.start_time, pulse.circular_frequency
    start_velocity, start_displacement = (
        np.interp(pulse.start_time, accelerogram.times, trace) for trace in traces
    )
    drift = pulse.amplitude / omega
    curves = (
        start_velocity + drift * (1 - np.cos(omega * after)),
        start_displacement + (start_velocity + drift) * after - drift / omega * np.sin(omega * after),
    )
    for panel, curve in zip(panels, curves, strict=True):
        panel.plot(times, curve, color=_PULSE, linewidth=1.2)


def _trace_panel(panel: Axes, sheet: RecordSheet, label: str, trace: np.ndarray) -> None:
    accelerogram = sheet.accelerogram
    panel.plot(*thinned(accelerogram.times, trace, _TRACE_POINTS), color="0.35", linewidth=0.6)
    panel.axhline(0, color="0.6", linewidth=0.3)
    largest = int(np.argmax(np.abs(trace)))
    peak = largest * accelerogram.time_step, trace[largest]
    panel.plot(*peak, "o", color="black", markersize=3)
    panel.annotate(f"{abs(peak[1]):.3g}", peak, xytext=(4, -2), textcoords="offset points", va="center")
    _significant(panel, sheet.measures)
    panel.set_xlim(0, accelerogram.duration)
    panel.set_ymargin(0.12)
    panel.set_ylabel(label)


def _pulse_spans(panel: Axes, sheet: RecordSheet) -> None:
    """The time of the sine pulse and of the velocity pulse as bars at the top of a panel."""
    spans = []
    if sheet.pulse is not None:
        spans.append((sheet.pulse.start_time, sheet.pulse.end_time, _PULSE))
    if sheet.velocity_pulse is not None:
        period, middle = sheet.velocity_pulse
        spans.append((middle - period / 2, middle + period / 2, _VELOCITY_PULSE))
    for level, (begin, end, colour) in zip((1.0, 0.94), spans, strict=False):
        panel.plot(
            [begin, end],
            [level, level],
            color=colour,
            linewidth=2,
            solid_capstyle="butt",
            transform=panel.get_xaxis_transform(),
            clip_on=False,
        )


def _significant(panel: Axes, measures: RecordMeasures) -> None:
    panel.axvspan(*measures.significant_times, color="0.93", linewidth=0, zorder=0)
