"""The targets beside a study, each at its smallest: what it writes is complete, and its figures can be true."""

import csv
import json
import math
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml
from made_campaign import write_campaign

import rocking
from docs.research.comparison import table as comparison
from rocking.assessment.fidelity import Tier
from rocking.records import Accelerogram
from rocking.records.synthetic import SyntheticRecord, at2_text
from rocking.tables import read_table
from tests.workflow.conftest import SmallStudy, new_study

pytestmark = pytest.mark.slow

TESTS = 16
BLOCKS = """
- {name: slender, type: block, breadth_m: 0.6, height_m: 4.0}
- {name: stout, type: block, breadth_m: 1.8, height_m: 5.7}
"""
LOG = "results/summary/logs"


def _strong(number: int) -> bytes:
    """A record of a station of its own, whose pulse lifts and overturns."""
    recipe = SyntheticRecord(
        f"made_{number}", number, 2 + 0.3 * number, 0.5 + 0.15 * number, 1.0, 1.0, 6.0, 0.01
    )
    return at2_text(recipe).encode()


@pytest.fixture(scope="module")
def asked(tree, tmp_path_factory) -> SmallStudy:
    """A study that was not run, and what the targets beside it made of made records."""
    study = new_study(tmp_path_factory.mktemp("targets") / "study", tree)
    study.add("near_1", _strong(1))
    shipped = SmallStudy(tree, tree)
    (tree / "records").mkdir()
    for drawn in (Path(__file__).parents[2] / "records").glob("*.V2A"):  # what the paper's figures draw
        (tree / "records" / drawn.name).write_bytes(drawn.read_bytes())
    for name, places in {"near_fault": ("near_1", "near_2", "near_3"), "fema_p695": ("far_4",)}.items():
        for place in places:
            shipped.add(place, _strong(int(place[-1])))
        (tree / "records" / "catalogue.csv").rename(tree / "records" / f"{name}.csv")
    mirror = study.folder / "shake_table"
    mirror.mkdir()
    write_campaign(mirror, tree / "records" / "shake_table.csv", TESTS)
    (study.folder / "config.yaml").write_text(yaml.safe_dump({"mirror": str(study.folder)}))
    (study.folder / "structures.yaml").write_text(BLOCKS)
    targets = ("calibrate", "calibrate_ensemble", "paper", "validate")
    done = study.run(*targets)
    assert done.returncode == 0, done.stdout
    return study


@pytest.fixture(scope="module")
def rows(asked) -> Callable[[str], list[dict[str, str]]]:
    def read(path: str) -> list[dict[str, str]]:
        with (asked.results / path).open(encoding="utf-8", newline="") as stream:
            return list(csv.DictReader(stream))

    return read


def test_calibrate_fits_and_judges_every_tier(rows, asked):
    scores = {(row["subject"], row["measure"]): row for row in rows("calibrate/scores.csv")}
    for tier in Tier:
        skill, best = scores[tier, "Brier skill"], scores[tier, "Brier skill of the shares themselves"]
        assert 0 < float(skill["value_low"]) <= float(skill["value"]) < float(best["value"]) < 1
        assert skill["sites"] == "4", "three of the near-fault catalogue and one of the other"
    assert ("fidelity: auto", "wrong verdicts among those settled") in scores
    fits = json.loads((asked.results / "calibrate" / "tiers.json").read_text())
    assert set(fits["tiers"]) == set(Tier) and fits["about"]["sites"] == 4
    assert "1 of 1: far_4" in (asked.folder / LOG / "calibrate.log").read_text()


def test_calibrate_ensemble_holds_ensembles_against_draws(rows, asked):
    trials = rows("calibrate_ensemble/ensemble_trials.csv")
    assert {row["record"] for row in trials} == {"near_1", "near_2", "near_3", "far_4"}
    assert len(trials) == 4 * 3, "three trials a record"
    assert {row["half"] for row in trials if row["record"] == "far_4"} == {"left out"}
    for row in trials:
        drawn = float(row["share_drawn"])
        # four standard errors of 256 independent members, to which a lattice is superior, and the last digit
        allowed = 4 * math.sqrt(drawn * (1 - drawn) / 256) + 1 / 256
        assert abs(float(row["share_256"]) - drawn) <= allowed
    assert any(0 < float(row["share_drawn"]) < 1 for row in trials)
    assert (asked.results / "calibrate_ensemble" / "report.pdf").read_bytes().startswith(b"%PDF")


def test_compare_runs_every_case_through_every_code(tmp_path, monkeypatch):
    """Other codes are not tried, whether they are installed or not."""
    monkeypatch.setattr(comparison, "outer_codes", dict)
    records = [record for number in (1, 2) for record in _read(tmp_path, number)]
    comparison.write_comparison(records, tmp_path, print, share=0.01)
    table = read_table(comparison.CodeRow, tmp_path)
    cases = {row.case for row in table}
    assert len(cases) == 4, "one percent of the pulses and of the records, rounded up"
    for row in table:
        if row.code == "rocking, tolerance 1e-09":
            assert row.verdict_agrees and row.error < 1e-6
    for code in ("rocking, tolerance 1e-03", "scipy RK45, 1e-6", "scipy DOP853, 1e-12 (reference)"):
        assert {row.case for row in table if row.code == code} == cases
    assert (tmp_path / "report.pdf").read_bytes().startswith(b"%PDF")


def _read(folder: Path, number: int) -> list[Accelerogram]:
    path = folder / f"made_{number}.AT2"
    path.write_bytes(_strong(number))
    return rocking.read(path)


def test_validate_predicts_what_the_tests_showed(rows, asked):
    """The made specimens overturn above a peak, so that the nominal peak velocity, in proportion to it, never errs."""
    scores = {(row["part"], row["subject"], row["measure"]): row for row in rows("validate/scores.csv")}
    # the second specimen stands at half a g, as no block of its p would
    for specimen, least in (("specimen 1", 0.8), ("specimen 2", 0.5)):
        assert scores[specimen, "threshold on peak velocity, nominal", "accuracy"]["value"] == "1.0"
        found = scores[specimen, "identified population", "accuracy"]
        assert (found["cases"], found["sites"]) == (str(TESTS), str(TESTS // 4))
        assert least < float(found["value"]) <= 1
    said = rows("validate/predictions.csv")
    fell = {(row["specimen"], row["test"]) for row in said if row["overturned"] == "true"}
    assert len(fell) == TESTS // 2 + TESTS // 4
    assert (asked.results / "validate" / "report.pdf").read_bytes().startswith(b"%PDF")


def test_paper_redraws_what_it_can(rows, asked):
    (said,) = (asked.folder / LOG / "paper.log").read_text().splitlines()
    assert said.endswith("records/near_fault.csv lists no RSN1063_NORTHR_RRS228.")
    for figure in ("figure_3", "figure_4", "figure_6", "figure_7", "equation_14", "pulse_spectrum"):
        assert len(rows(f"paper/{figure}.csv")) > 30
        assert "<svg" in (asked.results / "paper" / f"{figure}.svg").read_text()
    assert (asked.results / "paper" / "paper.pdf").read_bytes().startswith(b"%PDF")
