"""The report over all records: the map of what becomes of what, what each method costs, and where it fails."""

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.figure import Figure

from rocking.assessment.fate import ORDER, Fate
from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_record import FailureRow, PulseRow, RecordRow
from rocking.assessment.rows.of_study import AgreementRow
from rocking.assessment.verdict import Agreement, Verdict, agreement, within_factor_two
from rocking.quantities import GRAVITY
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.fragility import fragility_table
from rocking.reports.panels import draw_agreement
from rocking.reports.printing import NOTHING, Cell, number, ratio, strong, table_of, whole, words
from rocking.reports.record import METHODS
from rocking.reports.record_figures import LOOKS
from rocking.reports.style import new_figure, picture, styled
from rocking.tables import rows_of

if TYPE_CHECKING:
    from pandas import DataFrame

FEWEST_POINTS = 3
"""Cases from which on the closed form is drawn against the integration; fewer are read from the tables."""
MOST_MAPPED, MOST_STRUCTURES = 30, 20
"""Records and structures of the map, the worst first; verdicts.csv holds all."""
MOST_LISTED = 20
"""Rows of the list of unsafe cases and of that of failures; the CSV tables hold all."""
MOST_RECORDS = 200
_HEAD = 20
"""Letters of a name above a column of the map; the table of the structures holds it whole."""
ABOUT = ("study", "client", "author", "date")


def summary_report(
    tables: Mapping[str, "DataFrame"], settings: Mapping[str, Any], trade: Sequence[Mapping[str, str]] = ()
) -> bytes:
    """Return the PDF over all records. The arguments are those of `summary_data`."""
    return compile_document("summary.typ", summary_data(tables, settings, trade))


def summary_data(
    tables: Mapping[str, "DataFrame"], settings: Mapping[str, Any], trade: Sequence[Mapping[str, str]] = ()
) -> dict[str, object]:
    """Return what the template of the summary is given: texts, tables and figures.

    tables: the summary tables "record", "pulses", "comparison", "verdicts", "structures", "agreement" and "failures",
    and where they exist "maxima" and "timings" (what each method is worth and takes), "fragility_summary" and "ida".
    settings: at least tolerance and acceleration_scale; study, client, author and date where they are given.
    trade: figure and conclusion, where it was measured.
    """
    fates = sorted(rows_of(Fate, tables["verdicts"]), key=lambda fate: fate.severity, reverse=True)
    comparison, failures = tables["comparison"], tables["failures"]
    unsafe = comparison[comparison["agreement"] == Agreement.TOO_LOW]
    unsafe = unsafe.sort_values("integrated_rotation_ratio", ascending=False, kind="stable")
    records = tables["record"]
    return {
        "title": "Rocking assessment: summary",
        "about": {name: str(settings.get(name) or "") for name in ABOUT},
        "subtitle": _subtitle(tables),
        "notices": _notices(records, comparison, len(failures)),
        "headlines": headlines(fates),
        "map": severity_map(fates, records),
        "methods": method_table(tables),
        "structures": structure_table(fates),
        "sentences": expert_sentences(list(rows_of(AgreementRow, tables["agreement"]))),
        "scatter": _scatter(comparison),
        "agreement": agreement_table(list(rows_of(AgreementRow, tables["agreement"]))),
        "unsafe": case_table(rows_of(ComparisonRow, unsafe.head(MOST_LISTED))),
        "unsafe-note": _rest(len(unsafe) - MOST_LISTED, "case", "comparison.csv"),
        "fragility": _fragility(tables),
        "failures": failure_table(rows_of(FailureRow, failures.head(MOST_LISTED))),
        "failures-note": _rest(len(failures) - MOST_LISTED, "failure", "failures.csv"),
        "records": record_table(list(rows_of(RecordRow, records.head(MOST_RECORDS))), tables["pulses"]),
        "records-note": _rest(len(records) - MOST_RECORDS, "component", "record.csv"),
        "trade": list(trade),
        "tolerance": printing.given(float(settings["tolerance"])),
        "acceleration-scale": str(settings["acceleration_scale"]),
    }


