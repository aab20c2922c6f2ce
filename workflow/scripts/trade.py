"""Measure error against time: snakemake.* onto rocking.trade."""

from pathlib import Path

from rocking.records import load_catalogue
from rocking.reports.trade_figures import write_trade_figure
from rocking.study import Study
from rocking.trade import TradeSettings, write_trade

if __name__ == "__main__":
    files, config, output = snakemake.input, snakemake.config, snakemake.output
    study = Study.from_settings(config, Path(files.structures), "")
    records = {
        record.id: lambda record=record: study.open(record)[0]
        for record in load_catalogue(Path(files.catalogue))
    }
    settings = TradeSettings(**config["trade"], assessment=study.settings)
    write_trade(records, study.structures, settings, Path(output.table), Path(snakemake.log[0]))
    write_trade_figure(Path(output.table), Path(output.pdf), Path(output.svg))
