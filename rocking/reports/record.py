"""The report of one record: what an engineer hands to a client. Page one is looked at, the tables stand at the end."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib.metadata import version
from itertools import accumulate
from textwrap import wrap
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle
from matplotlib.transforms import Affine2D

from rocking.assessment.fate import Fate, RecordTables
from rocking.assessment.rows.of_record import RATIO_COLUMNS, ComparisonRow, PulseRow, RecordRow
from rocking.assessment.rows.of_study import StructureRow, structure_rows
from rocking.assessment.verdict import NEGLIGIBLE, Agreement, Method, Verdict, agreement, rests
from rocking.motion.response import Response
from rocking.pulses import Flag
from rocking.quantities import GRAVITY, counted
from rocking.records.accelerogram import Accelerogram
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.drawings import draw_structure, fallen_rotation, round_length
from rocking.reports.ground import POINTS, Motion, draw_ground, ground_figure, pulses_figure
from rocking.reports.panels import draw_rotation, rotation_ratios
from rocking.reports.printing import (
    Column,
    columns_of,
    left_out,
    number,
    ratio,
    short,
    strong,
    table,
    table_of,
    words,
)
from rocking.reports.style import PREDICTED, TEXT_WIDTH, elided, new_figure, panel_at, pictures, styled
from rocking.structures import Structure

ABOUT = ("study", "client", "author", "date")
"""Settings that stand above the title."""
MOST_DRAWN = 10
"""Structures of page one and of the histories, the worst first; the tables hold all."""
MOST_NAMED, MOST_LETTERS = 12, 300
"""Structures that the first lines name with one verdict, and their letters."""
MOST_PULSES = 3
"""Ranks of pulses that are shown."""
MOST_COMPARED = 24
"""Cases whose comparison is drawn, those with the largest rotations."""
LOOKS: dict[Verdict, tuple[str, str, str, str]] = {
    Verdict.OVERTURNS: ("▲", "#7a2400", "white", "xxxx"),
    Verdict.UNDECIDED: ("?", "#f0a030", "black", "///"),
    Verdict.UNKNOWN: ("–", "white", "black", ""),
    Verdict.STANDS: ("●", "#dceaf7", "black", ""),
}
"""Sign, colour, colour of letters on it, and pattern of each verdict: in print without colour the others tell it."""
_COLUMNS, _DRAWN = 5, (30.0, 27.0)
"""Structures of a row of page one; width and height of each drawing, mm."""
_LINE, _LETTERS = 3.2, 27
"""Height of a line below a drawing, mm, and its letters."""
_HISTORIES, _HIGHEST_ROW = 160.0, 30.0
"""Height of all histories together, and of one at most, mm."""
_STILL, _HIGHEST = 0.01, 1.25
"""Share of the largest rotation below which a history is cut; rotation ratio beyond which it is not drawn."""
_SMALLEST, _FALLEN = 1e-3, 3.0
"""Rotation ratios at the left end of the comparison, and where overturning stands."""
METHODS = {
    Method.PRINTED: "Eq. 15 as printed",
    Method.CLOSED_FORM: "Closed form",
    Method.MECHANISM_ON_PULSE: "Mechanism, pulse",
    Method.BLOCK_ON_RECORD: "Block, record",
    Method.MECHANISM_ON_RECORD: "Mechanism, record",
}
"""Headings of the methods, from the plainest to the full integration."""


@dataclass(frozen=True, eq=False)
class RecordReport:
    """The report of one record, and what several of its pages ask for.

    Every number of a table is a cell of `tables` or of the structures table, rounded. structures: by name. settings: at
    least tolerance and acceleration_scale; study, client, author and date where they are given. responses: those of
    the mechanism under the record with their histories, by component and structure.
    """

    record: str
    accelerograms: Sequence[Accelerogram]
    structures: Mapping[str, Structure]
    tables: RecordTables
    settings: Mapping[str, Any]
    responses: Mapping[tuple[str, str], Response] = field(default_factory=dict)

    def pdf(self) -> bytes:
        """Return the document."""
        return compile_document("record.typ", self.data())

    def data(self) -> dict[str, object]:
        """Return what the template is given: texts, tables and figures."""
        return {
            "title": f"Rocking assessment: {self.record}",
            "running": f"{self.record}.{self.scale_note}",
            "scale-note": self.scale_note,
            **_page_one(self),
            **_page_two(self),
            **_page_three(self),
            **_appendix(self),
        }

    @cached_property
    def fates(self) -> list[Fate]:
        """What became of each structure, the worst first."""
        return sorted(self.tables.verdicts, key=lambda fate: fate.severity, reverse=True)

    @cached_property
    def numbers(self) -> dict[str, str]:
        """The number by which each structure is called, from 1, by name."""
        names = dict.fromkeys([*self.structures, *(row.structure for row in self.tables.verdicts)])
        return {name: str(place) for place, name in enumerate(names, start=1)}

    @cached_property
    def motions(self) -> list[Motion]:
        """The components that were assessed, with their ranked pulses."""
        assessed = {row.component for row in self.tables.record}
        ranked = sorted((row for row in self.tables.pulses if row.ranked), key=lambda row: row.rank)
        return [
            Motion(each, [row.pulse for row in ranked if row.component == each.component])
            for each in self.accelerograms
            if each.component in assessed
        ]

    @cached_property
    def worst(self) -> dict[str, ComparisonRow]:
        """Of each structure the component that turns it farthest."""
        return worst_cases(self.tables.comparison)

    @cached_property
    def scale_note(self) -> str:
        """The declared scale factors for captions and the running head, or nothing."""
        factors = _each(
            printing.given(row.scale_factor) for row in self.tables.record if row.scale_factor != 1
        )
        return f" Accelerations ×\u00a0{factors}, declared." if factors else ""

    def label(self, structure: str) -> str:
        """Return number and name of a structure."""
        return f"{self.numbers[structure]} {structure}"


def _each(texts: Iterable[str]) -> str:
    """Each of the texts once."""
    return ", ".join(dict.fromkeys(filter(None, texts)))


def cell_text(fate: Fate | None) -> str:
    """Return a case in a map: sign and share of members that overturn, in %, or the rotation ratio of a single run."""
    sign = LOOKS[fate.verdict if fate else Verdict.UNKNOWN][0]
    if fate is not None and fate.members:
        return f"{sign} {printing.percent(fate.overturning_share)}"
    return f"{sign} {number(fate.rotation_ratio, 2)}" if fate and fate.rotation_ratio < math.inf else sign


def worst_cases(rows: Iterable[ComparisonRow]) -> dict[str, ComparisonRow]:
    """Return by structure the row of the component that turns it farthest, the first of several that overturn it."""
    farthest = sorted(
        rows, key=lambda row: np.nan_to_num(row.integrated_rotation_ratio, nan=-1), reverse=True
    )
    return {row.structure: row for row in reversed(farthest)}


def failure_report(record: str, message: str) -> bytes:
    """Return a one-page PDF that says why `record` gave no result."""
    told = (
        "Nothing was computed for this record, so no structure was assessed under it. The other records of the run are "
        "not affected. The sentence above also stands in summary/failures.csv."
    )
    data = {
        "title": f"Rocking assessment: {record}",
        "subtitle": "This record gave no result.",
        "parts": [{"notice": message or "No reason was given."}, {"text": told}],
    }
    return compile_document("plain.typ", data)


# Page one --------------------------------------------------------------------------------------------------


def _page_one(report: RecordReport) -> dict[str, object]:
    shown = [fate for fate in report.fates if fate.structure in report.structures][:MOST_DRAWN]
    names = printing.listed([fate.structure for fate in shown])
    return {
        "about": {name: str(report.settings.get(name) or "") for name in ABOUT},
        "subtitle": _subtitle(report.tables.record),
        "key": [_key_numbers(row) for row in report.tables.record],
        "ground": pictures(
            ground_figure, report.motions, "Acceleration of the ground and its dominant pulse."
        ),
        "strip": pictures(
            strip_figure, shown, f"Drawings of the structures in their state: {names}.", report
        ),
        "strip-note": left_out(len(report.fates) - len(shown), "structure", "the table of verdicts"),
        "headlines": headlines(report.fates),
        "sentences": _sentences(report),
        "notices": _notices(report),
    }


@styled
def strip_figure(fates: Sequence[Fate], report: RecordReport) -> Figure:
    """Draw each structure in its state, to one scale each: standing, rocking to its largest rotation, or fallen."""
    lines = [_lines(report, fate) for fate in fates]
    rows = [range(first, min(first + _COLUMNS, len(fates))) for first in range(0, len(fates), _COLUMNS)]
    heights = [_DRAWN[1] + 19 + _LINE * max(len(lines[place]) for place in row) for row in rows]
    figure = new_figure(sum(heights), margins=(0, 0, 0, 0))
    axes = figure.add_axes((0, 0, 1, 1), xlim=(0, TEXT_WIDTH), ylim=(-sum(heights), 0))
    axes.set_axis_off()
    for number_of_row, row in enumerate(rows):
        top = -sum(heights[:number_of_row])
        for column, place in enumerate(row):
            middle = (column + 0.5) * TEXT_WIDTH / _COLUMNS
            _draw_state(axes, report, fates[place], middle, top)
            below = middle, top - _DRAWN[1] - 16.5, "\n".join(lines[place])
            axes.text(*below, ha="center", va="top", fontsize=7, linespacing=1.25)
    return figure


def _draw_state(axes: Axes, report: RecordReport, fate: Fate, middle: float, top: float) -> None:
    sign, colour, ink, hatch = LOOKS[fate.verdict]
    structure = report.structures[fate.structure]
    cracked = (each.structure for each in structure.candidates() if each.description == fate.crack)
    structure = next(cracked, structure)
    rotation = drawn_rotation(structure, fate)
    points = np.vstack([*structure.outline(), *structure.outline(rotation)])
    low, high = points.min(axis=0), points.max(axis=0)
    scale = float(min(np.array(_DRAWN) / (high - low)))
    foot = np.array([middle, top - 7 - _DRAWN[1]])
    origin = np.array([(low[0] + high[0]) / 2, min(low[1], 0.0)])
    place = Affine2D().translate(*-origin).scale(scale).translate(*foot)
    look = {"facecolor": colour, "hatch": hatch, "edgecolor": "0.25", "linewidth": 0.6}
    draw_structure(axes, structure, rotation, look=look, place=place)
    axes.plot([middle - 15, middle + 15], [foot[1]] * 2, color="0.5", linewidth=0.6, zorder=0)
    label = elided(report.label(fate.structure), 23)
    axes.text(middle, top - 1, label, ha="center", va="top", fontweight="bold")
    bar = round_length(0.5 * _DRAWN[0] / scale)
    axes.plot([middle - bar * scale / 2, middle + bar * scale / 2], [foot[1] - 2.0] * 2, "k", linewidth=1.5)
    axes.text(middle + bar * scale / 2 + 1, foot[1] - 2.0, f"{bar:g} m", va="center", fontsize=7)
    frame = Rectangle(
        (middle - 16, foot[1] - 8.5), 32, 4.5, facecolor=colour, edgecolor="0.25", linewidth=0.5
    )
    axes.add_patch(frame)
    word = f"{sign} {fate.verdict}"
    axes.text(middle, foot[1] - 6.3, word, ha="center", va="center", color=ink, fontweight="bold")


def drawn_rotation(structure: Structure, fate: Fate) -> float:
    """Return the signed rotation of a structure on page one, rad: fallen, at its largest rotation or at rest."""
    side = -1 if fate.peak_side == -1 else 1
    if math.isinf(fate.rotation_ratio) or fate.verdict is Verdict.OVERTURNS:
        return fallen_rotation(structure, side)
    if not fate.rotation_ratio > NEGLIGIBLE:
        return 0.0
    sides = structure.mechanism().sides
    return side * fate.rotation_ratio * sides[0 if side > 0 else -1].critical_rotation


def _lines(report: RecordReport, fate: Fate) -> list[str]:
    """What stands below a drawing: members, rotation, statics, and what opens."""
    structure = report.structures[fate.structure]
    static = structure.static_multiplier
    peak = max((row.peak_acceleration_m_s2 for row in report.tables.record), default=math.nan) / GRAVITY
    tells = not (rests(fate.rotation_ratio) or structure.symmetric)
    side = f" {structure.side_names[fate.peak_side < 0]}" if tells and fate.peak_side else ""
    lines = [
        f"{fate.count} overturn" if fate.members else "one run",
        f"as given {_printed(fate.rotation_ratio, fate)}{side}",
    ]
    if fate.members and not rests(fate.rotation_ratio_high) and fate.rotation_ratio_low < math.inf:
        low, high = (_printed(each, fate) for each in (fate.rotation_ratio_low, fate.rotation_ratio_high))
        lines.append(f"5–95 %: {low} to {'falling' if high == 'overturns' else high}")
    lines.append(f"static {number(static, 2)} g, PGA {number(peak / static, 2)} ×")
    for crack in (fate.crack, fate.elsewhere_crack):
        lines += wrap(crack.replace("hinges at", "hinges").replace("°,", ","), _LETTERS)
    if fate.elsewhere_crack and fate.elsewhere_members:
        lines.append(f"there {fate.elsewhere_overturning_members} of {fate.elsewhere_members} overturn")
    return lines


def _printed(value: float, fate: Fate) -> str:
    """A rotation ratio with no more digits than the spread of the ensemble leaves a meaning."""
    if rests(value) or not math.isfinite(value):
        return ratio(value)
    return printing.to_spread(value, fate.rotation_ratio_high - fate.rotation_ratio_low)


def headlines(fates: Sequence[Fate]) -> list[dict[str, str]]:
    """Return the first lines of a report: each verdict with the structures that it is of, the worst first."""
    groups: dict[str, list[str]] = {}
    for fate in fates:
        remark = fate.leaning or (fate.count if fate.verdict is Verdict.OVERTURNS else "")
        remark = fate.why if fate.verdict is Verdict.UNKNOWN else remark
        groups.setdefault(fate.verdict, []).append(fate.structure + (f" ({remark})" if remark else ""))
    lines = []
    for verdict, names in groups.items():
        room = sum(end <= MOST_LETTERS for end in accumulate(map(len, names)))
        named = printing.listed(names, max(1, min(MOST_NAMED, room)))
        lines.append({"verdict": printing.sentence(verdict), "names": named})
    return lines


def _sentences(report: RecordReport) -> list[str]:
    """Return what a reader has to know beside the verdicts, and what file and integrations warn of, each once."""
    depends = []
    for fate in report.fates:
        varied = [row for row in report.tables.variations if row.structure == fate.structure]
        done = [row.integrated_rotation_ratio for row in varied if row.processing]
        if any(map(math.isinf, done)) and any(map(math.isfinite, done)):
            depends.append(fate.structure)
    remarks = [f"Whether it overturns depends on the processing of the record: {printing.listed(depends)}."]
    return [*remarks[: len(depends)], *warnings_of(report.tables)]


def warnings_of(tables: RecordTables) -> list[str]:
    """Return what file and integrations warn of, each once."""
    of_files = [each for row in tables.record for each in row.warnings]
    return list(dict.fromkeys([*of_files, *(row.warning for row in tables.comparison if row.warning)]))


def _notices(report: RecordReport) -> list[dict[str, object]]:
    """Return the warnings that stand above everything: scale factor, nothing moves, what failed."""
    tables = report.tables
    cases = tables.comparison
    scaled = "; ".join(
        f"component {words(row.component)}: ×\u00a0{printing.given(row.scale_factor)}"
        for row in tables.record
        if row.scale_factor != 1
    )
    kinds = ("slides", "bounces")
    failing = [
        f"{row.structure} ({' and '.join(kind for kind in kinds if getattr(row, kind))})"
        for row in cases
        if row.slides or row.bounces
    ]
    named = printing.listed(list(dict.fromkeys(failing)))
    still = "No structure uplifts: the ground acceleration never reaches an uplift acceleration."
    told = {
        still: bool(cases) and all(fate.rotation_ratio == 0 for fate in report.fates),
        f"Not the recorded amplitude. The file was multiplied by a declared factor ({scaled}).": scaled,
        "No structure could be assessed under this record.": not cases,
        f"The model does not hold, because a contact fails, for {named}.": failing,
        "No pulse could be sought in this record, so there is no closed-form prediction.": not tables.pulses,
    }
    told |= {f"{row.structure or row.component}: {row.message}": True for row in tables.failures}
    return [{"strong": text != still, "text": text} for text, holds in told.items() if holds]


def _subtitle(rows: Sequence[RecordRow]) -> str:
    distances = [row.epicentral_distance_m / 1000 for row in rows if row.epicentral_distance_m]
    parts = {
        "{}": (row.event for row in rows),
        "station {}": (row.station for row in rows),
        "magnitude {}": (printing.given(row.magnitude) for row in rows if row.magnitude),
        "{} km from the epicentre": map(printing.given, distances),
    }
    texts = [text.format(each) for text, many in parts.items() if (each := _each(many))]
    return " · ".join(texts) or "The file names no event and no station."


def _key_numbers(row: RecordRow) -> str:
    """PGA, PGV, D5–95 and T_p of a component in a line."""
    period = row.velocity_pulse_period_s
    shown = f"Tp {number(period)} s" if math.isfinite(period) else "no Tp"
    like = {None: "", True: " (pulse-like)", False: " (not pulse-like)"}[row.velocity_pulse_like]
    return (
        f"{words(row.component)}: PGA {number(row.peak_acceleration_m_s2 / GRAVITY)} g, "
        f"PGV {number(row.peak_velocity_m_s)} m/s, D5–95 {number(row.significant_duration_s)} s, {shown}{like}"
    )


# Page two --------------------------------------------------------------------------------------------------


History = tuple[Fate, ComparisonRow, np.ndarray, np.ndarray]
"""What became of a structure, the case that turns it farthest, times [s] and rotation ratio of that (k,)."""


def _page_two(report: RecordReport) -> dict[str, object]:
    histories: list[History] = []
    for fate in report.fates:
        row = report.worst.get(fate.structure)
        response = report.responses.get(row.case) if row else None
        if row and response and row.integrated_rotation_ratio > NEGLIGIBLE:
            history = rotation_ratios(response, report.structures[fate.structure].mechanism())
            histories += [(fate, row, *history)] if history else []
    shown = histories[:MOST_DRAWN]
    left = len(report.fates) - len(shown)
    alt = f"Rotation histories of {counted(len(shown), 'structure')} above the acceleration of the ground."
    return {
        "histories": pictures(histories_figure, shown, alt, report),
        "histories-note": left_out(left, "structure", "the table of verdicts, at rest or less demanding"),
    }


@styled
def histories_figure(histories: Sequence[History], report: RecordReport) -> Figure:
    """Draw the rotation of each structure, one below the other, and beneath them the ground, on one time axis.

    Each row has a scale of its own, which stands below its name.
    """
    row = min(_HIGHEST_ROW, _HISTORIES / len(histories))
    below, left, width = 20.0, 38.0, TEXT_WIDTH - 77
    figure = new_figure(row * len(histories) + below * len(report.motions) + 9)
    panel = panel_at(figure, left, 1, width, row * len(histories))
    for place, history in enumerate(histories):
        _draw_history(panel, report, history, -place)
    # the time in which anything moves
    sizes = [(times, np.abs(ratio)) for _, _, times, ratio in histories]
    moving = np.concatenate([times[size > _STILL * size.max()] for times, size in sizes])
    margin = 0.05 * (moving.max() - moving.min())
    span = max(0.0, moving.min() - margin), moving.max() + margin + 1e-3
    panel.set(xlim=span, ylim=(0.5 - len(histories), 0.5), xticks=[], yticks=[])
    panel.spines[["left", "bottom"]].set_visible(False)
    for place, motion in enumerate(report.motions):
        top = 2 + row * len(histories) + place * below
        draw_ground(panel_at(figure, left, top, width, below - 3), motion, span, motion is report.motions[-1])
    return figure


def _draw_history(panel: Axes, report: RecordReport, history: History, level: int) -> None:
    fate, row, times, ratios = history
    predicted = row.predicted_rotation_ratio
    largest = (each for each in (float(np.abs(ratios).max()), predicted) if 0 < each < math.inf)
    reach = min(1.25 * max(largest, default=1.0), _HIGHEST)
    band = min(fate.rotation_ratio_low, reach), min(fate.rotation_ratio_high, reach)
    draw_rotation(
        panel,
        times,
        np.clip(ratios, -reach, reach),
        predicted if predicted <= reach else math.inf,
        band if fate.members else None,
        level=level,
        scale=0.45 / reach,
        most=POINTS,
    )
    component = f", {elided_component(row.component)}" if len(report.motions) > 1 else ""
    label = f"{elided(report.label(fate.structure), 22)}\n± {reach:.2g}"
    remark = (
        f"{ratio(row.integrated_rotation_ratio, 2)}{component}, {counted(row.impacts or 0, 'impact')}\n"
        f"closed form: {ratio(predicted, 2)}"
    )
    beside: dict[str, Any] = {"transform": panel.get_yaxis_transform(), "va": "center", "fontsize": 7}
    panel.text(-0.02, level, label, ha="right", linespacing=1.3, **beside)
    panel.text(1.01, level, remark, ha="left", linespacing=1.3, **beside)


def elided_component(name: str) -> str:
    """Return a component's name as a figure has room for it."""
    return short(words(name), 10)


