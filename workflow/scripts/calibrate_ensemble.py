"""Hold ensembles against random draws: snakemake.* onto rocking.calibration.ensembles."""

from pathlib import Path

from rocking.calibration.ensembles import EnsembleTrial, write_ensemble_accuracy
from rocking.records import load_catalogue, open_record
from rocking.reports.summary.reliability_figure import write_reliability
from rocking.structures import load_structures
from rocking.study.progress import numbered
from rocking.tables import frame

if __name__ == "__main__":
    files, mirror = snakemake.input, snakemake.params.mirror
    listed, log = load_catalogue(Path(files.catalogue)), Path(snakemake.log[0])
    records = (
        (record.id, accelerogram)
        for record in numbered(listed, [record.id for record in listed], log)
        for accelerogram in open_record(record, mirror=mirror)
    )
    folder = Path(snakemake.output[0]).parent
    write_ensemble_accuracy(records, load_structures(Path(files.structures)), folder)
    write_reliability(frame(EnsembleTrial, folder / EnsembleTrial.table.file_name), Path(snakemake.output[2]))
