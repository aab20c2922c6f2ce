"""Rows as CSV: written row by row with their description, and read back as typed objects."""

import csv
import io
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from itertools import islice
from pathlib import Path
from typing import Any

from rocking.described import Described
from rocking.errors import RockingError
from rocking.tables.files import whole, write_whole
from rocking.tables.row import R, Row, Table, cell, value_of


def write_rows(row_class: type[R], rows: Iterable[R], path: Path) -> None:
    """Write `rows` to `path` as CSV, row by row, whole or not at all."""
    with rows_written(row_class, path) as write:
        write(rows)


@contextmanager
def rows_written(row_class: type[R], path: Path) -> Iterator[Callable[[Iterable[R]], None]]:
    """Yield what adds rows to the CSV file at `path`, which appears whole at the end, or not at all."""
    with whole(path) as stream:
        stream.write(head(row_class))

        def write(rows: Iterable[R]) -> None:
            for line in islice(csv_lines(row_class, rows), 1, None):
                stream.write(line.encode())

        yield write


def head(row_class: type[Row]) -> bytes:
    """Return the first line of the CSV file of a table."""
    return next(csv_lines(row_class, ())).encode()


def csv_lines(row_class: type[R], rows: Iterable[R]) -> Iterator[str]:
    """Yield the CSV lines of `rows`, below the names of the columns. Raises RockingError for a row of another class."""
    names = row_class.table.column_names
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")

    def line(texts: Iterable[str]) -> str:
        stream.seek(0)
        stream.truncate()
        writer.writerow(texts)
        return stream.getvalue()

    yield line(names)
    for each in rows:
        if type(each) is not row_class:
            raise RockingError(
                f"{row_class.table.file_name}: {type(each).__name__} is not {row_class.__name__}."
            )
        yield line([cell(getattr(each, name)) for name in names])


def read_rows(row_class: type[R], path: Path) -> Iterator[R]:
    """Yield the rows of a CSV file that `write_rows` wrote, one at a time.

    Raises RockingError naming file, line and column where a column is missing or unknown or a cell cannot be read.
    """
    columns = row_class.table.columns
    with readable(path) as stream:
        lines = csv.reader(stream)
        check_columns(row_class.table, next(lines, []), path)
        for cells in lines:
            if len(cells) != len(columns):
                raise RockingError(
                    f"{path}, line {lines.line_num}, has {len(cells)} cells, but must have {len(columns)}."
                )
            try:
                values = {each.name: value_of(each, text) for each, text in zip(columns, cells, strict=True)}
            except ValueError as error:
                raise RockingError(f"{path}, line {lines.line_num}, {error}.") from None
            yield row_class(**values)


@contextmanager
def readable(path: Path) -> Iterator[Any]:
    try:
        with Path(path).open(encoding="utf-8", newline="") as stream:
            yield stream
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise RockingError(f"{path} cannot be read: {reason}; make the table again.") from error


def check_columns(table: Table, names: Iterable[str], path: Path) -> None:
    found, wanted = list(names), list(table.column_names)
    if found != wanted:
        wrong = sorted(set(found) ^ set(wanted)) or ["in another order"]
        raise RockingError(
            f"{path}, line 1: the columns are not those of {table.name} ({', '.join(wrong[:6])}); make the table again."
        )


def write_tables(
    tables: Mapping[type[Row], Iterable[Row]],
    folder: Path,
    package: str = "",
    description: str = "datapackage.json",
) -> None:
    """Write rows by their class into `folder`; with the name of a `package` also the file that describes the tables."""
    for kind, rows in tables.items():
        write_rows(kind, rows, folder / kind.table.file_name)
    if package:
        described = {kind.table.name: (kind.table, kind.table.file_name) for kind in tables}
        write_whole(folder / description, data_package(package, described))


def read_table(row_class: type[R], folder: Path) -> list[R]:
    """Return the rows of a table that lies in `folder`. Raises RockingError as `read_rows` does."""
    return list(read_rows(row_class, folder / row_class.table.file_name))


def data_package(name: str, resources: Mapping[str, tuple[Table, str | list[str]]]) -> bytes:
    """Return a Frictionless datapackage.json: for each resource its table and the file, or files, that hold it."""
    described = [_resource(resource, table, path) for resource, (table, path) in resources.items()]
    content = {"profile": "tabular-data-package", "name": name, "resources": described}
    return (json.dumps(content, indent=1) + "\n").encode()


def _resource(name: str, table: Table, path: str | list[str]) -> dict[str, object]:
    return {
        "name": name,
        "path": path,
        "profile": "tabular-data-resource",
        "description": table.description,
        "schema": {"fields": [_field(each) for each in table.columns], "missingValues": ["", "nan"]},
    }


def _field(each: Described) -> dict[str, str]:
    said = {"name": each.name, "type": each.type, "description": each.meaning}
    more = {"unit": each.unit, "equation": each.more["equation"]}
    return said | {key: value for key, value in more.items() if value}
