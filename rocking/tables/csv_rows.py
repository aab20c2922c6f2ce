"""Rows as CSV: written row by row with their description, and read back as typed objects or as a data frame."""

import csv
import io
import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from enum import StrEnum
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

from rocking.described import Described
from rocking.errors import RockingError
from rocking.tables.files import whole, write_whole
from rocking.tables.row import R, Row, Table, cell, empty, unguarded, value_of

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

        def write(rows: Iterable[R]) -> None:
            stream.writelines(line.encode() for line in islice(csv_lines(row_class, rows), 1, None))

        yield write


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
    columns = list(names)
    wanted = list(table.column_names)
    if columns != wanted:
        wrong = sorted(set(columns) ^ set(wanted)) or ["in another order"]
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
    facts = {"name": column.name, "type": column.type, "description": column.meaning}
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

    kept = [each for each in row_class.table.columns if columns is None or each.name in set(columns)]
    content: Any = source
    if isinstance(source, Path | str):
        with readable(Path(source)) as stream:
            check_columns(row_class.table, next(csv.reader(stream), []), Path(source))
    else:
        content = io.StringIO("".join(csv_lines(row_class, source)))
    texts = [each for each in kept if each.holds is str or each.holds is tuple]
    chosen = [each for each in kept if issubclass(each.holds, StrEnum)]
    try:
        table = pd.read_csv(
            content,
            usecols=[each.name for each in kept],
            dtype={each.name: "category" if each in chosen else _dtype(each) for each in kept},
            keep_default_na=False,
            na_values={each.name: ["", "nan"] for each in kept if each not in texts},
        )
        for each in chosen:
            table[each.name] = _checked(table[each.name], each)
    except ValueError:
        if isinstance(source, Path | str):
            list(read_rows(row_class, Path(source)))  # says where
        raise
    for each in texts:
        table[each.name] = table[each.name].map(unguarded)
    return table


def _dtype(each: Described) -> Any:
    import pandas as pd

    if issubclass(each.holds, StrEnum):
        return pd.CategoricalDtype([one.value for one in each.holds])
    dtypes = {float: "float64", bool: "boolean", int: "Int64" if each.optional else "int64"}
    return dtypes.get(each.holds, "str")


def _checked(choices: Any, each: Described) -> Any:
    unknown = set(choices.cat.categories) - set(each.holds)
    if unknown or (choices.isna().any() and not each.optional):
        raise ValueError(each.name)
    return choices.cat.set_categories([one.value for one in each.holds])


def rows_of(row_class: type[R], table: "DataFrame") -> Iterator[R]:
    """Yield the rows of a whole data frame that `frame` gave as objects again."""
    columns = row_class.table.columns
    for line in table.astype(object).where(table.notna(), None).itertuples(index=False):
        yield row_class(**{each.name: _restored(each, getattr(line, each.name)) for each in columns})


def _restored(each: Described, value: Any) -> Any:
    if value is None or value != value:
        return empty(each)
    if each.holds is tuple:
        return tuple(value.split("; ")) if value else ()
    return each.holds(value)
