"""A study: many records against one list of structures."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from time import process_time

from rocking.assessment.assess import Assessment, Failure, assess_structures
from rocking.assessment.ensemble import GroundMotions, ensemble
from rocking.assessment.ensemble.ground_motions import processed
from rocking.assessment.fate import BOTH_COMPONENTS
from rocking.assessment.horizontal_motion import horizontal_motions
from rocking.assessment.method import Method
from rocking.assessment.rows.of_case import candidate_rows, ensemble_row, processing_rows
from rocking.assessment.rows.of_folder import RecordTables
from rocking.assessment.rows.of_record import TimingRow
from rocking.assessment.rows.shared import Identity
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.variations import candidates, processed_variants
from rocking.errors import RockingError
from rocking.records import Accelerogram, CatalogueRecord, Station, aligned, open_station
from rocking.records.processing import process
from rocking.records.station import station_of
from rocking.structures import Structure
from rocking.study.outcome import record_line
from rocking.study.parts import written_part
from rocking.study.settings import Settings

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
        """What a record is compared with: in full where a report is made, which shows every method."""
        chosen = self.settings
        return replace(chosen, fidelity="full") if self.settings.reports else chosen

    def open(self, record: CatalogueRecord) -> Opened:
        """Return the components of `record`, processed as the settings say.

        Raises RecordError naming the record, also when the vertical component does not fit the others.
        """
        return self._processed(open_station(record, self.settings.mirror))

    def opened(self, channels: list[Accelerogram], record: CatalogueRecord) -> Opened:
        """Return what open() returns, from the `channels` of the record's file. Raises RecordError."""
        return self._processed(station_of(channels, record))

    def _processed(self, station: Station) -> Opened:
        done = [self._process(accelerogram) for accelerogram in station.horizontal]
        if station.vertical is None or not self.settings.vertical:
            return done, None
        vertical = self._process(station.vertical)
        for accelerogram in done:
            aligned(vertical, accelerogram)
        return done, vertical

    def _process(self, accelerogram: Accelerogram) -> Accelerogram:
        which = self.settings.processing.apply
        wanted = which == "always" or (which == "raw" and accelerogram.processed is False)
        return process(accelerogram, self.settings.processing) if wanted else accelerogram


def assess_records(records: Iterable[CatalogueRecord], study: Study, folder: Path, log: Path) -> None:
    """Write the tables of `records`, one record after another, into `folder`, and a line for each into `log`."""
    with log.open("w", encoding="utf-8") as stream, written_part(folder) as add:
        for record in records:
            found = assess_record(record, study)
            add(found)
            line = record_line(found.verdicts, found.failures)
            print(f"{record.id}: {line}", file=stream, flush=True)


def assess_record(record: CatalogueRecord, study: Study) -> RecordTables:
    """Return the tables of `record`; what fails becomes a row of its failures."""
    started = process_time()
    tables = RecordTables()
    try:
        opened = study.open(record)
    except RockingError as error:
        tables.fail(record.id, "", Failure("read", "", str(error)))
        opened = [], None
    return assess_components(record, opened, study, tables, process_time() - started)


def assess_components(
    record: CatalogueRecord,
    opened: Opened,
    study: Study,
    tables: RecordTables | None = None,
    read_duration: float = 0.0,
) -> RecordTables:
    """Return the tables of the components that were `opened`. tables: what is known already."""
    tables = tables or RecordTables()
    durations = {"read": read_duration}
    accelerograms, vertical = opened
    started = process_time()
    motions = horizontal_motions(accelerograms)
    if accelerograms:
        durations["velocity pulse"] = process_time() - started
    for accelerogram, motion in zip(accelerograms, motions, strict=True):
        beside = None if vertical is None else aligned(vertical, accelerogram)
        assessment = assess_structures(accelerogram, study.structures, study.assessment, beside)
        identity = Identity(record.id, accelerogram, study.settings_sha256)
        tables.add(identity, assessment, study.assessment, record.licence, beside, motion)
        varied = process_time()
        _vary(identity, assessment, study, tables, beside)
        spent = {"variations": process_time() - varied, **assessment.durations}
        durations |= {stage: durations.get(stage, 0.0) + duration for stage, duration in spent.items()}
    if len(accelerograms) == 2 and study.assessment.ensemble.members and study.assessment.fidelity == "full":
        started = process_time()
        _assess_directions(record, opened, study, tables)
        durations["directions"] = process_time() - started
    for stage, duration in durations.items():
        tables.timings.append(TimingRow(record=record.id, stage=stage, duration_s=duration))
    return tables


def _assess_directions(record: CatalogueRecord, opened: Opened, study: Study, tables: RecordTables) -> None:
    """Append the ensembles over directions, where the record has two horizontal components."""
    accelerograms, vertical = opened
    settings = study.assessment.ensemble
    identity = Identity(record.id, accelerograms[0], study.settings_sha256)
    names = dict.fromkeys(alone.structure for alone in tables.ensemble)
    try:
        motions = GroundMotions.of_pair(
            accelerograms[0], accelerograms[1], vertical, processing=settings.processing
        )
        for name in names:
            found = ensemble(study.structures[name], motions, settings, tolerance=study.assessment.tolerance)
            tables.ensemble.append(ensemble_row(identity, name, found, BOTH_COMPONENTS))
    except RockingError as error:
        tables.fail(record.id, BOTH_COMPONENTS, Failure("directions", "", str(error)))


def _vary(
    identity: Identity,
    assessment: Assessment,
    study: Study,
    tables: RecordTables,
    vertical: Accelerogram | None,
) -> None:
    """Append the rows of candidates and processing, for every structure that gave a result."""
    record, cases = identity.accelerogram, {case.structure: case for case in assessment.cases}
    for name, case in cases.items():
        pulse = case.prediction.pulse if case.prediction else None
        try:
            found = candidates(
                study.structures[name], record, pulse, study.settings.candidates, study.assessment
            )
            tables.candidates.extend(candidate_rows(identity, name, found))
        except RockingError as error:
            tables.fail(identity.record, record.component, Failure("variations", name, str(error)))
    if study.settings.processing_variants:
        structures = {name: study.structures[name] for name in cases}
        followed = {name: case.responses.get(Method.MECHANISM_ON_RECORD) for name, case in cases.items()}
        known = {name: response for name, response in followed.items() if response is not None}
        variants = processed_variants(structures, processed(record), study.assessment, known, vertical)
        for name, of_structure in variants.items():
            tables.maxima.extend(processing_rows(identity, name, of_structure))
