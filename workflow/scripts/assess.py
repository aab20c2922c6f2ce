"""Assess the records of one job: snakemake.* onto rocking.study.run."""

from pathlib import Path

from rocking.study.plan import planned_records
from rocking.study.run import Study, assess_records

if __name__ == "__main__":
    config = snakemake.config
    study = Study.from_settings(config, Path(snakemake.input.structures), snakemake.params.settings_sha256)
    params = snakemake.params
    records = planned_records(Path(config["catalogue"]), params.records, params.records_sha256)
    assess_records(records, study, Path(config["results"]), Path(snakemake.log[0]))
