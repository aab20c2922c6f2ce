"""The PDF and the figure of a whole study, beside its summary tables."""

from collections.abc import Mapping
from pathlib import Path

from rocking.assessment.fragility.rows import FragilityRow, FragilitySummaryRow, IdaRow
from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_study import SUMMARY_TABLES
from rocking.reports.style import svg
from rocking.reports.summary.figures import prediction_scatter
from rocking.reports.summary.report import summary_report
from rocking.reports.trade import trade_picture
from rocking.tables import frame, write_whole

_GOVERNING = ("structure", "record", "level", "overturning_share")
_SHOWN = ("record", "pulses", "comparison", "verdicts", "structures", "agreement", "failures")


def report_summary(
    folder: Path, settings: Mapping[str, object], trade: Path | None = None, fragility: Path | None = None
) -> None:
    """Write summary.pdf beside the summary tables in `folder`.

    trade: the folder of the trade, where measured. fragility: the folder of the fragility, where measured.
    """
    shown = {each.table.name: each for each in SUMMARY_TABLES if each.table.name in _SHOWN}
    tables = {name: frame(each, folder / each.table.file_name) for name, each in shown.items()}
    if fragility is not None:
        for each in (FragilityRow, FragilitySummaryRow):
            tables[each.table.name] = frame(each, fragility / each.table.file_name)
        tables["ida"] = frame(IdaRow, fragility / IdaRow.table.file_name, _GOVERNING)
    shown_trade = trade_picture(trade) if trade else []
    write_whole(folder / "summary.pdf", summary_report(tables, settings, shown_trade))


def draw_summary(comparison: Path, target: Path) -> None:
    """Draw prediction against integration of every row of the comparison table into the SVG file `target`."""
    columns = ("predicted_rotation_ratio", "integrated_rotation_ratio")
    write_whole(target, svg(prediction_scatter(frame(ComparisonRow, comparison, columns))).encode())
