"""Measure the fragility of a study: snakemake.* onto rocking.study.fragility."""

from pathlib import Path

from rocking.records import load_catalogue
from rocking.reports.summary.fragility_figures import write_fragility_figure
from rocking.study.config_file import read_settings
from rocking.study.fragility import write_fragility
from rocking.study.inputs import planned_structures
from rocking.study.progress import line_writer
from rocking.study.run import Study

if __name__ == "__main__":
    params, output = snakemake.params, snakemake.output
    settings = read_settings(snakemake.config)
    study = Study(planned_structures(Path(settings.structures), params.structures_sha256), settings)
    folder, tell = Path(output.pdf).parent, line_writer(Path(snakemake.log[0]))
    unused = write_fragility(load_catalogue(Path(settings.catalogue)), study, folder, tell)
    write_fragility_figure(folder, Path(output.pdf), Path(output.svg))
    tell("\n".join(unused) or "All records were used.")
