"""What `.plot()` draws: one panel of matplotlib, on the axes given or on new ones, in the caller's own style.

Every function returns the axes, so that title, limits and labels can still be changed. Units stand on every axis.
"""

from typing import TYPE_CHECKING

import numpy as np
from matplotlib import pyplot
from matplotlib.axes import Axes

from rocking.errors import MotionError
from rocking.motion.response import Response
from rocking.pulses.analysis import PulseAnalysis
from rocking.pulses.pulse import Pulse
from rocking.records.accelerogram import Accelerogram
from rocking.reports.axes_pen import AxesPen
from rocking.reports.dimension_lines import draw_dimensions, draw_marks
from rocking.structures.capacity import CapacityCurve
from rocking.structures.mechanism import Mechanism, Side
from rocking.structures.outcome import Outcome
from rocking.structures.structure import Structure

if TYPE_CHECKING:
    from rocking.assessment.fragility import Fragility
    from rocking.assessment.single import StructureAssessment
    from rocking.motion.spectrum import RockingSpectrum

_TIME = "time [s]"
_ACCELERATION = "ground acceleration [m/s²]"
_POINTS = 400
_LEVELS = (0.05, 0.1, 0.2, 0.5, 1.0)
"""Rotation ratios that get a line in a rocking spectrum."""


def plot_accelerogram(record: Accelerogram, axes: Axes | None = None) -> Axes:
    """Draw the acceleration against time."""
    axes = _ready(axes, _TIME, _ACCELERATION)
    axes.plot(record.times, record.acceleration, linewidth=0.7, label=_named(record))
    axes.set_title(_named(record))
    return axes


def plot_pulse(pulse: Pulse, axes: Axes | None = None) -> Axes:
    """Draw the cycle, with a quarter of a period of rest before and after it."""
    axes = _ready(axes, _TIME, _ACCELERATION)
    times = np.linspace(pulse.start_time - pulse.period / 4, pulse.end_time + pulse.period / 4, _POINTS)
    axes.plot(times, pulse.acceleration(times), label=f"sine pulse, T = {pulse.period:.3g} s")
    return axes


def plot_analysis(analysis: PulseAnalysis, axes: Axes | None = None) -> Axes:
    """Draw the record with its dominant pulse."""
    axes = _ready(axes, _TIME, _ACCELERATION)
    record = analysis.accelerogram
    axes.plot(record.times, record.acceleration, color="0.6", linewidth=0.7, label="record")
    plot_pulse(analysis.dominant, axes)
    axes.set_title(_named(record))
    axes.legend(title=f"pulse explains {100 * analysis.explained_energy:.0f} %\nof the energy")
    return axes


def plot_response(response: Response, axes: Axes | None = None) -> Axes:
    """Draw the rotation against time, its largest value marked. Raises MotionError without a history."""
    if response.times is None or response.rotation is None:
        raise MotionError("the history of the response is not there; integrate with history=True to plot it.")
    axes = _ready(axes, _TIME, "rotation [rad]")
    axes.plot(response.times, response.rotation, linewidth=0.9, label="rotation")
    axes.axhline(0, color="0.8", linewidth=0.7, zorder=0)
    if response.outcome is Outcome.ROCKS:
        place = int(np.abs(response.rotation).argmax())
        axes.plot(response.times[place], response.rotation[place], "o", fillstyle="none", color="black")
    axes.set_title(response.outcome.of(response.rotation_ratio))
    return axes


def plot_assessment(assessment: "StructureAssessment", axes: Axes | None = None) -> Axes:
    """Draw the rotation ratio of the case as given against time, and the 5–95 % of the members' largest as a band."""
    response = assessment.response
    if response.times is None or response.rotation is None:
        raise MotionError("the history of the response is not there; assess the structure again to plot it.")
    critical = next(iter(assessment.cases.values())).mechanism.critical_rotation
    axes = _ready(axes, _TIME, "rotation / critical rotation [-]")
    axes.plot(response.times, response.rotation / critical, linewidth=0.9, label="as given")
    low, high = (min(value, 1.0) for value in (assessment.rotation_ratio_low, assessment.rotation_ratio_high))
    for sign in (1, -1):
        label = f"largest of {assessment.members} members, 5–95 %" if sign > 0 else None
        axes.axhspan(sign * low, sign * high, color="C1", alpha=0.2, label=label)
    axes.set_ylim(-1.15, 1.15)
    probability = assessment.overturning_probability
    axes.set_title(f"{assessment.verdict}: overturns in {100 * probability:.0f} % of the members")
    axes.legend(loc="upper right")
    return axes


def plot_fragility(fragility: "Fragility", axes: Axes | None = None) -> Axes:
    """Draw the empirical curve with its 90 % interval, and the lognormal one."""
    unit = f"[{fragility.unit or '-'}]"
    event = (
        "overturning"
        if np.isinf(fragility.threshold)
        else f"a rotation above {fragility.threshold:g} of the critical one"
    )
    axes = _ready(axes, f"{fragility.measure} {unit}", f"probability of {event} [-]")
    low, high = fragility.probability_low, fragility.probability_high
    label = f"{len(fragility.stations)} records of {fragility.independent} stations, 90 %"
    axes.fill_between(fragility.levels, low, high, color="C0", alpha=0.25, linewidth=0, label=label)
    axes.plot(fragility.levels, fragility.probability, ".-", color="C0", linewidth=0.7, label="empirical")
    law = "lognormal" if fragility.lognormal_holds else "lognormal, which does not hold"
    axes.plot(fragility.levels, fragility.lognormal, "--", color="black", linewidth=0.9, label=law)
    axes.set_xscale("log")
    axes.set_ylim(-0.02, 1.02)
    axes.legend(loc="upper left")
    return axes


