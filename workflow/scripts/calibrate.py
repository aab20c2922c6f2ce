"""Fit and judge the tiers: snakemake.* onto rocking.calibration.tiers."""

from pathlib import Path

from rocking.calibration.tiers import write_tiers
from rocking.records import load_catalogue
from rocking.records.catalogue import open_records
from rocking.study.progress import line_writer

if __name__ == "__main__":
    params, tell = snakemake.params, line_writer(Path(snakemake.log[0]))
    listed = [record for catalogue in params.catalogues for record in load_catalogue(catalogue)]
    records = open_records(listed, params.mirror, tell)
    for score in write_tiers(records, Path(snakemake.output[0]).parent):
        tell(str(score))
