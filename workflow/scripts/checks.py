"""Check the structures of a study at its design level: snakemake.* onto rocking.study.checks."""

from pathlib import Path

from rocking.study.checks import write_checks
from rocking.study.job import begin_job
from rocking.study.terminal import line_writer

if __name__ == "__main__":
    tell = line_writer(Path(snakemake.log[0]))
    study, _ = begin_job(snakemake.config, snakemake.params)
    write_checks(study, Path(snakemake.output.pdf).parent, tell)
