"""Measure the fragility of a study: snakemake.* onto rocking.study.summary."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from pathlib import Path

from rocking.reports.fragility import write_fragility_report
from rocking.study.job import begin_job
from rocking.study.results import keep_rows
from rocking.study.summary import OPENQUAKE, write_fragility

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    output = snakemake.output
    folder = Path(output.pdf).parent
    rows, reasons = write_fragility(job.records, job.study, folder, job.tell)
    keep_rows(Path(output.rows), rows)
    write_fragility_report(rows, Path(output.pdf), Path(output.svg), job.study.settings.figures)
    job.tell("\n".join(reasons) or "All records were used.")
    model = folder / OPENQUAKE
    job.finish([*output, *([model] if model.is_file() else [])])
