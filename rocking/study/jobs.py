"""The jobs of a study: what each rule of the workflow does with the task that it is given, one function for each rule.

The products over all records beside the summary have one for all of them.
"""

from rocking.assessment.cores import on_cores
from rocking.assessment.rows import FailureRow
from rocking.study.job import begin_job, steps_of
from rocking.study.kept import keep_rows
from rocking.study.products import BY_NAME
from rocking.study.summary import summarise
from rocking.study.task import Task
from rocking.study.work import work_of


def record(task: Task) -> None:
    """Take the records of a task through the five steps, each on what the one before it gave."""
    with begin_job(task) as job, on_cores(task.cores):
        for catalogued in job.records:
            with steps_of(catalogued, job) as step:
                motion = step.read()  # 1: by obspy, or by a reader of ours where it has none
                components = step.pulses(motion)  # 2: the sine pulses that dominate it
                predictions = step.predict(components)  # 3: the closed form of each equivalent block
                responses = step.integrate(motion, components, predictions)  # 4: under the whole record
                step.compare(responses)  # 5: and decide, report and keep the outcome


batch = record
"""Many records, one after another in one process: a start costs as much as twenty of them without reports."""


def summary(task: Task) -> None:
    """Write what stands over all records, and remove what no product of the study owns any more."""
    with begin_job(task) as job:
        summarise(job)


def product(task: Task) -> None:
    """Make what stands over all records beside the summary, and keep what this shows of it."""
    with begin_job(task) as job:
        made = work_of(BY_NAME[job.kind]).make(job)
        keep_rows(job.kept, {FailureRow: [], **made.rows}, job.made_by_hand, made.conclusion)
