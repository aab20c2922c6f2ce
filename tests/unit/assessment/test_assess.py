"""A record against structures: what is compared with what, what a failure costs, and the motion of a pair."""

import math
from dataclasses import replace
from time import process_time
from unittest.mock import Mock

import numpy as np
import pytest
from motion_cases import noise
from scipy.constants import g

import rocking
from rocking.assessment.assessor import Assessor, with_histories
from rocking.assessment.case import CaseResult, PeriodResult
from rocking.assessment.inputs import CaseInputs
from rocking.assessment.methods import NEGLIGIBLE, Method, agreement, ratio, rests, rocks, within_factor_two
from rocking.assessment.motions import Component, HorizontalMotion, horizontal_motions
from rocking.assessment.one_case import compute_case, predict
from rocking.assessment.rows import (
    RATIO_COLUMNS,
    ComparisonRow,
    Identity,
    capacity_rows,
    comparison_row,
    pulse_rows,
    record_row,
)
from rocking.assessment.scene import Scene, on_the_ground
from rocking.assessment.settings import AssessmentSettings, EnsembleSettings, PredictingPulse
from rocking.motion import integrate
from rocking.pulses import Pulse, PulseAnalysis, PulseEvidence, extract_pulses
from rocking.records import Accelerogram
from rocking.sine_pulse import predict_maximum
from rocking.structures import Block, Facade, Outcome
from tests.unit.assessment.made_rows import component_of

STEP = 0.01
PULSE = Pulse(amplitude=3.0, circular_frequency=2 * np.pi / 0.8, start_time=2.0)
RECORD = Accelerogram(PULSE.acceleration(np.arange(1000) * STEP), STEP, component="H1")
BLOCK = Block(2.0, 0.2)
SETTINGS = AssessmentSettings()
IDENTITY = Identity(
    record="made", component=RECORD.component, record_sha256=RECORD.source.sha256, settings_sha256=""
)
MOTION = Pulse(amplitude=3.0, circular_frequency=math.pi, start_time=10.0).acceleration(
    np.arange(3000) * STEP
)


def assessed(record: Accelerogram, settings: AssessmentSettings = SETTINGS, vertical=None) -> CaseResult:
    """The block under one component."""
    component = component_of(record, settings.pulse, vertical)
    prediction = predict(BLOCK.mechanism(), component.candidates, settings)
    pulse = prediction.pulse if prediction else None
    inputs = CaseInputs(motion=component.of_ground, structure=BLOCK, settings=settings, pulse=pulse)
    return replace(compute_case(inputs), prediction=prediction)


def compared(case: CaseResult) -> ComparisonRow:
    station = PeriodResult.of(Scene("block", BLOCK), {case.component: case})
    return comparison_row(IDENTITY, station, case)


@pytest.fixture(scope="module")
def case() -> CaseResult:
    return assessed(RECORD)


def test_a_record_that_is_one_pulse_is_predicted_by_its_pulse(case):
    # Sampling a sine every T/80 changes it by (π/80)²/2 of its amplitude: 8e-4, times the sensitivity of the response.
    block = case.responses[Method.BLOCK_ON_RECORD].rotation_ratio
    assert case.prediction.maximum.rotation_ratio == pytest.approx(block, rel=1e-2)


def test_the_ranked_rows_of_pulses_are_the_alternatives_in_their_order():
    component = component_of(RECORD, SETTINGS.pulse)
    rows = pulse_rows(IDENTITY, component)
    rows = [row for row in rows if row.ranked]
    assert [row.pulse for row in rows] == [evidence.pulse for evidence in component.analysis.ranked]
    assert [row.rank for row in rows] == list(range(1, len(rows) + 1)) and rows[0].gain_ratio == 1


