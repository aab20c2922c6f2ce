"""Prediction against integration: a strip for each structure that moves, with the closed forms against what happens."""

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from rocking.assessment.case import RecordResult
from rocking.assessment.conclusion import Conclusion
from rocking.assessment.cracks import cracked
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.rows import ComparisonRow, PulseRow, RecordRows
from rocking.errors import FaultError, one_structure
from rocking.motion.response import Response
from rocking.quantities import counted, listed, percents
from rocking.reports.drawings import Trace, drawn_by_hand, sine_lines, svg_path, thinned
from rocking.reports.pages import Against, AgainstHead, Compared, ComparedWords, Ground, Picture, Tick
from rocking.reports.printing import NOTHING, number, quantity, unit_of
from rocking.signal.accelerogram import Accelerogram
from rocking.structures import Mechanism, Structure

MOST_STRIPS = 24
"""Structures that have a strip, the worst first: two pages; comparison.csv holds all."""
WIDTH, HEIGHT = 80.0, 14.8
"""Size of a strip, mm."""
_GROUND = 15.0
"""Height of the strip of the ground, mm."""
_REACH = 1.25
"""Rotation ratio at the upper and at the lower edge of a strip."""
_POINTS = 700
_FORM, _BAND = "#0072B2", "#DAE9F2"
_FAINT = 'fill="none" stroke="#d0d0d0" stroke-width="0.15"'
_MARGIN = 0.04
"""Share of the window that is shown beyond the last of the largest rotations."""
_MOST_NAMED = 30
_STEPS = (1.0, 2.0, 5.0)
TITLE = "Prediction against integration"
HEADS = (
    AgainstHead("paper", "Eqs. 15, 16"),
    AgainstHead("predict", "closed form"),
    AgainstHead("integrate", "whole record"),
)
"""The methods whose results stand at the strips: of the source paper, and of the two steps that are compared."""
LEGEND = (
    "Black: the mechanism under the whole record, with the crack of its row in comparison.csv, under the component "
    "that turns it farthest; a triangle where it falls. Band: closed form of the equivalent block under the sine, "
    "which falls later where that begins after the fall. "
    "Dotted: Eqs. 15 and 16 of the source paper as printed, with its block (λ by Eq. 7 in g, p by Eq. 11 in rad/s; "
    "φ_cr in rad), grey outside of the regime in which Eq. 15 holds."
)
"""What the strips show."""


@dataclass(frozen=True, eq=False)
class Moving:
    """One structure that moves: what the tables say of it, and its history.

    case: its row of comparison.csv. times: s. ratios: rotation over critical rotation (k,), to the fall or to rest.
    """

    conclusion: Conclusion
    case: ComparisonRow
    mechanism: Mechanism
    times: np.ndarray
    ratios: np.ndarray

    @property
    def falls(self) -> bool:
        """Whether it overturns."""
        return self.case.integrated_rotation_ratio == math.inf

    @property
    def peak_time(self) -> float:
        """Time of its largest rotation, or at which it leaves the strip, s."""
        beyond = np.abs(self.ratios) >= _REACH
        place = int(np.argmax(beyond)) if beyond.any() else int(np.argmax(np.abs(self.ratios)))
        return float(self.times[place])


def traces_of(result: RecordResult, rows: RecordRows) -> list[Trace]:
    """Return the components that were assessed, with their ranked pulses, the dominant one first."""
    assessed = {row.component for row in rows.record}
    ranked = sorted((row for row in rows.pulses if row.ranked), key=lambda row: row.rank)
    return [
        Trace(accelerogram, [row.pulse for row in ranked if row.component == accelerogram.component])
        for accelerogram in result.accelerograms
        if accelerogram.component in assessed
    ]


def moving_structures(
    conclusions: Sequence[Conclusion], structures: Mapping[str, Structure], result: RecordResult
) -> list[Moving]:
    """Return the structures that move under the record, and whose history was kept, the worst first."""
    found = []
    for conclusion in conclusions:
        case = conclusion.case
        response = result.responses.get(case.case) if case else None
        if case is None or response is None or not case.integrated_rotation_ratio > NEGLIGIBLE:
            continue
        # One that cannot be drawn costs no other its strip; its numbers stand in the tables.
        with suppress(FaultError), one_structure(case.structure):
            if case.structure in structures:
                found += _moving(conclusion, case, structures[case.structure], response)
    return found


