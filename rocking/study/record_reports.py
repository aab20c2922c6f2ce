"""The PDF of each record of a study, from its tables."""

from collections.abc import Callable, Iterable
from functools import partial
from pathlib import Path

from rocking.assessment.rows.of_folder import RecordTables
from rocking.errors import RockingError
from rocking.records.catalogue import CatalogueRecord
from rocking.reports.record import failure_report, record_report
from rocking.study.parts import read_part
from rocking.study.run import Opened, Study
from rocking.tables import write_whole


def report_records(
    records: Iterable[CatalogueRecord], study: Study, part: Path, results: Path, log: Path
) -> None:
    """Write report.pdf of each record of a job, whose tables are in `part`, into its folder below `results`.

    A line for each goes into `log`.
    """
    rows = {record.id: record for record in records}
    with log.open("w", encoding="utf-8") as stream:
        for identifier, tables in read_part(part):
            opened = partial(study.open, rows[identifier])
            write_report(identifier, opened, tables, study, results / identifier)
            print(f"{identifier}: report written", file=stream, flush=True)


def write_report(
    record: str, opened: Callable[[], Opened], tables: RecordTables, study: Study, folder: Path
) -> None:
    """Write report.pdf of a record into `folder`. opened: gives its components, if any are needed."""
    write_whole(folder / "report.pdf", _report(record, opened, tables, study))


def _report(record: str, opened: Callable[[], Opened], tables: RecordTables, study: Study) -> bytes:
    if not tables.comparison:
        return failure_report(record, " ".join(failure.message for failure in tables.failures))
    try:
        accelerograms, vertical = opened()
    except RockingError as error:
        return failure_report(record, str(error))
    settings = study.settings.mapping()
    return record_report(record, accelerograms, study.structures, tables, settings, vertical)
