"""The report over all records: what a decision is taken from."""

from collections.abc import Mapping, Sequence
from typing import Any

from rocking.reports import printing, summary_tables
from rocking.reports.document import compile_document
from rocking.reports.printing import Row
from rocking.reports.style import svg
from rocking.reports.summary_figures import prediction_scatter

Tables = Mapping[str, Sequence[Row]]


def summary_report(tables: Tables, settings: Mapping[str, Any]) -> bytes:
    """Return the PDF over all records.

    tables: rows of text as read from the CSV files "record", "pulses", "comparison", "maxima", "structures",
    "agreement", "failures" and, where it exists, "trade". settings: at least tolerance, acceleration_scale
    and fragility_change.
    """
    return compile_document("summary.typ", summary_data(tables, settings))


def summary_data(tables: Tables, settings: Mapping[str, Any]) -> dict[str, object]:
    """Return what the template of the summary is given: texts, tables and figures."""
    comparison = tables["comparison"]
    unsafe = sorted(
        (row for row in comparison if row["verdict"] == "unsafe"),
        key=lambda row: -float(row["integrated_rotation_ratio"]),
    )
    fragile = [row for row in comparison if row["fragile"] == "true"]
    trade = tables.get("trade", ())
    return {
        "title": "Rocking assessment: summary",
        "subtitle": _subtitle(tables),
        "notices": summary_tables.notices(tables),
        "sentences": summary_tables.expert_sentences(tables),
        "scatter": _scatter(comparison),
        "agreement": summary_tables.agreement_table(tables),
        "records": summary_tables.record_table(tables),
        "unsafe": summary_tables.case_table(unsafe),
        "unsafe-note": summary_tables.unlisted(unsafe),
        "fragile": summary_tables.case_table(fragile),
        "fragile-note": summary_tables.unlisted(fragile),
        "failures": summary_tables.failure_table(tables["failures"]),
        "trade": summary_tables.plain_table(trade) if trade else None,
        "tolerance": printing.given(str(settings["tolerance"])),
        "fragility-change": f"{printing.given(str(100 * float(settings['fragility_change'])))} %",
        "acceleration-scale": str(settings["acceleration_scale"]),
    }


def _subtitle(tables: Tables) -> str:
    records = len(printing.distinct(tables["record"], "record"))
    structures = len(tables["structures"])
    cases = len(tables["comparison"])
    parts = [(records, "record"), (structures, "structure"), (cases, "case")]
    return printing.sentence(", ".join(printing.counted(many, noun) for many, noun in parts)) + "."


def _scatter(rows: Sequence[Row]) -> list[dict[str, str]]:
    predicted, integrated = "predicted_rotation_ratio", "integrated_rotation_ratio"
    cases = [
        (float(row[predicted]), float(row[integrated]), row["light"])
        for row in rows
        if row[predicted] and row[integrated]
    ]
    if not any(before > 0 or after > 0 for before, after, _ in cases):
        return []
    alt = "Scatter of predicted against integrated rotation ratio, marked by light, with factor-two lines."
    return [{"svg": svg(prediction_scatter(cases)), "alt": alt}]
