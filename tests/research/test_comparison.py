"""The comparison of codes: its reference, the structures as separate bodies, limits and impacts against what is known.

The reference is held against the tests' own integrator, with which it shares no code.
"""

import math
from dataclasses import replace
from importlib.util import find_spec
from itertools import pairwise

import numpy as np
import pytest
from motion_cases import MECHANISMS, noise
from oracle import Oracle
from scipy.constants import g

from docs.research.comparison import codes, lmgc90, table
from docs.research.comparison.bodies import properties, rigid_bodies
from docs.research.comparison.codes import CodeCase, pulse_cases, structures
from docs.research.comparison.table import code_rows, code_scores, missed
from docs.research.reference import landings
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.structures import Mechanism


def record_for(mechanism, seed, times):
    lift = g * max(side.uplift_multiplier for side in mechanism.sides)
    return noise(seed, 60, 0.02, times * lift)


@pytest.mark.parametrize("name", [name for name in MECHANISMS if name != "arch"])
def test_reference_equals_the_oracle(name):
    """Both at 1e-12 or tighter; the flights of 60 samples amplify errors a few hundred times at most."""
    mechanism = MECHANISMS[name]
    record = record_for(mechanism, 4, 1.2 if name == "two sides" else 1.8)
    expected, impacts = Oracle(mechanism).run(record.acceleration, record.time_step)
    assert impacts >= 2
    assert 0.001 < expected < np.inf
    assert landings(mechanism, record)[0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize("method", ["RK45", "DOP853"])
def test_events_converge_to_the_reference(method):
    """Each thousandfold tolerance brings it closer; at 1e-9 the kinks that no step meets leave less than 1e-5."""
    mechanism = MECHANISMS["block"]
    record = record_for(mechanism, 3, 2.0)
    truth, _ = landings(mechanism, record)
    errors = [
        abs(landings(mechanism, record, method, rtol, restart=False)[0] / truth - 1) for rtol in (1e-3, 1e-9)
    ]
    assert errors[1] < min(errors[0] / 10, 1e-5)


def test_the_limit_of_a_known_order():
    first, second = ([0.8 + 0.1 * h**order for h in (4, 2, 1)] for order in (1, 2))
    assert codes.limit_of(first) == pytest.approx((0.8, 0.1))
    assert codes.limit_of(second)[0] == pytest.approx(0.8)
    assert codes.limit_of([0.5, 0.5, 0.5]) == (0.5, 0.0)
    assert math.isinf(codes.limit_of([math.inf] * 3)[0])
    assert math.isnan(codes.limit_of([0.9, math.inf, math.inf])[0])


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
    _, expected = landings(block_case.mechanism, block_case.motion)
    inside = expected[expected[:, 0] <= block_case.motion.duration, 0]
    _, by_events = landings(block_case.mechanism, block_case.motion, "DOP853", 1e-9, restart=False)
    assert missed(by_events[:, 0], expected[:, 0], 1e-6) == 0
    assert codes.landings_of(response).size == response.impacts
    assert missed(codes.landings_of(response), inside, 1e-6) == 0
    assert missed(inside[1:], inside, 1e-6) == 1


def test_this_package_has_the_reference_s_answer(block_case):
    ours = {name: code for name, code in codes.inner_codes().items() if name.startswith("rocking")}
    reference, *rows = code_rows(block_case, ours)
    assert reference.error == 0.0
    for row, tolerance in zip(rows, (1e-3, 1e-6, 1e-9), strict=True):
        assert row.verdict_agrees
        assert row.error <= 3 * tolerance
        assert row.missed_impacts == 0
    medians = {score.subject: score.value for score in code_scores(rows) if score.measure == "median error"}
    assert medians == {row.code: row.error for row in rows}


def test_what_solves_another_model_has_no_error(block_case):
    """Its rotation stands beside the reference and beside ours with its own restitution, in a table of its own."""
    answer = codes.Answer(0.3, 1.0, 0.01, landings=np.empty(0), restitution=0.5)
    row = table._row(replace(block_case, structure="arch"), codes.LMGC90, answer, 0.4, np.array([1.0]))
    assert row.another_model
    assert math.isnan(row.error)
    assert row.missed_impacts is None
    side = replace(block_case.mechanism.positive, restitution=0.5)
    expected = integrate(Mechanism(side), block_case.motion, 1e-9).rotation_ratio
    assert row.same_restitution_rotation_ratio == pytest.approx(expected, rel=1e-5)


def test_the_voussoirs_are_the_bars_of_the_arch():
    """Three, two and two of them have the centroids of AB, BC and CD; neighbours share two corners, a thickness apart.

    On an abutment both lie on one of its edges.
    """
    arch = structures()["arch"]
    bodies = rigid_bodies(arch)
    assert bodies.hinges == ((0, 3, 5, 7), (7, 4, 2, 0))
    areas, centroids, _ = zip(*map(properties, bodies.polygons[1:-1]), strict=True)
    assert areas == pytest.approx([areas[0]] * 7)
    for bar, (first, end) in enumerate(((0, 3), (3, 5), (5, 7))):
        assert np.mean(centroids[first:end]) == pytest.approx(arch.linkages[0].rest[bar], abs=1e-12)
    left, *voussoirs, right = (polygon @ [1, 1j] for polygon in bodies.polygons)
    for one, other in pairwise(voussoirs):
        shared = one[np.abs(one[:, None] - other).min(axis=1) < 1e-12]
        assert abs(shared[0] - shared[1]) == pytest.approx(arch.thickness)
    for abutment, voussoir in ((left, voussoirs[0]), (right, voussoirs[-1])):
        along = np.roll(abutment, -1) - abutment
        beside = (along.conj() * (voussoir[:, None] - abutment)).imag / np.abs(along)
        assert max((np.abs(beside) < 1e-12).sum(axis=0)) == 2
        assert (beside.min(axis=1) < 1e-12).all(), "it overlaps"


def test_restitution_and_landings_of_a_history_that_is_known():
    """Half waves whose energy is the square of their height, each 0.8 of the one before."""
    times = np.linspace(0, 4, 4001)
    rotation = 0.1 * 0.8 ** np.floor(times) * np.sin(np.pi * times) * (times < 3.999)
    assert codes.landings(times + 1e-4, rotation)[:3] == pytest.approx([1.0, 2.0, 3.0], abs=2e-3)
    assert codes.restitution(times, rotation, rotation**2, 0.9, 1.0) == pytest.approx(0.8)
    assert math.isnan(codes.restitution(times, rotation, rotation**2, 2.9, 1.0))


def test_the_base_of_lmgc90_moves_as_the_accelerogram():
    """Its velocity is the integral of straight lines between the samples."""
    case = {"acceleration": [0.0, 2.0, -1.0, 0.0], "time_step": 0.1, "frequency_parameter": 10.0}
    times, speed = lmgc90.base_speed(case, 0.01)
    fine = np.linspace(0, times[-1], 200_001)
    acceleration = np.interp(fine, np.arange(4) * 0.1, case["acceleration"], right=0.0)
    exact = np.concatenate([[0], np.cumsum((acceleration[1:] + acceleration[:-1]) / 2 * np.diff(fine))])
    assert speed == pytest.approx(np.interp(times, fine, exact), abs=1e-6)


LMGC90_ONLY = pytest.mark.skipif(
    not find_spec("compas_lmgc90"), reason="install the extra compare to run this test"
)


@LMGC90_ONLY
@pytest.mark.parametrize("share, lifts", [(0.98, False), (1.02, True)])
def test_the_arch_of_lmgc90_lifts_where_limit_analysis_says(share, lifts):
    """Oppenheim's arch, λ = 0.370, after 0.4 s of constant acceleration: above λ the hinges of the mechanism open."""
    arch = structures()["arch"]
    critical = arch.mechanism().critical_rotation
    case = {"time_step": 0.005, "frequency_parameter": 1e9, "critical_rotation": critical}
    case["acceleration"] = [share * 0.370009738022 * g] * 81
    bodies = rigid_bodies(arch)
    _, turns, _ = lmgc90.follow(case, bodies, 1e-3)
    largest = float(np.abs(bodies.rotation(turns)).max()) / critical
    assert largest > 1e-2 if lifts else largest < 1e-3
    assert not lifts or bodies.outside_hinges(turns[-1]) < 0.02


@LMGC90_ONLY
def test_the_frame_of_lmgc90_keeps_what_angular_momentum_keeps():
    """Inelastic shocks at the new pivots: (1 − 1.5 sin²α + 3γ cos 2α)/(1 + 3γ), to first order in the time step."""
    mechanism = structures()["frame"].mechanism()
    pulse = np.append(np.sin(np.arange(51) * 2 * np.pi / 50), 0.0) * 2 * mechanism.uplift_multiplier * g
    motion = Accelerogram(pulse, 0.01)
    answer = codes.outer_codes()[codes.LMGC90](CodeCase("", "frame", "pulse", mechanism, motion))
    truth, _ = landings(mechanism, motion)
    alpha, gamma = math.atan(0.5 / 4.0), 1.0
    kept = (1 - 1.5 * math.sin(alpha) ** 2 + 3 * gamma * math.cos(2 * alpha)) / (1 + 3 * gamma)
    # A first-order method at three steps: a percent of η, a few of φ.
    assert answer.reason == "" and answer.restitution == pytest.approx(kept, abs=0.015)
    assert answer.rotation_ratio == pytest.approx(truth, rel=0.05)
