"""The document of a study's fragility: curves with intervals, their medians, and which records govern them."""

import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from matplotlib.axes import Axes
from matplotlib.figure import Figure

from rocking.assessment.rows import PlacedRow
from rocking.assessment.scene import placed
from rocking.earthquakes.sample import FEWEST, interval_words
from rocking.fragility.hazard import REACHING
from rocking.fragility.measures import INTENSITY_MEASURES, intensity_measure
from rocking.products.fragility.rows import (
    ROTATION_RATIOS,
    FragilityRow,
    FragilitySummaryRow,
    IdaRow,
    IntensityMeasureRow,
)
from rocking.quantities import counted
from rocking.reports.pages import CaptionedTable, Panel, PlainPage, Section
from rocking.reports.panels import CurveBand, draw_probability
from rocking.reports.printing import (
    Column,
    Figures,
    faults_in_words,
    number,
    plain,
    table_of,
    words,
    write_document,
)
from rocking.reports.style import elided, new_figure, picture, styled, svg
from rocking.tables import Row, frame, rows_of, write_whole

if TYPE_CHECKING:
    from pandas import DataFrame

ON_A_PAGE = 8
"""Structures whose curves stand on one page."""
FEW_STATIONS = 20
"""Below so many stations the curves are called rough."""
_COLUMNS = 2
"""Panels of a row."""
_HEIGHT = 46.0
"""Height of a row, mm."""
_GOVERNING = 3
"""Records that are named for each structure."""
_HALF = 0.5
"""Share of the members from which on a record overturns a structure."""
_COLOURS = dict(zip(ROTATION_RATIOS, ("#56B4E9", "#0072B2", "#009E73"), strict=False))
_FIRST = next(iter(INTENSITY_MEASURES))
_READ = (
    "structure",
    "support_period_s",
    "record",
    "station",
    "level",
    "overturning_share",
)


P = TypeVar("P", bound=PlacedRow)


def by_place(row_class: type[P], rows: Mapping[type[Row], Iterable[Row]]) -> list[P]:
    """Return the rows of a class, their structures with the periods of their supports in their names."""
    return [
        replace(row, structure=placed(row.structure, row.support_period_s))
        for row in rows_of(row_class, rows)
    ]


def ida_frame(rows: Mapping[type[Row], Iterable[Row]]) -> "DataFrame":
    """Return what the document shows of the scaled records."""
    return frame(IdaRow, by_place(IdaRow, rows), _READ)


def write_fragility_report(
    rows: Mapping[type[Row], Sequence[Row]], pdf: Path, image: Path, figures: Figures = "none"
) -> None:
    """Set the rows of the tables of fragility as the files `pdf` and `image` (SVG), and its figures next to them."""
    curves = frame(FragilityRow, by_place(FragilityRow, rows))
    summary = by_place(FragilitySummaryRow, rows)
    measures = frame(IntensityMeasureRow, by_place(IntensityMeasureRow, rows))
    write_whole(image, svg(fragility_figure(curves, summary)).encode())
    page = fragility_data(curves, summary, ida_frame(rows), measures, faults_in_words(rows))
    write_document(pdf, page, figures)


def fragility_data(
    curves: "DataFrame",
    summary: Sequence[FragilitySummaryRow],
    ida: "DataFrame",
    measures: "DataFrame",
    faults: Sequence[str] = (),
) -> PlainPage:
    """Return the page. The tables are fragility, fragility_summary, ida and intensity_measures."""
    stations = max((row.stations for row in summary), default=0)
    earthquakes = max((row.earthquakes for row in summary), default=0)
    label = interval_words(earthquakes)
    sample = f"{counted(stations, 'station')} of {counted(earthquakes, 'earthquake')}"
    scaled = (
        "Each record of the study is scaled up until the structure overturns; a level counts by its stations."
    )
    few = f" With {sample} the curves are rough and their intervals wide: take more."
    of_curves = (
        "Share of the stations that overturn each structure with the crack that governs, the worst of those that may "
        "form, and that exceed a rotation (overturns, or a share of the critical rotation φcr) with that of statics. "
        f"Dot and bar: the median of overturning with the crack that governs, and its {label}."
    )
    parts = [Section(text=scaled + few * (stations < FEW_STATIONS or earthquakes < FEWEST))]
    names = list(dict.fromkeys(curves["structure"]))
    for first in range(0, len(names), ON_A_PAGE):
        page = names[first : first + ON_A_PAGE]
        figure = fragility_figure(curves[curves["structure"].isin(page)], summary)
        alt = f"Fragility curves of {counted(len(page), 'structure')}, each with its {label}."
        parts.append(Section(pictures=(picture(figure, alt),), caption=of_curves))
    parts.append(_part(fragility_table(summary, ida)))
    if faults:
        parts.append(Section(sentences=tuple(faults)))
    if len(measures):
        parts.append(_part(scatter_table(measures)))
    records = f"{counted(ida['record'].nunique(), 'record')} of {sample}"
    subtitle = f"{records}; {counted(len(names), 'structure')}."
    return PlainPage(title="Fragility", subtitle=subtitle, parts=tuple(parts))


