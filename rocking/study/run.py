"""A study: many records against one list of structures, each record in its own folder of tables."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Any, Literal

from rocking.assessment import columns, rows
from rocking.assessment.assess import Assessment, AssessmentSettings, Case, Failure, assess
from rocking.assessment.variations import candidates, processed, processed_variants
from rocking.errors import RockingError
from rocking.pulses import PulseSettings
from rocking.records import Accelerogram
from rocking.records.catalogue import CatalogueRecord, open_record
from rocking.records.processing import UNPROCESSED_DEFAULT, Processing, process
from rocking.records.vertical import aligned, open_vertical
from rocking.structures import Structure, load_structures
from rocking.tables import Row, write_table


@dataclass(frozen=True)
class Study:
    """What every record of a study is put through.

    structures: by name. mirror: a folder that holds the files of remote records, or None.
    candidates: heights tried for the hinge of a wall or the crack of a spire, 0 for none.
    processing_variants: whether every structure also meets the record processed otherwise.
    vertical: whether the vertical component acts too, where there is one.
    process: which records are processed: those whose file says they are raw, all, or none; processing: how.
    settings_sha256: names the settings, the structure list and the package in every row.
    """

    structures: Mapping[str, Structure]
    settings: AssessmentSettings
    settings_sha256: str
    mirror: Path | None = None
    candidates: int = 19
    processing_variants: bool = True
    vertical: bool = False
    process: Literal["raw", "always", "never"] = "raw"
    processing: Processing = UNPROCESSED_DEFAULT

    def open(self, record: CatalogueRecord) -> tuple[list[Accelerogram], Accelerogram | None]:
        """Return the horizontal components of `record` and, where it is asked for and there is one, its vertical one.

        Raises RecordError naming the record, also when the vertical component does not fit the others.
        """
        accelerograms = [self._processed(a) for a in open_record(record, mirror=self.mirror)]
        vertical = open_vertical(record, mirror=self.mirror) if self.vertical else None
        vertical = None if vertical is None else self._processed(vertical)
        if vertical is not None:
            for accelerogram in accelerograms:
                aligned(vertical, accelerogram)
        return accelerograms, vertical

    def _processed(self, accelerogram: Accelerogram) -> Accelerogram:
        raw = accelerogram.processed is False or (self.process == "always")
        return process(accelerogram, self.processing) if raw and self.process != "never" else accelerogram

    @classmethod
    def from_settings(cls, settings: Mapping[str, Any], structures: Path, sha256: str) -> "Study":
        """Return the study that checked `settings` and the structure list in `structures` describe."""
        pulse = settings["pulse"]
        assessment = AssessmentSettings(
            acceleration_scale=settings["acceleration_scale"],
            tolerance=settings["tolerance"],
            fragility_change=settings["fragility_change"],
            fidelity=settings["fidelity"],
            fidelity_tolerance=settings["fidelity_tolerance"],
            fidelity_risk=settings["fidelity_risk"],
            friction_coefficient=settings["friction_coefficient"],
            bootstrap_replicates=pulse["bootstrap_replicates"],
            pulse_choice=pulse["choice"],
            pulse=PulseSettings(
                lowest_frequency=pulse["lowest_frequency_hz"],
                highest_frequency=pulse["highest_frequency_hz"],
                per_octave=pulse["frequencies_per_octave"],
            ),
        )
        mirror = settings["mirror"]
        return cls(
            load_structures(structures),
            assessment,
            sha256,
            Path(mirror) if mirror else None,
            settings["candidates"],
            settings["processing_variants"],
            settings["vertical"],
            settings["processing"]["apply"],
            _processing(settings["processing"]),
        )


def _processing(settings: Mapping[str, Any]) -> Processing:
    return Processing(
        pre_event=settings["pre_event_s"],
        baseline=settings["baseline"],
        taper=settings["taper"],
        high_pass=settings["high_pass_hz"],
        low_pass=settings["low_pass_hz"],
    )


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
    tables: dict[str, list[Row]] = {table.name: [] for table in columns.PER_RECORD}
    try:
        accelerograms, vertical = study.open(record)
    except RockingError as error:
        tables["failures"] = [rows.failure_row(record.id, "", Failure("read", "", str(error)))]
        accelerograms, vertical = [], None
    durations = {"read": process_time() - started}
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
    assessment = assess(accelerogram, study.structures, study.settings, beside)
    identity = rows.Identity(record.id, accelerogram, study.settings_sha256)
    made = rows.all_rows(identity, assessment, study.settings, record.licence, beside)
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
    records = processed(record) if study.processing_variants else {}
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
    found = candidates(structure, identity.accelerogram, pulse, study.candidates, study.settings)
    made["candidates"] += rows.candidate_rows(identity, case.structure, found)
    variants = processed_variants(structure, records, study.settings)
    made["processing"] += rows.processing_rows(identity, case.structure, variants)
