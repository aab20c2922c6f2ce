"""The source paper redrawn: its figures with their data, its equations with the numbers that decide, one document."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure

from docs.paper import curves
from docs.paper.equations import EquationRow, equation_rows
from docs.paper.figures import arch_response, panels, pulse_map
from docs.paper.response import example_arch, response_curves
from rocking.reports import printing
from rocking.reports.pages import Page, PageTable, Picture
from rocking.reports.printing import compile_document
from rocking.reports.style import picture, plain_logarithmic
from rocking.signal.accelerogram import Accelerogram
from rocking.sine_pulse import pulse_spectrum
from rocking.structures.mechanism import Scale, Side
from rocking.tables import Row, column, row


@row("pulse_spectrum", "One row per point of the spectrum of one sine pulse")
class PulseSpectrumRow(Row):
    """One block under one sine pulse."""

    frequency_ratio: float = column(
        "Circular frequency of the pulse over frequency parameter", equation="Eq. 16"
    )
    amplitude_ratio: float = column("a = a_g / (g times uplift multiplier)", equation="Eq. 16")
    rotation_ratio: float = column("Largest rotation over critical rotation; INF if it overturns")


Sides = dict[str, Side]


@dataclass(frozen=True, eq=False)
class PaperFigure:
    """One figure of the paper, redrawn. name: of its files. row_class and rows: its data."""

    name: str
    caption: str
    figure: Figure
    row_class: type[Row]
    rows: Sequence[Row]


def paper_figures(record: Accelerogram, instead: str = "") -> list[PaperFigure]:
    """Return Figs. 3, 4, 6 and 7, Figs. 3 and 4 with Eq. 4 as printed, the curves of Eq. 14, the envelope of
    section 3.1, the spectrum of one sine pulse, and Fig. 8 under `record`.

    instead: the sentences that say why the record is not the paper's; empty where it is.
    """
    walls, arches = equivalence_figures()[:2], equivalence_figures()[2:]
    others = [_figures_as_printed(), _hinge_heights(), _envelope(), *arches, _pulse_spectrum()]
    return [*walls, *others, _figure_8(record, instead)]


@cache
def equivalence_figures() -> list[PaperFigure]:
    """Return Figs. 3, 4, 6 and 7: what is lost by an equivalent block, the paper's and the one exact at rest."""
    walls, arches = curves.wall_sides(), curves.arch_sides()
    period = "Errors of the equivalent block"
    time = "Error of the equivalent block in the time to overturn under constant acceleration"
    wall, arch = "wall hinged at mid-height", "semicircular arch"
    return [
        _periods("figure_3", f"Fig. 3. {period}, {wall}", walls, curves.wall_uplift_curve("b")),
        _overturning("figure_4", f"Fig. 4. {time}, {wall}", walls),
        _periods("figure_6", f"Fig. 6. {period}, {arch}", arches, curves.arch_uplift_curve("b")),
        _overturning("figure_7", f"Fig. 7. {time}, {arch}", arches),
    ]


def paper_report(figures: Sequence[PaperFigure], equations: Sequence[EquationRow]) -> bytes:
    """Return one PDF with `figures` and the table of equations."""
    page = PaperPage(
        title="Towards a unified description of rocking structures: figures and equations recomputed",
        figures=tuple(DrawnFigure(picture(f.figure, f.caption), f.caption, f.name) for f in figures),
        equations=equation_table(equations),
    )
    return compile_document(page)


@dataclass(frozen=True)
class DrawnFigure:
    """A figure of the paper, its caption, and the name of its table."""

    picture: Picture
    caption: str
    name: str


@dataclass(frozen=True, kw_only=True)
class PaperPage(Page):
    """What paper.typ is given."""

    template = Path(__file__).with_name("paper.typ")

    figures: tuple[DrawnFigure, ...]
    equations: PageTable


def equation_table(rows: Sequence[EquationRow]) -> PageTable:
    """Return the equations as the template sets them."""
    columns = [
        ("Eq.", "0.45", "l"), ("Printed", "1.2", "l"), ("Corrected", "1.3", "l"), ("What decides", "1.8", "l"),
        ("Printed gives", "0.7", "r"), ("Corrected gives", "0.75", "r"), ("Decided", "0.7", "r"),
    ]  # fmt: skip
    cells = []
    for slip in rows:
        numbers = (slip.printed_number, slip.corrected_number, slip.deciding_number)
        texts = (slip.equation, slip.printed, slip.corrected, slip.quantity)
        cells.append([*texts, *(printing.number(number, 6) for number in numbers)])
    return printing.table(columns, cells)