def plot_spectrum(spectrum: "RockingSpectrum", axes: Axes | None = None) -> Axes:
    """Draw lines of equal rotation ratio over frequency parameter and uplift multiplier; hatched where it overturns.

    Raises MotionError for fewer than two values on either axis, or for a part of a spectrum.
    """
    if spectrum.shape != (spectrum.frequency_parameters.size, spectrum.uplift_multipliers.size):
        raise MotionError(
            f"the spectrum has shape {spectrum.shape}, which is a part of one; plot the whole of it."
        )
    if min(spectrum.shape) < 2:
        raise MotionError(f"the spectrum has shape {spectrum.shape}, but lines need at least (2, 2).")
    axes = _ready(axes, "frequency parameter p [rad/s]", "uplift multiplier λ [-]")
    grid = (spectrum.frequency_parameters, spectrum.uplift_multipliers)
    ratios = np.asarray(spectrum).T
    overturns = np.isinf(ratios)
    if overturns.any():
        axes.contourf(*grid, overturns.astype(float), levels=[0.5, 1.5], colors="0.85", hatches=["///"])
    shown = np.where(overturns, np.nan, ratios)
    if np.nanmax(shown, initial=0) > _LEVELS[0] and np.nanmin(shown, initial=np.inf) < _LEVELS[-1]:
        axes.clabel(axes.contour(*grid, shown, levels=_LEVELS, colors="black", linewidths=0.7), fmt="%g")
    axes.set_title("largest rotation / critical rotation; hatched: overturns")
    return axes


def plot_mechanism(mechanism: Mechanism, axes: Axes | None = None) -> Axes:
    """Draw I, G and B over their values at rest against the rotation, up to the critical one, for each side."""
    axes = _ready(axes, "rotation [rad]", "over the value at rest [-]")
    _plot_side(axes, mechanism.positive, 1)
    if mechanism.negative is not None:
        _plot_side(axes, mechanism.negative, -1)
    axes.axhline(0, color="0.8", linewidth=0.7, zorder=0)
    axes.legend()
    return axes


def plot_capacity(curve: CapacityCurve, axes: Axes | None = None) -> Axes:
    """Draw the load multiplier against the displacement of the control point, from uplift to where nothing holds."""
    axes = _ready(axes, "horizontal displacement of the control point [m]", "load multiplier G/B [g]")
    x, y = curve.control_point
    axes.plot(curve.displacement, curve.multiplier, label=f"control point ({x:.3g}, {y:.3g}) m")
    axes.axhline(0, color="0.8", linewidth=0.7, zorder=0)
    axes.margins(x=0)
    axes.legend()
    return axes


def plot_structure(
    structure: Structure, rotation: float = 0.0, axes: Axes | None = None, dimensions: bool = False
) -> Axes:
    """Draw the parts at a rotation [rad], to scale; displaced, also at rest (dashed) and with the hinges (circles).

    Loads, thrusts and ties are drawn too, and at rest the line of thrust as it starts to rock. dimensions: also draw
    the lines of its sizes, each with its letter, about the structure at rest.
    """
    axes = _ready(axes, "[m]", "[m]")
    for outline in structure.outline(rotation):
        axes.fill(*outline.T, facecolor="0.85", edgecolor="0.3", linewidth=0.8)
    if rotation:
        for outline in structure.outline():
            axes.fill(*outline.T, fill=False, linewidth=0.8, linestyle="--")
        axes.plot(*structure.hinges(rotation).T, "o", color="white", markeredgecolor="black")
    if dimensions:
        draw_dimensions(AxesPen(axes), structure.dimensions(), np.transpose, values=False)
    drawn = [*structure.outline(rotation), *structure.outline()]
    left = None if dimensions else min(float(each[:, 0].min()) for each in drawn)
    draw_marks(AxesPen(axes), structure.marks(rotation), np.transpose, left)
    if not rotation and len(structure.thrust_line()):
        axes.plot(*structure.thrust_line().T, color="C3", linewidth=1.0, label="thrust line at uplift")
        axes.legend(loc="upper right")
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.06)
    return axes


def _plot_side(axes: Axes, side: Side, sign: int) -> None:
    rotations = np.linspace(0, side.critical_rotation, _POINTS)
    for letter, name in (("I", "inertia"), ("G", "gravity"), ("B", "ground")):
        values = np.array([side.at(name, rotation) for rotation in rotations])
        colour, label = f"C{'IGB'.index(letter)}", letter if sign > 0 else None
        axes.plot(sign * rotations, values / values[0], "-" if sign > 0 else "--", color=colour, label=label)


def _ready(axes: Axes | None, x: str, y: str) -> Axes:
    if axes is None:
        axes = pyplot.subplots()[1]
    axes.set_xlabel(x)
    axes.set_ylabel(y)
    return axes


def _named(record: Accelerogram) -> str:
    """What the record is called, with no letter left that matplotlib takes for markup."""
    names = [name for name in (record.event, record.station, record.component) if name]
    return ", ".join(names).replace("$", r"\$") or "record"
