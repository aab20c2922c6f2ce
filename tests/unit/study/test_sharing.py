"""How a study that ran before is shared out: by the work that is left."""

import json
from pathlib import Path

import pytest

from rocking.study.plan import Plan, make_plan
from rocking.study.results import cases_of, part
from rocking.study.seal import SEAL, write_seal
from rocking.study.sharing import shared_by_work

RECORDS = 60
"""Three jobs' worth without reports, and so four jobs."""
BLOCK = "{{name: {0} {1}, type: block, breadth_m: {1}, height_m: 6}}"


@pytest.fixture(autouse=True)
def _in_the_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Plans are made in the folder of the study."""
    monkeypatch.chdir(tmp_path)


def _plan(
    breadths: str = "1 2 3 4 5", records: int = RECORDS, names: str = "wall", **settings: object
) -> Plan:
    rows = [f"r{place},r{place}.AT2,{place:064d}" for place in range(records)]
    Path("catalogue.csv").write_text("\n".join(["id,file,sha256", *rows]))
    blocks = [BLOCK.format(names, breadth) for breadth in breadths.split()]
    Path("structures.yaml").write_text(f"[{', '.join(blocks)}]")
    named = {"catalogue": "catalogue.csv", "structures": "structures.yaml", "results": "results"}
    return make_plan(named | {"reports": False} | settings)


def _summarised(plan: Plan) -> None:
    """Leave what a whole run of the plan leaves of its origin, and the cases of each record."""
    summary = Path("results", "summary")
    (summary / "cases").mkdir(parents=True)
    for record in plan.records:
        cases_of(Path("results"), record).touch()
    provenance = {
        "settings": plan.settings.mapping(),
        "hashes": {"settings": plan.settings_sha256, "package": plan.package_sha256},
        "structures": plan.structure_hashes,
        "records": {name: record.sha256 for name, record in plan.records.items()},
    }
    (summary / "provenance.json").write_text(json.dumps(provenance, default=str))


def _sealed(plan: Plan, *jobs: str) -> None:
    for job in jobs:
        folder = part(Path("results"), job)
        folder.mkdir(parents=True)
        write_seal(folder / SEAL, plan.made_from(job), [], Path("results"))


def _number(plan: Plan) -> int:
    return len(shared_by_work(plan).jobs)


def test_a_study_that_never_ran_is_shared_out_by_its_records() -> None:
    plan = _plan()
    assert shared_by_work(plan).jobs == plan.jobs
    assert len(plan.jobs) == 4


@pytest.mark.parametrize(
    ("breadths", "jobs"), [("1 2 3 4 9", 1), ("1 2 3 9 8", 2), ("1 2 9 8 7", 2), ("9 8 7 6 5.5", 4)]
)
def test_the_work_of_changed_structures_chooses_the_number_of_jobs(breadths: str, jobs: int) -> None:
    """Of 60 records, 24 a job: .3, .5, .7 and all of the work are .75, 1.25, 1.75 and 2.5 jobs."""
    _summarised(_plan())
    assert _number(_plan(breadths)) == jobs


def test_a_name_is_no_change_of_a_structure() -> None:
    _summarised(_plan())
    text = Path("structures.yaml").read_text()
    plan = _plan(names="pier")
    assert Path("structures.yaml").read_text() != text
    assert _number(plan) == 1


def test_a_job_that_stands_as_planned_keeps_the_sharing() -> None:
    """A run that was broken off goes on."""
    plan = _plan()
    _summarised(plan)
    _sealed(plan, next(iter(plan.jobs)))
    assert shared_by_work(plan).jobs == plan.jobs


def test_a_record_more_keeps_the_sharing() -> None:
    plan = _plan()
    _summarised(plan)
    _sealed(plan, *plan.jobs)
    grown = shared_by_work(_plan(records=RECORDS + 1))
    assert len(set(grown.jobs.items()) - set(plan.jobs.items())) == 1


def test_no_job_that_was_made_from_something_else_keeps_the_sharing() -> None:
    plan = _plan()
    _summarised(plan)
    _sealed(plan, *plan.jobs)
    assert _number(_plan("1 2 3 4 9")) == 1


@pytest.mark.parametrize("changed", [{"tolerance": 1e-7}, {"ensemble": {"members": 16}}])
def test_another_setting_leaves_all_the_work(changed: dict[str, object]) -> None:
    _summarised(_plan())
    assert _number(_plan(**changed)) == 4


@pytest.mark.parametrize("asked", [{"reports": True}, {"histories": True}, {"records_per_job": 15}])
def test_what_is_made_of_every_case_or_told_by_the_user_is_shared_out_as_ever(
    asked: dict[str, object],
) -> None:
    _summarised(_plan(**asked))
    changed = _plan("1 2 3 4 9", **asked)
    assert shared_by_work(changed).jobs == changed.jobs
    assert len(changed.jobs) > 1


@pytest.mark.parametrize(
    "content", ["", "[]", "{", '{"hashes": 3}', '{"hashes": {"package": 1}}', "[" * 100_000]
)
def test_a_provenance_that_cannot_be_read_tells_nothing(content: str) -> None:
    _summarised(_plan())
    Path("results", "summary", "provenance.json").write_text(content)
    assert _number(_plan("1 2 3 4 9")) == 4


def test_a_job_that_runs_does_not_change_the_sharing() -> None:
    """Each job makes the plan again, while others keep their cases."""
    _summarised(_plan())
    plan = _plan("1 2 3 9 8")
    before = shared_by_work(plan)
    for record in plan.records:
        cases_of(Path("results"), record).unlink()
        assert shared_by_work(plan).jobs == before.jobs
    _sealed(before, next(iter(before.jobs)))
    assert shared_by_work(plan).jobs == before.jobs
