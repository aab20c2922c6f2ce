"""The main job stands on its own: without codes, fragility and their products it runs, reports included."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

import rocking
from tests.synthetic import SyntheticRecord, at2_text

pytestmark = pytest.mark.process
TREE = Path(rocking.__file__).parents[1]
LATER = ("codes", "fragility")
THEIR_PRODUCTS = ("checks", "fragility")
ASSESS = """
import rocking
(record,) = rocking.read("study/records/one.AT2")
print(rocking.assess(record, rocking.Wall.of_size(3.2, 0.25), members=16).verdict)
"""


@pytest.fixture
def without(tmp_path) -> Path:
    """A copy of the package without them. What is left is linked, so that no kernel is compiled again."""
    package = tmp_path / "rocking"
    package.mkdir()
    for path in (TREE / "rocking").iterdir():
        if path.name not in (*LATER, "products", "__pycache__"):
            (package / path.name).symlink_to(path)
    (package / "products").mkdir()
    for one_path in (TREE / "rocking" / "products").iterdir():
        if one_path.name not in (*THEIR_PRODUCTS, "__pycache__"):
            (package / "products" / one_path.name).symlink_to(one_path)
    for name in ("Snakefile", "workflow", "config", "docs"):
        (tmp_path / name).symlink_to(TREE / name)
    study = tmp_path / "study"
    (study / "records").mkdir(parents=True)
    strong = SyntheticRecord(name="one", seed=7, pulse_period=1.0)
    (study / "records" / "one.AT2").write_text(at2_text(strong))
    (study / "structures.yaml").write_text(
        "- {name: wall, type: wall, height_m: 3.2, thickness_m: 0.25}\n"
        "- {name: roof, type: support, period_s: 0.3, participation: 1.3}\n"
        "- {name: parapet, type: block, breadth_m: 0.4, height_m: 1.4, stands_on: roof}\n"
    )
    (study / "config.yaml").write_text(
        "structures: structures.yaml\ncandidates: 0\nprocessing_variants: false\n"
        "ensemble: {members: 16, reserve: 0}\n"
    )
    return tmp_path


def run(folder: Path, *command: str) -> str:
    """What a command says in `folder`, where the package is imported from."""
    environment = os.environ | {"PYTHONPATH": str(folder)}
    done = subprocess.run(
        [sys.executable, *command], cwd=folder, env=environment, capture_output=True, text=True
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.slow
def test_without_codes_and_fragility_a_record_is_assessed_and_a_study_runs(without) -> None:
    where = run(
        without, "-c", "import rocking, pathlib; print(pathlib.Path(rocking.__file__).parent)"
    ).strip()
    assert where == str(without / "rocking")
    for name in (*LATER, *(f"products.{product}" for product in THEIR_PRODUCTS)):
        with pytest.raises(AssertionError, match="No module named"):
            run(without, "-c", f"import rocking.{name}")

    (record,) = rocking.read(without / "study" / "records" / "one.AT2")
    whole = rocking.assess(record, rocking.Wall.of_size(3.2, 0.25), members=16)
    assert run(without, "-c", ASSESS).strip() == str(whole.verdict)
    command = "-m", "rocking.study.cli"
    run(without, *command, "catalogue", "study/records")
    run(without, *command, "run", "study")
    results = without / "study" / "results"
    for path in (results / "one" / "report.pdf", results / "summary" / "summary.pdf"):
        assert path.read_bytes().startswith(b"%PDF")
    assert (results / "summary" / "verdicts.csv").read_text().count("\n") == 1 + 3
