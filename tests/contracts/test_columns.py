"""A column reads what it is named after, so that no two of one type can be exchanged unnoticed.

mypy holds a column to the type and the subject of what it reads; what it cannot tell apart are two columns of one type.
"""

import re
from dataclasses import dataclass
from importlib import import_module
from itertools import combinations
from types import CodeType

import pytest

from rocking.assessment import rows as of_assessment
from rocking.assessment import variants as of_variants
from rocking.described import Described
from rocking.study import strengthening as of_strengthening
from rocking.study.products import PRODUCTS
from rocking.tables import Columns, Row, RowOf, row

OF_PRODUCTS = [import_module(each.rows) for each in PRODUCTS]
MODULES = of_assessment, of_variants, *OF_PRODUCTS, of_strengthening
"""All that declare rows, imported so that these are known; reports, which declare none, are slow to import."""
UNITS = r"_(rad_s|m_s2|m2_s3|m_s|rad|hz|deg|s|m)$"


def row_classes(base: type[Row] = RowOf) -> list[type[Row]]:
    """All rows of a table that read a subject."""
    own = [each for each in base.__subclasses__() if each.__dict__.get("table") and each.table.name]
    return [*own, *(each for kind in base.__subclasses__() for each in row_classes(kind))]


CLASSES = {each.table.name: each for each in row_classes() if each.__module__.startswith("rocking.")}


def words(name: str) -> set[str]:
    """The words of a name without its unit, in the singular."""
    each = re.split(r"[_\W]+", re.sub(UNITS, "", name).lower())
    return {word.removesuffix("s") if len(word) > 3 else word for word in each} - {""}


def words_read(column: Described) -> set[str]:
    """The words of all attributes, functions and texts that the sources of a column name, its part and what of it."""
    found: set[str] = set()
    codes = [read.__code__ for read in column.more["reads"]]
    while codes:
        code = codes.pop()
        named = [*code.co_names, *(each for each in code.co_consts if isinstance(each, str))]
        found = found.union(*map(words, named))
        codes += [each for each in code.co_consts if isinstance(each, CodeType)]
    for cell in (cell for read in column.more["reads"] for cell in read.__closure__ or ()):
        found |= words(str(cell.cell_contents))
    return found


def exchangeable(kind: type[Row]) -> list[tuple[str, str]]:
    """Pairs of columns of one type that would fit each other's sources as well as their own."""
    named = {each.name: words(each.name) for each in kind.table.columns}
    read = {each.name: words_read(each) for each in kind.table.columns}

    def fit(column: str, source: str) -> int:
        return len(named[column] & read[source])

    return [
        (one.name, other.name)
        for one, other in combinations(kind.table.columns, 2)
        if one.kind == other.kind
        and fit(one.name, one.name) + fit(other.name, other.name)
        <= fit(one.name, other.name) + fit(other.name, one.name)
    ]


def unlike(kind: type[Row]) -> list[str]:
    """Columns that share no word with what they read."""
    return [each.name for each in kind.table.columns if not words(each.name) & words_read(each)]


@pytest.mark.parametrize("name", CLASSES)
def test_no_two_columns_of_one_type_can_be_exchanged(name: str) -> None:
    assert exchangeable(CLASSES[name]) == []


@pytest.mark.parametrize("name", CLASSES)
def test_every_column_shares_a_word_with_what_it_reads(name: str) -> None:
    assert unlike(CLASSES[name]) == []


@dataclass(frozen=True)
class Curve:
    """A subject of the test."""

    median: float
    median_low: float


of_curve = Columns(Curve)


@row("right")
class Right(RowOf[Curve]):
    """Each column reads what it is named after."""

    median: float = of_curve("Median", lambda of: of.median)
    median_low: float = of_curve("Its lower end", lambda of: of.median_low)


@row("exchanged")
class Exchanged(RowOf[Curve]):
    """The sources of the two are exchanged."""

    median: float = of_curve("Median", lambda of: of.median_low)
    median_low: float = of_curve("Its lower end", lambda of: of.median)


@row("foreign")
class Foreign(RowOf[Curve]):
    """One reads what has another name altogether."""

    dispersion: float = of_curve("Scatter", lambda of: of.median)


def test_an_exchange_is_found() -> None:
    assert exchangeable(Right) == unlike(Right) == unlike(Exchanged) == []
    assert exchangeable(Exchanged) == [("median", "median_low")]
    assert unlike(Foreign) == ["dispersion"]
    assert len(CLASSES) >= 19, "the rows of every table are asked"
