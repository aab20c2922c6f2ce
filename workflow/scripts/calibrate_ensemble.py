"""Hold ensembles against random draws: snakemake.* onto rocking.calibration.ensembles."""

from pathlib import Path

from rocking.calibration.ensembles import EnsembleTrial, write_ensemble_accuracy
from rocking.records import load_catalogue
from rocking.records.catalogue import open_records
from rocking.reports.summary.reliability_figure import write_reliability
from rocking.structures import load_structures
from rocking.study.progress import line_writer
from rocking.tables import frame

if __name__ == "__main__":
    params, folder = snakemake.params, Path(snakemake.output[0]).parent
    tell = line_writer(Path(snakemake.log[0]))
    catalogues = map(load_catalogue, params.catalogues)
    near_fault, others = (open_records(listed, params.mirror, tell) for listed in catalogues)
    write_ensemble_accuracy(near_fault, others, load_structures(Path(params.structures)), folder)
    trials = frame(EnsembleTrial, folder / EnsembleTrial.table.file_name)
    write_reliability(trials, Path(snakemake.output[2]))
