"""The figures and the equations of the source paper, redrawn."""

import sys
from pathlib import Path

from docs.paper.report import EquationRow, equation_rows, paper_figures, paper_report
from docs.paper.response import PredictionRow, prediction_rows
from rocking.catalogue import load_catalogue, open_station
from rocking.errors import RecordError
from rocking.records import read
from rocking.reports.style import svg
from rocking.tables import write_rows, write_whole

EXAMPLE = "RSN1063_NORTHR_RRS228"
"""The record of the paper's example (Fig. 8), by its identifier in the catalogue of near-fault records."""
SHIPPED = Path(__file__).parents[2] / "records" / "20161113_110259_WTMC_20.V2A"
"""The real record that comes with the project, whose component N28W takes the place of Rinaldi."""


def write_paper(catalogue: Path, mirror: str | None, folder: Path) -> str:
    """Write the paper's figures (SVG and CSV), the tables of its equations and predictions and paper.pdf into `folder`.

    Fig. 8 needs the Rinaldi record, which may not be shipped: where neither `mirror` nor the network has it, its panels
    are drawn for the shipped record, and its caption says why. Returns a sentence that says so, or that all
    figures were drawn.
    """
    message, instead = "All figures were drawn.", ""
    try:
        record = next(record for record in load_catalogue(catalogue) if record.id == EXAMPLE)
        motion = open_station(record, mirror=mirror).horizontal[0]
    except (StopIteration, RecordError) as error:
        why = str(error) or f"{catalogue} lists no {EXAMPLE}."
        message = f"Fig. 8 is drawn for the shipped record, not for the paper's: {why}"
        instead = (
            "The paper draws it for the record of Rinaldi (Northridge 1994), which may not be shipped and was neither "
            "in a mirror folder nor to be had over the network; the log says why. These are the same panels for Te "
            "Mara Farm, N28W (Kaikōura 2016; GeoNet, CC BY 3.0 NZ). "
        )
        motion = read(SHIPPED)[0]
    figures = paper_figures(motion, instead)
    equations = equation_rows()
    for figure in figures:
        write_rows(figure.row_class, figure.rows, folder / f"{figure.name}.csv")
        write_whole(folder / f"{figure.name}.svg", svg(figure.figure).encode())
    write_rows(PredictionRow, prediction_rows(motion), folder / PredictionRow.table.file_name)
    write_rows(EquationRow, equations, folder / EquationRow.table.file_name)
    write_whole(folder / "paper.pdf", paper_report(figures, equations))
    return message


if __name__ == "__main__":
    records = SHIPPED.with_name("near_fault.csv")
    print(write_paper(records, *sys.argv[1:2] or [None], records.parents[1] / "results" / "paper"))
