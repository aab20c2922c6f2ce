"""A study: many records against one list of structures, each record in its own folder of tables."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from time import process_time

from rocking.assessment import columns, rows
from rocking.assessment.assess import Assessment, Case, Failure, assess
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.variations import candidates, processed, processed_variants
from rocking.errors import RockingError
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord, as_declared, horizontal_of, open_record, vertical_of
from rocking.records.processing import process
from rocking.records.vertical import aligned, open_vertical
from rocking.structures import Structure
from rocking.study.settings import Settings
from rocking.tables import Row, write_table

Opened = tuple[list[Accelerogram], Accelerogram | None]
"""The horizontal components of a record, and its vertical one where that acts too."""


@dataclass(frozen=True)
class Study:
    """What every record of a study is put through: structures by name, and settings.

    settings_sha256: names the settings, the structure list and the package in every row.
    """

    structures: Mapping[str, Structure]
    settings: Settings = field(default_factory=Settings)
    settings_sha256: str = ""

    @cached_property
    def assessment(self) -> AssessmentSettings:
        """What a record is compared with."""
        return self.settings.assessment

    def open(self, record: CatalogueRecord) -> Opened:
        """Return the components of `record`, processed as the settings say.

        Raises RecordError naming the record, also when the vertical component does not fit the others.
        """
        mirror = self.settings.mirror
        vertical = open_vertical(record, mirror=mirror) if self.settings.vertical else None
        return self._processed(open_record(record, mirror=mirror), vertical)

    def opened(self, channels: list[Accelerogram], record: CatalogueRecord) -> Opened:
        """Return what open() returns, from the `channels` of the record's file. Raises RecordError."""
        vertical = vertical_of(channels, record) if self.settings.vertical else None
        vertical = None if vertical is None else as_declared(vertical, record)
        return self._processed(horizontal_of(channels, record), vertical)

    def _processed(self, accelerograms: list[Accelerogram], vertical: Accelerogram | None) -> Opened:
        done = [self._process(accelerogram) for accelerogram in accelerograms]
        if vertical is None:
            return done, None
        vertical = self._process(vertical)
        for accelerogram in done:
            aligned(vertical, accelerogram)
        return done, vertical

    def _process(self, accelerogram: Accelerogram) -> Accelerogram:
        which = self.settings.processing.apply
        wanted = which == "always" or (which == "raw" and accelerogram.processed is False)
        return process(accelerogram, self.settings.raw_processing) if wanted else accelerogram


def assess_records(records: Iterable[CatalogueRecord], study: Study, results: Path, log: Path) -> None:
    """Write the tables of each record into its folder below `results`, and a line for each into `log`."""
    with log.open("w", encoding="utf-8") as stream:
        for record in records:
            failures = assess_record(record, study, results / record.id)
            print(f"{record.id}: {'; '.join(failures) or 'assessed'}", file=stream, flush=True)


def assess_record(record: CatalogueRecord, study: Study, folder: Path) -> list[str]:
    """Write the tables of `record` into `folder`; what fails becomes a row of its failures table.

    Returns the sentences of what failed.
    """
    started = process_time()
    try:
        opened, failures = study.open(record), []
    except RockingError as error:
        opened, failures = ([], None), [rows.failure_row(record.id, "", Failure("read", "", str(error)))]
    return write_tables(record, opened, study, folder, failures, process_time() - started)


def write_tables(
    record: CatalogueRecord,
    opened: Opened,
    study: Study,
    folder: Path,
    failures: Sequence[Row] = (),
    read_duration: float = 0.0,
) -> list[str]:
    """Write the tables of the components that were `opened` into `folder`, and return the sentences of what failed."""
    tables: dict[str, list[Row]] = {table.name: [] for table in columns.PER_RECORD}
    tables["failures"] = list(failures)
    durations = {"read": read_duration}
    accelerograms, vertical = opened
    for accelerogram in accelerograms:
        _assess_component(record, accelerogram, vertical, study, tables, durations)
    tables["timings"] = [
        {"record": record.id, "stage": stage, "duration_s": duration} for stage, duration in durations.items()
    ]
    for table in columns.PER_RECORD:
        write_table(table, tables[table.name], folder / table.file_name)
    return [str(row["message"]) for row in tables["failures"]]


def _assess_component(
    record: CatalogueRecord,
    accelerogram: Accelerogram,
    vertical: Accelerogram | None,
    study: Study,
    tables: dict[str, list[Row]],
    durations: dict[str, float],
) -> None:
    beside = None if vertical is None else aligned(vertical, accelerogram)
    assessment = assess(accelerogram, study.structures, study.assessment, beside)
    identity = rows.Identity(record.id, accelerogram, study.settings_sha256)
    made = rows.all_rows(identity, assessment, study.assessment, record.licence, beside)
    for name, new in made.items():
        tables[name].extend(new)
    varied = process_time()
    for name, new in _variations(identity, assessment, study).items():
        tables[name].extend(new)
    durations["variations"] = durations.get("variations", 0.0) + process_time() - varied
    for stage, duration in assessment.durations.items():
        durations[stage] = durations.get(stage, 0.0) + duration


def _variations(identity: rows.Identity, assessment: Assessment, study: Study) -> dict[str, list[Row]]:
    """The rows of candidates and processing, for every structure that gave a result, and of what failed among them."""
    record = assessment.accelerogram
    records = processed(record) if study.settings.processing_variants else {}
    made: dict[str, list[Row]] = {"candidates": [], "processing": [], "failures": []}
    for case in assessment.cases:
        try:
            _vary(identity, case, records, study, made)
        except RockingError as error:
            failure = Failure("variations", case.structure, str(error))
            made["failures"].append(rows.failure_row(identity.record, record.component, failure))
    return made


def _vary(
    identity: rows.Identity,
    case: Case,
    records: Mapping[str, Accelerogram],
    study: Study,
    made: dict[str, list[Row]],
) -> None:
    structure = study.structures[case.structure]
    pulse = case.prediction.pulse if case.prediction else None
    found = candidates(structure, identity.accelerogram, pulse, study.settings.candidates, study.assessment)
    made["candidates"] += rows.candidate_rows(identity, case.structure, found)
    variants = processed_variants(structure, records, study.assessment)
    made["processing"] += rows.processing_rows(identity, case.structure, variants)
