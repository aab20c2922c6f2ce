"""The adaptive baseline against its description, made with the means of scipy."""

import re

import numpy as np
import pytest
from scipy.integrate import cumulative_trapezoid
from scipy.interpolate import CubicHermiteSpline

from rocking.errors import RecordError
from rocking.records.processing import adaptive_baseline

STEP = 0.01


def shaken(seed: int, seconds: float = 40.0) -> np.ndarray:
    """Ten seconds of noise after five of near rest, then a tilt that stays."""
    rng, t = np.random.default_rng(seed), np.arange(0, seconds, STEP)
    noise = np.convolve(rng.normal(size=t.size), np.hanning(15) / 8, "same")
    return noise * (1e-3 + ((t > 5) & (t < 15))) + 0.02 * (t > rng.uniform(7, 12)) + 1e-4 * (t - 20)


def kicked() -> np.ndarray:
    """One sample holds nearly all the energy, so that shaking gets the 16 samples that it has at least."""
    values = shaken(7, 6.0) * 1e-3
    values[3] = 5.0
    return values


def drift_of(velocity: np.ndarray, onset: int, end: int, degree: int) -> np.ndarray:
    """A line to `onset`, a polynomial from `end`, and between them the cubic that meets both in value and slope."""
    t = np.linspace(0, 1, velocity.size)
    before, after = np.polyfit(t[:onset], velocity[:onset], 1), np.polyfit(t[end:], velocity[end:], degree)
    ends, lines = (t[onset], t[end]), (before, after)
    values = [np.polyval(line, x) for line, x in zip(lines, ends, strict=True)]
    slopes = [np.polyval(np.polyder(line), x) for line, x in zip(lines, ends, strict=True)]
    bridge = CubicHermiteSpline(ends, values, slopes)(t[onset:end])
    return np.concatenate([np.polyval(before, t[:onset]), bridge, np.polyval(after, t[end:])])


def wandering(velocity: np.ndarray) -> float:
    return float(np.abs(np.cumsum(velocity)).max() * STEP)


@pytest.mark.parametrize("values", [*(shaken(seed) for seed in range(4)), kicked()])
def test_the_drift_that_leaves_the_smallest_displacement_is_removed(values: np.ndarray) -> None:
    velocity = cumulative_trapezoid(values, dx=STEP, initial=0)
    passed = np.cumsum(values**2) / np.sum(values**2)
    onset = max(8, int(np.argmax(passed >= 1e-3)))
    strong = max(onset + 16, int(np.argmax(passed >= 0.95)))
    last = min(strong + int(0.85 * (values.size - strong)), values.size - 16)
    ends = {int(end) for end in np.linspace(strong, last, 20)}
    left = {
        (end, degree): wandering(velocity - drift_of(velocity, onset, end, degree))
        for end in ends
        for degree in (1, 2)
    }
    corrected, sentence = adaptive_baseline(values, STEP)
    told = re.search(r"before (\S+) s and after (\S+) s \(degree (\d)\)", sentence)
    assert told and round(float(told[1]) / STEP) == onset
    chosen = round(float(told[2]) / STEP), int(told[3])
    assert left[chosen] <= min(left.values()) * (1 + 1e-6)
    removed = np.gradient(drift_of(velocity, onset, *chosen), STEP)
    # Two ways to the same least squares: rounding only.
    assert np.abs(values - corrected - removed).max() < 1e-9 * np.abs(values).max()


@pytest.mark.parametrize("values", [np.zeros(200), shaken(1)[600:663]])
def test_without_motion_or_with_few_samples_there_is_none(values: np.ndarray) -> None:
    with pytest.raises(RecordError, match="needs motion and at least 64 samples"):
        adaptive_baseline(values, STEP)
