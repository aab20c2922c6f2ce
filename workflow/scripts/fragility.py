"""Measure the fragility of a study: snakemake.* onto rocking.study.summary."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from functools import partial
from pathlib import Path

from rocking.assessment.rows import FailureRow
from rocking.fragility.rows import FragilityRow
from rocking.reports.fragility import write_fragility_report
from rocking.reports.printing import faults_in_words
from rocking.study.job import begin_job
from rocking.study.results import keep_rows
from rocking.study.summary import OPENQUAKE, write_beside, write_fragility

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    output = snakemake.output
    folder = Path(output.pdf).parent
    rows, reasons = write_fragility(job.records, job.study, folder, job.tell, job.log)
    write = partial(write_fragility_report, rows) if rows[FragilityRow] else None
    write_beside(write, Path(output.pdf), Path(output.svg), job, rows[FailureRow])
    keep_rows(Path(output.rows), rows)
    job.tell("\n".join([*reasons, *faults_in_words(rows)]) or "All records were used.")
    model = folder / OPENQUAKE
    job.finish([*output, *([model] if model.is_file() else [])])
