"""The mixing distribution, against cases whose answer is known in closed form."""

import numpy as np
import pytest
from scipy.optimize import minimize

from docs.research import mixture
from docs.research.mixture import fit_mixture, with_unexplained


def test_one_candidate_that_falls_and_one_that_stands_share_the_tests():
    """With both, (1 − ε) w + ε/2 must be the observed share: the likelihood of a coin."""
    outcomes = np.arange(40) < 13
    table = np.column_stack([np.ones(40, bool), np.zeros(40, bool)])
    found = fit_mixture(table, outcomes, [str(k % 8) for k in range(40)])
    share = with_unexplained(found.weights[0], found.unexplained)
    assert share == pytest.approx(13 / 40, abs=2e-3)


def test_many_steps_reach_the_largest_likelihood():
    """The problem is convex, so a general optimiser must find the same likelihood."""
    draw = np.random.default_rng(4)
    table = draw.random((60, 5)) < draw.random((60, 1))
    outcomes = table[:, 1] ^ (draw.random(60) < 0.1)
    patterns, _, prior = mixture._patterns(table)
    hits = np.where(outcomes[:, None], patterns, 1 - patterns)
    (weights,) = mixture._weights(hits, prior, np.ones((60, 1), np.float32), np.array([0.1]), (20_000,))
    weights = weights[:, 0]

    def loss(free):
        w = np.exp(free - np.logaddexp.reduce(free))
        p = with_unexplained(patterns @ w, 0.1)
        return -np.log(np.where(outcomes, p, 1 - p)).sum()

    best = min(minimize(loss, draw.normal(size=weights.size)).fun for _ in range(5))
    assert loss(np.log(np.maximum(weights, 1e-30))) == pytest.approx(best, abs=1e-3)


def test_scattered_outcomes_ask_for_fewer_steps_than_clear_ones():
    """Outcomes that are chance leave the weights near the prior's: whatever is learnt fails on motions left out."""
    draw = np.random.default_rng(6)
    table = draw.random((120, 40)) < 0.5
    groups = [str(k // 6) for k in range(120)]
    clear = fit_mixture(table, table[:, 0], groups)
    chance = fit_mixture(table, draw.random(120) < 0.5, groups)
    assert clear.weights[0] > 0.8
    assert chance.iterations < clear.iterations
    assert clear.log_score > chance.log_score


def test_probability_follows_from_the_weights():
    found = mixture.Mixture(np.array([0.25, 0.75]), 0.1, 10, 1.0, -0.1)
    table = np.array([[True, False], [True, True], [False, False]])
    assert np.allclose(found.probability(table), [0.9 * 0.25 + 0.05, 0.95, 0.05])


def test_sharpness_multiplies_the_log_odds():
    found = mixture.Mixture(np.array([0.25, 0.75]), 0.1, 10, 2.0, -0.1)
    share = np.array([0.0, 0.25, 0.75, 1.0])
    odds = with_unexplained(share, 0.1) / (1 - with_unexplained(share, 0.1))
    table = np.array([[False, False], [True, False], [False, True], [True, True]])
    assert found.probability(table) == pytest.approx(odds**2 / (1 + odds**2))


def test_probabilities_that_are_too_careful_are_sharpened_and_bold_ones_blunted():
    """Outcomes drawn with the log odds multiplied by b give b back."""
    draw = np.random.default_rng(8)
    odds = draw.normal(size=20_000)
    for factor in (0.7, 1.0, 1.6):
        happened = draw.random(odds.size) < 1 / (1 + np.exp(-factor * odds))
        said = np.where(happened, 1 / (1 + np.exp(-odds)), 1 / (1 + np.exp(odds)))
        assert mixture._sharpened(said)[0] == pytest.approx(factor, abs=0.07)  # three standard errors
    assert mixture._sharpened(np.full(9, 0.99))[0] == pytest.approx(mixture.SHARPNESS[1], abs=1e-3)
