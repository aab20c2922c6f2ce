"""The records of one batch, one after another: snakemake.* onto rocking.study.job."""

from rocking.study.job import begin_job, work_on
from rocking.study.results import outcome_of

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    for record in job.records:
        work_on(record, job)
    job.finish(outcome_of(job.results, record.id) for record in job.records)
