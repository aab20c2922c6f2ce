"""The record sheet: spectrum, pulse, energy, velocity and displacement of one component in one figure."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from rocking.pulses.pulse import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import RecordMeasures, ResponseSpectrum
from rocking.records.processing import displacement, velocity
from rocking.reports.paper.canvas import SMALL, TEXT_WIDTH, Box, Canvas, Symbol
from rocking.reports.paper.labels import draw_labels, placed_labels
from rocking.reports.paper.panel import GREY, GRID, Panel, panels_in
from rocking.reports.paper.scales import Scale, spanning
from rocking.reports.record.ground_figure import PULSE, UPLIFT

SHEET_HEIGHTS = (105.0, 72.0)
"""Height of the sheet of a single component, and of each of several, mm: two stand on a page with their table."""
ZOOM_PERIODS = 2.0
"""Periods of the pulse that are shown before and after its middle."""
SHARED = 2.4
"""Up to how near structures share a number, mm; where there are too many for that, none has one."""
_VELOCITY_PULSE = "#009E73"
_ASIDE = 9.5
"""From the axes of the right half to their labels, mm."""

Place = tuple[float, float]


@dataclass(frozen=True, eq=False)
class RecordSheet:
    """What the sheet of one component shows.

    structures: (number, frequency parameter p [rad/s], uplift multiplier λ) of each equivalent block. velocity_pulse:
    T_p and the time of its middle, s; None where there is none.
    """

    accelerogram: Accelerogram
    measures: RecordMeasures
    spectrum: ResponseSpectrum
    pulse: Pulse | None
    velocity_pulse: Place | None
    structures: Sequence[tuple[str, float, float]]


def record_sheet(sheet: RecordSheet, height: float = SHEET_HEIGHTS[0]) -> Canvas:
    """Draw the spectrum with the structures on it, the pulse, and Husid plot, velocity and displacement over time."""
    canvas = Canvas(TEXT_WIDTH, height)
    middle, low = TEXT_WIDTH / 2, height - 8.5
    parted = 5 + 0.56 * (low - 5)
    _spectrum_panel(canvas, Box(14, 5, middle - 1, parted), sheet)
    _pulse_panel(canvas, Box(14, parted + 12, middle - 1, low), sheet.accelerogram, sheet.pulse)
    time = Scale(0.0, sheet.accelerogram.duration)
    energy, *traces = panels_in(Box(middle + 16, 5, TEXT_WIDTH - 2, low), 3, 1, (0, 3))
    _husid_panel(Panel(canvas, energy, time, Scale(0, 1.05)), sheet)
    integrals = velocity(sheet.accelerogram), displacement(sheet.accelerogram)
    of_pulse = (
        _pulse_integrals(sheet.pulse, sheet.accelerogram, integrals) if sheet.pulse is not None else None
    )
    for place, (box, trace) in enumerate(zip(traces, integrals, strict=True)):
        panel = Panel(
            canvas,
            box,
            time,
            spanning(trace, *(() if of_pulse is None else of_pulse[1][place : place + 1]), margin=0.12),
        )
        _trace_panel(panel, sheet, trace)
        if of_pulse is not None:
            panel.line(of_pulse[0], of_pulse[1][place], PULSE, 1.2)
        label, last = ("vel. [m/s]", "displ. [m]")[place], place == 1
        panel.frame("time after the first sample [s]" if last else "", label, aside=_ASIDE, numbered=last)
        if place == 0:
            _pulse_spans(panel, sheet)
    return canvas


def _spectrum_panel(canvas: Canvas, box: Box, sheet: RecordSheet) -> None:
    periods, acceleration = sheet.spectrum.periods, sheet.spectrum.pseudo_acceleration
    blocks = np.array(
        [(2 * math.pi / p, GRAVITY * multiplier) for _, p, multiplier in sheet.structures]
    ).reshape(-1, 2)
    reached = [
        value
        for value in (*acceleration[[0, -1]], acceleration.min(), acceleration.max(), *blocks[:, 1])
        if value > 0
    ]
    longest = max([periods[-1], *(1.25 * blocks[:, 0])])
    height = Scale(0.7 * min(reached, default=1.0), 1.6 * max(reached, default=1.0), logarithmic=True)
    panel = Panel(canvas, box, Scale(periods[0], longest, logarithmic=True), height)
    curve = panel.places(periods, np.maximum(acceleration, height.low))
    if len(blocks):
        for level in {blocks[:, 1].min(), blocks[:, 1].max()}:
            panel.level(level, UPLIFT, 0.6, "dotted")
        lowest = panel.places(periods[0], blocks[:, 1].min())[0]
        canvas.text(lowest + np.array([0.8, -0.2]), "uplift gλ", SMALL, colour=UPLIFT)
    panel.line(periods, acceleration, "black", 1.0)
    places = panel.places(*blocks.T)
    panel.marks(places, UPLIFT)
    numbers = [int(label) for label, _, _ in sheet.structures]
    draw_labels(canvas, placed_labels(places, numbers, box, curve, SHARED))
    _period_lines(panel, sheet)
    panel.frame("period T, or 2π/p of a structure [s]", f"PSA, {100 * sheet.spectrum.damping:g} % [m/s²]")


def _period_lines(panel: Panel, sheet: RecordSheet) -> None:
    """The periods of sine and velocity pulse, the shorter named to the left of its line."""
    drawn = []
    if sheet.pulse is not None:
        drawn.append((sheet.pulse.period, "T_g", PULSE, "dash-dot"))
    if sheet.velocity_pulse is not None:
        drawn.append((sheet.velocity_pulse[0], "T_p", _VELOCITY_PULSE, "dashed"))
    for side, (period, name, colour, dash) in zip(("right", "left"), sorted(drawn), strict=False):
        panel.upright(period, colour, 0.9, dash)
        (place, _) = panel.places(period, panel.y.high)[0]
        air = 0.4 if side == "left" else -0.4
        panel.canvas.text((place + air, panel.box.top - 0.3), Symbol(name), across=side, colour=colour)


def _pulse_panel(canvas: Canvas, box: Box, accelerogram: Accelerogram, pulse: Pulse | None) -> None:
    labels = "time, two periods before and after the pulse [s]", "accel. [m/s²]"
    if pulse is None:
        panel = Panel(canvas, box, Scale(0, 1), Scale(-1, 1))
        panel.frame(*labels, x_ticks=())
        canvas.text(((box.left + box.right) / 2, box.top + 4), "no pulse could be sought", across="middle")
        return
    middle, reach = (pulse.start_time + pulse.end_time) / 2, ZOOM_PERIODS * pulse.period
    inside = np.linspace(pulse.start_time, pulse.end_time, 121)
    near = np.abs(accelerogram.times - middle) <= reach
    samples, drawn = accelerogram.acceleration[near], pulse.acceleration(inside)
    panel = Panel(canvas, box, Scale(middle - reach, middle + reach), spanning(samples, drawn))
    panel.band(pulse.start_time, pulse.end_time)
    panel.level(0.0, GRID, 0.3)
    panel.trace(accelerogram.times[near], samples, GREY, 0.6)
    panel.line(inside, drawn, PULSE, 1.5)
    panel.frame(*labels)


def _husid_panel(panel: Panel, sheet: RecordSheet) -> None:
    measures = sheet.measures
    panel.band(*measures.significant_times)
    panel.trace(sheet.accelerogram.times, measures.husid, "black", 0.8)
    shares = [(0.05, "5 %"), (0.5, "50 %"), (0.95, "95 %")]
    panel.frame("", "Arias share", y_ticks=shares, aside=_ASIDE, numbered=False)
    panel.title(
        Symbol(f"I_A = {measures.arias_intensity:.3g} m/s, D_5–95 = {measures.significant_duration:.3g} s")
    )


def _pulse_integrals(
    pulse: Pulse, accelerogram: Accelerogram, traces: Sequence[np.ndarray]
) -> tuple[np.ndarray, tuple[np.ndarray, np.ndarray]]:
    """Times of the pulse, and its velocity and displacement, which start from those of the record."""
    times = np.linspace(pulse.start_time, pulse.end_time, 121)
    after, omega = times - pulse.start_time, pulse.circular_frequency
    start_velocity, start_displacement = (
        np.interp(pulse.start_time, accelerogram.times, trace) for trace in traces
    )
    drift = pulse.amplitude / omega
    return times, (
        start_velocity + drift * (1 - np.cos(omega * after)),
        start_displacement + (start_velocity + drift) * after - drift / omega * np.sin(omega * after),
    )


def _trace_panel(panel: Panel, sheet: RecordSheet, trace: np.ndarray) -> None:
    """A trace over the significant duration, with its peak marked and named."""
    panel.band(*sheet.measures.significant_times)
    panel.level(0.0, GRID, 0.3)
    panel.trace(sheet.accelerogram.times, trace, GREY, 0.6)
    largest = int(np.argmax(np.abs(trace)))
    peak = panel.places(largest * sheet.accelerogram.time_step, trace[largest])[0]
    panel.canvas.circle(peak, 0.5, "black", "black")
    late = peak[0] > panel.box.left + 0.85 * panel.box.width
    side = "right" if late else "left"
    panel.canvas.text(
        peak + np.array([-1.2 if late else 1.2, 0]),
        f"{abs(trace[largest]):.3g}",
        SMALL,
        side,
        "middle",
        paper=True,
    )


def _pulse_spans(panel: Panel, sheet: RecordSheet) -> None:
    """The time of the sine pulse and of the velocity pulse as bars at the top of a panel."""
    spans = []
    if sheet.pulse is not None:
        spans.append((sheet.pulse.start_time, sheet.pulse.end_time, PULSE))
    if sheet.velocity_pulse is not None:
        period, middle = sheet.velocity_pulse
        spans.append((middle - period / 2, middle + period / 2, _VELOCITY_PULSE))
    for height, (begin, end, colour) in zip((0.0, 1.2), spans, strict=False):
        ends = panel.places(np.clip([begin, end], panel.x.low, panel.x.high), panel.y.high)
        panel.canvas.path(ends + np.array([0, height]), colour, 2.0)
