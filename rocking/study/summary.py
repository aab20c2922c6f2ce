"""The summary over all records of a study: its report, figure, page and workbook."""

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rocking.assessment.conclusion import conclusions, worst_of_each
from rocking.assessment.decide import worst_first
from rocking.assessment.rows import (
    SUMMARY_TABLES,
    AgreementRow,
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    PulseRow,
    TimingRow,
    VariationRow,
    VerdictRow,
    WarningRow,
    worst_period_each,
)
from rocking.assessment.scene import variants_of
from rocking.assessment.variants import VariantRow, variants
from rocking.quantities import counted, listed
from rocking.reports.printing import write_document
from rocking.reports.style import svg
from rocking.study.documents import made_or_failed
from rocking.study.job import Job, Study
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.outputs import SUMS, former_files, kept_of, remove, sums_of
from rocking.study.plan import versions
from rocking.study.products import BY_NAME
from rocking.study.settings import package_sha256, structure_hashes
from rocking.study.summary_tables import write_summary
from rocking.study.terminal import closing_lines, wrapped
from rocking.study.work import Work, work_of
from rocking.tables import (
    Row,
    data_package,
    rows_of,
    write_tables,
    write_whole,
)
from rocking.tables.workbook import workbook

if TYPE_CHECKING:
    from rocking.reports.pages import Strip

SCATTER = "prediction_against_integration.svg"
"""The figure of every case of the tables."""
_NAMED = 4
"""Files that are removed which a line names."""
WORKBOOK = "study.xlsx"
"""The tables of the summary in one file."""
MadeProduct = tuple[Work, Kept]
"""A product over all records that the summary shows."""
_NOT_IN_THE_WORKBOOK = (TimingRow, VariationRow)
"""The times differ from run to run; the variations of each case are ten times as many as the cases."""


# Whole on purpose: the list of what is made of all records, in the order in which one comes from the other.
def summarise(job: Job) -> None:
    """Write everything over all records, in their order, and remove what no rule gives any more."""
    study = job.study
    target = job.results / "summary"
    made = [_read_product(job, name) for name in job.plan.products]
    faults = [fault for _, kept in made for fault in kept.rows[FailureRow]]
    shown, pages, spectra, sums = write_summary(job.outcomes(), study, target, faults)
    paths: dict[type[Row], str | list[str]] = {
        row_class: row_class.table.file_name for row_class in SUMMARY_TABLES
    }
    write_whole(target / "datapackage.json", data_package("rocking-study", paths))
    provenance = {
        "versions": versions(),
        "settings": study.settings.mapping(),
        "hashes": {"settings": study.settings_sha256, "package": package_sha256()},
        "structures": structure_hashes(study.scenes),
        "records": {record.id: record.sha256 for record in job.records},
    }
    text = json.dumps(provenance, indent=1, sort_keys=True, default=str)
    write_whole(target / "provenance.json", (text + "\n").encode())
    if study.settings.reports:
        unmade = _documents(job, target, shown, made, pages, spectra)
        shown[FailureRow] += unmade
        if unmade:
            write_tables({FailureRow: shown[FailureRow]}, target)
    for rule in (*job.plan.products, "summary"):
        sums |= sums_of(rule, study.settings)
    lines = (f"{sha256}  {path}\n".encode() for path, sha256 in sorted(sums.items()))
    write_whole(job.results / SUMS, lines)
    keep(kept_of(job.results, job.rule), _kept(job, shown, made))
    if not job.plan.by_name:  # else the results of other jobs lie elsewhere
        _remove_former(job)


def _remove_former(job: Job) -> None:
    """Remove what no rule of the study gives any more, and say so: it would say what the tables do not."""
    former = former_files(job.plan.settings, job.plan.products, job.plan.records)
    remove(job.results, former)
    if former:
        job.show_line(
            f"removed {counted(len(former), 'file')} of former runs, which this study does not make: "
            f"{listed(list(map(str, former)), _NAMED)}"
        )


