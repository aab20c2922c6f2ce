"""What a run makes again after an edit, as snakemake -n tells it; and that the run after it equals one from scratch."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
import yaml

from rocking.hashes import sha256_of_file
from rocking.study.outputs import STEPS
from rocking.study.plan import make_plan
from tests.workflow.conftest import ROOT, SmallStudy
from tests.workflow.edits import EDITS, JOBS, write_outputs, write_study
from tests.workflow.forked import PLANNING, run_snakemake

pytestmark = pytest.mark.process


def _snakemake(*options: str) -> str:
    """What snakemake says in the folder of the study, with the profile of one machine."""
    study = SmallStudy(Path.cwd(), ROOT)
    with TemporaryDirectory() as folder:
        profile = str(ROOT / "workflow" / "profiles" / "default")
        arguments = [
            "--snakefile",
            str(ROOT / "workflow" / "Snakefile"),
            "--workflow-profile",
            profile,
            "--cores",
            "1",
            *options,
        ]
        output = Path(folder) / "output"
        status, told = run_snakemake(arguments, output, modules=PLANNING, **study.surroundings)
    assert status == 0, told
    return told


def _again(told: str) -> set[str]:
    """The jobs of a dry run over all records, each by its letter, and the first step of each record that is taken."""
    messages = re.findall(r"(?m)^Job \d+: (.*)$", told)
    first: dict[str, str] = {}
    for step in STEPS:
        for message in messages:
            if message.startswith(f"{step}: "):
                first.setdefault(message.removeprefix(f"{step}: "), step)
    of_records = {name if step == "read" else f"{name}.{step}" for name, step in first.items()}
    return of_records | {JOBS[message] for message in messages if message in JOBS}


def _finish() -> None:
    write_outputs()
    _snakemake("--touch", "--forceall")


@pytest.fixture(scope="module")
def touched(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study whose products all stand, and of which snakemake knows what they were made from."""
    folder = tmp_path_factory.mktemp("touched")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        write_study()
        _finish()
    return folder


