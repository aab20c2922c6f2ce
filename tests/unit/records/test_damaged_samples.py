"""Damage that only the samples tell of: warned of where it is no chance, and never of a whole record."""

import numpy as np
import pytest
from scipy.signal import lfilter

from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.records.kinds import RecordKind
from rocking.records.plausibility import agree_with_velocity, damage_warnings, repeated_rows
from rocking.signal.processing import integral
from rocking.warnings import RockingWarning

SHAKING = np.sin(np.arange(400) / 5) * np.hanning(400)


def told(values: np.ndarray) -> tuple[RockingWarning, ...]:
    return damage_warnings(Accelerogram(values, 0.01))


def shaking(seed: int, size: int = 4000) -> np.ndarray:
    """Noise of a resonance at 3 Hz within an envelope, printed with five decimals, to which no threshold was fitted."""
    noise = np.random.default_rng(seed).standard_normal(size)
    motion = lfilter([1.0], [1.0, -1.86, 0.9], noise) * (0.02 + np.hanning(size))
    return np.round(motion, 5)


def test_a_sample_alone_is_told_with_the_peak_without_it() -> None:
    """An exponent E-01 read as E+01 made Rinaldi's 0.874 g 2.93 g."""
    for place in (0, 150, 399):
        struck = SHAKING.copy()
        struck[place] = 30.0
        (alone,) = (warning for warning in told(struck) if warning.kind is RecordKind.SAMPLE_ALONE)
        assert alone["time_s"] == pytest.approx(place * 0.01)
        assert alone["peak_g"] == pytest.approx(30 / GRAVITY)
        assert alone["others_g"] == pytest.approx(np.abs(np.delete(SHAKING, place)).max() / GRAVITY)
    for size, is_told in ((120, True), (80, False)):  # a hundred samples or more
        short = np.ones(size)
        short[size // 2] = 30.0
        assert bool(told(short)) == is_told
    # a peak of 1.9 times all others is a peak
    struck[399] = 1.9
    assert told(struck) == () == told(SHAKING)


def test_zeros_within_shaking_are_told() -> None:
    """Of numbers of few digits, which stand still for a while anyway."""
    coarse = np.round(SHAKING, 1) + 1e-9
    for zeros, is_told in ((49, False), (50, True)):
        gap = coarse.copy()
        gap[180 : 180 + zeros] = 0.0
        assert (RecordKind.ZEROS_IN_SHAKING in {warning.kind for warning in told(gap)}) == is_told
    still = np.concatenate([np.zeros(300), SHAKING + 1e-9, np.zeros(300)])
    assert not told(still) + told(np.zeros(400))


@pytest.mark.parametrize("seed", range(20))
def test_a_whole_record_is_not_accused(seed: int) -> None:
    """Nor one of coarse numbers, pure noise, a sine, or one that begins and ends still."""
    values = shaking(seed)
    coarse = np.round(values, 0)
    noise = np.random.default_rng(seed).standard_normal(2000)
    sine = np.round(np.sin(np.arange(3000) * 2 * np.pi / 50), 4)
    padded = np.concatenate([np.zeros(200), values, np.zeros(300)])
    for whole in (values, coarse, noise, sine, padded):
        assert told(whole) == ()


@pytest.mark.parametrize(("start", "size", "is_told"), [(700, 60, True), (2000, 21, True), (2000, 20, False)])
@pytest.mark.parametrize("value", [0.0, 0.5])
def test_a_stretch_that_stands_still_is_told(start: int, size: int, is_told: bool, value: float) -> None:
    """Outside of the strong shaking, too: zeroed lines, or a line that is repeated again and again."""
    values = shaking(3)
    values[start : start + size] = value
    still = RockingWarning.of(RecordKind.STILL_STRETCH, time_s=start * 0.01, samples=size)
    assert (still in told(values)) == is_told
    values[-100:] = values[-100]
    assert (still in told(values)) == is_told, "whatever longer stretch the record ends with"


def test_a_row_of_all_channels_that_stands_twice_is_told() -> None:
    table = np.stack([shaking(seed) for seed in (5, 6, 7)], axis=1)
    whole = [Accelerogram(column, 0.01) for column in table.T]
    twice = [Accelerogram(column, 0.01) for column in np.insert(table, 2000, table[1999], axis=0).T]
    assert repeated_rows(whole) == () == repeated_rows(twice[:1])
    assert repeated_rows(twice) == (RockingWarning.of(RecordKind.ROW_REPEATED, time_s=2000 * 0.01),)
    coarse = [Accelerogram(np.round(column), 0.01) for column in table.T]
    assert repeated_rows(coarse) == ()


@pytest.mark.parametrize(("size", "is_told"), [(0, False), (1, True), (8, True)])
@pytest.mark.parametrize("of_velocity", [False, True])
def test_a_velocity_that_strays_in_one_place_is_told(size: int, is_told: bool, of_velocity: bool) -> None:
    """Samples exchanged in one of the two, whose whole courses agree within a thousandth."""
    acceleration = shaking(8)
    velocity = np.round(integral(acceleration, 0.01), 6)
    series = velocity if of_velocity else acceleration
    if size:
        series[1900 : 1900 + 2 * size] = np.roll(series[1900 : 1900 + 2 * size], size)
    told_of = agree_with_velocity(Accelerogram(acceleration, 0.01), velocity).warnings
    assert [warning.kind for warning in told_of] == [RecordKind.VELOCITY_UNLIKE_THERE] * is_told
    assert not agree_with_velocity(Accelerogram(acceleration, 0.01), velocity[:-1]).warnings, "of other times"