def _documents(
    job: Job,
    target: Path,
    shown: Mapping[type[Row], list[Row]],
    made: Sequence[MadeProduct],
    pages: Sequence[dict[str, Any]],
    spectra: Sequence[Sequence[float]],
) -> list[FailureRow]:
    """Write report, figure, page to explore and workbook over all records; return a row for each that cannot be made.

    shown: the rows of the summary. made: the other products. pages: of each record. spectra: of the components.
    """
    from rocking.reports.explore import explore_page  # matplotlib takes half a second to import

    study = job.study
    sheets: dict[type[Row], Path | Sequence[Row]] = {
        row_class: target / row_class.table.file_name
        for row_class in SUMMARY_TABLES
        if row_class not in _NOT_IN_THE_WORKBOOK
    }
    notes: dict[str, list[str]] = {}
    for work, kept in made:
        sheets |= {of_sheet: [*rows] for of_sheet in work.sheets if (rows := kept.rows[of_sheet])}
        for structure, note in work.notes(kept.rows).items():
            notes.setdefault(structure, []).append(note)
    drawn: list[Strip] = []
    if groups := variants_of(study.scenes):
        from rocking.reports.variants import strips  # matplotlib, as above

        compared = variants(groups, worst_of_each(conclusions(rows_of(VerdictRow, shown), [])))
        drawn = strips(compared, study.structures, notes=notes)
        sheets[VariantRow] = [variant for row in compared.values() for variant in row]
    findings = [kept.conclusion for _, kept in made if kept.conclusion]
    title = study.settings.study or ""
    figures = study.settings.figures
    pdf, scatter = target / "summary.pdf", target / SCATTER
    faults = made_or_failed(pdf, lambda: _report(pdf, study, shown, spectra, drawn, made), job.log, figures)
    faults += made_or_failed(scatter, lambda: _scatter(scatter, shown), job.log)
    page, book = target / "study.html", target / WORKBOOK
    faults += made_or_failed(
        page,
        lambda: write_whole(
            page, explore_page(pages, study.structures, title, findings, notes, drawn, study.warnings)
        ),
        job.log,
    )
    faults += made_or_failed(
        book, lambda: write_whole(book, workbook(sheets, title, opens_on=VerdictRow)), job.log
    )
    return faults


def _kept(job: Job, shown: Mapping[type[Row], list[Row]], made: Sequence[MadeProduct]) -> Kept:
    """What `rocking run` says at its end."""
    verdicts = rows_of(VerdictRow, shown)
    failures = rows_of(FailureRow, shown)
    warnings = rows_of(WarningRow, shown)
    comparison = rows_of(ComparisonRow, shown)
    expected = rows_of(ExpectedFallsRow, shown)
    agreed = rows_of(AgreementRow, shown)
    lines = [*closing_lines(verdicts, comparison, failures, expected, warnings, agreed)]
    for _, kept in made:
        lines += wrapped(kept.conclusion)
    records = worst_first((row.record, row.severity) for row in worst_period_each(verdicts))
    opened = ["summary/summary.pdf", *(f"{record}/report.pdf" for record in records[:1])]
    opened += [*(path for _, kept in made for path in kept.opened), "summary/study.html"]
    if not job.study.settings.reports:
        opened = ["summary"]
    return Kept({FailureRow: failures}, lines=lines, opened=opened)


def _read_product(job: Job, name: str) -> MadeProduct:
    """The work of another product over all records, and what it has left."""
    work = work_of(BY_NAME[name])
    return work, kept_in(kept_of(job.results, name), (*work.shown, FailureRow))


def _report(
    pdf: Path,
    study: Study,
    rows: Mapping[type[Row], Sequence[Row]],
    spectra: Sequence[Sequence[float]],
    strips: Sequence["Strip"],
    made: Sequence[MadeProduct],
) -> None:
    """Write summary.pdf and, where asked for, its figures in an archive.

    spectra: of the components, where there is a design level. strips: of the variants. made: the other products.
    """
    from rocking.reports.summary import summary_data

    level = study.settings.design_spectrum.spectrum()
    design = (level, spectra) if level is not None and spectra else None
    panels = [panel for work, kept in made if (panel := work.panel(kept.rows))]
    findings = [kept.conclusion for _, kept in made if kept.conclusion]
    page = summary_data(rows, study.settings.for_pages, design, strips, findings, panels, study.structures)
    write_document(pdf, page, study.settings.figures)


def _scatter(path: Path, rows: Mapping[type[Row], Sequence[Row]]) -> None:
    """Write the figure of every case of the tables."""
    from rocking.reports.scatter import prediction_scatter  # it loads the kernels and scipy

    scatter = prediction_scatter(rows_of(ComparisonRow, rows), rows_of(PulseRow, rows))
    write_whole(path, svg(scatter).encode())
