"""The results of a study as pandas data frames."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

from rocking.assessment.rows.of_folder import PER_RECORD
from rocking.assessment.rows.of_study import SUMMARY_TABLES
from rocking.assessment.rows.of_trade import TradeRow
from rocking.errors import RockingError
from rocking.study.parts import copy_tables, parts_in
from rocking.tables import Row, frame

if TYPE_CHECKING:
    from pandas import DataFrame

_ROWS: tuple[type[Row], ...] = (*PER_RECORD, *SUMMARY_TABLES, TradeRow)
_TABLES = {each.table.name: each for each in _ROWS}


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
        import pandas as pd

        if name not in _TABLES:
            raise RockingError(f"table is {name!r}, but must be one of {', '.join(_TABLES)}.")
        row_class = _TABLES[name]
        file = row_class.table.file_name
        kept = list(row_class.table.column_names if columns is None else columns)
        if (self.folder / "summary" / file).exists():
            return frame(row_class, self.folder / "summary" / file, kept)
        own = sorted(self.folder.glob(f"*/{file}"))  # of records that were assessed one by one
        paths = [path for part in parts_in(self.folder) if (path := part / file).exists()] or own
        if not paths:
            raise RockingError(f"{self.folder} holds no {file}; name the folder of a study's results.")
        found = pd.concat([frame(row_class, path, ["record", *kept]) for path in paths])
        return found.sort_values("record", kind="stable", ignore_index=True)[kept]

    def write_record(self, record: str, folder: Path | str | None = None) -> list[Path]:
        """Write the tables of one record as CSV into `folder`, else beside its report, and return their paths.

        A copy as the tables are now: the next run that assesses the record removes it from there. Raises RockingError
        where there is no such record.
        """
        return copy_tables(self.folder, record, self.folder / record if folder is None else Path(folder))

    def __getattr__(self, name: str) -> "DataFrame":
        if name not in _TABLES:
            raise AttributeError(f"Results has no table {name!r}; there are {', '.join(_TABLES)}.")
        return self.table(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_TABLES]

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r}): {', '.join(_TABLES)}"


def open_results(folder: Path | str) -> Results:
    """Return the tables of the results of a study in `folder`. Raises RockingError where there is no such folder."""
    path = Path(folder)
    if not path.is_dir():
        raise RockingError(f"{path} is no folder; name the folder of a study's results.")
    return Results(path)
