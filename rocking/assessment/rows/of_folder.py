"""The tables of one record: filled by an assessment, written, and read again as rows."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import get_args, get_type_hints

from rocking.assessment.assess import Assessment, Failure
from rocking.assessment.fate import Fate, fates
from rocking.assessment.horizontal_motion import HorizontalMotion
from rocking.assessment.rows.of_record import (
    ComparisonRow,
    ComponentRow,
    EnsembleRow,
    FailureRow,
    PulseRow,
    RecordRow,
    TimingRow,
    VariationRow,
    comparison_row,
    ensemble_row,
    pulse_rows,
    record_row,
)
from rocking.assessment.settings import AssessmentSettings
from rocking.records import Accelerogram
from rocking.tables import Row, read_table, write_tables, written_together


@dataclass(frozen=True)
class RecordTables:
    """Every row of one record, by table; each field is named as its file."""

    record: list[RecordRow] = field(default_factory=list)
    pulses: list[PulseRow] = field(default_factory=list)
    comparison: list[ComparisonRow] = field(default_factory=list)
    ensemble: list[EnsembleRow] = field(default_factory=list)
    variations: list[VariationRow] = field(default_factory=list)
    failures: list[FailureRow] = field(default_factory=list)
    timings: list[TimingRow] = field(default_factory=list)

    @classmethod
    def read(cls, folder: Path) -> "RecordTables":
        """Return the rows of a record's folder. Raises RockingError for a table that cannot be read."""
        return cls(*(read_table(each, folder) for each in PER_RECORD))  # type: ignore[arg-type]

    def write(self, folder: Path) -> None:
        """Write every table into `folder`."""
        with written_together():
            write_tables({each: getattr(self, each.table.name) for each in PER_RECORD}, folder)

    @property
    def verdicts(self) -> list[Fate]:
        """What became of each structure, all components considered."""
        return fates(self.comparison, self.ensemble, self.failures, self.variations)

    def of_component(self, component: str) -> "RecordTables":
        """Return the rows of one component, without the timings."""
        tables = {each.table.name: getattr(self, each.table.name) for each in PER_RECORD[:-1]}
        kept = {name: [row for row in rows if row.component == component] for name, rows in tables.items()}
        return replace(self, timings=[], **kept)

    def add(
        self,
        identity: ComponentRow,
        assessment: Assessment,
        settings: AssessmentSettings,
        licence: str,
        vertical: Accelerogram | None = None,
        motion: HorizontalMotion | None = None,
    ) -> None:
        """Append what one assessment gives. motion: of the pair of components, or None for that of one alone."""
        dominant = assessment.analysis.dominant if assessment.analysis else None
        self.record.append(record_row(identity, assessment.accelerogram, licence, vertical, motion, dominant))
        self.pulses.extend(pulse_rows(identity, assessment.analysis, assessment.candidates))
        for case in assessment.cases:
            self.comparison.append(comparison_row(identity, case, settings.friction_coefficient))
            if case.ensemble is not None:
                self.ensemble.append(ensemble_row(identity, case.structure, case.ensemble))
        for failure in assessment.failures:
            self.fail(identity.record, assessment.accelerogram.component, failure)

    def fail(self, record: str, component: str, failure: Failure) -> None:
        """Append a row of the failures."""
        self.failures.append(FailureRow.of(failure, record=record, component=component))


PER_RECORD: tuple[type[Row], ...] = tuple(get_args(each)[0] for each in get_type_hints(RecordTables).values())
"""The rows of every table of one record."""
RECORD_TABLES = PER_RECORD[:-2]
"""Those that hold results."""
