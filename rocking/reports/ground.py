"""The pictures of the ground in a record's report: acceleration and pulses."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import record_measures
from rocking.reports.panels import draw_energy_map, draw_motion
from rocking.reports.style import TEXT_WIDTH, elided, fixed_ticks, new_figure, panel_at, styled

POINTS = 1200
"""Points of a trace of a report: no printer shows more on the width of a page."""
_ZOOM = 1.5
"""Periods of the pulse that are shown before and after it."""
_MAP_COLUMNS = 240
_MARGIN = 0.15
"""Share of the strong shaking that is shown before and after it."""


@dataclass(frozen=True, eq=False)
class Motion:
    """One component of the ground with its ranked pulses, the dominant one first."""

    accelerogram: Accelerogram
    pulses: Sequence[Pulse]

    @cached_property
    def span(self) -> tuple[float, float]:
        """The time of 5 to 95 % of the Arias intensity with a margin, and of the dominant pulse, s."""
        begin, end = record_measures(self.accelerogram).significant_times
        for pulse in self.pulses[:1]:
            begin, end = min(begin, pulse.start_time), max(end, pulse.end_time)
        if not end > begin:  # nothing shakes
            return 0.0, self.accelerogram.duration
        margin = _MARGIN * (end - begin)
        return max(0.0, begin - margin), min(self.accelerogram.duration, end + margin)

    @property
    def name(self) -> str:
        """The component, as a figure names it."""
        return elided(self.accelerogram.component or "component", 14)


def shared_span(motions: Sequence[Motion]) -> tuple[float, float]:
    """Return the time in which any of the components shakes strongly, s."""
    return min(motion.span[0] for motion in motions), max(motion.span[1] for motion in motions)


@styled
def ground_figure(motions: Sequence[Motion]) -> Figure:
    """Draw the acceleration of each component with its dominant pulse, one below the other."""
    height = 19.0
    figure = new_figure(height * len(motions) + 8)
    for place, motion in enumerate(motions):
        panel = panel_at(figure, 14, 1 + place * height, TEXT_WIDTH - 16, height - 3)
        draw_ground(panel, motion, shared_span(motions), motion is motions[-1])
    return figure


def draw_ground(panel: Axes, motion: Motion, span: tuple[float, float], last: bool) -> None:
    """Draw the acceleration of a component within `span` [s], its dominant pulse and PGA; the last one names time."""
    accelerogram = motion.accelerogram
    draw_motion(panel, accelerogram, next(iter(motion.pulses), None), span, POINTS)
    amplitudes = [abs(each.amplitude) for each in motion.pulses[:1]]
    reach = 1.1 * max(accelerogram.peak_acceleration, *amplitudes, 1e-9)
    fixed_ticks(panel, "y", -reach, reach, 3)
    peak = f"{motion.name}: PGA {accelerogram.peak_acceleration / GRAVITY:.2g} g"
    panel.text(0.995, 0.97, peak, transform=panel.transAxes, ha="right", va="top")
    panel.set_ylabel("[m/s²]")
    _time_axis(panel, span, last)


def _time_axis(panel: Axes, span: tuple[float, float], last: bool) -> None:
    fixed_ticks(panel, "x", *span, 6)
    panel.tick_params(labelbottom=last)
    panel.set_xlabel("time after the first sample [s]" if last else "")


@styled
def pulses_figure(motions: Sequence[Motion]) -> Figure:
    """Draw of each component the dominant pulse in the record, and the energy of a pulse over onset and period."""
    from rocking.pulses import energy_map  # which loads the compiled scan

    height = 36.0
    figure = new_figure(height * len(motions))
    for place, motion in enumerate(motions):
        accelerogram, pulse = motion.accelerogram, motion.pulses[0]
        near, energy = (panel_at(figure, left, 3 + place * height, 69, 24) for left in (14, 100))
        zoom = _ZOOM * pulse.period
        span = max(pulse.start_time - zoom, 0.0), min(pulse.end_time + zoom, accelerogram.duration)
        draw_ground(near, motion, span, last=True)
        # of several onsets the largest gain: no printer shows more
        gains, frequencies = energy_map(accelerogram)
        starts = np.arange(0, gains.shape[0], max(1, gains.shape[0] // _MAP_COLUMNS))
        gains = np.maximum.reduceat(gains, starts, axis=0)
        draw_energy_map(energy, starts * accelerogram.time_step, 1 / frequencies, gains, motion.pulses)
        fixed_ticks(energy, "x", *motion.span, 6)
    return figure
