"""The results of a study: each job writes the rows of its records into tables of its own, gathered and read here."""

import csv
import heapq
import json
import re
import shutil
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from operator import itemgetter
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, RecordRows, TimingRow, TradeRow
from rocking.codes.rows import CodeCheckRow
from rocking.errors import RockingError
from rocking.tables import Row, csv_lines, frame, rows_written, whole, write_whole, written_together
from rocking.tables.csv_rows import check_columns, readable

if TYPE_CHECKING:
    from pandas import DataFrame

PAGE = "explore.jsonl"
"""Beside them: what the page to explore shows of each record, one JSON value a line."""
PROVENANCE = "provenance.json"
"""In the folder of the summary: what the results were made from and with."""
SPECTRA = "spectra"
"""The key of these under which the spectra of the components stand, for the summary, where there is a design level."""
_ROWS: tuple[type[Row], ...] = (*RECORD_TABLES, *SUMMARY_TABLES, TradeRow, CodeCheckRow)
_TABLES = {each.table.name: each for each in _ROWS}
_JOB = re.compile(r"\d{5}_of_\d{5}")


def part(results: Path, job: str) -> Path:
    """Return the folder of the tables of one job."""
    return results / "summary" / "jobs" / job


def cases_of(results: Path, record: str) -> Path:
    """Return the file that keeps the results of the cases of a record, for the next run."""
    return results / "summary" / "cases" / f"{record}.json"


def case_timings_of(results: Path, record: str) -> Path:
    """Return the file that keeps how long those results took, beside the other measurements of a run."""
    return results / "summary" / "benchmarks" / "cases" / f"{record}.json"


def remove_other_cases(results: Path, records: Collection[str]) -> None:
    """Remove what is kept of records that the study does not hold any more."""
    for folder in (cases_of(results, "").parent, case_timings_of(results, "").parent):
        for path in folder.glob("*.json"):
            if path.stem not in records:
                path.unlink(missing_ok=True)


@contextmanager
def written_part(folder: Path) -> Iterator[Callable[[RecordRows, Mapping[str, Any] | None], None]]:
    """Yield what adds a record to the files in `folder`, which appear together at the end, or not at all.

    It takes the tables of the record and, where there is one, what the page to explore shows of it.
    """
    with written_together(), ExitStack() as stack:
        tables = {
            each: stack.enter_context(rows_written(each, folder / each.table.file_name))
            for each in RECORD_TABLES
        }
        page = stack.enter_context(whole(folder / PAGE))

        def add(record: RecordRows, content: Mapping[str, Any] | None) -> None:
            for each, rows in record.tables.items():
                tables[each](rows)
            if content is not None:
                page.write(json.dumps(content, allow_nan=False, separators=(",", ":")).encode() + b"\n")

        yield add


def page_contents(folders: Iterable[Path], records: Iterable[str]) -> list[dict[str, Any]]:
    """Return what the page to explore shows of `records`, in their order, from the `folders` of all jobs."""
    lines = (line for folder in folders for line in (folder / PAGE).read_bytes().splitlines())
    contents = {content["id"]: content for content in map(json.loads, lines)}
    return [contents[record] for record in records if record in contents]


def table_lines(row_class: type[Row], folders: Iterable[Path], records: Iterable[str]) -> Iterator[bytes]:
    """Yield a table of `records` in their order, head first, from the parts in `folders`, which keep that order."""
    place = {record: number for number, record in enumerate(records)}

    def placed(path: Path) -> Iterator[tuple[int, str]]:
        with readable(path) as stream:
            check_columns(row_class.table, next(csv.reader(stream), []), path)
            for line in stream:  # a row is one line, and begins with the identifier
                if (record := line.partition(",")[0]) in place:
                    yield place[record], line

    yield from (line.encode() for line in csv_lines(row_class, ()))
    parts = (placed(folder / row_class.table.file_name) for folder in folders)
    yield from (line.encode() for _, line in heapq.merge(*parts, key=itemgetter(0)))


def remove_copies(folder: Path) -> None:
    """Remove the tables of one record from its folder: copies of a run before, or tables of an earlier version."""
    if folder.is_dir():
        for each in RECORD_TABLES:
            (folder / each.table.file_name).unlink(missing_ok=True)


def parts_in(results: Path) -> list[Path]:
    """Return the folders of the jobs that stand in the results."""
    return sorted(each for each in part(results, "").glob("*") if _JOB.fullmatch(each.name))


def remove_other_parts(results: Path, jobs: Collection[str]) -> None:
    """Remove what is left of jobs that records were shared out to before, whose rows would stand twice."""
    for folder in parts_in(results):
        if folder.name not in jobs:
            shutil.rmtree(folder)


class Results:
    """The folder of a study's results: each table is an attribute, read when it is asked for.

    >>> results = rocking.open_results("results")  # doctest: +SKIP
    >>> results.comparison.groupby("structure")["within_factor_two"].mean()  # doctest: +SKIP

    A table that the summary does not hold, as `responses`, is gathered from those of the jobs, sorted by record.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def table(self, name: str, columns: Iterable[str] | None = None) -> "DataFrame":
        """Return the table `name`, or only some of its columns. Raises RockingError where there is none."""
        import pandas as pd  # which takes half a second to import

        if name not in _TABLES:
            raise RockingError(f"table is {name!r}, but must be one of {', '.join(_TABLES)}.")
        row_class = _TABLES[name]
        file = row_class.table.file_name
        names = list(row_class.table.column_names if columns is None else columns)
        if (summary := self.folder / "summary" / file).exists():
            return frame(row_class, summary, names)
        parts = [path for part in parts_in(self.folder) if (path := part / file).exists()]
        paths = parts or sorted(self.folder.glob(f"*/{file}"))  # of records that were assessed one by one
        if not paths:
            raise RockingError(f"{self.folder} holds no {file}; name the folder of a study's results.")
        table = pd.concat([frame(row_class, path, ["record", *names]) for path in paths])
        return table.sort_values("record", kind="stable", ignore_index=True)[names]

    def write_record(self, record: str, folder: Path | str | None = None) -> list[Path]:
        """Write the tables of one record as CSV into `folder`, else beside its report, and return their paths.

        A copy as the tables are now: the next run that assesses the record removes it from there. Raises RockingError
        where there is no such record.
        """
        target = self.folder / record if folder is None else Path(folder)
        parts = parts_in(self.folder)
        tables = {each: list(table_lines(each, parts, [record])) for each in RECORD_TABLES}
        if len(tables[TimingRow]) == 1:  # which every record has, also one that could not be read
            raise RockingError(
                f"{self.folder} holds no tables of {record!r}; name a record of a study that has been run."
            )
        with written_together():
            for each, lines in tables.items():
                write_whole(target / each.table.file_name, lines)
        return [target / each.table.file_name for each in RECORD_TABLES]

    def __getattr__(self, name: str) -> "DataFrame":
        if name not in _TABLES:
            raise AttributeError(f"Results has no table {name!r}; there are {', '.join(_TABLES)}.")
        return self.table(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_TABLES]

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r}): {', '.join(_TABLES)}"


def open_results(folder: Path | str) -> Results:
    """Return the tables of the results of a study in `folder`. Raises RockingError where there is no such folder.

    >>> try:
    ...     rocking.open_results("nowhere")
    ... except rocking.RockingError as error:
    ...     print(error)
    nowhere is no folder; name the folder of a study's results.
    """
    path = Path(folder)
    if not path.is_dir():
        raise RockingError(f"{path} is no folder; name the folder of a study's results.")
    return Results(path)
