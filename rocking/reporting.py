"""Reports of a study: the PDF of each record beside its tables, and the one of all records."""

from collections.abc import Iterable, Mapping
from pathlib import Path

from rocking import columns
from rocking.errors import RecordError, RockingError
from rocking.records.catalogue import CatalogueRecord, load_catalogue, open_record
from rocking.reports import failure_report, record_report, summary_report
from rocking.reports.style import svg
from rocking.reports.summary_figures import prediction_scatter
from rocking.study import Study
from rocking.summary import structure_rows
from rocking.tables import csv_cells, read_rows, write_table, write_whole


def report_records(
    records: Iterable[CatalogueRecord],
    study: Study,
    settings: Mapping[str, object],
    results: Path,
    log: Path,
) -> None:
    """Write report.pdf of each record into its folder below `results`, and a line for each into `log`."""
    structures = [csv_cells(columns.STRUCTURES, row) for row in structure_rows(study.structures)]
    with log.open("w", encoding="utf-8") as stream:
        for record in records:
            folder = results / record.id
            write_whole(folder / "report.pdf", _report(record, study, settings, folder, structures))
            print(f"{record.id}: report written", file=stream, flush=True)


def _report(
    record: CatalogueRecord,
    study: Study,
    settings: Mapping[str, object],
    folder: Path,
    structures: list[dict[str, str]],
) -> bytes:
    tables = {table.name: read_rows(folder / table.file_name) for table in columns.RECORD_TABLES}
    failures = read_rows(folder / columns.FAILURES.file_name)
    if not tables["comparison"]:
        return failure_report(record.id, " ".join(row["message"] for row in failures))
    try:
        accelerograms, vertical = study.open(record)
    except RockingError as error:
        return failure_report(record.id, str(error))
    tables |= {"structures": structures, "failures": failures}
    return record_report(record.id, accelerograms, study.structures, tables, settings, vertical)


def report_summary(folder: Path, settings: Mapping[str, object]) -> None:
    """Write summary.pdf beside the summary tables in `folder`."""
    used = (table for table in columns.SUMMARY_TABLES if table not in (columns.MAXIMA, columns.TIMINGS))
    tables = {
        table.name: read_rows(folder / table.file_name) for table in used
    }  # the two left out are the longest
    write_whole(folder / "summary.pdf", summary_report(tables, settings))


def draw_summary(comparison: Path, target: Path) -> None:
    """Draw prediction against integration of every row of the comparison table into the SVG file `target`."""
    cases = [
        (
            float(row["predicted_rotation_ratio"] or "nan"),
            float(row["integrated_rotation_ratio"] or "nan"),
            row["light"],
        )
        for row in read_rows(comparison)
    ]
    write_whole(target, svg(prediction_scatter(cases)).encode())


EXAMPLE = "RSN1063_NORTHR_RRS228"
"""The record of the paper's example (Fig. 8), by its identifier in the catalogue of near-fault records."""


def write_paper(catalogue: Path, mirror: str | None, folder: Path) -> str:
    """Write the paper's figures (SVG and CSV), the table of its equations and paper.pdf into `folder`.

    Fig. 8 needs the Rinaldi record, which is not shipped: where it can neither be found in `mirror` nor fetched, the
    figure is left out. Returns a sentence that says so, or that all figures were drawn.
    """
    from rocking.reports.paper import (  # a sixth of a second
        EQUATIONS,
        equation_rows,
        paper_figures,
        paper_report,
    )

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
        write_table(figure.table, figure.rows, folder / f"{figure.name}.csv")
        write_whole(folder / f"{figure.name}.svg", svg(figure.figure).encode())
    write_table(EQUATIONS, equations, folder / EQUATIONS.file_name)
    write_whole(folder / "paper.pdf", paper_report(figures, equations))
    return message
