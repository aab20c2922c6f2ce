"""A job: its records, each read, processed, assessed and reported once, with what stays in memory in between."""

import contextlib
import fcntl
import os
import signal
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from rocking.assessment.assess import Clock, Extent, Store, assess_record, with_histories
from rocking.assessment.case import Failure, RecordResult
from rocking.assessment.compilation import compile_all
from rocking.assessment.listed import load_scenes
from rocking.assessment.rows import HistoryRow, RecordRows, history_rows, rows_of_record
from rocking.assessment.scene import Scene
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.store import RecordStore, computation_version
from rocking.errors import ConfigurationError, RecordError, RockingError, about
from rocking.hashes import sha256_of
from rocking.records import Accelerogram, CatalogueRecord, aligned, load_catalogue, open_station
from rocking.records.processing import process
from rocking.records.scaling import ScalingTarget, scaled_to
from rocking.records.station import station_of
from rocking.structures import Structure
from rocking.study.folder import locked
from rocking.study.plan import JOBS, structures_sha256
from rocking.study.results import SPECTRA, case_timings_of, cases_of, remove_copies, written_part
from rocking.study.settings import Settings, read_settings
from rocking.study.terminal import record_line, tell, tell_error
from rocking.tables import write_rows, write_whole

Opened = tuple[list[Accelerogram], Accelerogram | None]
"""The horizontal components of a record, and its vertical one where that acts too."""


@dataclass(frozen=True)
class Study:
    """The assessment of every record of a study: scenes by name, and settings.

    settings_sha256: names the settings, the structure list and the package in every row.
    """

    scenes: Mapping[str, Scene]
    settings: Settings = field(default_factory=Settings)
    settings_sha256: str = ""

    @property
    def structures(self) -> dict[str, Structure]:
        """The structures of the scenes, by name."""
        return {name: scene.structure for name, scene in self.scenes.items()}

    @cached_property
    def assessment(self) -> AssessmentSettings:
        """The settings of the assessment: in full where a report or histories are made, which show every case."""
        whole = self.settings.reports or self.settings.histories
        if whole and self.settings.fidelity == "auto":
            return replace(self.settings, fidelity="full")
        return self.settings

    @cached_property
    def extent(self) -> Extent:
        """The extent to which a case is followed."""
        return Extent(
            self.assessment,
            self.settings.candidates,
            self.settings.processing_variants,
            motion_measures=True,
            version=computation_version(),
        )

    def open(self, record: CatalogueRecord, channels: list[Accelerogram] | None = None) -> Opened:
        """Return the components of `record`, processed and scaled as its row and the settings say.

        channels: of its files, if they were read. Raises RecordError naming the record, also when the vertical
        component does not fit the others.
        """
        scale_to = record.scale_to or self.settings.scale_to
        unscaled = replace(
            record, scale_to=""
        )  # what is asked is the peak of the motion that acts, after processing
        station = station_of(channels, unscaled) if channels else open_station(unscaled, self.settings.mirror)
        horizontal = [self._processed(accelerogram) for accelerogram in station.horizontal]
        acts = station.vertical is not None and self.settings.vertical
        vertical = self._processed(station.vertical) if station.vertical is not None and acts else None
        if scale_to:
            with about(record.id):
                horizontal, vertical = scaled_to(ScalingTarget.parse(scale_to), horizontal, vertical)
        if vertical is not None:
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
        locked(JOBS, fcntl.LOCK_SH)  # never closed: held to the end
        # Ctrl-C comes from the scheduler, as SIGTERM.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    settings = read_settings(config)
    scenes = load_scenes(settings.structures)
    rows = {row.id: row for row in load_catalogue(settings.catalogue)}
    records = [rows[name] for name in params.records if name in rows]
    for name, sha256, before in (
        (settings.structures, structures_sha256(scenes), params.structures_sha256),
        (settings.catalogue, sha256_of(*records), params.records_sha256),
    ):
        if sha256 != before:
            raise ConfigurationError(f"{name}: the file changed while the study ran; start the study again.")
    compile_all(partial(tell, "compile"))
    return Study(scenes, settings, params.settings_sha256), records


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
            timings = case_timings_of(results, record.id)
            store = RecordStore(cases_of(results, record.id), tell, timings)
            result = assess_catalogued(record, study, store=store)
            store.save()
            if study.settings.reports or study.settings.histories:
                result = with_histories(result, study.settings.tolerance)
            rows = rows_of(result, record, study)
            folder = results / record.id
            content = None
            if study.settings.reports:
                from rocking.reports.explore import record_content  # matplotlib takes a second to import

                write_report(result, rows, study, folder)
                content = record_content(result, rows, study.structures)
                level = study.settings.design_spectrum.spectrum()
                if level is not None:
                    from rocking.reports.design_figure import component_spectra  # as above

                    content[SPECTRA] = component_spectra(result.accelerograms, level)
            else:
                remove_copies(folder)
            if study.settings.histories:
                histories = history_rows(record.id, result.responses)
                write_rows(HistoryRow, histories, folder / HistoryRow.table.file_name)
            add(rows, content)
            tell(f"{record.id}: {record_line(result.scenes.values(), rows.failures)}")
        for path in files:
            if not os.path.isfile(path):
                raise RecordError(f"{path}: the file went away while the study ran; bring it back.")


def write_report(result: RecordResult, rows: RecordRows, study: Study, folder: Path) -> None:
    """Write report.pdf of one record into `folder`, beside the tables that it names."""
    from rocking.reports.record import RecordReport, failure_report  # matplotlib takes a second to import

    rows.write(folder)
    if rows.comparison:
        report = RecordReport(result, rows, study.structures, study.settings.mapping()).pdf()
    else:
        report = failure_report(result.record, " ".join(failure.message for failure in rows.failures))
    write_whole(folder / "report.pdf", report)


def assess_catalogued(
    record: CatalogueRecord, study: Study, opened: Opened | None = None, store: Store | None = None
) -> RecordResult:
    """Read and assess `record`; one that cannot be read has a failure instead. opened: its components, if they were
    read."""
    clock = Clock()
    try:
        with clock.stage("read"):
            horizontal, vertical = opened or study.open(record)
    except RockingError as error:
        unread = Failure("read", error.beside(record.id))
        return RecordResult(record=record.id, failures=(("", unread),), durations=dict(clock.durations))
    return assess_record(
        record.id,
        horizontal,
        study.scenes,
        study.extent,
        vertical,
        store=store,
        clock=clock,
    )


def rows_of(result: RecordResult, record: CatalogueRecord, study: Study) -> RecordRows:
    """Return what the tables of a study hold of a record."""
    friction = study.settings.friction_coefficient
    return rows_of_record(result, study.settings_sha256, record.licence, friction)