def test_a_row_of_the_comparison_holds_what_each_method_says(case):
    row = compared(case)
    block = case.prediction.block
    for method, ratio_alone in (
        (Method.CLOSED_FORM, predict_maximum(block, PULSE).rotation_ratio),
        (Method.BLOCK_ON_RECORD, integrate(block, RECORD).rotation_ratio),
        (Method.MECHANISM_ON_PULSE, integrate(BLOCK, PULSE).rotation_ratio),
        (Method.MECHANISM_ON_RECORD, integrate(BLOCK, RECORD).rotation_ratio),
    ):
        # the pulse of the analysis is PULSE but for its sampling
        assert getattr(row, RATIO_COLUMNS[method]) == pytest.approx(ratio_alone, rel=1e-2), method
    assert len({getattr(row, name) for name in RATIO_COLUMNS.values()}) == len(RATIO_COLUMNS)
    assert row.impacts == integrate(BLOCK, RECORD).impacts


def test_a_fragile_case_is_repeated_and_its_row_and_its_history_say_at_which_tolerance():
    """Within 2e-9 of the limit: it falls at 1e-6, and stands in the oracle of the tests of motion, at 1.11640268442."""
    block = Block(1.0, 0.25, restitution=0.85)
    record = noise(11, 60, 0.05, g * block.mechanism().uplift_multiplier * 1.87260126893, 6)
    assert integrate(block, record).outcome is Outcome.OVERTURNS
    settings = AssessmentSettings(ensemble=EnsembleSettings(members=0))
    result = Assessor(settings).assess("made", [record], on_the_ground({"block": block}))
    (kept,) = result.periods[0].cases.values()
    row = compared(kept)
    assert row.fragile and kept.response.tolerance == 1e-9
    assert row.integrated_rotation_ratio == pytest.approx(1.11640268442, rel=1e-8)

    scene = result.scenes["block"]
    station = replace(scene.periods[0], cases={"": kept.kept})
    without = replace(result, scenes={"block": replace(scene, periods=(station,))})
    (again,) = with_histories(without, settings.tolerance).periods[0].cases.values()
    assert again.response.times is not None
    assert (again.response.rotation_ratio, again.response.fragile) == (row.integrated_rotation_ratio, True)
    calm = assessed(RECORD, settings)
    assert (compared(calm).fragile, calm.response.tolerance) == (False, 1e-6)


def test_runs_that_explain_the_closed_form_are_as_strict_as_a_fragile_one_that_is_repeated():
    """Page one names one of them as the reason, and neither is asked whether it is fragile."""
    vertical = Accelerogram(0.2 * RECORD.acceleration[::-1], STEP)
    case = assessed(RECORD, AssessmentSettings(tolerance=1e-3), vertical)
    for method in (Method.BLOCK_ON_RECORD, Method.MECHANISM_ON_PULSE):
        assert case.responses[method].tolerance == 1e-9
    smaller = assessed(RECORD, AssessmentSettings(tolerance=1e-11), vertical)
    assert smaller.responses[Method.MECHANISM_ON_PULSE].tolerance == 1e-11


def test_a_record_without_a_pulse_is_integrated_all_the_same():
    still = Accelerogram(np.zeros(1000), STEP)
    component = component_of(still, SETTINGS.pulse)
    assert component.analysis is None and component.failure
    rested = assessed(still)
    assert rested.prediction is None
    assert rested.responses[Method.MECHANISM_ON_RECORD].outcome is Outcome.NO_UPLIFT


def test_what_fails_over_all_directions_is_raised_in_python(monkeypatch):
    failing = Mock(side_effect=rocking.MotionError("it has no room."))
    monkeypatch.setattr("rocking.assessment.one_case.ensemble_over_cracks", failing)
    with pytest.raises(rocking.RockingError, match="it has no room"):
        rocking.assess([RECORD, RECORD.scaled(0.5)], BLOCK)


