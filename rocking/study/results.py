"""The results of a study: the tables in its folder, read back."""

from collections.abc import Iterable
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES
from rocking.errors import RockingError
from rocking.study.product import Product
from rocking.study.products import PRODUCTS
from rocking.tables import Row, frame

if TYPE_CHECKING:
    from pandas import DataFrame


_OWN = {row_class.table.name: row_class for row_class in (*RECORD_TABLES, *SUMMARY_TABLES)}
_OF_PRODUCTS = {table: product for product in PRODUCTS for table in product.tables}


def _names() -> list[str]:
    """The names of the tables that are read back."""
    return [*_OWN, *_OF_PRODUCTS]


def rows_of_table(product: Product, name: str) -> type[Row]:
    """Return the rows of a table of a product over all records, whose module is imported for it."""
    classes: list[Any] = list(vars(import_module(product.rows)).values())
    found: type[Row] = next(
        found for found in classes if getattr(getattr(found, "table", None), "name", "") == name
    )
    return found


class Results:
    """The folder of a study's results: each table is an attribute, read from its CSV when it is asked for.

    Parameters
    ----------
    folder : Path
        Folder of the results of a study.

    Examples
    --------
    >>> results = rocking.open_results("results")  # doctest: +SKIP
    >>> results.comparison.groupby("structure")["within_factor_two"].mean()  # doctest: +SKIP
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def table(self, name: str, columns: Iterable[str] | None = None) -> "DataFrame":
        """Return the table `name`, or only some of its columns. Raises RockingError where there is none."""
        import pandas as pd  # which takes half a second to import

        if name not in _names():
            raise RockingError(f"table is {name!r}, but must be one of {', '.join(_names())}.", table=name)
        product = _OF_PRODUCTS.get(name)
        row_class = rows_of_table(product, name) if product else _OWN[name]
        file = row_class.table.file_name
        names = list(row_class.table.column_names if columns is None else columns)
        if (whole := self.folder / (product.folder if product else "summary") / file).exists():
            return frame(row_class, whole, names)
        paths = sorted(self.folder.glob(f"*/{file}"))  # of records that were assessed one by one
        if not paths:
            raise RockingError(
                f"{self.folder} holds no {file}; name the folder of a study's results.", file=file
            )
        table = pd.concat([frame(row_class, path, ["record", *names]) for path in paths])
        return table.sort_values("record", kind="stable", ignore_index=True)[names]

    def __getattr__(self, name: str) -> "DataFrame":
        if name not in _names():
            raise AttributeError(f"Results has no table {name!r}; there are {', '.join(_names())}.")
        return self.table(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *_names()]

    def __repr__(self) -> str:
        return f"Results({str(self.folder)!r}): {', '.join(_names())}"


def open_results(folder: Path | str) -> Results:
    """Return the tables of the results of a study in `folder`.

    Parameters
    ----------
    folder : Path or str
        Folder of the results of a study.

    Returns
    -------
    Results
        The tables, each read when it is asked for.

    Raises
    ------
    RockingError
        Where it holds no results.

    Examples
    --------
    >>> try:
    ...     rocking.open_results("nowhere")
    ... except rocking.RockingError as error:
    ...     print(error)
    nowhere is no folder; name the folder of a study's results.
    """
    path = Path(folder)
    if not path.is_dir():
        raise RockingError(f"{path} is no folder; name the folder of a study's results.", folder=path)
    if not _holds_results(path):
        inner = path / "results"
        hint = f"name {inner}" if _holds_results(inner) else "name the folder of a study's results"
        raise RockingError(
            f"{path} holds no results, neither a summary nor tables of a record; {hint}.", folder=path
        )
    return Results(path)


def _holds_results(folder: Path) -> bool:
    """Whether a folder has a summary, or below it the tables of records that were assessed one by one."""
    names = {table.table.file_name for table in RECORD_TABLES}
    return (folder / "summary").is_dir() or any(path.name in names for path in folder.glob("*/*.csv"))
