"""The document of a study's fragility: curves with intervals, their medians, and which records govern them."""

import math
from pathlib import Path
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from rocking.assessment.intensity import INTENSITY_MEASURES
from rocking.assessment.rows.of_fragility import FragilityRow, FragilitySummaryRow, IdaRow
from rocking.quantities import counted
from rocking.reports.document import compile_document
from rocking.reports.panels import draw_probability
from rocking.reports.printing import NOTHING, Column, given, number, table_of, words
from rocking.reports.style import elided, new_figure, picture, styled, svg
from rocking.tables import frame, rows_of, write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

ON_A_PAGE = 8
"""Structures whose curves stand on one page."""
FEW_STATIONS = 20
"""Below so many stations the curves are called rough."""
_COLUMNS, _HEIGHT = 2, 52.0
"""Panels of a row, and its height, mm."""
_GOVERNING, _HALF = 3, 0.5
"""Records that are named for each structure; share of the members from which on a record overturns it."""
_COLOURS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7")
_READ = ("structure", "record", "station", "level", "overturning_share")


def write_fragility_report(folder: Path, pdf: Path, image: Path) -> None:
    """Set the tables of fragility in `folder` as the files `pdf` and `image` (SVG)."""
    curves, summary = (
        frame(each, folder / each.table.file_name) for each in (FragilityRow, FragilitySummaryRow)
    )
    write_whole(image, svg(fragility_figure(curves, summary)).encode())
    ida = frame(IdaRow, folder / IdaRow.table.file_name, _READ)
    write_whole(pdf, compile_document("plain.typ", fragility_data(curves, summary, ida)))


def fragility_data(curves: "DataFrame", summary: "DataFrame", ida: "DataFrame") -> dict[str, object]:
    """Return what the template is given. The tables are fragility, fragility_summary and ida."""
    stations = int(summary["stations"].max()) if len(summary) else 0
    scaled = (
        "Each record of the study is scaled up until the structure overturns; a level counts by its stations."
    )
    few = f" With {counted(stations, 'station')} the curves are rough and their intervals wide: take more."
    caption = (
        "Level that half of the stations overturn each structure at, with its 90 % interval by stations; dispersion of "
        "the lognormal curve; records under which it overturns first, with the level of each: they govern the lower "
        "end of its curve; and how many records, scaled up, let it stand again."
    )
    of_curves = (
        "Share of the stations that exceed a rotation (overturns, or a share of the critical rotation φcr), its 90 % "
        "interval by stations for overturning (shaded) and the lognormal curve (dashed)."
    )
    parts = [
        {"text": scaled + few * (stations < FEW_STATIONS)},
        fragility_table(summary, ida) | {"caption": caption},
    ]
    names = list(dict.fromkeys(curves["structure"]))
    for first in range(0, len(names), ON_A_PAGE):
        page = names[first : first + ON_A_PAGE]
        drawn = fragility_figure(*(table[table["structure"].isin(page)] for table in (curves, summary)))
        alt = f"Fragility curves of {counted(len(page), 'structure')} with 90 % intervals."
        parts.append(picture(drawn, alt) | {"caption": of_curves})
    records = f"{counted(ida['record'].nunique(), 'record')} of {counted(stations, 'station')}"
    return {
        "title": "Fragility",
        "subtitle": f"{records}; {counted(len(names), 'structure')}.",
        "parts": parts,
    }


