"""The report over all records: the map of what becomes of what, what each method costs, and where it fails."""

import math
from collections import Counter
from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from rocking.assessment.conclusion import (
    conclusion_in_words,
    conclusions,
    fallen_in_one_run,
    falls_in_words,
    falls_seen_in_words,
    to_check,
    worst_of_each,
)
from rocking.assessment.decide import ORDER, Verdict, worst_first
from rocking.assessment.methods import Agreement, Method, agreement, ratio_in_words, within_factor_two
from rocking.assessment.rows import (
    RATIO_COLUMNS,
    AgreementRow,
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    PulseRow,
    RecordRow,
    StructureRow,
    SupportRow,
    VerdictRow,
    WarningRow,
    counted_apart,
    counted_cases,
    made_records,
    worst_period_each,
)
from rocking.assessment.scene import placed
from rocking.quantities import GRAVITY, counted, listed
from rocking.reports import printing
from rocking.reports.design_figure import design_summary_figure
from rocking.reports.matrix import MOST_RECORDS as MOST_RECORDS_BESIDE
from rocking.reports.matrix import MOST_WITH_ALL, matrix
from rocking.reports.pages import (
    Cell,
    MapCell,
    MapRow,
    Notice,
    PageSettings,
    PageTable,
    Panel,
    Scatter,
    Section,
    SeverityMap,
    Strip,
    SummaryPage,
    TableCell,
)
from rocking.reports.printing import (
    Column,
    columns_of,
    displaying,
    known_crack,
    number,
    plain,
    ratio,
    remainder,
    strong,
    table_of,
    unit_of,
    words,
)
from rocking.reports.scatter import lifts, prediction_scatter
from rocking.reports.style import elided, new_figure, picture, pictures, styled, wrapped
from rocking.reports.supports import shares_by_period_figure
from rocking.structures import Structure
from rocking.tables import Row, rows_of

if TYPE_CHECKING:
    from rocking.codes.design_spectrum import DesignSpectrum

FEWEST_POINTS = 3
"""Cases from which on the closed form is drawn against the integration; fewer are read from the tables."""
MOST_MAPPED = 48
"""Records of the map, the worst first; verdicts.csv holds all."""
MOST_ON_PAGE_ONE = 12
"""Of these those on the first page, above the scatter."""
MOST_STRUCTURES = 20
"""Structures of the map, likewise."""
MOST_LISTED = 20
"""Rows of the lists of unsafe cases and of failures; the CSV tables hold all."""
MOST_RECORDS = 200
"""Rows of the list of the records, likewise."""
MOST_HIGH = 12
"""Structures up to which the rows of the matrix and the scatter below it are high."""
_HIGH, _LOW = 112.0, 76.0
"""Heights of the scatter, mm."""
_BESIDE = 30
"""Letters of a name at a bar."""
_LETTERS = 8.0
"""Of the tables, pt."""
_TOGETHER = 14
"""Rows of the list of the records that stay together, so that no last page is nearly empty."""
_UNKNOWN = [(math.nan, math.nan)]
"""The peaks of a record of which there is no row."""
_HEAD = 26
"""Letters of a name above a column of the map; the table of the structures holds it whole."""


Design = tuple["DesignSpectrum", Sequence[Sequence[float]]]
"""The design level of a study, and the spectra [m/s²] of the components as `component_spectra` gives them."""


def summary_data(
    rows: Mapping[type[Row], Sequence[Row]],
    settings: PageSettings,
    design: Design | None = None,
    strips: Sequence[Strip] = (),
    other_conclusions: Sequence[str] = (),
    panels: Sequence[Panel] = (),
    structures: Mapping[str, Structure] = MappingProxyType({}),
) -> SummaryPage:
    """Return the page of the summary: texts, tables and figures.

    rows: of the tables of the summary. design: None where the study has no design level. strips: of the variants of
    structures. other_conclusions, panels: of the other products over all records. structures: by name, of which it is
    said whose crack is known.
    """
    with displaying(settings):
        return _page(rows, settings, design, strips, other_conclusions, panels, structures)


