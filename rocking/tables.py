"""Result tables: a row is a frozen dataclass whose fields say what its columns are; all else derives from it.

    @row("spectrum", "One row per equivalent block")
    class SpectrumRow(Row):
        frequency_parameter_rad_s: float = column("p of the equivalent block", equation="Eq. 11")

A field is a float (nan: not known), int, bool, str, StrEnum, one of these or None, or a tuple of texts. From the class
come the CSV (`write_rows`, `read_rows`), its description (`data_package`) and data frames (`frame`). The unit of a
column stands at the end of its name. A text from a file cannot become a formula of a spreadsheet nor a second line: one
that begins like a formula is written behind an apostrophe, control characters and backslashes are escaped, and reading
takes both back.
"""

import csv
import glob
import io
import json
import math
import os
import re
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import MISSING, dataclass, field, fields
from enum import Enum, StrEnum
from itertools import islice
from pathlib import Path
from types import NoneType
from typing import (
    TYPE_CHECKING,
    Any,
    BinaryIO,
    ClassVar,
    TypeVar,
    dataclass_transform,
    get_args,
    get_type_hints,
)

from rocking.errors import RockingError

if TYPE_CHECKING:
    from pandas import DataFrame

_UNITS = {
    "rad_s": "rad/s",
    "m_s2": "m/s²",
    "m2_s3": "m²/s³",
    "m_s": "m/s",
    "rad": "rad",
    "hz": "Hz",
    "s": "s",
    "m": "m",
}
"""Unit by the end of a column's name; the first that fits counts."""
_TYPES = {float: "number", int: "integer", bool: "boolean"}
"""Frictionless types; every other is a string."""


@dataclass(frozen=True)
class Column:
    """One column: name (ending in its unit), Frictionless type, meaning, the equation it comes from, and its unit.

    holds: the type of a value. optional: whether it may be None.
    """

    name: str
    type: str
    description: str
    equation: str = ""
    unit: str = ""
    holds: Any = str
    optional: bool = False


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


class Row:
    """Root of every row class; `table` describes the file that holds its rows."""

    __slots__ = ()
    table: ClassVar[Table]


R = TypeVar("R", bound=Row)


def column(
    meaning: str, *, equation: str = "", unit: str = "", last: bool = False, default: Any = MISSING
) -> Any:
    """Declare a field of a row. unit: where the name cannot say it. last: after the columns of the subclasses."""
    known = {"meaning": meaning, "equation": equation, "unit": unit, "last": last}
    return field(default=default, metadata=known)


@dataclass_transform(frozen_default=True, kw_only_default=True, field_specifiers=(column,))
def row(name: str = "", description: str = "") -> Callable[[type[R]], type[R]]:
    """Make the decorated class a row of the table `name`; without a name, the common part of several rows."""

    def made(cls: type[R]) -> type[R]:
        row_class: Any = dataclass(frozen=True, slots=True, kw_only=True)(cls)
        hints = get_type_hints(row_class)
        declared = sorted(fields(row_class), key=lambda each: each.metadata["last"])
        row_class.table = Table(
            name, description, tuple(_column(f.name, hints[f.name], f.metadata) for f in declared)
        )
        return row_class

    return made


def _column(name: str, hint: Any, known: Mapping[str, Any]) -> Column:
    parts = [part for part in get_args(hint) if part is not NoneType] or [hint]
    holds = tuple if hint == tuple[str, ...] else parts[0]
    unit = known["unit"] or next((unit for end, unit in _UNITS.items() if name.endswith(f"_{end}")), "")
    optional = NoneType in get_args(hint)
    return Column(
        name, _TYPES.get(holds, "string"), known["meaning"], known["equation"], unit, holds, optional
    )


# ---- writing


def write_rows(row_class: type[R], rows: Iterable[R], path: Path) -> None:
    """Write `rows` to `path` as CSV, row by row, whole or not at all."""
    with rows_written(row_class, path) as write:
        write(rows)


@contextmanager
def rows_written(row_class: type[R], path: Path) -> Iterator[Callable[[Iterable[R]], None]]:
    """Yield what adds rows to the CSV file at `path`, which appears whole at the end, or not at all."""
    with _whole(path) as stream:
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


