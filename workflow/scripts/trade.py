"""Measure error against time: snakemake.* onto rocking.calibration.trade."""

from pathlib import Path

from rocking.calibration.trade import write_trade
from rocking.records import load_catalogue
from rocking.reports.trade.report import write_trade_report
from rocking.study.config_file import read_settings
from rocking.study.inputs import planned_structures
from rocking.study.progress import line_writer
from rocking.study.run import Study

if __name__ == "__main__":
    params, output = snakemake.params, snakemake.output
    settings = read_settings(snakemake.config)
    study = Study(planned_structures(Path(settings.structures), params.structures_sha256), settings)
    records = {
        record.id: lambda record=record: study.open(record)[0]
        for record in load_catalogue(Path(settings.catalogue))
    }
    folder, tell = Path(output.pdf).parent, line_writer(Path(snakemake.log[0]))
    write_trade(
        records, study.structures, settings.error_against_time, folder, tell, params.intensity_measure
    )
    write_trade_report(folder, Path(output.pdf), Path(output.svg))