def _page(
    rows: Mapping[type[Row], Sequence[Row]],
    settings: PageSettings,
    design: Design | None,
    strips: Sequence[Strip],
    other_conclusions: Sequence[str],
    panels: Sequence[Panel],
    structures: Mapping[str, Structure],
) -> SummaryPage:
    verdicts = rows_of(VerdictRow, rows)
    shown = worst_period_each(verdicts)
    comparison = list(counted_cases(rows_of(ComparisonRow, rows), verdicts))
    recorded, _ = counted_apart(comparison, made_records(rows_of(RecordRow, rows)))
    concluded = conclusions(verdicts, comparison)
    words_of_all = {
        conclusion.row.structure: conclusion.row.decision.verdict for conclusion in worst_of_each(concluded)
    }
    judged = {row.record for row in shown}
    many = len(judged) > MOST_RECORDS_BESIDE
    failures = rows_of(FailureRow, rows)
    records = rows_of(RecordRow, rows)
    pulses = rows_of(PulseRow, rows)
    agreed = rows_of(AgreementRow, rows)
    unsafe = [row for row in comparison if row.agreement is Agreement.TOO_LOW]
    unsafe.sort(key=lambda row: row.integrated_rotation_ratio, reverse=True)
    # Names that stand upright, a second sentence and more rows leave less room below them.
    low = bool(len(judged) > MOST_WITH_ALL or other_conclusions or len(words_of_all) > MOST_HIGH)
    return SummaryPage(
        title="Summary over the records",
        about=settings.about,
        footer=printing.footer_of(settings),
        strips_title="The variants: verdict and share under the worst record of each" if strips else "",
        strips=tuple(strips),
        subtitle=f"{counted(len(judged), 'record')}, "
        f"{counted(len(rows_of(StructureRow, rows)), 'structure')}",
        conclusion=conclusion_in_words(
            words_of_all, len(judged), fallen_in_one_run(worst_of_each(concluded))
        ),
        falls=falls_in_words(rows_of(ExpectedFallsRow, rows)),
        conclusions=tuple(other_conclusions),
        matrix=matrix(concluded, records, pulses),
        notices=(
            *_notices(records, comparison, len(failures)),
            *map(Notice, to_check(rows_of(WarningRow, rows))),
        ),
        outcomes=Section(
            pictures=pictures(
                outcomes_figure,
                shown if many else (),
                "Number of records under which each structure has each verdict.",
            ),
            caption="Under how many records each structure has each verdict, the worst structures first.",
        ),
        map=severity_map(shown if many else (), records, MOST_ON_PAGE_ONE),
        whole_map=severity_map(
            shown if len(judged) > MOST_ON_PAGE_ONE else (), records, MOST_MAPPED, caption=_WHOLE_MAP
        ),
        supports=Section(
            pictures=pictures(
                shares_by_period_figure,
                rows_of(SupportRow, rows),
                "Mean share of members that overturn against the period of the support, by structure.",
            ),
            caption=_OF_SUPPORTS,
        ),
        structures=Section(table=structure_table(shown, structures), caption=_STRUCTURE_TABLE, size=_LETTERS),
        scatter=_scatter(recorded, pulses, agreed, _LOW if low else _HIGH),
        panels=tuple(panels),
        failures=Section(
            heading="Failures" if failures else "",
            table=table_of(failures[:MOST_LISTED], *FAILURE_COLUMNS),
            caption="What gave no result, and why."
            + remainder(len(failures) - MOST_LISTED, "failure", "failures.csv"),
            size=_LETTERS,
        ),
        agreement=Section(
            heading="How the closed form compares",
            table=table_of(agreed, *AGREEMENT_COLUMNS),
            caption=_AGREEMENT_TABLE,
            size=_LETTERS,
        ),
        lists=Section(heading="Appendix: the lists"),
        methods=Section(
            heading="What each method is worth",
            level=2,
            table=method_table(recorded),
            caption=_METHOD_TABLE,
            size=_LETTERS,
        ),
        unsafe=Section(
            heading="Cases in which the closed form is on the unsafe side",
            level=2,
            text="" if unsafe else "None.",
            table=table_of(unsafe[:MOST_LISTED], *UNSAFE_COLUMNS),
            caption="Cases in which more happens than the closed form says: overturning or rocking missed, the worst "
            f"first.{remainder(len(unsafe) - MOST_LISTED, 'case', 'comparison.csv')}",
            size=_LETTERS,
        ),
        records=Section(
            heading="The records and how the numbers were made",
            level=2,
            text=_how_made(settings, bool(records)),
            table=record_table(records[:MOST_RECORDS], pulses),
            caption="The records, one row per component. A declared factor other than 1 means that the accelerations "
            f"are not those recorded.{remainder(len(records) - MOST_RECORDS, 'component', 'record.csv')}",
            size=_LETTERS,
            last=_TOGETHER,
        ),
        design=_design(design),
    )


