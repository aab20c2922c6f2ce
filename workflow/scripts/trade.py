"""Measure error against time: snakemake.* onto rocking.calibration.accuracy."""

from pathlib import Path

from rocking.calibration.accuracy import write_trade
from rocking.records import load_catalogue
from rocking.reports.summary.trade_figures import write_trade_figure
from rocking.structures import load_structures
from rocking.study.config_file import read_settings
from rocking.study.run import Study

if __name__ == "__main__":
    files, output = snakemake.input, snakemake.output
    settings = read_settings(snakemake.config)
    study = Study(load_structures(files.structures), settings)
    records = {
        record.id: lambda record=record: study.open(record)[0]
        for record in load_catalogue(Path(files.catalogue))
    }
    write_trade(
        records, study.structures, settings.error_against_time, Path(output.table), Path(snakemake.log[0])
    )
    write_trade_figure(Path(output.table), Path(output.pdf), Path(output.svg))
