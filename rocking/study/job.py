"""A job: its records, each read, processed, assessed and reported once, with what stays in memory in between."""

import contextlib
import fcntl
import os
import signal
import sys
from collections import defaultdict
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from time import process_time
from typing import Any

from rocking.assessment.assess import Failure, assess_structures
from rocking.assessment.compilation import compile_all
from rocking.assessment.ensemble import GroundMotions, processed
from rocking.assessment.fate import BOTH_COMPONENTS, RecordTables
from rocking.assessment.rows.of_record import (
    HistoryRow,
    HorizontalMotion,
    TimingRow,
    VariationRow,
    ensemble_row,
    history_rows,
    horizontal_motions,
    identity_of,
)
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.variations import Variation, candidates, ensemble_over_cracks, processed_variants
from rocking.assessment.verdict import Method
from rocking.errors import ConfigurationError, RecordError, RockingError
from rocking.motion.response import Response
from rocking.records import Accelerogram, CatalogueRecord, aligned, load_catalogue, open_station
from rocking.records.processing import process
from rocking.records.station import station_of
from rocking.structures import Structure, load_structures
from rocking.study.plan import JOBS, sha256_of, structures_sha256
from rocking.study.results import remove_copies, written_part
from rocking.study.settings import Settings, read_settings
from rocking.study.terminal import record_line, tell, tell_error
from rocking.tables import write_rows, write_whole

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
        """What a record is compared with: in full where a report or histories are made, which show every case."""
        whole = self.settings.reports or self.settings.histories
        return replace(self.settings, fidelity="full") if whole else self.settings

    def open(self, record: CatalogueRecord, channels: list[Accelerogram] | None = None) -> Opened:
        """Return the components of `record`, processed as the settings say. channels: of its files, if they were read.

        Raises RecordError naming the record, also when the vertical component does not fit the others.
        """
        station = station_of(channels, record) if channels else open_station(record, self.settings.mirror)
        horizontal = [self._processed(accelerogram) for accelerogram in station.horizontal]
        if station.vertical is None or not self.settings.vertical:
            return horizontal, None
        vertical = self._processed(station.vertical)
        for accelerogram in horizontal:
            aligned(vertical, accelerogram)
        return horizontal, vertical

    def _processed(self, accelerogram: Accelerogram) -> Accelerogram:
        which = self.settings.processing.apply
        if which == "always" or (which == "raw" and accelerogram.processed is False):
            return process(accelerogram, self.settings.processing)
        return accelerogram


def begin_job(config: Mapping[str, Any], params: Any) -> tuple[Study, list[CatalogueRecord]]:
    """Return the study and the records of a job, from its `config` and what `Plan.params` planned for it.

    The next run waits for the end of this process, should its scheduler be killed. Raises ConfigurationError when the
    structure list or the catalogue says something else than it did then.
    """
    sys.excepthook = tell_error
    with contextlib.suppress(OSError):
        fcntl.flock(os.open(JOBS, os.O_RDWR | os.O_CREAT), fcntl.LOCK_SH)  # never closed: held to the end
        # Ctrl-C comes from the scheduler, as SIGTERM.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    settings = read_settings(config)
    structures = load_structures(settings.structures)
    rows = {row.id: row for row in load_catalogue(settings.catalogue)}
    records = [rows[name] for name in params.records if name in rows]
    for name, sha256, before in (
        (settings.structures, structures_sha256(structures), params.structures_sha256),
        (settings.catalogue, sha256_of(*records), params.records_sha256),
    ):
        if sha256 != before:
            raise ConfigurationError(f"{name}: the file changed while the study ran; start the study again.")
    compile_all(partial(tell, "compile"))
    return Study(structures, settings, params.settings_sha256), records


