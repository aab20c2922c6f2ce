"""Summarise all records: snakemake.* onto rocking.study.summary."""

from pathlib import Path

from rocking.study.job import begin_job
from rocking.study.seal import SEAL, write_seal
from rocking.study.summary import summarise

if __name__ == "__main__":
    study, records = begin_job(snakemake.config, snakemake.params)
    results = Path(study.settings.results)
    summarise(study, records, snakemake.params.jobs, snakemake.params)
    files = map(Path, snakemake.output)
    write_seal(results / "summary" / SEAL, snakemake.params.made_from, files, results)