_FORMULA = re.compile(r"'*[=+\-@\t\r]")
_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\\]")
_ESCAPED = re.compile(r"\\(?:(\\)|u([0-9a-f]{4}))")


def _guarded(text: str) -> str:
    if text.isalnum():
        return text
    text = "'" + text if _FORMULA.match(text) else text
    return _CONTROL.sub(lambda found: "\\\\" if found[0] == "\\" else f"\\u{ord(found[0]):04x}", text)


def _unguarded(text: str) -> str:
    if "\\" in text:
        text = _ESCAPED.sub(lambda found: found[1] or chr(int(found[2], 16)), text)
    return text[1:] if text[:1] == "'" and _FORMULA.match(text) else text


def write_whole(path: Path, content: bytes | Iterable[bytes]) -> None:
    """Write `content`, or its pieces, to `path` through a temporary file beside it, so that it appears whole."""
    with _whole(path) as stream:
        stream.writelines([content] if isinstance(content, bytes) else content)


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
        written = {path: Path(temporary)}
        if (group := _TOGETHER.get()) is None:
            _put_in_place(written)
        else:
            group |= written
    except BaseException as error:
        Path(temporary).unlink(missing_ok=True)
        if isinstance(error, OSError) and error.filename in (None, temporary):
            raise _unwritten(path, error) from error
        raise


_TOGETHER: ContextVar[dict[Path, Path] | None] = ContextVar("_TOGETHER", default=None)
"""The files that wait for the end of written_together, with their temporary ones."""


@contextmanager
def written_together() -> Iterator[None]:
    """Let the files that are written within appear at its end, when the disk has them all; none after an error.

    The disk takes them side by side: to wait for it after each of the nine tables of a record takes ten times as long.
    """
    waiting: dict[Path, Path] = {}
    before = _TOGETHER.set(waiting)
    try:
        yield
        _put_in_place(waiting)
    except OSError as error:
        raise _unwritten(next(iter(waiting), Path()), error) from error
    finally:
        _TOGETHER.reset(before)
        for temporary in waiting.values():
            temporary.unlink(missing_ok=True)


def _put_in_place(written: Mapping[Path, Path]) -> None:
    """Rename temporary files, after the disk has them: else a power cut may leave a name with nothing behind it."""
    if len(written) == 1:
        _sync(*written.values())
    elif written:
        from concurrent.futures import ThreadPoolExecutor  # of which few readers of tables have need

        with ThreadPoolExecutor(len(written)) as threads:
            list(threads.map(_sync, written.values()))
    for path, temporary in written.items():
        os.replace(temporary, path)
    for folder in {path.parent for path in written}:
        _sync(folder)


