"""Sheet: a workbook of a spreadsheet as the text of a table, where its columns say what they hold."""

import csv
import io
import zipfile
from collections.abc import Iterator
from typing import Any

from rocking.errors import RecordError
from rocking.records.formats.labels import ColumnLabel

_PARTS = "xl/workbook.xml"
_LARGEST_PART = 64 * 2**20
"""Bytes of a part of a workbook, unpacked."""
_HEADS = 30
"""Rows in which the names of the columns are looked for."""
_FEWEST = 8
"""Rows of numbers from which on a sheet holds a series."""
_ADVICE = "save the sheet as CSV, with the names of the columns and their units above the numbers"


def is_workbook(raw: bytes) -> bool:
    """Whether `raw`, a zip file, is a workbook as spreadsheets have written it since 2007 (.xlsx)."""
    try:
        return _PARTS in zipfile.ZipFile(io.BytesIO(raw)).namelist()
    except (zipfile.BadZipFile, ValueError, NotImplementedError):
        return False


def table_of_workbook(raw: bytes) -> bytes:
    """Return the text of the one sheet of a workbook that holds times and accelerations with their units.

    Raises RecordError where none does, or several do, and for a workbook that is damaged or unpacks to too much.
    """
    from openpyxl import load_workbook  # which a workbook alone needs

    try:
        parts = zipfile.ZipFile(io.BytesIO(raw)).infolist()
        if max(part.file_size for part in parts) > _LARGEST_PART:
            raise RecordError.naming(
                "size",
                _LARGEST_PART,
                f"a part of the workbook unpacks to more than {_LARGEST_PART} bytes; {_ADVICE}.",
            )
        book = load_workbook(io.BytesIO(raw), read_only=True, data_only=True)
        tables = {sheet.title: _table(sheet.iter_rows(values_only=True)) for sheet in book.worksheets}
    except RecordError:
        raise
    except Exception as error:  # zipfile and openpyxl raise what they like for what is damaged
        raise RecordError.naming(
            "format", "workbook", f"the workbook cannot be read, {type(error).__name__}; {_ADVICE}."
        ) from error
    named = {title: table for title, table in tables.items() if table}
    if len(named) != 1:
        what = f"the sheets {', '.join(named)} hold" if named else "no sheet of the workbook holds"
        raise RecordError.naming(
            "sheets",
            tuple(named),
            f"{what} times and accelerations with their units in names above them; {_ADVICE}.",
        )
    return next(iter(named.values()))


def _table(rows: Iterator[tuple[Any, ...]]) -> bytes:
    """Return the text of a sheet from the names of its columns on, empty where they name no times or no unit."""
    over: tuple[Any, ...] = ()
    above: tuple[Any, ...] = ()
    for _, row in zip(range(_HEADS), rows, strict=False):
        if above and any(isinstance(cell, int | float) and not isinstance(cell, bool) for cell in row):
            names = _with_units(over, above)
            labels = [ColumnLabel(name) for name in names if name]
            if any(label.is_time for label in labels) and any(label.unit for label in labels):
                first = next(place for place, name in enumerate(names) if name)
                beside = next((place for place in range(first, len(names)) if not names[place]), len(names))
                places = list(range(first, beside))  # what stands behind an empty column is another table
                return _written(names, places, [row, *rows])
            return b""
        over, above = above, row
    return b""


def _with_units(over: tuple[Any, ...], above: tuple[Any, ...]) -> list[str]:
    """Return the names of columns in the row `above` the numbers, or in the one `over` it where that holds units."""
    names = [str(cell or "").strip() for cell in above]
    units = [ColumnLabel(f"({name.strip('()[]')})") if name else None for name in names]
    are_units = all(unit is None or unit.unit or unit.is_time or unit.other for unit in units)
    if not (over and are_units and any(unit and unit.unit for unit in units)):
        return names
    heads = [str(cell or "").strip() for cell in over]
    return [
        f"{head} ({name.strip('()[]')})" if head and name else head
        for head, name in zip(heads, names, strict=False)
    ]


def _written(names: list[str], places: list[int], rows: list[tuple[Any, ...]]) -> bytes:
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow([names[place].replace(",", " ") for place in places])
    every = ([row[place] if place < len(row) else None for place in places] for row in rows)
    kept = [
        ["" if cell is None else cell for cell in cells]
        for cells in every
        if any(c is not None for c in cells)
    ]
    writer.writerows(kept)
    return text.getvalue().encode() if len(kept) >= _FEWEST else b""
