"""Run the same cases through every code: snakemake.* onto rocking.calibration.comparison and its report."""

from pathlib import Path

from rocking.calibration.comparison.cases import RECORDS
from rocking.calibration.comparison.write import write_comparison
from rocking.records import load_catalogue, open_record
from rocking.reports.comparison.report import comparison_report
from rocking.tables import write_whole

if __name__ == "__main__":
    pdf, mirror = Path(snakemake.output.pdf), snakemake.params.mirror
    listed = load_catalogue(Path(snakemake.input.catalogue))
    records = [open_record(record, mirror=mirror)[0] for record in listed[: RECORDS // 3]]
    write_comparison(records, pdf.parent, Path(snakemake.log[0]), snakemake.params.share)
    write_whole(pdf, comparison_report(pdf.parent))
