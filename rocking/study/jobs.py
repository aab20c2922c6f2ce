"""The jobs of a study, one function for each rule of the workflow: what it does with the task that it is handed."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial

import numpy as np

from rocking.assessment.cores import on_cores
from rocking.assessment.rows import FailureRow, MechanismRow, RecordRow, TradeRow, VerdictRow
from rocking.assessment.trade import trade as measure_trade
from rocking.errors import RockingError
from rocking.records import Accelerogram, CatalogueRecord
from rocking.reports.printing import faults_in_words
from rocking.reports.trade import write_trade_report
from rocking.study.job import Study, begin_job, costs_no_other, steps_of
from rocking.study.kept import keep_rows
from rocking.study.outcomes import read_outcomes
from rocking.study.summary import summarise, write_beside, write_fragility
from rocking.study.task import Task
from rocking.tables import Row, write_tables

MOST_RECORDS = 70
"""Records that the trade tries, spread evenly over the catalogue."""


def record(task: Task) -> None:
    """Take the records of a task through the five steps, each on what the one before it gave."""
    with begin_job(task) as job, on_cores(task.cores):
        for each in job.records:
            with steps_of(each, job) as step:
                motion = step.read()  # 1: by obspy, or by a reader of ours where it has none
                components = step.pulses(motion)  # 2: the sine pulses that dominate it
                predictions = step.predict(components)  # 3: the closed form of each equivalent block
                responses = step.integrate(motion, components, predictions)  # 4: under the whole record
                step.compare(responses)  # 5: and decide, report and keep the outcome


batch = record
"""Many records, one after another in one process: a start costs as much as twenty of them without reports."""


def summary(task: Task) -> None:
    """Write what stands over all records, and remove what no product of the study owns any more."""
    with begin_job(task) as job:
        summarise(job)


def checks(task: Task) -> None:
    """Check every structure at the design level of the study."""
    # The other jobs run without the folder of the codes.
    from rocking.codes.rows import CodeCheckRow
    from rocking.study.checks import write_checks

    with begin_job(task) as job:
        rows = [outcome.rows for outcome in read_outcomes(job.plan.outcomes())]
        verdicts = [row for each in rows for row in each[VerdictRow] if isinstance(row, VerdictRow)]
        records = [row for each in rows for row in each[RecordRow] if isinstance(row, RecordRow)]
        mechanisms = [row for each in rows for row in each[MechanismRow] if isinstance(row, MechanismRow)]
        checked = write_checks(job.study, job.results / "summary", verdicts, records, job.tell, mechanisms)
        keep_rows(job.kept, {CodeCheckRow: checked}, job.made_by_hand)


def fragility(task: Task) -> None:
    """Scale the records until the structures overturn."""
    # The other jobs run without the folder of the fragility.
    from rocking.fragility.rows import FragilityRow
    from rocking.reports.fragility import write_fragility_report

    with begin_job(task) as job:
        folder = job.results / "fragility"
        rows, reasons = write_fragility(job.records, job.study, folder, job.tell, job.log)
        write = partial(write_fragility_report, rows) if rows[FragilityRow] else None
        write_beside(write, folder / "fragility.pdf", folder / "fragility.svg", job, rows[FailureRow])
        keep_rows(job.kept, rows, job.made_by_hand)
        job.tell("\n".join([*reasons, *faults_in_words(rows)]) or "All records were used.")


def trade(task: Task) -> None:
    """Measure the error and the time of every method, on records and structures of the study."""
    with begin_job(task) as job:
        study = job.study
        folder = job.results / "summary"
        rows: dict[type[Row], list[Row]] = {TradeRow: [], FailureRow: []}
        tried = [""]

        def net(structure: str = "") -> AbstractContextManager[None]:
            return costs_no_other(rows[FailureRow], job.log, "the trade", structure, tried[-1])

        # The methods are compared on records: what stands on a support is taken on the ground.
        motions = _components(study, job.records, job.tell, tried, net)
        rows[TradeRow] += measure_trade(
            motions, study.structures, settings=study.settings, tell=job.tell, within=net
        )
        write_tables({TradeRow: rows[TradeRow]}, folder, "rocking-trade", "trade.json")
        write = partial(write_trade_report, rows)
        write_beside(write, folder / "trade.pdf", folder / "trade.svg", job, rows[FailureRow])
        keep_rows(job.kept, rows, job.made_by_hand)


def _components(
    study: Study,
    records: Sequence[CatalogueRecord],
    tell: Callable[..., None],
    tried: list[str],
    net: Callable[[], AbstractContextManager[None]],
) -> Iterator[Accelerogram]:
    """Yield the components of each record that is tried, which is then the last of those in `tried`."""
    places = np.unique(np.linspace(0, len(records) - 1, min(MOST_RECORDS, len(records))).astype(int))
    for number, place in enumerate(places, start=1):
        opened: list[Accelerogram] = []
        try:
            tried.append(records[place].id)
            with net():
                opened = study.open(records[place])[0]
            tell(f"{number} of {len(places)}: {records[place].id}", number, len(places))
        except RockingError as error:
            tell(f"{number} of {len(places)}: {records[place].id}: {error}")
        yield from opened
