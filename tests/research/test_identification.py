"""Identification: known structures are found again, and predictions hold on tests that took no part."""

import math

import numpy as np
import pytest

from docs.research.identification import PARAMETERS, BlockPrior, identify, overturning_table, two_sided_block
from rocking.errors import ConfigurationError
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.records.processing import Processing

STEP = 0.02
LINEAR = Processing(baseline="linear")
TRUTH = (0.13, 0.11, 4.5, 0.9)
PRIOR = BlockPrior((0.06, 0.2), (2.5, 8.0), restitution=(0.75, 0.99), size=256)


def motion(seed: int, peak: float) -> Accelerogram:
    """A few seconds of coloured noise that swells and fades, of a peak acceleration in m/s²."""
    draw = np.random.default_rng(seed)
    times = np.arange(500) * STEP
    shape = np.sin(np.pi * times / times[-1]) ** 2
    tones = sum(
        draw.normal() * np.sin(2 * np.pi * f * times + draw.uniform(0, 7)) / f for f in (0.4, 0.7, 1.1, 1.9)
    )
    values = shape * tones
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


@pytest.fixture(scope="module")
def found():
    records, outcomes = campaign(range(12), 0.05)
    return identify(records, outcomes, PRIOR, motions=[each.event for each in records])


def test_the_true_parameters_lie_within_the_ranges(found):
    for name, value in zip(PARAMETERS, TRUTH, strict=True):
        low, median, high = found.ranges()[name]
        assert low <= value <= high
        assert low <= median <= high


def test_the_ranges_are_narrower_than_the_prior(found):
    low, _, high = found.ranges()["uplift_multiplier_positive"]
    prior_low, prior_high = np.quantile(PRIOR.parameters()[:, 0], [0.05, 0.95])
    assert high / low < 0.8 * prior_high / prior_low


def test_motions_that_took_no_part_are_predicted(found):
    records, outcomes = campaign(range(100, 112), 0.05)
    probability = found.overturning_probabilities(records)
    share = np.mean(outcomes)
    assert 0.1 < share < 0.9
    assert np.mean((probability > 0.5) == outcomes) >= 0.9
    assert np.mean((probability - outcomes) ** 2) < 0.4 * share * (1 - share)


def test_probabilities_keep_clear_of_certainty(found):
    still = Accelerogram(np.full(50, 0.01), STEP)
    assert 1e-5 < found.overturning_probabilities([still])[0] < 0.05


def test_the_table_says_what_integrate_says():
    blocks = [two_sided_block(*row) for row in PRIOR.parameters()[:16].tolist()]
    records = [motion(3, 2.0), motion(4, 4.0)]
    table = overturning_table(blocks, records)
    expected = [[math.isinf(integrate(block, each).rotation_ratio) for block in blocks] for each in records]
    assert table.tolist() == expected


def test_sequences_of_unlike_length_are_refused():
    with pytest.raises(ConfigurationError, match="1 records, 2 outcomes and 1 motions"):
        identify([motion(1, 2.0)], [True, False], PRIOR)
