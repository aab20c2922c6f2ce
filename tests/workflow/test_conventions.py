"""What a user of snakemake expects of a workflow, each on the real command in the folder of a study of one's own."""

import csv
import errno
import os
import shutil
import subprocess
import sys
import tarfile
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import obspy
import pytest
import yaml

from rocking.study.cli import main
from rocking.study.outputs import STEPS
from tests.workflow.conftest import ROOT, SmallStudy
from tests.workflow.forked import PLANNING, run_snakemake

pytestmark = pytest.mark.process

FEW = {"ensemble": {"members": 16, "reserve": 0}, "processing_variants": False, "candidates": 0}
PIER = "- {name: pier, type: block, breadth_m: 0.5, height_m: 3.0}\n"


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> SmallStudy:
    """A study as `rocking start` makes it, of one record and one structure, which has not been run."""
    folder = tmp_path_factory.mktemp("conventions") / "study"
    assert main(["start", str(folder)]) == 0
    study = SmallStudy(folder, ROOT)
    study.add_synthetic("good_1", 1)
    (folder / "structures.yaml").write_text(PIER)
    (folder / "config.yaml").write_text(yaml.safe_dump({"reports": False, **FEW}))
    return study


@pytest.fixture(scope="module")
def done(begun: SmallStudy, tmp_path_factory: pytest.TempPathFactory) -> SmallStudy:
    """The same after a run."""
    study = begun.copy_to(tmp_path_factory.mktemp("done") / "study")
    snakemake(study)
    return study


def snakemake(study: SmallStudy, *options: str, status: int = 0) -> str:
    """Run the bare command in the folder of the study, by its own Snakefile and its own profile."""
    with TemporaryDirectory() as folder:
        output = Path(folder) / "output"
        ended, told = run_snakemake(["--nocolor", *options], output, modules=PLANNING, **study.surroundings)
    assert ended == status, told
    return told


def failures(study: SmallStudy) -> list[dict[str, str]]:
    with (study.results / "summary" / "failures.csv").open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def test_no_flag_is_mandatory_and_a_second_run_makes_nothing_again(done) -> None:
    """The profile of the study says the cores, and that dates of what the user writes mean nothing."""
    assert not failures(done)
    told = snakemake(done, "-n")
    assert done.planned() == [] and "profiles/default" in told


@pytest.mark.slow
def test_a_configfile_replaces_keys_of_the_settings_and_no_others(done, tmp_path) -> None:
    study = done.copy_to(tmp_path / "study")
    (tmp_path / "few.yaml").write_text("study: A town\n")
    snakemake(study, "--configfile", str(tmp_path / "few.yaml"))
    provenance = yaml.safe_load((study.results / "summary" / "provenance.json").read_text())
    assert provenance["settings"]["study"] == "A town"
    assert provenance["settings"]["ensemble"]["members"] == 16 and not provenance["settings"]["reports"]
    assert study.tables()["summary/verdicts.csv"] == done.tables()["summary/verdicts.csv"]


def test_a_plan_demands_only_what_the_jobs_asked_for_need(begun, tmp_path) -> None:
    study = begun.copy_to(tmp_path / "study")
    settings = {"fragility": {"hazard": "nowhere.csv", "in_every_run": True}}
    (study.folder / "config.yaml").write_text(yaml.safe_dump(settings))
    assert "nowhere.csv" in snakemake(study, "-n", status=1)
    snakemake(study, "-n", "results/good_1/report.pdf")


def test_a_product_that_cannot_be_made_is_a_page_and_a_row_and_status_1(begun, tmp_path) -> None:
    """A hazard curve with a column of another name; the summary and all other tables stand."""
    study = begun.copy_to(tmp_path / "study")
    study.add_synthetic("good_2", 2)
    (study.folder / "hazard.csv").write_text("intensity,rate\n0.1,0.01\n1,0.0001\n")
    fragility = {"hazard": "hazard.csv", "in_every_run": True, "members": False}
    (study.folder / "config.yaml").write_text(
        yaml.safe_dump({**FEW, "fragility": fragility, "trade": {"in_summary": False}})
    )
    told = snakemake(study, status=1)
    assert "1 row of results/summary/failures.csv" in told
    (failure,) = failures(study)
    assert failure["stage"] == "fragility" and "hazard.csv" in failure["message"]
    assert (study.results / "fragility" / "fragility.pdf").read_bytes().startswith(b"%PDF")
    assert (study.results / "summary" / "summary.pdf").stat().st_size > 10_000
    assert (study.results / "summary" / "verdicts.csv").read_text().count("\n") == 3


