"""What accuracy costs, measured on the records and structures of a study; its document, and what is shown of it."""

from collections.abc import Callable, Iterator, Sequence
from contextlib import AbstractContextManager
from functools import partial
from textwrap import wrap

import numpy as np

from rocking.assessment.rows import FailureRow
from rocking.catalogue import CatalogueRecord
from rocking.errors import RockingError
from rocking.products.trade.measure import trade, what_follows
from rocking.products.trade.report import trade_panel, write_trade_report
from rocking.products.trade.rows import TradeRow
from rocking.records import Accelerogram
from rocking.reports.pages import Panel
from rocking.study.job import Job, Study, costs_no_other
from rocking.study.kept import Rows
from rocking.study.terminal import WIDTH
from rocking.study.work import Made, Work, write_documents
from rocking.tables import Row, rows_of, write_tables

MOST_RECORDS = 70
"""Records that the trade tries, spread evenly over the catalogue."""


class Trade(Work):
    """The error and the time of every method."""

    shown = (TradeRow,)

    def make(self, job: Job) -> Made:
        """Measure the error and the time of every method, on records and structures of the study."""
        study = job.study
        folder = job.folder
        rows: dict[type[Row], list[Row]] = {TradeRow: [], FailureRow: []}
        tried = [""]

        def net(structure: str = "") -> AbstractContextManager[None]:
            return costs_no_other(rows[FailureRow], job.log, "the trade", structure, tried[-1])

        # The methods are compared on records: what stands on a support is taken on the ground.
        motions = _components(study, job.records, job.show_line, tried, net)
        rows[TradeRow] += trade(
            motions,
            study.structures,
            settings=study.settings,
            tell=job.show_line,
            within=net,
            each_unnamed=study.settings.unnamed_events == "each",
        )
        write_tables({TradeRow: rows[TradeRow]}, folder, "rocking-trade", "trade.json")
        write = partial(write_trade_report, rows)
        write_documents(write, folder / "trade.pdf", folder / "trade.svg", job, rows[FailureRow])
        return Made(rows)

    def panel(self, rows: Rows) -> Panel | None:
        """Return the figure of error against time, and what follows."""
        return trade_panel(rows_of(TradeRow, rows))

    def lines(self, rows: Rows) -> Iterator[str]:
        """Yield the table over all structures, and what follows from it."""
        return trade_lines(rows_of(TradeRow, rows))


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
