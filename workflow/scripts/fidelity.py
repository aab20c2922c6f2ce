"""Find how far the cheap methods may be trusted: snakemake.* onto rocking.calibration.fidelity."""

from pathlib import Path

from rocking.calibration.fidelity import write_fidelity
from rocking.records import load_catalogue, open_record
from rocking.structures import load_structures

if __name__ == "__main__":
    files, mirror = snakemake.input, snakemake.params.mirror
    records = (
        (record.id, accelerogram)
        for record in load_catalogue(Path(files.catalogue))
        for accelerogram in open_record(record, mirror=mirror)
    )
    folder = Path(snakemake.output[0]).parent
    report = write_fidelity(records, load_structures(Path(files.structures)), folder)
    Path(snakemake.log[0]).write_text("\n".join(map(str, report)) + "\n", encoding="utf-8")