def test_what_is_timed_adds_up_to_no_more_than_was_spent(case):
    started = process_time()
    result = Assessor().assess("made", [RECORD], on_the_ground({"block": BLOCK, "stout": Block(2.0, 0.3)}))
    spent = process_time() - started
    durations = dict(result.durations)
    stages = [durations.pop(name) for name in ("pulses", "responses", "variations", "reserve")]
    assert min(stages) > 0 and sum(stages) <= spent
    assert set(durations) == {*case.responses, Method.CLOSED_FORM}
    assert 0 < durations.pop(Method.CLOSED_FORM) <= spent
    assert 0 < sum(durations.values()) <= stages[1]
    assert case.prediction.pulse == extract_pulses(RECORD).dominant, "which predicts by default"


def test_the_sides_of_a_capacity_curve_are_those_to_which_it_rocks():
    """A tie holds the façade on one side alone, where it stands up to another rotation."""
    facade = Facade((3.5,), (0.6,), 20e3, tie_heights=(3.4,), tie_stiffness=1e4)
    rows, (positive, negative) = list(capacity_rows({"facade": facade})), facade.mechanism().sides
    assert positive.critical_rotation != pytest.approx(negative.critical_rotation, rel=1e-3)
    for name, side in (("positive", positive), ("negative", negative)):
        *_, last = (row.rotation_rad for row in rows if row.side == name)
        assert last == pytest.approx(side.critical_rotation, rel=1e-9)


def test_a_pulse_method_that_finds_nothing_costs_no_integration():
    # 1.1 s of record hold a sine of 0.5 s, but no wavelet of T_p = 0.24 s, which is 1.19 s long
    short = Accelerogram(
        Pulse(amplitude=3.0, circular_frequency=4 * np.pi, start_time=0.3).acceleration(
            np.arange(110) * STEP
        ),
        STEP,
    )
    settings = AssessmentSettings(pulse=PredictingPulse(choice="velocity"))
    component = component_of(short, settings.pulse)
    assert component.failure and component.analysis is not None
    integrated = assessed(short, settings)
    assert integrated.prediction is None and integrated.integrated_rotation_ratio > 0


def test_a_steady_vertical_acceleration_scales_gravity(case):
    # −0.2 g for the whole record: λ and p² fall by a fifth, as under 1/0.8 of the motion in 1/√0.8 of the time
    vertical = Accelerogram(np.full(1000, -0.2 * 9.80665), STEP)
    lifted, slower = (
        assessed(RECORD, vertical=vertical),
        Accelerogram(RECORD.acceleration / 0.8, STEP * math.sqrt(0.8)),
    )
    assert lifted.integrated_rotation_ratio == pytest.approx(
        assessed(slower).integrated_rotation_ratio, rel=1e-5
    )
    assert lifted.integrated_rotation_ratio > case.integrated_rotation_ratio


ABOVE = math.nextafter(NEGLIGIBLE, 1.0)


@pytest.mark.parametrize(
    ("pairs", "expected"),
    [
        (((math.inf, math.inf), (0.0, 1e-6)), "same outcome"),
        (((0.9, math.inf), (0.0, 0.1), (NEGLIGIBLE, ABOVE)), "too low"),
        (((math.inf, 0.4), (ABOVE, NEGLIGIBLE)), "too high"),
        (((math.nan, 0.4),), "unknown"),
    ],
)
def test_agreement_changes_where_rest_ends(pairs, expected):
    assert {agreement(predicted=predicted, integrated=integrated) for predicted, integrated in pairs} == {
        expected
    }
    assert rests(NEGLIGIBLE) and not rests(ABOVE) and not rests(math.nan)
    assert rocks(ABOVE) and not rocks(NEGLIGIBLE) and not rocks(math.inf) and not rocks(math.nan)


@pytest.mark.parametrize(
    ("predicted", "integrated", "expected"),
    [(0.2, 0.4, True), (0.8, 0.4, True), (0.19, 0.4, False), (0.81, 0.4, False), (0.0, 0.4, None)],
)
def test_within_a_factor_two_holds_its_ends(predicted, integrated, expected):
    assert within_factor_two(predicted=predicted, integrated=integrated) is expected


