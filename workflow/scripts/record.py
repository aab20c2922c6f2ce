"""One record: snakemake.* onto rocking.study.job."""

from rocking.study.job import begin_job, work_on

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    (record,) = job.records
    work_on(record, job)
    job.finish(snakemake.output)
