"""Measure the fragility of a study: snakemake.* onto rocking.study.summary."""

from pathlib import Path

from rocking.reports.fragility import write_fragility_report
from rocking.study.job import begin_job
from rocking.study.seal import write_seal
from rocking.study.summary import write_fragility
from rocking.study.terminal import line_writer

if __name__ == "__main__":
    output, tell = snakemake.output, line_writer(Path(snakemake.log[0]))
    study, records = begin_job(snakemake.config, snakemake.params)
    folder = Path(output.pdf).parent
    reasons = write_fragility(records, study, folder, tell)
    write_fragility_report(folder, Path(output.pdf), Path(output.svg))
    made = [Path(file) for file in output if file != output.seal]
    write_seal(Path(output.seal), snakemake.params.made_from, made, folder.parent)
    tell("\n".join(reasons) or "All records were used.")
