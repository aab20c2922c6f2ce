"""All records: snakemake.* onto rocking.study.summary."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from rocking.study.job import begin_job
from rocking.study.summary import summarise

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    job.finish(summarise(job))
