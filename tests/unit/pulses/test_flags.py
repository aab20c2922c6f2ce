"""Flags: each on a motion that must raise it, and none on a clean pulse."""

import numpy as np
import pytest

from rocking.pulses import Pulse, extract_pulses
from rocking.pulses.extraction import oscillates
from rocking.pulses.kinds import PulseKind
from rocking.signal.accelerogram import Accelerogram

STEP = 0.01
TIMES = np.arange(3000) * STEP


def flags(samples, **fields):
    return tuple(flag.kind for flag in extract_pulses(Accelerogram(samples, STEP, **fields)).flags)


def cycle(amplitude, period, start, cycles=1.0, wave=np.sin):
    phase = (TIMES - start) / period
    return amplitude * wave(2 * np.pi * phase) * ((phase >= 0) & (phase <= cycles))


def noise(seed, size=0.1):
    return size * np.random.default_rng(seed).standard_normal(TIMES.size)


def test_a_clean_pulse_raises_no_flag():
    assert flags(cycle(2, 1.1, 8.003) + noise(0)) == ()


@pytest.mark.parametrize("missing", [0.1, 0.25, 0.4, 0.45, 0.5, 0.6])
@pytest.mark.parametrize("period", [0.6, 1.5, 4.0])
def test_a_truncated_pulse_is_at_the_edge(missing, period):
    assert PulseKind.PULSE_AT_AN_END in flags(cycle(2, period, -missing * period))
    assert PulseKind.PULSE_AT_AN_END in flags(cycle(2, period, TIMES[-1] - (1 - missing) * period))


@pytest.mark.parametrize("room", [0.05, 0.15, 0.9, 1.1])
@pytest.mark.parametrize("level", [0.5, 0.7])
def test_near_a_loud_end_a_pulse_needs_a_period_of_room_and_near_a_quiet_one_a_tenth_of_it(room, level):
    """Loud is a first or last sample of 0.3 of the pulse, which is 2 m/s²; that of the far end says nothing."""
    period = 1.5
    for near, start in ((0, room * period), (-1, TIMES[-1] - (1 + room) * period)):
        samples = cycle(2, period, start)
        samples[near] += level
        assert (PulseKind.PULSE_AT_AN_END in flags(samples)) is (room < (1.0 if level > 0.6 else 0.1))
        samples[[near, -1 - near]] = 0.0, 1.0
        assert (PulseKind.PULSE_AT_AN_END in flags(samples)) is (room < 0.1)


@pytest.mark.parametrize("seed", range(10))
def test_two_cycles_are_unstable(seed):
    assert PulseKind.PULSE_UNSTABLE in flags(cycle(2, 0.9, 8.003, cycles=2) + noise(seed, 0.3))


@pytest.mark.parametrize("seed", range(10))
def test_equal_pulses_are_unstable(seed):
    raised = flags(cycle(2, 0.9, 8.003) + cycle(-2, 1.0, 15) + noise(seed, 0.1))
    assert PulseKind.PULSE_UNSTABLE in raised
    assert PulseKind.PULSE_SYMMETRIC not in raised


def ricker(period, middle):
    x = (np.pi * (TIMES - middle) / period) ** 2
    return (1 - 2 * x) * np.exp(-x)


@pytest.mark.parametrize("shape", [ricker(1.5, 12.0), cycle(1.0, 1.5, 10.0, wave=np.cos)])
def test_a_symmetric_shape_reports_both_solutions(shape):
    found = extract_pulses(Accelerogram(shape, STEP))
    first, second = found.ranked[0].pulse, found.ranked[1].pulse
    assert {PulseKind.PULSE_SYMMETRIC, PulseKind.PULSE_UNSTABLE} <= {flag.kind for flag in found.flags}
    # mirror images: equal gain, period and magnitude, opposite sign. The middle of the shape lies on a sample, so
    # that the mirror is exact up to the last bits of the search
    assert second.amplitude == pytest.approx(-first.amplitude, rel=1e-4)
    assert second.period == pytest.approx(first.period, rel=1e-4)
    assert abs(second.start_time - first.start_time) == pytest.approx(first.period / 2, rel=0.1)


@pytest.mark.parametrize(("share", "oscillates"), [(0.65, False), (0.70, True)])
def test_the_middle_of_an_oscillation_shows_in_the_gains_of_its_twins(share, oscillates):
    # half cycles of `share` before and after a cycle: its twins, half a cycle away, gain ((1 + share)/2)² of it, which
    # passes the limit of 0.7 at 0.673; what the pursuit finds next has another period, so that it does not adjoin
    phase = TIMES - 8.003
    half = np.abs(phase - 0.5)
    samples = 3 * np.sin(2 * np.pi * phase) * ((half < 0.5) + share * ((half >= 0.5) & (half < 1)))
    found = extract_pulses(Accelerogram(samples, STEP))
    assert found.gain_ratio == pytest.approx(((1 + share) / 2) ** 2, rel=1e-2)
    assert (PulseKind.PULSE_UNSTABLE in {flag.kind for flag in found.flags}) is oscillates


def test_a_filter_that_reduces_the_pulse_is_told():
    samples = cycle(2, 3.0, 8.003)
    assert PulseKind.PULSE_FILTERED in flags(samples, high_pass_frequency=0.07)  # 3.0 s > 0.2 / 0.07 Hz
    assert PulseKind.PULSE_FILTERED not in flags(samples, high_pass_frequency=0.06)
    assert PulseKind.PULSE_FILTERED not in flags(samples)


@pytest.mark.parametrize("period", [0.12, 9.0])
def test_a_pulse_outside_the_band_lies_at_its_limit(period):
    assert PulseKind.PULSE_AT_BAND_LIMIT in flags(cycle(2, period, 8.003))


def test_a_filled_gap_is_told_and_padding_is_not():
    samples = cycle(2, 1.1, 8.003) + noise(4)
    holed, padded = samples.copy(), samples.copy()
    holed[1500:1650] = 0.0
    padded[:500] = padded[2000:] = 0.0
    assert PulseKind.PULSE_NEXT_TO_GAP in flags(holed)
    assert PulseKind.PULSE_NEXT_TO_GAP not in flags(padded)


@pytest.mark.parametrize(
    ("distance", "twin"), [(0, False), (0.35, False), (0.4, True), (0.6, True), (0.65, False), (1, False)]
)
@pytest.mark.parametrize("period", [1.0, 1.2])
def test_a_twin_lies_half_a_cycle_from_the_middle_of_the_pulse(distance, twin, period):
    # an eighth of a cycle to either side of the half, whatever the twin's own period
    pulse = Pulse(amplitude=1, circular_frequency=2 * np.pi, start_time=3.0)
    before, after = (
        Pulse(
            amplitude=-1, circular_frequency=2 * np.pi / period, start_time=3.5 + side * distance - period / 2
        )
        for side in (-1, 1)
    )
    assert oscillates(pulse, [before, after]) is twin
    assert not oscillates(pulse, [before]) and not oscillates(pulse, [after])
