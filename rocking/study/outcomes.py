"""The outcome of each record: what is kept of it for the products that stand over all records."""

import json
import zipfile
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rocking.assessment.rows import RECORD_TABLES, VerdictRow
from rocking.errors import RockingError
from rocking.study.kept import LARGEST, decoded_rows, encoded_rows, undamaged
from rocking.tables import Row, read_whole, regular_file, whole, write_whole
from rocking.tables.rows import rows_of


@dataclass(frozen=True)
class RecordOutcome:
    """What a record leaves: the rows of its tables, by their class, and what documents over all records show of it.

    page: what the page to explore shows. spectra: of the components, m/s², where there is a design level. Without
    reports both are empty. sums: the sha256 of its report and its tables, by their paths from the folder of the
    results, where the record has files of its own.
    """

    rows: Mapping[type[Row], list[Row]]
    page: dict[str, Any]
    spectra: Mapping[str, Sequence[float]]
    sums: Mapping[str, str]


@contextmanager
def outcomes_written(path: Path) -> Iterator[Callable[[str, RecordOutcome], None]]:
    """Yield what keeps the outcome of a record by its identifier, in one file that appears whole at the end.

    In a file that ends in .zip, which holds those of a batch, each is a member; else the file is that of one record.
    """
    if path.suffix != ".zip":
        yield lambda _record, outcome: write_whole(path, _encoded_outcome(outcome))
        return
    with whole(path) as stream, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as batch:
        # A member without a date: the same input gives the same bytes.
        yield lambda record, outcome: batch.writestr(
            zipfile.ZipInfo(record), _encoded_outcome(outcome), zipfile.ZIP_DEFLATED
        )


def _encoded_outcome(outcome: RecordOutcome) -> bytes:
    content = {
        "rows": encoded_rows(outcome.rows),
        "page": outcome.page,
        "spectra": outcome.spectra,
        "sums": outcome.sums,
    }
    return json.dumps(content, separators=(",", ":")).encode()


def read_outcomes(files: Mapping[str, Path]) -> Iterator[RecordOutcome]:
    """Yield the outcome of each record, one at a time; files: by the identifier of the record that which keeps it.

    Raises RockingError where one is not what this version writes.
    """
    for record, path in files.items():
        with undamaged(path):
            content = json.loads(_kept_outcome(path, record))
            rows = decoded_rows(content["rows"], RECORD_TABLES)
            yield RecordOutcome(rows, content["page"], content["spectra"], content["sums"])


def _kept_outcome(path: Path, record: str) -> bytes:
    if path.suffix != ".zip":
        return read_whole(path, LARGEST, RockingError)
    with regular_file(path) as stream, zipfile.ZipFile(stream) as batch:
        if batch.getinfo(record).file_size > LARGEST:
            raise ValueError(f"{record} is larger than {LARGEST} bytes")
        return batch.read(record)


def verdicts_of(files: Mapping[str, Path]) -> list[VerdictRow]:
    """Return what became of every structure under the records, from their outcomes: a table is print."""
    verdicts: list[VerdictRow] = []
    for record, path in files.items():
        with undamaged(path):
            content = json.loads(_kept_outcome(path, record))
            verdicts += rows_of(VerdictRow, decoded_rows(content["rows"], [VerdictRow]))
    return verdicts
