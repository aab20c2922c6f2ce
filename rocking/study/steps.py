"""The five steps of a record, each from the files of those before it to files of its own.

| step | gives |
|---|---|
| read | motion.mseed and motion.json: the motion as it acts, and all that is known of it |
| pulses | record.csv, pulses.csv; pulses.json |
| predict | predictions.csv; predictions.json |
| integrate | the cases, which the next run looks up as well |
| report | all other tables, report.pdf, and the outcome for what is made of all records |

What a step computes it stores to the last bit, and those after it look it up there: each asks the
one before it for its result.
"""

import errno
import json
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from traceback import print_exception
from typing import Any

from rocking.assessment.assessor import Assessor
from rocking.assessment.case import Failure, Prediction, RecordResult
from rocking.assessment.motions import Component
from rocking.assessment.one_case import Clock
from rocking.assessment.rows import PredictionRow, identities_of, prediction_row
from rocking.assessment.store import LARGEST, RecordStore, decoded, encoded
from rocking.catalogue import CatalogueRecord
from rocking.errors import RockingError, fault_in_words
from rocking.records import Accelerogram
from rocking.study.job import Opened, Study, rows_of, write_record
from rocking.study.kept import undamaged
from rocking.study.miniseed import miniseed_of, samples_in
from rocking.study.outputs import STEPS, TABLES, store_of, times_of
from rocking.tables import Row, read_whole, write_tables, write_whole, written_together

_OF_THE_DISK = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS)
"""Errors of writing alone: a file that cannot be read costs its own record, and no other."""


def of_the_machine(error: BaseException) -> bool:
    """Whether memory or the disk is at fault, which ends a job, so that the next run does it again."""
    cause = error.__cause__ if isinstance(error, RockingError) else error
    return isinstance(cause, MemoryError) or (isinstance(cause, OSError) and cause.errno in _OF_THE_DISK)