def _subtitle(tables: Mapping[str, "DataFrame"]) -> str:
    records = tables["record"]["record"].nunique()
    parts = [
        (records, "record"),
        (len(tables["structures"]), "structure"),
        (len(tables["comparison"]), "case"),
    ]
    return printing.sentence(", ".join(printing.counted(many, noun) for many, noun in parts)) + "."


def _rest(more: int, noun: str, file: str) -> str:
    """Say what is left out, as a sentence or nothing."""
    return f" Another {printing.counted(more, noun)} in {file}." if more > 0 else ""


def _notices(records: "DataFrame", comparison: "DataFrame", failures: int) -> list[dict[str, object]]:
    """Return the warnings that stand above everything."""
    integrated = comparison["integrated_rotation_ratio"]
    said = []
    if records.empty:
        said.append("No record could be read, so there is no result; the failures below say why.")
    elif comparison.empty:
        said.append("No structure could be assessed under any record; the failures below say why.")
    elif (integrated == 0).all():
        said.append("No structure uplifts under any record.")
    spared = int((integrated.isna() & (comparison["answer_outcome"] != "failed")).sum())
    if spared:
        said.append(
            f"{printing.sentence(printing.counted(spared, 'case'))} answered by a cheaper method than the full "
            "integration and left out of what compares the two; see answer_method in comparison.csv."
        )
    if failures:
        said.append(f"{printing.sentence(printing.counted(failures, 'failure'))}, listed below.")
    scaled = sorted(records.loc[records["scale_factor"] != 1, "record"].unique())
    if scaled:
        named = printing.listed(scaled, most=20)
        said.append(f"Accelerations multiplied by a declared factor, not as recorded: {named}.")
    return [{"strong": True, "text": text} for text in said]


# What becomes of what --------------------------------------------------------------------------------------


def headlines(fates: Sequence[Fate]) -> list[dict[str, str]]:
    """Return the first lines: what overturns under some record, what is undecided at worst, what always stands.

    fates: the worst first.
    """
    heads = {
        Verdict.OVERTURNS: "Overturns",
        Verdict.UNDECIDED: "Undecided at worst",
        Verdict.UNKNOWN: "Unknown under some record, standing under the others",
        Verdict.STANDS: "Stands under every record that could be assessed",
    }
    groups: dict[str, list[str]] = {head: [] for head in heads.values()}
    for name, counts in _counts(fates).items():
        worst = next(verdict for verdict in ORDER if counts[verdict])
        many = counts[worst]
        told = (
            "" if worst is Verdict.STANDS or counts.total() == 1 else f" ({many} of {counts.total()} records)"
        )
        groups[heads[worst]].append(name + told)
    return printing.headlines(groups)


def _counts(fates: Sequence[Fate]) -> dict[str, Counter[Verdict]]:
    """Under how many records each structure has each verdict, the structure with the worst case first."""
    counts: dict[str, Counter[Verdict]] = {}
    for fate in fates:
        counts.setdefault(fate.structure, Counter())[fate.verdict] += 1
    return counts


def severity_map(fates: Sequence[Fate], records: "DataFrame") -> dict[str, object]:
    """Return verdict and share by record and structure, both the worst first. fates: the worst first."""
    weight: Counter[str] = Counter()
    columns: Counter[str] = Counter()
    for fate in fates:
        share = 0.0 if math.isnan(fate.overturning_share) else fate.overturning_share
        weight[fate.record] += share  # type: ignore[assignment]
        columns[fate.structure] += share  # type: ignore[assignment]
    shown = [name for name, _ in columns.most_common(MOST_STRUCTURES)]
    rows = [name for name, _ in weight.most_common(MOST_MAPPED)]
    by_pair = {(fate.record, fate.structure): fate for fate in fates}
    peaks = records.groupby("record", observed=True)[["peak_acceleration_m_s2", "peak_velocity_m_s"]].max()
    left = [(len(weight) - len(rows), "record"), (len(columns) - len(shown), "structure")]
    rest = " and ".join(printing.counted(many, noun) for many, noun in left if many)
    return {
        "heads": [printing.short(name, _HEAD) for name in shown],
        "rows": [
            {
                "record": name,
                "peaks": [number(peaks.loc[name].iloc[0] / GRAVITY, 2), number(peaks.loc[name].iloc[1], 2)]
                if name in peaks.index
                else [NOTHING, NOTHING],
                "cells": [_cell(by_pair.get((name, each))) for each in shown],
            }
            for name in rows
        ],
        "note": f" Not shown, but in verdicts.csv: {rest}." if rest else "",
    }