def fragility_table(summary: "DataFrame", ida: "DataFrame") -> dict[str, object]:
    """Return one row per structure: its median, that with the worst crack, and what overturns it first."""
    falls = list(rows_of(FragilitySummaryRow, summary[summary["threshold"] == math.inf]))
    worst = {row.structure: row for row in falls if row.governing}
    records = governing_records(ida)
    first = "First to overturn it, and at what level"

    def of_worst(row: FragilitySummaryRow) -> str:
        return _with_interval(worst[row.structure]) if row.structure in worst else NOTHING

    with_worst: Column = ("Median with the worst crack", "1.0", "l", of_worst)
    rate: Column = ("Annual rate [1/year]", "0.7", "r", lambda row: number(row.annual_rate, 2))
    return table_of(
        [row for row in falls if not row.governing],
        ("Structure", "1.3", "l", lambda row: row.structure),
        ("Median and its 90 % interval", "1.3", "l", _median),
        *([with_worst] if worst else []),
        ("Disper\u00adsion [-]", "0.6", "r", lambda row: number(row.dispersion, 2)),
        ("Sta\u00adtions", "auto", "r", lambda row: given(row.stations)),
        (first, "2.2", "l", lambda row: words(records.get(row.structure))),
        ("Stand again, scaled up", "0.6", "r", lambda row: given(row.reversals)),
        *([rate] if any(row.annual_rate > 0 for row in falls) else []),
    )


def _median(row: FragilitySummaryRow) -> str:
    """The median with interval, name and unit of its intensity measure."""
    return f"{row.intensity_measure} {_with_interval(row)} {_unit(row.intensity_measure)}"


def _with_interval(row: FragilitySummaryRow) -> str:
    return f"{number(row.median, 2)} ({number(row.median_low, 2)}–{number(row.median_high, 2)})"


def _unit(measure: str) -> str:
    return INTENSITY_MEASURES[measure].unit or "-"


def governing_records(ida: "DataFrame") -> dict[str, str]:
    """Return for each structure the records that overturn it at the lowest levels, with the level of each."""
    fallen = ida[ida["overturning_share"] >= _HALF]
    first = fallen.groupby(["structure", "record"], sort=False, observed=True)["level"].min().reset_index()
    named: dict[str, list[str]] = {}
    for _, row in first.sort_values("level", kind="stable").iterrows():
        named.setdefault(str(row["structure"]), []).append(f"{row['record']} ({number(row['level'], 2)})")
    return {structure: ", ".join(records[:_GOVERNING]) for structure, records in named.items()}


@styled
def fragility_figure(curves: "DataFrame", summary: "DataFrame") -> Figure:
    """Draw the curves of each structure from the tables fragility and fragility_summary, with the crack of statics."""
    curves, summary = (table[~table["governing"]] for table in (curves, summary))
    names = list(dict.fromkeys(curves["structure"]))
    rows = math.ceil(len(names) / _COLUMNS)
    figure = new_figure(_HEIGHT * rows + 20, margins=(16, 3, 12, 11))
    spaced = {"hspace": 0.45, "wspace": 0.08}
    panels = figure.subplots(rows, _COLUMNS, squeeze=False, sharey=True, gridspec_kw=spaced)
    for panel in panels.flat[len(names) :]:
        panel.set_axis_off()
    for panel in panels[:, 0]:
        panel.set_ylabel("probability [-]")
    for name, panel in zip(names, panels.flat, strict=False):
        of_structure = curves[curves["structure"] == name]
        for place, (threshold, curve) in enumerate(of_structure.groupby("threshold")):
            overturns = math.isinf(float(threshold))  # type: ignore[arg-type]
            draw_probability(
                panel,
                curve["level"].to_numpy(),
                curve["probability"].to_numpy(),
                (curve["probability_low"], curve["probability_high"]) if overturns else None,
                curve["lognormal"].to_numpy() if overturns else None,
                "overturns" if overturns else f"φ > {threshold:g} φcr",
                "black" if overturns else _COLOURS[place % len(_COLOURS)],
            )
        own = summary[(summary["structure"] == name) & (summary["threshold"] == math.inf)]
        falls = next(rows_of(FragilitySummaryRow, own))
        panel.set_title(f"{elided(name, 60)}\nmedian {_median(falls)}", fontsize=8)
        panel.set_xlabel(f"{falls.intensity_measure} [{_unit(falls.intensity_measure)}]")
        panel.legend(loc="upper left", fontsize=7)
    return figure
