"""The rows of tables: frozen dataclasses whose fields carry type, unit, meaning and equation; and their files.

Rows are written as CSV row by row with their description, and read back as typed objects or as a data frame.
"""

import csv
import json
import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import MISSING, dataclass, fields, replace
from enum import Enum, StrEnum
from io import TextIOWrapper
from itertools import islice
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, dataclass_transform

from rocking.described import Described, described, described_values, number_hint
from rocking.errors import RockingError
from rocking.quantities import shown
from rocking.tables.files import Document, check_target, regular_file, whole, write_whole
from rocking.warnings import Kind, every_kind, kind_of

_UNITS = {
    "n_per_m": "N/m",
    "rad_s": "rad/s",
    "m_s2": "m/s²",
    "m2_s3": "m²/s³",
    "m_s": "m/s",
    "rad": "rad",
    "hz": "Hz",
    "deg": "°",
    "s": "s",
    "m": "m",
}
"""Unit by the end of a column's name; the first that fits counts."""


@dataclass(frozen=True)
class Table:
    """A CSV table: its file name without folder, what a row is, and its columns in order.

    kept: the fields of its rows that no column prints; rows with such fields are not read back from CSV.
    """

    name: str
    description: str
    columns: tuple[Described, ...]
    kept: tuple[str, ...] = ()

    @property
    def file_name(self) -> str:
        """Name of the CSV file."""
        return f"{self.name}.csv"

    @property
    def column_names(self) -> tuple[str, ...]:
        """Names of the columns, in order."""
        return tuple(column.name for column in self.columns)


class Row:
    """Root of every row class; `table` describes the file that holds its rows."""

    __slots__ = ()
    table: ClassVar[Table]


R = TypeVar("R", bound=Row)


def column(
    meaning: str, *, equation: str = "", unit: str = "", last: bool = False, default: Any = MISSING
) -> Any:
    """Declare a field of a row that whoever makes it fills.

    unit: where the name cannot say it. last: after the columns of the subclasses.
    """
    return described(default, meaning, unit, equation=equation, last=last)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(column,))
def row(name: str = "", description: str = "", first: Sequence[str] = ()) -> Callable[[type[R]], type[R]]:
    """Make the decorated class a row of the table `name`; without a name, the common part of several rows.

    description: of the table, by default the first line of the docstring of the class. first: the columns that lead,
    whichever class they come from; the others follow in the order of their declaration.
    """

    def made(cls: type[R]) -> type[R]:
        row_class: Any = dataclass(frozen=True, slots=True, kw_only=True)(cls)
        columns = []
        values = dict(described_values(row_class))
        leading = [values.pop(attribute) for attribute in first]
        following = sorted(values.values(), key=lambda column: column.more["last"])
        for column in (*leading, *following):
            ends = (unit for end, unit in _UNITS.items() if column.name.endswith(f"_{end}"))
            columns.append(replace(column, unit=column.unit or next(ends, "")))
        summary = description or (cls.__doc__ or "").partition("\n")[0].rstrip(".")
        described = {column.name for column in columns}
        kept = tuple(part.name for part in fields(row_class) if part.name not in described)
        row_class.table = Table(name, summary, tuple(columns), kept)
        result: type[R] = row_class
        return result

    return made


_FORMULA = re.compile(r"'*[=+\-@\t\r]")
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\\]")
_ESCAPED = re.compile(r"\\(?:(\\)|u([0-9a-f]{4}))")


def cell(value: object) -> str:
    """Return the text that stands for `value` in a CSV file."""
    if isinstance(value, float):
        return "" if value != value else repr(float(value)).replace("inf", "INF")
    if isinstance(value, Enum):
        return str(value.value)
    if isinstance(value, str):
        return _guarded(value)
    if value is None:
        return ""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, tuple | list):
        return _guarded("; ".join(str(item) for item in value))
    return str(value)


def _guarded(text: str) -> str:
    if text.isalnum():
        return text
    text = "'" + text if _FORMULA.match(text) else text
    return _CONTROL.sub(lambda mark: "\\\\" if mark[0] == "\\" else f"\\u{ord(mark[0]):04x}", text)


def unguarded(text: str) -> str:
    if "\\" in text:
        text = _ESCAPED.sub(lambda mark: mark[1] or chr(int(mark[2], 16)), text)
    return text[1:] if text[:1] == "'" and _FORMULA.match(text) else text


def value_of(column: Described, text: str) -> Any:
    """The value of a cell. Raises ValueError with the column and what is allowed."""
    holds = column.holds
    if text == "" and (column.optional or holds is float):
        return None if column.optional else math.nan
    if holds is str:
        return unguarded(text)
    if holds is tuple:
        parts = unguarded(text).split("; ") if text else []
        return tuple(typed(column.name, column.item, part) for part in parts)
    return typed(column.name, holds, text)


def typed(name: str, kind: Any, text: str) -> Any:
    """One value of the column `name` as its type `kind`. Raises ValueError with the column and what is allowed."""
    if kind is str:
        return text
    made_of = kind_of if kind is Kind else kind
    try:
        return {"true": True, "false": False}[text] if kind is bool else made_of(text)
    except (ValueError, KeyError):
        allowed = {bool: "true or false", int: "a whole number"}.get(kind, "a number")
        if issubclass(kind, StrEnum):
            allowed = ", ".join(every_kind() if kind is Kind else kind)
        raise ValueError(f"column {name}: {shown(text)} must be {allowed}{number_hint(text)}") from None


