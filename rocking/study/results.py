"""The results of a study: what is kept of each record for what stands over all records, and the tables read back."""

import json
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_type_hints

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, TimingRow, TradeRow, VerdictRow
from rocking.assessment.store import decoder, encoded
from rocking.errors import RockingError
from rocking.tables import Row, frame, read_whole, regular_file, whole, write_whole, written_together
from rocking.tables.rows import check_columns, readable, rows_of

if TYPE_CHECKING:
    from pandas import DataFrame

_LARGEST = 200_000_000
"""Bytes of what is kept of a product that are read; of a record under ten structures some hundred thousand."""

Rows = Mapping[type[Row], Iterable[Row]]
"""The rows of tables by their class."""


@dataclass(frozen=True)
class RecordOutcome:
    """What a record leaves: the rows of its tables, by their class, and what documents over all records show of it.

    page: what the page to explore shows. spectra: of the components, m/s², where there is a design level. Without
    reports both are empty. sums: the sha256 of its report and its tables, by their paths from the folder of the
    results, where the record has files of its own.
    """

    rows: Mapping[type[Row], list[Row]]
    page: dict[str, Any]
    spectra: Mapping[str, Sequence[float]]
    sums: Mapping[str, str]


@contextmanager
def outcomes_written(path: Path) -> Iterator[Callable[[str, RecordOutcome], None]]:
    """Yield what keeps the outcome of a record by its identifier, in one file that appears whole at the end.

    In a file that ends in .zip, which holds those of a batch, each is a member; else the file is that of one record.
    """
    if path.suffix != ".zip":
        yield lambda record, outcome: write_whole(path, _encoded_outcome(outcome))
        return
    with whole(path) as stream, zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as batch:
        # A member without a date: the same input gives the same bytes.
        yield lambda record, outcome: batch.writestr(
            zipfile.ZipInfo(record), _encoded_outcome(outcome), zipfile.ZIP_DEFLATED
        )


def _encoded_outcome(outcome: RecordOutcome) -> bytes:
    content = {
        "rows": encoded_rows(outcome.rows),
        "page": outcome.page,
        "spectra": outcome.spectra,
        "sums": outcome.sums,
    }
    return json.dumps(content, separators=(",", ":")).encode()


def read_outcomes(files: Mapping[str, Path]) -> Iterator[RecordOutcome]:
    """Yield the outcome of each record, one at a time; files: by the identifier of the record that which keeps it.

    Raises RockingError where one is not what this version writes.
    """
    for record, path in files.items():
        with _undamaged(path):
            content = json.loads(_kept_outcome(path, record))
            rows = decoded_rows(content["rows"], RECORD_TABLES)
            yield RecordOutcome(rows, content["page"], content["spectra"], content["sums"])


def _kept_outcome(path: Path, record: str) -> bytes:
    if path.suffix != ".zip":
        return read_whole(path, _LARGEST, RockingError)
    with regular_file(path) as stream, zipfile.ZipFile(stream) as batch:
        if batch.getinfo(record).file_size > _LARGEST:
            raise ValueError(f"{record} is larger than {_LARGEST} bytes")
        return batch.read(record)


def keep_rows(path: Path, rows: Rows, made_by_hand: Sequence[str] = ()) -> None:
    """Keep the rows of a product over all records; made_by_hand: what one is made from that no whole run makes."""
    lines = (json.dumps(each, separators=(",", ":")).encode() for each in (made_by_hand, encoded_rows(rows)))
    write_whole(path, b"\n".join(lines))


def kept_rows(path: Path, tables: Iterable[type[Row]]) -> dict[type[Row], list[Row]]:
    """Return the rows of some tables of a product. Raises RockingError where they are not what this version writes."""
    with _undamaged(path):
        _, _, rows = read_whole(path, _LARGEST, RockingError).partition(b"\n")
        return decoded_rows(json.loads(rows), tables)


def made_by_hand(path: Path) -> tuple[str, ...]:
    """Return what the product was made from whose rows are kept at `path`, if it was made by hand, else ()."""
    try:
        with regular_file(path) as stream:
            return tuple(map(str, json.loads(stream.readline(_LARGEST))))
    except (OSError, ValueError, TypeError, RecursionError):
        return ()


@contextmanager
def _undamaged(path: Path) -> Iterator[None]:
    """Raise RockingError, which names the file, for what only a damaged one gives."""
    try:
        yield
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError, zipfile.BadZipFile) as error:
        raise RockingError(f"{path}: it is damaged ({error}); remove it and run the study again.") from None


def verdicts_of(files: Mapping[str, Path]) -> list[VerdictRow]:
    """Return what became of every structure under the records, from their outcomes: a table is print."""
    verdicts: list[VerdictRow] = []
    for record, path in files.items():
        with _undamaged(path):
            content = json.loads(_kept_outcome(path, record))
            verdicts += rows_of(VerdictRow, decoded_rows(content["rows"], [VerdictRow]))
    return verdicts


def encoded_rows(rows: Rows) -> dict[str, list[list[Any]]]:
    """Return what JSON can hold of the rows of tables: by the name of the table what each row carries."""
    content = {}
    for each, of_it in rows.items():
        names = _carried(each)
        content[each.table.name] = [[encoded(getattr(row, name)) for name in names] for row in of_it]
    return content


