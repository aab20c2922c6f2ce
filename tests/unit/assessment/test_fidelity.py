"""The choice of the cheapest method: the rule, what calibrates it, and what it does on real records it never saw."""

import itertools
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.constants import g

from rocking.assessment.assess import AssessmentSettings, Method, assess_structures
from rocking.assessment.fidelity import (
    LIMITS,
    Limits,
    cheapest_answer,
    known_error,
    limits_for,
    stays_at_rest,
)
from rocking.assessment.rows import Identity, comparison_row
from rocking.calibration.fidelity import (
    RIGHT,
    RISKS,
    TOLERANCES,
    HeldOut,
    choose_limits,
    halves,
    held_out,
    is_right,
    is_unsafe,
    write_fidelity,
)
from rocking.calibration.lights import distinct_components, grid_of_blocks
from rocking.calibration.trials import Trial, trials
from rocking.errors import RockingError
from rocking.motion.integration import integrate
from rocking.pulses import Light
from rocking.records import Accelerogram, load_catalogue, open_record
from rocking.reports.record.verdict import verdict_sentences, verdict_table
from rocking.sine_pulse import Maximum, Regime
from rocking.structures import Arch, Block
from rocking.structures.outcome import Outcome
from rocking.tables import read_rows

STEP = 0.01
TIMES = np.arange(400) * STEP
BLOCK = Block(2.0, 0.2)
MECHANISM = BLOCK.mechanism()
EQUIVALENT = MECHANISM.equivalent_block("uplift")
TRUSTING = Limits(
    tolerance=0.1,
    risk=0.01,
    closed_form_margin=0.5,
    known_error=0.1,
    rotation_ratio=0.7,
    sensitivity=1e9,
    answers=0,
    right=1.0,
    unsafe=0.0,
)
ROCKS = Maximum(0.3, Outcome.ROCKS, Regime.PRINTED_EXACT, 1, 1, 0.6)
FALLS = Maximum(math.inf, Outcome.OVERTURNS, Regime.OVERTURNS_WITHOUT_IMPACT, 0, 1, -2.0)


def record(peak: float) -> Accelerogram:
    """A sine of 0.8 s that swells and fades; `peak` in units of λ g."""
    shape = np.sin(2 * np.pi * TIMES / 0.8) * np.sin(np.pi * TIMES / TIMES[-1]) ** 2
    return Accelerogram(shape / np.abs(shape).max() * peak * MECHANISM.uplift_multiplier * g, STEP)


def answer(peak=1.5, closed_form=(Light.GREEN, ROCKS), limits=TRUSTING, **settings):
    return cheapest_answer(MECHANISM, EQUIVALENT, record(peak), closed_form, limits, **settings)


@pytest.mark.parametrize("excess, rests", [(-1e-9, True), (1e-9, False)])
def test_rest_ends_at_the_uplift_acceleration(excess, rests):
    level = np.full(50, (1 + excess) * MECHANISM.uplift_multiplier * g)
    assert stays_at_rest(MECHANISM, Accelerogram(level, STEP)) is rests
    assert (integrate(MECHANISM, Accelerogram(level, STEP)).outcome is Outcome.NO_UPLIFT) is rests


def test_vertical_acceleration_can_end_the_rest():
    """0.9 λ g lifts where gravity is 0.8 g."""
    still = record(0.9)
    assert stays_at_rest(MECHANISM, still)
    assert not stays_at_rest(MECHANISM, still, Accelerogram(np.full(400, -0.2 * g), STEP))


def test_nothing_is_integrated_below_uplift():
    found = answer(peak=0.99)
    assert (found.method, found.rotation_ratio, found.outcome) == (
        Method.NOTHING_TO_INTEGRATE,
        0.0,
        Outcome.NO_UPLIFT,
    )


def test_known_error_of_a_block_is_that_of_its_sine():
    """g sin α/(4R/3) against (3g/4R) α: the ratio sin α / α, and λ is kept by the uplift scale."""
    assert known_error(MECHANISM, EQUIVALENT) == pytest.approx(math.log(0.2 / math.sin(0.2)), rel=1e-12)


