"""extract_pulses: identities of its results, and the sentences it answers bad input with."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from rocking.errors import PulseError
from rocking.pulses import Pulse, PulseSettings, extract_pulses
from rocking.pulses.kinds import PulseKind
from rocking.signal.accelerogram import Accelerogram, Source
from rocking.warnings import RockingWarning
from tests.refusals import refused

STEP = 0.01
TIMES = np.arange(2000) * STEP


@pytest.fixture(scope="module")
def record():
    rng = np.random.default_rng(11)
    first, second = (
        Pulse(amplitude=2.0, circular_frequency=2 * np.pi / 1.3, start_time=6.2),
        Pulse(amplitude=-1.5, circular_frequency=2 * np.pi / 0.7, start_time=11),
    )
    pulses = first.acceleration(TIMES) + second.acceleration(TIMES)
    return Accelerogram(pulses + 0.3 * rng.standard_normal(TIMES.size), STEP)


@pytest.fixture(scope="module")
def found(record):
    return extract_pulses(record)


def energy_left(record, pulse):
    return np.sum((record.acceleration - pulse.acceleration(TIMES)) ** 2) * STEP


def test_every_alternative_has_the_gain_it_states(record, found):
    """The amplitude is a least-squares one, so the residual is square to the pulse (Pythagoras)."""
    energy = np.sum(record.acceleration**2) * STEP
    assert len(found.ranked) == 5
    assert [e.gain for e in found.ranked] == sorted((e.gain for e in found.ranked), reverse=True)
    for evidence in found.ranked:
        assert evidence.gain == pytest.approx(energy - energy_left(record, evidence.pulse), rel=1e-9)
    assert found.gain_ratio == found.alternatives[0].gain / found.evidence.gain
    assert replace(found, ranked=found.ranked[:1]).gain_ratio == 0.0
    assert found.explained_energy == pytest.approx(found.evidence.gain / energy, rel=1e-9)
    assert np.sum(found.residual**2) * STEP == pytest.approx(energy_left(record, found.dominant), rel=1e-9)


def test_pursuit_takes_energy_step_by_step(record, found):
    residual = record.acceleration.copy()
    for evidence in found.sequence:
        before = np.sum(residual**2) * STEP
        residual = residual - evidence.pulse.acceleration(TIMES)
        assert before - np.sum(residual**2) * STEP == pytest.approx(evidence.gain, rel=1e-9)
    assert found.sequence[0] == found.evidence
    assert len(found.sequence) == 3
    assert found.sequence[1].pulse.period == pytest.approx(0.7, rel=0.05)


def test_pursuit_equals_a_new_search_of_the_residual(found):
    again = extract_pulses(Accelerogram(found.residual, STEP))
    assert found.sequence[1].gain == pytest.approx(again.evidence.gain, rel=1e-6)


@pytest.mark.parametrize("turn", [0, 0.5 * np.pi, np.pi, -0.5 * np.pi])
def test_phase_tells_a_sine_from_a_cosine(turn):
    cycle = (TIMES >= 5) & (TIMES <= 7)
    shape = np.sin(np.pi * (TIMES - 5) + turn) * cycle
    phase = extract_pulses(Accelerogram(shape, STEP)).evidence.phase
    # told apart means nearer to its own quarter turn than to the next: the best sine of a cosine is shorter than the
    # cosine's cycle, and the envelope inside is flat. A sine is told to one sample, ω dt
    limit = np.pi / 4 if turn % np.pi else 1.01 * np.pi * STEP
    assert abs(math.remainder(phase - turn, 2 * np.pi)) < limit


def test_a_record_that_does_not_move_is_refused():
    dead = Accelerogram(np.full(1000, 0.3), STEP, source=Source(path="dead.at2"))
    with refused(PulseError, "acceleration", 0.3):
        extract_pulses(dead)
    with refused(PulseError, "acceleration"):
        extract_pulses(Accelerogram(np.append(np.zeros(999), 1.0), STEP))


def test_a_record_shorter_than_the_longest_period_says_so():
    pulse = Pulse(amplitude=1.0, circular_frequency=2 * np.pi / 0.8, start_time=0.9)
    found = extract_pulses(Accelerogram(pulse.acceleration(TIMES[:300]), STEP))
    assert RockingWarning(PulseKind.PULSE_RECORD_SHORT) in found.flags
    assert found.band[0] == pytest.approx(1 / 2.99)
    assert found.dominant.period == pytest.approx(0.8, rel=1e-6)


def test_a_record_too_coarse_for_the_upper_frequency_says_so():
    times = np.arange(400) * 0.1
    found = extract_pulses(
        Accelerogram(
            Pulse(amplitude=1.0, circular_frequency=2 * np.pi / 2.5, start_time=9.03).acceleration(times), 0.1
        )
    )
    assert RockingWarning(PulseKind.PULSE_SAMPLING_COARSE) in found.flags
    assert found.band[1] == pytest.approx(1.25)  # eight samples in a cycle
    assert found.dominant.period == pytest.approx(2.5, rel=1e-6)


@pytest.mark.parametrize(
    "change",
    [
        {"lowest_frequency": 0},
        {"highest_frequency": 0.1},
        {"candidates": 0},
        {"pursuit": True},
    ],
)
def test_impossible_settings_are_refused(change):
    ((field, value),) = change.items()
    with refused(PulseError, field, value):
        PulseSettings(**change)


@pytest.mark.parametrize("size", [1e-200, 1e200])
def test_a_peak_beyond_numbers_is_refused(record, size):
    with refused(PulseError, "peak_acceleration"):
        extract_pulses(Accelerogram(record.acceleration * size, STEP))


@given(
    samples=arrays(float, st.integers(30, 120), elements=st.floats(-50, 50, allow_subnormal=False)),
    step=st.sampled_from([0.005, 0.02, 0.1, 1.0]),
)
@settings(deadline=None, max_examples=2 * settings.default.max_examples)
def test_any_record_gives_a_pulse_within_it_or_a_sentence(samples, step):
    record = Accelerogram(samples, step)
    try:
        found = extract_pulses(record)
    except PulseError as error:
        assert str(error).endswith(".")
        return
    energy = np.sum(samples**2) * step
    for evidence in found.ranked:
        assert 0 < evidence.gain <= energy * (1 + 1e-9)
        assert -1e-6 * step <= evidence.pulse.start_time
        assert evidence.pulse.end_time <= record.duration + 1e-6 * step
        low, high = found.band
        assert low * (1 - 1e-9) <= 1 / evidence.pulse.period <= high * (1 + 1e-9)
    assert np.sum(found.residual**2) * step <= energy * (1 + 1e-9)


def test_a_motion_sampled_far_too_finely_has_the_pulses_of_the_motion():
    step = 0.0002
    times = np.arange(100_001) * step
    waves = Pulse(amplitude=3.0, circular_frequency=5.0, start_time=6.0).acceleration(times) + 0.4 * np.sin(
        31.0 * times
    ) * np.exp(-times / 5)
    fine = extract_pulses(Accelerogram(waves, step))
    plain = extract_pulses(Accelerogram(waves[::10], 10 * step))
    assert fine.dominant.period == pytest.approx(plain.dominant.period, rel=1e-3)
    assert fine.dominant.amplitude == pytest.approx(plain.dominant.amplitude, rel=1e-3)
    assert fine.residual.size == waves.size
    assert np.abs(fine.residual - (waves - fine.dominant.acceleration(times))).max() == 0