# Page three ------------------------------------------------------------------------------------------------


def _page_three(report: RecordReport) -> dict[str, object]:
    rows = [row for row in report.tables.comparison if row.agreement is not Agreement.UNKNOWN]
    demanding = sorted(
        rows, key=lambda row: (row.agreement is Agreement.TOO_LOW, row.integrated_rotation_ratio)
    )
    drawn = [row for row in rows if row in demanding[-MOST_COMPARED:]]
    with_pulse = [motion for motion in report.motions if motion.pulses]
    alt = f"Closed form beside integration of {counted(len(drawn), 'case')}."
    return {
        "pulse-figures": pictures(pulses_figure, with_pulse, "The dominant pulse and its evidence."),
        "comparison": pictures(comparison_figure, drawn, alt, report),
        "comparison-note": left_out(len(rows) - len(drawn), "case", "the table of every method"),
        "pulse-sentences": [_pulse_sentence(report, motion) for motion in with_pulse],
        "doubts": _doubts(report, rows),
    }


@styled
def comparison_figure(cases: Sequence[ComparisonRow], report: RecordReport) -> Figure:
    """Draw closed form, block and mechanism of each case on one line, bold where the closed form is unsafe."""
    height = 4.3 * len(cases)
    figure = new_figure(height + 16)
    panel = panel_at(figure, 46, 6, TEXT_WIDTH - 46 - 40, height)
    rows = np.arange(len(cases))
    shown = (Method.CLOSED_FORM, Method.BLOCK_ON_RECORD, Method.MECHANISM_ON_RECORD)
    ratios = np.array([[getattr(case, RATIO_COLUMNS[method]) for method in shown] for case in cases])
    form, block, whole = np.where(np.isinf(ratios), _FALLEN, np.maximum(ratios, _SMALLEST)).T
    unsafe = np.array([case.agreement is Agreement.TOO_LOW for case in cases])
    panel.hlines(rows[~unsafe], form[~unsafe], whole[~unsafe], color="0.6", linewidth=0.8)
    panel.hlines(rows[unsafe], form[unsafe], whole[unsafe], color="#D55E00", linewidth=2.0)
    panel.plot(form, rows, "D", color=PREDICTED, fillstyle="none", markersize=5, label="closed form, pulse")
    panel.plot(block, rows, "s", color="0.45", fillstyle="none", markersize=4, label="block, whole record")
    panel.plot(whole, rows, "o", color="black", markersize=3.5, label="mechanism, whole record")
    labels = []
    for place, case in enumerate(cases):
        name = report.label(case.structure)
        several = len(report.motions) > 1
        labels.append(f"{short(name, 20)}, {elided_component(case.component)}" if several else name)
        remark = case.prediction_in_words
        panel.text(1.02, place, remark, transform=panel.get_yaxis_transform(), va="center", fontsize=7)
    panel.set(xscale="log", xlim=(0.7 * _SMALLEST, 1.5 * _FALLEN), ylim=(len(cases) - 0.5, -0.5))
    panel.set_yticks(rows, [elided(label, 30) for label in labels])
    ticks = {_SMALLEST: "rests", 0.01: "0.01", 0.1: "0.1", 0.3: "0.3", 1.0: "1", _FALLEN: "overturns"}
    panel.set_xticks(list(ticks), list(ticks.values()))
    panel.set_xticks([], minor=True)
    panel.axvline(1.0, color="0.5", linewidth=0.5)
    panel.set_xlabel("largest rotation / critical rotation [-]")
    figure.legend(loc="upper center", ncols=3)
    return figure


