"""The tables of a whole study, gathered from those of its jobs."""

import json
import platform
from collections.abc import Iterable, Mapping, Sequence
from importlib.metadata import version
from pathlib import Path

from rocking.assessment.rows.of_case import ComparisonRow
from rocking.assessment.rows.of_study import (
    AGREEMENT_COLUMNS,
    SUMMARY_TABLES,
    AgreementRow,
    CapacityRow,
    StructureRow,
    agreement_rows,
    capacity_rows,
    structure_rows,
)
from rocking.structures import Structure
from rocking.study.parts import IN_PARTS, gathered, part
from rocking.tables import data_package, frame, write_tables, write_whole

_GATHERED = [each for each in SUMMARY_TABLES if each in IN_PARTS]


def write_summary(
    parts: Sequence[Path], records: Sequence[str], structures: Mapping[str, Structure], target: Path
) -> None:
    """Write the summary tables of a study into `target`, from the tables of its jobs in `parts`.

    records: the identifiers in the order in which their rows are to stand.
    """
    for each in _GATHERED:
        write_whole(target / each.table.file_name, gathered(each, parts, records))
    of_structures = {
        StructureRow: structure_rows,
        CapacityRow: capacity_rows,
    }
    write_tables({each: rows(structures) for each, rows in of_structures.items()}, target)  # type: ignore[operator]
    cases = frame(ComparisonRow, target / ComparisonRow.table.file_name, AGREEMENT_COLUMNS)
    write_tables({AgreementRow: agreement_rows(cases)}, target)


def write_description(jobs: Iterable[str], results: Path) -> None:
    """Describe every column: datapackage.json beside the summary tables, and one in `results` for those of the jobs.

    Two, because a data package may not name files outside its own folder.
    """
    folders = [part(Path(), job).as_posix() for job in jobs]
    of_study, of_jobs = ([each.table for each in many] for many in (SUMMARY_TABLES, IN_PARTS))
    summary = {table.name: (table, table.file_name) for table in of_study}
    parts = {table.name: (table, [f"{folder}/{table.file_name}" for folder in folders]) for table in of_jobs}
    write_whole(results / "summary" / "datapackage.json", data_package("rocking-study-summary", summary))
    write_whole(results / "datapackage.json", data_package("rocking-study", parts))


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
