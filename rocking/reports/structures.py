"""The document of the structures at the design level: one page each, which an engineer signs."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.assessment.decide import ORDER, Verdict
from rocking.assessment.reserve import Reserve
from rocking.assessment.scene import placed
from rocking.codes.check import Check, StructureCheck
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.local_mechanism import LIMIT_STATES, LocalMechanism
from rocking.codes.rows import KINDS, disagreement
from rocking.codes.selection import Selection
from rocking.floors.place import GROUND, Place
from rocking.floors.support import Support
from rocking.quantities import counted, percent
from rocking.remarks import Kind, Remark
from rocking.reports import printing
from rocking.reports.drawings import draw_dimensions, draw_structure
from rocking.reports.panels import ZERO, plot
from rocking.reports.printing import (
    Cell,
    compile_document,
    displaying,
    number,
    plain,
    quantity,
    table,
    unit_of,
    words,
)
from rocking.reports.style import PREDICTED, PULSE, new_figure, panel_at, picture, room_for_texts, styled
from rocking.structures import Structure

_FIGURE_HEIGHT = 112.0
"""mm; with it the page of a structure is full, and the tallest drawing can still be read."""

_TURNED = 0.5
"""Share of the critical rotation at which a mechanism is drawn."""
_POINTS = 200
_QUANTILE = 1.645
"""The deviation of the normal distribution within which nine tenths lie."""


@dataclass(frozen=True, eq=False, kw_only=True)
class CheckedStructure:
    """The content of the page of one structure.

    place, support: where it stands, and of what stands on a support one along its axis, None on the ground below it.
    checked: None where it could not be checked, and `refusal` then says why. overturning_share: mean over the stations
    of the study, of each the mean over its records, nan without any; records, stations: how many there are, but for
    those of which it cannot be told. verdicts: stations by the worst verdict on it there, and doubts: what may make
    one worse than said. followed_beside: records under which this period of the support was not followed, so that they
    count as at the worse one beside it. reserves: under each record of the study under which one was sought;
    reserve_doubts: the kinds of doubt for which they may be too high.
    """

    name: str
    structure: Structure
    checked: StructureCheck | None
    place: Place = GROUND
    support: Support | None = None
    refusal: str = ""
    overturning_share: float = math.nan
    records: int = 0
    stations: int = 0
    verdicts: Mapping[Verdict, int] = field(default_factory=dict)
    doubts: Sequence[Kind] = ()
    followed_beside: int = 0
    reserves: Sequence[Reserve] = ()
    reserve_doubts: Sequence[Kind] = ()


def structures_report(
    structures: Sequence[CheckedStructure],
    spectrum: DesignSpectrum,
    settings: Mapping[str, Any],
    selection: Selection | None = None,
    notices: Sequence[str] = (),
) -> bytes:
    """Return the PDF. settings: as those of the summary. selection: the sets of the dynamic check, None without."""
    return compile_document(
        "structures.typ", structures_data(structures, spectrum, settings, selection, notices)
    )


def structures_data(
    structures: Sequence[CheckedStructure],
    spectrum: DesignSpectrum,
    settings: Mapping[str, Any],
    selection: Selection | None = None,
    notices: Sequence[str] = (),
) -> dict[str, object]:
    """Return what the template is given."""
    with displaying(settings):
        return _data(structures, spectrum, settings, selection, notices)


def _data(
    structures: Sequence[CheckedStructure],
    spectrum: DesignSpectrum,
    settings: Mapping[str, Any],
    selection: Selection | None,
    notices: Sequence[str],
) -> dict[str, object]:
    spectra = []
    motions: dict[str, object] = {"rows": []}
    if selection is not None:
        alt = "Spectra of the set of records and their mean beside the design spectrum."
        spectra = [picture(_selection_figure(selection), alt) | {"caption": f"{selection.words}."}]
        motions = _motion_table(selection)
    return {
        "title": "Checks at the design level",
        **printing.settings_texts(settings),
        "spectrum": spectrum.words,
        "notices": list(notices),
        "spectra": spectra,
        "motions": motions,
        "pages": [_page(each, spectrum) for each in structures],
    }


def _motion_table(selection: Selection) -> dict[str, object]:
    """The records of the chosen set, each with its factor and its peak when scaled."""
    peak = unit_of("m/s²")
    heads = [
        ("Record", "1.6", "l"),
        ("Earthquake and station", "1.6", "l"),
        ("Components", "auto", "r"),
        ("Factor [-]", "auto", "r"),
        (f"Peak when scaled [{peak.name}]", "auto", "r"),
    ]
    lines: list[list[Cell]] = []
    for place in selection.chosen:
        motions = selection.scaled(int(place))
        facts = [each for each in (motions[0].event, motions[0].station) if each]
        lines.append(
            [
                selection.names[place],
                words(facts),
                plain(len(motions)),
                number(float(selection.factors[place])),
                number(max(each.peak_acceleration for each in motions) / peak.size),
            ]
        )
    return table(heads, lines)


def _page(each: CheckedStructure, spectrum: DesignSpectrum) -> dict[str, object]:
    name = placed(each.name, each.place.period_of(each.support))
    head = {
        "name": name,
        "description": f"{each.structure.description}.",
        "comparison": _comparison(each),
    }
    if each.checked is None:
        return head | {"refusal": each.refusal, "figure": [], "sentences": [], "finding": "", "share": ""}
    checked = each.checked
    alt = f"{name}: drawing with sizes and loads, mechanism, and capacity curve with limit displacements."
    return head | {
        "refusal": "",
        "figure": [picture(_structure_figure(each.structure, checked), alt)],
        "checks": _check_table(checked),
        "sentences": [*_support(each), *_sentences(checked)],
        "share": _share(each),
        "finding": disagreement(checked, each.overturning_share, each.stations),
    }


def _check_table(checked: StructureCheck) -> dict[str, object]:
    heads = [
        ("Check", "0.8", "l"),
        ("Clause", "auto", "l"),
        ("Capacity", "1.0", "r"),
        ("Demand", "1.0", "r"),
        ("Ratio [-]", "auto", "r"),
        ("Result", "auto", "l"),
        ("Mechanism that decides", "1.6", "l"),
    ]
    lines: list[list[Cell]] = [
        [
            KINDS[each.clause],
            each.clause,
            _valued(each, each.capacity),
            _valued(each, each.demand),
            each.ratio_in_words,
            {"text": each.outcome, "strong": True},
            each.mechanism,
        ]
        for each in checked.checks
    ]
    return table(heads, lines)


def _valued(check: Check, value: float) -> str:
    letter = "d" if check.unit == "m" else "a_g"
    return f"{letter} = {quantity(value, check.unit)}"


def _sentences(checked: StructureCheck) -> list[str]:
    """The basis of the checks, in sentences."""
    mechanism = checked.governing
    lines = [
        f"Mechanism that governs: {mechanism.description}; α₀ = {number(mechanism.onset_multiplier)}, "
        f"e* = {number(mechanism.participating_mass_ratio)}, FC = {number(mechanism.confidence_factor)}, "
        f"d₀ = {quantity(mechanism.ultimate_displacement, 'm')}; it starts at "
        f"a_g = {quantity(checked.damage_level, 'm/s²')} (SLD)."
    ]
    for state in LIMIT_STATES.values():
        point = mechanism.limit(state)
        if math.isinf(point.displacement):
            continue
        lines.append(
            f"d_{state.name} = {quantity(point.displacement, 'm')} ({point.reason}), "
            f"a = {quantity(point.acceleration, 'm/s²')}, T_{state.name} = {number(point.period)} s."
        )
    lines += _terms(checked)
    dynamic = checked.dynamic
    if dynamic is not None:
        said = f"Dynamic check under {counted(dynamic.motions, 'motion')}: {dynamic.sentence}"
        lines.append(f"{said}; {dynamic.refusal}." if dynamic.refusal else f"{said}. {dynamic.caution}")
    elif checked.remark:
        lines.append(str(checked.remark))
    else:
        lines.append("The dynamic check was not made: there are no sets of records for it.")
    return lines


def _terms(checked: StructureCheck) -> list[str]:
    """The terms that the check was given beside the structure, and what it leaves unchecked, in sentences."""
    mechanism = checked.governing
    terms = []
    if mechanism.elastic_period:
        terms.append(
            f"It is free to vibrate with T₀ = {number(mechanism.elastic_period)} s, as given (C8.7.1.7)."
        )
    if math.isfinite(mechanism.support_loss):
        terms.append(
            f"What it carries falls at a displacement of {quantity(mechanism.support_loss, 'm')} of the corner that "
            "moves farthest, as given."
        )
    ties = [tie.tie for each in checked.mechanisms for tie in each.static.side.ties]
    if any(math.isinf(tie.strength) for tie in ties):
        terms.append(
            "A tie has no strength of its own: it is taken never to break, and its force is not checked."
        )
    return terms


def _support(page: CheckedStructure) -> list[str]:
    """The sentence on the support on which a structure stands, if it does."""
    if page.support is None:
        return []
    modes = " and ".join(
        f"{number(mode.period)} s with Γψ = {number(mode.participation)}" for mode in page.support.modes
    )
    return [
        f"It stands on {page.place.name}, a support of period {modes}: the demands are those there (C7.2.5 to "
        "C7.2.10), and the dynamic check follows the motion there."
    ]


def _comparison(page: CheckedStructure) -> str:
    """The warning above the page of a structure that stands on a support and is taken on the ground; "" elsewhere."""
    if page.support is not None or not page.place.supports:
        return ""
    return (
        f"For comparison only: {page.name} stands on a support, and this page takes it on the ground; "
        "sign the pages of its support."
    )


def _share(each: CheckedStructure) -> str:
    counts = ", ".join(
        f"{word.predicate} under {counted(each.verdicts[word], 'station')}"
        for word in ORDER
        if each.verdicts.get(word)
    )
    reasons = f" ({'; '.join(str(Remark(kind)) for kind in each.doubts)})" if each.doubts else ""
    if not each.stations:
        told = f"; it {counts}{reasons}" if counts else ""
        return f"No record of the study tells whether it overturns{told}."
    low, high = share_interval(each.overturning_share, each.stations)
    share = (
        f"Under the {counted(each.records, 'record')} of {counted(each.stations, 'station')} of the study, uncertain "
        f"inputs considered, it overturns with a share of {percent(each.overturning_share)} % (90 % interval over "
        f"stations: {percent(low)} to {percent(high)} %). By the worst record of each it {counts}{reasons}."
    )
    if each.followed_beside:
        share += (
            f" Under {counted(each.followed_beside, 'record')} this period was not followed, as the periods beside it "
            "have one verdict: the worse of these counts."
        )
    return f"{share} {_reserve(each)}"


def _reserve(each: CheckedStructure) -> str:
    """The sentence on by how much the records may be stronger: the least reserve, the middle one, their doubts."""
    if not each.reserves:
        return "No reserve was sought, by how much these records may be stronger."
    lows = np.array([reserve.low for reserve in each.reserves])
    reached = lows[~np.isnan(lows)]
    limit = max(reserve.limit for reserve in each.reserves)
    of_all = f"all {counted(lows.size, 'record')}" if lows.size > 1 else "that record"
    if lows.size < each.records:  # on a support it is sought at the worst period of each record
        of_all = f"the {counted(lows.size, 'record')} of {each.records} of which this is the worst period"
    if not reached.size:
        words = f"Under {of_all} fewer than 5 % of its members fall up to {limit:g} times the record"
    else:
        words = f"5 % of its members fall at {number(reached.min(), 2)} times the most demanding record"
        if lows.size > 1:
            median = float(np.quantile(np.where(np.isnan(lows), np.inf, lows), 0.5, method="lower"))
            middle = f"beyond {limit:g}" if math.isinf(median) else f"at {number(median, 2)}"
            words = f"{words}, and {middle} times the record in the median over {of_all.removeprefix('all ')}"
        elif lows.size < each.records:
            words = f"{words}, over {of_all}"
    if each.reserve_doubts:
        reasons = " and ".join(str(Remark(kind)) for kind in each.reserve_doubts)
        words = f"{words}; this is the reserve of the mechanism alone, and too high where {reasons}"
    return f"{words}."


def share_interval(share: float, count: int) -> tuple[float, float]:
    """Return the 90 % interval of a share of `count` stations after Wilson (1927)."""
    squared = _QUANTILE**2 / count
    centre = (share + squared / 2) / (1 + squared)
    half = math.sqrt(share * (1 - share) * squared + squared**2 / 4) / (1 + squared)
    return max(centre - half, 0.0), min(centre + half, 1.0)


@styled
def _structure_figure(structure: Structure, checked: StructureCheck) -> Figure:
    """Three panels: the structure with sizes and loads, its mechanism, and the capacity curve."""
    figure = new_figure(_FIGURE_HEIGHT)
    mechanism = checked.governing
    drawn = panel_at(figure, 2, 4, 60, _FIGURE_HEIGHT - 10)
    draw_structure(drawn, structure, values=True)
    draw_dimensions(drawn, structure, values=True)
    turned = panel_at(figure, 62, 4, 36, _FIGURE_HEIGHT - 10)
    critical = mechanism.static.side.critical_rotation
    draw_structure(turned, mechanism.body, mechanism.sign * _TURNED * critical)
    for axes, title in ((drawn, "sizes and loads"), (turned, "mechanism")):
        axes.set_title(title)
        axes.set_aspect("equal", adjustable="datalim")
        axes.margins(0.08)
        axes.autoscale_view()
        axes.set_axis_off()
    room_for_texts(figure, drawn)
    _draw_capacity(panel_at(figure, 112, 4, 56, _FIGURE_HEIGHT - 13), mechanism)
    return figure


def _draw_capacity(axes: Axes, mechanism: LocalMechanism) -> None:
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
        label = f"d_{name} = {quantity(point.displacement, 'm')}, T_{name} = {number(point.period)} s"
        place = point.displacement / length.size
        level = point.acceleration / force.size
        axes.plot([0, place], [0, level], "--", color=colour, linewidth=0.8)
        axes.plot(place, level, "o", color=colour, markersize=4, label=label)
    axes.axhline(0, **ZERO)
    axes.margins(x=0)
    axes.set_ylim(0, 1.35 * float(accelerations.max()))
    axes.set(
        xlabel=f"displacement d [{length.name}]",
        ylabel=f"acceleration a [{force.name}]",
        title="capacity curve",
    )
    if axes.get_legend_handles_labels()[0]:
        axes.legend(loc="upper right")


@styled
def _selection_figure(selection: Selection) -> Figure:
    figure = new_figure(80.0)
    plot(selection, figure.subplots())
    return figure
