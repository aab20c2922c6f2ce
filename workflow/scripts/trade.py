"""Measure error against time: snakemake.* onto rocking.assessment.trade."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from pathlib import Path

import numpy as np

from rocking.assessment.rows import TradeRow
from rocking.assessment.trade import trade
from rocking.errors import RockingError
from rocking.reports.trade import write_trade_report
from rocking.study.job import begin_job
from rocking.study.results import keep_rows
from rocking.tables import write_tables

MOST_RECORDS = 70
"""Records that are tried, spread evenly over the catalogue."""


def components(study, records, tell):
    """Yield the components of each record that is tried."""
    places = np.unique(np.linspace(0, len(records) - 1, min(MOST_RECORDS, len(records))).astype(int))
    for number, place in enumerate(places, start=1):
        try:
            yield from study.open(records[place])[0]
            tell(f"{number} of {len(places)}: {records[place].id}", number, len(places))
        except RockingError as error:
            tell(f"{number} of {len(places)}: {records[place].id}: {error}")


if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    output, study = snakemake.output, job.study
    folder = Path(output.pdf).parent
    # The methods are compared on records: what stands on a support is taken on the ground.
    tried = components(study, job.records, job.tell)
    rows = trade(tried, study.structures, settings=study.settings, tell=job.tell)
    write_tables({TradeRow: rows}, folder, "rocking-trade", "trade.json")
    keep_rows(Path(output.rows), {TradeRow: rows})
    write_trade_report(rows, Path(output.pdf), Path(output.svg), study.settings.figures)
    job.finish(output)
