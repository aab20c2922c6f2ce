"""Every picture of the package, drawn once: one panel on the axes given, for `.plot()`, reports and documentation.

Units stand on every axis. A long trace is drawn as its envelope.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from rocking.earthquakes.sample import interval_words
from rocking.errors import MotionError, RockingError
from rocking.quantities import percent, shown
from rocking.reports.drawings import MOST_POINTS, bay_of, draw_bay, draw_dimensions, draw_structure, thinned
from rocking.reports.style import (
    PULSE,
    RECORD,
    new_figure,
    plain_logarithmic,
    styled,
    svg,
)
from rocking.structures.arch import Arch

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from rocking.assessment.assess import StructureAssessment
    from rocking.codes.selection import Selection
    from rocking.fragility.curves import Fragility
    from rocking.motion.batch import RockingSpectrum
    from rocking.motion.response import Response
    from rocking.pulses import Pulse, PulseAnalysis
    from rocking.signal.accelerogram import Accelerogram
    from rocking.signal.measures import ResponseSpectrum
    from rocking.strengthening import Strengthening
    from rocking.structures import Mechanism, Structure
    from rocking.structures.capacity import StaticCurve

TIME = "time [s]"
ACCELERATION = "ground acceleration [m/s²]"
ZERO: dict[str, Any] = {"color": "0.8", "linewidth": 0.6, "zorder": 0}
_POINTS = 400
_STILL = 0.01
"""Share of its largest rotation up to which a structure is still."""


def plot(thing: object, axes: Axes | None = None, **options: Any) -> Axes:
    """Draw anything of this package that has a method plot, in the caller's own style, on `axes` or on new ones.

    Parameters
    ----------
    thing : object
        What is drawn: a record, a pulse, a response, a structure, a curve.
    axes : Axes | None, optional
        Matplotlib axes; None: new ones.
    **options : Any
        Options of its method `plot`.

    Returns
    -------
    Axes
        The axes, so that title, limits and labels can still be changed.

    Examples
    --------
    >>> rocking.plot(rocking.Block(2.0, 0.2)).get_xlabel()
    '[m]'
    """
    names = [kind.__name__ for kind in type(thing).__mro__ if kind.__name__ in _PLOTS]
    if not names:
        raise RockingError(
            f"thing is {shown(thing)}, but must be something that has a picture: {', '.join(sorted(_PLOTS))}.",
            thing=thing,
        )
    draw = _PLOTS[names[0]]
    if axes is None:
        from matplotlib import pyplot  # it owns the windows, which who gives axes does not need

        axes = pyplot.subplots()[1]
    draw(thing, axes, **options)
    return axes


@styled
def svg_of(thing: object) -> bytes:
    """Return the picture of a thing that has one, in the style of the reports, as SVG."""
    figure = new_figure(90.0)
    plot(thing, figure.subplots())
    return svg(figure).encode()


# What a report and a method draw alike ---------------------------------------------------------------------


def draw_motion(axes: Axes, record: Accelerogram, pulse: Pulse) -> None:
    """Draw the acceleration against time, with its pulse."""
    axes.plot(
        *thinned(record.times, record.acceleration, MOST_POINTS), color=RECORD, linewidth=0.6, label="record"
    )
    cycle = np.linspace(pulse.start_time, pulse.end_time, 121)
    axes.plot(cycle, pulse.acceleration(cycle), color=PULSE, linewidth=1.5, label="dominant pulse")


def draw_rotation(axes: Axes, history: tuple[np.ndarray, np.ndarray], band: tuple[float, float]) -> None:
    """Draw a history, times and rotation over critical rotation (k,), with impacts as ticks on the line of rest.

    band: the largest rotation ratio of 5 and of 95 % of the members, drawn as a bar at the right.
    """
    times, ratio = history
    axes.axhline(0, **ZERO)
    low, high = (min(value, 1.0) for value in band)
    look: dict[str, Any] = {"color": "#E69F00", "alpha": 0.6, "linewidth": 0}
    for sign, label in ((1, "5–95 % of the members"), (-1, None)):
        if high > 0:
            axes.axhspan(sign * low, sign * high, xmin=0.97, label=label, **look)
    axes.plot(*thinned(times, ratio), color="black", linewidth=0.8, label="as given")
    impacts = times[1:][ratio[1:] * ratio[:-1] < 0]
    axes.plot(impacts, np.zeros(impacts.size), "|", color="black", markersize=3, markeredgewidth=0.4)


def moving_span(histories: Iterable[tuple[np.ndarray, np.ndarray]]) -> tuple[float, float]:
    """Return the time in which any of several histories, each times [s] and rotation (k,), moves, with a margin, s.

    A history moves while its rotation is above a share of its largest one; one that rests counts from end to end.
    """
    sizes = [(times, np.abs(rotation)) for times, rotation in histories]
    moving = np.concatenate([times[size >= _STILL * size.max()] for times, size in sizes])
    begin = float(moving.min())
    end = float(moving.max())
    margin = 0.05 * (end - begin) + 1e-3
    return max(0.0, begin - margin), end + margin


class CurveBand(NamedTuple):
    """A fragility curve over the levels of its intensity measure, (k,) each.

    interval: its lower and its upper end, called as `interval_words` says. It and the lognormal curve may be left out.
    """

    levels: np.ndarray
    probability: np.ndarray
    interval: tuple[np.ndarray, np.ndarray] | None = None
    lognormal: np.ndarray | None = None
    interval_words: str = "interval"


def draw_probability(axes: Axes, curve: CurveBand, label: str = "empirical", colour: str = "C0") -> None:
    """Draw a fragility curve, with its interval and lognormal curve where it has them."""
    levels = curve.levels
    if curve.interval is not None:
        axes.fill_between(
            levels,
            *curve.interval,
            color=colour,
            alpha=0.2,
            linewidth=0,
            label=f"{curve.interval_words}, by earthquakes",
        )
    axes.plot(levels, curve.probability, ".-", color=colour, linewidth=0.9, markersize=3, label=label)
    if curve.lognormal is not None:
        axes.plot(levels, curve.lognormal, "--", color=colour, linewidth=0.7, label="lognormal")
    plain_logarithmic(axes, "x")
    axes.set_ylim(-0.02, 1.02)


# The methods plot ------------------------------------------------------------------------------------------


def _plot_accelerogram(record: Accelerogram, axes: Axes) -> None:
    axes.plot(*thinned(record.times, record.acceleration), linewidth=0.7, label=_named(axes, record))
    axes.set(xlabel=TIME, ylabel=ACCELERATION)


def _plot_pulse(pulse: Pulse, axes: Axes) -> None:
    times = np.linspace(pulse.start_time - pulse.period / 4, pulse.end_time + pulse.period / 4, _POINTS)
    axes.plot(times, pulse.acceleration(times), label=f"sine pulse, T = {pulse.period:.3g} s")
    axes.set(xlabel=TIME, ylabel=ACCELERATION)


def _plot_analysis(analysis: PulseAnalysis, axes: Axes) -> None:
    draw_motion(axes, analysis.accelerogram, analysis.dominant)
    _named(axes, analysis.accelerogram)
    axes.set(xlabel=TIME, ylabel=ACCELERATION)
    axes.legend(title=f"pulse explains {100 * analysis.explained_energy:.0f} %\nof the energy")


def _plot_response(response: Response, axes: Axes, relative: bool = False) -> None:
    times, rotation = _history(response, "integrate with history=True to plot it", relative)
    axes.plot(*thinned(times, rotation), linewidth=0.9, label="rotation")
    axes.axhline(0, **ZERO)
    if 0 < response.rotation_ratio < math.inf:
        place = int(np.abs(rotation).argmax())
        axes.plot(times[place], rotation[place], "o", fillstyle="none", color="black")
    of_what = "rotation / critical rotation [-]" if relative else "rotation [rad]"
    axes.set(xlabel=TIME, ylabel=of_what, title=response.outcome.of(response.rotation_ratio))


def _plot_assessment(assessment: StructureAssessment, axes: Axes) -> None:
    history = _history(assessment.response, "assess the structure again to plot it", relative=True)
    draw_rotation(axes, history, band=(assessment.rotation_ratio_low, assessment.rotation_ratio_high))
    of_all = [f"{assessment.members} members"] if assessment.members else []
    followed_as = f"runs {assessment.body.joints.as_stones}" if assessment.body.joints.as_stones else "stacks"
    of_all += [f"{assessment.stacks.runs} {followed_as}"] if assessment.stacks else []
    share = " of ".join(filter(None, [assessment.decision.share_in_words, " and ".join(of_all)]))
    axes.set(xlabel=TIME, ylabel="rotation / critical rotation [-]", ylim=(-1.15, 1.15))
    axes.set_title(f"{assessment.decision.verdict}: overturns in {share}")
    axes.legend()


def _plot_fragility(fragility: Fragility, axes: Axes) -> None:
    overturning = math.isinf(fragility.threshold)
    event = "overturning" if overturning else f"a rotation above {fragility.threshold:g} of the critical one"
    interval = fragility.probability_low, fragility.probability_high
    label = f"empirical, {fragility.sample.words}"
    words = interval_words(fragility.sample.earthquakes)
    curve = CurveBand(fragility.levels, fragility.probability, interval, fragility.lognormal, words)
    draw_probability(axes, curve, label)
    axes.set(xlabel=f"{fragility.measure} [{fragility.unit or '-'}]", ylabel=f"probability of {event} [-]")
    axes.legend(loc="upper left")


def _plot_spectrum(spectrum: RockingSpectrum, axes: Axes) -> None:
    """Lines of equal rotation ratio over p and λ, hatched where it overturns.

    Raises MotionError for fewer than two values on either axis, or for a part of a spectrum.
    """
    whole = spectrum.frequency_parameters.size, spectrum.uplift_multipliers.size
    if spectrum.shape != whole or min(whole) < 2:
        raise MotionError(
            f"the spectrum has shape {spectrum.shape}, but lines need the whole of it, {whole}, and at least (2, 2).",
            shape=spectrum.shape,
        )
    across = spectrum.frequency_parameters
    up = spectrum.uplift_multipliers
    ratios = np.asarray(spectrum).T
    overturns = np.isinf(ratios)
    if overturns.any():
        axes.contourf(across, up, overturns.astype(float), levels=[0.5, 1.5], colors="0.85", hatches=["///"])
    levels = (0.05, 0.1, 0.2, 0.5, 1.0)
    rocking = np.where(overturns, np.nan, ratios)
    if np.nanmax(rocking, initial=0) > levels[0] and np.nanmin(rocking, initial=np.inf) < levels[-1]:
        lines = axes.contour(across, up, rocking, levels=levels, colors="black", linewidths=0.7)
        axes.clabel(lines, fmt="%g", fontsize=7)
    axes.set(xlabel="frequency parameter p [rad/s]", ylabel="uplift multiplier λ [-]")
    axes.set_title("largest rotation / critical rotation; hatched: overturns")


def _plot_mechanism(mechanism: Mechanism, axes: Axes) -> None:
    """I, G and B over their values at rest, up to the critical rotation of each side."""
    for side, sign, line in zip(mechanism.sides, (1, -1), ("-", "--"), strict=False):
        rotations = np.linspace(0, side.critical_rotation, _POINTS)
        for colour, (letter, name) in enumerate({"I": "inertia", "G": "gravity", "B": "ground"}.items()):
            values = np.array([side.at(name, rotation) for rotation in rotations])
            label = letter if sign > 0 else None
            axes.plot(sign * rotations, values / values[0], line, color=f"C{colour}", label=label)
    axes.axhline(0, **ZERO)
    axes.set(xlabel="rotation [rad]", ylabel="over the value at rest [-]")
    axes.legend()


def _plot_capacity(curve: StaticCurve, axes: Axes) -> None:
    x, y = curve.control_point
    axes.plot(curve.displacement, curve.multiplier, label=f"control point ({x:.3g}, {y:.3g}) m")
    axes.axhline(0, **ZERO)
    axes.margins(x=0)
    axes.set(xlabel="horizontal displacement of the control point [m]", ylabel="load multiplier G/B [g]")
    axes.legend()


def _plot_selection(selection: Selection, axes: Axes) -> None:
    """The scaled spectra of the chosen set, their mean, the target and what is allowed about it."""
    for place in selection.chosen:
        axes.plot(selection.periods, selection.spectra[place], color="0.75", linewidth=0.6)
    target = selection.target
    low = (1 - selection.below) * target
    high = (1 + selection.above) * target
    axes.fill_between(selection.periods, low, high, color=PULSE, alpha=0.15, linewidth=0)
    allowed = f"target, {-100 * selection.below:+.0f} to {100 * selection.above:+.0f} %"
    axes.plot(selection.periods, target, color=PULSE, label=allowed)
    axes.plot(
        selection.periods, selection.mean, color=RECORD, label=f"mean of {selection.chosen.size} records"
    )
    _set_over_periods(axes, "spectral acceleration [m/s²]")


def _set_over_periods(axes: Axes, quantity: str) -> None:
    """Set the axes of a spectrum: periods from end to end of its curves, and `quantity` with its unit from 0."""
    plain_logarithmic(axes, "x")
    axes.set_ylim(bottom=0)
    axes.margins(x=0)
    axes.set(xlabel="period [s]", ylabel=quantity)
    axes.legend()


def _plot_strengthening(strengthening: Strengthening, axes: Axes) -> None:
    """The share that overturns over the value with its bounds, the target, and the value that can be shown to hold."""
    outward = strengthening.field.outward
    tried = strengthening.tried
    values = [outward(trial.value) for trial in tried]
    low, high = zip(*(trial.interval for trial in tried), strict=True)
    label = f"share of {strengthening.sample.words}"
    bounds = f"one-sided {interval_words(strengthening.sample.earthquakes, 'bound')}, by earthquakes"
    axes.fill_between(values, low, high, color="C0", alpha=0.2, linewidth=0, label=bounds)
    axes.plot(values, [trial.share for trial in tried], ".-", color="C0", linewidth=0.9, label=label)
    axes.axhline(
        strengthening.target, color="0.4", linestyle=":", label=f"target {percent(strengthening.target)} %"
    )
    if strengthening.chosen is not None:
        shown_to_hold = f"shown to hold: {strengthening.as_typed(strengthening.value)}"
        axes.axvline(outward(strengthening.value), color="C2", label=shown_to_hold)
    if not math.isnan(strengthening.static_tie):
        of_code = f"linear check: {strengthening.as_typed(strengthening.static_tie)}"
        axes.axvline(outward(strengthening.static_tie), color="C3", linestyle="--", label=of_code)
    plain_logarithmic(axes, "x")
    axes.set_ylim(-0.02, 1.02)
    unit = f" [{strengthening.field.unit}]"
    axes.set(xlabel=strengthening.key.replace("_", " ") + unit, ylabel="share that overturns [-]")
    axes.legend(frameon=True, framealpha=0.85, edgecolor="none")  # the lines of the values may pass behind it


def _plot_response_spectrum(spectrum: ResponseSpectrum, axes: Axes) -> None:
    """The pseudo-acceleration over the undamped period."""
    axes.plot(
        spectrum.periods, spectrum.pseudo_acceleration, color=RECORD, label=f"damping {spectrum.damping:.0%}"
    )
    _set_over_periods(axes, "pseudo-acceleration [m/s²]")


def _plot_structure(
    structure: Structure, axes: Axes, rotation: float = 0.0, dimensions: bool = False
) -> None:
    """To scale; loads, thrusts and ties too, and at rest the line of thrust as it starts to rock."""
    draw_structure(axes, structure, rotation, values=not dimensions)
    if dimensions:
        draw_dimensions(axes, structure)
        bay = bay_of(structure)
        if bay is not None:
            draw_bay(axes, bay)
    if not rotation and isinstance(structure, Arch):
        axes.plot(*structure.thrust_line().T, color="C3", linewidth=1.0, label="thrust line at uplift")
        # above the axes: an arch reaches into every corner of them
        axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), borderaxespad=0.2, frameon=False)
    axes.set(xlabel="[m]", ylabel="[m]")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.06)
    axes.autoscale_view()


_PLOTS: dict[str, Callable[..., None]] = {
    "Accelerogram": _plot_accelerogram,
    "Pulse": _plot_pulse,
    "PulseAnalysis": _plot_analysis,
    "Response": _plot_response,
    "StructureAssessment": _plot_assessment,
    "Fragility": _plot_fragility,
    "RockingSpectrum": _plot_spectrum,
    "ResponseSpectrum": _plot_response_spectrum,
    "Mechanism": _plot_mechanism,
    "StaticCurve": _plot_capacity,
    "Selection": _plot_selection,
    "Strengthening": _plot_strengthening,
    "Structure": _plot_structure,
}
"""The drawings by the name of the class: importing the classes costs whoever draws a record the kernels of motion."""


def _history(response: Response, otherwise: str, relative: bool) -> tuple[np.ndarray, np.ndarray]:
    """Return times [s] and rotation, rad or over the critical one, while the structure moves.

    Raises MotionError without a history.
    """
    rotation = response.relative_rotation if relative else response.rotation
    if response.times is None or rotation is None:
        raise MotionError(f"the history of the response is not there; {otherwise}.", history=False)
    begin, end = moving_span([(response.times, rotation)])
    inside = (response.times >= begin) & (response.times <= end)
    return response.times[inside], rotation[inside]


def _named(axes: Axes, record: Accelerogram) -> str:
    """Write what the record is called above the axes, with no letter taken for markup, and return it."""
    name = ", ".join(name for name in (record.event, record.station, record.component) if name) or "record"
    axes.set_title(name).set_parse_math(False)
    return name.replace("$", r"\$")  # as a legend shows it, which has no such switch