def test_known_error_counts_a_missed_uplift():
    """a_sc of a block is 1, so the linearised block lifts at α g instead of g tan α."""
    linearised = MECHANISM.equivalent_block("linearised")
    assert known_error(MECHANISM, linearised) == pytest.approx(math.log(math.tan(0.2) / 0.2), rel=1e-9)


def test_known_error_foretells_the_error_of_a_small_rotation():
    """Measured by integration: after a short push, each turns in proportion to its restoring acceleration."""
    arch = Arch(10.0, 1.5, np.deg2rad(157.5), restitution=0.9).mechanism()
    block = arch.equivalent_block("uplift")
    push = np.zeros(200)
    push[2:6] = -1.3 * arch.uplift_multiplier * g
    motion = Accelerogram(push, 0.002)
    miss = math.log(integrate(arch, motion).rotation_ratio / integrate(block, motion).rotation_ratio)
    assert 0 < integrate(arch, motion).rotation_ratio < 0.01
    assert abs(miss) == pytest.approx(known_error(arch, block), rel=0.05)


@pytest.mark.parametrize(
    "closed_form, method",
    [
        ((Light.GREEN, FALLS), Method.CLOSED_FORM),
        ((Light.AMBER, FALLS), Method.CLOSED_FORM),
        ((Light.RED, FALLS), Method.BLOCK_ON_RECORD),
        ((Light.GREEN, replace(FALLS, overturning_margin=-0.4)), Method.BLOCK_ON_RECORD),
        ((Light.GREEN, ROCKS), Method.BLOCK_ON_RECORD),
        (None, Method.BLOCK_ON_RECORD),
    ],
)
def test_the_closed_form_answers_overturning_with_a_margin_alone(closed_form, method):
    found = answer(closed_form=closed_form)
    assert found.method is method
    if method is Method.CLOSED_FORM:
        assert (found.rotation_ratio, found.response) == (math.inf, None)


def test_the_block_answers_with_its_own_rotation():
    found = answer()
    assert found.rotation_ratio == integrate(EQUIVALENT, record(1.5)).rotation_ratio
    assert found.response.fragile is False
    assert found.rotation_ratio != integrate(MECHANISM, record(1.5)).rotation_ratio


@pytest.mark.parametrize(
    "limits",
    [
        None,
        replace(TRUSTING, known_error=0.001),
        replace(TRUSTING, rotation_ratio=0.01),
        replace(TRUSTING, sensitivity=0.01),
    ],
)
def test_what_is_not_trusted_is_integrated(limits):
    found = answer(limits=limits)
    assert found.method is Method.MECHANISM_ON_RECORD
    assert found.rotation_ratio == integrate(MECHANISM, record(1.5)).rotation_ratio
    assert found.response.times is not None


def test_a_block_near_overturning_is_not_trusted():
    """Just below the amplitude at which it first overturns, 3 % more of the motion topples it."""
    low, high = 1.5, 1.5
    while not math.isinf(integrate(EQUIVALENT, record(high)).rotation_ratio):
        low, high = high, high + 0.01
    assert (
        answer(peak=low, limits=replace(TRUSTING, rotation_ratio=10.0)).method is Method.MECHANISM_ON_RECORD
    )


def test_with_vertical_motion_nothing_is_trusted():
    vertical = Accelerogram(np.zeros(400), STEP)
    assert answer(closed_form=(Light.GREEN, FALLS), vertical=vertical).method is Method.MECHANISM_ON_RECORD


def test_limits_are_never_looser_than_asked_for():
    for tolerance, risk in itertools.product((0.01, 0.03, 0.1, 0.7), (0.001, 0.02, 0.3)):
        found = limits_for(tolerance, risk)
        assert found.tolerance <= tolerance
        assert found.risk <= risk
    assert limits_for(0.03, 0.02) == next(row for row in LIMITS if (row.tolerance, row.risk) == (0.02, 0.01))
    assert limits_for(0.005, 0.01) is None
    assert limits_for(0.1, 0.0) is None


def test_the_shipped_limits_keep_their_own_promises():
    assert {(row.tolerance, row.risk) for row in LIMITS} == set(itertools.product(TOLERANCES, RISKS))
    for row in LIMITS:
        assert row.unsafe <= row.risk
        assert row.right >= RIGHT
        assert row.known_error <= row.tolerance