def _pulse_sentence(report: RecordReport, motion: Motion) -> str:
    """Say what the dominant pulse of a component is, and what makes it doubtful."""
    component = motion.accelerogram.component
    of_component = report.tables.of_component(component)
    row = next(row for row in of_component.pulses if row.ranked and row.rank == 1)
    sentences = {flag.value: flag.sentence for flag in Flag}
    doubts = [sentences.get(flag, printing.sentence(f"{flag}.")) for flag in row.flags]
    if any(each.pulse_periods_unlike for each in of_component.record):
        doubts.append(
            "Its period differs by more than a factor of two from that of the velocity pulse: they are two features."
        )
    pulse = (
        f"Component {words(component)}: amplitude {number(abs(row.amplitude_m_s2))} m/s², "
        f"period {number(row.period_s)} s, from {number(row.start_time_s)} s on; it "
        f"explains {printing.percent(row.explained_energy)}\u00a0% of the acceleration energy."
    )
    return " ".join([pulse, *doubts])


def _doubts(report: RecordReport, rows: Sequence[ComparisonRow]) -> list[str]:
    """Say where the closed form says less than happens, and which of its two simplifications is the reason."""
    reasons: dict[str, list[str]] = {}
    for row in sorted(rows, key=lambda row: -row.integrated_rotation_ratio):
        if row.agreement is Agreement.TOO_LOW:
            kept = tuple(
                agreement(simpler, row.integrated_rotation_ratio) is Agreement.SAME
                for simpler in (row.block_on_record_rotation_ratio, row.mechanism_on_pulse_rotation_ratio)
            )
            name = row.structure + (f" ({words(row.component)})" if len(report.motions) > 1 else "")
            reasons.setdefault(_BLAME[kept], []).append(name)
    if not reasons:
        return ["The closed form says of no structure less than happens."] if rows else []
    return [
        f"The closed form misses what happens to {printing.listed(names, 8)}: {why}."
        for why, names in reasons.items()
    ]


