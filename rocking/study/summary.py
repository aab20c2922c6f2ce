"""The tables of a whole study, built by streaming the tables of its records."""

import json
import math
import platform
from collections.abc import Iterable, Iterator, Mapping
from importlib.metadata import version
from pathlib import Path

from rocking.assessment import columns
from rocking.assessment.agreement import agreement_rows
from rocking.assessment.method import Method
from rocking.structures import Structure
from rocking.structures.equivalence import measure_equivalence
from rocking.tables import Row, StoredRows, Table, data_package, write_table, write_whole

_COPIED = (columns.RECORD, columns.PULSES, columns.COMPARISON, columns.FAILURES, columns.TIMINGS)


def write_summary(folders: Iterable[Path], structures: Mapping[str, Structure], target: Path) -> None:
    """Write the summary tables of the record folders `folders`, in their order, into `target`."""
    folders = tuple(folders)
    for table in _COPIED:
        write_table(table, _all_rows(folders, table), target / table.file_name)
    counted = agreement_rows(_all_rows(folders, columns.COMPARISON))
    write_table(columns.AGREEMENT, counted, target / columns.AGREEMENT.file_name)
    write_table(columns.MAXIMA, _maxima(folders), target / columns.MAXIMA.file_name)
    write_table(columns.STRUCTURES, structure_rows(structures), target / columns.STRUCTURES.file_name)
    write_table(columns.EQUIVALENCE, equivalence_rows(structures), target / columns.EQUIVALENCE.file_name)


def write_description(folders: Iterable[Path], target: Path) -> None:
    """Describe every column: datapackage.json in `target` for its tables, one in its parent for those of the records.

    Two, because a data package may not name files outside its own folder.
    """
    names = [folder.name for folder in folders]
    summary = {table.name: (table, table.file_name) for table in columns.SUMMARY_TABLES}
    records = {
        table.name: (table, [f"{name}/{table.file_name}" for name in names])
        for table in columns.RECORD_TABLES
    }
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


def structure_rows(structures: Mapping[str, Structure]) -> Iterator[Row]:
    """The rows of the structures table."""
    for name, structure in structures.items():
        mechanism = structure.mechanism()
        side = mechanism.positive
        yield {
            "structure": name,
            "type": type(structure).__name__,
            "geometry": str(structure),
            "frequency_parameter_rad_s": side.frequency_parameter,
            "critical_rotation_rad": side.critical_rotation,
            "uplift_multiplier": mechanism.uplift_multiplier,
            "acceleration_scale_linearised": side.scaled_acceleration("linearised"),
            "acceleration_scale_uplift": side.scaled_acceleration("uplift"),
            "linearised_over_true_uplift": side.critical_rotation
            / side.scaled_acceleration("linearised")
            / side.uplift_multiplier,
            "restitution": side.restitution,
        }


AMPLITUDES = (0.1, 0.3, 0.5, 0.7, 0.9)
"""Rotations over φ_cr at which natural periods are compared."""
ACCELERATIONS = (1.1, 1.5, 2.0, 5.0)
"""Constant ground accelerations over that of uplift under which times to overturn are compared."""


def equivalence_rows(structures: Mapping[str, Structure]) -> Iterator[Row]:
    """The rows of the equivalence table: each side of each structure against its linearisation."""
    for name, structure in structures.items():
        for which, side in zip(("positive", "negative"), structure.mechanism().sides, strict=False):
            found = measure_equivalence(side, AMPLITUDES, ACCELERATIONS)
            head = {"structure": name, "side": which}
            yield from _measures(head, "natural period", "", AMPLITUDES, found.period_ratio)
            yield from _measures(
                head, "uplift acceleration", "linearised", (math.nan,), (found.uplift_ratio,)
            )
            for scale, ratios in found.overturning_ratio.items():
                yield from _measures(head, "time to overturn", scale, ACCELERATIONS, ratios)


def _measures(
    head: Mapping[str, object], measure: str, scale: str, places: Iterable[float], ratios: Iterable[float]
) -> Iterator[Row]:
    for place, value in zip(places, ratios, strict=True):
        yield {
            **head,
            "measure": measure,
            "acceleration_scale_choice": scale,
            "at": place,
            "block_over_structure": float(value),
        }


def _all_rows(folders: Iterable[Path], table: Table) -> Iterator[dict[str, str]]:
    for folder in folders:
        yield from StoredRows(folder / table.file_name)


def _maxima(folders: Iterable[Path]) -> Iterator[Row]:
    for folder in folders:
        rows = [*_all_rows([folder], columns.PREDICTIONS), *_all_rows([folder], columns.RESPONSES)]
        comparison = {_key(row): row for row in _all_rows([folder], columns.COMPARISON)}
        for row in rows:
            yield _maximum_row(row, comparison[_key(row)])


def _maximum_row(row: Mapping[str, str], comparison: Mapping[str, str]) -> Row:
    reference, value = _number(comparison["integrated_rotation_ratio"]), _number(row["rotation_ratio"])
    both_rock = 0 < value < math.inf and 0 < reference < math.inf
    is_reference = row["method"] == Method.MECHANISM_ON_RECORD
    names = columns.MAXIMA.column_names
    return {name: row.get(name, "") for name in names} | {
        "light": comparison["light"],
        "error": value / reference - 1 if both_rock and not is_reference else math.nan,
    }


def _key(row: Mapping[str, str]) -> tuple[str, str]:
    return row["component"], row["structure"]


def _number(text: str) -> float:
    return float(text) if text else math.nan