def _how_made(settings: PageSettings, any_record: bool) -> str:
    """How the numbers of the summary were made."""
    made = (
        "The closed form is the exact largest rotation of the equivalent block (acceleration scale "
        f"“{settings.acceleration_scale}”) under the dominant sine pulse of the record. The full integration follows "
        "the nonlinear mechanism under the whole record with a relative tolerance of "
        f"{plain(settings.tolerance)}. All numbers are in the tables of the summary folder."
    )
    return made if any_record else f"{made} No record could be read."


_WHOLE_MAP = "The verdict on each structure under each record, both the worst first: "
_STRUCTURE_TABLE = (
    "The structures: under how many records each has each verdict; the record that is worst for it, the share that "
    "overturns there, and the largest rotation over the critical rotation, as given and of 5 to 95 % of the members "
    "(up to “overturns”: more than 5 % of them do; “rests”: at most a thousandth)."
)
_OF_SUPPORTS = (
    "Mean over the records of the share of members that overturn, for each structure on a support against the period "
    "of that support. The periods are not random: results of different periods are never averaged. In the tables "
    "above, such a structure is listed once for each record, with its worst period; verdicts.csv holds all periods."
)
_AGREEMENT_TABLE = (
    "How often the closed form was right, by structure; the first row is all of them. A structure on a support counts "
    "once under each component, at the period of its verdict, here as in the tables of methods and of what the closed "
    "form misses. The ratio is that of predicted over integrated rotation where both rock. Overturning: cases that "
    "overturn in the integration, those of them in which the closed form overturns too (hits) and in which it does not "
    "(misses, the dangerous ones), and cases in which it alone overturns (false alarms)."
)
_METHOD_TABLE = (
    "What each method is worth here, against the integration of the mechanism under the whole record. Less than "
    "happens: it predicts rest or rocking where more happens, which is unsafe. Within a factor 2: of the cases that "
    "rock in both."
)

_COUNTED = (
    "A structure on a support counts once, at the period of its verdict and with the closed form there."
)


def _scatter(
    comparison: Sequence[ComparisonRow],
    pulses: Sequence[PulseRow],
    agreed: Sequence[AgreementRow],
    height: float,
) -> tuple[Scatter, ...]:
    """The scatter of all cases, so many mm high, with what the closed form saw of the falls as its heading."""
    if sum(map(lifts, comparison)) < FEWEST_POINTS:
        return ()
    heading = f"The closed form {falls_seen_in_words(agreed)}"
    alt = "Scatter of the rotation ratio by closed form against that by integration, in four quadrants."
    figure = prediction_scatter(comparison, pulses, height)
    carried = any(row.support_period_s is not None for row in comparison)
    return (Scatter(heading, picture(figure, alt), _COUNTED if carried else ""),)


def _design(design: Design | None) -> Section:
    """The figure of the spectra with the design level, and what that is."""
    if design is None:
        return Section()
    level, spectra = design
    alt = "Spectra of all components and their mean with the design spectrum."
    caption = (
        "The spectra of the records as they acted, for the damping of the design level, each component on its own, and "
        f"their mean with that of the design level: {level.words}."
    )
    return Section(pictures=(picture(design_summary_figure(spectra, level), alt),), caption=caption)


