"""The benchmark for any program: its values are derived again, this package answers it, and it scores what is wrong."""

import csv
import math
import runpy
import subprocess
import sys
from itertools import pairwise
from pathlib import Path

import pytest

import rocking

BENCHMARK = Path(__file__).parents[3] / "docs" / "benchmark"


def _table(path: Path) -> dict[str, dict[str, str]]:
    with path.open(encoding="utf-8") as stream:
        return {row["case"]: row for row in csv.DictReader(stream)}


def _imports(path: Path) -> list[str]:
    lines = path.read_text(encoding="utf-8").splitlines()
    return [line for line in lines if line.startswith(("import ", "from "))]


CASES = _table(BENCHMARK / "cases.csv")


@pytest.fixture(scope="module")
def ours() -> dict[str, float]:
    return runpy.run_path(str(BENCHMARK / "by_rocking.py"))["answers"]()


def test_every_expected_value_is_derived_again_without_this_package():
    derived = runpy.run_path(str(BENCHMARK / "expected.py"))["values"]()
    assert derived.keys() == CASES.keys()
    for case, value in derived.items():
        assert float(CASES[case]["expected"]) == pytest.approx(value, rel=1e-7), case
    assert not any("rocking" in line for line in _imports(BENCHMARK / "expected.py"))


@pytest.mark.parametrize("case", CASES)
def test_this_package_answers_within_the_tolerance(ours, case):
    expected = float(CASES[case]["expected"])
    assert ours[case] == pytest.approx(expected, rel=float(CASES[case]["tolerance"]))


@pytest.mark.parametrize(
    ("breadth", "height", "restitution"),
    [(0.6, 3.0, 0.9), (0.6, 3.0, 0.5), (1.0, 2.0, 0.7), (0.3, 3.0, 0.95), (2.0, 6.0, 0.8)],
)
def test_two_ideal_impulses_are_the_limit_of_short_ones_at_first_order(breadth, height, restitution):
    exact = runpy.run_path(str(BENCHMARK / "expected.py"))["double_impulse"](breadth, height, restitution)
    found = runpy.run_path(str(BENCHMARK / "by_rocking.py"))["double_impulse"]
    block = rocking.Block.of_size(breadth, height, restitution=restitution)
    errors = [found(block, samples) / exact - 1 for samples in (500, 1000, 2000)]
    # Of first order each is twice the next, but for the second order, which is as small as the error itself.
    for longer, shorter in pairwise(errors):
        assert longer == pytest.approx(2 * shorter, rel=2 * longer)
    assert 0 < errors[-1] < 1e-3
    # What is left where the first order is taken out is of the second.
    assert 2 * errors[-1] - errors[-2] == pytest.approx(0, abs=errors[-2] ** 2)


def test_the_answers_that_are_kept_are_those_of_this_version(ours):
    kept = _table(BENCHMARK / "answers" / "rocking.csv")
    for case, value in ours.items():
        assert float(kept[case]["value"]) == pytest.approx(value, rel=1e-6)


def _scored(tmp_path: Path, text: str) -> subprocess.CompletedProcess[str]:
    path = tmp_path / "other.csv"
    path.write_text(text, encoding="utf-8")
    command = [sys.executable, str(BENCHMARK / "score.py"), str(path)]
    return subprocess.run(command, capture_output=True, text=True, check=False)


@pytest.mark.process
@pytest.mark.parametrize(
    ("text", "status", "said"),
    [
        ("case,value\nwall_multiplier,0.3125\n", 0, "0 answers beyond"),
        ("case,value\nwall_multiplier,0.32\n", 1, "1 answers beyond"),
        ("case,value\npulse_two_sided,inf\n", 1, "inf ✗"),
        ("case,value\nnonsense,1\n", 2, ""),
    ],
)
def test_a_wrong_answer_is_counted_and_an_unknown_case_refused(tmp_path, text, status, said):
    done = _scored(tmp_path, text)
    assert done.returncode == status, done.stderr
    assert said in done.stdout


def test_every_case_stands_in_the_readme():
    text = (BENCHMARK / "README.md").read_text(encoding="utf-8")
    assert all(f"`{case}`" in text for case in CASES)
    assert not math.isnan(sum(float(one_case["expected"]) for one_case in CASES.values()))
