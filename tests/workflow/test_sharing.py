"""A study that ran before is shared out by the work that is left, and its tables do not tell."""

from pathlib import Path

import pytest

from tests.workflow.conftest import SmallStudy, kinds_of_jobs, new_study

RECORDS = 25
"""One more than a job takes without reports."""


def _jobs(study: SmallStudy) -> int:
    return len(list((study.results / "summary" / "jobs").iterdir()))


def _changed(study: SmallStudy) -> None:
    """Make the wall thicker."""
    path = study.folder / "structures.yaml"
    before = path.read_text(encoding="utf-8")
    path.write_text(before.replace("thickness_m: 0.25", "thickness_m: 0.26"), encoding="utf-8")
    assert path.read_text(encoding="utf-8") != before


@pytest.mark.slow
def test_a_changed_structure_takes_one_job_and_gives_the_tables_of_a_whole_run(
    tree: Path, tmp_path: Path
) -> None:
    study = new_study(tmp_path / "study", tree)
    (study.folder / "config.yaml").write_text("reports: false\nensemble: {members: 16}\n", encoding="utf-8")
    for number in range(1, RECORDS + 1):
        study.add_synthetic(f"good_{number}", number)
    fresh = study.copy_to(tmp_path / "fresh")
    study.run()
    assert _jobs(study) == 2
    assert study.planned() == []

    study.add_synthetic("another", 40)
    assert kinds_of_jobs(study.run()) == ["assess", "summarise"], "the other job stands"
    assert _jobs(study) == 2

    _changed(study)
    assert kinds_of_jobs(study.run()) == ["assess"], "which makes the summary too"
    assert _jobs(study) == 1
    assert study.planned() == []

    fresh.add_synthetic("another", 40)
    _changed(fresh)
    fresh.run()
    assert _jobs(fresh) == 2
    of_summary = [
        path.name for path in (fresh.results / "summary").glob("*.csv") if path.name != "timings.csv"
    ]
    assert of_summary
    for name in of_summary:
        path = f"summary/{name}"
        assert study.tables()[path] == fresh.tables()[path]