@dataclass(frozen=True)
class Assessed:
    """One record in memory: its components as they acted, every row, and the responses by component and structure."""

    record: CatalogueRecord
    study: Study
    accelerograms: list[Accelerogram] = field(default_factory=list)
    tables: RecordTables = field(default_factory=RecordTables)
    responses: dict[tuple[str, str], Response] = field(default_factory=dict)
    durations: dict[str, float] = field(default_factory=lambda: defaultdict(float))

    @contextlib.contextmanager
    def stage(self, name: str, component: str = "", structure: str = "") -> Iterator[None]:
        """Add the CPU time of what is done within to that of a stage, s; its error becomes a row of the failures."""
        started = process_time()
        try:
            yield
        except RockingError as error:
            self.tables.fail(self.record.id, component, Failure(name, structure, str(error)))
        finally:
            self.durations[name] += process_time() - started

    def assess(
        self,
        accelerogram: Accelerogram,
        motion: HorizontalMotion,
        vertical: Accelerogram | None,
        alone: bool,
    ) -> None:
        """Append what one component gives: cases, other cracks, other processing. motion: of it, or of its pair."""
        study = self.study
        tables = self.tables
        component = accelerogram.component
        beside = None if vertical is None else aligned(vertical, accelerogram)
        assessment = assess_structures(accelerogram, study.structures, study.assessment, beside, alone)
        identity = identity_of(self.record.id, accelerogram, study.settings_sha256)
        tables.add(identity, assessment, study.assessment, self.record.licence, beside, motion)
        for stage, duration in assessment.durations.items():
            self.durations[stage] += duration
        variations: dict[str, list[Variation]] = {case.structure: [] for case in assessment.cases}
        for case in assessment.cases:
            if response := case.responses.get(Method.MECHANISM_ON_RECORD):
                self.responses[component, case.structure] = response
            pulse = case.prediction.pulse if case.prediction else None
            structure = study.structures[case.structure]
            number = study.settings.candidates
            with self.stage("variations", component, case.structure):
                variations[case.structure] += candidates(
                    structure, accelerogram, pulse, number, study.assessment
                )
        if study.settings.processing_variants:
            as_recorded = {case.structure: case.integrated_rotation_ratio for case in assessment.cases}
            structures = {name: study.structures[name] for name in as_recorded}
            with self.stage("variations", component):
                motions = processed(accelerogram)
                of_each = processed_variants(structures, motions, study.assessment, as_recorded, beside)
                for name, several in of_each.items():
                    variations[name] += several
        for name, several in variations.items():
            tables.variations.extend(VariationRow.of(identity, each, structure=name) for each in several)

    def assess_directions(self, pair: GroundMotions) -> None:
        """Append the ensembles over all directions of a record that has two horizontal components."""
        settings = self.study.assessment
        identity = identity_of(self.record.id, self.accelerograms[0], self.study.settings_sha256)
        identity = replace(identity, component=BOTH_COMPONENTS)
        for name in dict.fromkeys(case.structure for case in self.tables.comparison):
            structure, quick = self.study.structures[name], settings.fidelity == "auto"
            with self.stage("directions", BOTH_COMPONENTS, name):
                members = ensemble_over_cracks(structure, pair, settings, verdict_only=quick)
                self.tables.ensemble.append(ensemble_row(identity, name, members))


def run_job(
    records: Iterable[CatalogueRecord],
    study: Study,
    part: Path,
    results: Path,
    tell: Callable[[str], object] = lambda _: None,
    files: Iterable[str] = (),
) -> None:
    """Assess `records`, one after another: their tables and what the page to explore shows of them go into `part`.

    Where the settings ask for it, the report, the tables that it names and the histories of each go into its folder
    below `results`. tell: takes a line for each record. files: must still be there at the end, lest a folder that went
    away for a while be taken for records that cannot be read. Raises RecordError, and leaves nothing, when one is not.
    """
    with written_part(part) as add:
        for record in records:
            assessed = assess_record(record, study)
            tables = assessed.tables
            folder = results / record.id
            content = None
            if study.settings.reports:
                from rocking.reports.explore import record_content  # matplotlib takes a second to import

                write_report(assessed, folder)
                content = record_content(
                    record.id, assessed.accelerograms, study.structures, tables, assessed.responses
                )
            else:
                remove_copies(folder)
            if study.settings.histories:
                rows = history_rows(record.id, assessed.responses)
                write_rows(HistoryRow, rows, folder / HistoryRow.table.file_name)
            add(tables, content)
            tell(f"{record.id}: {record_line(tables.verdicts, tables.failures)}")
        for path in files:
            if not os.path.isfile(path):
                raise RecordError(f"{path}: the file went away while the study ran; bring it back.")


def write_report(assessed: Assessed, folder: Path) -> None:
    """Write report.pdf of one record into `folder`, beside the tables that it names."""
    from rocking.reports.record import RecordReport, failure_report  # matplotlib takes a second to import

    tables = assessed.tables
    record = assessed.record.id
    study = assessed.study
    tables.write(folder)
    if tables.comparison:
        settings = study.settings.mapping()
        report = RecordReport(
            record, assessed.accelerograms, study.structures, tables, settings, assessed.responses
        ).pdf()
    else:
        report = failure_report(record, " ".join(failure.message for failure in tables.failures))
    write_whole(folder / "report.pdf", report)


def assess_record(record: CatalogueRecord, study: Study, opened: Opened | None = None) -> Assessed:
    """Read and assess `record`; what fails becomes a row of its failures. opened: its components, if they were read."""
    assessed = Assessed(record, study)
    horizontal: list[Accelerogram] = assessed.accelerograms
    vertical = None
    with assessed.stage("read"):
        components, vertical = opened or study.open(record)
        horizontal += components
    if horizontal:
        with assessed.stage("velocity pulse"):
            motions = horizontal_motions(horizontal)
        pair = None
        ensemble = study.assessment.ensemble
        if len(horizontal) == 2 and ensemble.members:
            with assessed.stage("directions", BOTH_COMPONENTS):
                pair = GroundMotions.of(*horizontal, vertical=vertical, processing=ensemble.processing)
        for accelerogram, motion in zip(horizontal, motions, strict=True):
            assessed.assess(accelerogram, motion, vertical, alone=pair is None)
        if pair:
            assessed.assess_directions(pair)
    for stage, duration in assessed.durations.items():
        assessed.tables.timings.append(TimingRow(record=record.id, stage=stage, duration_s=duration))
    return assessed
