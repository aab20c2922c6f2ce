"""Fit and judge the tiers: snakemake.* onto rocking.calibration.tiers."""

from pathlib import Path

from rocking.calibration.tiers import write_tiers
from rocking.records import load_catalogue, open_record
from rocking.study.progress import numbered

if __name__ == "__main__":
    mirror, log = snakemake.params.mirror, Path(snakemake.log[0])
    listed = [each for path in snakemake.input.catalogues for each in load_catalogue(Path(path))]
    records = (
        (record.id, accelerogram)
        for record in numbered(listed, [record.id for record in listed], log)
        for accelerogram in open_record(record, mirror=mirror)
    )
    scores = write_tiers(records, Path(snakemake.output[0]).parent)
    with log.open("a", encoding="utf-8") as stream:
        print(*scores, sep="\n", file=stream)
