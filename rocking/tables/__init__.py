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

from rocking.tables.cells import cell
from rocking.tables.csv_rows import csv_lines, head, read_rows, rows_written, write_rows
from rocking.tables.files import write_whole, written_together
from rocking.tables.folder import read_table, write_tables
from rocking.tables.frames import frame, rows_of
from rocking.tables.package import data_package
from rocking.tables.row import Column, R, Row, Table, column, row

__all__ = [
    "Column",
    "R",
    "Row",
    "Table",
    "cell",
    "column",
    "csv_lines",
    "data_package",
    "frame",
    "head",
    "read_rows",
    "read_table",
    "row",
    "rows_of",
    "rows_written",
    "write_rows",
    "write_tables",
    "write_whole",
    "written_together",
]