def _cell(fate: Fate | None) -> dict[str, str]:
    """Sign and share of a cell in the look of its verdict: in %, or with a single run its rotation ratio."""
    sign, colour, ink, _ = LOOKS[fate.verdict if fate else Verdict.UNKNOWN]
    text = ""
    if fate is not None and fate.members:
        text = printing.percent(fate.overturning_share)
    elif fate is not None and fate.rotation_ratio < math.inf:
        text = number(fate.rotation_ratio, 2)
    return {"text": f"{sign} {text}".strip(), "fill": colour, "ink": ink}


def structure_table(fates: Sequence[Fate]) -> dict[str, object]:
    """Return one row per structure: under how many records it overturns, and the record that is worst for it."""
    worst = {fate.structure: fate for fate in reversed(fates)}
    counts = _counts(fates)
    some = Counter(fate.verdict for fate in fates)
    verdicts = [verdict for verdict in ORDER if some[verdict] or verdict is not Verdict.UNKNOWN]
    return table_of(
        counts,
        ("Structure", "1.6", "l", strong),
        *(
            (
                printing.sentence(verdict),
                "auto",
                "r",
                lambda name, verdict=verdict: str(counts[name][verdict]),
            )
            for verdict in verdicts
        ),
        ("Worst record", "1.6", "l", lambda name: worst[name].record),
        ("Overturns there in", "0.8", "l", lambda name: worst[name].count or NOTHING),
        ("As given", "0.7", "r", lambda name: ratio(worst[name].rotation_ratio, 2)),
        ("5–95 % of the members", "1.1", "r", lambda name: _band(worst[name])),
    )


def _band(fate: Fate) -> str:
    if not fate.members:
        return NOTHING
    return f"{ratio(fate.rotation_ratio_low, 2)} – {ratio(fate.rotation_ratio_high, 2)}"


# What the methods are worth --------------------------------------------------------------------------------


def method_table(tables: Mapping[str, "DataFrame"]) -> dict[str, object]:
    """Return how each method stands to the integration of the mechanism under the record, and what a case took it.

    Without rows where the table "maxima" is not given.
    """
    rows = []
    if "maxima" in tables and len(tables["maxima"]):
        maxima = tables["maxima"]
        key = ["record", "component", "structure"]
        of = {
            Method(str(name)): part.set_index(key)["rotation_ratio"]
            for name, part in maxima[maxima["processing"].fillna("") == ""].groupby("method", observed=True)
        }
        whole_record = of.get(Method.MECHANISM_ON_RECORD)
        if whole_record is not None:
            rows = [(method, *_worth(of[method], whole_record)) for method in METHODS if method in of]
    spent = _spent(tables.get("timings"))
    return table_of(
        rows,
        ("Method", "1.6", "l", lambda row: METHODS[row[0]]),
        ("Cases", "0.6", "r", lambda row: whole(row[1])),
        ("Same outcome", "0.8", "r", lambda row: printing.of(row[2], row[1])),
        ("Less than happens", "0.8", "r", lambda row: strong(whole(row[3]), row[3] > 0)),
        ("More than happens", "0.8", "r", lambda row: whole(row[4])),
        ("Within a factor 2", "0.8", "r", lambda row: printing.of(row[5], row[6])),
        ("CPU of a case", "0.8", "r", lambda row: _time(spent.get(row[0], math.nan) / max(row[1], 1))),
    )


