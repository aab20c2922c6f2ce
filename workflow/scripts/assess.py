"""Assess the records of one job: snakemake.* onto rocking.study.run."""

from pathlib import Path

from rocking.study.config_file import read_settings
from rocking.study.inputs import check_files, planned_structures
from rocking.study.parts import remove_copies
from rocking.study.plan import planned_records
from rocking.study.run import Study, assess_records

if __name__ == "__main__":
    settings, params = read_settings(snakemake.config), snakemake.params
    structures = planned_structures(Path(settings.structures), params.structures_sha256)
    records = planned_records(Path(settings.catalogue), set(params.records), params.records_sha256)
    check_files(records, settings, params.files_sha256)
    study = Study(structures, settings, params.settings_sha256)
    assess_records(records, study, Path(snakemake.output[0]).parent, Path(snakemake.log[0]))
    for record in records:
        remove_copies(Path(settings.results) / record.id)