_BLAME: dict[tuple[bool, ...], str] = {
    (True, True): "either simplification alone would have kept the outcome, both together do not",
    (True, False): "the equivalent block under the whole record has it, so the single pulse is the reason",
    (False, True): "the mechanism under the pulse has it, so the equivalent block is the reason",
    (False, False): "neither the block under the whole record nor the mechanism under the pulse has it",
}
"""By whether the block under the record, and the mechanism under the pulse, have the outcome of the integration."""


# Appendix --------------------------------------------------------------------------------------------------


def _appendix(report: RecordReport) -> dict[str, object]:
    tables, record = report.tables, report.tables.record
    number_of: Column = ("No.", "auto", "r", lambda row: report.numbers[row.structure])
    ranked = [row for row in tables.pulses if row.rank <= MOST_PULSES]
    structures = list(structure_rows(report.structures))
    return {
        "facts": facts_table(record),
        "verdicts": table_of(report.fates, number_of, *VERDICT_COLUMNS),
        "structures": table_of(structures, number_of, *STRUCTURE_COLUMNS),
        "pulses": table_of(ranked, *PULSE_COLUMNS),
        "methods": table_of(tables.comparison, number_of, *_method_columns(tables.comparison)),
        "tolerance": printing.given(float(report.settings["tolerance"])),
        "acceleration-scale": str(report.settings["acceleration_scale"]),
        "friction": printing.given(report.settings.get("friction_coefficient")),
        "vertical": _each(row.vertical_component for row in record),
        "arch": any("arch" in row.type for row in structures),
        "tapering": any(
            each.crack_margin > 1 and len(each.candidates()) > 1 for each in report.structures.values()
        ),
        # the time of the run is left out
        "times": _each(row.start_time for row in record),
        "files": _each(f"{words(row.file)}, SHA-256 {row.record_sha256}" for row in record),
        "settings": _each(f"{row.settings_sha256[:16]}…" for row in record),
        "version": version("rocking"),
    }


