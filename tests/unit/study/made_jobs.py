"""Jobs of a study that no scheduler started."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rocking.records import CatalogueRecord
from rocking.study.job import Job, Study, steps_of
from rocking.study.seals import Seals


def made_job(
    records: Sequence[CatalogueRecord],
    study: Study,
    results: Path,
    product: str = "batches/all",
    told: list[str] | None = None,
) -> Job:
    """A job on `records`, whose results lie in a folder; told: takes what it tells."""
    study = replace(study, settings=replace(study.settings, results=str(results)))
    seals = Seals(results, lambda _: {})
    lines = [] if told is None else told
    return Job(product, seals.key(product), study, list(records), seals, results / "made.log", lines.append)


def take_steps(record: CatalogueRecord, job: Job) -> None:
    """What `workflow/scripts/record.py` does with a record."""
    with steps_of(record, job) as step:
        motion = step.read()
        components = step.pulses(motion)
        step.compare(step.integrate(motion, components, step.predict(components)))


def worked(
    records: Sequence[CatalogueRecord],
    study: Study,
    results: Path,
    told: list[str] | None = None,
) -> Job:
    """Assess `records`, each in a job of its own where the study makes reports or histories, and return the last."""
    own = study.settings.reports or study.settings.histories
    job = made_job(records, study, results, told=told)
    for record in records:
        job = made_job([record], study, results, f"records/{record.id}" if own else job.product, told)
        take_steps(record, job)
    return made_job(records, study, results, "summary", told)
