"""The exit status of a run, with what snakemake ends with set by hand."""

import pytest

from rocking.study import run as module


@pytest.fixture
def study(tmp_path, monkeypatch):
    """A study of one record and one structure, of which no job runs."""
    (tmp_path / "records").mkdir()
    (tmp_path / "records" / "own.txt").write_text("0.0 0.1\n")
    (tmp_path / "records" / "catalogue.csv").write_text("id,file\nown,own.txt\n")
    (tmp_path / "structures.yaml").write_text("- {name: pier, type: block, breadth_m: 1, height_m: 4}\n")
    (tmp_path / "config.yaml").write_text("")
    monkeypatch.setattr(module, "warm_up", lambda settings: None)
    monkeypatch.setattr(module, "_print_outcome", lambda folder, plan: 7)
    return tmp_path


@pytest.mark.parametrize(
    ("ended", "options", "status"),
    [(0, [], 7), (1, [], 1), (3, [], 1), (1, ["summary"], 1), (0, ["summary"], 0)],
)
def test_the_status_of_a_run_is_that_of_its_jobs(study, monkeypatch, ended, options, status):
    monkeypatch.setattr(module, "_snakemake", lambda arguments: ended)
    assert module.run(study, options) == status


@pytest.mark.parametrize("ended", [None, 0, 5])
def test_the_status_of_snakemake_is_handed_on(monkeypatch, ended):
    def main(arguments):
        if ended is not None:
            raise SystemExit(ended)

    monkeypatch.setattr("snakemake.cli.main", main)
    assert module._snakemake([]) == (ended or 0)
