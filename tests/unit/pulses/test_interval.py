"""The bootstrap interval: repeatable, honest at its limits; its coverage stands with the acceptance figures."""

import numpy as np
import pytest

from rocking.errors import PulseError
from rocking.pulses import Pulse, PulseSettings, extract_pulses, pulse_interval
from rocking.pulses.interval import _replicate
from rocking.pulses.search import PulseSearch, searched_band
from rocking.records.accelerogram import Accelerogram

STEP = 0.01
TIMES = np.arange(2000) * STEP


def noisy(size, seed=5):
    noise = size * np.random.default_rng(seed).standard_normal(TIMES.size)
    return extract_pulses(Accelerogram(Pulse(2.0, 2 * np.pi / 1.3, 6.2).acceleration(TIMES) + noise, STEP))


def test_the_same_record_gives_the_same_interval():
    one, two = pulse_interval(noisy(0.5), replicates=40), pulse_interval(noisy(0.5), replicates=40)
    assert one == two
    assert one != pulse_interval(noisy(0.5, seed=6), replicates=40)


def test_the_interval_narrows_with_the_noise_and_vanishes_without():
    wide, narrow, none = (pulse_interval(noisy(size), replicates=60) for size in (1.0, 0.1, 0.0))
    for name in ("amplitude", "period", "start_time"):
        widths = [high - low for low, high in (getattr(i, name) for i in (wide, narrow, none))]
        assert widths[0] > widths[1] > widths[2]
        assert widths[2] == pytest.approx(0, abs=1e-9)


def test_a_higher_level_is_wider():
    analysis = noisy(0.5)
    inner, outer = (pulse_interval(analysis, level=level) for level in (0.5, 0.95))
    assert outer.period[0] < inner.period[0] < inner.period[1] < outer.period[1]


def test_a_rival_has_an_interval_of_its_own():
    samples = Pulse(2.0, 2 * np.pi / 1.3, 4.2).acceleration(TIMES) + Pulse(-1.6, 2 * np.pi, 13).acceleration(
        TIMES
    )
    noise = 0.3 * np.random.default_rng(2).standard_normal(TIMES.size)
    analysis = extract_pulses(Accelerogram(samples + noise, STEP))
    rival = next(e.pulse for e in analysis.alternatives if e.pulse.start_time > 10)
    found = pulse_interval(analysis, pulse=rival, replicates=100)
    assert found.start_time[0] < 13 < found.start_time[1]
    assert found.amplitude[0] < -1.6 < found.amplitude[1]
    assert pulse_interval(analysis, pulse=analysis.dominant, replicates=40) == pulse_interval(
        analysis, replicates=40
    )


@pytest.mark.parametrize("options", [{"level": 1.0}, {"level": 0.0}, {"replicates": 5}])
def test_impossible_options_are_refused(options):
    with pytest.raises(PulseError):
        pulse_interval(noisy(0.5), **options)


@pytest.mark.parametrize(("start", "sign"), [(13.2, 1.0), (13.2, -1.0), (1.2, 1.0)])
def test_the_drawn_sample_of_the_residual_comes_under_the_middle_of_the_pulse(start, sign):
    # half the same cycle elsewhere in the residual, drawn at its middle, is laid exactly on the pulse
    pulse, settings = Pulse(2.0, 2 * np.pi / 1.3, 6.2), PulseSettings()
    residual = Pulse(1.0, pulse.circular_frequency, start).acceleration(TIMES)
    search = PulseSearch(STEP, searched_band(Accelerogram(residual, STEP), settings), settings)
    found = _replicate(search, pulse, residual, round((start + 0.65) / STEP), sign)
    assert found.amplitude == pytest.approx(2.0 + sign, rel=1e-6)
    assert found.period == pytest.approx(1.3, rel=1e-6)
    assert found.start_time == pytest.approx(6.2, abs=1e-6)
