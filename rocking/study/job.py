"""What the jobs of a study share: how it assesses a record, and what it writes of one."""

import contextlib
import warnings
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from functools import cached_property, partial
from pathlib import Path
from traceback import print_exception
from typing import Any

from rocking.assessment.assessor import Assessor, Store, with_histories
from rocking.assessment.case import Failure, RecordResult
from rocking.assessment.conclusion import worst_cases
from rocking.assessment.cracks import prepare_structure
from rocking.assessment.methods import NEGLIGIBLE
from rocking.assessment.one_case import Clock
from rocking.assessment.rows import (
    RECORD_TABLES,
    FailureRow,
    HistoryRow,
    RecordRows,
    WarningRow,
    history_rows,
    rows_of_record,
)
from rocking.assessment.scene import Scene, on_joints
from rocking.assessment.settings import AssessmentSettings
from rocking.assessment.store import computation_version
from rocking.catalogue import CatalogueRecord, open_station
from rocking.catalogue.place import Coordinates
from rocking.catalogue.station import station_of
from rocking.errors import RockingError, about, fault_in_words
from rocking.records import Accelerogram
from rocking.signal import aligned
from rocking.signal.processing import process
from rocking.signal.scaling import ScalingTarget, scaled_to
from rocking.structures import Structure
from rocking.study.apart import tell
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.outputs import STEPS, TABLES, kept_of, outcome_of, sums_of
from rocking.study.plan import MADE_FROM, Plan, scenes_of, study_warnings
from rocking.study.products import BY_NAME
from rocking.study.settings import Settings, settings_sha256
from rocking.study.terminal import record_line
from rocking.tables import Row, write_rows, write_tables, write_whole, written_together

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

    @classmethod
    def of(cls, plan: Plan, step: str = "") -> "Study":
        """Return that of a plan; of a step of a record, with the settings and structures that the step is made from."""
        settings = plan.settings.only((*MADE_FROM[step], "results", "mirror")) if step else plan.settings
        scenes = {} if step in ("read", "pulses") else plan.scenes
        return cls(scenes, settings, settings_sha256(settings, scenes))

    def __post_init__(self) -> None:
        scenes = on_joints(self.scenes, self.settings.joints) if self.scenes else {}
        object.__setattr__(self, "scenes", scenes)

    @property
    def structures(self) -> dict[str, Structure]:
        """The structures of the scenes, by name."""
        return {name: scene.structure for name, scene in self.scenes.items()}

    @cached_property
    def warnings(self) -> list[WarningRow]:
        """The rows of what there is to say of settings and structures before they meet a record."""
        return WarningRow.of_study(study_warnings(self.settings, self.scenes))

    @cached_property
    def assessment(self) -> AssessmentSettings:
        """The settings of the assessment: in full where a report or histories are made, which show every case."""
        settings = self.settings
        own = {
            setting.name: getattr(settings, setting.name)
            for setting in fields(AssessmentSettings)
            if settings.knows(setting.name)
        }
        if own.get("fidelity") == "quick" and (settings.reports or settings.histories):
            own["fidelity"] = "standard"
        return AssessmentSettings(**own)

    def assessor(self, store: Store | None, clock: Clock) -> Assessor:
        """Return what assesses a record, as far as the settings ask."""
        settings = self.settings
        return Assessor(
            self.assessment,
            settings.candidates if settings.knows("candidates") else 0,
            settings.knows("processing_variants") and settings.processing_variants,
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


def prepare(settings: Settings) -> Iterator[None]:
    """Make what depends on each structure of a study alone, one after another, for jobs forked from this process.

    Structures cache what they compute, and `scenes_of` gives a fork those of this process where the list is the same.
    What is wrong with the study its jobs say.
    """
    with contextlib.suppress(RockingError), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        study = Study(scenes_of(settings.structures), settings)
        for scene in study.scenes.values():
            yield
            with contextlib.suppress(RockingError):
                prepare_structure(scene.structure, study.assessment, vertical=settings.vertical)


@dataclass(frozen=True)
class Job:
    """The job of a rule over all records, as the work of a product sees it.

    rule: its name. log: of the job.
    """

    rule: str
    plan: Plan
    study: Study
    log: Path

    @property
    def records(self) -> Sequence[CatalogueRecord]:
        """The records of the study, in catalogue order."""
        return list(self.plan.records.values())

    @property
    def results(self) -> Path:
        """The folder of the results."""
        return self.plan.results

    @property
    def folder(self) -> Path:
        """The folder of the files of the product."""
        return self.results / BY_NAME[self.rule].folder

    @property
    def kept(self) -> Path:
        """The file of the rows of the product for the summary."""
        return kept_of(self.results, self.rule)

    def outcomes(self) -> Iterator[Kept]:
        """Yield the outcome of each record, in catalogue order, one at a time."""
        return (kept_in(path, RECORD_TABLES) for path in self.plan.outcomes)

    def show_line(self, line: str, _done: int = 0, _total: int = 0) -> None:
        """Add a line to the log, and show it."""
        tell(f"{self.rule}: {line}")


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
        print_exception(fault)
        sentence = fault_in_words(fault, log, where)
        faults.append(FailureRow(record=record, structure=structure, stage="fault", message=sentence))


def write_record(result: RecordResult, record: CatalogueRecord, study: Study, log: Path) -> None:
    """Write what the report of a record gives, and its outcome for what covers all records."""
    settings = study.settings
    if settings.histories:
        result = with_histories(result, settings.tolerance)
    rows = rows_of(result, record, study)
    of_pulses = settings_sha256(settings.only(MADE_FROM["pulses"]), {})  # by which their own step names them
    rows = replace(
        rows,
        record=[replace(row, settings_sha256=of_pulses) for row in rows.record],
        pulses=[replace(row, settings_sha256=of_pulses) for row in rows.pulses],
    )
    results = Path(settings.results)
    folder = results / record.id
    page: dict[str, Any] = {}
    spectra: Mapping[str, Sequence[float]] = {}
    with written_together():
        if settings.reports:
            from rocking.reports.design_figure import component_spectra  # matplotlib takes a second to import
            from rocking.reports.explore import RECORD_SCRIPT, cells_of, record_content, record_script
            from rocking.study.documents import made_or_failed

            result = with_histories(result, settings.tolerance, _drawn(result, rows))
            make = partial(write_report, result, rows, study, folder)
            faults = made_or_failed(folder / "report.pdf", make, log, settings.figures, record.id)
            rows = replace(rows, failures=[*rows.failures, *faults])
            content = record_content(result, rows, study.structures)
            write_whole(folder / RECORD_SCRIPT, record_script(content))
            page = cells_of(content)
            level = settings.design_spectrum.spectrum()
            if level is not None:
                spectra = component_spectra(result.accelerograms, level)
        write_tables({row_class: rows.tables[row_class] for row_class in TABLES["report"]}, folder)
        if settings.histories:
            histories = history_rows(record.id, result.responses)
            write_rows(HistoryRow, histories, folder / HistoryRow.table.file_name)
    tables = {row_class: list(of_it) for row_class, of_it in rows.tables.items()}
    sums = {path: sha256 for step in STEPS for path, sha256 in sums_of(step, settings, record.id).items()}
    keep(outcome_of(results, record.id), Kept(tables, page=page, spectra=spectra, sums=sums))
    tell(f"{record.id}: {record_line(rows.verdicts, rows.failures)}")


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
    """Write report.pdf of one record into `folder`, next to the tables that it names."""
    from rocking.reports.pages import Page
    from rocking.reports.printing import write_document  # matplotlib takes a second to import
    from rocking.reports.record import RecordReport, failure_page

    if rows.comparison:
        level = study.settings.design_spectrum.spectrum()
        page: Page = RecordReport(
            result, rows, study.structures, study.settings.for_pages, level, study.warnings
        ).page()
    else:
        page = failure_page(result.record, " ".join(failure.message for failure in rows.failures))
    write_document(folder / "report.pdf", page, study.settings.figures)


def assess_catalogued(record: CatalogueRecord, study: Study, opened: Opened | None = None) -> RecordResult:
    """Read and assess `record`; one that cannot be read has a failure instead. opened: its components, if they were
    read."""
    clock = Clock()
    try:
        with clock.stage("read"):
            horizontal, vertical = opened or study.open(record)
    except RockingError as error:
        unread = Failure("read", error.without_place(record.id))
        return RecordResult(record=record.id, failures=(("", unread),), durations=dict(clock.durations))
    return study.assessor(None, clock).assess(record.id, horizontal, study.scenes, vertical)


def rows_of(result: RecordResult, record: CatalogueRecord, study: Study) -> RecordRows:
    """Return what the tables of a study hold of a record."""
    vertical = study.settings.vertical
    place = record.epicentre
    epicentre = place if isinstance(place, Coordinates) else None
    return rows_of_record(result, study.settings_sha256, record.licence, vertical, epicentre)
