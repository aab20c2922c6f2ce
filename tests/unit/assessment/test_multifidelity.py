"""Multi-fidelity fragility: a sample of the mechanism tells the curve of all of it, whatever the block says."""

import numpy as np
import pytest
from scipy.stats import norm

from rocking.assessment.ensemble import EnsembleSettings
from rocking.assessment.fragility import fragility, fragility_of, multi_fidelity_analysis
from rocking.assessment.fragility.multifidelity import corrected, inclusion, systematic_draw
from rocking.motion import integrate
from rocking.records import Accelerogram
from rocking.structures import Wall

LEVELS = np.geomspace(0.2, 5.0, 20)
STEP, TIMES = 0.01, np.arange(0, 4, 0.01)
WALL = Wall(1.5, 1.0, 0.3)


def made_outcomes(rng: np.random.Generator, records: int, alike: float) -> tuple[np.ndarray, np.ndarray]:
    """Mechanism and block, (records, 20), that part by `alike` in the logarithm, with 3 % of outcomes turned round."""
    threshold = np.exp(0.5 * rng.standard_normal((records, 1)))
    blocks = threshold * np.exp(alike * rng.standard_normal((records, 1)))
    turned = rng.random((records, LEVELS.size)) < 0.03
    return ((threshold < LEVELS) ^ turned).astype(float), (blocks < LEVELS).astype(float)


def estimates(
    outcomes: np.ndarray, blocks: np.ndarray, runs: int, rng: np.random.Generator, repeats: int
) -> np.ndarray:
    """The curve, (repeats, levels), from `runs` runs."""
    chance = inclusion(LEVELS, blocks, runs)
    return np.array(
        [
            corrected(LEVELS, blocks, systematic_draw(chance, rng), outcomes, chance).mean(axis=0)
            for _ in range(repeats)
        ]
    )


def test_cases_are_drawn_as_often_as_their_chance_says():
    rng = np.random.default_rng(2)
    _, blocks = made_outcomes(rng, 12, 0.1)
    chance = inclusion(LEVELS, blocks, 60)
    assert chance.sum() == pytest.approx(60) and chance.min() > 0 and chance.max() <= 1 + 1e-12
    drawn = np.array([systematic_draw(chance, rng) for _ in range(4000)])
    assert np.all(drawn.sum(axis=(1, 2)) == 60)
    # A frequency of 4 000 draws scatters by at most 0.008; four such deviations for the worst of 240.
    assert drawn.mean(axis=0) == pytest.approx(chance, abs=0.032)


@pytest.mark.parametrize("block", ["alike", "blind", "contrary"])
def test_the_mean_of_the_curve_is_that_of_the_mechanism(block):
    """Whatever the block says, even always the contrary: that costs width alone."""
    rng = np.random.default_rng(4)
    outcomes, alike = made_outcomes(rng, 40, 0.1)
    blocks = {"alike": alike, "blind": np.zeros_like(alike), "contrary": 1 - outcomes}[block]
    found = estimates(outcomes, blocks, 100, rng, 1000)
    error = found.std(axis=0) / 1000**0.5
    assert np.all(np.abs(found.mean(axis=0) - outcomes.mean(axis=0)) <= 4 * error + 1e-12)


def test_a_block_that_is_alike_buys_several_times_the_runs():
    """Of 80 records, 100 runs at random cases are 5 at a level, whose share scatters by the root of p(1 - p)/5."""
    rng = np.random.default_rng(6)
    outcomes, blocks = made_outcomes(rng, 80, 0.1)
    truth = outcomes.mean(axis=0)
    middle = (truth > 0.1) & (truth < 0.9)
    scatter = estimates(outcomes, blocks, 100, rng, 300).var(axis=0)[middle].mean()
    assert (truth * (1 - truth))[middle].mean() / 5 > 4 * scatter


