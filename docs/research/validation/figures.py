"""Figures of the validation: scores with intervals, reliability, confusion by peak velocity, ranges beside the mesh."""

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from docs.research.validation.rows import ConfusionRow, IdentifiedRow, ReliabilityRow, ScoreRow
from rocking.reports.style import new_figure, styled
from rocking.tables import R

_OURS, _OTHER, _WRONG = "#0072B2", "#000000", "#D55E00"
PARAMETERS = {
    "uplift_multiplier_positive": "λ, positive side",
    "uplift_multiplier_negative": "λ, negative side",
    "frequency_parameter": "p (rad/s)",
    "restitution": "η",
}


@styled
def score_figure(rows: Sequence[ScoreRow]) -> Figure:
    """Draw accuracy and Brier score of every method with 95 % intervals, a row of panels for each specimen."""
    found = by_specimen(rows)
    most = max(map(len, found.values()))
    figure = new_figure(5.2 * most * len(found) + 24, margins=(52, 4, 11, 6))
    panels = figure.subplots(len(found), 2, squeeze=False, gridspec_kw={"hspace": 0.22, "wspace": 0.08})
    for (specimen, listed), (left, right) in zip(found.items(), panels, strict=True):
        own = listed[::-1]
        _intervals(left, own, [(row.accuracy_low, row.accuracy, row.accuracy_high) for row in own])
        _intervals(right, own, [(row.brier_low, row.brier, row.brier_high) for row in own])
        left.set_yticks(range(len(own)), [row.method for row in own])
        right.set_yticks(range(len(own)), [""] * len(own))
        left.set(title=f"Specimen {specimen}", xlim=(0.55, 1.0), xticks=(0.6, 0.7, 0.8, 0.9))
        right.set(xlim=(0.0, 0.4))
    panels[-1, 0].set_xlabel("accuracy: more is better")
    panels[-1, 1].set_xlabel("Brier score: less is better")
    return figure


@styled
def reliability_figure(rows: Sequence[ReliabilityRow]) -> Figure:
    """Draw the share that overturned against the probability that was stated, with 90 % intervals and counts."""
    figure = new_figure(72, margins=(13, 3, 11, 6))
    found = by_specimen(rows)
    panels = figure.subplots(1, len(found), squeeze=False)[0]
    for panel, (specimen, own) in zip(panels, found.items(), strict=True):
        panel.plot([0, 1], [0, 1], color="0.6", linewidth=0.7)
        stated, observed = np.array([[row.stated, row.observed] for row in own]).T
        reach = np.array([[row.observed - row.observed_low, row.observed_high - row.observed] for row in own])
        panel.errorbar(
            stated, observed, np.clip(reach.T, 0, None), fmt="o", color=_OURS, markersize=4, elinewidth=0.8
        )
        for row in own:
            below = row.observed > 0.5
            panel.annotate(
                str(row.tests),
                (row.stated, row.observed_low if below else row.observed_high),
                textcoords="offset points",
                xytext=(0, -4 if below else 4),
                ha="center",
                va="top" if below else "bottom",
            )
        panel.set(title=f"Specimen {specimen}", xlabel="predicted probability of overturning")
        panel.set(xlim=(-0.04, 1.04), ylim=(-0.09, 1.09), aspect="equal")
    figure.axes[0].set_ylabel("share that overturned")
    return figure


@styled
def confusion_figure(rows: Sequence[ConfusionRow]) -> Figure:
    """Draw how many verdicts were right and wrong, by class of peak velocity."""
    figure = new_figure(66, margins=(13, 3, 17, 6))
    found = by_specimen(rows)
    panels = figure.subplots(1, len(found), squeeze=False)[0]
    for panel, (specimen, own) in zip(panels, found.items(), strict=True):
        base = np.zeros(len(own))
        for name, column, colour, hatch in (
            ("stood, as predicted", "stood", "0.85", ""),
            ("overturned, as predicted", "overturned", "#56B4E9", ""),
            ("false overturning", "false", "#E69F00", "//"),
            ("missed overturning", "missed", _WRONG, "xx"),
        ):
            values = [getattr(row, column) for row in own]
            panel.bar(range(len(own)), values, bottom=base, color=colour, hatch=hatch, label=name, width=0.75)
            base = base + values
        panel.set_xticks(range(len(own)), [_class(row) for row in own], rotation=30, ha="right")
        panel.set(title=f"Specimen {specimen}", xlabel="peak velocity of the table (m/s)")
    figure.axes[0].set_ylabel("tests")
    figure.axes[-1].legend(loc="upper right")
    return figure


@styled
def identified_figure(rows: Sequence[IdentifiedRow]) -> Figure:
    """Draw the identified 90 % ranges and medians beside what the mesh allows and what was tried."""
    specimens = sorted({row.specimen for row in rows})
    figure = new_figure(42, margins=(17, 3, 11, 6))
    panels = figure.subplots(1, len(PARAMETERS), gridspec_kw={"wspace": 0.16})
    for panel, (name, label) in zip(panels, PARAMETERS.items(), strict=True):
        for row in (each for each in rows if each.parameter == name):
            place = len(specimens) - row.specimen
            panel.plot([row.prior_low, row.prior_high], [place, place], color="0.85", linewidth=6)
            panel.plot([row.low, row.high], [place, place], color=_OURS, linewidth=2)
            panel.plot(row.median, place, "o", color=_OURS)
            panel.plot([row.mesh_low, row.mesh_high], [place - 0.28] * 2, "|-", color=_WRONG, linewidth=1.6)
        panel.set(xlabel=label, ylim=(-0.6, len(specimens) - 0.5))
        panel.set_yticks(range(len(specimens)), [""] * len(specimens))
    for panel in panels[:2]:
        panel.set_xlim(0, 0.4)
    panels[0].set_yticks(range(len(specimens)), [f"specimen {each}" for each in specimens[::-1]])
    return figure


def by_specimen(rows: Sequence[R]) -> dict[int, list[R]]:
    """Return the rows of each specimen by its number."""
    found: dict[int, list[R]] = {}
    for row in rows:
        found.setdefault(row.specimen, []).append(row)  # type: ignore[attr-defined]
    return dict(sorted(found.items()))


def _intervals(panel: Axes, rows: Sequence[ScoreRow], values: Sequence[tuple[float, float, float]]) -> None:
    for place, (row, (low, middle, high)) in enumerate(zip(rows, values, strict=True)):
        ours = place == len(rows) - 1
        colour = _OURS if ours else _OTHER
        panel.plot([low, high], [place, place], color=colour, linewidth=0.9)
        marker = "D" if ours else "s" if row.method.startswith("published") else "o"
        panel.plot(middle, place, marker, color=colour, markersize=4)
    best = values[-1][1]
    panel.axvline(best, color=_OURS, linewidth=0.5, linestyle=":")
    panel.set_ylim(-0.7, len(rows) - 0.3)
    panel.grid(True, axis="x")
    panel.set_axisbelow(True)


def _class(row: ConfusionRow) -> str:
    if np.isinf(row.highest_peak_velocity_m_s):
        return f"over {row.lowest_peak_velocity_m_s:g}"
    return f"{row.lowest_peak_velocity_m_s:g}–{row.highest_peak_velocity_m_s:g}"
