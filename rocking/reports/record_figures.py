"""The figures of the details of a record's report: the pulses, the reserve, the motion, and the closed form."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from rocking.assessment.case import PeriodResult
from rocking.assessment.methods import Agreement, Method, ratio_in_words
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import RATIO_COLUMNS, ComparisonRow
from rocking.assessment.scene import placed
from rocking.quantities import GRAVITY, counted
from rocking.reports.drawings import Trace
from rocking.reports.panels import draw_energy_map, draw_motion, draw_rotation, moving_span
from rocking.reports.printing import LOOKS, number, ratio, unit_of
from rocking.reports.style import PREDICTED, PULSE, TEXT_WIDTH, elided, new_figure, panel_at, styled, wrapped

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_POINTS = 1200
"""Points of a trace: no printer shows more on the width of a page."""
_HISTORIES = 160.0
"""Height of all histories together, mm."""
_HIGHEST_ROW = 30.0
"""Height of one history at most, mm."""
_HIGHEST = 1.25
"""Rotation ratio beyond which a history is not drawn."""
_ZOOM = 1.5
"""Periods of the pulse that are drawn before and after it."""
_MAP_COLUMNS = 240
"""Columns of the map of energy, at most twice as many."""
_BESIDE_CASES = 29
"""Small letters that stand at a case of the comparison."""
_SMALLEST = 1e-3
"""Rotation ratio at the left end of the comparison."""
_FALLEN = 3.0
"""Rotation ratio at which overturning stands there."""


@dataclass(frozen=True, eq=False)
class History:
    """The rotation of a structure under the component that turns it farthest, and what became of it.

    times: s. ratios: rotation over critical rotation (k,).
    """

    station: PeriodResult
    case: ComparisonRow
    times: np.ndarray
    ratios: np.ndarray


def _component(name: str) -> str:
    """The name of a component as a figure has room for it; one of digits alone would be read as a number."""
    return elided(f"comp. {name}" if name.isdigit() else name or "component", 12)


# The ground ------------------------------------------------------------------------------------------------


def _draw_ground(panel: Axes, motion: Trace, span: tuple[float, float], last: bool) -> None:
    """Draw the acceleration of a component within `span` [s], its dominant pulse and PGA; the last one names time."""
    accelerogram = motion.accelerogram
    unit = unit_of("m/s²")
    draw_motion(panel, accelerogram, next(iter(motion.pulses), None), span, _POINTS, unit.size)
    amplitudes = [abs(pulse.amplitude) for pulse in motion.pulses[:1]]
    reach = 1.1 * max(accelerogram.peak_acceleration, *amplitudes, 1e-9) / unit.size
    peak = f"{_component(accelerogram.component)}: PGA {accelerogram.peak_acceleration / GRAVITY:.2g} g"
    panel.text(0.995, 0.97, peak, transform=panel.transAxes, ha="right", va="top")
    _fixed_ticks(panel, "y", -reach, 1.5 * reach)  # room for the label above the highest peak
    _fixed_ticks(panel, "x", *span, 6)
    panel.tick_params(labelbottom=last)
    panel.set(xlabel="time after the first sample [s]" if last else "", ylabel=f"[{unit.name}]")


def _fixed_ticks(panel: Axes, which: str, low: float, high: float, count: int = 5) -> None:
    """Give the x or y axis its limits and about `count` round ticks between them, which nothing has to seek again."""
    from matplotlib.ticker import FixedFormatter, FixedLocator, MaxNLocator

    places = np.asarray(MaxNLocator(count, steps=[1, 2, 5, 10]).tick_values(low, high))
    places = places[(places >= low) & (places <= high)]
    axis = panel.xaxis if which == "x" else panel.yaxis
    axis.set_major_locator(FixedLocator(places.tolist()))
    axis.set_major_formatter(FixedFormatter([f"{round(place, 12):g}".replace("-", "−") for place in places]))
    panel.set(**{f"{which}lim": (low, high)})


@styled
def pulses_figure(motions: Sequence[Trace]) -> Figure:
    """Draw of each component the dominant pulse in the record, and the energy of a pulse over onset and period."""
    from rocking.pulses import energy_map  # which loads the compiled scan

    height = 32.0
    figure = new_figure(height * len(motions))
    for place, motion in enumerate(motions):
        accelerogram = motion.accelerogram
        pulse = motion.pulses[0]
        near, energy = (panel_at(figure, left, 2 + place * height, 69, 21) for left in (14, 100))
        zoom = _ZOOM * pulse.period
        span = max(pulse.start_time - zoom, 0.0), min(pulse.end_time + zoom, accelerogram.duration)
        _draw_ground(near, motion, span, last=True)
        # of several onsets the largest gain: no printer shows more
        gains, onsets, frequencies = energy_map(accelerogram)
        starts = np.arange(0, gains.shape[0], max(1, gains.shape[0] // _MAP_COLUMNS))
        gains = np.maximum.reduceat(gains, starts, axis=0)
        draw_energy_map(energy, onsets[starts], 1 / frequencies, gains, motion.pulses, motion.span)
        _fixed_ticks(energy, "x", *motion.span, 6)
    return figure


# The structures --------------------------------------------------------------------------------------------


@styled
def reserve_figure(stations: Sequence[PeriodResult], labels: Mapping[str, str]) -> Figure:
    """Draw for each structure the factors on the record at which 5, 50 and 95 % of its members overturn, worst first.

    A verdict is read off the line at 1: what lies left of it falls under the record as it is. A bar that ends in an
    arrow goes on beyond the largest factor that was tried.
    """
    from matplotlib.ticker import FixedFormatter, FixedLocator

    reserves = [(station, station.reserve) for station in stations if station.reserve is not None]
    height = 3.3 * len(reserves) + 9.0
    figure = new_figure(height, margins=(0, 0, 0, 0))
    panel = panel_at(figure, 46, 0.5, TEXT_WIDTH - 82, height - 9)
    limit = max(reserve.limit for _, reserve in reserves)
    found = [factor for _, reserve in reserves for factor in (reserve.low, reserve.median) if factor > 0]
    least = min([0.5, *(0.8 * factor for factor in found)])
    panel.axvline(1.0, color="black", linewidth=0.8)
    for place, (station, reserve) in enumerate(reserves):
        colour = LOOKS[station.decision.word][1]
        low = limit if math.isnan(reserve.low) else reserve.low
        high = limit if math.isnan(reserve.high) else reserve.high
        bar: dict[str, Any] = {
            "left": low,
            "height": 0.55,
            "color": colour,
            "edgecolor": "0.25",
            "linewidth": 0.5,
        }
        if high > low:
            panel.barh(-place, high - low, **bar)
        if not math.isnan(reserve.median):
            panel.plot([reserve.median] * 2, [-place - 0.3, -place + 0.3], color="black", linewidth=1.2)
        if math.isnan(reserve.high):
            panel.plot(limit, -place, ">", color="0.25", markersize=3.5, clip_on=False)
        label = elided(placed(labels[station.structure], station.support_period_s), 27)
        panel.text(-0.01, -place, label, ha="right", va="center", transform=panel.get_yaxis_transform())
        panel.text(1.06 * limit, -place, _reserve_in_numbers(reserve), ha="left", va="center", fontsize=7)
    panel.set(xscale="log", xlim=(least, limit), ylim=(-len(reserves) + 0.4, 0.6), yticks=[])
    ticks = [
        tick
        for tick in (0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 10.0)
        if least <= tick <= limit
    ]
    panel.xaxis.set_major_locator(FixedLocator(ticks))
    panel.xaxis.set_major_formatter(FixedFormatter([f"{tick:g}" for tick in ticks]))
    panel.xaxis.set_minor_locator(FixedLocator([]))
    panel.set_xlabel(
        "factor on the record [-]; bar: from 5 to 95 % of the members overturn, stroke: half of them"
    )
    return figure


def _reserve_in_numbers(reserve: Reserve) -> str:
    """The factors of 5 and of 50 %: "5 %: 0.80 ×, half: 1.1 ×"."""
    if math.isnan(reserve.low):
        return f"none up to {reserve.limit:g} ×"
    if math.isnan(reserve.median):
        return f"5 %: {number(reserve.low, 2)} ×"
    return f"5 %: {number(reserve.low, 2)} ×, half: {number(reserve.median, 2)} ×"


# Their motion ----------------------------------------------------------------------------------------------


@styled
def histories_figure(
    histories: Sequence[History], labels: Mapping[str, str], motions: Sequence[Trace]
) -> Figure:
    """Draw the rotation of each structure, one below the other, and beneath them the ground, on one time axis.

    Each row has a scale of its own, which stands below its name, one of `labels`.
    """
    row = min(_HIGHEST_ROW, _HISTORIES / len(histories))
    below = 20.0
    left = 38.0
    width = TEXT_WIDTH - 84  # what happened stands at the right
    figure = new_figure(row * len(histories) + below * len(motions) + 9)
    panel = panel_at(figure, left, 1, width, row * len(histories))
    for place, history in enumerate(histories):
        station = history.station
        label = placed(labels[station.structure], station.support_period_s)
        _draw_history(panel, history, -place, label, several=len(motions) > 1)
    span = moving_span((history.times, history.ratios) for history in histories)
    panel.set(xlim=span, ylim=(0.5 - len(histories), 0.5), xticks=[], yticks=[])
    panel.spines[["left", "bottom"]].set_visible(False)
    for place, motion in enumerate(motions):
        top = 2 + row * len(histories) + place * below
        _draw_ground(panel_at(figure, left, top, width, below - 3), motion, span, motion is motions[-1])
    return figure


def _draw_history(panel: Axes, history: History, level: int, label: str, several: bool) -> None:
    """Draw one history about `level`, between its `label` and what happened; of `several` components, with its own."""
    station = history.station
    case = history.case
    ratios = history.ratios
    predicted = case.predicted_rotation_ratio
    largest = (ratio for ratio in (float(np.abs(ratios).max()), predicted) if 0 < ratio < math.inf)
    reach = min(1.25 * max(largest, default=1.0), _HIGHEST)
    members = station.ensemble
    band = min(members.rotation_ratio_low, reach), min(members.rotation_ratio_high, reach)
    draw_rotation(
        panel,
        (history.times, np.clip(ratios, -reach, reach)),
        predicted if predicted <= reach else math.inf,
        band if members.members else None,
        place=(level, 0.45 / reach),
        most=_POINTS,
    )
    component = f", {_component(case.component)}" if several else ""
    remark = (
        f"{ratio(case.integrated_rotation_ratio, 2)}{component}, {counted(case.impacts or 0, 'impact')}\n"
        f"closed form: {ratio(predicted, 2)}"
    )
    look: dict[str, Any] = {"transform": panel.get_yaxis_transform(), "va": "center", "fontsize": 7}
    name = wrapped(label, 24, 3)
    panel.text(-0.02, level, f"{name}\n± {reach:.2g}", ha="right", linespacing=1.3, **look)
    panel.text(1.01, level, remark, ha="left", linespacing=1.3, **look)


# The closed form -------------------------------------------------------------------------------------------


@styled
def comparison_figure(cases: Sequence[ComparisonRow], labels: Mapping[str, str], several: bool) -> Figure:
    """Draw closed form, block and mechanism of each case on one line, bold where the closed form is unsafe.

    labels: what each structure is called. several: whether a line names its component.
    """
    height = 4.3 * len(cases)
    figure = new_figure(height + 16)
    panel = panel_at(figure, 46, 6, TEXT_WIDTH - 46 - 40, height)
    rows = np.arange(len(cases))
    methods = (Method.CLOSED_FORM, Method.BLOCK_ON_RECORD, Method.MECHANISM_ON_RECORD)
    ratios = np.array([[getattr(case, RATIO_COLUMNS[method]) for method in methods] for case in cases])
    form, block, whole = np.where(np.isinf(ratios), _FALLEN, np.maximum(ratios, _SMALLEST)).T
    unsafe = np.array([case.agreement is Agreement.TOO_LOW for case in cases])
    panel.hlines(rows[~unsafe], form[~unsafe], whole[~unsafe], color="0.6", linewidth=0.8)
    panel.hlines(rows[unsafe], form[unsafe], whole[unsafe], color=PULSE, linewidth=2.0)
    panel.plot(form, rows, "D", color=PREDICTED, fillstyle="none", markersize=5, label="closed form, pulse")
    panel.plot(block, rows, "s", color="0.45", fillstyle="none", markersize=4, label="block, whole record")
    panel.plot(whole, rows, "o", color="black", markersize=3.5, label="mechanism, whole record")
    names = []
    for place, case in enumerate(cases):
        component = f", {_component(case.component)}" if several else ""
        label = placed(labels[case.structure], case.support_period_s)
        names.append(elided(label, _BESIDE_CASES - len(component)) + component)
        remark = ratio_in_words(
            predicted=case.predicted_rotation_ratio, integrated=case.integrated_rotation_ratio
        )
        panel.text(1.02, place, remark, transform=panel.get_yaxis_transform(), va="center", fontsize=7)
    panel.set(xscale="log", xlim=(0.7 * _SMALLEST, 1.5 * _FALLEN), ylim=(len(cases) - 0.5, -0.5))
    panel.set_yticks(rows, names)
    ticks = {_SMALLEST: "rests", 0.01: "0.01", 0.1: "0.1", 0.3: "0.3", 1.0: "1", _FALLEN: "overturns"}
    panel.set_xticks(list(ticks), list(ticks.values()))
    panel.set_xticks([], minor=True)
    panel.axvline(1.0, color="0.5", linewidth=0.5)
    panel.set_xlabel("largest rotation / critical rotation [-]")
    figure.legend(loc="upper center", ncols=3)
    return figure
