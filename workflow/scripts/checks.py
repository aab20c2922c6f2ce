"""Check the structures of a study at its design level: snakemake.* onto rocking.study.checks."""

from rocking.study.fork_server import hand_over

hand_over()  # before the imports that take a second

from pathlib import Path

from rocking.assessment.rows import MechanismRow, RecordRow, VerdictRow
from rocking.codes.rows import CodeCheckRow
from rocking.study.checks import write_checks
from rocking.study.job import begin_job
from rocking.study.results import keep_rows, outcomes_of

if __name__ == "__main__":
    job = begin_job(snakemake.config, snakemake.params, snakemake.log[0])
    rows = [outcome.rows for outcome in outcomes_of(job.results, job.records)]
    verdicts = [row for each in rows for row in each[VerdictRow]]
    records = [row for each in rows for row in each[RecordRow]]
    mechanisms = [row for each in rows for row in each[MechanismRow]]
    folder = Path(snakemake.output.pdf).parent
    checks = write_checks(job.study, folder, verdicts, records, job.tell, mechanisms)
    keep_rows(Path(snakemake.output.rows), {CodeCheckRow: checks})
    job.finish(snakemake.output)
