"""Summarise all records: snakemake.* onto rocking.study.summary."""

from rocking.study.job import planned
from rocking.study.summary import summarise

if __name__ == "__main__":
    summarise(*planned(snakemake.config, snakemake.params), snakemake.params.jobs, snakemake.params)
