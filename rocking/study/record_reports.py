"""The PDF of each record of a study, beside its tables."""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

from rocking.assessment import columns
from rocking.errors import RockingError
from rocking.records.catalogue import CatalogueRecord
from rocking.reports.record.report import failure_report, record_report
from rocking.study.run import Opened, Study
from rocking.study.summary import structure_rows
from rocking.tables import csv_cells, read_rows, write_whole


def report_records(records: Iterable[CatalogueRecord], study: Study, results: Path, log: Path) -> None:
    """Write report.pdf of each record into its folder below `results`, and a line for each into `log`."""
    with log.open("w", encoding="utf-8") as stream:
        for record in records:
            write_report(record, partial(study.open, record), study, results / record.id)
            print(f"{record.id}: report written", file=stream, flush=True)


def write_report(record: CatalogueRecord, opened: Callable[[], Opened], study: Study, folder: Path) -> None:
    """Write report.pdf beside the tables of a record in `folder`. opened: gives its components, if any are needed."""
    write_whole(folder / "report.pdf", _report(record, opened, study, folder))


def _report(record: CatalogueRecord, opened: Callable[[], Opened], study: Study, folder: Path) -> bytes:
    tables = {table.name: read_rows(folder / table.file_name) for table in columns.RECORD_TABLES}
    tables["failures"] = read_rows(folder / columns.FAILURES.file_name)
    if not tables["comparison"]:
        return failure_report(record.id, " ".join(row["message"] for row in tables["failures"]))
    try:
        accelerograms, vertical = opened()
    except RockingError as error:
        return failure_report(record.id, str(error))
    tables["structures"] = [csv_cells(columns.STRUCTURES, row) for row in structure_rows(study.structures)]
    settings = study.settings.mapping()
    return record_report(record.id, accelerograms, study.structures, tables, settings, vertical)
