"""Which runs to buy: what is bought gives the interval that was asked for."""

import math

import numpy as np
import pytest

from rocking.assessment.fragility import fragility, multi_fidelity_analysis, purchases
from rocking.errors import ConfigurationError
from rocking.records import Accelerogram
from rocking.structures import Wall

STEP, TIMES = 0.01, np.arange(0, 4, 0.01)
WALL, LEVELS = Wall(1.5, 1.0, 0.3), np.geomspace(0.15, 4.0, 20)
PERIODS = np.geomspace(0.4, 2.0, 40)


def _record(k: int) -> Accelerogram:
    wave = np.sin(2 * np.pi * TIMES / PERIODS[k] + 0.7 * k) * np.exp(-((TIMES - 1.5) ** 2))
    return Accelerogram(wave, STEP, component="made", event="made", station=str(k))


RECORDS = [_record(k) for k in range(40)]


def _width(found) -> float:
    return math.log(found.interval[1] / found.interval[0])


@pytest.fixture(scope="module")
def pilot():
    return multi_fidelity_analysis(RECORDS, WALL, 80, levels=LEVELS)


def test_what_is_bought_gives_the_interval(pilot):
    every = _width(fragility(RECORDS, WALL, levels=LEVELS))
    wanted = 1.25 * every
    bought = {each.method: each for each in purchases(pilot, math.exp(wanted))}
    few = fragility(
        RECORDS,
        WALL,
        levels=LEVELS,
        method="multi-fidelity",
        mechanism_runs=bought["multi-fidelity"].mechanism_runs,
    )
    rng = np.random.default_rng(0)
    fewer = [
        _width(
            fragility(
                [RECORDS[k] for k in rng.permutation(40)[: bought["scaling"].stations]], WALL, levels=LEVELS
            )
        )
        for _ in range(8)
    ]
    # Widths of 40 stations scatter by 1/(2 * 40)^0.5 = 11 %, and the plan comes from two of them.
    assert _width(few) == pytest.approx(wanted, rel=0.3)
    assert np.mean(fewer) == pytest.approx(wanted, rel=0.3)


def test_the_cheapest_comes_first_and_counts_the_block(pilot):
    bought = purchases(pilot, 3 * math.exp(_width(pilot.block.fragility())))
    assert [each.cpu for each in bought] == sorted(each.cpu for each in bought)
    by_method = {each.method: each for each in bought}
    assert by_method["multi-fidelity"].cpu > pilot.block_seconds
    assert by_method["scaling"].mechanism_runs == by_method["scaling"].stations * LEVELS.size
    assert "runs of the mechanism under" in str(bought[0])


def test_an_interval_that_the_records_do_not_allow_is_one_sentence(pilot):
    least = math.exp(_width(pilot.block.fragility()))
    with pytest.raises(
        ConfigurationError, match=r"40 stations allow no less than .*; give about 4\d stations"
    ):
        purchases(pilot, least**0.98)
    with pytest.raises(ConfigurationError, match="must be greater than 1"):
        purchases(pilot, 1.0)