def _notices(
    records: Sequence[RecordRow], comparison: Sequence[ComparisonRow], failures: int
) -> list[Notice]:
    """Return the warnings that stand above everything."""
    notices: list[Notice] = []
    if not records:
        text = "No record could be read, so there is no result; the failures below say why."
        notices.append(Notice(text))
    elif not comparison:
        text = "No structure could be assessed under any record; the failures below say why."
        notices.append(Notice(text))
    elif all(row.integrated_rotation_ratio == 0 for row in comparison):
        notices.append(Notice("No structure uplifts under any record."))
    if failures:
        notices.append(Notice(f"{counted(failures, 'failure')}, listed below."))
    scaled = sorted({row.record for row in records if row.scale_factor != 1})
    if scaled:
        names = listed(scaled, most=6)
        text = f"By a declared factor, not as recorded: {names}."
        notices.append(Notice(text))
    return notices


# What becomes of what --------------------------------------------------------------------------------------


def outcome_counts(verdicts: Sequence[VerdictRow]) -> dict[str, Counter[Verdict]]:
    """Return of each structure under how many records it has each verdict; the structures the worst first."""
    counts: dict[str, Counter[Verdict]] = {
        name: Counter() for name in worst_first((row.structure, row.severity) for row in verdicts)
    }
    for row in verdicts:
        counts[row.structure][row.verdict] += 1
    return counts


@styled
def outcomes_figure(verdicts: Sequence[VerdictRow]) -> Figure:
    """Draw of each structure, the worst first, under how many records it has each verdict."""
    counts = outcome_counts(verdicts)
    names = list(counts)[:MOST_STRUCTURES]
    labels = [wrapped(name, _BESIDE, 2) for name in names]
    kinds = [kind for kind in ORDER if any(counts[name][kind] for name in names)]
    row = 6.2 if any("\n" in name for name in labels) else 5.0
    head = 7.0
    foot = 10.0
    figure = new_figure(row * len(names) + head + foot, margins=(46, 4, foot, head))
    axes = figure.subplots()
    places = list(range(len(names)))
    start = np.zeros(len(names))
    for kind in kinds:
        sign, fill, ink, pattern = printing.LOOKS[kind]
        width = np.array([counts[name][kind] for name in names], dtype=float)
        # The hatch has the colour of the edge, so the frame is drawn a second time.
        axes.barh(places, width, 0.72, start, color=fill, edgecolor="white", linewidth=0, hatch=pattern)
        axes.barh(places, width, 0.72, start, fill=False, edgecolor="0.3", linewidth=0.4)
        axes.bar(0, 0, color=fill, edgecolor="0.3", linewidth=0.4, label=f"{sign} {kind}")
        box = {"facecolor": fill, "edgecolor": "none", "pad": 0.8}
        for place, begin, size in zip(places, start, width, strict=True):
            if size:
                text = f"{size:.0f}"
                axes.text(begin + size / 2, place, text, ha="center", va="center", color=ink, bbox=box)
        start += width
    axes.set_yticks(places, labels, linespacing=1.1)
    axes.tick_params(axis="y", length=0)
    axes.set(xlim=(0, float(start.max())), ylim=(len(names) - 0.4, -0.6), xlabel="number of records [-]")
    axes.xaxis.set_major_locator(MaxNLocator(8, integer=True))
    axes.legend(loc="lower left", bbox_to_anchor=(0, 1), ncols=len(kinds), borderaxespad=0.2, frameon=False)
    return figure


