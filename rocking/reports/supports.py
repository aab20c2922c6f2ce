"""The structures on a support in a report: share against the period of the support, and the spectra of its motion."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from rocking.assessment.case import RecordResult, SceneResult
from rocking.assessment.motions import Component
from rocking.assessment.rows import SupportRow
from rocking.floors.place import Place
from rocking.reports.printing import quantity
from rocking.reports.style import (
    new_figure,
    styled,
    wrapped,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST_SUPPORTS = 4
"""Supports that are drawn; the table supports.csv holds all."""
_LINES = ("-", "--", ":", "-.")
_MARKS = "osD^v"
_MOST_LINES = 12
_PERIODS = np.geomspace(0.05, 3.0, 60)
"""Periods of the spectra, s."""


@dataclass(frozen=True, eq=False)
class SupportPanel:
    """A support with the structures on it, and the component of the ground with the largest peak.

    floors: that component on the support, at its shortest, its middle and its longest first period.
    """

    structures: Sequence[SceneResult]
    ground: Component
    floors: Sequence[Component]


def support_panels(result: RecordResult) -> list[SupportPanel]:
    """Return a panel for each support of a record that carries something, in the order of the structures."""
    by_place: dict[Place, list[SceneResult]] = {}
    for scene in result.carried:
        by_place.setdefault(scene.scene.place, []).append(scene)
    if not result.components:
        return []
    worst = max(
        range(len(result.components)), key=lambda n: result.components[n].accelerogram.peak_acceleration
    )
    panels = []
    for place, several in by_place.items():
        reached = [support for support in place.supports if support in result.floors]
        if reached:
            drawn = dict.fromkeys((reached[0], reached[len(reached) // 2], reached[-1]))
            floors = [result.components_on(support)[worst] for support in drawn]
            panels.append(SupportPanel(several, result.components[worst], floors))
    return panels[:MOST_SUPPORTS]


@styled
def shares_by_period_figure(rows: Sequence[SupportRow]) -> Figure:
    """Draw for each structure on a support the mean over the records of the share that overturns, by period."""
    shares: dict[tuple[str, str], dict[str, dict[float, float]]] = {}
    for row in rows:
        of_records = shares.setdefault((row.structure, row.support), {})
        of_records.setdefault(row.record, {})[row.support_period_s or 0.0] = row.overturning_share
    figure = new_figure(62.0, margins=(14, 52, 11, 3))
    axes = figure.subplots()
    for number, ((structure, support), of_records) in enumerate(list(shares.items())[:_MOST_LINES]):
        ordered = sorted({period for own in of_records.values() for period in own})
        # A record that is too coarse for the shortest periods has no row there.
        lines = [[own.get(period, math.nan) for period in ordered] for own in of_records.values()]
        means = np.nanmean(lines, axis=0)
        style = f"{_MARKS[number % len(_MARKS)]}{_LINES[number % len(_LINES)]}"
        label = wrapped(f"{structure} on {support}", 27, 3)
        axes.plot(ordered, means, style, linewidth=0.9, markersize=4, clip_on=False, label=label)
    axes.set(xlabel="period T_b of the support [s], 0: the ground", ylim=(0, 1), xlim=(0, None))
    axes.set_ylabel("mean share that overturns [-]")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0))
    return figure


def floor_sentences(panels: Sequence[SupportPanel]) -> list[str]:
    """Say by how much each support amplifies the peak, and what its dominant pulse is, at its first and last period."""
    sentences = []
    for panel in panels:
        peak = panel.ground.accelerogram.peak_acceleration
        if not peak:
            continue
        parts = []
        for floor in dict.fromkeys((panel.floors[0], panel.floors[-1])):
            assert floor.support is not None
            factor = floor.accelerogram.peak_acceleration / peak
            text = (
                f"at T_b {floor.support.first_period:.3g} s the peak is {factor:.2g} times that of the ground"
            )
            if floor.analysis is not None:
                pulse = floor.analysis.evidence.pulse
                amplitude = quantity(abs(pulse.amplitude), "m/s²").replace(" ", "\u00a0")
                text += f", and the dominant sine has {amplitude} and {pulse.period:.2g} s"
            parts.append(text)
        sentences.append(f"On {panel.structures[0].scene.place.name}, {'; '.join(parts)}.")
    return sentences
