"""The PDF of each record of a study, beside its tables."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from rocking.assessment import columns
from rocking.errors import RockingError
from rocking.records.catalogue import CatalogueRecord
from rocking.reports.record.report import failure_report, record_report
from rocking.study.run import Study
from rocking.study.summary import structure_rows
from rocking.tables import csv_cells, read_rows, write_whole


def report_records(
    records: Iterable[CatalogueRecord],
    study: Study,
    settings: Mapping[str, object],
    results: Path,
    log: Path,
) -> None:
    """Write report.pdf of each record into its folder below `results`, and a line for each into `log`."""
    structures = [csv_cells(columns.STRUCTURES, row) for row in structure_rows(study.structures)]
    with log.open("w", encoding="utf-8") as stream:
        for record in records:
            folder = results / record.id
            write_whole(folder / "report.pdf", _report(record, study, settings, folder, structures))
            print(f"{record.id}: report written", file=stream, flush=True)


def _report(
    record: CatalogueRecord,
    study: Study,
    settings: Mapping[str, object],
    folder: Path,
    structures: list[dict[str, str]],
) -> bytes:
    tables = {table.name: read_rows(folder / table.file_name) for table in columns.RECORD_TABLES}
    failures = read_rows(folder / columns.FAILURES.file_name)
    if not tables["comparison"]:
        return failure_report(record.id, " ".join(row["message"] for row in failures))
    try:
        accelerograms, vertical = study.open(record)
    except RockingError as error:
        return failure_report(record.id, str(error))
    tables |= {"structures": structures, "failures": failures}
    return record_report(record.id, accelerograms, study.structures, tables, settings, vertical)
