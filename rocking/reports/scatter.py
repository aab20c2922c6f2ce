"""The scatter of closed form against integration: each case in one of four quadrants, by who says that it falls."""

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from rocking.assessment.rows import ComparisonRow, PulseRow
from rocking.pulses.pulse import DOMINATES
from rocking.quantities import counted, percents
from rocking.reports.style import new_figure, panel_at, styled

WIDTH = 180.0
"""Width of the figure, mm."""
_LEAST = 0.03
"""Rotation ratio at the lower end of both scales; what turns less, or rests, stands there."""
_LARGEST = 1.5
"""Rotation ratio at their upper end; what came back from beyond it stands there."""
_ZONE = 0.25
"""Where the zone of what falls begins, in the decimal logarithm of the rotation ratio."""
_END = 0.95
"""Where it ends."""
_SPACING = 0.075
"""Least distance of two points that both stand in a zone, likewise."""
_MOST_POINTS = 5000
"""Points that are drawn as shapes; more become a picture, whose size does not grow with them."""
_MOST_PACKED = 120
"""Points that are packed into a corner; of more their number is written."""
_LIGHT = "#C9CED6"
_DARK = "#1F3A5F"
_MISSED = "#A33B14"


@styled
def prediction_scatter(
    comparison: Sequence[ComparisonRow], pulses: Sequence[PulseRow] = (), height: float = 118.0
) -> Figure:
    """Draw the rotation ratio of the closed form across and that of the integration upwards, with the counts.

    A case without one of the two is left out, and so is one that neither lifts. pulses: which say how much of the
    energy of a record lies in its sine; without them all cases are alike.
    """
    figure = new_figure(height, WIDTH)
    size = height - 2
    axes = panel_at(figure, 20, 1, size, height - 14)
    cases = [row for row in comparison if lifts(row)]
    predicted = np.array([row.predicted_rotation_ratio for row in cases])
    integrated = np.array([row.integrated_rotation_ratio for row in cases])
    energy = _energy(cases, pulses)
    dark = energy >= DOMINATES
    _draw_quadrants(axes)
    places = np.stack([_placed(predicted), _placed(integrated)])
    sees = np.isinf(predicted)
    falls = np.isinf(integrated)
    late = sees & falls & ~np.array([row.sees_fall for row in cases], dtype=bool)
    _spread(places[0], places[1], falls & ~sees)
    _spread(places[1], places[0], sees & ~falls)
    packed = _pack(places, sees & falls)
    count = len(cases)
    for which, colour in ((~dark & ~late, _LIGHT), (dark & ~late, _DARK), (late, "white")):
        shown = which & ~(sees & falls & ~packed)
        axes.plot(
            *places[:, shown],
            "o",
            color=colour,
            markeredgecolor="0.25",
            markeredgewidth=0.5,
            markersize=4.5,
            rasterized=count > _MOST_POINTS,
            label=f"cases ({int(which.sum())})",
        )
    _write_counts(axes, predicted, integrated, late)
    _write_key(figure, energy, sees & ~late, falls, 20 + size + 6, height)
    return figure


def lifts(row: ComparisonRow) -> bool:
    """Whether a case has both ratios and one of them lifts it."""
    both = row.predicted_rotation_ratio, row.integrated_rotation_ratio
    return not any(map(math.isnan, both)) and max(both) > 0


def _energy(cases: Sequence[ComparisonRow], pulses: Sequence[PulseRow]) -> np.ndarray:
    """The share of the energy of its record that the dominant pulse explains, of each case; nan where none is known."""
    of_pulse = {(row.record, row.component): row.explained_energy for row in pulses if row.is_dominant}
    return np.array([of_pulse.get((row.record, row.component), np.nan) for row in cases])


def _placed(ratios: np.ndarray) -> np.ndarray:
    """The places of rotation ratios on a scale: their logarithm, or the middle of the zone of what falls."""
    places = np.log10(np.clip(ratios, _LEAST, _LARGEST))
    return np.where(np.isinf(ratios), (_ZONE + _END) / 2, places)


def _spread(along: np.ndarray, across: np.ndarray, which: np.ndarray) -> None:
    """Move points of a zone `across` it into lines where they would stand on one another `along` it."""
    lines: list[float] = []
    for place in np.flatnonzero(which)[np.argsort(along[which], kind="stable")]:
        free = next((n for n, last in enumerate(lines) if along[place] - last >= _SPACING), None)
        if free is None and len(lines) < 7:
            free = len(lines)
            lines.append(along[place])
        free = len(lines) - 1 if free is None else free
        lines[free] = along[place]
        across[place] = _ZONE + 0.1 + _SPACING * free


def _pack(places: np.ndarray, which: np.ndarray) -> np.ndarray:
    """Set the points that fall in both side by side into their corner; return which of them found room."""
    found = np.zeros(which.size, dtype=bool)
    columns = int((_END - _ZONE - 0.1) / _SPACING)
    for number, place in enumerate(np.flatnonzero(which)[:_MOST_PACKED]):
        row, column = divmod(number, columns)
        up = _ZONE + 0.08 + _SPACING * row
        if up > _END - 0.2:
            break
        places[:, place] = _ZONE + 0.08 + _SPACING * column, up
        found[place] = True
    return found