def _part(captioned: CaptionedTable) -> Section:
    return Section(table=captioned.table, caption=captioned.caption)


def fragility_panel(rows: Mapping[type[Row], Iterable[Row]]) -> Panel:
    """Return what the curves of each structure come down to, for the summary."""
    captioned = fragility_table(by_place(FragilitySummaryRow, rows), ida_frame(rows))
    caption = f"{captioned.caption} fragility.pdf holds the curves."
    return Panel("Fragility", (Section(table=captioned.table, caption=caption),))


def fragility_table(summary: Sequence[FragilitySummaryRow], ida: "DataFrame") -> CaptionedTable:
    """Return one row per structure: its median, and what overturns it first."""
    label = interval_words(max((row.earthquakes for row in summary), default=0))
    falls = [row for row in summary if row.threshold == math.inf]
    records = governing_records(ida)
    first = "First to overturn it, and at what level"
    rate: Column = (f"Annual rate and its {label} [1/year]", "1.0", "r", _rate_with_interval)
    table = table_of(
        falls,
        ("Structure", "1.3", "l", lambda row: row.structure),
        (f"Median and its {label}", "1.3", "l", lambda row: _with_interval(row, row.intensity_measure)),
        ("Disper\u00adsion [-]", "0.6", "r", lambda row: number(row.dispersion, 2)),
        (
            "Sta\u00adtions of earth\u00adquakes",
            "0.8",
            "r",
            lambda row: f"{row.stations} of {row.earthquakes}",
        ),
        ("Reach the median", "0.7", "r", _reaching_median),
        (first, "2.2", "l", lambda row: words(records.get(row.structure))),
        ("Stand again, scaled up", "0.6", "r", lambda row: plain(row.reversals)),
        *([rate] if any(row.annual_rate_high > 0 for row in falls) else []),
    )
    caption = (
        f"Level that half of the stations overturn each structure at, with its {label} by earthquakes (– where "
        "it is not known), for the crack that governs, the worst of those that may form; the "
        "stations that reach this level within the largest factor, and the factor with which nine in ten would; "
        "dispersion of the lognormal curve; "
        "records under which it overturns first, with the level of each: they govern the lower end of its curve; and "
        f"how many records, scaled up, let it stand again.{_scaled(falls)}{_untold(falls)}"
    )
    return CaptionedTable(table, caption)


def scatter_table(measures: "DataFrame") -> CaptionedTable:
    """Return one row per structure: by how much the level that overturns scatters in each intensity measure."""
    # A measure has a row for each figure that it is set against, but one scatter.
    once = measures.drop_duplicates(["structure", "intensity_measure"]).sort_values(
        "efficiency", kind="stable"
    )
    by_structure = {str(name): rows for name, rows in once.groupby("structure", sort=False)}

    def scatters(name: str) -> str:
        rows = zip(by_structure[name]["intensity_measure"], by_structure[name]["efficiency"], strict=True)
        return ", ".join(f"{measure} {number(scatter, 2)}" for measure, scatter in rows)

    def needed(name: str) -> str:
        rows = by_structure[name].dropna(subset=["stations_needed"])
        pairs = dict(zip(rows["intensity_measure"], rows["stations_needed"], strict=True))
        shown = {measure: count for measure, count in pairs.items() if measure in (next(iter(pairs)), _FIRST)}
        return ", ".join(f"{int(count)} with {measure}" for measure, count in shown.items())

    names = [name for name in dict.fromkeys(measures["structure"].astype(str)) if name in by_structure]
    table = table_of(
        names,
        ("Structure", "1.0", "l", words),
        ("Scatter by intensity measure, least first [-]", "3.0", "l", scatters),
        ("Stations for a median ± 20 %", "1.4", "l", needed),
    )
    caption = (
        "Standard deviation of the logarithm of the level that overturns, by intensity measure (of arias: of its "
        "root), and the stations that a 90 % interval of ± 20 % about the median needs, in the measure that scatters "
        f"least and in {_FIRST}. A measure chosen for its scatter under these records scatters more under others."
    )
    return CaptionedTable(table, caption)


def _scaled(rows: Sequence[FragilitySummaryRow]) -> str:
    """Return the sentence that says by how much records were scaled, and which did not reach the highest level."""
    factors = [row.largest_scale_factor for row in rows if math.isfinite(row.largest_scale_factor)]
    if not factors:
        return ""
    out = max(row.stations_out for row in rows)
    sentence = f" Records are scaled by {number(max(factors), 2)} at the most"
    do = "does" if out == 1 else "do"
    return (
        f"{sentence}; {counted(out, 'station')} {do} not reach the highest level so."
        if out
        else f"{sentence}."
    )


def _reaching_median(row: FragilitySummaryRow) -> str:
    """Return how many stations reach the median: "14 of 22 (factor 23)"."""
    reached = f"{row.stations_at_median} of {row.stations}"
    if row.stations_at_median >= REACHING * row.stations or math.isnan(row.factor_for_median):
        return reached
    return f"{reached} (factor {number(row.factor_for_median, 2)})"