def _moving(
    conclusion: Conclusion, case: ComparisonRow, structure: Structure, response: Response
) -> list[Moving]:
    mechanism = cracked(structure, case.crack).mechanism()
    ratios = response.relative_rotation
    if response.times is None or ratios is None or ratios.size < 2:
        return []
    return [Moving(conclusion, case, mechanism, response.times, ratios)]


@dataclass(frozen=True, eq=False)
class Comparison:
    """Prediction against integration of one record, as page two and the page to explore show it.

    moving: the structures that move, the worst first. grounds: the components under which those of them move that have
    a strip. span: the time that strips show, s. at_rest: the sentence on the others. several: whether components are
    to be named.
    """

    moving: Sequence[Moving]
    grounds: Sequence[Trace]
    span: tuple[float, float]
    at_rest: str
    several: bool


def comparison_of(
    conclusions: Sequence[Conclusion],
    structures: Mapping[str, Structure],
    result: RecordResult,
    motions: Sequence[Trace],
) -> Comparison | None:
    """Return what there is to compare; None where no structure was compared. motions: the components."""
    compared = [
        conclusion for conclusion in conclusions if conclusion.case and not math.isnan(conclusion.ratios[-1])
    ]
    if not compared or not motions:
        return None
    moving = moving_structures(conclusions, structures, result)
    shown = moving[:MOST_STRIPS]
    used = {moving.case.component for moving in shown}
    grounds = [motion for motion in motions if motion.accelerogram.component in used] or list(motions[:1])
    resting = [conclusion for conclusion in compared if conclusion.ratios[-1] <= NEGLIGIBLE]
    return Comparison(moving, grounds, _window(shown, grounds), _at_rest(resting), len(motions) > 1)


def against(
    comparison: Comparison, structures: Mapping[str, Structure], pulses: Sequence[PulseRow]
) -> Against:
    """Return the page. pulses: the rows of the record."""
    span = comparison.span
    ticks = _ticks(*span)
    shown = comparison.moving[:MOST_STRIPS]
    more = len(comparison.moving) - len(shown)
    compared = tuple(_each_compared(shown, structures, span, ticks, comparison.several))
    return Against(
        title=TITLE,
        heads=HEADS,
        legend=LEGEND if compared else "",
        grounds=tuple(_ground(ground, span, ticks, pulses) for ground in comparison.grounds),
        compared=compared,
        ticks=tuple(Tick(_across(at, span), f"{at:g}") for at in ticks),
        at_rest=comparison.at_rest,
        more=f"Another {counted(more, 'structure')} in comparison.csv." if more else "",
    )


def _window(shown: Sequence[Moving], grounds: Sequence[Trace]) -> tuple[float, float]:
    """The strong motion, and on to the last of the largest rotations, s."""
    spans = [ground.span for ground in grounds]
    begin = min(span[0] for span in spans)
    end = max([span[1] for span in spans] + [moving.peak_time for moving in shown])
    return begin, end + _MARGIN * (end - begin)


