"""Check the structures of a study at its design level: snakemake.* onto rocking.study.checks."""

from pathlib import Path

from rocking.assessment.rows import RecordRow, VerdictRow
from rocking.study.checks import write_checks
from rocking.study.job import begin_job
from rocking.study.results import outcomes_of

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    rows = [outcome.rows for outcome in outcomes_of(job.results, job.records)]
    verdicts = [row for each in rows for row in each[VerdictRow]]
    records = [row for each in rows for row in each[RecordRow]]
    write_checks(job.study, Path(snakemake.output.pdf).parent, verdicts, records, job.tell)
    job.finish(snakemake.output)
