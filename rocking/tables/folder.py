"""Tables in a folder, each in the file that its class names."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from rocking.tables.csv_rows import read_rows, write_rows
from rocking.tables.files import write_whole
from rocking.tables.package import data_package
from rocking.tables.row import R, Row


def write_tables(
    tables: Mapping[type[Row], Iterable[Row]],
    folder: Path,
    package: str = "",
    description: str = "datapackage.json",
) -> None:
    """Write rows by their class into `folder`; with the name of a `package` also the file that describes the tables."""
    for kind, rows in tables.items():
        write_rows(kind, rows, folder / kind.table.file_name)
    if package:
        described = {kind.table.name: (kind.table, kind.table.file_name) for kind in tables}
        write_whole(folder / description, data_package(package, described))


def read_table(row_class: type[R], folder: Path) -> list[R]:
    """Return the rows of a table that lies in `folder`. Raises RockingError as `read_rows` does."""
    return list(read_rows(row_class, folder / row_class.table.file_name))
