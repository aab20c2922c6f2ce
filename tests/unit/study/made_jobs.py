"""Jobs of a study that no scheduler started."""

from collections.abc import Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from rocking.assessment.rows import RECORD_TABLES, FailureRow
from rocking.catalogue import CatalogueRecord
from rocking.study.job import Job, Study
from rocking.study.kept import Kept, keep, kept_in
from rocking.study.outputs import STEPS, kept_of, outcome_of
from rocking.study.plan import Plan
from rocking.study.products import BY_NAME
from rocking.study.steps import Steps
from rocking.study.work import work_of


def made_job(records: Sequence[CatalogueRecord], study: Study, results: Path, rule: str = "summary") -> Job:
    """A job over all of `records`, whose results lie in a folder."""
    study = replace(study, settings=replace(study.settings, results=str(results)))
    plan = Plan(study.settings, {record.id: record for record in records})
    return Job(rule, plan, study, results / "made.log")


def outcomes_in(results: Path, records: Sequence[CatalogueRecord]) -> Iterator[Kept]:
    """What the jobs on `records` left, in their order."""
    return (kept_in(outcome_of(results, record.id), RECORD_TABLES) for record in records)


def keep_nothing(results: Path, *products: str) -> None:
    """Keep no rows of products over all records, as if they had been made."""
    for name in products:
        shown = (*work_of(BY_NAME[name]).shown, FailureRow)
        keep(kept_of(results, name), Kept({row_class: [] for row_class in shown}))


def worked(records: Sequence[CatalogueRecord], study: Study, results: Path) -> Job:
    """Assess `records`, each by jobs of its own; return the summary's."""
    job = made_job(records, study, results)
    for record in records:
        take(record, job)
    return job


def take(record: CatalogueRecord, job: Job) -> None:
    """Take a record through its steps."""
    for step in STEPS:
        Steps(record, job.study, job.log).take(step)
