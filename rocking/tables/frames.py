"""Tables as pandas data frames."""

import csv
import math
from collections.abc import Iterable, Iterator
from enum import Enum, StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.described import Described
from rocking.tables.csv_rows import check_columns, read_rows, readable
from rocking.tables.row import R, Row, unguarded

if TYPE_CHECKING:
    from pandas import DataFrame


def frame(
    row_class: type[Row], source: Path | str | Iterable[Row], columns: Iterable[str] | None = None
) -> "DataFrame":
    """Return a table as a pandas DataFrame, from its CSV file or from rows; `columns`: only these.

    Numbers are float64 (INF is inf, an empty cell nan), int64, or Int64 where a count may be missing; truths are
    boolean, choices categories, texts str. Raises RockingError like `read_rows`.
    """
    import pandas as pd  # here, because half the commands make no data frame and it takes half a second to import

    table = row_class.table
    kept = [each for each in table.columns if columns is None or each.name in set(columns)]
    if not isinstance(source, Path | str):
        rows = list(source)
        values = {each.name: [_plain(getattr(one, each.name)) for one in rows] for each in kept}
        return pd.DataFrame({each.name: pd.Series(values[each.name], dtype=_dtype(each)) for each in kept})
    path = Path(source)
    with readable(path) as stream:
        check_columns(table, next(csv.reader(stream), []), path)
    texts = [each for each in kept if each.holds is str or each.holds is tuple]
    chosen = [each for each in kept if issubclass(each.holds, StrEnum)]
    try:
        made = pd.read_csv(
            path,
            usecols=[each.name for each in kept],
            dtype={each.name: "category" if each in chosen else _dtype(each) for each in kept},
            keep_default_na=False,
            na_values={each.name: ["", "nan"] for each in kept if each not in texts},
        )
        for each in chosen:
            made[each.name] = _checked(made[each.name], each)
    except ValueError:
        for _ in read_rows(row_class, path):  # says where
            pass
        raise
    for each in texts:
        made[each.name] = made[each.name].map(unguarded)
    return made


def _dtype(each: Described) -> Any:
    import pandas as pd

    if issubclass(each.holds, StrEnum):
        return pd.CategoricalDtype([one.value for one in each.holds])
    known = {float: "float64", bool: "boolean", int: "Int64" if each.optional else "int64"}
    return known.get(each.holds, "str")


def _checked(found: Any, each: Described) -> Any:
    unknown = set(found.cat.categories) - set(each.holds)
    if unknown or (found.isna().any() and not each.optional):
        raise ValueError(each.name)
    return found.cat.set_categories([one.value for one in each.holds])


def _plain(value: object) -> object:
    if isinstance(value, Enum):
        return value.value
    return "; ".join(value) if isinstance(value, tuple) else value


def rows_of(row_class: type[R], table: "DataFrame") -> Iterator[R]:
    """Yield the rows of a whole data frame that `frame` gave as objects again."""
    columns = row_class.table.columns
    for found in table.astype(object).where(table.notna(), None).itertuples(index=False):
        yield row_class(**{each.name: _restored(each, getattr(found, each.name)) for each in columns})


def _restored(each: Described, value: Any) -> Any:
    if value is None or value != value:
        return None if each.optional else math.nan if each.holds is float else ""
    if each.holds is tuple:
        return tuple(value.split("; ")) if value else ()
    return each.holds(value)
