"""What the summary says of fragility: curves with intervals, and which records govern them."""

import math
from collections.abc import Callable, Iterator, Mapping
from typing import TYPE_CHECKING

from rocking.assessment.fragility.rows import FragilitySummaryRow
from rocking.assessment.intensity import INTENSITY_MEASURES
from rocking.reports import printing
from rocking.reports.printing import Cell, number, table_of, whole, words
from rocking.reports.style import svg
from rocking.reports.summary.fragility_figures import fragility_figure
from rocking.tables import rows_of

if TYPE_CHECKING:
    from pandas import DataFrame

ON_A_PAGE = 8
"""Structures whose curves stand on one page."""
MOST_CURVES = 40
"""Structures whose curves are drawn; fragility.csv holds all."""
_GOVERNING = 3
"""Records that are named for each structure."""
_HALF = 0.5
"""Share of the members of a case from which on its record is said to overturn the structure."""


def fragility_data(tables: Mapping[str, "DataFrame"]) -> dict[str, object]:
    """Return figures and table of the fragility, without figures where it was not measured.

    tables: as in rocking.reports.summary.report, with "fragility", "fragility_summary" and "ida" where they exist.
    """
    if "fragility" not in tables:
        return {"figures": []}
    summary = tables["fragility_summary"]
    falls = summary[summary["rotation_ratio"] == math.inf]
    names = list(falls["structure"])
    left = len(names) - MOST_CURVES
    return {
        "figures": list(_figures(tables, names[:MOST_CURVES])),
        "note": f" Another {printing.counted(left, 'structure')} in fragility.csv." if left > 0 else "",
        "table": _table(falls, tables["ida"]),
    }


def _figures(tables: Mapping[str, "DataFrame"], names: list[str]) -> Iterator[dict[str, str]]:
    pages = math.ceil(len(names) / ON_A_PAGE)
    each_page = 2 * math.ceil(len(names) / (2 * pages)) if pages else 1
    for first in range(0, len(names), each_page):
        shown = names[first : first + each_page]
        curves, summary = (
            tables[name][tables[name]["structure"].isin(shown)] for name in ("fragility", "fragility_summary")
        )
        alt = f"Fragility curves of {printing.counted(len(shown), 'structure')} with 90 % intervals."
        yield {"svg": svg(fragility_figure(curves, summary)), "alt": alt}


def _table(falls: "DataFrame", ida: "DataFrame") -> dict[str, object]:
    """One row per structure: its median and what overturns it first."""
    governing = governing_records(ida)
    columns: list[tuple[str, str, str, Callable[[FragilitySummaryRow], Cell]]] = [
        ("Structure", "1.3", "l", lambda row: row.structure),
        ("Median and its 90 % interval", "1.2", "l", _median),
        ("Disper\u00adsion [-]", "0.6", "r", _dispersion),
        ("Sta\u00adtions", "auto", "r", lambda row: whole(row.stations)),
        (
            "First to overturn it, and at what level",
            "2.2",
            "l",
            lambda row: words(governing.get(row.structure)),
        ),
        ("Stand again, scaled up", "0.6", "r", lambda row: whole(row.reversals)),
    ]
    if falls["annual_rate"].notna().any():
        columns.append(("Annual rate [1/year]", "0.7", "r", lambda row: number(row.annual_rate, 2)))
    return table_of(rows_of(FragilitySummaryRow, falls), *columns)


def _dispersion(row: FragilitySummaryRow) -> str:
    return number(row.dispersion, 2)


def _median(row: FragilitySummaryRow) -> str:
    unit = INTENSITY_MEASURES[row.intensity_measure].unit
    interval = f"{number(row.median_low, 2)}–{number(row.median_high, 2)}"
    return f"{number(row.median, 2)} ({interval}) {unit}".strip()


def governing_records(ida: "DataFrame") -> dict[str, str]:
    """Return for each structure the records that overturn it at the lowest levels, with the level of each."""
    fallen = ida[ida["overturning_share"] >= _HALF]
    first = fallen.groupby(["structure", "record"], sort=False, observed=True)["level"].min().reset_index()
    ordered = first.sort_values("level", kind="stable")
    return {
        str(structure): ", ".join(
            f"{record} ({number(level, 2)})"
            for record, level in zip(of_it["record"], of_it["level"], strict=True)
        )
        for structure, of_it in ordered.groupby("structure", observed=True)
        .head(_GOVERNING)
        .groupby("structure")
    }
