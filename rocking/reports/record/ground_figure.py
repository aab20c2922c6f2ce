"""The figure of the ground motion: acceleration, its dominant pulse, and what that leaves."""

from collections.abc import Sequence

import numpy as np

from rocking.pulses.pulse import Pulse
from rocking.records.accelerogram import Accelerogram
from rocking.reports.paper.canvas import SIZE, TEXT_WIDTH, Box, Canvas
from rocking.reports.paper.panel import GREY, GRID, Panel, panels_in
from rocking.reports.paper.scales import Scale, spanning

PULSE, UPLIFT = "#D55E00", "#0072B2"
"""Colours of the sine pulse and of what lifts a structure."""
_RISE = 1.3
"""Uplift accelerations beyond this share of the peak are not drawn."""
_SIDE_MARK = 0.012


def ground_motion(
    accelerogram: Accelerogram, pulse: Pulse | None, uplift: Sequence[float], height: float
) -> Canvas:
    """Draw acceleration with pulse and uplift accelerations [m/s²], and what the pulse leaves of it. height: mm."""
    canvas = Canvas(TEXT_WIDTH, height)
    times, samples = accelerogram.times, accelerogram.acceleration
    residual = samples if pulse is None else samples - pulse.acceleration(times)
    shared = Scale(0.0, accelerogram.duration), spanning(samples, residual)
    boxes = panels_in(Box(17, 5, TEXT_WIDTH - 2, height - 8.5), 2, 1, (0, 3))
    record, left = (Panel(canvas, box, *shared) for box in boxes)
    for panel, trace, name in ((record, samples, "record"), (left, residual, "residual")):
        if pulse is not None:
            panel.band(pulse.start_time, pulse.end_time)
        panel.level(0.0, GRID, 0.3)
        panel.trace(times, trace, GREY)
        last = panel is left
        panel.frame("time after the first sample [s]" if last else "", name, aside=7.5, numbered=last)
    entries = [("record", GREY, 0.5, "")]
    if pulse is not None:
        inside = np.linspace(pulse.start_time, pulse.end_time, 121)
        record.line(inside, pulse.acceleration(inside), PULSE, 1.5)
        entries.append(("dominant pulse", PULSE, 1.5, ""))
    if _uplift_lines(record, uplift, accelerogram.peak_acceleration):
        entries.append(("uplift accelerations", UPLIFT, 0.6, "dotted"))
    record.legend(entries)
    canvas.text((3.2, (height - 3.5) / 2), "acceleration [m/s²]", SIZE, "middle", "bottom", turned=True)
    return canvas


def _uplift_lines(panel: Panel, uplift: Sequence[float], peak: float) -> bool:
    """Draw the outermost across the panel, those between as marks at its ends: many lines would hide the record."""
    levels = sorted({value for value in uplift if value <= _RISE * peak})
    for place, level in enumerate(levels):
        outermost = place in (0, len(levels) - 1)
        for signed in (level, -level):
            for span in [(0.0, 1.0)] if outermost else [(0.0, _SIDE_MARK), (1 - _SIDE_MARK, 1.0)]:
                panel.level(signed, UPLIFT, 0.6, "dotted" if outermost else "", span)
    return bool(levels)
