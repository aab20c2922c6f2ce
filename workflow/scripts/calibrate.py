"""Measure how far one pulse may be trusted: snakemake.* onto rocking.calibration.lights."""

from pathlib import Path

from rocking.calibration.lights import write_calibration
from rocking.records import load_catalogue, open_record
from rocking.structures import load_structures

if __name__ == "__main__":
    files, mirror = snakemake.input, snakemake.params.mirror
    records = (
        (record.id, accelerogram)
        for record in load_catalogue(Path(files.catalogue))
        for accelerogram in open_record(record, mirror=mirror)
    )
    thresholds = write_calibration(
        records, load_structures(Path(files.structures)), Path(snakemake.output[0]).parent
    )
    Path(snakemake.log[0]).write_text(f"{thresholds}\n", encoding="utf-8")