def _ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Round numbers between two ends, at most so many."""
    least = (high - low) / most
    power = 10.0 ** math.floor(math.log10(least))
    step = next((size * power for size in _STEPS if size * power >= least), 10 * power)
    return [step * place for place in range(math.ceil(low / step), math.floor(high / step) + 1)]


N = TypeVar("N", float, np.ndarray)


def _across(times: N, span: tuple[float, float]) -> N:
    """Where times stand on a strip, mm."""
    return WIDTH * (times - span[0]) / (span[1] - span[0])


def _line(x: Sequence[float], y: Sequence[float], height: float, look: str) -> str:
    return svg_path(np.column_stack([x, y]), height, look)


# The ground ------------------------------------------------------------------------------------------------


def _ground(
    motion: Trace, span: tuple[float, float], ticks: Sequence[float], pulses: Sequence[PulseRow]
) -> Ground:
    """The accelerogram of a component with its axes and its sine, and what is known of that."""
    record = motion.accelerogram
    unit = unit_of("m/s²")
    reach = 1.08 * max(record.peak_acceleration, *(abs(pulse.amplitude) for pulse in motion.pulses[:1]), 1e-9)

    def up(values: np.ndarray | float) -> np.ndarray:
        return np.asarray(_GROUND / 2 * (1 + np.asarray(values) / reach))

    inside = (record.times >= span[0]) & (record.times <= span[1])
    times, samples = thinned(record.times[inside], record.acceleration[inside], _POINTS)
    shapes = [_line([_across(at, span)] * 2, [0, _GROUND], _GROUND, _FAINT) for at in ticks]
    levels = [level for level in _ticks(-reach / unit.size, reach / unit.size, 4) if level]
    shapes += [_line([0, WIDTH], [float(up(at * unit.size))] * 2, _GROUND, _FAINT) for at in (0.0, *levels)]
    look = 'fill="none" stroke="#595959" stroke-width="0.2"'
    shapes.append(svg_path(np.column_stack([_across(times, span), up(samples)]), _GROUND, look))
    for pulse in motion.pulses[:1]:
        cycle = np.linspace(pulse.start_time, pulse.end_time, 61)
        shapes += sine_lines(np.column_stack([_across(cycle, span), up(pulse.acceleration(cycle))]), _GROUND)
    alt = f"Acceleration of component {record.component or 'without a name'} and its dominant sine."
    return Ground(
        name=record.component,
        peak=peak_of(record),
        facts=sine_facts(record.component, pulses),
        picture=drawn_by_hand(shapes, WIDTH, _GROUND, alt),
        levels=tuple(
            Tick(_GROUND - float(up(at * unit.size)), f"{at:g} {unit.name}".replace("-", "−"))
            for at in levels
        ),
    )


def peak_of(record: Accelerogram) -> str:
    """Return the peak of a component in words."""
    return f"PGA {quantity(record.peak_acceleration, 'm/s²')}"


def sine_facts(component: str, pulses: Iterable[PulseRow]) -> tuple[str, ...]:
    """Return the lines on the dominant sine of a component; none without one."""
    dominant = (row for row in pulses if row.component == component and row.is_dominant)
    sine = next(dominant, None)
    if sine is None:
        return ()
    return (
        f"sine {quantity(abs(sine.amplitude_m_s2), 'm/s²')}, {number(sine.period_s)}\u00a0s,",
        f"from {number(sine.start_time_s)}\u00a0s on, {percents(sine.explained_energy)} of the energy",
    )


# The structures --------------------------------------------------------------------------------------------


def _each_compared(
    shown: Sequence[Moving],
    structures: Mapping[str, Structure],
    span: tuple[float, float],
    ticks: Sequence[float],
    several: bool,
) -> Iterator[Compared]:
    for moving in shown:
        name = moving.case.structure
        # One that cannot be drawn costs no other its strip; its numbers stand in the tables.
        with suppress(FaultError), one_structure(name):
            words = compared_in_words(moving, structures[name], several)
            yield Compared(picture=_strip(moving, span, ticks), **vars(words))


def compared_in_words(moving: Moving, structure: Structure, several: bool) -> ComparedWords:
    """Return the texts at the strip of a structure. several: whether its component is to be named."""
    case = moving.case
    both_fall = case.predicted_rotation_ratio == case.integrated_rotation_ratio == math.inf
    crack = case.crack or moving.conclusion.row.crack
    period = case.support_period_s
    notes = [
        f"under {case.component}" if several and case.component else "",
        f"T_b {period:.3g} s" if period else "on the ground" if period == 0 else "",
        crack,
        least_uplift(case, structure),
    ]
    return ComparedWords(
        name=case.structure,
        below=sizes_of(case.structure, structure),
        constants=(
            f"λ {number(case.uplift_multiplier)}",
            f"p {number(case.frequency_parameter_rad_s)}",
            f"φ_cr {number(case.critical_rotation_rad)}",
            f"η {number(case.restitution)}",
        ),
        note=", ".join(filter(None, notes)),
        printed=in_words(case.printed_rotation_ratio),
        outside=case.printed_holds is False,
        form="falls later" if both_fall and not case.sees_fall else in_words(case.predicted_rotation_ratio),
        whole=in_words(case.integrated_rotation_ratio),
    )


def least_uplift(case: ComparisonRow, structure: Structure) -> str:
    """Return the least λ of all cracks where that of the row is another one: "λ_min 0.195"."""
    least = structure.mechanism().uplift_multiplier
    is_another = number(least) != number(case.uplift_multiplier) and least < case.uplift_multiplier
    return f"λ_min\u00a0{number(least)}" if is_another else ""


def sizes_of(name: str, structure: Structure) -> str:
    """Return type and sizes as they were typed: "free wall, 2.2×0.30 m"; of one whose name says its type the sizes."""
    described = structure.described
    type_name = described.type_name.replace("_", " ")
    size = described.size.replace(" × ", "×")
    return ", ".join(filter(None, ("" if type_name == name and size else type_name, size)))


def in_words(rotation_ratio: float) -> str:
    """Return a rotation over the critical one in two digits: "0.69", "falls", "rests", or a dash without one.

    Below 0 is none: what a formula gives outside of where it holds.
    """
    if not rotation_ratio >= 0:
        return NOTHING
    if rotation_ratio == math.inf:
        return "falls"
    return "rests" if rotation_ratio <= NEGLIGIBLE else number(rotation_ratio, 2)


def _up(ratios: np.ndarray | float) -> np.ndarray:
    """Where a rotation ratio stands on a strip, mm; what is beyond it at its edge."""
    return np.asarray(HEIGHT / 2 * (1 + np.clip(ratios, -_REACH, _REACH) / _REACH))


def _strip(moving: Moving, span: tuple[float, float], ticks: Sequence[float]) -> Picture:
    """The history within the band of the closed form, with the paper's as a dotted line, and where it falls."""
    case = moving.case
    sides = (1,) if moving.mechanism.one_sided else (1, -1)
    shapes = []
    form = case.predicted_rotation_ratio
    if form > 0:
        low, high = float(_up(min(sides) * form if len(sides) > 1 else 0.0)), float(_up(form))
        box = f'x="0" y="{HEIGHT - high:.3f}" width="{WIDTH:g}" height="{high - low:.3f}"'
        shapes.append(f'<rect {box} fill="{_BAND}"/>')
    shapes += [_line([_across(at, span)] * 2, [0, HEIGHT], HEIGHT, _FAINT) for at in ticks]
    grey = 'fill="none" stroke="#bbbbbb" stroke-width="0.18"'
    shapes += [_line([0, WIDTH], [float(_up(at))] * 2, HEIGHT, grey) for at in (-1.0, 0.0, 1.0)]
    of_form = f'fill="none" stroke="{_FORM}" stroke-width="0.35"'
    shapes += [
        _line([0, WIDTH], [float(_up(side * form))] * 2, HEIGHT, of_form)
        for side in sides
        if 0 < form <= _REACH
    ]
    ink = "#808080" if case.printed_holds is False else "black"
    dots = f'fill="none" stroke="{ink}" stroke-width="0.3" stroke-dasharray="0.3 0.8"'
    shapes += [
        _line([0, WIDTH], [float(_up(side * case.printed_rotation_ratio))] * 2, HEIGHT, dots)
        for side in sides
        if 0 < case.printed_rotation_ratio <= _REACH
    ]
    shapes += _history(moving, span)
    alt = f"{case.structure}: its rotation over the critical one, with the closed form as a band."
    return drawn_by_hand(shapes, WIDTH, HEIGHT, alt)


