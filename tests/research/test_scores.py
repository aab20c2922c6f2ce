"""Scores and the fit of probabilities: against scipy and planted truths; and what counts as a site."""

import numpy as np
import pytest
from scipy.optimize import minimize

from docs.research import scores
from docs.research.scores import HAPPENED, logistic, logit_slope
from docs.research.sites import independent, spread
from rocking.earthquakes.sample import ClusterSample
from rocking.records import Accelerogram


def planted(many: int) -> tuple[np.ndarray, np.ndarray]:
    """A design, and outcomes of log odds 2 x − 1."""
    rng = np.random.default_rng(7)
    x = rng.normal(size=many)
    fallen = rng.random(many) < 1 / (1 + np.exp(1 - 2 * x))
    return np.column_stack([np.ones(many), x]), fallen


def test_the_fit_is_the_maximum_of_the_likelihood():
    """Of scipy's simplex, which knows no derivative; the penalty moves it by less than its tolerance."""
    design, fallen = planted(2000)
    signs = np.where(fallen, -1, 1)
    oracle = minimize(
        lambda b: np.logaddexp(0, signs * (design @ b)).sum(),
        np.zeros(2),
        method="Nelder-Mead",
        options={"xatol": 1e-7, "fatol": 1e-9},
    )
    assert logistic(design, fallen) == pytest.approx(oracle.x, abs=1e-3)


def test_what_is_said_as_it_is_has_slope_one():
    design, fallen = planted(20_000)
    odds = 2 * design[:, 1] - 1
    every = np.arange(20_000)
    # the standard error of the slope is 0.02 here
    assert logit_slope(odds, fallen.astype(float))(every) == pytest.approx(1.0, abs=0.06)
    assert logit_slope(2 * odds, fallen.astype(float))(every) == pytest.approx(0.5, abs=0.03)


def test_intervals_draw_whole_sites():
    """Ten cases of one site are one draw: the interval is as wide as for ten times fewer cases."""
    many = np.repeat(np.random.default_rng(2).random(40), 10)
    sites = np.arange(400), np.repeat(np.arange(40), 10)
    rows = [next(scores.scored("", "", {"mean": many}, labels, 2000)) for labels in sites]
    narrow, wide = (row.value_high - row.value_low for row in rows)
    assert wide / narrow == pytest.approx(np.sqrt(10), rel=0.15)
    assert wide == pytest.approx(2 * 1.645 * many.std() / np.sqrt(40), rel=0.15)


def test_intervals_draw_whole_earthquakes_and_what_none_shows_has_the_bounds_of_a_share():
    """Stations that say what their earthquake does have the interval of the earthquakes, by an oracle of draws."""
    of_earthquakes = np.random.default_rng(2).random(20)
    sample = ClusterSample.named((str(place), str(place // 4)) for place in range(80))
    (row,) = scores.scored("", "", {"mean": np.repeat(of_earthquakes, 4)}, sample)
    means = np.random.default_rng(5).choice(of_earthquakes, (4000, 20)).mean(axis=1)
    oracle = np.quantile(means, (0.05, 0.95))
    # The ends lie farther out by what 20 hide: Student's 1.73 for 1.64, and the root of 20/19.
    assert row.value_high - row.value_low == pytest.approx(1.08 * np.ptp(oracle), rel=0.08)
    assert (row.sites, row.earthquakes, row.cases) == (80, 20, 80)
    (none,) = scores.scored("", "", {"falls": np.zeros(80)}, sample)
    # No better than 20 independent trials of which none falls, no worse than four times fewer stations.
    assert none.value_low == 0 and 1 - 0.05 ** (1 / 80) < none.value_high < 1 - 0.05 ** (1 / 20)


def test_reliability_counts_every_case_once():
    draw = np.random.default_rng(3)
    probability, sites = draw.random(200), [str(k // 5) for k in range(200)]
    outcomes = (draw.random(200) < probability).astype(float)
    rows = scores.reliability("a", "b", probability, outcomes, sites, (0.0, 0.2, 0.5, 1.0))
    happened = [row for row in rows if row.measure == HAPPENED]
    assert sum(event.cases for event in happened) == 200
    assert sum(one_event.cases * one_event.value for one_event in happened) == pytest.approx(outcomes.sum())
    assert all(
        other_event.value_low <= other_event.value <= other_event.value_high for other_event in happened
    )


def test_a_site_under_two_names_counts_once():
    def record(event: str, station: str, component: str) -> Accelerogram:
        return Accelerogram(np.sin(np.arange(300) / 10), 0.01, component, event=event, station=station)

    rinaldi = ("Northridge-01 1994-01-17 M6.69", "Rinaldi Receiving Sta RRS")
    listed = [
        ("a", record(*rinaldi, "228")),
        ("b", record(*rinaldi, "318")),
        ("c", record(*rinaldi, "228")),
        ("d", record("NORTHRIDGE EQ 1/17/94", "Rinaldi Receiving Sta", "x")),
        ("e", record("NORTHRIDGE EQ 1/17/94", "CANYON COUNTRY", "y")),
        ("f", record("Landers", "Rinaldi Receiving Sta", "y")),
    ]
    assert [component.identifier for component in independent(listed)] == ["a", "b", "e", "f"]


def test_a_share_of_the_sites_has_as_many_earthquakes_as_can_be():
    """One site of each first; all components of what is taken, in the catalogue that they are of."""

    def record(event: str, station: str, component: str) -> Accelerogram:
        return Accelerogram(np.sin(np.arange(300) / 10), 0.01, component, event=event, station=station)

    near = [("a", record("Kobe", "KJMA", "0")), ("b", record("Kobe", "KJMA", "90"))]
    near += [("c", record("Kobe", "Takatori", "0"))]
    far = [("d", record("Landers", "Lucerne", "0")), ("e", record("Landers", "Yermo", "0"))]
    taken = [
        [[name for name, _ in records] for records in spread([near, far], most)] for most in (1, 2, 3, 9)
    ]
    assert taken == [
        [["a", "b"], []],
        [["a", "b"], ["d"]],
        [["a", "b", "c"], ["d"]],
        [["a", "b", "c"], ["d", "e"]],
    ]


def test_a_score_counts_the_cases_that_tell_it():
    """Cases of nan count nowhere: neither as cases nor by their sites and earthquakes."""
    sample = ClusterSample(("a", "a", "b", "c"), ("one", "one", "one", "two"))
    (told,) = scores.scored("s", "p", {"m": [1.0, np.nan, 0.0, np.nan]}, sample)
    assert (told.value, told.cases, told.sites, told.earthquakes) == (0.5, 2, 2, 1)
    (none,) = scores.scored("s", "p", {"m": [np.nan] * 4}, sample)
    assert (none.cases, none.sites, none.earthquakes) == (0, 0, 0) and np.isnan(none.value)
