"""The jobs of a study: what each rule of the workflow does in its process, one function for each kind of rule."""

import contextlib
from dataclasses import replace
from pathlib import Path
from traceback import print_exception

from rocking.assessment.cores import on_cores
from rocking.assessment.rows import FailureRow
from rocking.errors import RockingError, fault_in_words
from rocking.study.documents import write_reason
from rocking.study.job import Job, Study
from rocking.study.kept import Kept, Rows, keep
from rocking.study.outputs import outputs_of
from rocking.study.plan import Plan
from rocking.study.products import BY_NAME
from rocking.study.steps import Steps, of_the_machine
from rocking.study.summary import summarise
from rocking.study.terminal import failing_lines, wrapped
from rocking.study.work import work_of
from rocking.tables import rows_of, write_whole

_DRAWN = (".pdf", ".svg", ".xlsx", ".html")


def run(rule: str, plan: Plan, log: str, cores: int, folder: str) -> None:
    """Do the job of a rule.

    folder: in which the files lie that the rule declares, as the study names them; on another machine they are copies.
    """
    log = str(Path(log).absolute())
    with contextlib.chdir(folder or "."), on_cores(cores):
        match rule:
            case "read" | "pulses" | "predict" | "integrate" | "report":
                (record,) = plan.records.values()
                Steps(record, Study.of(plan, rule), Path(log)).take(rule)
            case "summary":
                summarise(Job(rule, plan, Study.of(plan), Path(log)))
            case _:
                product(Job(rule, plan, Study.of(plan), Path(log)))


def product(job: Job) -> None:
    """Make a product over all records, and write for the summary and the terminal what they show of it.

    Where it cannot be made, its pages and a row say why, and the summary and all tables are made.
    """
    face = BY_NAME[job.rule]
    work = work_of(face)
    try:
        made = work.make(job)
    except Exception as error:
        if of_the_machine(error):
            raise
        print_exception(error)
        sentence = str(error) if isinstance(error, RockingError) else fault_in_words(error, job.log, job.rule)
        for path in outputs_of(job.rule, job.plan.settings).values():
            if path.suffix in _DRAWN:
                write_reason(path, [sentence])
            else:
                write_whole(path, b"")
        fault = FailureRow(stage=job.rule, message=sentence)
        made = Kept({**dict.fromkeys(work.shown, ()), FailureRow: [fault]})
    rows: Rows = {FailureRow: [], **made.rows}
    lines = [*made.lines, *failing_lines(rows_of(FailureRow, rows)), *wrapped(made.conclusion)]
    opened = [f"{face.folder}/{name}" for name in face.files if name.endswith(".pdf")]
    keep(job.kept, replace(made, rows=rows, lines=lines, opened=opened))
