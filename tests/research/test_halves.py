"""What holds on the other half of the earthquakes: what each rule chooses, and what its scores count."""

import numpy as np
import pytest

from docs.research.halves import TARGETS, scores_of_halves, seems, shown, split
from rocking.earthquakes.sample import ClusterSample
from rocking.strengthening import GRID, Strengthening, Tried, sizes
from rocking.structures import Block

(BREADTH,) = (size for size in sizes(Block(2.0, 0.2)) if size.name == "breadth")
VALUES = np.geomspace(0.1, 1.0, GRID).tolist()


def _found(shares: np.ndarray) -> Strengthening:
    sample = ClusterSample.scattered([f"station {k}" for k in range(shares.shape[1])])
    tried = tuple(Tried(value, row, sample) for value, row in zip(VALUES, shares, strict=True))
    return Strengthening(BREADTH, 0.1, sample, tried, tried[0])


def test_the_value_that_is_shown_is_that_of_those_stations_alone():
    """The first twenty stations stand from the sixth value on, the others from the tenth."""
    shares = np.ones((GRID, 40))
    shares[6:, :20] = 0.0
    shares[10:, 20:] = 0.0
    found = _found(shares)
    assert shown(found, np.arange(20), 0.2).value == VALUES[6]
    assert shown(found, np.arange(20, 40), 0.2).value == VALUES[10]
    assert shown(found, np.arange(5), 0.1) is None  # five stations show no share of a tenth
    assert seems(found, np.arange(5), 0.1).value == VALUES[6]


def test_the_scores_are_the_shares_of_the_other_half():
    """Where all stations are alike both rules choose the same value, and every half holds."""
    shares = np.zeros((GRID, 60))
    shares[:8] = 1.0
    scores = list(scores_of_halves("made", _found(shares)))
    parts = {score.part for score in scores}
    assert parts == {f"{rule} to hold, target {limit:g}" for rule in ("shown", "seems") for limit in TARGETS}
    values = {one_score.measure.split(" ")[0]: one_score.value for one_score in scores}
    assert values == pytest.approx({"share": 0.0, "value": VALUES[8], "of": 1.0})
    assert {
        other_score.sites for other_score in scores if other_score.measure == "share of the other half"
    } == {30}


def test_the_least_value_that_seems_to_hold_fails_on_half_of_the_halves():
    """A share of a fifth in all, with a target of a fifth: where one half has less, the other one has more."""
    shares = np.zeros((GRID, 50))
    shares[:8] = 1.0
    shares[8, :10] = 1.0
    scores = {
        (score.part, score.measure.split(" ")[0]): score.value
        for score in scores_of_halves("made", _found(shares))
    }
    assert scores["seems to hold, target 0.2", "of"] < 0.7
    assert scores["shown to hold, target 0.2", "of"] >= 0.9  # what its bound promises


def test_no_earthquake_is_on_both_sides_of_a_split():
    events = tuple(f"earthquake {k // 3}" for k in range(21))
    sample = ClusterSample(tuple(f"station {k}" for k in range(21)), events)
    here, elsewhere = split(sample, np.random.default_rng(1))
    assert sorted([*here, *elsewhere]) == list(range(21))
    assert not {events[place] for place in here} & {events[place] for place in elsewhere}
    assert len({events[place] for place in here}) == 3
