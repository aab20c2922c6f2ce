"""What a job writes for those over all records: rows of tables and more, as JSON, which holds every digit."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

from rocking.assessment.store import LARGEST, decoder, encoded
from rocking.errors import RockingError
from rocking.tables import Row, read_whole, write_whole

Rows = Mapping[type[Row], Sequence[Row]]
"""The rows of tables by their class."""


@dataclass(frozen=True)
class Kept:
    """What a record, the summary or a product over all records leaves for what is made of it.

    conclusion: the sentence that a product comes down to, on page one of the summary, on the page to explore and at the
    end of a run; "" for none. lines: what the terminal shows after the job; opened: the files that are read first, from
    the folder of the results. Of a record, page: what the page to explore shows; spectra: of the components, m/s²,
    where there is a design level; both are empty without reports. sums: the sha256 of its report and its tables, by
    their paths from the folder of the results.
    """

    rows: Rows
    conclusion: str = ""
    lines: Sequence[str] = ()
    opened: Sequence[str] = ()
    page: dict[str, Any] = field(default_factory=dict)
    spectra: Mapping[str, Sequence[float]] = field(default_factory=dict)
    sums: Mapping[str, str] = field(default_factory=dict)


def keep(path: Path, kept: Kept) -> None:
    """Write what a job leaves as the file `path`."""
    rows = {}
    for row_class, of_it in kept.rows.items():
        names = _carried(row_class)
        rows[row_class.table.name] = [[encoded(getattr(row, name)) for name in names] for row in of_it]
    write_whole(path, json.dumps(vars(kept) | {"rows": rows}, separators=(",", ":")).encode())


def kept_in(path: Path, tables: Iterable[type[Row]]) -> Kept:
    """Return what a job left, with the rows of `tables`. Raises RockingError for what this version does not write."""
    with undamaged(path):
        content = json.loads(read_whole(path, LARGEST, RockingError))
        rows: dict[type[Row], list[Row]] = {}
        for row_class in tables:
            kept: Any = row_class
            columns = _columns_of(kept)
            rows[row_class] = [
                row_class(**{name: of(cell) for (name, of), cell in zip(columns, cells, strict=True)})
                for cells in content["rows"][row_class.table.name]
            ]
        return Kept(**content | {"rows": rows})


@contextmanager
def undamaged(path: Path) -> Iterator[None]:
    """Raise RockingError, which names the file, for what only a damaged one gives."""
    try:
        yield
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise RockingError(
            f"{path}: it is damaged ({error}); remove it and run the study again.", path=path
        ) from None


@cache
def _columns_of(row_class: Any) -> list[tuple[str, Callable[[Any], Any]]]:
    """The name of each field of a row, and what makes its value of what was written."""
    hints = get_type_hints(row_class)
    return [(name, decoder(hints[name])) for name in _carried(row_class)]


def _carried(row_class: type[Row]) -> tuple[str, ...]:
    """The names of what a row carries: its columns, and what it holds besides."""
    return *row_class.table.column_names, *row_class.table.kept
