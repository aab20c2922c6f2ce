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
from rocking.floors.spectrum import FLOOR_DAMPING, floor_spectrum, has_code_spectrum, spectrum_of
from rocking.quantities import GRAVITY
from rocking.records.measures import response_spectrum
from rocking.reports.printing import LOOKS, quantity
from rocking.reports.style import (
    PREDICTED,
    elided,
    new_figure,
    panel_at,
    plain_logarithmic,
    styled,
    wrapped,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
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
def supports_figure(panels: Sequence[SupportPanel]) -> Figure:
    """Draw of each support the share that overturns against its period, and the spectra of ground and floor."""
    height = 46.0
    figure = new_figure(height * len(panels) + 2)
    for place, panel in enumerate(panels):
        top = 6 + place * height
        share = panel_at(figure, 14, top, 60, height - 18)
        spectra = panel_at(figure, 100, top, 42, height - 18)
        _draw_shares(share, panel.structures)
        if any(period_result.reserve for scene in panel.structures for period_result in scene.periods):
            _draw_reserves(share, panel.structures)
        _draw_spectra(spectra, panel)
    return figure


def _draw_shares(axes: Axes, structures: Sequence[SceneResult]) -> None:
    """Draw share against period, one line for each structure; a marker has the colour of its verdict."""
    for line, scene in zip(_LINES * len(structures), structures, strict=False):
        periods = scene.first_periods
        shares = [period_result.decision.share for period_result in scene.periods]
        axes.plot(
            periods,
            shares,
            line,
            color="0.35",
            linewidth=0.9,
            label=elided(scene.scene.name, 24),
            zorder=1,
        )
        for period, share, period_result in zip(periods, shares, scene.periods, strict=True):
            colour = LOOKS[period_result.decision.word][1]
            axes.plot(
                [period],
                [share],
                "o",
                markerfacecolor=colour,
                markeredgecolor="0.2",
                markersize=4.5,
                clip_on=False,
            )
    axes.set(ylim=(-0.05, 1.05), xlabel="period T_b of the support [s], 0: the ground")
    axes.set_ylabel("share that overturns [-]")
    axes.set_title(elided(f"on {structures[0].scene.place.name}", 40), loc="left")
    axes.legend(loc="best")


def _draw_reserves(axes: Axes, structures: Sequence[SceneResult]) -> None:
    """Draw on a scale of its own the factor on the record at which half of the members overturn, where there is one.

    Single points, with nothing between them: it is searched on the ground and at the worst period.
    """
    reserve_axes = axes.twinx()
    limits = []
    for scene in structures:
        periods = scene.first_periods
        reserves = [period_result.reserve for period_result in scene.periods]
        factors = [reserve.median if reserve else np.nan for reserve in reserves]
        limits += [reserve.limit for reserve in reserves if reserve]
        reserve_axes.plot(periods, factors, linestyle="", marker="x", color=PREDICTED, markersize=3.5)
    reserve_axes.set(ylim=(0, max(limits)))
    reserve_axes.set_ylabel("median reserve [×]", color=PREDICTED)
    reserve_axes.spines["right"].set_visible(True)


def _draw_spectra(axes: Axes, panel: SupportPanel) -> None:
    """Draw the 5 % spectra of ground and floor, and the code's floor spectrum from that of the ground."""
    record = panel.ground.accelerogram
    place = panel.structures[0].scene.place
    of_ground = response_spectrum(record, _PERIODS, FLOOR_DAMPING).pseudo_acceleration
    axes.plot(_PERIODS, of_ground / GRAVITY, color="0.6", linewidth=1.6, label="ground")
    for line, floor in zip(_LINES, panel.floors, strict=False):
        support = next(support for support in place.supports if support == floor.support)
        own = response_spectrum(floor.accelerogram, _PERIODS, FLOOR_DAMPING).pseudo_acceleration
        label = f"T_b {support.first_period:.3g} s"
        axes.plot(_PERIODS, own / GRAVITY, line, color="black", linewidth=0.9, label=label)
        if has_code_spectrum(support):
            code = floor_spectrum(support, _PERIODS, FLOOR_DAMPING, spectrum_of(record))
            axes.plot(_PERIODS, code / GRAVITY, line, color=PREDICTED, linewidth=0.9)
    axes.plot([], [], color=PREDICTED, linewidth=0.9, label="code, C7.2.5")
    plain_logarithmic(axes, "x")
    axes.set(xlim=(_PERIODS[0], _PERIODS[-1]), ylim=(0, None), xlabel="period of what stands there [s]")
    axes.set_ylabel("5 % spectrum [g]")
    axes.set_title(elided(f"component {record.component or 'not named'}", 30), loc="left")
    axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.05))


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
