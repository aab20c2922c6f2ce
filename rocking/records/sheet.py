"""Sheet: a workbook of a spreadsheet as the text of a table, where its columns say what they hold."""

from collections.abc import Iterator, Sequence
from typing import Any

from rocking.errors import RecordError
from rocking.records.formats.labels import ColumnLabel, with_units
from rocking.tables.sheets import csv_text, sheets

_HEADS = 30
"""Rows in which the names of the columns are looked for."""
_FEWEST = 8
"""Rows of numbers from which on a sheet holds a series."""
_ADVICE = "save the sheet as CSV, with the names of the columns and their units above the numbers"


def table_of_workbook(raw: bytes) -> bytes:
    """Return the text of the one sheet of a workbook that holds times and accelerations with their units.

    Raises RecordError where none does, or several do, and for a workbook that is damaged or unpacks to too much.
    """
    with sheets(raw, RecordError, _ADVICE) as rows_of:
        tables = {title: _table(rows) for title, rows in rows_of.items()}
    named = {title: table for title, table in tables.items() if table}
    if len(named) != 1:
        what = f"the sheets {', '.join(named)} hold" if named else "no sheet of the workbook holds"
        raise RecordError(
            f"{what} times and accelerations with their units in names above them; {_ADVICE}.",
            sheets=tuple(named),
        )
    return next(iter(named.values()))


def _table(rows: Iterator[Sequence[Any]]) -> bytes:
    """Return the text of a sheet from the names of its columns on, empty where they name no times or no unit."""
    over: list[str] = []
    above: list[str] = []
    text: list[str] = []
    for _, row in zip(range(_HEADS), rows, strict=False):
        if above and any(isinstance(cell, int | float) and not isinstance(cell, bool) for cell in row):
            names = list(with_units(over, above) if over else ()) or above
            labels = [ColumnLabel(name) for name in names if name]
            if any(label.is_time for label in labels) and any(label.unit for label in labels):
                first = next(place for place, name in enumerate(names) if name)
                end = next((place for place in range(first, len(names)) if not names[place]), len(names))
                places = list(range(first, end))  # what follows an empty column is another table
                numbers = _written(names, places, [row, *rows])
                if names is above:
                    text.append(" ".join(filter(None, over)))
                return "".join(f"# {line}\n" for line in text if line).encode() + numbers if numbers else b""
            return b""
        text.append(" ".join(filter(None, over)))
        over, above = above, ["" if cell is None else str(cell).strip() for cell in row]
    return b""


def _written(names: list[str], places: list[int], rows: list[Sequence[Any]]) -> bytes:
    heads = [names[place].replace(",", " ") for place in places]
    every = ([row[place] if place < len(row) else None for place in places] for row in rows)
    filled = [cells for cells in every if any(cell is not None for cell in cells)]
    return csv_text([heads, *filled]).encode() if len(filled) >= _FEWEST else b""
