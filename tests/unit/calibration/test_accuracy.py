"""Error against time, case by case: which cases are tried, and what a row says."""

import math

import numpy as np
import pytest

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.rows.of_trade import TradeMethod
from rocking.calibration.accuracy import (
    TOLERANCES,
    Pulses,
    TradeCase,
    choose_cases,
    scipy_rows,
    strongest_stretch,
    whole_record_rows,
)
from rocking.calibration.settings import TradeSettings
from rocking.errors import ConfigurationError
from rocking.motion.integration import integrate
from rocking.pulses import PulseSettings
from rocking.records import Accelerogram
from rocking.structures import Block, Wall

STEP = 0.02
BLOCK, WALL = Block(1.0, 0.2), Wall(1.5, 1.5, 0.16)
STRUCTURES = {"block": BLOCK, "wall": WALL}
ENSEMBLE = EnsembleSettings(members=16)


def record(peak: float, frequency: float = 1.2, count: int = 80) -> Accelerogram:
    """Two cycles that swell and fade, with a higher tone on top."""
    times = np.arange(count) * STEP
    shape = np.sin(np.pi * times / times[-1]) ** 2
    tones = np.sin(2 * np.pi * frequency * times) + 0.3 * np.sin(2 * np.pi * 3.1 * frequency * times)
    return Accelerogram(peak * shape * tones, STEP, component="H1")


def case(motion: Accelerogram, name: str = "block") -> TradeCase:
    return TradeCase("one", motion, name, STRUCTURES[name].mechanism(), 1.0)


@pytest.fixture(scope="module")
def whole():
    motion = record(3.0)
    return list(whole_record_rows(case(motion), Pulses.of(motion, PulseSettings()), ENSEMBLE))


@pytest.fixture(scope="module")
def beside_scipy():
    return list(scipy_rows(case(record(3.0)), 60.0))


def test_every_method_is_measured(whole, beside_scipy):
    assert [row.method for row in whole] == [
        TradeMethod.ONE_SINE,
        TradeMethod.SINES,
        TradeMethod.BLOCK,
        *[TradeMethod.MECHANISM] * len(TOLERANCES),
        TradeMethod.ENSEMBLE,
    ]
    assert {row.method for row in beside_scipy} == {
        TradeMethod.MECHANISM,
        TradeMethod.RK45,
        TradeMethod.DOP853,
    }
    assert all(row.cpu_s > 0 for row in [*whole, *beside_scipy])
    assert all(row.beside_scipy for row in beside_scipy) and not any(row.beside_scipy for row in whole)
    sines = [row for row in whole if row.preparation_record_s > 0]
    assert {row.method for row in sines} == {TradeMethod.ONE_SINE, TradeMethod.SINES}


def test_the_mechanism_keeps_three_times_its_tolerance_beside_scipy(beside_scipy):
    for row in beside_scipy:
        if row.method == TradeMethod.MECHANISM:
            assert row.error <= 3 * row.tolerance


def test_the_reference_of_whole_records_is_that_of_scipy(whole, beside_scipy):
    """The record is short, so that the strongest stretch is all of it."""
    assert whole[0].reference_rotation_ratio == pytest.approx(
        beside_scipy[0].reference_rotation_ratio, rel=1e-9
    )


def test_errors_are_those_of_the_numbers_beside_them(whole):
    for row in whole:
        assert 0 < row.reference_rotation_ratio < 1
        if row.verdict_agrees:
            ratio = row.rotation_ratio / row.reference_rotation_ratio
            assert row.error == pytest.approx(abs(ratio - 1), abs=1e-15)


def test_the_closed_form_errs_where_the_pulse_is_not_the_record(whole):
    """The record is no sine pulse, so a closed form that is exact for one cannot be right to 1e-6."""
    assert not whole[0].error < 1e-6
    assert whole[1].rotation_ratio >= whole[0].rotation_ratio, "the worst of five sines, the first among them"


def test_a_case_beyond_its_budget_says_so():
    (row,) = scipy_rows(case(record(3.0, count=2000), "wall"), 1.0)
    assert "budget" in row.reason and math.isnan(row.error)


def test_a_record_without_a_pulse_says_so_and_keeps_its_other_methods():
    motion = record(3.0)
    rows = list(whole_record_rows(case(motion), Pulses((), 0.01, "the record is too short."), ENSEMBLE))
    assert [row.reason for row in rows[:2]] == ["the record is too short."] * 2
    assert all(not math.isnan(row.error) for row in rows[2:])


def test_the_strongest_stretch_holds_most_energy():
    acceleration = np.concatenate([np.full(50, 0.1), np.full(30, 2.0), np.full(50, 0.1)])
    stretch = strongest_stretch(Accelerogram(acceleration, STEP), 30)
    assert stretch.acceleration.tolist() == [2.0] * 30
    assert stretch.time_step == STEP
    whole = Accelerogram(acceleration, STEP)
    assert strongest_stretch(whole, 1000) is whole


def test_cases_begin_with_the_most_sensitive_and_cover_the_structures():
    motions = [(f"r{k}", record(2.5 + 0.1 * k)) for k in range(6)]
    found = {
        (name, label): abs(integrate(structure, motion, sensitivity=True).sensitivity)
        for name, motion in motions
        for label, structure in STRUCTURES.items()
    }
    settings = TradeSettings(cases=5, samples=100)
    cases = choose_cases(motions, STRUCTURES, settings)
    sensitive = max((key for key in found if math.isfinite(found[key])), key=lambda key: found[key])
    assert (cases[0].record, cases[0].structure) == sensitive
    assert {each.structure for each in cases} == set(STRUCTURES)
    assert len({(each.record, each.structure) for each in cases}) == len(cases) == 5
    again = choose_cases(motions, STRUCTURES, settings)
    assert [(c.record, c.structure) for c in cases] == [(c.record, c.structure) for c in again]


@pytest.mark.parametrize("wrong", [{"cases": 0}, {"samples": 5}, {"budget_s": 0.0}])
def test_settings_out_of_range_are_refused(wrong):
    with pytest.raises(ConfigurationError, match=next(iter(wrong))):
        TradeSettings(**wrong)
