"""The report over all records: what a decision is taken from."""

import heapq
from collections.abc import Mapping
from typing import Any

from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.style import svg
from rocking.reports.summary import tables as summary_tables
from rocking.reports.summary.figures import prediction_scatter
from rocking.reports.summary.tables import MOST_LISTED, Listing, Rows, Tables
from rocking.reports.summary.trade_figures import trade_figure


def summary_report(tables: Tables, settings: Mapping[str, Any]) -> bytes:
    """Return the PDF over all records.

    tables: rows of text as read from the CSV files "record", "pulses", "comparison", "structures", "agreement",
    "failures" and, where it exists, "trade". They are gone through several times, so that those of any number of
    records may be read from a file each time. settings: at least tolerance, acceleration_scale and fragility_change.
    """
    return compile_document("summary/summary.typ", summary_data(tables, settings))


def summary_data(tables: Tables, settings: Mapping[str, Any]) -> dict[str, object]:
    """Return what the template of the summary is given: texts, tables and figures."""
    comparison = tables["comparison"]
    unsafe = _worst(comparison)
    fragile = Listing.of(row for row in comparison if row["fragile"] == "true")
    failures = Listing.of(tables["failures"])
    records = summary_tables.record_listing(tables)
    return {
        "title": "Rocking assessment: summary",
        "subtitle": _subtitle(tables),
        "notices": summary_tables.notices(tables, failures.total),
        "sentences": summary_tables.expert_sentences(tables),
        "scatter": _scatter(comparison),
        "agreement": summary_tables.agreement_table(tables),
        "records": summary_tables.record_table(records, tables["pulses"]),
        "records-note": records.rest("component", "record.csv"),
        "unsafe": summary_tables.case_table(unsafe),
        "unsafe-note": unsafe.rest("case", "comparison.csv"),
        "fragile": summary_tables.case_table(fragile),
        "fragile-note": fragile.rest("case", "comparison.csv"),
        "failures": summary_tables.failure_table(failures),
        "failures-note": failures.rest("failure", "failures.csv"),
        "trade": _trade(tables.get("trade", ())),
        "tolerance": printing.given(str(settings["tolerance"])),
        "fragility-change": f"{printing.given(str(100 * float(settings['fragility_change'])))} %",
        "acceleration-scale": str(settings["acceleration_scale"]),
    }


def _worst(comparison: Rows) -> Listing:
    """The cases on the unsafe side, the largest integrated rotations first."""
    unsafe = (row for row in comparison if row["verdict"] == "unsafe")
    first = heapq.nlargest(MOST_LISTED, unsafe, key=lambda row: float(row["integrated_rotation_ratio"]))
    return Listing(first, sum(row["verdict"] == "unsafe" for row in comparison))


def _subtitle(tables: Tables) -> str:
    records = len(printing.distinct(tables["record"], "record"))
    structures = sum(1 for _ in tables["structures"])
    cases = sum(1 for _ in tables["comparison"])
    parts = [(records, "record"), (structures, "structure"), (cases, "case")]
    return printing.sentence(", ".join(printing.counted(many, noun) for many, noun in parts)) + "."


def _scatter(comparison: Rows) -> list[dict[str, str]]:
    both = ("predicted_rotation_ratio", "integrated_rotation_ratio")
    if not any(
        all(row[name] for name in both) and any(float(row[name]) > 0 for name in both) for row in comparison
    ):
        return []
    alt = "Scatter of predicted against integrated rotation ratio, marked by light, with factor-two lines."
    return [{"svg": svg(prediction_scatter(comparison)), "alt": alt}]


def _trade(rows: Rows) -> list[dict[str, str]]:
    measured = list(rows)
    alt = "Error of the largest rotation against the time of one response, for every method, with medians."
    return [{"svg": svg(trade_figure(measured)), "alt": alt}] if measured else []
