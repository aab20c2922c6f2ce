"""What each product of a study is made from: the texts and the files that its rule hands to snakemake."""

import re
import shutil
import tomllib
from importlib.util import find_spec
from pathlib import Path

import pytest

from rocking.errors import ConfigurationError
from rocking.study import made_from as module
from rocking.study import settings as settings_module
from rocking.study.made_from import (
    OF_RECORDS,
    inputs_of,
    made_from,
    of_kind,
    of_records,
    settings_for,
    versions,
    what_changed,
)
from rocking.study.products import BY_NAME
from rocking.study.products import PRODUCTS as OVER_ALL
from rocking.study.workspace import write_catalogue as write_catalogue_of_folder
from tests.refusals import refused
from tests.workflow.edits import (
    BATCH,
    EDITS,
    plan,
    write_settings,
    write_study,
)

ROOT = Path(__file__).parents[3]
PRODUCTS = ("record/a", "record/b", BATCH, "summary", "checks", "fragility", "trade", "map")


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study that has not been run."""
    folder = tmp_path_factory.mktemp("written")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        write_study()
    return folder


@pytest.fixture
def study(written: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it in which the test runs."""
    monkeypatch.chdir(shutil.copytree(written, tmp_path / "study"))
    return tmp_path / "study"


def _changed(before: dict[str, tuple[str, ...]]) -> list[str]:
    now = plan()
    return [product for product, texts in before.items() if what_changed(texts, made_from(product, now))]


def _texts() -> dict[str, tuple[str, ...]]:
    made = plan()
    return {product: made_from(product, made) for product in PRODUCTS}


OF_INPUTS = [each for each in EDITS if "away" not in each[0] or each[0].startswith("record")]


@pytest.mark.parametrize("edit", OF_INPUTS, ids=[each[0] for each in OF_INPUTS])
def test_a_batch_is_made_again_by_what_it_is_made_from(study, edit) -> None:
    """All else is asked of snakemake, by tests/workflow/test_edits.py."""
    _, change, again, *first = edit
    for each in first:
        each()
    before = made_from(BATCH, plan())
    change()
    assert bool(what_changed(before, made_from(BATCH, plan()))) == ("B" in again.split())


def test_each_product_has_as_many_texts_as_its_kind_and_no_two_are_one(study) -> None:
    """Snakemake compares params as a set."""
    made = plan()
    for product, texts in _texts().items():
        assert len(texts) == len(set(texts)) == len(of_kind(product.partition("/")[0], made)) + OF_RECORDS
        assert texts[-OF_RECORDS:] == of_records(product, made)


def test_a_text_names_what_it_says_and_nothing_of_what_a_study_says_of_itself(study) -> None:
    write_settings(study="Kilroy", client="Kilroy", author="Kilroy", project_number="Kilroy", date="Kilroy")
    hostile = "</script><script>{wildcards.record}\n"
    shutil.copy("hazard.csv", hostile.strip().replace("/", "_"))
    write_settings(
        study="Kilroy",
        client="Kilroy",
        fragility={"hazard": hostile.strip().replace("/", "_")},
    )
    for texts in _texts().values():
        assert not any(re.search(r"Kilroy|[<>{}\n]", text) for text in texts)
    assert "tolerance = 1e-06" in made_from("record/a", plan())
    (files,) = (text for text in made_from("record/a", plan()) if text.startswith("files: "))
    assert re.fullmatch(r"files: records/a\.AT2 [0-9a-f]{16}", files)


def test_what_changed_is_told_by_its_names(study) -> None:
    before = _texts()
    write_settings(tolerance=1e-7, study="A town")
    Path("hazard.csv").write_text("intensity,annual_rate\n0.1,0.02\n1,0.0001\n")
    now = plan()
    assert what_changed(before["record/a"], made_from("record/a", now)) == "study, tolerance"
    assert (
        what_changed(before["fragility"], made_from("fragility", now))
        == "file of fragility.hazard, tolerance"
    )


def test_two_settings_that_swap_their_values_are_a_change(study) -> None:
    write_settings(checks={"least_factor": 0.5, "shortest_period_s": 0.25})
    before = _texts()
    write_settings(checks={"least_factor": 0.25, "shortest_period_s": 0.5})
    assert _changed(before) == ["summary", "checks"]


def test_every_input_is_a_file_that_stands_and_the_pool_is_among_those_of_the_checks(study) -> None:
    made = plan()
    for product in PRODUCTS:
        assert all(Path(path).is_file() for paths in inputs_of(product, made).values() for path in paths)
    assert inputs_of("record/a", made)["files"] == ["design.csv", "records/a.AT2"]
    assert set(inputs_of("checks", made)["files"]) == {
        *("design.csv", "records/a.AT2", "records/b.AT2", "pool/catalogue.csv", "pool/p.AT2"),
    }
    assert inputs_of("summary", made)["files"] == ["design.csv"], "the outcomes of the records are its input"


