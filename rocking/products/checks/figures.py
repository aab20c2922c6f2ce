"""The figures of the pages to sign: mechanism and bars of the checks, the capacity curve, the set of records."""

import math
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Patch

from rocking.codes.check import Check, DynamicCheck, StructureCheck
from rocking.codes.code_capacity import LIMIT_STATES, CodeCapacity
from rocking.codes.selection import Selection
from rocking.products.checks.rows import KINDS
from rocking.reports.drawings import bay_of, draw_bay, draw_dimensions, draw_structure
from rocking.reports.panels import ZERO, plot
from rocking.reports.printing import unit_of
from rocking.reports.sentences import Sentences
from rocking.reports.style import PREDICTED, PULSE, new_figure, panel_at, room_for_texts, styled
from rocking.structures import Structure
from rocking.structures.leaves import beside

_HEIGHT = 102.0
"""mm; of the mechanism to the left of its bars."""
_BASIS_HEIGHT = 72.0
"""mm; of the drawing to the left of its capacity curve, which leaves the page room for its tables."""
_TURNED = 0.5
"""Share of the critical rotation at which a mechanism is drawn."""
_POINTS = 200
_MET = "#1F3A5F"
_NOT_MET = "#AF4D1C"
_SIDE = "#F6E9E2"
"""Colours of a bar that is met, of one that is not, and of the side on which these lie."""
_LEAST, _MOST = 0.25, 10.0
"""Ends of the scale of the bars, which begin at 1; what lies beyond ends there, with its value."""
_SHORT = 0.62
"""Ratio from which on a bar that is not met is too short to hold it."""
_BAR = 0.24
"""Height of a bar; one check and the next are 1 apart."""


@styled
def bars_figure(
    structure: Structure, checked: StructureCheck, untied: StructureCheck | None, words: Sentences
) -> Figure:
    """Draw the mechanism that governs, turned, and at its right capacity over demand of each check on one scale.

    structure: of which a leaf may be what falls. untied: the checks without ties, whose bars are outlined below the
    others.
    """
    figure = new_figure(_HEIGHT)
    mechanism = checked.governing
    body = mechanism.candidate.structure
    bay = bay_of(body) if mechanism.candidate.bulges else None
    foot = 6 if bay is None else 6 + _HEIGHT / 3
    drawn = panel_at(figure, 2, foot, 58, _HEIGHT - 4 - foot)
    rotation = mechanism.candidate.sign * _TURNED * mechanism.static.side.critical_rotation
    # The values at loads and ties are English; on an Italian page they stand among the assumptions alone.
    values = words.language == "en"
    rest = beside(structure, mechanism.candidate.part)
    draw_structure(drawn, body, rotation, values=values, rest=rest)
    _to_scale(figure, drawn)
    if bay is not None:
        bay_axes = panel_at(figure, 2, 6, 58, _HEIGHT / 3 - 6)
        draw_bay(bay_axes, bay)
        _to_scale(figure, bay_axes)

    axes = panel_at(figure, 92, 6, 76, _HEIGHT - 18)
    axes.axvspan(_LEAST, 1, color=_SIDE, zorder=0)
    axes.axvline(1, color="black", linewidth=1.2, zorder=4)
    without = {check.clause: check for check in untied.checks} if untied else {}
    for place, check in enumerate(checked.checks):
        colour = _MET if check.passed else _NOT_MET
        other = without.get(check.clause)
        _draw_bar(axes, place - (0.15 if other else 0), check, words, {"color": colour})
        if other:
            _draw_bar(axes, place + 0.15, other, words, {"facecolor": "white", "edgecolor": "black"})
        decides = check is checked.decisive
        _write_beside(axes, place - 0.2, words(KINDS[check.clause]), size=9.5, weight="bold")
        _write_beside(axes, place, check.clause, size=7.5, color="0.4")
        _write_beside(
            axes,
            place + 0.19,
            words(checked.part_of(check).in_words),
            size=8.5,
            weight="bold" if decides else "normal",
            color=colour if decides else "0.3",
        )
    axes.set(xscale="log", xlim=(_LEAST, _MOST), ylim=(len(checked.checks) - 0.5, -0.5))
    ticks = (0.25, 0.5, 1, 2, 4, 8)
    axes.set_xticks(ticks, [words.decimal(f"{tick:g}") for tick in ticks])
    axes.minorticks_off()
    axes.set_yticks([])
    for side in ("left", "top", "right"):
        axes.spines[side].set_visible(False)
    for text, shift, align, colour in (
        (words("not met"), -5, "right", _NOT_MET),
        (words("met"), 5, "left", "black"),
    ):
        axes.annotate(
            text,
            (1, 1),
            (shift, 4),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha=align,
            weight="bold",
            size=9,
            color=colour,
        )
    if without:
        axes.legend(
            handles=[
                Patch(facecolor=_MET, edgecolor="black", label=words("with the tie")),
                Patch(facecolor="white", edgecolor="black", label=words("without")),
            ],
            loc="upper left",
            bbox_to_anchor=(0, -0.08),
            ncols=2,
            frameon=False,
        )
    return figure