@pytest.fixture
def study(touched: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it in which the test runs."""
    monkeypatch.chdir(shutil.copytree(touched, tmp_path / "study"))
    return tmp_path / "study"


IN_CI = {
    *("nothing", "structure changed", "content of a record", "date of a record in the future", "record away"),
    *("record more", "report away"),
}
"""The edits that snakemake plans in every change of the project; the plan alone is asked of all."""


@pytest.mark.parametrize(
    "edit",
    [pytest.param(edit, id=edit[0], marks=[] if edit[0] in IN_CI else [pytest.mark.slow]) for edit in EDITS],
)
def test_each_edit_makes_again_what_depends_on_it_and_nothing_else(study, edit) -> None:
    _, change, again, *first = edit
    for before in first:
        before()
        _finish()
    change()
    assert _again(_snakemake("-n")) == set(again.split())


def _made_from() -> dict[str, object]:
    """What each job is made from by the plan, by its letter; those of a record by the names of both."""
    plan = make_plan(yaml.safe_load(Path("config.yaml").read_text()))
    jobs = {f"{record}.{step}": (step, record) for record in plan.records for step in STEPS}
    jobs |= {name[0].upper(): (name, "") for name in plan.products}
    return {
        letter: (plan.params(rule), plan.contents(rule, record)) for letter, (rule, record) in jobs.items()
    }


@pytest.mark.parametrize("edit", [edit for edit in EDITS if "away" not in edit[0]], ids=lambda edit: edit[0])
def test_the_plan_makes_a_job_from_what_changes_it_and_from_nothing_else(study, edit) -> None:
    """Summary, checks, trade and map follow where a record is made again, and the summary where anything is."""
    _, change, expected, *first = edit
    for make in first:
        make()
    before = _made_from()
    change()
    after = _made_from()
    again = set(expected.split())
    changed = [letter for letter, made_from in after.items() if before.get(letter) != made_from]
    own = {*{letter.partition(".")[0]: letter.removesuffix(".read") for letter in reversed(changed)}.values()}
    follows = set("SCTM") if own - set("CFTM") else {"S"}
    assert again - follows <= own <= again


DESIGN = "period_s,acceleration_g\n0,0.2\n0.1,0.5\n0.5,0.5\n4,0.06\n"
WHOLE = {
    "ensemble": {"members": 16, "reserve": 0},
    "processing_variants": False,
    "candidates": 0,
    "design_spectrum": {"points": "design.csv"},
    "checks": {"stations": 1},
    "fragility": {"in_every_run": True, "hazard": "hazard.csv", "members": False},
}


@pytest.fixture(scope="module")
def run(start, tmp_path_factory) -> SmallStudy:
    """A study of two records with reports, checks at a design level by its points, and fragility, after its run."""
    made = start.copy_to(tmp_path_factory.mktemp("reports") / "study")
    made.write_catalogue(made.rows()[:2])
    (made.folder / "design.csv").write_text(DESIGN)
    (made.folder / "hazard.csv").write_text("intensity,annual_rate\n0.01,0.1\n10,0.00001\n")
    (made.folder / "config.yaml").write_text(yaml.safe_dump(WHOLE))
    made.run()
    return made


def _everything(study: SmallStudy) -> dict[str, bytes]:
    """What a study wrote, by its path; of what holds measured times, and of logs, that it is there."""
    measured = {"timings.csv", "trade.csv", "trade.pdf", "trade.svg", "trade.json"}
    found: dict[str, bytes] = {}
    for path in study.results.rglob("*"):
        name = path.relative_to(study.results)
        if path.is_file():
            told = {"logs", "benchmarks", ".kept"} & set(name.parts) or path.name in measured
            found[name.as_posix()] = b"" if told else path.read_bytes()
    shows_times = {"summary/summary.pdf", "SHA256SUMS"} if "summary/trade.csv" in found else set()
    return {name: b"" if name in shows_times else content for name, content in found.items()}


def _settings(**changed: object) -> Callable[[SmallStudy], object]:
    def edit(study: SmallStudy) -> None:
        settings = {key: value for key, value in {**WHOLE, **changed}.items() if value is not None}
        (study.folder / "config.yaml").write_text(yaml.safe_dump(settings))

    return edit


def _file(name: str, old: str, new: str) -> Callable[[SmallStudy], object]:
    def edit(study: SmallStudy) -> None:
        path = study.folder / name
        before = path.read_text()
        assert old in before
        path.write_text(before.replace(old, new))

    return edit


def _both(*edits: Callable[[SmallStudy], object]) -> Callable[[SmallStudy], object]:
    return lambda study: [edit(study) for edit in edits]


def _record_less(study: SmallStudy) -> None:
    study.write_catalogue(study.rows()[1:])


def _record_more(study: SmallStudy) -> None:
    study.add_synthetic("good_9", 9)


def _other_content(study: SmallStudy) -> None:
    first, *others = study.rows()
    (study.folder / "records" / "good_1.txt").unlink()
    study.write_catalogue([])
    study.add_synthetic("good_1", 7)
    study.write_catalogue([*study.rows(), *others])
    assert study.rows()[0]["sha256"] != first["sha256"]


def _record_that_fails(study: SmallStudy) -> None:
    study.add("broken", b"no record")


def _tables_by_name(study: SmallStudy) -> None:
    study.run("results/good_1/comparison.csv")


def _order(study: SmallStudy) -> None:
    study.write_catalogue(study.rows()[::-1])


LEVEL = {"ag_g": 0.2, "f0": 2.4, "tc_star_s": 0.35}
RUNS: dict[str, tuple[Callable[[SmallStudy], object], ...]] = {
    "reports off and a breadth": (_both(_settings(reports=False), _file("structures.yaml", "_m: 0.5", "_m: 0.6")),),
    "title": (_settings(study="A town"),),
    "reports off and a breadth, then on without a design level": (
        _both(_settings(reports=False), _file("structures.yaml", "_m: 0.5", "_m: 0.6")),
        _settings(design_spectrum=None, study="A town"),
    ),
    "design level away": (_settings(design_spectrum=None),),
    "seed of the sets": (_settings(checks={**WHOLE["checks"], "seed": 2}),),
    "design level by a_g": (_settings(design_spectrum=LEVEL),),
    "content of the design level": (_file("design.csv", "0.06", "0.05"),),
    "hazard": (_file("hazard.csv", "0.00001", "0.00002"),),
    "structure": (_file("structures.yaml", "3.2", "3.3"),),
    "structure renamed": (_file("structures.yaml", "name: block", "name: pier"),),
    "histories on and off": (_settings(histories=True), _settings()),
    "figures on and off": (_settings(figures="svg"), _settings()),
    "reports off and on": (_settings(reports=False), _settings()),
    "language": (_settings(language="it"),),
    "trade on": (_settings(trade={"in_summary": True}),),
    "record less": (_record_less,),
    "record more": (_record_more,),
    "record that fails": (_record_that_fails, _settings(reports=False)),
    "tables of a record by its name": (_both(_settings(reports=False), _tables_by_name),),
    "content of a record": (_other_content,),
    "order of the records": (_order,),
    "tolerance": (_settings(tolerance=1e-7),),
    "two edits before one run": (_both(_settings(study="A town", tolerance=1e-7), _record_less),),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("edits", RUNS.values(), ids=RUNS)
def test_the_runs_after_edits_leave_the_files_of_a_run_from_scratch(run, tmp_path: Path, edits) -> None:
    """Each file with its bytes; so no document of a former run stands beside tables that it does not fit."""
    study = run.copy_to(tmp_path / "study")
    for edit in edits:
        edit(study)
        study.run()
    assert study.planned() == []
    scratch = study.copy_to(tmp_path / "scratch")
    shutil.rmtree(scratch.results)
    shutil.rmtree(scratch.folder / ".snakemake")
    scratch.run()
    after, anew = _everything(study), _everything(scratch)
    assert sorted(after) == sorted(anew)
    assert [name for name in anew if after[name] != anew[name]] == []


@pytest.mark.slow
def test_a_file_of_the_user_among_the_results_stays_and_what_goes_is_told(run, tmp_path: Path) -> None:
    study = run.copy_to(tmp_path / "study")
    mine = [study.results / name for name in ("mine.pdf", "good_1/notes.txt", "summary/mine.csv")]
    for path in mine:
        path.write_text("mine")
    curves = sorted((study.results / "fragility").iterdir())
    _settings(reports=False, design_spectrum=None, fragility=None)(study)
    told = study.run()
    assert "files of former runs, which this study does not make: results/" in told
    assert all(path.read_text() == "mine" for path in mine)
    assert sorted((study.results / "fragility").iterdir()) == curves, "its verb may have made them"
    pages = {path.relative_to(study.results).as_posix() for path in study.results.rglob("*.pdf")}
    assert pages == {"mine.pdf", "fragility/fragility.pdf"}
    assert not (study.results / "summary" / "logs" / "checks.log").exists()


def test_a_file_of_one_record_is_made_when_it_is_asked_for_by_its_name(finished, tmp_path) -> None:
    """And no more; a name that is no record's is refused."""
    study = finished.copy_to(tmp_path / "study")
    (study.results / "good_2" / "comparison.csv").unlink()
    assert study.planned("results/good_2/comparison.csv") == ["report"]
    study.run("results/good_2/comparison.csv")
    lines = (study.results / "good_2" / "comparison.csv").read_bytes().splitlines()[1:]
    assert lines == finished.rows_of("good_2")["comparison.csv"]
    told = study.run("--dry-run", "results/good_9/comparison.csv", status=1)
    assert "records/catalogue.csv: it has no record good_9" in told


@pytest.mark.slow
def test_the_sums_are_those_of_the_pages_and_tables(run) -> None:
    sums = dict(reversed(line.split("  ")) for line in (run.results / "SHA256SUMS").read_text().splitlines())
    assert {
        "summary/structures.pdf",
        "summary/verdicts.csv",
        "good_1/report.pdf",
        "fragility/fragility.csv",
    } <= set(sums)
    assert "summary/timings.csv" not in sums
    for name, sha256 in sums.items():
        assert sha256_of_file(run.results / name) == sha256
