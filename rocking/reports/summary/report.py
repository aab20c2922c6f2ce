"""The report over all records: what a decision is taken from."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_record import FailureRow, RecordRow
from rocking.assessment.rows.of_study import AgreementRow
from rocking.assessment.verdict import Agreement
from rocking.reports import printing
from rocking.reports.document import compile_document
from rocking.reports.style import svg
from rocking.reports.summary import fates as summary_fates
from rocking.reports.summary import tables as summary_tables
from rocking.reports.summary.figures import prediction_scatter
from rocking.reports.summary.fragility import fragility_data
from rocking.reports.summary.tables import MOST_RECORDS, Listing
from rocking.tables import rows_of

if TYPE_CHECKING:
    from pandas import DataFrame


FEWEST_POINTS = 3
"""Cases from which on the closed form is drawn against the integration; fewer are read from the tables."""


def summary_report(
    tables: Mapping[str, "DataFrame"], settings: Mapping[str, Any], trade: Sequence[Mapping[str, str]] = ()
) -> bytes:
    """Return the PDF over all records.

    tables: the summary tables "record", "pulses", "comparison", "verdicts", "structures", "agreement" and "failures",
    and where they exist "fragility", "fragility_summary" and "ida". settings: at least tolerance and
    acceleration_scale. trade: figure and conclusion, where it was measured.
    """
    return compile_document("summary/summary.typ", summary_data(tables, settings, trade))


def summary_data(
    tables: Mapping[str, "DataFrame"], settings: Mapping[str, Any], trade: Sequence[Mapping[str, str]] = ()
) -> dict[str, object]:
    """Return what the template of the summary is given: texts, tables and figures."""
    comparison = tables["comparison"]
    found = tables["verdicts"]
    worst = comparison[comparison["agreement"] == Agreement.TOO_LOW].sort_values(
        "integrated_rotation_ratio", ascending=False, kind="stable"
    )
    unsafe = Listing.of(ComparisonRow, worst)
    failures = Listing.of(FailureRow, tables["failures"])
    records = Listing.of(RecordRow, tables["record"], MOST_RECORDS)
    agreement = list(rows_of(AgreementRow, tables["agreement"]))
    return {
        "title": "Rocking assessment: summary",
        "subtitle": _subtitle(tables),
        "notices": summary_tables.notices(tables["record"], comparison, failures.total),
        "headlines": summary_fates.headlines(found),
        "structures": summary_fates.structure_table(found),
        "matrix": summary_fates.matrix(found),
        "fragility": fragility_data(tables),
        "sentences": summary_tables.expert_sentences(agreement),
        "scatter": _scatter(comparison),
        "agreement": summary_tables.agreement_table(agreement),
        "records": summary_tables.record_table(records, tables["pulses"]),
        "records-note": records.rest("component", "record.csv"),
        "unsafe": summary_tables.case_table(unsafe),
        "unsafe-note": unsafe.rest("case", "comparison.csv"),
        "failures": summary_tables.failure_table(failures),
        "failures-note": failures.rest("failure", "failures.csv"),
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


def _scatter(comparison: "DataFrame") -> list[dict[str, str]]:
    both = comparison[["predicted_rotation_ratio", "integrated_rotation_ratio"]]
    if (both.max(axis="columns", skipna=False) > 0).sum() < FEWEST_POINTS:
        return []
    alt = "Scatter of predicted against integrated rotation ratio, with factor-two lines."
    return [{"svg": svg(prediction_scatter(comparison)), "alt": alt}]