if TYPE_CHECKING:
    from pandas import DataFrame


def write_rows(row_class: type[R], rows: Iterable[R], path: Path) -> None:
    """Write `rows` to `path` as CSV, row by row, whole or not at all."""
    with whole(path) as stream:
        stream.writelines(line.encode() for line in csv_lines(row_class, rows))


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
    for table_row in rows:
        if type(table_row) is not row_class:
            kind = type(table_row).__name__
            sentence = f"{row_class.table.file_name}: {kind} is not {row_class.__name__}."
            raise RockingError(sentence, row=kind)
        writer.writerow([cell(getattr(table_row, name)) for name in names])
        yield line.pop()


def read_rows(row_class: type[R], path: Path) -> Iterator[R]:
    """Yield the rows of a CSV file that `write_rows` wrote, one at a time.

    Raises RockingError naming file, line and column where a column is missing or unknown or a cell cannot be read, and
    TypeError for rows that carry more than their columns.
    """
    if row_class.table.kept:
        raise TypeError(
            f"{row_class.__name__} carries {', '.join(row_class.table.kept)}, which no CSV file holds."
        )
    names = row_class.table.column_names
    for values in _read_values(row_class, path, names):
        yield row_class(**dict(zip(names, values, strict=True)))


def _read_values(row_class: type[Row], path: Path, names: Collection[str]) -> Iterator[list[Any]]:
    """Yield the values of the columns `names` in each row of a CSV file; raises RockingError as read_rows does."""
    columns = row_class.table.columns
    chosen = [(place, one) for place, one in enumerate(columns) if one.name in names]
    with readable(path) as stream:
        lines = csv.reader(stream)
        check_columns(row_class.table, next(lines, []), path)
        for cells in lines:
            if len(cells) != len(columns):
                counts = f"has {len(cells)} cells, but must have {len(columns)}"
                sentence = f"{path}, line {lines.line_num}, {counts}."
                raise RockingError(sentence, cells=len(cells))
            values: list[Any] = []
            try:
                for place, wanted in chosen:
                    values.append(value_of(wanted, cells[place]))
            except ValueError as error:
                place, wanted = chosen[len(values)]
                sentence = f"{path}, line {lines.line_num}, {error}."
                raise RockingError(sentence, **{wanted.name: cells[place]}) from None
            yield values


def values_of(
    row_class: type[Row], source: Path | str | Iterable[Row], names: Collection[str] | None = None
) -> Iterator[Sequence[Any]]:
    """Yield the values of each row of a table, from its CSV file or from rows; `names`: of these columns alone."""
    names = row_class.table.column_names if names is None else names
    if isinstance(source, Path | str):
        yield from _read_values(row_class, Path(source), names)
    else:
        yield from ([getattr(row, name) for name in names] for row in source)


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
        sentence = f"{path} cannot be read: {reason}; make the table again."
        raise RockingError(sentence, file=path.name) from error


def check_columns(table: Table, names: Iterable[str], path: Path) -> None:
    columns = list(names)
    expected = list(table.column_names)
    if columns != expected:
        wrong = sorted(set(columns) ^ set(expected)) or ["in another order"]
        raise RockingError(
            f"{path}, line 1: the columns are not those of {table.name} ({', '.join(wrong[:6])}); make the table "
            "again.",
            columns=wrong,
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


def document_of(row_class: type[Row]) -> Document:
    """Return the table of these rows as a kind of file, which its own names of columns tell from others."""
    names = next(csv_lines(row_class, ())).encode()
    return Document(f"table of {row_class.table.name}", ".csv", lambda content: content.startswith(names))


def check_tables(row_classes: Iterable[type[Row]], folder: Path) -> None:
    """Check that the tables of these rows may be written into a folder that a user names, as `check_target` does."""
    for row_class in row_classes:
        check_target(folder / row_class.table.file_name, document_of(row_class))


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
            "schema": {
                "fields": [_field(column) for column in kind.table.columns],
                "missingValues": ["", "nan"],
            },
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

    chosen = [column for column in row_class.table.columns if columns is None or column.name in set(columns)]
    names = [column.name for column in chosen]
    rows = list(values_of(row_class, source, names))
    table = pd.DataFrame(index=range(len(rows)))
    for place, column in enumerate(chosen):
        values = [row[place] for row in rows]
        if column.holds is tuple:
            values = ["; ".join(map(str, value)) for value in values]
        dtypes: dict[Any, Any] = {
            float: "float64",
            bool: "boolean",
            int: "Int64" if column.optional else "int64",
        }
        if issubclass(column.holds, StrEnum):
            dtypes[column.holds] = pd.CategoricalDtype([choice.value for choice in column.holds])
        table[column.name] = pd.Series(values, dtype=dtypes.get(column.holds, "str"))
    return table


def rows_of(row_class: type[R], tables: Mapping[type[Row], Iterable[Row]]) -> list[R]:
    """Return the rows of one class among `tables`; none where they lack it."""
    return [row for row in tables.get(row_class, ()) if isinstance(row, row_class)]
