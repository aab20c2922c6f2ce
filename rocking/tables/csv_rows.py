"""Rows as CSV: written row by row with their description, and read back as typed objects or as a data frame."""

import csv
import json
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from io import TextIOWrapper
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from rocking.described import Described
from rocking.errors import RockingError
from rocking.tables.files import regular_file, whole, write_whole
from rocking.tables.row import R, Row, Table, cell, value_of

if TYPE_CHECKING:
    from pandas import DataFrame


def write_rows(row_class: type[R], rows: Iterable[R], path: Path) -> None:
    """Write `rows` to `path` as CSV, row by row, whole or not at all."""
    with rows_written(row_class, path) as write:
        write(rows)


@contextmanager
def rows_written(row_class: type[R], path: Path) -> Iterator[Callable[[Iterable[R]], None]]:
    """Yield what adds rows to the CSV file at `path`, which appears whole at the end, or not at all."""
    with whole(path) as stream:
        stream.writelines(line.encode() for line in csv_lines(row_class, ()))
        yield lambda rows: stream.writelines(
            line.encode() for line in islice(csv_lines(row_class, rows), 1, None)
        )


def csv_lines(row_class: type[R], rows: Iterable[R]) -> Iterator[str]:
    """Yield the CSV lines of `rows`, below the names of the columns. Raises RockingError for a row of another class."""
    names = row_class.table.column_names
    line: list[str] = []
    writer = csv.writer(SimpleNamespace(write=line.append), lineterminator="\n")
    writer.writerow(names)
    yield line.pop()
    for each in rows:
        if type(each) is not row_class:
            kind = type(each).__name__
            raise RockingError(f"{row_class.table.file_name}: {kind} is not {row_class.__name__}.")
        writer.writerow([cell(getattr(each, name)) for name in names])
        yield line.pop()


def read_rows(row_class: type[R], path: Path) -> Iterator[R]:
    """Yield the rows of a CSV file that `write_rows` wrote, one at a time.

    Raises RockingError naming file, line and column where a column is missing or unknown or a cell cannot be read.
    """
    names = row_class.table.column_names
    for values in _read_values(row_class, path, names):
        yield row_class(**dict(zip(names, values, strict=True)))


def _read_values(row_class: type[Row], path: Path, names: Collection[str]) -> Iterator[list[Any]]:
    """Yield the values of the columns `names` in each row of a CSV file; raises RockingError as read_rows does."""
    columns = row_class.table.columns
    chosen = [(place, each) for place, each in enumerate(columns) if each.name in names]
    with readable(path) as stream:
        lines = csv.reader(stream)
        check_columns(row_class.table, next(lines, []), path)
        for cells in lines:
            if len(cells) != len(columns):
                counts = f"has {len(cells)} cells, but must have {len(columns)}"
                raise RockingError(f"{path}, line {lines.line_num}, {counts}.")
            try:
                values = [value_of(each, cells[place]) for place, each in chosen]
            except ValueError as error:
                raise RockingError(f"{path}, line {lines.line_num}, {error}.") from None
            yield values


@contextmanager
def readable(path: Path) -> Iterator[Any]:
    """Yield the text of a regular file. Raises RockingError where it cannot be read."""
    try:
        with (
            regular_file(Path(path)) as content,
            TextIOWrapper(content, encoding="utf-8", newline="") as stream,
        ):
            yield stream
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise RockingError(f"{path} cannot be read: {reason}; make the table again.") from error


def check_columns(table: Table, names: Iterable[str], path: Path) -> None:
    columns = list(names)
    expected = list(table.column_names)
    if columns != expected:
        wrong = sorted(set(columns) ^ set(expected)) or ["in another order"]
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
        paths = {kind: kind.table.file_name for kind in tables}
        write_whole(folder / description, data_package(package, paths))


def read_table(row_class: type[R], folder: Path) -> list[R]:
    """Return the rows of a table that lies in `folder`. Raises RockingError as `read_rows` does."""
    return list(read_rows(row_class, folder / row_class.table.file_name))


def data_package(name: str, paths: Mapping[type[Row], str | list[str]]) -> bytes:
    """Return a Frictionless datapackage.json: each table with the file, or files, that hold it."""
    resources = [
        {
            "name": kind.table.name,
            "path": path,
            "profile": "tabular-data-resource",
            "description": kind.table.description,
            "schema": {"fields": [_field(each) for each in kind.table.columns], "missingValues": ["", "nan"]},
        }
        for kind, path in paths.items()
    ]
    content = {"profile": "tabular-data-package", "name": name, "resources": resources}
    return (json.dumps(content, indent=1) + "\n").encode()


def _field(column: Described) -> dict[str, str]:
    kind = {float: "number", int: "integer", bool: "boolean"}.get(column.holds, "string")
    facts = {"name": column.name, "type": kind, "description": column.meaning}
    more = {"unit": column.unit, "equation": column.more["equation"]}
    return facts | {key: value for key, value in more.items() if value}


def frame(
    row_class: type[Row], source: Path | str | Iterable[Row], columns: Iterable[str] | None = None
) -> "DataFrame":
    """Return a table as a pandas DataFrame, from its CSV file or from rows; `columns`: only these.

    Numbers are float64 (INF is inf, an empty cell nan), int64, or Int64 where a count may be missing; truths are
    boolean, choices categories, texts str. Raises RockingError like `read_rows`.
    """
    import pandas as pd  # here, because half the commands make no data frame and it takes half a second to import

    chosen = [each for each in row_class.table.columns if columns is None or each.name in set(columns)]
    names = [each.name for each in chosen]
    if isinstance(source, Path | str):
        rows = list(_read_values(row_class, Path(source), names))
    else:
        rows = [[getattr(row, name) for name in names] for row in source]
    table = pd.DataFrame(index=range(len(rows)))
    for place, each in enumerate(chosen):
        values = [row[place] for row in rows]
        if each.holds is tuple:
            values = ["; ".join(map(str, value)) for value in values]
        dtypes: dict[Any, Any] = {
            float: "float64",
            bool: "boolean",
            int: "Int64" if each.optional else "int64",
        }
        if issubclass(each.holds, StrEnum):
            dtypes[each.holds] = pd.CategoricalDtype([choice.value for choice in each.holds])
        table[each.name] = pd.Series(values, dtype=dtypes.get(each.holds, "str"))
    return table


def rows_of(row_class: type[R], tables: Mapping[type[Row], Iterable[Row]]) -> list[R]:
    """Return the rows of one class among `tables`; none where they lack it."""
    return [row for row in tables.get(row_class, ()) if isinstance(row, row_class)]
