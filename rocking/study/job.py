"""A job: its records, each read, processed, assessed and reported once, with what stays in memory in between."""

import contextlib
import fcntl
import gc
import signal
import sys
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from pathlib import Path
from typing import Any

from rocking.assessment.assessor import Assessor, Predictions, Store, with_histories
from rocking.assessment.case import Failure, RecordResult
from rocking.assessment.compilation import compile_all
from rocking.assessment.conclusion import worst_cases
from rocking.assessment.contacts import expected_seconds
from rocking.assessment.cracks import prepare_structure
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.motions import Component
from rocking.assessment.one_case import Clock
from rocking.assessment.rows import (
    FailedCase,
    FailureRow,
    HistoryRow,
    RecordRows,
    RemarkRow,
    history_rows,
    rows_of_record,
)
from rocking.assessment.scene import Scene, on_joints
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.store import RecordStore, computation_version
from rocking.catalogue import CatalogueRecord, open_station
from rocking.catalogue.place import Place
from rocking.catalogue.station import station_of
from rocking.errors import ConfigurationError, RockingError, about, fault_in_words, one_structure
from rocking.quantities import counted
from rocking.records import Accelerogram
from rocking.records.read import LARGEST_FILE
from rocking.signal import aligned
from rocking.signal.processing import process
from rocking.signal.scaling import ScalingTarget, scaled_to
from rocking.structures import Structure
from rocking.study.contents import ContentHashes
from rocking.study.folder import locked
from rocking.study.made_from import made_from, records_of, settings_for, what_changed
from rocking.study.outcomes import RecordOutcome, outcomes_written
from rocking.study.outputs import case_timings_of, cases_of, kept_of, outcome_of, sums_of
from rocking.study.plan import JOBS, Plan, plan_of_job, scenes_of, study_remarks
from rocking.study.products import BY_NAME
from rocking.study.progress import line_writer, log_error, send_compilation, send_error, send_line
from rocking.study.settings import Settings, settings_sha256
from rocking.study.task import Task
from rocking.study.terminal import record_line
from rocking.tables import Row, write_rows, write_tables, write_whole, written_together