def test_every_library_that_counts_is_named() -> None:
    """But for those that load modules, fetch files, count them or read messages, and those of the scheduling process.

    The readers of ASDF count where they are installed, and llvmlite, by which numba compiles.
    """
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    extras = project["optional-dependencies"]
    named = [*project["dependencies"], *extras["workflow"], *extras["asdf"], "llvmlite"]
    declared = {re.match(r"[\w-]+", each)[0].lower() for each in named}
    others = {"lazy_loader", "polib", "pooch", "tqdm", "psutil", "pygments"}
    absent = {"h5py"} if find_spec("h5py") is None else set()
    assert set(versions()) == {"python", "rocking", *declared - others - absent}


def test_every_setting_stands_in_the_table_of_edits() -> None:
    """But the places, and the design level, which has a line of its own."""
    settings = module.Settings()
    others = {
        "catalogue",
        "structures",
        "results",
    }
    others |= set(settings.values_of(["design_spectrum"]))
    edits = [each[0] for each in EDITS]
    missing = [
        name
        for name in settings.values_of(list(vars(settings)))
        if name not in others and not any(edit.startswith(name) for edit in edits)
    ]
    assert missing == []


@pytest.mark.parametrize("library", ["numpy", "python", "scipy"])
def test_another_version_of_a_library_makes_everything_again(study, monkeypatch, library: str) -> None:
    before = _texts()
    monkeypatch.setattr(module, "versions", lambda: versions() | {library: "0.1"})
    assert _changed(before) == list(PRODUCTS)


def test_an_edited_answer_makes_again_the_record_that_it_reads(study) -> None:
    """The table of layouts is no file of a record; the one answer by which its table is read is part of its content."""
    rows = "".join(f"{place / 100},{(-1) ** place}\n" for place in range(300))
    Path("records/b.AT2").write_text(f"Station 1\nTime,Q1\n{rows}")
    told = write_catalogue_of_folder(Path("records"), Path("records/catalogue.csv"), None, None)
    answers = Path("records/layouts.csv")
    assert "Answer what stands in records/layouts.csv" in told and answers.read_text().count("t, ?") == 1
    answers.write_text(answers.read_text().replace("t, ?", "t, a g"))
    before = _texts()
    assert _changed(before) == []
    answers.write_text(answers.read_text() + '"one series g, dt 0.01","bare",x.txt,,1,,elsewhere\n')
    assert _changed(before) == []
    answers.write_text(answers.read_text().replace("t, a g", "t, NS g"))
    assert _changed(before) == ["record/b", BATCH, "checks", "fragility", "trade"]


def test_a_copied_folder_makes_nothing_again(study, monkeypatch) -> None:
    """Inodes and dates differ; contents do not."""
    before = _texts()
    shutil.copytree(study, study.parent / "copy")
    monkeypatch.chdir(study.parent / "copy")
    assert _changed(before) == []


def test_files_on_another_machine_are_taken_by_the_name_and_the_hash_of_the_catalogue(study) -> None:
    here = plan()
    Path("records/a.AT2").rename("a.AT2")
    with refused(ConfigurationError, "sha256"):
        made_from("record/a", plan(by_name=True))
    Path("a.AT2").rename("records/a.AT2")
    here.fill_hashes()
    texts = made_from("record/a", plan())
    Path("records/a.AT2").unlink()
    made = plan(by_name=True)
    assert made_from("record/a", made) == texts
    assert inputs_of("record/a", made)["files"] == ["design.csv", "records/a.AT2"]


def test_a_job_cannot_read_a_setting_that_its_line_does_not_name(study) -> None:
    settings = settings_for("fragility", plan().settings)
    assert settings.fragility.hazard == "hazard.csv" and settings.tolerance == 1e-6
    with refused(ConfigurationError, "client"):
        _ = settings.client
    with refused(ConfigurationError, "checks"):
        _ = settings_for("record", plan().settings).checks


@pytest.mark.parametrize("product", [each.name for each in OVER_ALL])
def test_an_edit_of_a_product_makes_it_and_the_summary_again_and_no_record(
    study, tmp_path, monkeypatch, product: str
) -> None:
    tree = tmp_path / "tree" / "rocking"
    shutil.copytree(ROOT / "rocking" / "products", tree / "products", ignore=shutil.ignore_patterns("__*"))
    monkeypatch.setattr(settings_module, "__file__", str(tree / "study" / "settings.py"))
    for cached in (settings_module.package_sha256, settings_module.folder_sha256):
        monkeypatch.setattr(module, cached.__name__, cached.__wrapped__)
    before = _texts()
    with (tree / BY_NAME[product].source / "report.py").open("a") as stream:
        stream.write("# edited\n")
    assert set(_changed(before)) == {"summary", product}
