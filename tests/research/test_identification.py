"""Identification: known structures are found again, predictions hold on tests that took no part, and the mixing
distribution has the weights of cases whose answer is known in closed form."""

import math

import numpy as np
import pytest
from scipy.optimize import minimize

from docs.research import identification as ident
from docs.research.identification import PARAMETERS, BlockPrior, fit_mixture, two_sided_block
from rocking.motion import integrate, integrate_batch
from rocking.records import Accelerogram

STEP = 0.02
TRUTH = (0.13, 0.11, 4.5, 0.9)
NONE = np.empty((0, 4))
PRIOR = BlockPrior((0.06, 0.2), (2.5, 8.0), restitution=(0.75, 0.99), size=256)


def motion(seed: int, peak: float) -> Accelerogram:
    """A few seconds of coloured noise that swells and fades, of a peak acceleration in m/s²."""
    draw, times = np.random.default_rng(seed), np.arange(500) * STEP
    tones = sum(
        draw.normal() * np.sin(2 * np.pi * f * times + draw.uniform(0, 7)) / f for f in (0.4, 0.7, 1.1, 1.9)
    )
    values = np.sin(np.pi * times / times[-1]) ** 2 * tones
    return Accelerogram(values * peak / np.abs(values).max(), STEP, event=str(seed))


def campaign(seeds: range, scatter: float) -> tuple[list[Accelerogram], list[bool]]:
    """Each motion at seven scales, and how a specimen ends whose λ scatters from test to test."""
    draw = np.random.default_rng(99)
    records, outcomes = [], []
    for seed in seeds:
        for peak in np.geomspace(1.0, 6.0, 7):
            change = math.exp(scatter * draw.normal())
            block = two_sided_block(TRUTH[0] * change, TRUTH[1] * change, TRUTH[2], TRUTH[3])
            records.append(motion(seed, peak))
            outcomes.append(math.isinf(integrate(block, records[-1]).rotation_ratio))
    return records, outcomes


def test_the_blocks_of_a_prior_fill_its_box():
    """Evenly in the logarithm: half of them lie below the geometric mean; of η below the mean."""
    first, second, frequency, restitution = (
        BlockPrior((0.06, 0.2), (2.5, 8.0), 1.5, (0.7, 0.9), 256).parameters().T
    )
    ranges = ((np.sqrt(first * second), 0.06, 0.2), (first / second, 1 / 1.5, 1.5), (frequency, 2.5, 8.0))
    for values, low, high in (
        *((np.log(one_range), *np.log(ends)) for one_range, *ends in ranges),
        (restitution, 0.7, 0.9),
    ):
        quartiles = np.quantile(values, (0, 0.25, 0.5, 0.75, 1))
        assert quartiles == pytest.approx(np.linspace(low, high, 5), abs=(high - low) / 100)


def test_known_structures_are_found_and_predicted_under_motions_that_took_no_part():
    records, outcomes = campaign(range(12), 0.05)
    parameters = PRIOR.parameters()
    blocks = [two_sided_block(*number) for number in parameters.tolist()]

    def overturning(motions):
        return np.array([np.isinf(integrate_batch(blocks, motion)[:, 0]) for motion in motions])

    motions = [record.event for record in records]
    mixture = fit_mixture(parameters, overturning(records), np.array(outcomes), motions)
    for name, value in zip(PARAMETERS, TRUTH, strict=True):
        low, median, high = mixture.ranges()[name]
        assert low <= value <= high and low <= median <= high
    low, _, high = mixture.ranges()["uplift_multiplier_positive"]
    prior_low, prior_high = np.quantile(parameters[:, 0], [0.05, 0.95])
    assert high / low < 0.8 * prior_high / prior_low
    records, outcomes = campaign(range(100, 112), 0.05)
    probability = mixture.probability(overturning(records))
    share = np.mean(outcomes)
    assert 0.1 < share < 0.9
    assert np.mean((probability > 0.5) == outcomes) >= 0.9
    assert np.mean((probability - outcomes) ** 2) < 0.4 * share * (1 - share)
    still = Accelerogram(np.full(50, 0.01), STEP)
    assert 1e-5 < mixture.probability(overturning([still]))[0] < 0.05


def test_many_steps_reach_the_largest_likelihood():
    """The problem is convex, so a general optimiser must find the same likelihood."""
    draw = np.random.default_rng(4)
    table = draw.random((60, 5)) < draw.random((60, 1))
    outcomes = table[:, 1] ^ (draw.random(60) < 0.1)
    patterns, _, prior = ident._patterns(table)
    hits = np.where(outcomes[:, None], patterns, 1 - patterns)
    (weights,) = ident._weights(hits, prior, np.ones((60, 1), np.float32), np.array([0.1]), (20_000,))

    def loss(free):
        w = np.exp(free - np.logaddexp.reduce(free))
        p = ident.with_unexplained(patterns @ w, 0.1)
        return -np.log(np.where(outcomes, p, 1 - p)).sum()

    best = min(minimize(loss, draw.normal(size=len(weights))).fun for _ in range(5))
    assert loss(np.log(np.maximum(weights[:, 0], 1e-30))) == pytest.approx(best, abs=1e-3)


def test_one_step_weighs_each_candidate_by_what_it_explains():
    """Two tests end as the first candidate has it, one as the second; a fifth of the outcomes is chance."""
    hits, prior = np.array([[1, 0], [1, 0], [0, 1]], np.float32), np.array([0.5, 0.5], np.float32)
    (weights,) = ident._weights(hits, prior, np.ones((3, 1), np.float32), np.array([0.2]), (1,))
    gains = np.array([2 * 0.9 + 0.1, 2 * 0.1 + 0.9])
    assert weights[:, 0] == pytest.approx(gains / gains.sum(), rel=1e-5)


def test_scattered_outcomes_ask_for_fewer_steps_than_clear_ones():
    """Outcomes that are chance leave the weights near the prior's: whatever is learnt fails on motions left out."""
    draw = np.random.default_rng(6)
    table, groups = draw.random((120, 40)) < 0.5, [str(k // 6) for k in range(120)]
    clear = fit_mixture(NONE, table, table[:, 0], groups)
    chance = fit_mixture(NONE, table, draw.random(120) < 0.5, groups)
    assert clear.weights[0] > 0.8
    assert chance.iterations < clear.iterations


def test_probabilities_that_are_too_careful_are_sharpened_and_bold_ones_blunted():
    """Outcomes drawn with the log odds multiplied by b give b back."""
    draw = np.random.default_rng(8)
    odds = draw.normal(size=20_000)
    for factor in (0.7, 1.0, 1.6):
        happened = draw.random(odds.size) < 1 / (1 + np.exp(-factor * odds))
        said = np.where(happened, 1 / (1 + np.exp(-odds)), 1 / (1 + np.exp(odds)))
        assert ident.sharpness(said) == pytest.approx(factor, abs=0.07)  # three standard errors