def decoded_rows(
    content: Mapping[str, list[list[Any]]], tables: Iterable[type[Row]]
) -> dict[type[Row], list[Row]]:
    """Return the rows of `tables` that `encoded_rows` gave. Raises ValueError, KeyError or TypeError for others."""
    rows: dict[type[Row], list[Row]] = {}
    for each in tables:
        kept: Any = each
        columns = _columns_of(kept)
        rows[each] = [
            each(**{name: of(cell) for (name, of), cell in zip(columns, cells, strict=True)})
            for cells in content[each.table.name]
        ]
    return rows


@cache
def _columns_of(row_class: Any) -> list[tuple[str, Callable[[Any], Any]]]:
    """The name of each field of a row, and what makes its value of what is kept."""
    hints = get_type_hints(row_class)
    return [(name, decoder(hints[name])) for name in _carried(row_class)]


def _carried(row_class: type[Row]) -> tuple[str, ...]:
    """The names of what a row carries: its columns, and what is kept beside them."""
    return *row_class.table.column_names, *row_class.table.kept


def _lines_of(row_class: type[Row], path: Path, record: str) -> Iterator[bytes]:
    """Yield the lines of one record in a table over all records, behind its head."""
    with readable(path) as stream:
        head = stream.readline()
        check_columns(row_class.table, head.rstrip("\n").split(","), path)
        yield head.encode()
        # A row is one line, and begins with the identifier of its record.
        yield from (line.encode() for line in stream if line.startswith(f"{record},"))


@cache
def _tables() -> dict[str, type[Row]]:
    """The rows of the tables that are read back, by the name of the table."""
    from rocking.codes.rows import CodeCheckRow  # which a study without a design level has no need of

    rows: tuple[type[Row], ...] = (*RECORD_TABLES, *SUMMARY_TABLES, TradeRow, CodeCheckRow)
    return {each.table.name: each for each in rows}


class Results:
    """The folder of a study's results: each table is an attribute, read from its CSV when it is asked for.

    Parameters
    ----------
    folder : Path
        Folder of the results of a study.

    Examples
    --------
    >>> results = rocking.open_results("results")  # doctest: +SKIP
    >>> results.comparison.groupby("structure")["within_factor_two"].mean()  # doctest: +SKIP
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def table(self, name: str, columns: Iterable[str] | None = None) -> "DataFrame":
        """Return the table `name`, or only some of its columns. Raises RockingError where there is none."""
        import pandas as pd  # which takes half a second to import

        if name not in _tables():
            raise RockingError(f"table is {name!r}, but must be one of {', '.join(_tables())}.")
        row_class = _tables()[name]
        file = row_class.table.file_name
        names = list(row_class.table.column_names if columns is None else columns)
        if (summary := self.folder / "summary" / file).exists():
            return frame(row_class, summary, names)
        paths = sorted(self.folder.glob(f"*/{file}"))  # of records that were assessed one by one
        if not paths:
            raise RockingError(f"{self.folder} holds no {file}; name the folder of a study's results.")
        table = pd.concat([frame(row_class, path, ["record", *names]) for path in paths])
        return table.sort_values("record", kind="stable", ignore_index=True)[names]

    def write_record(self, record: str, folder: Path | str | None = None) -> list[Path]:
        """Write the tables of one record as CSV into `folder`, else into its folder, and return their paths.

        Raises RockingError where there is no such record.
        """
        target = self.folder / record if folder is None else Path(folder)
        summary = self.folder / "summary"
        tables = {
            each: list(_lines_of(each, summary / each.table.file_name, record)) for each in RECORD_TABLES
        }
        if len(tables[TimingRow]) == 1:  # which every record has, also one that could not be read
            raise RockingError(
                f"{self.folder} holds no tables of {record!r}; name a record of a study that has been run."
            )
        with written_together():
            for each, lines in tables.items():
                write_whole(target / each.table.file_name, lines)
        return [target / each.table.file_name for each in RECORD_TABLES]

    def __getattr__(self, name: str) -> "DataFrame":
        if name not in _tables():
            raise AttributeError(f"Results has no table {name!r}; there are {', '.join(_tables())}.")
        return self.table(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_tables()]

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r}): {', '.join(_tables())}"


def open_results(folder: Path | str) -> Results:
    """Return the tables of the results of a study in `folder`.

    Parameters
    ----------
    folder : Path or str
        Folder of the results of a study.

    Returns
    -------
    Results
        The tables, each read when it is asked for.

    Raises
    ------
    RockingError
        Where it holds no results.

    Examples
    --------
    >>> try:
    ...     rocking.open_results("nowhere")
    ... except rocking.RockingError as error:
    ...     print(error)
    nowhere is no folder; name the folder of a study's results.
    """
    path = Path(folder)
    if not path.is_dir():
        raise RockingError(f"{path} is no folder; name the folder of a study's results.")
    if not _holds_results(path):
        inner = path / "results"
        hint = f"name {inner}" if _holds_results(inner) else "name the folder of a study's results"
        raise RockingError(f"{path} holds no results, neither a summary nor tables of a record; {hint}.")
    return Results(path)


def _holds_results(folder: Path) -> bool:
    """Whether a folder has a summary, or below it the tables of records that were assessed one by one."""
    names = {table.table.file_name for table in RECORD_TABLES}
    return (folder / "summary").is_dir() or any(path.name in names for path in folder.glob("*/*.csv"))