def _worth(ratios: "DataFrame", integrated: "DataFrame") -> tuple[int, int, int, int, int, int]:
    """Cases; those with the same, a too low and a too high outcome; within a factor two, of those that both rock."""
    pairs = [
        (float(one), float(other))
        for one, other in zip(ratios, integrated.reindex(ratios.index), strict=True)
        if not (math.isnan(one) or math.isnan(other))
    ]
    outcomes = Counter(agreement(*pair) for pair in pairs)
    near = [close for pair in pairs if (close := within_factor_two(*pair)) is not None]
    kinds = (outcomes[kind] for kind in (Agreement.SAME, Agreement.TOO_LOW, Agreement.TOO_HIGH))
    same, low, high = kinds
    return len(pairs), same, low, high, sum(near), len(near)


def _spent(timings: "DataFrame | None") -> dict[str, float]:
    """CPU time by stage, s: where a stage is a method, what that took in all cases."""
    if timings is None or timings.empty:
        return {}
    return {str(stage): float(spent) for stage, spent in timings.groupby("stage")["duration_s"].sum().items()}


def _time(seconds: float) -> str:
    """A time to one digit: it differs from run to run."""
    if math.isnan(seconds) or seconds <= 0:
        return NOTHING
    factor, unit = (1.0, "s") if seconds >= 1 else (1e3, "ms") if seconds >= 1e-3 else (1e6, "µs")
    return f"{float(f'{seconds * factor:.1g}'):g} {unit}"


def expert_sentences(rows: Sequence[AgreementRow]) -> list[str]:
    """Return what the comparison of closed form and integration amounts to, in sentences."""
    every = rows[0]
    if every.cases == 0:
        return [
            "There is no case with both a prediction and an integration, so nothing can be said of the closed form."
        ]
    false = printing.counted(every.overturning_false, "case")
    both = (
        f"In none of {every.cases} cases do both the closed form and the integration rock."
        if not every.both_rock
        else "Where both rock, the closed form is within a factor of two of the integration in "
        f"{every.within_factor_two} of {every.both_rock} cases, with a median ratio of {number(every.median_ratio)}."
    )
    if every.overturning == 0:
        return [both, f"Nothing overturns in the full integration; the closed form overturns {false}."]
    return [
        both,
        f"Of {every.overturning} overturnings in the full integration the closed form has "
        f"{every.overturning_found} and misses {every.overturning_missed}; it overturns {false} "
        f"that {'stays' if every.overturning_false == 1 else 'stay'} up.",
    ]


def _scatter(comparison: "DataFrame") -> list[dict[str, str]]:
    both = comparison[["predicted_rotation_ratio", "integrated_rotation_ratio"]]
    if (both.max(axis="columns", skipna=False) > 0).sum() < FEWEST_POINTS:
        return []
    alt = "Scatter of predicted against integrated rotation ratio, with factor-two lines."
    return [picture(prediction_scatter(comparison), alt)]


@styled
def prediction_scatter(comparison: "DataFrame") -> Figure:
    """Draw predicted against integrated rotation ratio, from the comparison table."""
    figure = new_figure(90, 115, margins=(20, 3, 13, 3))
    columns = comparison[["integrated_rotation_ratio", "predicted_rotation_ratio"]]
    draw_agreement(figure.subplots(), *columns.to_numpy(dtype=float).T)
    return figure


