"""Fit and judge the tiers: snakemake.* onto rocking.calibration.tiers."""

from pathlib import Path

from rocking.calibration.tiers import write_tiers
from rocking.records import load_catalogue, open_record
from rocking.study.progress import line_writer


def components(catalogues, mirror, tell):
    """Yield identifier and accelerogram of every component in the catalogues."""
    listed = [record for catalogue in catalogues for record in load_catalogue(catalogue)]
    for count, record in enumerate(listed, start=1):
        tell(f"{count} of {len(listed)}: {record.id}")
        for accelerogram in open_record(record, mirror=mirror):
            yield record.id, accelerogram


if __name__ == "__main__":
    params, tell = snakemake.params, line_writer(Path(snakemake.log[0]))
    records = components(params.catalogues, params.mirror, tell)
    for score in write_tiers(records, Path(snakemake.output[0]).parent):
        tell(str(score))
