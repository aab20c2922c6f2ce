"""Annual rates against the closed form of a lognormal fragility under a power-law hazard."""

import math

import numpy as np
import pytest
from scipy.stats import norm

from rocking.assessment.fragility import fragility_of
from rocking.assessment.rows.of_fragility import HazardRow, annual_rate, read_hazard
from rocking.errors import ConfigurationError

LEVELS = np.geomspace(0.02, 50.0, 400)


def _points(levels, rates) -> list[HazardRow]:
    return [HazardRow(intensity=level, annual_rate=rate) for level, rate in zip(levels, rates, strict=True)]


def test_the_rate_is_that_of_the_closed_form():
    """ν = k₀ x⁻ᵏ and a lognormal of median m and dispersion β: rate = k₀ m⁻ᵏ exp(k²β²/2) (Cornell 1996)."""
    slope, scale, median, dispersion = 2.5, 1e-3, 1.2, 0.4
    thresholds = median * np.exp(dispersion * norm.ppf((np.arange(300) + 0.5) / 300))
    curve = fragility_of(LEVELS, (thresholds[:, None] < LEVELS).astype(float), [str(k) for k in range(300)])
    rates = annual_rate(curve, _points(LEVELS[[0, -1]], scale * LEVELS[[0, -1]] ** -slope))
    exact = scale * median**-slope * math.exp(slope**2 * dispersion**2 / 2)
    # Steps of 2 % in the level, half a step of lag in a curve that is counted: 2.5 x 1 % of the rate.
    assert rates["annual_rate"] == pytest.approx(exact, rel=0.03)
    assert rates["annual_rate_low"] < rates["annual_rate"] < rates["annual_rate_high"]


def test_what_curve_and_hazard_leave_out_is_said():
    """One half of a rate that occurs at and above the level where a curve ends at one half; all below the hazard."""
    half = (np.arange(200)[:, None] < 100 * (np.array([1.0, 2.0]) > 1.5)).astype(float)
    curve = fragility_of(np.array([1.0, 2.0]), half, [str(k) for k in range(200)])
    points = _points([0.5, 8.0], [0.16, 0.01])  # rate 0.08/x
    rates = annual_rate(curve, points)
    # above 2.0 there occurs 0.04 a year, of which the curve counts a half; the steps of the integral are 0.7 %
    assert rates["annual_rate_remainder"] == pytest.approx(0.02, rel=0.02)
    # the same where the hazard curve ends at the last level: all that is rarer occurs beyond it
    ended = annual_rate(curve, _points([0.5, 2.0], [0.16, 0.04]))
    assert ended["annual_rate_remainder"] == pytest.approx(0.02, rel=1e-9)
    falling = fragility_of(np.array([0.1, 0.2]), np.ones((4, 2)), list("abcd"))
    # between 0.1 and 0.5, which the hazard curve does not reach, there occurs 0.8 − 0.16
    assert annual_rate(falling, points)["annual_rate_remainder"] == pytest.approx(0.64, rel=0.02)


@pytest.mark.parametrize(
    ("levels", "rates", "sentence"),
    [
        (
            [0.1, 0.2],
            [1e-3, 2e-3],
            "says 0.002 a year at 0.2, more than 0.001 at 0.1, but annual_rate must not rise",
        ),
        ([0.2, 0.1], [1e-2, 1e-3], "holds 0.1 after 0.2, but intensity must ascend"),
        ([0.1], [1e-2], "holds 1 points, but must hold at least 2"),
        ([0.1, 0.2], [1e-2, 0.0], "both must be above 0"),
    ],
)
def test_a_hazard_that_is_none_is_one_sentence(tmp_path, levels, rates, sentence):
    path = tmp_path / "hazard.csv"
    lines = [f"{level},{rate}" for level, rate in zip(levels, rates, strict=True)]
    path.write_text("\n".join(["intensity,annual_rate", *lines]) + "\n")
    with pytest.raises(ConfigurationError, match=sentence):
        read_hazard(path)
