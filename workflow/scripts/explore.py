"""Write the page to explore the study: snakemake.* onto rocking.study.explore."""

from pathlib import Path

from rocking.records.catalogue import load_catalogue
from rocking.study.config_file import read_settings
from rocking.study.explore import write_explore
from rocking.study.inputs import check_files, planned_structures
from rocking.study.progress import line_writer
from rocking.study.run import Study

if __name__ == "__main__":
    settings, params = read_settings(snakemake.config), snakemake.params
    structures = planned_structures(Path(settings.structures), params.structures_sha256)
    records = [record for record in load_catalogue(settings.catalogue) if record.id in set(params.records)]
    check_files(records, settings, params.files_sha256)
    study = Study(structures, settings, params.settings_sha256)
    tell = line_writer(Path(snakemake.log[0]))
    write_explore(records, study, Path(settings.results), Path(snakemake.output.page), tell)
