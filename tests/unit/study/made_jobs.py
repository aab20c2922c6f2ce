"""Jobs of a study that no scheduler started."""

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from rocking.records import CatalogueRecord
from rocking.study.job import Job, Study, work_on
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
        work_on(record, job)
    return made_job(records, study, results, "summary", told)
