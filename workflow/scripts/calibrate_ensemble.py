"""Hold ensembles against random draws: snakemake.* onto rocking.calibration.ensembles."""

from pathlib import Path

from rocking.calibration.ensembles import EnsembleTrial, write_ensemble_accuracy
from rocking.records import load_catalogue, open_record
from rocking.reports.summary.reliability_figure import write_reliability
from rocking.structures import load_structures
from rocking.study.progress import line_writer
from rocking.tables import frame


def components(catalogue, mirror, tell):
    """Yield identifier and accelerogram of every component in the catalogue."""
    listed = load_catalogue(catalogue)
    for count, record in enumerate(listed, start=1):
        tell(f"{count} of {len(listed)}: {record.id}")
        for accelerogram in open_record(record, mirror=mirror):
            yield record.id, accelerogram


if __name__ == "__main__":
    params, folder = snakemake.params, Path(snakemake.output[0]).parent
    tell = line_writer(Path(snakemake.log[0]))
    near_fault, others = (components(Path(each), params.mirror, tell) for each in params.catalogues)
    write_ensemble_accuracy(near_fault, others, load_structures(Path(params.structures)), folder)
    trials = frame(EnsembleTrial, folder / EnsembleTrial.table.file_name)
    write_reliability(trials, Path(snakemake.output[2]))