def _sync(path: Path) -> None:
    """Wait until the disk holds a file, or the names in a folder."""
    handle = os.open(os.fspath(path), os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _unwritten(path: Path, error: OSError) -> RockingError:
    reason = error.strerror or str(error)
    return RockingError(f"{path} cannot be written: {reason}; mend that, then start again.")


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


def _field(described: Column) -> dict[str, str]:
    known = {"name": described.name, "type": described.type, "description": described.description}
    more = {"unit": described.unit, "equation": described.equation}
    return known | {key: value for key, value in more.items() if value}


# ---- reading


def read_rows(row_class: type[R], path: Path) -> Iterator[R]:
    """Yield the rows of a CSV file that `write_rows` wrote, one at a time.

    Raises RockingError naming file, line and column where a column is missing or unknown or a cell cannot be read.
    """
    columns = row_class.table.columns
    with _readable(path) as stream:
        lines = csv.reader(stream)
        _check_columns(row_class.table, next(lines, []), path)
        for cells in lines:
            if len(cells) != len(columns):
                raise RockingError(
                    f"{path}, line {lines.line_num}, has {len(cells)} cells, but must have {len(columns)}."
                )
            try:
                values = {each.name: _value(each, text) for each, text in zip(columns, cells, strict=True)}
            except ValueError as error:
                raise RockingError(f"{path}, line {lines.line_num}, {error}.") from None
            yield row_class(**values)


@contextmanager
def _readable(path: Path) -> Iterator[Any]:
    try:
        with Path(path).open(encoding="utf-8", newline="") as stream:
            yield stream
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise RockingError(f"{path} cannot be read: {reason}; make the table again.") from error


def _check_columns(table: Table, names: Iterable[str], path: Path) -> None:
    found, wanted = list(names), list(table.column_names)
    if found != wanted:
        wrong = sorted(set(found) ^ set(wanted)) or ["in another order"]
        raise RockingError(
            f"{path}, line 1: the columns are not those of {table.name} ({', '.join(wrong[:6])}); make the table again."
        )


def _value(described: Column, text: str) -> Any:
    """The value of a cell. Raises ValueError with the column and what is allowed."""
    holds = described.holds
    if text == "" and (described.optional or holds is float):
        return None if described.optional else math.nan
    if holds is str:
        return _unguarded(text)
    if holds is tuple:
        return tuple(_unguarded(text).split("; ")) if text else ()
    try:
        return {"true": True, "false": False}[text] if holds is bool else holds(text)
    except (ValueError, KeyError):
        allowed = (
            ", ".join(holds)
            if issubclass(holds, StrEnum)
            else {bool: "true or false", int: "a whole number"}.get(holds, "a number")
        )
        raise ValueError(f"column {described.name}: {text!r} must be {allowed}") from None


# ---- data frames


def frame(
    row_class: type[Row], source: Path | str | Iterable[Row], columns: Iterable[str] | None = None
) -> "DataFrame":
    """Return a table as a pandas DataFrame, from its CSV file or from rows; `columns`: only these.

    Numbers are float64 (INF is inf, an empty cell nan), int64, or Int64 where a count may be missing; truths are
    boolean, choices categories, texts str. Raises RockingError like `read_rows`.
    """
    import pandas as pd  # here, because half the commands make no data frame and it takes half a second to import

    table = row_class.table
    kept = [each for each in table.columns if columns is None or each.name in set(columns)]
    if not isinstance(source, Path | str):
        rows = list(source)
        values = {each.name: [_plain(getattr(one, each.name)) for one in rows] for each in kept}
        return pd.DataFrame({each.name: pd.Series(values[each.name], dtype=_dtype(each)) for each in kept})
    path = Path(source)
    with _readable(path) as stream:
        _check_columns(table, next(csv.reader(stream), []), path)
    texts = [each for each in kept if each.holds is str or each.holds is tuple]
    chosen = [each for each in kept if issubclass(each.holds, StrEnum)]
    try:
        made = pd.read_csv(
            path,
            usecols=[each.name for each in kept],
            dtype={each.name: "category" if each in chosen else _dtype(each) for each in kept},
            keep_default_na=False,
            na_values={each.name: ["", "nan"] for each in kept if each not in texts},
        )
        for each in chosen:
            made[each.name] = _checked(made[each.name], each)
    except ValueError:
        for _ in read_rows(row_class, path):  # says where
            pass
        raise
    for each in texts:
        made[each.name] = made[each.name].map(_unguarded)
    return made


def _dtype(described: Column) -> Any:
    import pandas as pd

    if issubclass(described.holds, StrEnum):
        return pd.CategoricalDtype([each.value for each in described.holds])
    known = {float: "float64", bool: "boolean", int: "Int64" if described.optional else "int64"}
    return known.get(described.holds, "str")


def _checked(found: Any, described: Column) -> Any:
    unknown = set(found.cat.categories) - set(described.holds)
    if unknown or (found.isna().any() and not described.optional):
        raise ValueError(described.name)
    return found.cat.set_categories([each.value for each in described.holds])


def _plain(value: object) -> object:
    if isinstance(value, Enum):
        return value.value
    return "; ".join(value) if isinstance(value, tuple) else value


def rows_of(row_class: type[R], table: "DataFrame") -> Iterator[R]:
    """Yield the rows of a whole data frame that `frame` gave as objects again."""
    columns = row_class.table.columns
    for found in table.astype(object).where(table.notna(), None).itertuples(index=False):
        yield row_class(**{each.name: _restored(each, getattr(found, each.name)) for each in columns})


def _restored(described: Column, value: Any) -> Any:
    if value is None or value != value:
        return None if described.optional else math.nan if described.holds is float else ""
    if described.holds is tuple:
        return tuple(value.split("; ")) if value else ()
    return described.holds(value)
