"""The tables over all records of a study, written record by record."""

from collections.abc import Collection, Iterable, Iterator, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path
from typing import Any

from rocking.assessment.rows import (
    RECORD_TABLES,
    SUMMARY_TABLES,
    AgreementRow,
    CapacityRow,
    ComparisonRow,
    ExpectedFallsRow,
    FailureRow,
    PulseRow,
    RecordRow,
    StructureRow,
    SupportRow,
    VerdictRow,
    WarningRow,
    agreement_rows,
    capacity_rows,
    counted_cases,
    falls_over,
    falls_under,
    made_records,
    sample_of_records,
    structure_rows,
)
from rocking.errors import RockingError, one_structure
from rocking.study.job import Study
from rocking.study.kept import Kept
from rocking.tables import (
    Row,
    rows_of,
    rows_written,
    write_tables,
    written_together,
)

ON_PAGES = (RecordRow, PulseRow, ComparisonRow, SupportRow, VerdictRow, FailureRow, WarningRow)
"""The tables of records that the documents over all of them show; the others, far longer, are in no memory whole."""


def write_summary(
    outcomes: Iterable[Kept], study: Study, target: Path, faults: Collection[Row] = ()
) -> tuple[dict[type[Row], list[Row]], list[dict[str, Any]], list[Sequence[float]], dict[str, str]]:
    """Write the tables of the summary into `target`, record by record.

    faults: of what else covers all records. Returned are the rows of ON_PAGES and of the tables over all records, what
    the page to explore and the spectra show of each record, and the hashes of the files of the records.
    """
    variants = [name for name, scene in study.scenes.items() if scene.variant_of]
    kept: dict[type[Row], list[Row]] = {row_class: [] for row_class in SUMMARY_TABLES}
    pages: list[dict[str, Any]] = []
    spectra: list[Sequence[float]] = []
    sums: dict[str, str] = {}
    falls_of_records: list[ExpectedFallsRow] = []
    cases: list[ComparisonRow] = []
    read: list[RecordRow] = []
    of_records = [row_class for row_class in SUMMARY_TABLES if row_class in RECORD_TABLES]
    with written_together(), ExitStack() as stack:
        write = {
            row_class: stack.enter_context(rows_written(row_class, target / row_class.table.file_name))
            for row_class in of_records
        }
        write[WarningRow](study.warnings)  # what was typed, before what records say
        kept[WarningRow] += study.warnings
        for outcome in outcomes:
            for row_class in of_records:
                write[row_class](outcome.rows[row_class])
            for row_class in ON_PAGES:
                kept[row_class] += outcome.rows[row_class]
            first = rows_of(RecordRow, outcome.rows)[:1]
            read += first
            verdicts = rows_of(VerdictRow, outcome.rows)
            cases += counted_cases(rows_of(ComparisonRow, outcome.rows), verdicts)
            sums |= outcome.sums
            if falls := falls_under(verdicts, variants, made_records(first)):
                falls_of_records.append(falls)
            pages.append(outcome.page)
            spectra += outcome.spectra.values()
        failures = [*faults]
        for name, structure in study.structures.items():
            with failures_of_structure(failures, name):
                kept[StructureRow] += structure_rows({name: structure}, study.settings.acceleration_scale)
            with failures_of_structure(failures, name):
                kept[CapacityRow] += capacity_rows({name: structure})
        write[FailureRow](failures)
        kept[FailureRow] += failures
        identifiers, sample = sample_of_records(read, study.settings.unnamed_events == "each")
        of_sample = WarningRow.of_study(sample.warnings)
        write[WarningRow](of_sample)
        kept[WarningRow] += of_sample
        names = dict(zip(identifiers, zip(sample.stations, sample.events, strict=True), strict=True))
        of_all = falls_over(falls_of_records, names)
        kept[ExpectedFallsRow] = [*falls_of_records, *([of_all] if of_all else [])]
        kept[AgreementRow] = list(agreement_rows(cases, names, made_records(read)))
        write_tables({row_class: rows for row_class, rows in kept.items() if row_class not in write}, target)
    return kept, pages, spectra, sums


@contextmanager
def failures_of_structure(faults: list[Row], name: str) -> Iterator[None]:
    """Add a row to `faults` for what goes wrong within with one structure, and go on behind it."""
    try:
        with one_structure(name):
            yield
    except RockingError as error:
        faults.append(FailureRow(structure=name, stage="summary", message=str(error)))
