"""Assess and report the records of one job, and of a study with no other all: snakemake.* onto rocking.study."""

import os
from pathlib import Path

from rocking.study.job import begin_job, run_job
from rocking.study.seal import SEAL, beside, write_seal
from rocking.study.terminal import line_writer

if __name__ == "__main__":
    study, records = begin_job(snakemake.config, snakemake.params)
    output, results = snakemake.output, Path(study.settings.results)
    part = Path(output.part[0]).parent
    params, tell_line = snakemake.params, line_writer(Path(snakemake.log[0]))
    files = [os.fsdecode(bytes.fromhex(name)) for name in params.files]
    run_job(records, study, part, results, tell_line, files)
    write_seal(part / SEAL, params.made_from, beside([*output.part, *output.own]), results)
    if params.summary:
        from rocking.study.summary import summarise  # of which one job of many has no need

        summarise(study, records, params.summary["jobs"], params)
        seal = results / "summary" / SEAL
        write_seal(seal, params.summary["made_from"], map(Path, output.summary), results)
