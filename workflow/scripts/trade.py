"""Measure error against time: snakemake.* onto rocking.assessment.trade."""

from pathlib import Path

import numpy as np

from rocking.assessment.rows.of_trade import TradeRow
from rocking.assessment.trade import trade
from rocking.errors import RockingError
from rocking.records import load_catalogue
from rocking.reports.trade import write_trade_report
from rocking.study.config_file import read_settings
from rocking.study.inputs import planned_structures
from rocking.study.progress import line_writer
from rocking.study.run import Study
from rocking.tables import write_tables

MOST_RECORDS = 70
"""Records that are tried, spread evenly over the catalogue."""


def opened(study, catalogue, tell):
    """Yield the components of each record that is tried."""
    listed = load_catalogue(catalogue)
    places = np.unique(np.linspace(0, len(listed) - 1, min(MOST_RECORDS, len(listed))).astype(int))
    for number, place in enumerate(places, start=1):
        try:
            yield from study.open(listed[place])[0]
            tell(f"{number} of {len(places)}: {listed[place].id}")
        except RockingError as error:
            tell(f"{number} of {len(places)}: {listed[place].id}: {error}")


if __name__ == "__main__":
    params, output = snakemake.params, snakemake.output
    settings, tell = read_settings(snakemake.config), line_writer(Path(snakemake.log[0]))
    study = Study(planned_structures(Path(settings.structures), params.structures_sha256), settings)
    records, folder = opened(study, Path(settings.catalogue), tell), Path(output.pdf).parent
    rows = trade(records, study.structures, settings=settings, tell=tell)
    write_tables({TradeRow: rows}, folder, "rocking-trade", "trade.json")
    write_trade_report(folder, Path(output.pdf), Path(output.svg))