def agreement_table(rows: Sequence[AgreementRow]) -> dict[str, object]:
    """Return how often the closed form was right, by structure."""
    return table_of(
        rows,
        ("Structure", "1.6", "l", lambda row: row.structure or "all"),
        ("Records", "0.8", "r", lambda row: whole(row.records)),
        ("Cases", "0.8", "r", lambda row: whole(row.cases)),
        ("Both rock", "0.8", "r", lambda row: whole(row.both_rock)),
        ("within factor 2", "0.8", "r", lambda row: whole(row.within_factor_two)),
        ("Median ratio [-]", "0.8", "r", lambda row: number(row.median_ratio)),
        ("Overturn", "0.9", "r", lambda row: whole(row.overturning)),
        ("predicted", "0.8", "r", lambda row: whole(row.overturning_found)),
        ("missed", "0.7", "r", lambda row: strong(whole(row.overturning_missed), row.overturning_missed > 0)),
        ("only predicted", "0.9", "r", lambda row: whole(row.overturning_false)),
    )


def case_table(cases: Iterable[ComparisonRow]) -> dict[str, object]:
    """Return single cases of the comparison table."""
    return table_of(
        cases,
        ("Record", "1.4", "l", lambda row: row.record),
        ("Comp.", "0.7", "l", lambda row: words(row.component)),
        ("Structure", "1.4", "l", lambda row: row.structure),
        ("Closed form", "auto", "r", lambda row: ratio(row.predicted_rotation_ratio)),
        ("Full integration", "auto", "r", lambda row: strong(ratio(row.integrated_rotation_ratio))),
        ("Regime of the closed form", "1.4", "l", lambda row: words(row.regime)),
        ("The closed form is", "1.2", "l", lambda row: words(row.prediction_in_words)),
    )


# Fragility, failures and records ---------------------------------------------------------------------------


def _fragility(tables: Mapping[str, "DataFrame"]) -> list[dict[str, object]]:
    """The table of the fragility in a list, which is empty where it was not measured."""
    if "fragility_summary" not in tables:
        return []
    summary = tables["fragility_summary"]
    return [fragility_table(summary[np.isinf(summary["rotation_ratio"])], tables["ida"])]


def failure_table(failures: Iterable[FailureRow]) -> dict[str, object]:
    """Return what gave no result, and why."""
    return table_of(
        failures,
        ("Record", "1", "l", lambda row: words(row.record)),
        ("Comp.", "0.5", "l", lambda row: words(row.component)),
        ("Structure", "0.8", "l", lambda row: words(row.structure)),
        ("Stage", "0.6", "l", lambda row: words(row.stage)),
        ("Why", "3", "l", lambda row: words(row.message)),
    )


def record_table(records: Sequence[RecordRow], pulses: "DataFrame") -> dict[str, object]:
    """Return the records with their dominant pulses."""
    dominant = pulses[(pulses["kind"] == "alternative") & (pulses["rank"] == 1)]
    known = dominant[dominant["record"].isin([row.record for row in records])]
    by_component = {(row.record, row.component): row for row in rows_of(PulseRow, known)}

    def pulse(show: Callable[[PulseRow], str]) -> Callable[[RecordRow], str]:
        return lambda row: (
            show(by_component[key]) if (key := (row.record, row.component)) in by_component else NOTHING
        )

    return table_of(
        records,
        ("Record", "1.6", "l", lambda row: row.record),
        ("Comp.", "0.8", "l", lambda row: words(row.component)),
        ("Declared factor", "0.7", "r", lambda row: _factor(row.scale_factor)),
        ("PGA [m/s²]", "0.8", "r", lambda row: number(row.peak_acceleration_m_s2)),
        ("PGV [m/s]", "0.8", "r", lambda row: number(row.peak_velocity_m_s)),
        ("Pulse amplitude [m/s²]", "0.9", "r", pulse(lambda row: number(row.amplitude_m_s2))),
        ("Pulse period [s]", "0.8", "r", pulse(lambda row: number(row.period_s))),
        ("Explained energy [-]", "0.9", "r", pulse(lambda row: number(row.explained_energy, 2))),
        ("Flags", "1.2", "l", pulse(lambda row: words(row.flags))),
    )


def _factor(scale_factor: float) -> Cell:
    scaled = scale_factor != 1
    return strong(("×\u00a0" if scaled else "") + printing.given(scale_factor), scaled)
