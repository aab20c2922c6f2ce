"""Tables as one workbook of a spreadsheet (XLSX): a sheet a table, typed cells, and units in the heads."""

import math
from collections.abc import Iterable, Mapping, Sequence
from datetime import datetime
from io import BytesIO
from pathlib import Path
from typing import Any

from xlsxwriter import Workbook

from rocking.described import Described
from rocking.quantities import escaped
from rocking.tables.files import regular_file
from rocking.tables.rows import Row, values_of

MOST_ROWS = 1_048_575
"""Rows below the head of a sheet; the format holds no more."""
_LONGEST_TEXT = 32_767
"""Characters of a cell; the format holds no more."""
_WIDEST = 40
_ABOUT = (("Sheet", 20), ("Column", 40), ("Column of the CSV", 40), ("Unit", 10), ("Meaning", 100))
_MADE = datetime(2000, 1, 1)
"""Stands in the file as its date, so that two runs of a study give the same bytes."""


def workbook(
    tables: Mapping[type[Row], Path | Sequence[Row]], title: str = "", opens_on: type[Row] | None = None
) -> bytes:
    """Return a workbook of `tables`, one sheet each, behind a sheet that says what every column means.

    A table is its rows, or the CSV file that holds them, which is read row by row.
    A number is a number, a truth a truth, overturning (inf) the text INF, and what is missing an empty cell. A table of
    more rows than a sheet holds is left out, and the first sheet says so. opens_on: the table that is shown first; None
    for the sheet of the columns.
    """
    content = BytesIO()
    book = Workbook(
        content, {"constant_memory": True, "strings_to_formulas": False, "strings_to_urls": False}
    )
    book.set_properties({"title": escaped(title), "created": _MADE})
    bold = book.add_format({"bold": True, "bottom": 1})
    about = book.add_worksheet("columns")
    for place, (head, width) in enumerate(_ABOUT):
        about.write_string(0, place, head, bold)
        about.set_column(place, place, width)
    about.freeze_panes(1, 0)
    line = 1
    for kind, source in tables.items():
        count = _count(source)
        if count > MOST_ROWS:
            file = kind.table.file_name
            about.write_string(line, 0, f"{kind.table.name} has more rows than a sheet holds; read {file}.")
            line += 1
            continue
        sheet = _add_sheet(book, bold, kind, values_of(kind, source), count)
        if kind is opens_on:
            sheet.activate()
        for column in kind.table.columns:
            for place, text in enumerate(
                (kind.table.name, _head(column), column.name, column.unit, column.meaning)
            ):
                about.write_string(line, place, text)
            line += 1
    book.close()
    return content.getvalue()


def _head(column: Described) -> str:
    """The head of a column, with its unit: "largest_rotation [rad]"."""
    return f"{column.attribute} [{column.unit}]" if column.unit else column.attribute


def _count(source: Path | Sequence[Row]) -> int:
    """The number of rows of a table; in a CSV file of this package each has one line."""
    if not isinstance(source, Path):
        return len(source)
    with regular_file(source) as lines:
        return sum(1 for _ in lines) - 1


def _add_sheet(book: Any, bold: Any, kind: type[Row], rows: Iterable[Sequence[object]], count: int) -> Any:
    columns = kind.table.columns
    sheet = book.add_worksheet(kind.table.name[:31])
    for place, column in enumerate(columns):
        head = _head(column)
        sheet.write_string(0, place, head, bold)
        sheet.set_column(place, place, min(len(head) + 2, _WIDEST))
    sheet.freeze_panes(1, 1)
    for number, values in enumerate(rows, start=1):
        _write_row(sheet, number, values)
    sheet.autofilter(0, 0, count, len(columns) - 1)
    return sheet


def _write_row(sheet: Any, number: int, values: Iterable[object]) -> None:
    for place, value in enumerate(values):
        if isinstance(value, bool):
            sheet.write_boolean(number, place, value)
        elif isinstance(value, int | float):
            if math.isinf(value):
                sheet.write_string(number, place, "INF" if value > 0 else "-INF")
            elif not math.isnan(value):
                sheet.write_number(number, place, value)
        elif text := _text(value):
            sheet.write_string(number, place, escaped(text)[:_LONGEST_TEXT])


def _text(value: object) -> str:
    if isinstance(value, tuple | list):
        return "; ".join(map(str, value))
    return "" if value is None else str(value)
