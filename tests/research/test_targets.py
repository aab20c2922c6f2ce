"""The targets beside a study, each at its smallest: what it writes is complete, and its figures can be true."""

import json
import shutil
from collections import Counter
from pathlib import Path

import pytest
import yaml
from made_campaign import write_campaign

from docs.research.code_checks import WallRow
from docs.research.ensembles import EnsembleTrial
from docs.research.scores import Score
from docs.research.validation import PredictionRow
from rocking.quantities import GRAVITY
from rocking.tables import read_table
from tests.synthetic import SyntheticRecord, at2_text
from tests.workflow.conftest import SmallStudy, new_study

pytestmark = pytest.mark.slow

TESTS = 16
TARGETS = {
    "calibrate_ensemble": {"scores.csv", "ensemble_trials.csv"},
    "validate": {"scores.csv", "predictions.csv"},
    "code_check": {"scores.csv", "walls.csv"},
}
"""With the tables of each."""
BLOCKS = """
- {name: slender, type: block, breadth_m: 0.6, height_m: 4.0}
- {name: stout, type: block, breadth_m: 1.8, height_m: 5.7}
"""
LOG = "results/summary/logs"
ROOT = Path(__file__).parents[2]


def _strong(number: int) -> bytes:
    """A record of a station of its own, whose pulse lifts and overturns."""
    made = SyntheticRecord(
        name=f"made_{number}", seed=number, pulse_amplitude=2 + 0.3 * number, pulse_period=0.5 + 0.15 * number
    )
    return at2_text(made).encode()


@pytest.fixture(scope="module")
def asked(tree, tmp_path_factory) -> SmallStudy:
    """A study that was not run, and what the targets beside it made of made records."""
    study = new_study(tmp_path_factory.mktemp("targets") / "study", tree)
    study.add("near_1", _strong(1))
    shipped = SmallStudy(tree, tree)
    shutil.copytree(
        ROOT / "records", tree / "records", ignore=shutil.ignore_patterns("*.csv")
    )  # the paper draws them
    for name, places in {"near_fault": ("near_1", "near_2", "near_3"), "fema_p695": ("far_4",)}.items():
        for place in places:
            shipped.add(place, _strong(int(place[-1])))
        (tree / "records" / "catalogue.csv").rename(tree / "records" / f"{name}.csv")
    mirror = study.folder / "shake_table"
    mirror.mkdir()
    write_campaign(mirror, tree / "records" / "shake_table.csv", TESTS)
    (study.folder / "config.yaml").write_text(yaml.safe_dump({"mirror": str(study.folder)}))
    (study.folder / "structures.yaml").write_text(BLOCKS)
    study.run(*TARGETS, "paper")
    return study


@pytest.mark.parametrize("target", TARGETS)
def test_a_target_writes_its_tables_and_its_report(asked, target):
    folder = asked.results / target
    described = json.loads((folder / "datapackage.json").read_text())["resources"]
    assert {value["path"] for value in described} == TARGETS[target]
    assert (folder / "report.pdf").read_bytes().startswith(b"%PDF")
    scores = read_table(Score, folder)
    assert scores
    for score in scores:
        assert score.sites <= score.cases
        assert not score.value_low > score.value_high


def test_calibrate_ensemble_tries_every_record(asked):
    trials = read_table(EnsembleTrial, asked.results / "calibrate_ensemble")
    assert {row.record for row in trials} == {"near_1", "near_2", "near_3", "far_4"}
    assert len(trials) == 4 * 3 and any(0 < row.share_drawn < 1 for row in trials)


def test_code_check_holds_every_wall_beside_every_record(asked):
    """The linear ratio of a cantilever by hand: α_0 = b/h, e* = 1 and q = 2 on soil B, where S_S falls with a_g."""
    rows = read_table(WallRow, asked.results / "code_check")
    kinds = Counter(row.kind for row in rows)
    assert kinds == {
        "cantilever": 143,
        "wall, hinge of statics": 143,
        "wall, hinge at mid-height": 143,
    }
    assert {row.records for row in rows} == {4}
    assert any(0 < row.overturning < 4 for row in rows)
    design = 0.25 * GRAVITY
    for row in rows:
        if row.kind == "cantilever":
            level = row.linear_ratio * design / 2
            soil = min(max(1.4 - 0.4 * 2.45 * level / GRAVITY, 1.0), 1.2)
            assert level * soil == pytest.approx(row.thickness_m / row.height_m * GRAVITY / 1.35, rel=1e-9)
        assert row.nonlinear_ratio * design >= row.linear_ratio * design / 2 * (1 - 1e-9)
    scores = read_table(Score, asked.results / "code_check")
    for kind, formula in (("nonlinear", "nonlinear_ratio"), ("linear", "linear_ratio")):
        passed = [
            row for row in rows if row.kind != "wall, hinge at mid-height" and getattr(row, formula) >= 1
        ]
        (score,) = (
            one_score
            for one_score in scores
            if one_score.subject == f"{kind}, FC 1.35"
            and one_score.part.startswith("all")
            and one_score.measure.startswith("unsafe")
        )
        assert score.measure == f"unsafe of the {len(passed)} that pass"
        assert score.sites == 4
        unsafe = sum(row.overturning / row.records > 0.1 for row in passed)
        assert score.value == pytest.approx(unsafe / len(passed))


def test_validate_predicts_what_the_tests_showed(asked):
    """The made specimens overturn above a peak, so that the nominal peak velocity, in proportion to it, never errs."""
    rows = read_table(Score, asked.results / "validate")
    accuracy = {(row.part, row.subject): row for row in rows if row.measure == "accuracy"}
    # the second specimen stands at half a g, as no block of its p would
    for specimen, least in (("specimen 1", 0.8), ("specimen 2", 0.5)):
        assert accuracy[specimen, "threshold on peak velocity, nominal"].value == 1.0
        identified = accuracy[specimen, "identified population"]
        assert (identified.cases, identified.sites) == (TESTS, TESTS // 4)
        assert least < identified.value <= 1
    predictions = read_table(PredictionRow, asked.results / "validate")
    fell = {(row.specimen, row.test) for row in predictions if row.overturned}
    assert len(fell) == TESTS // 2 + TESTS // 4


def test_paper_redraws_what_it_can(asked):
    (line,) = (asked.folder / LOG / "paper.log").read_text().splitlines()
    assert line.endswith("records/near_fault.csv lists no RSN1063_NORTHR_RRS228.")
    assert (asked.results / "paper" / "paper.pdf").read_bytes().startswith(b"%PDF")