def severity_map(
    verdicts: Sequence[VerdictRow],
    records: Sequence[RecordRow],
    most: int = MOST_MAPPED,
    caption: str = "",
) -> SeverityMap:
    """Return verdict and share by record and structure, both the worst first.

    verdicts: the worst first. most: records. caption: what stands before the meaning of the cells.
    """
    names = [
        worst_first((getattr(row, which), row.severity) for row in verdicts)
        for which in ("record", "structure")
    ]
    rows = names[0][:most]
    columns = names[1][:MOST_STRUCTURES]
    others = [(len(names[0]) - len(rows), "record"), (len(names[1]) - len(columns), "structure")]
    rest = " and ".join(counted(count, noun) for count, noun in others if count)
    by_pair = {(row.record, row.structure): row for row in verdicts}
    velocity = unit_of("m/s")
    peaks: dict[str, list[tuple[float, float]]] = {name: [] for name in rows}
    for row in records:
        if row.record in peaks:
            accelerations = row.peak_acceleration_m_s2 / GRAVITY
            peaks[row.record].append((accelerations, row.peak_velocity_m_s / velocity.size))
    return SeverityMap(
        record_heads=("Record, the worst first", "PGA [g]", f"PGV [{velocity.name}]"),
        heads=tuple(elided(name, _HEAD) for name in columns),
        rows=tuple(
            MapRow(
                name,
                tuple(
                    number(max(of_components), 2)
                    for of_components in zip(*(peaks[name] or _UNKNOWN), strict=True)
                ),
                tuple(_cell(by_pair.get((name, column))) for column in columns),
            )
            for name in rows
        ),
        words=f"{caption}{printing.LEGEND}. {printing.SHARES} A single run has none; at … s: the worst period of a "
        f"support.{f' Not shown, but in verdicts.csv: {rest}.' if rest else ''}",
    )


def _cell(verdict_row: VerdictRow | None) -> MapCell:
    decision = verdict_row.decision if verdict_row else None
    _, fill, ink, _ = printing.LOOKS[decision.verdict if decision else Verdict.CANNOT_BE_TOLD]
    text = printing.cell_text(decision)
    if verdict_row and verdict_row.support_period_s:  # of a support the period that is worst
        text += f" at\u00a0{verdict_row.support_period_s:.2g}\u00a0s"
    return MapCell(text=text, fill=fill, ink=ink)


def structure_table(
    verdicts: Sequence[VerdictRow], structures: Mapping[str, Structure] = MappingProxyType({})
) -> PageTable:
    """Return one row per structure: under how many records it overturns, and the record that is worst for it.

    Below the name of one whose crack is known this is said.
    """
    by_severity = sorted(verdicts, key=lambda row: row.severity, reverse=True)
    worst = {row.structure: row for row in reversed(by_severity)}
    counts = outcome_counts(verdicts)
    present = {row.verdict for row in verdicts}
    kinds = [verdict for verdict in ORDER if verdict in present]
    heads = [printing.sentence(verdict) for verdict in kinds]
    # A name that one line holds keeps to it; a longer one would take the room of the numbers.
    width = "auto" if max((len(row.record) for row in verdicts), default=0) <= _BESIDE else "1.6"
    return table_of(
        [(name, *[counts[name][verdict] for verdict in kinds], worst[name]) for name in counts],
        ("Structure", "1.6", "l", lambda row: TableCell(row[0], True, known_crack(structures.get(row[0])))),
        *((head, "0.9", "r", lambda row, at=at: str(row[at])) for at, head in enumerate(heads, start=1)),
        ("Worst record", width, "l", lambda row: _record(row[-1])),
        ("Overturns there in", "0.8", "l", lambda row: words(row[-1].decision.share_in_words)),
        ("As given", "0.7", "r", lambda row: ratio(row[-1].rotation_ratio, 2)),
        ("5–95 % of the members", "1.3", "r", lambda row: printing.band_text(row[-1], " – ")),
    )


def _record(row: VerdictRow) -> Cell:
    """The record of a verdict, with the period of the support below it."""
    period = placed("", row.support_period_s).removeprefix(", ")
    return TableCell(row.record, below=period) if period else row.record


# What the methods are worth --------------------------------------------------------------------------------


