"""The tables of a study in parts: each job writes the rows of its records, one record after another, into its own."""

import re
import shutil
from collections.abc import Callable, Collection, Iterable, Iterator
from contextlib import ExitStack, contextmanager
from itertools import groupby
from pathlib import Path
from typing import Any

from rocking.assessment.fate import Fate
from rocking.assessment.rows.of_folder import PER_RECORD, RecordTables
from rocking.assessment.rows.of_record import TimingRow
from rocking.errors import RockingError
from rocking.tables import Row, head, read_rows, rows_written, write_whole, written_together

IN_PARTS: tuple[type[Row], ...] = (*PER_RECORD, Fate)
"""The rows of every table of a job."""
_JOB = re.compile(r"\d{5}_of_\d{5}")


def part(results: Path, job: str) -> Path:
    """Return the folder of the tables of one job."""
    return results / "summary" / "jobs" / job


@contextmanager
def written_part(folder: Path) -> Iterator[Callable[[RecordTables], None]]:
    """Yield what adds a record to the tables in `folder`, which appear together at the end, or not at all."""
    with written_together(), ExitStack() as stack:
        tables = [
            (each, stack.enter_context(rows_written(each, folder / each.table.file_name)))
            for each in IN_PARTS
        ]

        def add(found: RecordTables) -> None:
            for each, write in tables:
                write(getattr(found, each.table.name))

        yield add


def read_part(folder: Path) -> Iterator[tuple[str, RecordTables]]:
    """Yield the identifier and the tables of each record of a job, one record at a time.

    Raises RockingError for a table that cannot be read, or whose records do not stand in the order of the others.
    """
    groups = {
        each.table.name: _grouped(read_rows(each, folder / each.table.file_name))
        for each in PER_RECORD
        if each is not TimingRow
    }
    next_group = {name: next(records, ("", [])) for name, records in groups.items()}
    for record, timings in _grouped(read_rows(TimingRow, folder / TimingRow.table.file_name)):
        found: dict[str, list[Any]] = {"timings": timings}
        for name, (whose, rows) in next_group.items():
            if whose == record:
                found[name] = rows
                next_group[name] = next(groups[name], ("", []))
        yield record, RecordTables(**found)
    for name, (whose, _) in next_group.items():
        if whose:
            raise RockingError(f"{folder / name}.csv holds {whose} out of place; make the table again.")


def _grouped(rows: Iterator[Any]) -> Iterator[tuple[str, list[Any]]]:
    for record, found in groupby(rows, key=lambda row: row.record):
        yield record, list(found)


def gathered(row_class: type[Row], folders: Iterable[Path], records: Iterable[str]) -> Iterator[bytes]:
    """Yield a table of all parts in `folders`, head first, as its lines stand there, in the order of `records`."""
    yield head(row_class)
    places: dict[str, tuple[Path, int, int]] = {}
    for folder in folders:
        path = folder / row_class.table.file_name
        places |= {record: (path, *place) for record, place in _places(row_class, path).items()}
    for path, start, end in (places[record] for record in records if record in places):
        with path.open("rb") as stream:
            stream.seek(start)
            yield stream.read(end - start)


def _places(row_class: type[Row], path: Path) -> dict[str, tuple[int, int]]:
    """Where the rows of each record begin and end, in bytes: each is one line, which begins with its identifier."""
    found: dict[str, tuple[int, int]] = {}
    try:
        with path.open("rb") as stream:
            first = stream.readline()
            if first != head(row_class):
                name = row_class.table.name
                raise RockingError(f"{path}: the columns are not those of {name}; make the table again.")
            end = len(first)
            for line in stream:
                record = line.partition(b",")[0].decode()
                found[record] = found.get(record, (end, 0))[0], end + len(line)
                end += len(line)
    except OSError as error:
        raise RockingError(f"{path} cannot be read: {error.strerror}; make the table again.") from error
    return found


def copy_tables(results: Path, record: str, target: Path) -> list[Path]:
    """Write the tables of one record of a study into `target` and return their paths.

    Raises RockingError where the results hold no such record.
    """
    folder = next((each for each in parts_in(results) if record in _places(TimingRow, each / _TIMINGS)), None)
    if folder is None:
        raise RockingError(
            f"{results} holds no tables of {record!r}; name a record of a study that has been run."
        )
    with written_together():
        for each in PER_RECORD:
            write_whole(target / each.table.file_name, gathered(each, [folder], [record]))
    return [target / each.table.file_name for each in PER_RECORD]


_TIMINGS = TimingRow.table.file_name
"""Holds every record, also those that could not be read."""


def remove_copies(folder: Path) -> None:
    """Remove the tables of one record from its folder: copies of a run before, or tables of an earlier version."""
    if folder.is_dir():
        for each in PER_RECORD:
            (folder / each.table.file_name).unlink(missing_ok=True)


def parts_in(results: Path) -> list[Path]:
    """Return the folders of the jobs that stand in the results."""
    return sorted(each for each in part(results, "").glob("*") if _JOB.fullmatch(each.name))


def remove_other_parts(results: Path, jobs: Collection[str]) -> None:
    """Remove what is left of jobs that records were shared out to before, whose rows would stand twice."""
    for folder in parts_in(results):
        if folder.name not in jobs:
            shutil.rmtree(folder)
