"""Summarise all records: snakemake.* onto rocking.study.summary."""

from rocking.study.job import planned
from rocking.study.summary import summarise

if __name__ == "__main__":
    params = snakemake.params
    study, records = planned(snakemake.config, params)
    hashes = {"settings": params.settings_sha256, "package": params.package_sha256}
    summarise(study, {record.id: record.sha256 for record in records}, params.jobs, hashes)
