"""The outcome of each record: what is kept of it for the products that stand over all records."""

import json
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rocking.assessment.rows import RECORD_TABLES, VerdictRow
from rocking.errors import RockingError
from rocking.study.kept import LARGEST, decoded_rows, encoded_rows, undamaged
from rocking.tables import Row, read_whole, write_whole
from rocking.tables.rows import rows_of


@dataclass(frozen=True)
class RecordOutcome:
    """What a record leaves: the rows of its tables, by their class, and what documents over all records show of it.

    page: what the page to explore shows. spectra: of the components, m/s², where there is a design level. Without
    reports both are empty. sums: the sha256 of its report and its tables, by their paths from the folder of the
    results.
    """

    rows: Mapping[type[Row], list[Row]]
    page: dict[str, Any]
    spectra: Mapping[str, Sequence[float]]
    sums: Mapping[str, str]


def keep_outcome(path: Path, outcome: RecordOutcome) -> None:
    """Keep the outcome of a record at `path`."""
    content = {
        "rows": encoded_rows(outcome.rows),
        "page": outcome.page,
        "spectra": outcome.spectra,
        "sums": outcome.sums,
    }
    write_whole(path, json.dumps(content, separators=(",", ":")).encode())


def read_outcomes(paths: Iterable[Path]) -> Iterator[RecordOutcome]:
    """Yield the outcome of each record, one at a time.

    Raises RockingError where one is not what this version writes.
    """
    for path in paths:
        with undamaged(path):
            content = json.loads(read_whole(path, LARGEST, RockingError))
            rows = decoded_rows(content["rows"], RECORD_TABLES)
            yield RecordOutcome(rows, content["page"], content["spectra"], content["sums"])


def verdicts_of(paths: Iterable[Path]) -> list[VerdictRow]:
    """Return what became of every structure under the records, from their outcomes: a table is print."""
    verdicts: list[VerdictRow] = []
    for path in paths:
        with undamaged(path):
            content = json.loads(read_whole(path, LARGEST, RockingError))
            verdicts += rows_of(VerdictRow, decoded_rows(content["rows"], [VerdictRow]))
    return verdicts
