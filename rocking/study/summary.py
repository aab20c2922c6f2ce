"""The tables of a whole study, built by streaming the tables of its records."""

import json
import platform
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import version
from pathlib import Path

from rocking.assessment.rows import (
    RECORD_TABLES,
    SUMMARY_TABLES,
    AgreementRow,
    CapacityRow,
    ComparisonRow,
    EnsembleRow,
    EquivalenceRow,
    FailureRow,
    MaximumRow,
    PredictionRow,
    PulseRow,
    RecordRow,
    ResponseRow,
    StructureRow,
    TimingRow,
    agreement_rows,
    capacity_rows,
    equivalence_rows,
    maximum_row,
    structure_rows,
)
from rocking.assessment.rows.of_study import AGREEMENT_COLUMNS
from rocking.structures import Structure
from rocking.tables import Row, data_package, frame, read_rows, write_rows, write_whole

_COPIED: tuple[type[Row], ...] = (
    RecordRow,
    PulseRow,
    ComparisonRow,
    EnsembleRow,
    FailureRow,
    TimingRow,
)


def write_summary(folders: Iterable[Path], structures: Mapping[str, Structure], target: Path) -> None:
    """Write the summary tables of the record folders `folders`, in their order, into `target`."""
    folders = tuple(folders)
    for copied in _COPIED:
        _write(copied, _gathered(copied, folders), target)
    _write(MaximumRow, (row for folder in folders for row in _maxima(folder)), target)
    _write(StructureRow, structure_rows(structures), target)
    _write(EquivalenceRow, equivalence_rows(structures), target)
    _write(CapacityRow, capacity_rows(structures), target)
    cases = frame(ComparisonRow, target / ComparisonRow.table.file_name, AGREEMENT_COLUMNS)
    _write(AgreementRow, agreement_rows(cases), target)


def _write(row_class: type[Row], rows: Iterable[Row], target: Path) -> None:
    write_rows(row_class, rows, target / row_class.table.file_name)


def _gathered(row_class: type[Row], folders: Iterable[Path]) -> Iterator[Row]:
    for folder in folders:
        yield from read_rows(row_class, folder / row_class.table.file_name)


def _maxima(folder: Path) -> Iterator[MaximumRow]:
    comparison = {row.case: row for row in read_rows(ComparisonRow, folder / ComparisonRow.table.file_name)}
    for predicted in read_rows(PredictionRow, folder / PredictionRow.table.file_name):
        yield maximum_row(predicted, comparison[predicted.case])
    for integrated in read_rows(ResponseRow, folder / ResponseRow.table.file_name):
        yield maximum_row(integrated, comparison[integrated.case])


def write_description(folders: Iterable[Path], target: Path) -> None:
    """Describe every column: datapackage.json in `target` for its tables, one in its parent for those of the records.

    Two, because a data package may not name files outside its own folder.
    """
    names = [folder.name for folder in folders]
    of_study, of_records = ([each.table for each in many] for many in (SUMMARY_TABLES, RECORD_TABLES))
    summary = {table.name: (table, table.file_name) for table in of_study}
    records = {table.name: (table, [f"{name}/{table.file_name}" for name in names]) for table in of_records}
    write_whole(target / "datapackage.json", data_package("rocking-study-summary", summary))
    write_whole(target.parent / "datapackage.json", data_package("rocking-study", records))


def write_provenance(
    settings: Mapping[str, object], records: Mapping[str, str], hashes: Mapping[str, str], target: Path
) -> None:
    """Write provenance.json: versions, the hash of every record, the settings and the hash of the code."""
    packages = ("rocking", "obspy", "numpy", "scipy", "pandas", "matplotlib", "numba", "snakemake", "typst")
    content = {
        "versions": {"python": platform.python_version()} | {name: version(name) for name in packages},
        "settings": dict(settings),
        "hashes": dict(hashes),
        "records": dict(records),
    }
    text = json.dumps(content, indent=1, sort_keys=True, default=str)
    write_whole(target / "provenance.json", (text + "\n").encode())
