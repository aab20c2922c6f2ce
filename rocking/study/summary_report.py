"""The PDF and the figure of a whole study, beside its summary tables."""

from collections.abc import Mapping
from pathlib import Path

from rocking.assessment import columns
from rocking.reports.style import svg
from rocking.reports.summary.figures import prediction_scatter
from rocking.reports.summary.report import summary_report
from rocking.tables import StoredRows, write_whole


def report_summary(folder: Path, settings: Mapping[str, object], trade: Path | None = None) -> None:
    """Write summary.pdf beside the summary tables in `folder`. trade: a trade.csv, where one was measured."""
    tables = {table.name: StoredRows(folder / table.file_name) for table in columns.SUMMARY_TABLES}
    if trade is not None:
        tables["trade"] = StoredRows(trade)
    write_whole(folder / "summary.pdf", summary_report(tables, settings))


def draw_summary(comparison: Path, target: Path) -> None:
    """Draw prediction against integration of every row of the comparison table into the SVG file `target`."""
    write_whole(target, svg(prediction_scatter(StoredRows(comparison))).encode())
