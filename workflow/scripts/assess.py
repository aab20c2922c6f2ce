"""Assess and report the records of one job: snakemake.* onto rocking.study.job."""

from pathlib import Path

from rocking.study.job import planned, run_job
from rocking.study.terminal import line_writer

if __name__ == "__main__":
    study, records = planned(snakemake.config, snakemake.params)
    part, results = Path(snakemake.output[0]).parent, Path(study.settings.results)
    run_job(records, study, part, results, line_writer(Path(snakemake.log[0])))