FACTS = (
    "event station file format unit licence scale_factor samples time_step_s duration_s high_pass_frequency_hz "
    "processing peak_acceleration_m_s2 rotd50_peak_acceleration_m_s2 rotd100_peak_acceleration_m_s2 peak_velocity_m_s "
    "peak_displacement_m arias_intensity_m_s significant_duration_s velocity_pulse_period_s velocity_pulse_azimuth_deg "
    "velocity_pulse_orientation_rad velocity_pulse_peak_velocity_m_s velocity_pulse_indicator pulse_period_ratio "
    "vertical_component vertical_peak_acceleration_m_s2"
)
"""Fields of the record table that a report shows."""


def facts_table(rows: Sequence[RecordRow]) -> dict[str, object]:
    """Return what was read, done and measured: one column per component, or two columns of facts for a single one."""
    shown = [[head, *map(show, rows)] for head, _, _, show in columns_of(RecordRow, FACTS)]
    facts = [texts for texts in shown if set(texts[1:]) != {printing.NOTHING}]
    if len(rows) == 1:
        facts += [["", ""]] * (len(facts) % 2)
        half = len(facts) // 2
        columns = [("", "auto", "l"), ("", "1", "l")] * 2
        return table(columns, [left + right for left, right in zip(facts[:half], facts[half:], strict=True)])
    components = [(f"Component {words(row.component)}", "1", "l") for row in rows]
    return table([("", "auto", "l"), *components], facts)


