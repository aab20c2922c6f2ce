"""Filters against scipy.signal, which the package does without."""

import numpy as np
import pytest
from scipy import signal

from rocking.records import filters

KINDS = {"highpass": True, "lowpass": False}


@pytest.fixture(scope="module")
def walk() -> np.ndarray:
    """A motion with a drift, which shows the lowest frequencies most."""
    return np.cumsum(np.random.default_rng(1).normal(size=4000))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("corner", [1e-3, 0.004, 0.05, 0.3, 0.8])
@pytest.mark.parametrize("order", [2, 4, 6, 8, 10])
def test_an_even_order_is_that_of_scipy_and_runs_as_it_does(walk, order, corner, kind):
    sections = filters.butterworth(order, corner, KINDS[kind])
    # a few roundings of numbers near 1
    assert sections == pytest.approx(signal.butter(order, corner, kind, output="sos"), rel=1e-14, abs=2e-15)
    run = filters.both_ways(sections, walk)
    assert np.array_equal(run, signal.sosfiltfilt(sections, walk, padtype=None))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("corner", [0.004, 0.05, 0.3, 0.8])
@pytest.mark.parametrize("order", [1, 3, 5, 7, 9])
def test_an_odd_order_answers_each_frequency_as_that_of_scipy(order, corner, kind):
    """scipy pairs the real pole with another zero, so that the sections differ, and their product does not."""
    frequencies = np.linspace(0.0, np.pi, 200)
    ours, theirs = (
        signal.sosfreqz(sections, frequencies)[1]
        for sections in (
            filters.butterworth(order, corner, KINDS[kind]),
            signal.butter(order, corner, kind, output="sos"),
        )
    )
    # near ω = 0 a pole of share c stands c from the zero of a high-pass, and roundings grow by its inverse
    assert np.abs(ours - theirs).max() < 1e-13 / corner


def test_a_filter_that_is_run_both_ways_passes_half_of_the_amplitude_at_its_corner():
    """|H|² of Butterworth's is 1/2 there, whatever the order, and the two runs multiply."""
    times = np.arange(20_000)
    corner = 0.05
    wave = np.sin(np.pi * corner * times)
    for order in (1, 3, 4):
        for high_pass in (False, True):
            passed = filters.both_ways(filters.butterworth(order, corner, high_pass), wave)
            middle = slice(8000, 12_000)  # a hundred periods, far from where the runs begin
            assert passed[middle] == pytest.approx(0.5 * wave[middle], abs=1e-9)


def test_the_recursion_of_an_oscillator_is_the_sum_of_what_rings_on():
    factor = 0.9 + 0.2j
    values = np.random.default_rng(2).normal(size=60) + 0j
    summed = [sum(factor ** (k - j) * values[j] for j in range(k + 1)) for k in range(values.size)]
    assert filters.recursion(factor, values.copy()) == pytest.approx(np.array(summed), rel=1e-12)
