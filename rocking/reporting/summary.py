"""The PDF and the figure of a whole study, beside its summary tables."""

from collections.abc import Mapping
from pathlib import Path

from rocking import columns
from rocking.reports.style import svg
from rocking.reports.summary import summary_report
from rocking.reports.summary_figures import prediction_scatter
from rocking.tables import read_rows, write_whole


def report_summary(folder: Path, settings: Mapping[str, object]) -> None:
    """Write summary.pdf beside the summary tables in `folder`."""
    used = (table for table in columns.SUMMARY_TABLES if table not in (columns.MAXIMA, columns.TIMINGS))
    tables = {
        table.name: read_rows(folder / table.file_name) for table in used
    }  # the two left out are the longest
    write_whole(folder / "summary.pdf", summary_report(tables, settings))


def draw_summary(comparison: Path, target: Path) -> None:
    """Draw prediction against integration of every row of the comparison table into the SVG file `target`."""
    cases = [
        (
            float(row["predicted_rotation_ratio"] or "nan"),
            float(row["integrated_rotation_ratio"] or "nan"),
            row["light"],
        )
        for row in read_rows(comparison)
    ]
    write_whole(target, svg(prediction_scatter(cases)).encode())
