"""The tables a user gets: each column once, with its type, unit and meaning; written whole or not at all."""

import csv
import glob
import io
import json
import math
import os
import tempfile
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import BinaryIO

from rocking.errors import RockingError

Row = Mapping[str, object]


@dataclass(frozen=True)
class Column:
    """One column: name (ending in its unit), Frictionless type, meaning, and the equation it comes from."""

    name: str
    type: str
    description: str
    equation: str = ""


@dataclass(frozen=True)
class Table:
    """A CSV table: its file name without folder, what a row is, and its columns in order."""

    name: str
    description: str
    columns: tuple[Column, ...]

    @property
    def file_name(self) -> str:
        """Name of the CSV file."""
        return f"{self.name}.csv"

    @property
    def column_names(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(column.name for column in self.columns)


def csv_lines(table: Table, rows: Iterable[Row]) -> Iterator[str]:
    """Yield the CSV lines of `rows`, every one of which must have exactly the table's columns.

    Raises RockingError for a row with a missing or an unknown column.
    """
    yield _line(table.column_names)
    names = set(table.column_names)
    for row in rows:
        if set(row) != names:
            wrong = ", ".join(sorted(set(row) ^ names))
            raise RockingError(f"{table.file_name}: a row and the table differ in the columns {wrong}.")
        yield _line([_cell(row[name]) for name in table.column_names])


def csv_cells(table: Table, row: Row) -> dict[str, str]:
    """Return `row` as the text that a CSV file of `table` would hold."""
    return {name: _cell(row[name]) for name in table.column_names}


def read_rows(path: Path) -> list[dict[str, str]]:
    """Return the rows of a CSV file as mappings of text, nothing converted."""
    return list(StoredRows(Path(path)))


@dataclass(frozen=True)
class StoredRows:
    """The rows of a CSV file as mappings of text, read anew whenever they are gone through: none stays in memory."""

    path: Path

    def __iter__(self) -> Iterator[dict[str, str]]:
        with self.path.open(encoding="utf-8", newline="") as stream:
            yield from csv.DictReader(stream)


def write_table(table: Table, rows: Iterable[Row], path: Path) -> None:
    """Write `rows` to `path` as the CSV that `table` describes, row by row, whole or not at all."""
    with _whole(path) as stream:
        for line in csv_lines(table, rows):
            stream.write(line.encode())


def write_whole(path: Path, content: bytes) -> None:
    """Write `content` to `path` through a temporary file beside it, so that it appears whole."""
    with _whole(path) as stream:
        stream.write(content)


@contextmanager
def _whole(path: Path) -> Iterator[BinaryIO]:
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        for left_by_a_kill in path.parent.glob(f".{glob.escape(path.name)}.*.part"):
            left_by_a_kill.unlink(missing_ok=True)
        handle, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=".part")
    except OSError as error:
        raise _unwritten(path, error) from error
    try:
        with os.fdopen(handle, "wb") as stream:
            yield stream
        os.chmod(temporary, 0o644)
        os.replace(temporary, path)
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename in (None, temporary):
            raise _unwritten(path, error) from error
        raise


def _unwritten(path: Path, error: OSError) -> RockingError:
    reason = error.strerror or str(error)
    return RockingError(f"{path} cannot be written: {reason}; mend that, then start again.")


def data_package(name: str, tables: Mapping[str, tuple[Table, str | list[str]]]) -> bytes:
    """Return a Frictionless datapackage.json: for each resource its table and the file, or files, that hold it."""
    resources = [_resource(resource, table, path) for resource, (table, path) in tables.items()]
    return (
        json.dumps({"profile": "tabular-data-package", "name": name, "resources": resources}, indent=1) + "\n"
    ).encode()


def _resource(name: str, table: Table, path: str | list[str]) -> dict[str, object]:
    fields = []
    for column in table.columns:
        field = {"name": column.name, "type": column.type, "description": column.description}
        fields.append(field | ({"equation": column.equation} if column.equation else {}))
    return {
        "name": name,
        "path": path,
        "profile": "tabular-data-resource",
        "description": table.description,
        "schema": {"fields": fields, "missingValues": ["", "nan"]},
    }


def _line(cells: Iterable[str]) -> str:
    stream = io.StringIO()
    csv.writer(stream, lineterminator="\n").writerow(cells)
    return stream.getvalue()


def _cell(value: object) -> str:
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, float):
        return "" if math.isnan(value) else repr(float(value)).replace("inf", "INF")
    if isinstance(value, tuple | list):
        return "; ".join(str(item) for item in value)
    return str(value)
