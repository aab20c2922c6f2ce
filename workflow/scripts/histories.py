"""Write the rotation histories of one job's records: snakemake.* onto rocking.study.histories."""

from pathlib import Path

from rocking.study.config_file import read_settings
from rocking.study.histories import write_histories
from rocking.study.inputs import check_files, planned_structures
from rocking.study.plan import planned_records
from rocking.study.run import Study

if __name__ == "__main__":
    settings, params = read_settings(snakemake.config), snakemake.params
    structures = planned_structures(Path(settings.structures), params.structures_sha256)
    records = planned_records(Path(settings.catalogue), set(params.records), params.records_sha256)
    check_files(records, settings, params.files_sha256)
    study = Study(structures, settings, params.settings_sha256)
    write_histories(records, study, Path(settings.results), Path(snakemake.log[0]))
