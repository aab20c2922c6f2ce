"""Measure how far one pulse may be trusted: snakemake.* onto rocking.calibration.lights."""

from pathlib import Path

from rocking.calibration.lights import write_calibration
from rocking.records import load_catalogue, open_record
from rocking.structures import load_structures
from rocking.study.progress import numbered

if __name__ == "__main__":
    files, mirror = snakemake.input, snakemake.params.mirror
    listed, log = load_catalogue(Path(files.catalogue)), Path(snakemake.log[0])
    records = (
        (record.id, accelerogram)
        for record in numbered(listed, [record.id for record in listed], log)
        for accelerogram in open_record(record, mirror=mirror)
    )
    thresholds = write_calibration(
        records, load_structures(Path(files.structures)), Path(snakemake.output[0]).parent
    )
    with log.open("a", encoding="utf-8") as stream:
        print(thresholds, file=stream)