def test_a_run_until_a_step_gives_the_files_of_that_step_and_goes_on_from_there(
    begun, done, tmp_path
) -> None:
    study = begun.copy_to(tmp_path / "study")
    snakemake(study, "--until", "pulses")
    own = study.results / "good_1"
    assert {path.name for path in own.iterdir()} == {
        *("motion.mseed", "motion.json", "record.csv", "pulses.csv", "pulses.json")
    }
    with (own / "record.csv").open(encoding="utf-8", newline="") as stream:
        (row,) = csv.DictReader(stream)
    (channel,) = obspy.read(own / "motion.mseed")
    assert abs(channel.data).max() == pytest.approx(float(row["peak_acceleration_m_s2"]), rel=1e-9)
    assert study.planned() == ["integrate", "predict", "report", "summary"]
    snakemake(study, "results/good_1/report.pdf", "--config", "reports=true")
    assert (own / "report.pdf").is_file() and not (study.results / "summary" / "verdicts.csv").exists()
    assert (own / "pulses.csv").read_bytes() == (done.results / "good_1" / "pulses.csv").read_bytes()


@pytest.mark.slow
def test_rocking_run_until_a_step_says_where_its_files_lie(begun, done, tmp_path) -> None:
    study = begun.copy_to(tmp_path / "study")
    told = study.rocking("run", str(study.folder), "--until", "predict").stdout
    assert f"Finished: --until predict; what it wrote lies in {study.results}" in told
    own = Path("good_1", "predictions.csv")
    assert (study.results / own).read_bytes() == (done.results / own).read_bytes()
    assert study.planned() == ["integrate", "report", "summary"]


def test_the_graph_of_the_readme_is_that_of_the_rules() -> None:
    command = [sys.executable, "-m", "snakemake", "--rulegraph", "mermaid-js", "summary"]
    drawn = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=True).stdout
    _, _, shown = (ROOT / "README.md").read_text(encoding="utf-8").partition("```mermaid\n")
    # Snakemake draws the edges in any order.
    assert sorted(shown.partition("\n```")[0].splitlines()) == sorted(drawn.strip().splitlines())


@pytest.mark.slow
def test_outputs_dated_ahead_of_the_clock_stop_nothing(done, tmp_path) -> None:
    study = done.copy_to(tmp_path / "study")
    ahead = time.time() + 1e6
    for path in study.results.rglob("*"):
        os.utime(path, (ahead, ahead))
    (study.results / "summary" / "verdicts.csv").unlink()
    snakemake(study)
    assert study.tables() == done.tables()
    assert study.planned() == []


@pytest.mark.slow
def test_a_link_to_itself_among_the_results_stops_nothing(done, tmp_path) -> None:
    study = done.copy_to(tmp_path / "study")
    (study.results / "summary" / "verdicts.csv").unlink()
    (study.results / "again").symlink_to(study.results)
    snakemake(study)
    assert study.tables() == done.tables()


@pytest.mark.slow
@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOSYS])
def test_a_file_system_without_locks_is_a_warning(done, tmp_path, number) -> None:
    study = done.copy_to(tmp_path / "study")
    code = (
        "import fcntl, os, sys\n"
        f"def flock(*_): raise OSError({number}, os.strerror({number}))\n"
        "fcntl.flock = flock\n"
        "from rocking.study.cli import main\n"
        "sys.exit(main(['run', sys.argv[1]]))"
    )
    command = [sys.executable, "-c", code, str(study.folder)]
    ended = subprocess.run(command, capture_output=True, text=True, check=False, **study.surroundings)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert f"not locked, {os.strerror(number)}" in ended.stdout


