"""Sufficiency: components of one station are one observation; against scipy where they are independent."""

import math

import numpy as np
import pytest
from scipy.stats import linregress

from rocking.assessment.fragility.sufficiency import sufficiency


def test_a_second_component_that_says_the_same_adds_nothing():
    rng = np.random.default_rng(1)
    figures = rng.standard_normal(12)
    capacities = 0.4 * figures + rng.standard_normal(12)
    names = [f"{k:02d}" for k in range(12)]
    once = sufficiency(figures, capacities, names)
    twice = sufficiency(np.repeat(figures, 2), np.repeat(capacities, 2), np.repeat(names, 2).tolist())
    assert twice == pytest.approx(once, rel=1e-9)
    assert linregress(np.repeat(figures, 2), np.repeat(capacities, 2)).pvalue < 0.8 * once


def test_independent_records_are_judged_as_by_least_squares():
    rng = np.random.default_rng(3)
    figures = rng.standard_normal(200)
    names = [str(k) for k in range(200)]
    for slope in (0.0, 0.15):
        capacities = slope * figures + rng.standard_normal(200)
        found, plain = sufficiency(figures, capacities, names), linregress(figures, capacities).pvalue
        # The resampled error of 200 records scatters by some 5 %, and with it the quantile that p stands for.
        assert found == pytest.approx(plain, abs=0.05)


def test_stations_without_a_dependence_seldom_seem_to_have_one():
    rng = np.random.default_rng(5)
    names = [str(k // 2) for k in range(60)]
    called = []
    for _ in range(200):
        figures, capacities = (
            (rng.standard_normal((30, 1)) + 0.3 * rng.standard_normal((30, 2))).ravel() for _ in range(2)
        )
        called.append(sufficiency(figures, capacities, names) < 0.05)
    # 5 % of 200 scatter by 1.5 %; three deviations, and the resampled error of 30 stations is somewhat small.
    assert np.mean(called) < 0.10


def test_too_few_stations_say_nothing():
    assert math.isnan(sufficiency(np.arange(6.0), np.arange(6.0) ** 2, ["a", "a", "b", "b", "c", "c"]))
    assert math.isnan(sufficiency(np.ones(6), np.arange(6.0), list("abcdef")))
