"""What is kept of the rows of tables for other products and for the next run: as JSON, which holds every digit."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from functools import cache
from pathlib import Path
from typing import Any, get_type_hints

from rocking.assessment.store import decoder, encoded
from rocking.errors import RockingError
from rocking.tables import Row, read_whole, regular_file, write_whole

LARGEST = 200_000_000
"""Bytes of what is kept of a product that are read; of a record under ten structures some hundred thousand."""

Rows = Mapping[type[Row], Sequence[Row]]
"""The rows of tables by their class."""


def keep_rows(path: Path, rows: Rows, conclusion: str = "") -> None:
    """Keep the rows of a product over all records, and the sentence that it comes down to."""
    lines = (json.dumps(key, separators=(",", ":")).encode() for key in (conclusion, encoded_rows(rows)))
    write_whole(path, b"\n".join(lines))


def kept_rows(path: Path, tables: Iterable[type[Row]]) -> dict[type[Row], list[Row]]:
    """Return the rows of some tables of a product. Raises RockingError where they are not what this version writes."""
    with undamaged(path):
        _, rows = read_whole(path, LARGEST, RockingError).split(b"\n", 1)
        return decoded_rows(json.loads(rows), tables)


def kept_conclusion(path: Path) -> str:
    """Return the sentence that a product comes down to. Raises RockingError where this version has not written it."""
    with undamaged(path), regular_file(path) as stream:
        return str(json.loads(stream.readline(LARGEST)))


@contextmanager
def undamaged(path: Path) -> Iterator[None]:
    """Raise RockingError, which names the file, for what only a damaged one gives."""
    try:
        yield
    except (ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
        raise RockingError(
            f"{path}: it is damaged ({error}); remove it and run the study again.", path=path
        ) from None


def encoded_rows(rows: Rows) -> dict[str, list[list[Any]]]:
    """Return what JSON can hold of the rows of tables: by the name of the table what each row carries."""
    content = {}
    for row_class, of_it in rows.items():
        names = _carried(row_class)
        content[row_class.table.name] = [[encoded(getattr(row, name)) for name in names] for row in of_it]
    return content


def decoded_rows(
    content: Mapping[str, list[list[Any]]], tables: Iterable[type[Row]]
) -> dict[type[Row], list[Row]]:
    """Return the rows of `tables` that `encoded_rows` gave. Raises ValueError, KeyError or TypeError for others."""
    rows: dict[type[Row], list[Row]] = {}
    for row_class in tables:
        kept: Any = row_class
        columns = _columns_of(kept)
        rows[row_class] = [
            row_class(**{name: of(cell) for (name, of), cell in zip(columns, cells, strict=True)})
            for cells in content[row_class.table.name]
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