def test_another_table_of_limits_is_refused(tmp_path):
    (tmp_path / "limits.csv").write_text("tolerance,risk\n0.1,0.01\n")
    with pytest.raises(RockingError, match="closed_form_margin"):
        list(read_rows(Limits, tmp_path / "limits.csv"))


@pytest.mark.parametrize(
    "found, truth, right, unsafe",
    [
        (0.5, 0.52, True, False),
        (0.5, 0.6, False, True),
        (0.6, 0.5, False, False),
        (0.0, 0.01, False, True),
        (0.9, math.inf, False, True),
        (math.inf, 0.9, False, False),
        (math.inf, math.inf, True, False),
        (0.0, 0.0, True, False),
    ],
)
def test_right_and_unsafe(found, truth, right, unsafe):
    assert is_right(found, truth, 0.1) is right
    assert is_unsafe(found, truth, 0.1) is unsafe


def trial(site, sensitivity, block, mechanism, **changes) -> Trial:
    made = Trial(
        "r",
        site,
        "s",
        1.0,
        False,
        Light.RED,
        0.5,
        0.01,
        block,
        sensitivity,
        False,
        mechanism,
        1,
        2,
        8,
        10,
        40,
    )
    return replace(made, **changes)


def planted(per_site=40) -> list[Trial]:
    """Ten sites: the block is right where its sensitivity is 3 and half as large as it should be where it is 30."""
    sites = [f"site {k}" for k in range(10)]
    calm = [trial(site, 3.0, 0.3, 0.31) for site in sites for _ in range(per_site)]
    wild = [trial(site, 30.0, 0.3, 0.6) for site in sites for _ in range(per_site // 4)]
    return calm + wild


def test_limits_leave_out_what_is_unsafe():
    limits = choose_limits(planted(), 0.1, 0.01)
    assert 3 <= limits.sensitivity < 30
    assert (limits.answers, limits.right, limits.unsafe) == (400, 1.0, 0.0)


def test_too_little_evidence_earns_no_trust():
    """Of 1 % risk, 90 answers without an unsafe one say too little: one more would make 1.1 %."""
    few = [trial(f"site {k}", 3.0, 0.3, 0.31) for k in range(10) for _ in range(9)]
    assert choose_limits(few, 0.1, 0.01).answers == 0
    assert choose_limits(few, 0.1, 0.05).answers == 90


def test_one_bad_site_is_enough():
    """The promise holds whichever one site is left out, so what is wrong at two of ten is not hidden by the rest."""
    spoilt = [replace(t, mechanism_ratio=0.6) if t.site in ("site 0", "site 1") else t for t in planted()]
    assert choose_limits(spoilt, 0.1, 0.01).answers == 0


def test_margins_of_the_closed_form_are_chosen_to_be_right():
    falls = [
        trial(f"site {k}", 0.0, 0.9, math.inf if margin < -1.5 else 0.9, light=Light.GREEN, margin=margin)
        for k in range(10)
        for margin in (-0.2, -0.7, -3.0, -4.0, -5.0, -6.0)
    ]
    assert choose_limits(falls, 0.1, 0.01).closed_form_margin == 1.0


def test_time_counts_what_was_tried_in_vain():
    """1 s of closed form, 2 s of the block, 8 s of its sensitivity, 10 s of the mechanism and 40 s with its own."""
    limits = replace(TRUSTING, closed_form_margin=math.inf, rotation_ratio=0.5, sensitivity=10.0)
    calm, wild, high = trial("a", 3.0, 0.3, 0.3), trial("a", 30.0, 0.3, 0.6), trial("a", 3.0, 0.8, 0.8)
    assert [t.duration(limits, full=True) for t in (calm, wild, high)] == [11, 51, 43]
    assert [t.duration(limits, full=False) for t in (calm, wild, high)] == [11, 21, 13]
    assert trial("a", 0.0, 0.0, 0.0, at_rest=True).duration(limits, full=True) == 0
    found = held_out("held out", [calm, wild, high], limits)
    assert found.time_saved_full == pytest.approx(1 - 105 / 120)
    assert (found.block, found.mechanism, found.right) == pytest.approx((1 / 3, 2 / 3, 1.0))


def test_halves_share_no_site():
    first, second = halves(planted())
    assert not {t.site for t in first} & {t.site for t in second}
    assert len({t.site for t in first}) == len({t.site for t in second}) == 5


def test_a_study_answers_with_the_cheapest():
    settings = AssessmentSettings(fidelity="auto", bootstrap_replicates=0)
    (case,) = assess_structures(record(1.5), {"block": BLOCK}, settings).cases
    assert set(case.responses) <= {Method.BLOCK_ON_RECORD, Method.MECHANISM_ON_RECORD}
    assert len(case.responses) == 1
    (whole,) = assess_structures(record(1.5), {"block": BLOCK}, replace(settings, fidelity="full")).cases
    assert whole.answer.method is Method.MECHANISM_ON_RECORD
    assert case.answer.rotation_ratio == pytest.approx(whole.answer.rotation_ratio, rel=0.1)


def test_a_report_says_what_answered():
    """A cheap method says that the block overturns, and the report must not call that nothing."""
    settings = AssessmentSettings(fidelity="auto", bootstrap_replicates=0)
    assessment = assess_structures(record(12.0), {"block": BLOCK}, settings)
    assert assessment.cases[0].answer.method in (Method.CLOSED_FORM, Method.BLOCK_ON_RECORD)
    identity = Identity("r", assessment.accelerogram, "")
    rows = [comparison_row(identity, case) for case in assessment.cases]
    assert math.isnan(rows[0].integrated_rotation_ratio)
    assert rows[0].found_rotation_ratio == rows[0].answer_rotation_ratio == math.inf
    (sentence,) = verdict_sentences(rows)
    assert sentence.startswith("Of one structure by the cheapest trusted method: one overturn")
    assert "block" in str(verdict_table(rows, {"block": "1"}))


@pytest.fixture(scope="module")
def components(real_records):
    catalogue = Path(__file__).parents[3] / "records" / "near_fault.csv"
    opened = ((r.id, a) for r in load_catalogue(catalogue) for a in open_record(r, mirror=real_records))
    return list(distinct_components(opened))


@pytest.mark.real_records
def test_the_promise_holds_at_sites_it_was_not_made_at(components):
    """One component of every other held-out site, under every third block of the grid."""
    sites = sorted({(a.event, a.station) for _, a in components})[1::4]
    one_each = {(a.event, a.station): (name, a) for name, a in components}
    blocks = dict(itertools.islice(grid_of_blocks().items(), 0, None, 3))
    tried = [t for site in sites for t in trials(*one_each[site], blocks)]
    limits = limits_for(0.1, 0.01)
    found = held_out("held out", tried, limits)
    assert len(sites) == 6
    assert found.block > 0.3
    assert found.right >= RIGHT
    assert found.unsafe <= limits.risk


@pytest.mark.real_records
def test_a_study_follows_the_rule_that_was_calibrated(components):
    name, accelerogram = components[0]
    blocks = grid_of_blocks()
    limits = limits_for(0.1, 0.01)
    expected = [t.method(limits) for t in trials(name, accelerogram, blocks) if t.scale_factor == 1]
    settings = AssessmentSettings(fidelity="auto", bootstrap_replicates=0)
    assert [
        case.answer.method for case in assess_structures(accelerogram, blocks, settings).cases
    ] == expected
    assert len(set(expected)) > 1


@pytest.mark.slow
@pytest.mark.real_records
def test_the_shipped_limits_are_remade(components, tmp_path):
    """All records, the grid of blocks alone: half as many structures, so the risk that was held is not loosened."""
    report = write_fidelity(components, {}, tmp_path)
    assert len(list(read_rows(Limits, tmp_path / "fidelity.csv"))) == len(TOLERANCES) * len(RISKS)
    assert list(read_rows(HeldOut, tmp_path / "fidelity_held_out.csv")) == report
    for row in report:
        if row.half == "held out":
            assert row.unsafe <= row.risk
            assert row.right >= RIGHT
