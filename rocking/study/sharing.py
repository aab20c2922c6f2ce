"""The sharing out of a study that ran before: by the work that its kept results leave, not by its records alone.

A process takes two seconds to start. Where most cases are kept, one job does what is left sooner than several, and it
makes the summary too.
"""

import json
from collections.abc import Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

from rocking.errors import RockingError
from rocking.study.plan import Plan, jobs_of, share_out
from rocking.study.results import PROVENANCE, part, parts_in
from rocking.study.seal import SEAL, sealed_origin
from rocking.tables import read_whole

_READING = 0.1
"""Work of a record whose cases are all kept, as a share of its whole: it is read and its rows are written again. Of 42
records under ten structures it takes 0.07."""
_LARGEST = 100_000_000
"""Bytes of the provenance that are read; a hundred thousand records take about ten million."""


def shared_by_work(plan: Plan) -> Plan:
    """Return the plan with its records shared out by the work that is left.

    Where a job stands as it is planned, its study goes on with the sharing that it has, lest what is finished be
    computed again. The plan stays as it is where the settings name the number of records per job, or ask for reports or
    histories, which are made of every case.
    """
    settings = plan.settings
    if settings.records_per_job or settings.reports or settings.histories:
        return plan
    for count in _counts(Path(settings.results)):
        shared = replace(plan, jobs=jobs_of(plan.records, count))
        if _any_stands(shared):
            return shared
    return replace(plan, jobs=share_out(plan.records, reports=False, work=_work_left(plan)))


def _counts(results: Path) -> list[int]:
    """The numbers of jobs that the records were shared out to before, the largest first."""
    counts = {int(folder.name.rpartition("_")[2]) for folder in parts_in(results)}
    return sorted(counts - {0}, reverse=True)


def _any_stands(plan: Plan) -> bool:
    results = Path(plan.settings.results)
    return any(sealed_origin(part(results, job) / SEAL) == plan.made_from(job) for job in plan.jobs)


def _work_left(plan: Plan) -> float:
    """The work that is left of a record, as a share of its whole, after what the last summary was made from.

    An estimate, on which no number depends: a case that was thought to be kept is computed. It asks only for what no
    job changes, as each job makes the plan again while others run; not for the kept cases themselves.
    """
    before = _provenance(Path(plan.settings.results) / "summary" / PROVENANCE)
    settings = json.loads(json.dumps(plan.settings.mapping(), default=str))
    hashes = before.get("hashes")
    package = hashes.get("package") if isinstance(hashes, dict) else None
    if package != plan.package_sha256 or before.get("settings") != settings:
        return 1.0
    records = {name: each.sha256 for name, each in plan.records.items()}
    kept = _unchanged(before.get("structures"), plan.structure_hashes)
    kept *= _unchanged(before.get("records"), records)
    return min(1.0, _READING + 1 - kept)


def _provenance(path: Path) -> Mapping[str, Any]:
    """The content of a provenance; {} where there is none that can be read."""
    try:
        content = json.loads(read_whole(path, _LARGEST, RockingError))
    except (RockingError, OSError, ValueError, RecursionError):
        return {}
    return content if isinstance(content, dict) else {}


def _unchanged(before: object, now: Mapping[str, str]) -> float:
    """The share of the hashes of now that stood before, whatever their names."""
    known = {str(each) for each in before.values()} if isinstance(before, dict) else set()
    return sum(each in known for each in now.values()) / max(1, len(now))