@dataclass(frozen=True)
class Steps:
    """The steps of one record.

    study: with the settings and structures from which the step is made. log: of the job.
    """

    record: CatalogueRecord
    study: Study
    log: Path
    clock: Clock = field(default_factory=Clock)

    def take(self, step: str) -> None:
        """Do a step; where it gives nothing its files are empty, and those of the last step say why.

        Whatever goes wrong with a record costs no other. What goes wrong with the machine, a full disk, too little
        memory or a folder that is gone, ends the job.
        """
        try:
            failure = None if step == "read" else self._why_unread
            if failure is None:
                getattr(self, step)()
                return
        except Exception as error:
            if isinstance(error, OSError) or of_the_machine(error):
                raise
            if isinstance(error, RockingError):
                failure = Failure("read", error.without_place(self.record.id))
            else:  # which the last step meets as well
                print_exception(error)
                failure = Failure("fault", fault_in_words(error, self.log))
        if step == "read":
            self._hand_on([], {"failure": encoded(failure)})
        elif step == "report":
            self._write(RecordResult(record=self.record.id, failures=(("", failure),)))
        else:
            write_tables({row_class: [] for row_class in TABLES[step]}, self._folder)
            self._store(step).stand()

    def read(self) -> None:
        """Read the files of the record, by obspy or by a reader of ours where it has none, and process them."""
        with self.clock.stage("read"):
            horizontal, vertical = self.study.open(self.record)
        channels = [*horizontal, *([] if vertical is None else [vertical])]
        facts = [
            {name: value for name, value in encoded(channel).items() if name != "acceleration"}
            for channel in channels
        ]
        self._hand_on(channels, {"channels": facts, "vertical": vertical is not None})

    def pulses(self) -> None:
        """Extract the sine pulses that dominate each component."""
        store = self._store("pulses")
        components, _ = self._components(store)
        rows = rows_of(self._result(components), self.record, self.study).tables
        self._keep(store, {row_class: rows[row_class] for row_class in TABLES["pulses"]})

    def predict(self) -> None:
        """Predict the largest rotation of each structure by the closed form of its equivalent block."""
        store = self._store("predict")
        components, _ = self._components(store)
        identities = identities_of(self._result(components), self.study.settings_sha256)
        predictions = self._assessor(store).predict(components, self.study.scenes)
        rows = [
            prediction_row(identities[component], structure, found)
            for (structure, component), found in predictions.items()
            if isinstance(found, Prediction)
        ]
        self._keep(store, {PredictionRow: rows})

    def integrate(self) -> None:
        """Follow each structure, and its members, through the whole record."""
        store = self._store("integrate")
        self._integrated(store)
        self._keep(store, {})
        store.stand()

    def report(self) -> None:
        """Compare prediction and integration, decide on each structure, and write the tables and the report."""
        self._write(self._integrated(self._store("integrate")))

    # Each from the files of those before it ---------------------------------------------------------------

    def _components(self, store: RecordStore) -> tuple[tuple[Component, ...], Accelerogram | None]:
        horizontal, vertical = self._motion
        return self._assessor(store).pulses(horizontal, vertical), vertical

    def _integrated(self, store: RecordStore) -> RecordResult:
        assessor = self._assessor(store)
        components, vertical = self._components(store)
        predictions = assessor.predict(components, self.study.scenes)
        return assessor.compare(
            assessor.integrate(self.record.id, components, self.study.scenes, predictions, vertical)
        )

    def _assessor(self, store: RecordStore) -> Assessor:
        return self.study.assessor(store, self.clock)

    def _result(self, components: tuple[Component, ...]) -> RecordResult:
        return RecordResult(record=self.record.id, components=components)

    # The files --------------------------------------------------------------------------------------------

    @property
    def _results(self) -> Path:
        return Path(self.study.settings.results)

    @property
    def _folder(self) -> Path:
        return self._results / self.record.id

    @property
    def _read_times(self) -> Path:
        return times_of(self._results, "read", self.record.id)

    def _store(self, step: str) -> RecordStore:
        """The results of a step, in which those of the steps before it are looked up."""
        former = [self._store(other) for other in STEPS[1 : STEPS.index(step)][-1:]]
        path = store_of(self._results, step, self.record.id)
        return RecordStore(path, print, times_of(self._results, step, self.record.id), former)

    def _keep(self, store: RecordStore, tables: dict[type[Row], Any]) -> None:
        with written_together():
            write_tables(tables, self._folder)
        store.save()

    def _write(self, result: RecordResult) -> None:
        """Write what comes of the record, with what it took to read it."""
        self.clock.add(json.loads(read_whole(self._read_times, LARGEST, RockingError)))
        result = replace(result, durations=dict(self.clock.durations))
        write_record(result, self.record, self.study, self.log)

    def _hand_on(self, channels: list[Accelerogram], facts: dict[str, Any]) -> None:
        """Write what is read, and apart from it what that took, which differs from run to run."""
        write_whole(self._folder / "motion.mseed", miniseed_of(channels))
        for path, content in (
            (self._folder / "motion.json", facts),
            (self._read_times, self.clock.durations),
        ):
            write_whole(path, json.dumps(content, separators=(",", ":")).encode())

    @cached_property
    def _facts(self) -> dict[str, Any]:
        path = self._folder / "motion.json"
        with undamaged(path):
            facts: dict[str, Any] = json.loads(read_whole(path, LARGEST, RockingError))
            return facts

    @property
    def _why_unread(self) -> Failure | None:
        return decoded(Failure, self._facts["failure"]) if "failure" in self._facts else None

    @property
    def _motion(self) -> Opened:
        channels = [
            decoded(Accelerogram, facts | {"acceleration": samples})
            for facts, samples in zip(
                self._facts["channels"], samples_in(self._folder / "motion.mseed"), strict=True
            )
        ]
        return (channels[:-1], channels[-1]) if self._facts["vertical"] else (channels, None)
