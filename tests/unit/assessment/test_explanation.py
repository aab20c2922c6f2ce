"""Efficiency and dependence: components of one station are one observation; every outcome counts."""

import numpy as np
import pytest
from scipy.optimize import minimize
from scipy.stats import norm
from scipy.stats import t as student

from rocking.earthquakes.sample import ClusterSample
from rocking.fragility.curves import explanation

LEVELS = np.log(np.geomspace(0.05, 20.0, 60))


def outcomes(capacities: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Levels (r, k) and whether each record overturns there, where it does from its capacity on."""
    levels = np.broadcast_to(LEVELS, (capacities.size, LEVELS.size))
    return levels, (levels > capacities[:, None]).astype(float)


def test_a_second_component_that_says_the_same_adds_nothing():
    rng = np.random.default_rng(1)
    figures = rng.standard_normal(12)
    levels, falls = outcomes(0.4 * figures + 0.5 * rng.standard_normal(12))
    names = [f"{k:02d}" for k in range(12)]
    once = explanation(levels, falls, figures, ClusterSample.scattered(names))
    again = [np.repeat(case, 2, axis=0) for case in (levels, falls, figures)]
    twice = explanation(*again, ClusterSample.scattered(np.repeat(names, 2).tolist()))
    assert twice.p_value == pytest.approx(once.p_value, rel=1e-6)
    # Student's law for 12 stations less three, by which the power counts as well
    size, limit = student.isf([once.p_value / 2, 0.025], 9)
    assert once.power == pytest.approx(norm.cdf(size - limit) + norm.cdf(-size - limit), rel=1e-9)
    assert twice.efficiency == pytest.approx(once.efficiency, rel=1e-6)


def test_the_slope_and_the_scatter_are_those_behind_the_outcomes():
    rng = np.random.default_rng(3)
    figures = rng.standard_normal(400)
    names = [str(k) for k in range(400)]
    columns = explanation(
        *outcomes(0.3 * figures + 0.4 * rng.standard_normal(400)), figures, ClusterSample.scattered(names)
    )
    # its standard error is 0.4/20
    assert columns.slope == pytest.approx(0.3, abs=0.06)
    assert columns.p_value < 1e-6 and columns.power > 0.99
    # the logistic law of the same scatter, and 1/28 of it by chance
    unlike = explanation(*outcomes(0.4 * rng.standard_normal(400)), figures, ClusterSample.scattered(names))
    assert unlike.efficiency == pytest.approx(0.4, rel=0.12)


def test_a_figure_that_differs_only_in_a_record_that_no_level_reaches_explains_nothing():
    """Beside the intercept it made the matrix singular, or a slope out of rounding."""
    rng = np.random.default_rng(0)
    levels, falls = outcomes(0.4 * rng.standard_normal(7))
    falls[6] = np.nan
    columns = explanation(levels, falls, np.array([0.3] * 6 + [1.3]), ClusterSample.scattered("abcdefg"))
    without = explanation(levels[:6], falls[:6], np.full(6, 0.3), ClusterSample.scattered("abcdef"))
    assert columns.efficiency == without.efficiency
    assert np.isnan([columns.slope, columns.p_value, columns.power]).all()


def test_the_scatter_of_outcomes_that_a_level_parts_cleanly_is_that_of_the_penalised_fit():
    """−log L + 1e-9 n b²/2, where b is the slope for one standard deviation of the levels, is least there by scipy."""
    levels, falls = outcomes(np.zeros(4))
    signs, spread = np.where(falls, 1.0, -1.0), levels.std()

    def loss(free: np.ndarray) -> float:
        offset, slope = free
        likelihood = norm.logcdf(signs * (offset + slope * levels)).sum()
        return float(1e-9 * levels.size * (slope * spread) ** 2 / 2 - likelihood)

    best = minimize(loss, (0.0, 10.0), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-16})
    columns = explanation(levels, falls, np.ones(len(falls)), ClusterSample.scattered("abcd"))
    assert columns.efficiency == pytest.approx(1 / best.x[1], rel=1e-3)


def test_a_record_that_never_overturns_counts():
    """The capacities above the highest level are those of large figures: to drop them would hide the slope."""
    rng = np.random.default_rng(4)
    figures = rng.standard_normal(60)
    capacities = figures + 0.3 * rng.standard_normal(60)
    levels, falls = outcomes(capacities)
    low = levels[0] < 0.5
    names = [str(k) for k in range(60)]
    assert (falls[:, low].sum(axis=1) == 0).sum() > 10
    assert explanation(
        levels[:, low], falls[:, low], figures, ClusterSample.scattered(names)
    ).slope == pytest.approx(1.0, abs=0.25)


@pytest.mark.parametrize("trials", [60, pytest.param(200, marks=pytest.mark.slow)])
def test_stations_without_a_dependence_seldom_seem_to_have_one(trials):
    rng = np.random.default_rng(5)
    names = [str(k // 2) for k in range(60)]
    called, power = [], []
    for _ in range(trials):
        figures, capacities = (
            (rng.standard_normal((30, 1)) + 0.3 * rng.standard_normal((30, 2))).ravel() for _ in range(2)
        )
        columns = explanation(*outcomes(0.5 * capacities), figures, ClusterSample.scattered(names))
        called.append(columns.p_value < 0.05)
        power.append(columns.power)
    # 5 % of n scatter by 22 % / √n; three deviations, and the error from 30 stations is somewhat small
    assert np.mean(called) < 0.06 + 0.66 / np.sqrt(trials)
    assert np.median(power) < 0.3, "and says that it would seldom see a slope of that size"


def test_too_few_stations_say_nothing():
    levels, falls = outcomes(np.linspace(-1, 1, 6))
    few = explanation(levels, falls, np.arange(6.0), ClusterSample.scattered("aabbcc"))
    equal = explanation(levels, falls, np.ones(6), ClusterSample.scattered("abcdef"))
    for case in (few, equal):
        assert case.efficiency > 0
        assert np.isnan([case.slope, case.p_value, case.power]).all()


@pytest.mark.parametrize("seed", range(6))
def test_of_a_slope_near_zero_both_signs_count_in_the_power(seed):
    """It is the chance of showing such a slope again: a sample scatters by one error about that of the p value."""
    rng = np.random.default_rng(seed)
    names = [str(n) for n in range(12)]
    levels = np.broadcast_to(np.linspace(-1.0, 1.0, 15), (12, 15))
    figures = rng.normal(size=12)
    limits = (0.05 * seed * figures + rng.normal(scale=0.3, size=12))[:, None]
    found = explanation(levels, (levels > limits).astype(float), figures, ClusterSample.scattered(names))
    errors = student.isf(found.p_value / 2, 9)
    limit = student.isf(0.025, 9)
    assert found.power == pytest.approx(norm.sf(limit, loc=errors) + norm.cdf(-limit, loc=errors), rel=1e-6)
