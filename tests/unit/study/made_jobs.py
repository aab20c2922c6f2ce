"""Jobs of a study that no scheduler started."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import partial
from pathlib import Path

from rocking.catalogue import CatalogueRecord
from rocking.study.contents import ContentHashes
from rocking.study.job import Job, Study, steps_of
from rocking.study.outcomes import RecordOutcome, outcomes_written, read_outcomes
from rocking.study.outputs import outcome_of
from rocking.study.plan import Plan
from rocking.study.task import Task


def made_job(
    records: Sequence[CatalogueRecord],
    study: Study,
    results: Path,
    product: str = "batch/00000_of_00001",
    told: list[str] | None = None,
    beside: Sequence[str] = (),
) -> Job:
    """A job on `records`, whose results lie in a folder; told: takes what it tells."""
    study = replace(study, settings=replace(study.settings, results=str(results)))
    plan = Plan(study.settings, {each.id: each for each in records}, study.scenes, ContentHashes())
    lines = [] if told is None else told
    task = Task(product, {}, (), products=beside)
    return Job(
        task, plan, study, list(records), results / "made.log", partial(_tell, lines), partial(_keep, results)
    )


def _tell(lines: list[str], line: str, *_counts: int) -> None:
    lines.append(line)


def _keep(results: Path, record: str, outcome: RecordOutcome) -> None:
    with outcomes_written(outcome_of(results, record)) as keep:
        keep(record, outcome)


def outcomes_in(results: Path, records: Sequence[CatalogueRecord]) -> Iterator[RecordOutcome]:
    """What the jobs on `records` left, in their order."""
    yield from read_outcomes({each.id: outcome_of(results, each.id) for each in records})


def take_steps(record: CatalogueRecord, job: Job) -> None:
    """What `rocking.study.jobs.record` does with a record."""
    with steps_of(record, job) as step:
        motion = step.read()
        components = step.pulses(motion)
        step.compare(step.integrate(motion, components, step.predict(components)))


def worked(
    records: Sequence[CatalogueRecord],
    study: Study,
    results: Path,
    told: list[str] | None = None,
    beside: Sequence[str] = (),
) -> Job:
    """Assess `records`, each in a job of its own where the study makes reports or histories; return the summary's."""
    own = study.settings.reports or study.settings.histories
    job = made_job(records, study, results, told=told)
    for record in records:
        job = made_job([record], study, results, f"record/{record.id}", told) if own else job
        take_steps(record, job)
    return made_job(records, study, results, "summary", told, beside)