def method_table(comparison: Sequence[ComparisonRow]) -> PageTable:
    """Return how each method stands to the integration of the mechanism under the record; times stand in a table."""
    every = [_worth(method, comparison) for method in printing.METHODS]
    return table_of(
        [worth for worth in every if worth.cases],
        ("Method", "1.6", "l", lambda worth: printing.METHODS[worth.method]),
        ("Cases", "0.6", "r", lambda worth: plain(worth.cases)),
        ("Same outcome", "0.8", "r", lambda worth: printing.of(worth.same, worth.cases)),
        ("Less than happens", "0.8", "r", lambda worth: strong(plain(worth.too_low), worth.too_low > 0)),
        ("More than happens", "0.8", "r", lambda worth: plain(worth.too_high)),
        ("Within a factor\u00a02", "0.8", "r", lambda worth: printing.of(worth.near, worth.both_rock)),
    )


class _Worth(NamedTuple):
    """Counts of the cases of a method against the integration.

    same, too_low, too_high: by outcome. both_rock: those that rock by both; near: of these within a factor two.
    """

    method: Method
    cases: int
    same: int
    too_low: int
    too_high: int
    both_rock: int
    near: int


def _worth(method: Method, comparison: Sequence[ComparisonRow]) -> _Worth:
    """Count the cases that have both rotation ratios."""
    of_all = [(getattr(row, RATIO_COLUMNS[method]), row.integrated_rotation_ratio) for row in comparison]
    pairs = [pair for pair in of_all if not any(map(math.isnan, pair))]
    outcomes = Counter(
        agreement(predicted=predicted, integrated=integrated) for predicted, integrated in pairs
    )
    closeness = [
        within_factor_two(predicted=predicted, integrated=integrated) for predicted, integrated in pairs
    ]
    return _Worth(
        method=method,
        cases=len(pairs),
        same=outcomes[Agreement.SAME],
        too_low=outcomes[Agreement.TOO_LOW],
        too_high=outcomes[Agreement.TOO_HIGH],
        both_rock=sum(is_near is not None for is_near in closeness),
        near=sum(bool(is_near) for is_near in closeness),
    )


AGREEMENT_COLUMNS: list[Column] = [
    ("Structure", "1.4", "l", lambda row: row.structure or ("all, made records" if row.made else "all")),
    *columns_of(
        AgreementRow,
        "stations=0.7 earthquakes=1 cases=0.5 both_rock=0.7 within_factor_two=0.8 median_ratio=0.7 overturning=1 "
        "overturning_hits=1 overturning_misses=1 overturning_false_alarms=1",
    ),
]
UNSAFE_COLUMNS: list[Column] = [
    *columns_of(ComparisonRow, "record=1.4 component=auto"),
    ("Structure", "1.4", "l", lambda row: placed(row.structure, row.support_period_s)),
    *columns_of(ComparisonRow, "predicted_rotation_ratio integrated_rotation_ratio regime"),
    (
        "Closed form and integration",
        "1.6",
        "l",
        lambda row: ratio_in_words(
            predicted=row.predicted_rotation_ratio, integrated=row.integrated_rotation_ratio
        ),
    ),
]
FAILURE_COLUMNS = columns_of(FailureRow, "record component=auto structure stage=0.6 message=3")


def record_table(records: Sequence[RecordRow], pulses: Sequence[PulseRow]) -> PageTable:
    """Return the records with their dominant pulses."""
    pulse_of = {(row.record, row.component): row for row in pulses if row.is_dominant}
    of_record = columns_of(
        RecordRow, "record=1.6 component=auto scale_factor peak_acceleration_m_s2=0.95 peak_velocity_m_s"
    )
    of_pulse = columns_of(PulseRow, "amplitude_m_s2 period_s explained_energy flags=1.2")
    heads = [column[:3] for column in of_record]
    heads += [(f"Pulse {head.lower()}", width, side) for head, width, side, _ in of_pulse]
    cells = []
    for row in records:
        pulse = pulse_of.get((row.record, row.component))
        cells.append([show(row) for *_, show in of_record] + [show(pulse) for *_, show in of_pulse])
    return printing.table(heads, cells)