def test_ratio_is_known_only_where_both_are_lifted_and_stay_up():
    assert ratio(predicted=0.2, integrated=0.4) == 0.5
    assert math.isnan(ratio(predicted=math.inf, integrated=0.4))
    assert math.isnan(ratio(predicted=0.2, integrated=0.0))


def row_of(record: Accelerogram, motion: HorizontalMotion, dominant: Pulse | None, vertical=None):
    """The row of a record whose dominant pulse is `dominant`."""
    analysis = None
    if dominant is not None:
        evidence = PulseEvidence(pulse=dominant, gain=1.0, explained_energy=0.5, phase=0.0)
        analysis = PulseAnalysis(record, (evidence,), (), (), (0.1, 5.0))
    return record_row(IDENTITY, Component(record, vertical, motion, analysis, ()))


def component(share: float, name: str, azimuth: float | None = None, **changes) -> Accelerogram:
    return replace(Accelerogram(share * MOTION, STEP, name, azimuth=azimuth), **changes)


def test_a_pair_has_one_motion_and_its_axis_from_north():
    north, east = component(math.cos(0.3), "N", 0.0), component(math.sin(0.3), "E", 90.0)
    one, other = horizontal_motions([north, east])
    assert one is other
    assert one.velocity_pulse_azimuth == pytest.approx(math.degrees(0.3))
    assert one.velocity_pulse.orientation == pytest.approx(0.3)
    assert one.rotd.rotd100 == pytest.approx(3.0, rel=1e-3)
    written = row_of(north, one, Pulse(amplitude=1.0, circular_frequency=math.pi))
    assert written.rotd50_peak_acceleration_m_s2 == one.rotd.rotd50
    assert written.rotd100_peak_acceleration_m_s2 == one.rotd.rotd100
    assert written.pulse_periods_unlike is one.velocity_pulse.is_unlike(
        Pulse(amplitude=1.0, circular_frequency=math.pi)
    )
    alone = row_of(north, horizontal_motions([north])[0], None, vertical=component(0.1, ""))
    assert math.isnan(alone.rotd100_peak_acceleration_m_s2)
    assert alone.vertical_component == "not named"


@pytest.mark.parametrize(
    "others",
    [[], [component(1, "E", time_step=0.02)], [component(1, "a"), component(1, "b")]],
    ids=["one", "another time step", "three"],
)
def test_what_is_no_pair_stands_alone(others):
    motions = horizontal_motions([component(1.0, "S", 200.0), *others])
    assert len(motions) == 1 + len(others)
    assert motions[0].rotd is None
    assert motions[0].velocity_pulse.period == pytest.approx(1.93 * 2.0, rel=0.02)
    assert motions[0].velocity_pulse_azimuth == 20.0


def test_a_still_or_short_record_has_no_velocity_pulse():
    for short in (Accelerogram(np.zeros(3000), STEP), Accelerogram(np.ones(50), STEP)):
        (motion,) = horizontal_motions([short])
        assert motion.velocity_pulse is None and motion.velocity_pulse_azimuth is None
        assert (
            row_of(short, motion, Pulse(amplitude=1.0, circular_frequency=1.0)).pulse_periods_unlike is None
        )


def test_periods_more_than_a_factor_2_apart_are_unlike():
    (motion,) = horizontal_motions([component(1.0, "N")])
    period = motion.velocity_pulse.period
    assert (
        motion.velocity_pulse.is_unlike(
            Pulse(amplitude=1.0, circular_frequency=2 * math.pi / (0.49 * period))
        )
        is True
    )
    assert (
        motion.velocity_pulse.is_unlike(
            Pulse(amplitude=1.0, circular_frequency=2 * math.pi / (0.51 * period))
        )
        is False
    )