VERDICT_COLUMNS: list[Column] = [
    *columns_of(Fate, "structure=1.3"),
    ("Verdict", "0.7", "l", lambda fate: strong(str(fate.verdict), fate.verdict is not Verdict.STANDS)),
    ("Members that overturn", "0.8", "l", lambda fate: words(fate.count)),
    ("As given", "0.7", "l", lambda fate: _printed(fate.rotation_ratio, fate)),
    ("5 %", "0.75", "r", lambda fate: _printed(fate.rotation_ratio_low, fate)),
    ("50 %", "0.75", "r", lambda fate: _printed(fate.rotation_ratio_median, fate)),
    ("95 %", "0.75", "r", lambda fate: _printed(fate.rotation_ratio_high, fate)),
    *columns_of(Fate, "direction=1.1 polarity=0.7"),
]
STRUCTURE_COLUMNS: list[Column] = [
    (
        "Structure, type and geometry",
        "3.4",
        "l",
        lambda row: strong(row.structure) | {"below": f"{words(row.type)}: {row.geometry}"},
    ),
    *columns_of(
        StructureRow,
        "frequency_parameter_rad_s=0.95 critical_rotation_rad=0.85 uplift_multiplier=0.95 "
        "acceleration_scale_linearised=1.15 acceleration_scale_uplift=1.15 restitution=1.1 restoring_defect=0.95 "
        "forcing_defect",
    ),
]
PULSE_COLUMNS = columns_of(
    PulseRow,
    "component=auto kind=auto rank=auto amplitude_m_s2 period_s start_time_s gain_ratio explained_energy "
    "effective_length_m",
)


def _method_columns(rows: Sequence[ComparisonRow]) -> list[Column]:
    """Every method that gave anything beside the others, and what stands behind them."""
    heads = {RATIO_COLUMNS[method]: head for method, head in METHODS.items()}
    used = [name for name in heads if not all(math.isnan(getattr(row, name)) for row in rows)]
    of_methods = columns_of(ComparisonRow, " ".join(used))
    return [
        ("Comp.", "0.6", "l", lambda row: words(row.component)),
        ("a [-]", "0.5", "r", lambda row: number(row.amplitude_ratio)),
        ("ω/p [-]", "0.5", "r", lambda row: number(row.frequency_ratio)),
        *((heads[name], *column[1:]) for name, column in zip(used, of_methods, strict=True)),
        *columns_of(ComparisonRow, "peak_time_s=0.45 impacts required_friction slides=0.5 bounces", "0.65"),
    ]
