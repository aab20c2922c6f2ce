"""Measure error against time: snakemake.* onto rocking.calibration.accuracy."""

from pathlib import Path

from rocking.calibration.accuracy import TradeSettings, write_trade
from rocking.records import load_catalogue
from rocking.reports.summary.trade_figures import write_trade_figure
from rocking.study.run import Study

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