@pytest.mark.slow
def test_a_catalogue_that_cannot_be_written_stops_nothing(begun, done, tmp_path) -> None:
    """Nor any other file that the user wrote: a run only reads them, and the provenance holds the hash left blank."""
    study = begun.copy_to(tmp_path / "study")
    study.write_catalogue([row | {"sha256": ""} for row in study.rows()])
    before = {path: path.read_bytes() for path in study.folder.rglob("*") if path.is_file()}
    command = [sys.executable, "-m", "snakemake", "--nocolor"]
    if os.geteuid() == 0:  # to whom permissions mean nothing, unless that is taken from it
        if not shutil.which("setpriv"):
            pytest.skip("root writes everywhere, and setpriv is not installed to take that from it")
        command = ["setpriv", "--bounding-set=-dac_override", *command]
    for path in (
        *(study.folder / "records").iterdir(),
        study.folder / "records",
        study.folder / "config.yaml",
    ):
        path.chmod(0o555 if path.is_dir() else 0o444)
    ended = subprocess.run(command, capture_output=True, text=True, check=False, **study.surroundings)
    (study.folder / "records").chmod(0o755)
    assert ended.returncode == 0, ended.stdout + ended.stderr
    assert study.tables() == done.tables()
    assert {path: path.read_bytes() for path in before} == before
    provenance = yaml.safe_load((study.results / "summary" / "provenance.json").read_text())
    assert len(provenance["records"]["good_1"]) == 64


@pytest.mark.slow
def test_a_module_of_another_snakefile_gives_the_same_status_and_files(begun, done, tmp_path) -> None:
    study = begun.copy_to(tmp_path / "study")
    (study.folder / "Snakefile").unlink()
    (study.folder / "workflow").mkdir()
    (study.folder / "workflow" / "Snakefile").write_text(
        f'configfile: "config.yaml"\n\nmodule rocking:\n    snakefile: "{ROOT}/workflow/Snakefile"\n'
        "    config: config\n\nuse rule * from rocking\n"
    )
    study.add("broken", b"no record")
    told = snakemake(study, "--cores", "2", status=1)
    assert "1 row of results/summary/failures.csv" in told
    assert [failure["record"] for failure in failures(study)] == ["broken"]
    assert study.rows_of("good_1") == done.rows_of("good_1")


@pytest.mark.slow
def test_an_archive_unpacks_to_a_study_that_runs(begun, done, tmp_path) -> None:
    snakemake(begun, "--archive", str(tmp_path / "study.tar.gz"))
    with tarfile.open(tmp_path / "study.tar.gz") as archive:
        archive.extractall(tmp_path / "unpacked", filter="data")
    study = SmallStudy(tmp_path / "unpacked", ROOT)
    snakemake(study, "--cores", "2")
    assert study.tables() == done.tables()


@pytest.mark.slow
def test_every_generated_unit_test_parses(done, tmp_path) -> None:
    study = done.copy_to(tmp_path / "study")
    command = [sys.executable, "-m", "snakemake", "--generate-unit-tests", "tests"]  # where it was imported
    subprocess.run(command, capture_output=True, check=True, **study.surroundings)
    written = list((study.folder / "tests").rglob("test_*.py"))
    assert {*(f"test_{step}.py" for step in STEPS), "test_summary.py"} <= {path.name for path in written}
    for path in written:
        compile(path.read_text(encoding="utf-8"), path, "exec")


@pytest.mark.slow
def test_the_rules_are_free_of_lint() -> None:
    command = [sys.executable, "-m", "snakemake", "--lint"]
    ended = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert not ended.returncode and "Lints for" not in ended.stdout + ended.stderr, ended.stderr


@pytest.mark.slow
def test_the_catalogue_of_workflows_finds_the_main_file_and_how_it_is_used() -> None:
    assert (ROOT / "workflow" / "Snakefile").is_file()
    usage = yaml.safe_load((ROOT / ".snakemake-workflow-catalog.yml").read_text())["usage"]
    assert set(usage) == {"software-stack-deployment", "report"}, "no flag is mandatory"
    assert (ROOT / "profiles" / "default" / "config.yaml").samefile(
        ROOT / "workflow" / "profiles" / "default" / "config.yaml"
    )
    told = subprocess.run(
        [sys.executable, "-m", "snakemake", "-n"], cwd=ROOT, capture_output=True, text=True, check=False
    )
    assert told.returncode == 0 and "profiles/default" in told.stdout + told.stderr
    assert Path(ROOT / "Snakefile").read_text().count("\n") < 20
