"""The rotation histories of each record of a study, on request."""

from collections.abc import Iterable
from pathlib import Path

from rocking.assessment.rows.of_case import HistoryRow, history_rows
from rocking.errors import RockingError
from rocking.records.catalogue import CatalogueRecord
from rocking.study.run import Study
from rocking.tables import write_rows


def write_histories(records: Iterable[CatalogueRecord], study: Study, results: Path, log: Path) -> None:
    """Write histories.csv of each record into its folder below `results`, and a line for each into `log`.

    That of a record that cannot be read has a head and no rows; its failures.csv says why.
    """
    with log.open("w", encoding="utf-8") as stream:
        for record in records:
            target = results / record.id / HistoryRow.table.file_name
            try:
                accelerograms, vertical = study.open(record)
            except RockingError as error:
                write_rows(HistoryRow, (), target)
                print(f"{record.id}: no histories: {error}", file=stream, flush=True)
                continue
            tolerance = study.settings.tolerance
            write_rows(
                HistoryRow,
                history_rows(record.id, accelerograms, study.structures, tolerance, vertical),
                target,
            )
            print(f"{record.id}: histories written", file=stream, flush=True)
