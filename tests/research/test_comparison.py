"""The comparison of codes: cases that come again, limits and impacts against what is known, ours without a miss."""

import math
from dataclasses import replace

import numpy as np
import pytest

from docs.research.comparison import lmgc90, table
from docs.research.comparison.cases import SAMPLES, pulse_cases, record_cases
from docs.research.comparison.codes import LMGC90, inner_codes, landings_of, outer_codes
from docs.research.comparison.runs import Answer, limit_of
from docs.research.comparison.table import code_rows, code_scores, missed
from docs.research.reference import event_landings, reference_landings
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism


def test_a_record_is_cut_and_scaled_to_rock():
    draw = np.random.default_rng(1)
    record = Accelerogram(draw.normal(size=3 * SAMPLES) * np.hanning(3 * SAMPLES), 0.01)
    for case in record_cases([record], 6):
        assert case.motion.acceleration.size == SAMPLES
        ratio = case.motion.peak_acceleration / (9.80665 * case.mechanism.uplift_multiplier)
        assert 1.3 <= ratio <= 4.0


def test_the_limit_of_a_known_order():
    first, second = ([0.8 + 0.1 * h**order for h in (4, 2, 1)] for order in (1, 2))
    assert limit_of(first)[0] == pytest.approx(0.8)
    assert limit_of(second)[0] == pytest.approx(0.8)
    assert limit_of(first)[1] == pytest.approx(0.1)
    assert limit_of([0.5, 0.5, 0.5]) == (0.5, 0.0)
    assert math.isinf(limit_of([math.inf] * 3)[0])
    assert math.isnan(limit_of([0.9, math.inf, math.inf])[0])


def test_missed_impacts_are_those_without_a_counterpart():
    expected = np.array([1.0, 2.0, 3.0])
    assert missed(np.array([1.001, 3.0]), expected, 0.01) == 1
    assert missed(np.empty(0), expected, 0.01) == 3
    assert missed(expected, np.empty(0), 0.01) == 0


@pytest.fixture(scope="module")
def block_case():
    """The first block that rocks and does not overturn."""
    return next(
        case
        for case in pulse_cases(60)
        if case.structure == "block" and 0.05 < integrate(case.mechanism, case.motion).rotation_ratio < 0.9
    )


def test_landings_of_a_history_are_the_impacts(block_case):
    response = integrate(block_case.mechanism, block_case.motion, 1e-9, history=True)
    _, landings = reference_landings(block_case.mechanism, block_case.motion)
    inside = landings[landings[:, 0] <= block_case.motion.duration, 0]
    _, by_events = event_landings(block_case.mechanism, block_case.motion, "DOP853", 1e-9)
    assert missed(by_events[:, 0], landings[:, 0], 1e-6) == 0
    assert landings_of(response).size == response.impacts
    assert missed(landings_of(response), inside, 1e-6) == 0


def test_this_package_has_the_reference_s_answer(block_case):
    ours = {name: code for name, code in inner_codes().items() if name.startswith("rocking")}
    reference, *rows = code_rows(block_case, ours)
    assert reference.error == 0.0
    for row, tolerance in zip(rows, (1e-3, 1e-6, 1e-9), strict=True):
        assert row.verdict_agrees
        assert row.error <= 3 * tolerance
        assert row.missed_impacts == 0
    medians = {each.subject: each.value for each in code_scores(rows) if each.measure == "median error"}
    assert medians == {row.code: row.error for row in rows}


def test_the_base_of_lmgc90_moves_as_the_accelerogram():
    """Its velocity is the integral of straight lines between the samples."""
    given = {"acceleration": [0.0, 2.0, -1.0, 0.0], "time_step": 0.1, "frequency_parameter": 10.0}
    times, speed = lmgc90._base(given, 0.01)
    fine = np.linspace(0, times[-1], 200_001)
    acceleration = np.interp(fine, np.arange(4) * 0.1, given["acceleration"], right=0.0)
    exact = np.concatenate([[0], np.cumsum((acceleration[1:] + acceleration[:-1]) / 2 * np.diff(fine))])
    assert speed == pytest.approx(np.interp(times, fine, exact), abs=1e-6)


def test_lmgc90_tends_to_the_same_block(block_case):
    """First order in time, with impacts known to a step: a few percent after extrapolation."""
    pytest.importorskip("compas_lmgc90", reason="install the extra compare to run this test")
    answer = outer_codes()[LMGC90](block_case)
    truth = integrate(block_case.mechanism, block_case.motion, 1e-9).rotation_ratio
    assert answer.reason == ""
    assert answer.rotation_ratio == pytest.approx(truth, rel=0.05)


def test_a_code_that_is_not_there_says_so(block_case, monkeypatch):
    from docs.research.comparison import codes

    monkeypatch.setattr(codes, "_DRIVERS", {"nothing": "docs.research.comparison.absent"})
    answer = codes.outer_codes()["nothing"](replace(block_case))
    assert math.isnan(answer.rotation_ratio)
    assert "No module named" in answer.reason


def test_what_solves_another_model_has_no_error(block_case):
    """Its rotation stands beside the reference and beside ours with its own restitution, in a table of its own."""
    answer = Answer(0.3, 1.0, 0.01, landings=np.empty(0), restitution=0.5)
    row = table._row(replace(block_case, structure="arch"), LMGC90, answer, 0.4, np.array([1.0]))
    assert row.another_model
    assert math.isnan(row.error)
    assert row.missed_impacts is None
    side = replace(block_case.mechanism.positive, restitution=0.5)
    expected = integrate(Mechanism(side), block_case.motion, 1e-9).rotation_ratio
    assert row.same_restitution_rotation_ratio == pytest.approx(expected, rel=1e-5)
