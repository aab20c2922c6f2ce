"""Set the PDFs of one job's records: snakemake.* onto rocking.study.record_reports."""

from pathlib import Path

from rocking.study.config_file import read_settings
from rocking.study.inputs import check_files, planned_structures
from rocking.study.plan import planned_records
from rocking.study.record_reports import report_records
from rocking.study.run import Study

if __name__ == "__main__":
    settings, params = read_settings(snakemake.config), snakemake.params
    structures = planned_structures(Path(settings.structures), params.structures_sha256)
    records = planned_records(Path(settings.catalogue), set(params.records), params.records_sha256)
    check_files(records, settings, params.files_sha256)
    study = Study(structures, settings, params.settings_sha256)
    part = Path(snakemake.input.tables[0]).parent
    report_records(records, study, part, Path(settings.results), Path(snakemake.log[0]))
