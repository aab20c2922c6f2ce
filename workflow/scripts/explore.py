"""Write the page to explore the study: snakemake.* onto rocking.study.explore."""

from pathlib import Path

from rocking.study.config_file import read_settings
from rocking.study.explore import write_explore
from rocking.study.inputs import check_files, planned_structures
from rocking.study.parts import part
from rocking.study.plan import planned_records
from rocking.study.progress import line_writer
from rocking.study.run import Study

if __name__ == "__main__":
    settings, params = read_settings(snakemake.config), snakemake.params
    structures = planned_structures(Path(settings.structures), params.structures_sha256)
    records = planned_records(Path(settings.catalogue), None, params.records_sha256)
    check_files(records, settings, params.files_sha256)
    study = Study(structures, settings, params.settings_sha256)
    results, tell = Path(settings.results), line_writer(Path(snakemake.log[0]))
    parts = [part(results, job) for job in params.jobs]
    write_explore(records, study, parts, results, Path(snakemake.output.page), tell)