def test_the_interval_covers_a_known_curve():
    """Records of two components a station, drawn anew each time, and a sample of their mechanism."""
    rng = np.random.default_rng(8)
    truth = norm.cdf(np.log(LEVELS) / 0.5)
    middle = (truth > 0.02) & (truth < 0.98)
    covered, medians = [], []
    for _ in range(80):
        shared, own = rng.standard_normal((30, 1)), rng.standard_normal((30, 2))
        logs = 0.5 * ((shared + own) / 2**0.5).reshape(-1, 1)
        outcomes = (np.exp(logs) < LEVELS).astype(float)
        blocks = (np.exp(logs + 0.1 * rng.standard_normal((60, 1))) < LEVELS).astype(float)
        chance = inclusion(LEVELS, blocks, 150)
        said = corrected(LEVELS, blocks, systematic_draw(chance, rng), outcomes, chance)
        names = [str(k // 2) for k in range(60)]
        found = fragility_of(LEVELS, said, names, sampled_of=fragility_of(LEVELS, blocks, names))
        inside = (found.probability_low <= truth) & (truth <= found.probability_high)
        covered.append(inside[middle].mean())
        medians.append(found.interval[0] <= 1.0 <= found.interval[1])
    # 80 trials of a coverage of 0.9 scatter by 0.034; three deviations of a single proportion are 0.10.
    assert np.mean(covered) == pytest.approx(0.9, abs=0.08) and np.mean(medians) >= 0.8


def _record(period: float, station: str) -> Accelerogram:
    wave = np.sin(2 * np.pi * TIMES / period) * np.exp(-((TIMES - 1.5) ** 2))
    return Accelerogram(wave, STEP, component="made", event="made", station=station)


RECORDS = [_record(period, f"{k // 2}") for k, period in enumerate((0.6, 0.7, 0.9, 1.0, 1.3, 1.5))]


def test_all_runs_are_the_exhaustive_answer():
    every = fragility(RECORDS, WALL, levels=LEVELS)
    found = fragility(RECORDS, WALL, levels=LEVELS, method="multi-fidelity", mechanism_runs=120)
    assert found.probability == pytest.approx(every.probability, abs=1e-12)
    assert found.median == pytest.approx(every.median, rel=1e-9)
    assert found.mechanism_runs == 120 and "120 runs of the mechanism" in repr(found)


def test_what_was_followed_is_the_mechanism_and_repeats():
    once, again = (
        multi_fidelity_analysis(RECORDS, WALL, 40, levels=LEVELS, intensity_measure="pgv") for _ in range(2)
    )
    assert once.mechanism_runs == 40
    assert np.array_equal(once.rotation_ratios, again.rotation_ratios, equal_nan=True)
    for record, level in zip(*np.nonzero(~np.isnan(once.rotation_ratios)), strict=True):
        scaled = RECORDS[record].scaled(LEVELS[level] / once.block.intensities[record])
        alone = integrate(WALL, scaled).rotation_ratio
        assert once.rotation_ratios[record, level] == pytest.approx(alone, rel=1e-9)
    turned = once.fragility(0.2)
    assert turned.threshold == 0.2 and np.all((turned.probability >= 0) & (turned.probability <= 1))


def test_members_are_drawn_by_chance_and_their_mean_is_the_share():
    ensemble = EnsembleSettings(amplitude_range=0.3)
    levels = np.geomspace(0.3, 2, 8)
    every = fragility(RECORDS, WALL, levels=levels, ensemble=ensemble)
    assert ((every.exceedance > 0) & (every.exceedance < 1)).any()
    drawn = [
        multi_fidelity_analysis(RECORDS, WALL, 48, levels=levels, ensemble=ensemble, seed=seed)
        .fragility()
        .probability
        for seed in range(25)
    ]
    assert np.std(drawn, axis=0).max() > 0
    # One member for each of 6 records: the mean of 25 draws scatters by at most 0.5/(6 * 25)^0.5 = 0.041.
    assert np.mean(drawn, axis=0) == pytest.approx(every.probability, abs=4 * 0.041)
