"""The PDF of each record of a study, beside its tables."""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

from rocking.assessment.rows import RecordTables
from rocking.errors import RockingError
from rocking.records.catalogue import CatalogueRecord
from rocking.reports.record.report import failure_report, record_report
from rocking.study.run import Opened, Study
from rocking.tables import write_whole


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
    tables = RecordTables.read(folder)
    if not tables.comparison:
        return failure_report(record.id, " ".join(failure.message for failure in tables.failures))
    try:
        accelerograms, vertical = opened()
    except RockingError as error:
        return failure_report(record.id, str(error))
    settings = study.settings.mapping()
    return record_report(record.id, accelerograms, study.structures, tables, settings, vertical)
