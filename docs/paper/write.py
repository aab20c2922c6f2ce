"""The figures and the equations of the source paper, redrawn."""

from pathlib import Path

from docs.paper.report import EquationRow, equation_rows, paper_figures, paper_report
from rocking.errors import RecordError
from rocking.records import load_catalogue, open_record
from rocking.reports.style import svg
from rocking.tables import write_rows, write_whole

EXAMPLE = "RSN1063_NORTHR_RRS228"
"""The record of the paper's example (Fig. 8), by its identifier in the catalogue of near-fault records."""


def write_paper(catalogue: Path, mirror: str | None, folder: Path) -> str:
    """Write the paper's figures (SVG and CSV), the table of its equations and paper.pdf into `folder`.

    Fig. 8 needs the Rinaldi record, which is not shipped: where it can neither be found in `mirror` nor fetched, the
    figure is left out. Returns a sentence that says so, or that all figures were drawn.
    """
    rinaldi, message = None, "All figures were drawn."
    try:
        record = next(record for record in load_catalogue(catalogue) if record.id == EXAMPLE)
        rinaldi = open_record(record, mirror=mirror)[0]
    except StopIteration:
        message = f"Fig. 8 was left out: {catalogue} lists no {EXAMPLE}."
    except RecordError as error:
        message = f"Fig. 8 was left out: {error}"
    figures, equations = paper_figures(rinaldi), equation_rows()
    for figure in figures:
        write_rows(figure.row_class, figure.rows, folder / f"{figure.name}.csv")
        write_whole(folder / f"{figure.name}.svg", svg(figure.figure).encode())
    write_rows(EquationRow, equations, folder / EquationRow.table.file_name)
    write_whole(folder / "paper.pdf", paper_report(figures, equations))
    return message