def _history(moving: Moving, span: tuple[float, float]) -> list[str]:
    """The history within the window, to rest or to the fall, which a triangle marks."""
    times, ratios = moving.times, moving.ratios
    if moving.falls:
        last = int(np.searchsorted(times, moving.peak_time)) + 1
        times, ratios = times[:last], ratios[:last]
    else:
        times, ratios = np.append(times, max(span[1], times[-1])), np.append(ratios, 0.0)
        if moving.times[-1] < span[1]:
            times, ratios = np.insert(times, -1, moving.times[-1]), np.insert(ratios, -1, 0.0)
    inside = (times >= span[0]) & (times <= span[1])
    places = _across(times[inside], span), _up(ratios[inside])
    line = np.column_stack(thinned(*places, _POINTS))
    shapes = [svg_path(line, HEIGHT, 'fill="none" stroke="black" stroke-width="0.28"')]
    if moving.falls and inside.any():
        x, y = float(places[0][-1]), float(places[1][-1])
        tip = math.copysign(1.7, y - HEIGHT / 2)
        triangle = np.array([[x - 1.1, y - tip], [x + 1.1, y - tip], [x, y]])
        shapes.append(svg_path(triangle, HEIGHT, 'fill="black"', closed=True))
    return shapes


def _at_rest(resting: Sequence[Conclusion]) -> str:
    """The sentence on the structures that do not move, with the closed form of those that it moves."""
    if not resting:
        return ""
    names = [
        f"{conclusion.row.structure} (closed form {in_words(conclusion.ratios[0])})"
        if conclusion.ratios[0] > NEGLIGIBLE
        else conclusion.row.structure
        for conclusion in resting
    ]
    return f"At rest under the record: {listed(names, _MOST_NAMED)}."
