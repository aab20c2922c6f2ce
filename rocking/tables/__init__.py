"""Result tables: a row is a frozen dataclass whose fields say what its columns are; all else derives from it.

    @row("blocks", "One row per equivalent block")
    class BlockRow(Row):
        restitution: float = column("Ratio of angular velocities", equation="Eq. 2")

    BlockRow(restitution=block.restitution)

A field is a float (nan: not known), int, bool, str, StrEnum, one of these or None, or a tuple of texts. From the class
come the CSV (`write_rows`, `read_rows`), its description (`data_package`) and data frames (`frame`). The unit of a
column stands at the end of its name. A text from a file cannot become a formula of a spreadsheet nor a second line: one
that begins like a formula is written behind an apostrophe, control characters and backslashes are escaped, and reading
takes both back.
"""

from rocking.tables.edited import edited_text as edited_text
from rocking.tables.edited import read_edited as read_edited
from rocking.tables.files import Document as Document
from rocking.tables.files import check_target as check_target
from rocking.tables.files import read_start as read_start
from rocking.tables.files import read_whole as read_whole
from rocking.tables.files import whole as whole
from rocking.tables.files import write_whole as write_whole
from rocking.tables.files import written_together as written_together
from rocking.tables.rows import Row as Row
from rocking.tables.rows import cell as cell
from rocking.tables.rows import check_tables as check_tables
from rocking.tables.rows import column as column
from rocking.tables.rows import csv_lines as csv_lines
from rocking.tables.rows import data_package as data_package
from rocking.tables.rows import document_of as document_of
from rocking.tables.rows import frame as frame
from rocking.tables.rows import read_rows as read_rows
from rocking.tables.rows import read_table as read_table
from rocking.tables.rows import row as row
from rocking.tables.rows import rows_of as rows_of
from rocking.tables.rows import rows_written as rows_written
from rocking.tables.rows import write_rows as write_rows
from rocking.tables.rows import write_tables as write_tables