def _draw_quadrants(axes: Axes) -> None:
    low = np.log10(_LEAST) - 0.08
    for corner, shade in (((low, _ZONE), "#F3DCD1"), ((_ZONE, _ZONE), "0.93"), ((_ZONE, low), "0.97")):
        size = [(_END if start == _ZONE else _ZONE) - start for start in corner]
        axes.add_patch(Rectangle(corner, *size, facecolor=shade, edgecolor="0.6", linewidth=0.5))
    axes.plot([low, _ZONE], [low, _ZONE], color="0.3", linewidth=0.8)
    axes.text(low + 0.07, low + 0.13, "agree", rotation=45, color="0.4", fontsize=7)
    ticks = (_LEAST, 0.1, 1.0)
    axes.plot([low, _ZONE], [0, 0], color="0.8", linewidth=0.5, zorder=0)
    axes.plot([0, 0], [low, _ZONE], color="0.8", linewidth=0.5, zorder=0)
    places = [*np.log10(ticks), (_ZONE + _END) / 2]
    names = [f"≤ {_LEAST:g}", "0.1", "1", "falls"]
    axes.set_xticks(places, names)
    axes.set_yticks(places, names)
    axes.set(
        xlim=(low, _END),
        ylim=(low, _END),
        xlabel="closed form (1: critical)",
        ylabel="integration (1: critical)",
    )


def _write_counts(axes: Axes, predicted: np.ndarray, integrated: np.ndarray, late: np.ndarray) -> None:
    """Write into each quadrant how many cases stand there; of those that rock in both, how many within a factor two.

    late: whether both fall, but by a sine that begins after the fall.
    """
    sees = np.isinf(predicted)
    falls = np.isinf(integrated)
    rock = (predicted > 0) & (integrated > 0) & ~sees & ~falls
    factor = np.abs(np.log2(predicted[rock] / integrated[rock]))
    low = np.log10(_LEAST)
    # Points that lie behind a count leave it readable.
    paper = {"facecolor": "white", "alpha": 0.7, "linewidth": 0, "pad": 0.8}
    large: dict[str, Any] = {"fontsize": 11.5, "fontweight": "bold", "bbox": paper}
    to_the_right: dict[str, Any] = {"ha": "right", "bbox": paper}
    axes.text(low, _END - 0.05, f"{int((falls & ~sees).sum())} missed", color=_MISSED, va="top", **large)
    axes.text(_ZONE + 0.05, _END - 0.05, f"{int((falls & sees & ~late).sum())} right", va="top", **large)
    if late.any():
        note = f"{int(late.sum())} by a sine\nafter the fall"
        # Below the count, as the points fill the quadrant from its lower left corner.
        below: dict[str, Any] = {"xytext": (0, -16), "textcoords": "offset points", "va": "top"}
        axes.annotate(note, (_ZONE + 0.05, _END - 0.05), fontsize=8.5, bbox=paper, **below)
    axes.text(
        _ZONE + 0.05,
        low + 0.4,
        counted(int((sees & ~falls).sum()), "false alarm").replace(" alarm", "\nalarm"),
        **large,
    )
    right = _ZONE - 0.04
    axes.text(
        right, low + 0.26, f"{int(rock.sum())} rock in both,", fontsize=9.5, fontweight="bold", **to_the_right
    )
    axes.text(
        right, low + 0.12, f"{int((factor <= 1).sum())} within factor two", fontsize=8.5, **to_the_right
    )


def _write_key(
    figure: Figure, energy: np.ndarray, sees: np.ndarray, falls: np.ndarray, left: float, height: float
) -> None:
    """Write at the right of the scatter, by the energy in the sine, how many falls are missed."""
    axes = panel_at(figure, left, 0, WIDTH - left, height)
    axes.set_axis_off()
    axes.set(xlim=(0, WIDTH - left), ylim=(-height, 0))
    top = -5.0
    if not np.isnan(energy).all():
        axes.text(0, top, "energy in the sine", fontsize=7.5, color="0.3")
        for which, colour in ((energy >= DOMINATES, _DARK), (energy < DOMINATES, _LIGHT)):
            if not which.any():
                continue
            top -= 6
            missed = int((falls & ~sees & which).sum())
            axes.plot(
                1.5, top + 1, "o", color=colour, markeredgecolor="0.25", markeredgewidth=0.5, markersize=5
            )
            axes.text(5, top, percents(*energy[which]), fontsize=9.5, fontweight="bold")
            axes.text(5, top - 4.5, f"misses {missed} of {int((falls & which).sum())}", fontsize=8.5)
            top -= 6
    axes.text(
        0,
        top - 8,
        "Above the line:\nunsafe.",
        fontsize=9,
        fontweight="bold",
        color=_MISSED,
        va="top",
    )
