"""The figures of a record's report: ground, structures in their state, histories, pulses, comparison, measures."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D

from rocking.assessment.fate import Fate
from rocking.assessment.verdict import NEGLIGIBLE, Agreement, Verdict
from rocking.pulses import Pulse
from rocking.quantities import GRAVITY
from rocking.records.accelerogram import Accelerogram
from rocking.records.measures import record_measures, response_spectrum
from rocking.records.processing import displacement, velocity
from rocking.reports.drawings import draw_structure, fallen_rotation, round_length
from rocking.reports.panels import (
    Placed,
    draw_energy_map,
    draw_levels,
    draw_motion,
    draw_response_spectra,
    draw_rotation,
)
from rocking.reports.style import (
    PREDICTED,
    TEXT_WIDTH,
    elided,
    fixed_ticks,
    new_figure,
    panel_at,
    plain_logarithmic,
    styled,
    thinned,
)
from rocking.structures import Structure

LOOKS: dict[Verdict, tuple[str, str, str, str]] = {
    Verdict.OVERTURNS: ("▲", "#7a2400", "white", "xxxx"),
    Verdict.UNDECIDED: ("?", "#f0a030", "black", "///"),
    Verdict.UNKNOWN: ("–", "white", "black", ""),
    Verdict.STANDS: ("●", "#dceaf7", "black", ""),
}
"""Sign, colour, colour of letters on it, and pattern of each verdict: in print without colour the others tell it."""
_COLUMNS = 5
_CELL = (34.0, 67.0)
"""Structures of a row, and width and height of each, mm."""
_DRAWN = (30.0, 27.0)
"""Room for the structure itself, mm."""
_POINTS = 1200
"""Points of a trace of a report: no printer shows more on the width of a page."""
_HISTORIES, _HIGHEST_ROW = 160.0, 30.0
"""Height of all histories together, and of one at most, mm."""
_STILL = 0.01
"""Share of the largest rotation below which a history is cut."""
_HIGHEST = 1.25
"""Rotation ratio beyond which a history is not drawn."""
_SMALLEST, _FALLEN = 1e-3, 2.2
"""Rotation ratios at the left end of the comparison, and where overturning stands."""
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

    @property
    def dominant(self) -> Pulse | None:
        """The pulse that explains most."""
        return next(iter(self.pulses), None)

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


@dataclass(frozen=True)
class State:
    """A structure as page one draws it: cracked where that governs, with what is said below it in lines."""

    label: str
    structure: Structure
    fate: Fate
    lines: Sequence[str]


@dataclass(frozen=True, eq=False)
class History:
    """One response: rotation over critical rotation (k,) against time (k,) s, what was predicted, and a remark."""

    label: str
    times: np.ndarray
    ratio: np.ndarray
    predicted: float
    band: tuple[float, float] | None
    remark: str

    @property
    def reach(self) -> float:
        """Half of the height of its row: enough for the response and the prediction, no more than _HIGHEST."""
        levels = [float(np.abs(self.ratio).max(initial=0)), self.predicted]
        return min(1.25 * max((level for level in levels if 0 < level < math.inf), default=1.0), _HIGHEST)


@dataclass(frozen=True)
class Compared:
    """One case: rotation ratios (inf: overturns, nan: none) of closed form, block and mechanism, and how they agree."""

    label: str
    ratios: tuple[float, float, float]
    agreement: Agreement
    words: str


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
        _ground(panel, motion, shared_span(motions), motion is motions[-1])
    return figure


def _ground(panel: Axes, motion: Motion, span: tuple[float, float], last: bool) -> None:
    accelerogram = motion.accelerogram
    draw_motion(panel, accelerogram, motion.dominant, span, _POINTS)
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
def strip_figure(states: Sequence[State]) -> Figure:
    """Draw each structure in its state, to one scale each: standing, rocking to its largest rotation, or fallen."""
    rows = math.ceil(len(states) / _COLUMNS)
    width, height = _CELL
    figure = new_figure(rows * height, margins=(0, 0, 0, 0))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, TEXT_WIDTH), ylim=(-rows * height, 0))
    axes.set_axis_off()
    for place, state in enumerate(states):
        row, column = divmod(place, _COLUMNS)
        _draw_state(axes, state, (column + 0.5) * width, -row * height)
    return figure


def _draw_state(axes: Axes, state: State, middle: float, top: float) -> None:
    sign, colour, ink, hatch = LOOKS[state.fate.verdict]
    structure, rotation = state.structure, drawn_rotation(state.structure, state.fate)
    points = np.vstack([*structure.outline(), *structure.outline(rotation)])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = float(min(np.array(_DRAWN) / (high - low)))
    foot = np.array([middle, top - 7 - _DRAWN[1]])
    origin = np.array([(low[0] + high[0]) / 2, min(low[1], 0.0)])
    place = Affine2D().translate(*-origin).scale(scale).translate(*foot)
    look = {"facecolor": colour, "hatch": hatch, "edgecolor": "0.25", "linewidth": 0.6}
    draw_structure(axes, structure, rotation, look=look, place=place)
    axes.plot([middle - 15, middle + 15], [foot[1]] * 2, color="0.5", linewidth=0.6, zorder=0)
    axes.text(middle, top - 1, elided(state.label, 23), ha="center", va="top", fontweight="bold")
    bar = round_length(0.5 * _DRAWN[0] / scale)
    axes.plot([middle - bar * scale / 2, middle + bar * scale / 2], [foot[1] - 2.0] * 2, "k", linewidth=1.5)
    axes.text(middle + bar * scale / 2 + 1, foot[1] - 2.0, f"{bar:g} m", va="center", fontsize=7)
    frame = Rectangle(
        (middle - 16, foot[1] - 8.5), 32, 4.5, facecolor=colour, edgecolor="0.25", linewidth=0.5
    )
    axes.add_patch(frame)
    word = f"{sign} {state.fate.verdict}"
    axes.text(middle, foot[1] - 6.3, word, ha="center", va="center", color=ink, fontweight="bold")
    for line, text in enumerate(state.lines):
        axes.text(middle, foot[1] - 9.5 - 3.2 * line, text, ha="center", va="top", fontsize=7)


def drawn_rotation(structure: Structure, fate: Fate) -> float:
    """Return the signed rotation of a structure on page one, rad: fallen, at its largest rotation or at rest."""
    side = -1 if fate.peak_side == -1 else 1
    if math.isinf(fate.rotation_ratio) or fate.verdict is Verdict.OVERTURNS:
        return fallen_rotation(structure, side)
    if not fate.rotation_ratio > NEGLIGIBLE:
        return 0.0
    sides = structure.mechanism().sides
    return side * fate.rotation_ratio * sides[0 if side > 0 else -1].critical_rotation


@styled
def histories_figure(histories: Sequence[History], motions: Sequence[Motion]) -> Figure:
    """Draw the rotation of each structure, one below the other, and beneath them the ground, on one time axis.

    Each row has a scale of its own, which stands below its name.
    """
    row = min(_HIGHEST_ROW, _HISTORIES / len(histories))
    below, left, width = 20.0, 38.0, TEXT_WIDTH - 77
    figure = new_figure(row * len(histories) + below * len(motions) + 9)
    span = _window(histories)
    panel = panel_at(figure, left, 1, width, row * len(histories))
    beside: dict[str, Any] = {"transform": panel.get_yaxis_transform(), "va": "center", "fontsize": 7}
    for place, history in enumerate(histories):
        reach, level = history.reach, -float(place)
        draw_rotation(
            panel,
            history.times,
            np.clip(history.ratio, -reach, reach),
            history.predicted if history.predicted <= reach else math.inf,
            history.band and (min(history.band[0], reach), min(history.band[1], reach)),
            level=level,
            scale=0.45 / reach,
            most=_POINTS,
        )
        label = f"{elided(history.label, 22)}\n± {reach:.2g}"
        panel.text(-0.02, level, label, ha="right", linespacing=1.3, **beside)
        panel.text(1.01, level, history.remark, ha="left", linespacing=1.3, **beside)
    panel.set(xlim=span, ylim=(0.5 - len(histories), 0.5), xticks=[], yticks=[])
    panel.spines[["left", "bottom"]].set_visible(False)
    for place, motion in enumerate(motions):
        top = 2 + row * len(histories) + place * below
        _ground(panel_at(figure, left, top, width, below - 3), motion, span, motion is motions[-1])
    return figure


def _window(histories: Sequence[History]) -> tuple[float, float]:
    """The span of time in which anything moves."""
    moving = []
    for history in histories:
        size = np.abs(history.ratio)
        moving.append(history.times[size > _STILL * size.max(initial=0)])
    times = np.concatenate(moving)
    margin = 0.05 * float(np.ptp(times)) + 1e-3
    return max(0.0, float(times.min()) - margin), float(times.max()) + margin


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
        _ground(near, motion, span, last=True)
        # of several onsets the largest gain: no printer shows more
        gains, frequencies = energy_map(accelerogram)
        starts = np.arange(0, gains.shape[0], max(1, gains.shape[0] // _MAP_COLUMNS))
        gains = np.maximum.reduceat(gains, starts, axis=0)
        draw_energy_map(energy, starts * accelerogram.time_step, 1 / frequencies, gains, motion.pulses)
        fixed_ticks(energy, "x", *motion.span, 6)
    return figure


@styled
def comparison_figure(cases: Sequence[Compared]) -> Figure:
    """Draw closed form, block and mechanism of each case on one line, bold where the closed form is unsafe."""
    height = 4.3 * len(cases)
    figure = new_figure(height + 16)
    panel = panel_at(figure, 46, 6, TEXT_WIDTH - 46 - 40, height)
    rows = np.arange(len(cases))
    ratios = np.array([case.ratios for case in cases])
    form, block, whole = np.where(np.isinf(ratios), _FALLEN, np.maximum(ratios, _SMALLEST)).T
    unsafe = np.array([case.agreement is Agreement.TOO_LOW for case in cases])
    panel.hlines(rows[~unsafe], form[~unsafe], whole[~unsafe], color="0.6", linewidth=0.8)
    panel.hlines(rows[unsafe], form[unsafe], whole[unsafe], color="#D55E00", linewidth=2.0)
    panel.plot(form, rows, "D", color=PREDICTED, fillstyle="none", markersize=5, label="closed form, pulse")
    panel.plot(block, rows, "s", color="0.45", fillstyle="none", markersize=4, label="block, whole record")
    panel.plot(whole, rows, "o", color="black", markersize=3.5, label="mechanism, whole record")
    for place, case in enumerate(cases):
        panel.text(1.02, place, case.words, transform=panel.get_yaxis_transform(), va="center", fontsize=7)
    panel.set(xscale="log", xlim=(0.7 * _SMALLEST, 1.5 * _FALLEN), ylim=(len(cases) - 0.5, -0.5))
    panel.set_yticks(rows, [elided(case.label, 30) for case in cases])
    ticks = [_SMALLEST, 0.01, 0.1, 0.3, 1.0, _FALLEN]
    panel.set_xticks(ticks, ["rests", "0.01", "0.1", "0.3", "1", "overturns"])
    panel.set_xticks([], minor=True)
    panel.axvline(1.0, color="0.5", linewidth=0.5)
    panel.set_xlabel("largest rotation / critical rotation [-]")
    figure.legend(loc="upper center", ncols=3)
    return figure


@styled
def measures_figure(motions: Sequence[Motion], placed: Sequence[Placed]) -> Figure:
    """Draw response spectra with the structures on them, and velocity and displacement over time."""
    figure = new_figure(62)
    spectrum = panel_at(figure, 14, 2, 70, 50)
    spectra = {motion.name: response_spectrum(motion.accelerogram) for motion in motions}
    draw_response_spectra(spectrum, spectra, placed)
    spectrum.legend(loc="lower left")
    for row, (label, integral) in enumerate(
        {"velocity [m/s]": velocity, "displacement [m]": displacement}.items()
    ):
        panel = panel_at(figure, 103, 2 + 26 * row, 65, 24)
        traces = [(motion.accelerogram.times, integral(motion.accelerogram)) for motion in motions]
        for trace, line in zip(traces, ("-", "--", ":"), strict=False):
            panel.plot(*thinned(*trace, _POINTS), line, color="black", linewidth=0.6)
        reach = 1.1 * max(float(np.abs(trace).max()) for _, trace in traces) or 1.0
        fixed_ticks(panel, "y", -reach, reach, 3)
        panel.set_ylabel(label)
        _time_axis(panel, shared_span(motions), row == 1)
    return figure


@styled
def spectra_figure(
    spectra: Mapping[str, tuple[np.ndarray, np.ndarray, np.ndarray]], placed: Sequence[Placed]
) -> Figure:
    """Draw the rocking spectra of the components, (p, λ, rotation ratios) by name, side by side with the structures."""
    figure = new_figure(58)
    width = (TEXT_WIDTH - 16) / len(spectra) - 4
    for place, (name, levels) in enumerate(spectra.items()):
        panel = panel_at(figure, 15 + place * (width + 16 / len(spectra)), 4, width - 12, 43)
        draw_levels(panel, *levels, placed, (0.1, 0.5))
        plain_logarithmic(panel, "x")
        plain_logarithmic(panel, "y")
        panel.set_title(name)
    return figure
