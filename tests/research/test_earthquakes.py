"""Intervals over earthquakes: what is drawn has the scatter that it names, and coverage is counted as it is named."""

import numpy as np
import pytest

from docs.research import earthquakes
from docs.research.earthquakes import POPULATIONS, made_scores, real_scores, sample_of, weighted_median
from docs.research.fragilities import RealSites


@pytest.mark.parametrize(
    ("name", "alike"),
    [("normal, a fifth between earthquakes", 0.2), ("normal, half between earthquakes", 0.5)],
)
def test_stations_of_an_earthquake_are_alike_by_the_part_named(name, alike):
    drawn = POPULATIONS[name](np.random.default_rng(1), 40_000, 2)
    # Five standard errors of a correlation of so many pairs are 2.5 %.
    assert np.corrcoef(drawn.T)[0, 1] == pytest.approx(alike, abs=0.025)
    assert drawn.std() == pytest.approx(0.4, rel=0.02)


def test_a_weighted_median_is_that_of_the_repeated_values():
    values = np.array([3.0, 1.0, 2.0, 5.0])
    assert weighted_median(values, np.array([1.0, 1, 1, 0])) == pytest.approx(2.0)
    assert weighted_median(values, np.array([1.0, 0, 1, 0])) == pytest.approx(6**0.5)


def test_a_sample_of_earthquakes_and_one_as_if_independent():
    assert sample_of(3, 2).words == "6 stations of 3 earthquakes"
    assert sample_of(3, 2, alone=True).earthquakes == 6


def test_what_is_always_the_truth_is_always_held(monkeypatch):
    for name, value in (
        ("TRIALS", 3),
        ("MEDIANS", 2),
        ("MANY", 20),
        ("EARTHQUAKES", (4,)),
        ("STATIONS", (2,)),
    ):
        monkeypatch.setattr(earthquakes, name, value)

    def alike(rng, count, stations):
        return np.full((count, stations), -0.2)

    told = {(row.part, row.measure): row.value for row in made_scores("alike", alike)}
    held = [value for (_, measure), value in told.items() if measure.startswith(("median", "expected"))]
    assert held == [1.0] * 3
    levels = np.geomspace(0.1, 10, 20)
    pool = np.tile((levels > 1.0).astype(float), (6, 1))
    sample = sample_of(3, 2)
    rows = list(real_scores("alike", RealSites(levels, pool, pool, sample)))
    # Rates that are all one have an interval of one number, which rounding may miss.
    certain = [row for row in rows if row.measure.startswith(("median", earthquakes.TOLD))]
    assert [row.value for row in certain] == [1.0] * 3