def _made(
    name: str, caption: str, lines: Sequence[curves.Curve], figure: Figure | None = None
) -> PaperFigure:
    return PaperFigure(name, caption, figure or panels(lines), curves.CurveRow, curves.rows_of(lines))


def _periods(name: str, caption: str, sides: Sides, uplift: curves.Curve) -> PaperFigure:
    """Errors in the natural period and in uplift."""
    caption += (
        ": (a) natural period, linearised as in the paper, (b) uplift, linearised; (c) natural period of the block "
        "exact at rest, whose uplift has no error."
    )
    lines = [*curves.period_curves(sides, "a"), uplift, *curves.period_curves(sides, "c", "exact_at_rest")]
    return _made(name, caption, lines)


def _overturning(name: str, caption: str, sides: Sides) -> PaperFigure:
    """Errors in the time to overturn."""
    caption += ": (a) with a_sc and (b) with a_sc,alt as in the paper, (c) exact at rest."
    scales: tuple[tuple[Scale, str], ...] = (("linearised", "a"), ("uplift", "b"), ("exact_at_rest", "c"))
    lines = [curve for scale, panel in scales for curve in curves.overturning_curves(sides, scale, panel)]
    return _made(name, caption, lines)


def _figures_as_printed() -> PaperFigure:
    caption = (
        "Figs. 3 and 4 as they come out with Eq. 4 as printed, 6R sin² in place of 2R sin²: (a) natural period, "
        "(b) time to overturn with a_sc. Compare with Figs. 3a and 4a: the misprint makes the stocky wall three times "
        "as inert in its bending as it is."
    )
    sides = curves.printed_wall_sides()
    lines = [*curves.period_curves(sides, "a"), *curves.overturning_curves(sides, "linearised", "b")]
    return _made("figures_3_4_equation_4_as_printed", caption, lines)


def _hinge_heights() -> PaperFigure:
    caption = (
        "Eq. 14 as printed and corrected: frequency parameter of the wall against the height of its hinge, at fixed "
        "height H, with a thickness of 0.1 H. Only the printed form has a largest value inside."
    )
    lines = curves.hinge_height_curves()
    return _made("equation_14", caption, lines, panels(lines, columns=1))


def _envelope() -> PaperFigure:
    caption = (
        "The governing envelope that section 3.1 proposes, over all mechanisms that may form, for a hollow spire of "
        "3 m × 15 m with a wall of 0.25 m under one full sine, by the closed form of the block exact at rest: (a) the "
        "least amplitude that overturns what stands on one crack, and over all cracks; (b) the crack that governs. "
        "Short sines throw off the tip, long ones turn over the whole spire at its base, where statics cracks it."
    )
    lines = curves.envelope_curves()
    figure = panels(lines)
    plain_logarithmic(figure.axes[0], "y")
    return _made("envelope", caption, lines, figure)


def _pulse_spectrum() -> PaperFigure:
    caption = (
        "Spectrum of one full sine pulse, η = 0.9: largest rotation over critical rotation of the equivalent block "
        "(numbers on the lines), and where it overturns (hatched). White areas above a hatched one are safe islands."
    )
    frequencies, amplitudes = np.geomspace(0.5, 12, 90), np.geomspace(1.01, 20, 90)
    ratios = pulse_spectrum(frequencies, amplitudes, 0.9)
    rows = [
        PulseSpectrumRow(frequency_ratio=omega, amplitude_ratio=a, rotation_ratio=float(ratios[i, j]))
        for i, omega in enumerate(frequencies.tolist())
        for j, a in enumerate(amplitudes.tolist())
    ]
    figure = pulse_map(frequencies, amplitudes, ratios)
    return PaperFigure("pulse_spectrum", caption, figure, PulseSpectrumRow, rows)


def _figure_8(record: Accelerogram, instead: str) -> PaperFigure:
    caption = (
        f"Fig. 8. {instead}Arches of 157.5° with a thickness of 0.15 r under the record: (a) the arch of r = 10 m "
        "at rest (dashed) and displaced, with its thrust line at onset; (b) its dominant pulse; (c, d) the integration "
        "for r = 10 m and 15 m beside the predicted maximum. A prediction that overturns has no line. "
        "The paper's block keeps the true uplift acceleration (a_sc,alt); ours is exact at rest."
    )
    if not instead:
        caption += " Under the pulse alone the arch of 10 m overturns, which no block says."
    lines = response_curves(record)
    return _made("figure_8", caption, lines, arch_response(lines, example_arch(10.0)))


__all__ = ["EquationRow", "PaperFigure", "equation_rows", "paper_figures", "paper_report"]
