"""What accuracy costs, measured on the records and structures of a study; its document, and what is shown of it."""

import math
from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial
from textwrap import wrap

from rocking.assessment.cracks import cracked
from rocking.assessment.methods import Acts
from rocking.assessment.motions import GroundMotions, Motion, arrived
from rocking.assessment.rows import (
    ComparisonRow,
    FailureRow,
    RecordRow,
    VerdictRow,
    counted_apart,
    counted_cases,
    made_records,
    named_records,
)
from rocking.earthquakes.sample import ClusterSample
from rocking.errors import RockingError
from rocking.floors.support import Support
from rocking.products.trade.measure import TradeCase, trade_of_cases, what_follows
from rocking.products.trade.report import trade_panel, write_trade_report
from rocking.products.trade.rows import TradeMethod, TradeRow
from rocking.records import Accelerogram
from rocking.reports.pages import Panel
from rocking.structures import Structure
from rocking.study.documents import made_or_failed
from rocking.study.job import Job, Study, costs_no_other
from rocking.study.kept import Kept, Rows
from rocking.study.terminal import WIDTH
from rocking.study.work import Work
from rocking.tables import Row, rows_of, write_tables


class Trade(Work):
    """The error and the time of every method."""

    shown = (TradeRow,)

    def make(self, job: Job) -> Kept:
        """Measure the error and the time of every method, on records and structures of the study."""
        study = job.study
        folder = job.folder
        rows: dict[type[Row], list[Row]] = {TradeRow: [], FailureRow: []}
        tried = [""]
        motions_of: list[str] = []

        def net(structure: str = "") -> AbstractContextManager[None]:
            return costs_no_other(rows[FailureRow], job.log, "the trade", structure, tried[-1])

        read: list[RecordRow] = []
        cases: list[ComparisonRow] = []
        for outcome in job.outcomes():
            read += rows_of(RecordRow, outcome.rows)[:1]
            cases += counted_cases(rows_of(ComparisonRow, outcome.rows), rows_of(VerdictRow, outcome.rows))
        cases, _ = counted_apart(cases, made_records(read))
        names = named_records(read, study.settings.unnamed_events == "each")
        rows[TradeRow] += trade_of_cases(
            _met(study, job, cases, tried, motions_of, net),
            lambda: ClusterSample.named(names[record] for record in motions_of),
            study.structures,
            settings=study.settings,
            within=net,
        )
        write_tables({TradeRow: rows[TradeRow]}, folder, "rocking-trade", "trade.json")
        pdf, image, figures = folder / "trade.pdf", folder / "trade.svg", study.settings.figures
        make = partial(write_trade_report, rows, pdf, image, figures)
        rows[FailureRow] += made_or_failed(pdf, make, job.log, figures, image=image)
        return Kept(rows, lines=[*trade_lines(rows_of(TradeRow, rows))])

    def panel(self, rows: Rows) -> Panel | None:
        """Return the figure of error against time, and what follows."""
        return trade_panel(rows_of(TradeRow, rows))


def trade_lines(rows: Sequence[TradeRow]) -> Iterator[str]:
    """Yield the table of the trade of error for time over all structures, and what follows from it."""
    yield f"{'method':<26}  stations  cases  median error  wrong (unsafe)  ms a structure  ms a record"
    for row in rows:
        if row.structure == "":
            error = f"{100 * row.error:.2g} %" if row.error >= 0 else "–"
            wrong = f"{row.wrong_verdicts} ({row.unsafe_verdicts})"
            times = f"{1e3 * row.cpu_s:>14.2g}  {1e3 * row.preparation_record_s:>11.2g}"
            yield f"{row.method:<26}  {row.stations:>8}  {row.cases:>5}  {error:>12}  {wrong:>14}  {times}"
    for sentence in what_follows(rows):
        yield from wrap(sentence, WIDTH)
    if rows:
        yield f"Measured on {rows[0].machine}"


def _met(
    study: Study,
    job: Job,
    cases: Sequence[ComparisonRow],
    tried: list[str],
    motions_of: list[str],
    net: Callable[[], AbstractContextManager[None]],
) -> Iterator[tuple[GroundMotions, list[TradeCase]]]:
    """Yield the motions of one component, on the ground or a support, with the cases that meet it.

    The record that is opened is then the last of those in `tried`, and that of each motion is added to `motions_of`.
    """
    of_records: dict[str, list[ComparisonRow]] = {}
    for case in cases:
        if not (math.isnan(case.predicted_rotation_ratio) or math.isnan(case.integrated_rotation_ratio)):
            of_records.setdefault(case.record, []).append(case)
    records = [record for record in job.records if record.id in of_records]
    for number, record in enumerate(records, start=1):
        opened: list[Accelerogram] = []
        vertical = None
        try:
            tried.append(record.id)
            with net():
                opened, vertical = study.open(record)
            job.show_line(f"{number} of {len(records)}: {record.id}", number, len(records))
        except RockingError as error:
            job.show_line(f"{number} of {len(records)}: {record.id}: {error}")
        for component in opened:
            met: dict[Support | None, list[TradeCase]] = {}
            for case in of_records[record.id]:
                if case.component == component.component:
                    scene = study.scenes[case.structure]
                    support = scene.place.support_of(case.support_period_s)
                    met.setdefault(support, []).append(_case(case, scene.structure))
            for support, of_motion in met.items():
                motions_of.append(record.id)
                yield arrived(Motion((component,), vertical, support)), of_motion


def _case(case: ComparisonRow, structure: Structure) -> TradeCase:
    """A case of the agreement, with what the study has found of it."""
    found = {
        TradeMethod.PRINTED: case.printed_rotation_ratio,
        TradeMethod.ONE_SINE: case.predicted_rotation_ratio,
        TradeMethod.BLOCK: case.block_on_record_rotation_ratio,
    }
    return TradeCase(
        structure=case.structure,
        mechanism=cracked(structure, case.crack).mechanism(),
        reference=case.integrated_rotation_ratio,
        fall_time=case.fall_time_s,
        found=found,
        is_late=case.pulse_acts is Acts.AFTER,
    )
