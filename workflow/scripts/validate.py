"""Hold predictions against shake-table tests: snakemake.* onto rocking.calibration.validation and its report."""

from pathlib import Path

from rocking.calibration.validation.write import write_validation
from rocking.reports.validation.report import validation_report
from rocking.study.progress import line_writer
from rocking.tables import write_whole

if __name__ == "__main__":
    mirror, pdf = snakemake.params.mirror, Path(snakemake.output.pdf)
    tell = line_writer(Path(snakemake.log[0]))
    write_validation(Path(snakemake.input.catalogue), Path(mirror) if mirror else None, pdf.parent, tell=tell)
    write_whole(pdf, validation_report(pdf.parent))
