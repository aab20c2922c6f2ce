"""Assess and report the records of one job, and of a study with no other all: snakemake.* onto rocking.study."""

import os
from pathlib import Path

from rocking.study.job import begin_job, run_job
from rocking.study.terminal import line_writer

if __name__ == "__main__":
    study, records = begin_job(snakemake.config, snakemake.params)
    part, results = Path(snakemake.output[0]).parent, Path(study.settings.results)
    params, tell_line = snakemake.params, line_writer(Path(snakemake.log[0]))
    files = [os.fsdecode(bytes.fromhex(name)) for name in params.files]
    run_job(records, study, part, results, tell_line, files)
    if params.summary:
        from rocking.study.summary import summarise  # of which one job of many has no need

        summarise(study, records, params.summary["jobs"], params)
