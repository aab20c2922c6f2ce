"""Measure error against time: snakemake.* onto rocking.assessment.trade."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from functools import partial
from pathlib import Path

import numpy as np

from rocking.assessment.rows import FailureRow, TradeRow
from rocking.assessment.trade import trade
from rocking.errors import RockingError
from rocking.reports.trade import write_trade_report
from rocking.study.job import begin_job, costs_no_other
from rocking.study.results import keep_rows
from rocking.study.summary import write_beside
from rocking.tables import write_tables

MOST_RECORDS = 70
"""Records that are tried, spread evenly over the catalogue."""


def components(study, records, tell, tried, net):
    """Yield the components of each record that is tried, which is then the last of those in `tried`."""
    places = np.unique(np.linspace(0, len(records) - 1, min(MOST_RECORDS, len(records))).astype(int))
    for number, place in enumerate(places, start=1):
        opened = []
        try:
            tried.append(records[place].id)
            with net():
                opened = study.open(records[place])[0]
            tell(f"{number} of {len(places)}: {records[place].id}", number, len(places))
        except RockingError as error:
            tell(f"{number} of {len(places)}: {records[place].id}: {error}")
        yield from opened


if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    output, study = snakemake.output, job.study
    folder = Path(output.pdf).parent
    rows = {TradeRow: [], FailureRow: []}
    tried = [""]

    def net(structure=""):
        return costs_no_other(rows[FailureRow], job.log, "the trade", structure, tried[-1])

    # The methods are compared on records: what stands on a support is taken on the ground.
    motions = components(study, job.records, job.tell, tried, net)
    rows[TradeRow] += trade(motions, study.structures, settings=study.settings, tell=job.tell, within=net)
    write_tables({TradeRow: rows[TradeRow]}, folder, "rocking-trade", "trade.json")
    write_beside(partial(write_trade_report, rows), Path(output.pdf), Path(output.svg), job, rows[FailureRow])
    keep_rows(Path(output.rows), rows)
    job.finish(output)