def _draw_bar(axes: Axes, place: float, check: Check, words: Sentences, look: dict[str, Any]) -> None:
    """One bar from 1 on, with its ratio: within it where it is not met, at its right where it is."""
    end = min(max(check.ratio, _LEAST), _MOST)
    axes.barh(place, end - 1, _BAR, 1, linewidth=0.8, zorder=3, **look)
    text = words.decimal(check.ratio_in_words)
    if isinstance(check, DynamicCheck) and check.exceeding:
        text = words("falls: {exceeding}/{motions}", exceeding=check.exceeding, motions=check.motions)
    outlined = look.get("facecolor") == "white"
    ink = "black" if outlined or check.ratio >= 1 else "white"
    is_short = _SHORT < check.ratio < 1  # without room for its ratio, which stands left of it
    ends_the_scale = end == _MOST
    if is_short or (ends_the_scale and outlined):
        ink = "black"
    elif ends_the_scale:
        ink = "white"
    to_the_left = is_short or ends_the_scale
    axes.annotate(
        text,
        (end, place),
        (-4 if to_the_left else 4, 0),
        textcoords="offset points",
        ha="right" if to_the_left else "left",
        va="center",
        size=9,
        weight="normal" if outlined else "bold",
        color=ink,
        zorder=5,
    )


def _write_beside(axes: Axes, place: float, text: str, **look: Any) -> None:
    """Write a line of what a bar is of, left of the scale."""
    axes.annotate(
        text,
        (0, place),
        (-72, 0),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        va="center",
        **look,
    )


@styled
def basis_figure(structure: Structure, checked: StructureCheck, words: Sentences) -> Figure:
    """Draw the structure with its sizes and loads, and the capacity curve of the mechanism that governs."""
    figure = new_figure(_BASIS_HEIGHT)
    bay = bay_of(structure)
    drawn = panel_at(figure, 2, 4, 70 if bay is None else 36, _BASIS_HEIGHT - 10)
    draw_structure(drawn, structure, values=words.language == "en")
    draw_dimensions(drawn, structure, values=True, written=words.decimal)
    drawn.set_title(words("sizes and loads"))
    _to_scale(figure, drawn)
    if bay is not None:
        front = panel_at(figure, 41, 4, 36, _BASIS_HEIGHT - 10)
        draw_bay(front, bay)
        front.set_title(words("front between two ties"))
        _to_scale(figure, front)
    _draw_capacity(panel_at(figure, 94, 4, 74, _BASIS_HEIGHT - 13), checked.governing, words)
    return figure


def _to_scale(figure: Figure, axes: Axes) -> None:
    """Give a drawing one scale both ways, no axes, and room for what is written in it."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.margins(0.08)
    axes.autoscale_view()
    axes.set_axis_off()
    room_for_texts(figure, axes)


def _draw_capacity(axes: Axes, mechanism: CodeCapacity, words: Sentences) -> None:
    """a against d with its limit displacements and the secants whose periods the check takes."""
    side = mechanism.static.side
    bends = np.array(side.bends)
    steps = np.linspace(0.0, side.critical_rotation, _POINTS)
    rotations = np.unique([*steps, *bends, *bends * (1 + 1e-9)])
    length = unit_of("m")
    force = unit_of("m/s²")
    displacements = mechanism.displacement(rotations) / length.size
    accelerations = mechanism.acceleration(rotations) / force.size
    axes.plot(displacements, accelerations, color="black")
    for (name, state), colour in zip(LIMIT_STATES.items(), (PREDICTED, PULSE), strict=True):
        point = mechanism.limit(state)
        if math.isinf(point.displacement):
            continue
        label = (
            f"d_{name} = {words.quantity(point.displacement, 'm')}, T_{name} = {words.number(point.period)} s"
        )
        place = point.displacement / length.size
        level = point.acceleration / force.size
        axes.plot([0, place], [0, level], "--", color=colour, linewidth=0.8)
        axes.plot(place, level, "o", color=colour, markersize=4, label=label)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(lambda value, _: words.decimal(f"{value:.3g}"))
    axes.axhline(0, **ZERO)
    axes.margins(x=0)
    axes.set_ylim(0, 1.35 * float(accelerations.max()))
    axes.set(
        xlabel=words("displacement d [{unit}]", unit=length.name),
        ylabel=words("acceleration a [{unit}]", unit=force.name),
        title=words("capacity curve"),
    )
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper right")


@styled
def selection_figure(selection: Selection) -> Figure:
    """Draw the spectra of the set of records with the design spectrum."""
    figure = new_figure(80.0)
    plot(selection, figure.subplots())
    return figure