WORTH_A_LINE = 5.0
"""Processor time of contact dynamics of a record, s, from which on it is announced."""
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

    def __post_init__(self) -> None:
        scenes = on_joints(self.scenes, self.settings.joints)
        object.__setattr__(self, "scenes", scenes)

    @property
    def structures(self) -> dict[str, Structure]:
        """The structures of the scenes, by name."""
        return {name: scene.structure for name, scene in self.scenes.items()}

    @cached_property
    def remarks(self) -> list[RemarkRow]:
        """The rows of what there is to say of settings and structures before they meet a record."""
        return RemarkRow.of_study(study_remarks(self.settings, self.scenes))

    @cached_property
    def assessment(self) -> AssessmentSettings:
        """The settings of the assessment: in full where a report or histories are made, which show every case."""
        settings = self.settings
        own = {setting.name: getattr(settings, setting.name) for setting in fields(AssessmentSettings)}
        if settings.fidelity == "quick" and (settings.reports or settings.histories):
            own["fidelity"] = "standard"
        return AssessmentSettings(**own)

    def assessor(self, store: Store | None, clock: Clock) -> Assessor:
        """Return what assesses a record, as far as the settings ask."""
        return Assessor(
            self.assessment,
            self.settings.candidates,
            self.settings.processing_variants,
            motion_measures=True,
            version=computation_version() if store else "",
            store=store,
            clock=clock,
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


def prepare(settings: Settings) -> None:
    """Make what depends on each structure of a study alone, for jobs that are forked from this process.

    Structures keep what they compute, and `plan_of_job` gives a fork those of this process where the list is the same.
    What is wrong with the study its jobs say.
    """
    with contextlib.suppress(RockingError), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        study = Study(scenes_of(settings.structures, ContentHashes(None, LARGEST_FILE)), settings)
        for scene in study.scenes.values():
            with contextlib.suppress(RockingError):
                prepare_structure(scene.structure, study.assessment, vertical=settings.vertical)


@dataclass(frozen=True)
class Job:
    """The work on one product of a study.

    plan: as the job reads it. study: of which the settings that the product is made from can be read. records: those of
    the product, in catalogue order. log: of the job. show_line: adds a line to the log, and shows it.
    keep: keeps the outcome of a record for what stands over all records.
    """

    task: Task
    plan: Plan
    study: Study
    records: Sequence[CatalogueRecord]
    log: Path
    show_line: Callable[..., None]
    keep: Callable[[str, RecordOutcome], None] = lambda _record, _outcome: None

    @property
    def kind(self) -> str:
        """The kind of the product, which is the name of its rule."""
        return self.task.product.partition("/")[0]

    @property
    def results(self) -> Path:
        """The folder of the results."""
        return Path(self.study.settings.results)

    @property
    def folder(self) -> Path:
        """The folder of the files of a product over all records."""
        return self.results / BY_NAME[self.kind].folder

    @property
    def made_by_hand(self) -> Sequence[str]:
        """What a product is made from that no whole run makes, and stays until that changes; () for the others."""
        return () if self.task.product in self.plan.products else self.task.made_from

    @property
    def kept(self) -> Path:
        """The file that keeps the rows of the product for the summary."""
        return kept_of(self.results, self.task.product)


@contextlib.contextmanager
def begin_job(task: Task) -> Iterator[Job]:
    """Yield the job of a task, in the folder in which its files lie.

    The next run waits for the end of this process, should its scheduler be killed. Raises ConfigurationError, at the
    begin and at the end, when the product is made from something else than what was planned.
    """
    gc.freeze()  # where nothing was forked: see rocking.study.warm
    kind = task.product.partition("/")[0]
    sys.excepthook = send_error
    log = Path(task.log).absolute()
    with contextlib.suppress(OSError):
        locked(JOBS, fcntl.LOCK_SH)  # never closed: held to the end
        # Ctrl-C comes from the scheduler, as SIGTERM.
        signal.signal(signal.SIGINT, signal.SIG_IGN)
        signal.signal(signal.SIGTERM, signal.default_int_handler)
    with contextlib.chdir(task.folder or "."):
        write_line = line_writer(log, kind)
        plan = _planned(task)
        compile_all(send_compilation)
        settings = settings_for(kind, plan.settings)
        study = Study(plan.scenes, settings, settings_sha256(plan.settings, plan.scenes))
        records = [plan.records[record] for record in records_of(task.product, plan)]
        job = Job(task, plan, study, records, Path(task.log), write_line)
        if kind in ("record", "batch"):
            batch = task.product.partition("/")[2] if kind == "batch" else ""
            with outcomes_written(outcome_of(job.results, records[0].id, batch)) as keep:
                yield replace(job, keep=keep)
                _planned(task)
        else:
            yield job
            _planned(task)


def _planned(task: Task) -> Plan:
    """The plan of a task, read again. Raises ConfigurationError when its product is made from something else now."""
    plan = plan_of_job(task.config, task.product, task.by_name)
    if changed := what_changed(task.made_from, made_from(task.product, plan)):
        raise ConfigurationError(
            f"{task.product}: a file or a setting changed while the study ran ({changed}); start the study again.",
            made_from=changed,
        )
    return plan


class Steps:
    """The five steps of one record of a job, each on what the one before it gave."""

    def __init__(self, record: CatalogueRecord, job: Job) -> None:
        self._record = record
        self._job = job
        timings = case_timings_of(job.results, record.id)
        self.store = RecordStore(cases_of(job.results, record.id), job.show_line, timings)
        self.clock = Clock()
        self._assessor = job.study.assessor(self.store, self.clock)
        self.is_read = False

    def read(self) -> Opened:
        """Return the components of the record, processed and scaled. Raises RockingError."""
        with self.clock.stage("read"):
            opened = self._job.study.open(self._record)
        self.is_read = True
        return opened

    def pulses(self, opened: Opened) -> tuple[Component, ...]:
        """Return the components with the sine pulses that dominate each."""
        return self._assessor.pulses(*opened)

    def predict(self, components: tuple[Component, ...]) -> Predictions:
        """Return the closed form of each equivalent block under the pulse of each component."""
        return self._assessor.predict(components, self._job.study.scenes)

    def integrate(
        self, opened: Opened, components: tuple[Component, ...], predictions: Predictions
    ) -> RecordResult:
        """Return the motion of each structure, and of its members, under the whole record."""
        horizontal, vertical = opened
        scenes = self._job.study.scenes
        asking = self._job.study.assessment
        costs = [_expected(scene, horizontal, asking) for scene in scenes.values()]
        if sum(costs) > WORTH_A_LINE:
            number = counted(sum(cost > 0 for cost in costs), "structure")
            send_line(
                "contact dynamics",
                f"{self._record.id}: up to {sum(costs):.2g} s, if {number} cannot be decided otherwise; the longest "
                f"takes {max(costs):.2g} s",
            )
        return self._assessor.integrate(self._record.id, components, scenes, predictions, vertical)

    def compare(self, result: RecordResult) -> None:
        """Compare prediction and integration, decide on each structure, and write tables, report and outcome."""
        settings = self._job.study.settings
        result = self._assessor.compare(result)
        self.store.save()
        if settings.histories:
            result = with_histories(result, settings.tolerance)
        _write(result, self._record, self._job)


def _expected(scene: Scene, horizontal: Sequence[Accelerogram], settings: AssessmentSettings) -> float:
    """What contact dynamics of a structure may take, s; 0 of one that fails, of which its own row says why."""
    try:
        with one_structure(scene.name):
            return expected_seconds(scene.structure, horizontal, settings)
    except RockingError:
        return 0.0


@contextlib.contextmanager
def steps_of(record: CatalogueRecord, job: Job) -> Iterator[Steps]:
    """Yield the five steps of a record. Whatever goes wrong with it costs no other: its outcome is a row that says why.

    What goes wrong with the machine, a full disk or too little memory, ends the job.
    """
    steps = Steps(record, job)
    try:
        yield steps
    except RockingError as error:
        if steps.is_read:
            raise
        failure = Failure("read", error.without_place(record.id))
    except (OSError, MemoryError):
        raise
    except Exception as fault:
        log_error(fault)
        failure = Failure("fault", fault_in_words(fault, job.log))
    else:
        return
    durations = dict(steps.clock.durations)
    steps.store.stand()  # an output of its rule like the others
    _write(RecordResult(record=record.id, failures=(("", failure),), durations=durations), record, job)


@contextlib.contextmanager
def costs_no_other(
    faults: list[Row], log: Path | str, where: str, structure: str = "", record: str = ""
) -> Iterator[None]:
    """Add a row to `faults` for what no input may cause within, and go on behind it.

    record, structure: that it is about; "" for all. What is wrong with the input or the machine passes.
    """
    try:
        yield
    except (RockingError, OSError, MemoryError):
        raise
    except Exception as fault:
        log_error(fault)
        failure = Failure("fault", fault_in_words(fault, log, where))
        faults.append(FailureRow.of(FailedCase(record, "", structure, failure)))


def _write(result: RecordResult, record: CatalogueRecord, job: Job) -> None:
    """Write the outcome of a record, and in a job of its own the files in its folder."""
    study = job.study
    rows = rows_of(result, record, study)
    folder = job.results / record.id
    page: dict[str, Any] = {}
    spectra: Mapping[str, Sequence[float]] = {}
    with written_together():
        if study.settings.reports:
            from rocking.reports.design_figure import component_spectra  # matplotlib takes a second to import
            from rocking.reports.explore import RECORD_SCRIPT, cells_of, record_content, record_script
            from rocking.study.documents import made_or_failed

            result = with_histories(result, study.settings.tolerance, _drawn(result, rows))
            make = partial(write_report, result, rows, study, folder)
            pdf = folder / "report.pdf"
            faults = made_or_failed(pdf, make, job.log, study.settings.figures, record.id)
            rows = replace(rows, failures=[*rows.failures, *faults])
            content = record_content(result, rows, study.structures)
            write_whole(folder / RECORD_SCRIPT, record_script(content))
            page = cells_of(content)
            level = study.settings.design_spectrum.spectrum()
            if level is not None:
                spectra = component_spectra(result.accelerograms, level)
        if job.kind == "record":
            write_tables(rows.tables, folder)
        if study.settings.histories:
            histories = history_rows(record.id, result.responses)
            write_rows(HistoryRow, histories, folder / HistoryRow.table.file_name)
    tables = {row_class: list(of_it) for row_class, of_it in rows.tables.items()}
    sums = sums_of(job.task.product, study.settings) if job.kind == "record" else {}
    job.keep(record.id, RecordOutcome(tables, page, spectra, sums))
    job.show_line(f"{record.id}: {record_line(result.scenes.values(), rows.failures)}")


def _drawn(result: RecordResult, rows: RecordRows) -> set[tuple[str, str, float | None]]:
    """The cases whose history documents draw: the worst one of each structure that moves, at its worst period."""
    worst = worst_cases(rows.comparison)
    keys = (
        (result.record, period_result.structure, period_result.support_period_s)
        for period_result in result.worst_periods
    )
    found = (worst[key] for key in keys if key in worst)
    return {row.case for row in found if row.integrated_rotation_ratio > NEGLIGIBLE}


def write_report(result: RecordResult, rows: RecordRows, study: Study, folder: Path) -> None:
    """Write report.pdf of one record into `folder`, beside the tables that it names."""
    from rocking.reports.pages import Page
    from rocking.reports.printing import write_document  # matplotlib takes a second to import
    from rocking.reports.record import RecordReport, failure_page

    if rows.comparison:
        level = study.settings.design_spectrum.spectrum()
        page: Page = RecordReport(
            result, rows, study.structures, study.settings.for_pages, level, study.remarks
        ).page()
    else:
        page = failure_page(result.record, " ".join(failure.message for failure in rows.failures))
    write_document(folder / "report.pdf", page, study.settings.figures)


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
        unread = Failure("read", error.without_place(record.id))
        return RecordResult(record=record.id, failures=(("", unread),), durations=dict(clock.durations))
    return study.assessor(store, clock).assess(record.id, horizontal, study.scenes, vertical)


def rows_of(result: RecordResult, record: CatalogueRecord, study: Study) -> RecordRows:
    """Return what the tables of a study hold of a record."""
    vertical = study.settings.vertical
    place = record.epicentre
    epicentre = place if isinstance(place, Place) else None
    return rows_of_record(result, study.settings_sha256, record.licence, vertical, epicentre)
