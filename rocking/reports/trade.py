"""The report of the trade of error for time, from its table."""

import math
from collections.abc import Sequence
from pathlib import Path

from matplotlib.figure import Figure

from rocking.assessment.rows import TradeMethod, TradeRow
from rocking.reports import printing
from rocking.reports.printing import compile_document
from rocking.reports.style import new_figure, picture, plain_logarithmic, powers_of_ten, styled, svg
from rocking.tables import read_table, write_whole

SMALLEST_ERROR = 1e-8
"""Smaller errors, down to none at all, are drawn here."""
_MARKERS = dict(zip(TradeMethod, "opsdD^*", strict=True))


def write_trade_report(folder: Path, pdf: Path, image: Path) -> None:
    """Set the table in `folder` as the files `pdf` and `image` (SVG)."""
    rows = read_table(TradeRow, folder)
    table = printing.table_of(
        rows,
        ("Method", "1.4", "l", lambda row: row.method),
        ("Structure", "1.6", "l", lambda row: row.structure or "all"),
        *printing.columns_of(TradeRow, "cases", "0.5"),
        ("Median error (%)", "0.8", "r", lambda row: printing.number(100 * row.error, 2)),
        ("95 % quantile (%)", "0.8", "r", lambda row: printing.number(100 * row.error_high, 2)),
        *printing.columns_of(TradeRow, "wrong_verdicts unsafe_verdicts", "0.7"),
        ("A response (ms)", "0.8", "r", lambda row: printing.number(1e3 * row.cpu_s, 2)),
        ("A record (ms)", "0.7", "r", lambda row: printing.number(1e3 * row.preparation_record_s, 2)),
    )
    caption = (
        "Cases: those in which the method or the reference, the mechanism at a tolerance of 1e-12, does not rest. "
        "Errors: of the largest rotation where both rock. Unsafe: verdicts that say less than the reference. A record: "
        "the search for its pulses. The ensemble answers for all alike cases; its error is that of its median."
        f"{_break_even(rows)}"
    )
    parts = [*trade_picture(folder), {**table, "caption": caption}]
    subtitle = "Processor times of the machine that measured, on the records and structures of the study."
    data = {"title": "What accuracy costs", "subtitle": subtitle, "parts": parts}
    write_whole(pdf, compile_document("plain.typ", data))
    write_whole(image, svg(trade_figure(rows)).encode())


def _break_even(rows: Sequence[TradeRow]) -> str:
    """Return the sentence that says from how many structures a record on the search for its pulses is repaid."""
    of_all = {row.method: row for row in rows if row.structure == ""}
    sine = of_all.get(TradeMethod.ONE_SINE)
    mechanism = of_all.get(TradeMethod.MECHANISM)
    if sine is None or mechanism is None or not mechanism.cpu_s > sine.cpu_s:
        return ""
    structures = math.ceil(sine.preparation_record_s / (mechanism.cpu_s - sine.cpu_s))
    return (
        f" Below {structures} structures a record the search for its pulses costs more than the integration of all "
        "of them."
    )


def trade_picture(folder: Path) -> list[dict[str, str]]:
    """Return the figure and its conclusion for another document; nothing where no structure was followed."""
    rows = [row for row in read_table(TradeRow, folder) if row.structure == ""]
    conclusion = "; ".join(
        f"{row.method}: {1e3 * row.cpu_s:.2g} ms, {printing.of(row.wrong_verdicts, row.cases)} verdicts wrong"
        for row in rows
    )
    figure = picture(trade_figure(rows), "Median error against processor time of every method.")
    caption = (
        "Median error of the largest rotation against the processor time of one response, over all structures. Errors "
        "below 1e-8 stand at 1e-8."
    )
    return [figure | {"caption": caption, "conclusion": f"{conclusion}."}] if rows else []


@styled
def trade_figure(rows: Sequence[TradeRow]) -> Figure:
    """Draw what each method errs against what it costs, over all structures."""
    figure = new_figure(80, margins=(16, 60, 12, 4))
    panel = figure.subplots()
    for row in (each for each in rows if each.structure == "" and each.error >= 0):
        error = max(row.error, SMALLEST_ERROR)
        panel.plot(1e3 * row.cpu_s, error, _MARKERS[row.method], markersize=6, label=row.method)
    plain_logarithmic(panel, "x")
    powers_of_ten(panel, "y")
    panel.margins(0.08, 0.1)
    panel.set_xlabel("processor time of a response [ms]")
    panel.set_ylabel("relative error of the largest rotation [-]")
    panel.grid(True)
    figure.legend(loc="center right")
    return figure