def _untold(rows: Sequence[FragilitySummaryRow]) -> str:
    """Return the sentence on rates for which there are too few stations, "" without any."""
    if not any(math.isnan(row.annual_rate) and row.annual_rate_high > 0 for row in rows):
        return ""
    return (
        " A rate is given by both ends alone where fewer than nine in ten stations reach the level at which half of it "
        "is made: the lower one if the others never overturn there, the upper one if they do at once; a larger factor "
        "or stronger records tell it. So it is where the mechanism alone is the lower end of the curve, since what "
        "slides first, or whose contacts open, may fall."
    )


def _rate_with_interval(row: FragilitySummaryRow) -> str:
    """Return the annual rate with its interval, or both ends of one for which there are too few stations."""
    ends = f"{number(row.annual_rate_low, 2)}–{number(row.annual_rate_high, 2)}"
    return ends if math.isnan(row.annual_rate) else f"{number(row.annual_rate, 2)} ({ends})"


def _with_interval(row: FragilitySummaryRow, measure: str = "") -> str:
    """Return the median with its interval, and with name and unit of its intensity measure if that is named."""
    ends = f"{number(row.median_low, 2)}–{number(row.median_high, 2)}" if row.median_low > 0 else "–"
    median = number(row.median, 2)
    if row.median_upper < row.median:
        median = f"{number(row.median_upper, 2)} to {median}, by the {row.by}"
    text = f"{median} ({ends})"
    return f"{measure} {text} {_unit(measure)}" if measure else text


def _unit(measure: str) -> str:
    return intensity_measure(measure).unit or "-"


def governing_records(ida: "DataFrame") -> dict[str, str]:
    """Return for each structure the records that overturn it at the lowest levels, with the level of each."""
    falls = ida[ida["overturning_share"] >= _HALF]
    levels = falls.groupby(["structure", "record"], sort=False, observed=True)["level"].min()
    texts: dict[str, list[str]] = {}
    for (structure, record), level in levels.sort_values(kind="stable").items():
        texts.setdefault(str(structure), []).append(f"{record} ({number(level, 2)})")
    return {structure: ", ".join(records[:_GOVERNING]) for structure, records in texts.items()}


@styled
def fragility_figure(curves: "DataFrame", summary: Sequence[FragilitySummaryRow] = ()) -> Figure:
    """Draw the curves of each structure from the table fragility.

    summary: the medians of overturning with their intervals, which are drawn where they are given.
    """
    medians = {row.structure: row for row in summary if row.threshold == math.inf}
    names = list(dict.fromkeys(curves["structure"]))
    rows = math.ceil(len(names) / _COLUMNS)
    figure = new_figure(_HEIGHT * rows + 18, margins=(16, 3, 10, 15))
    spaced = {"hspace": 0.45, "wspace": 0.08}
    panels = figure.subplots(rows, _COLUMNS, squeeze=False, sharey=True, gridspec_kw=spaced)
    for panel in panels.flat[len(names) :]:
        panel.set_axis_off()
    for panel in panels[:, 0]:
        panel.set_ylabel("probability [-]")
    for name, panel in zip(names, panels.flat, strict=False):
        of_structure = curves[curves["structure"] == name]
        for _, curve in of_structure.groupby("threshold"):
            _draw_curve(panel, curve)
        if name in medians:
            _draw_median(panel, medians[name])
        measure = of_structure["intensity_measure"].iloc[0]
        panel.set(title=elided(name, 60), xlabel=f"{measure} [{_unit(measure)}]")
    legends = (panel.get_legend_handles_labels() for panel in panels.flat)
    handles = {label: handle for legend in legends for handle, label in zip(*legend, strict=True)}
    figure.legend(handles.values(), handles.keys(), loc="upper center", ncols=4)
    return figure


def _draw_median(panel: Axes, row: FragilitySummaryRow) -> None:
    """Draw the median of overturning with its interval, which may have no upper end."""
    if math.isnan(row.median):
        return
    high = row.median_high if math.isfinite(row.median_high) else panel.get_xlim()[1]
    panel.plot([row.median_low, high], [0.5, 0.5], color="black", linewidth=2.2, solid_capstyle="butt")
    panel.plot(
        row.median, 0.5, "o", color="black", markersize=5, label=f"median, {interval_words(row.earthquakes)}"
    )


def _draw_curve(panel: Axes, curve: "DataFrame") -> None:
    """Draw one curve, that of overturning with its interval and lognormal curve."""
    threshold = float(curve["threshold"].iloc[0])
    columns = ["level", "probability", "probability_low", "probability_high", "lognormal"]
    levels, probability, low, high, lognormal = curve[columns].to_numpy(dtype=float).T
    if threshold < math.inf:
        label = f"φ > {threshold:g} φcr"
        draw_probability(panel, CurveBand(levels, probability), label, _COLOURS[threshold])
    else:
        draw_probability(panel, CurveBand(levels, probability, (low, high), lognormal), "overturns", "black")
