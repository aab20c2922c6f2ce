"""The interval of the annual rate: truths of closed form, what a site's curve comes down to, and the least reach."""

import math

import numpy as np
import pytest
from scipy.special import gamma

from docs.research import rates
from docs.research.fragilities import RealSites
from docs.research.rates import (
    POPULATIONS,
    bounds,
    interval_scores,
    least_reach,
    rates_of_sites,
    study_scores,
)
from rocking.earthquakes.sample import ClusterSample

SLOPE = 1.5
CLOSED_FORM = {
    "lognormal, β 0.4": 3.0**-SLOPE * math.exp((SLOPE * 0.4) ** 2 / 2),
    "tail to the weak side": gamma(9 - SLOPE) / gamma(9),
    "heavy tails": math.pi * 0.2 * SLOPE / math.sin(math.pi * 0.2 * SLOPE),
    "one in three stronger": (2 / 3 + 2**-SLOPE / 3) * math.exp((SLOPE * 0.25) ** 2 / 2),
    "one in ten weaker": (0.9 + 0.1 * 0.6**-SLOPE) * math.exp((SLOPE * 0.4) ** 2 / 2),
    "a plateau of 0.4": 0.4 * math.exp((SLOPE * 0.5) ** 2 / 2),
    "none beyond a range": (2**SLOPE - 2**-SLOPE) / (2 * SLOPE * math.log(2)),
}


@pytest.mark.parametrize("name", CLOSED_FORM)
def test_a_population_has_the_mean_rate_of_its_closed_form(name):
    drawn = POPULATIONS[name](np.random.default_rng(1), 400_000, SLOPE)
    # Five standard errors of the mean of so many.
    assert drawn.mean() == pytest.approx(CLOSED_FORM[name], abs=5 * drawn.std() / math.sqrt(drawn.size))


def test_a_dip_takes_away_from_a_rate_and_never_all_of_it():
    drawn = POPULATIONS["a dip in every second"](np.random.default_rng(1), 100_000, SLOPE)
    whole = 1.5**-SLOPE * math.exp((SLOPE * 0.4) ** 2 / 2)
    assert drawn.min() > 0 and 0.7 * whole < drawn.mean() < whole


@pytest.mark.parametrize("known", [False, True])
def test_an_efficient_estimate_of_many_stations_reaches_the_bound(known):
    """That of maximum likelihood, of 2000 stations; its deviation from 4000 samples is within 5 % in all but few."""
    slope, dispersion, count = 2.5, 0.5, 2000
    rng = np.random.default_rng(3)
    logs = np.array([dispersion * rng.standard_normal(count) for _ in range(4000)])
    squares = dispersion**2 if known else logs.var(axis=1)
    estimates = -slope * logs.mean(axis=1) + slope**2 * squares / 2
    reach = math.exp(1.6449 * estimates.std())
    bound = least_reach(slope, dispersion, count, dispersion_is_known=known)
    assert math.log(reach) == pytest.approx(math.log(bound), rel=0.05)


def test_no_interval_reaches_twice_the_rate_from_twenty_stations_of_a_steep_hazard():
    assert least_reach(3.5, 0.5, 20) > 2.7
    assert least_reach(3.5, 0.5, 43) > 2 > least_reach(3.5, 0.5, 44)
    assert least_reach(3.5, 0.5, 20, dispersion_is_known=True) < 2
    assert all(row.value > 1 for row in bounds())


def test_a_site_that_overturns_from_a_level_upwards_has_the_hazard_of_that_level():
    levels = np.geomspace(0.1, 8.0, 400)
    thresholds = np.array([0.5, 1.0, 4.0])
    pool = (levels > thresholds[:, None]).astype(float)
    found = rates_of_sites(levels, pool, SLOPE)
    # A level lies within 1.1 % of the next, and a step of the integral is 1.3 %.
    assert found == pytest.approx((thresholds / 0.05) ** -SLOPE, rel=0.04)


def test_the_scores_count_what_they_name(monkeypatch):
    """Stations that all have one rate: the interval is that rate; a truth beside it is missed to one side."""
    monkeypatch.setattr(rates, "TRIALS", 5)
    monkeypatch.setattr(rates, "STATIONS", (8,))

    def alike(rng: np.random.Generator, count: int) -> np.ndarray:
        return np.full(count, 0.01)

    above = {row.measure: row.value for row in interval_scores("alike", SLOPE, 0.02, alike)}
    assert above == pytest.approx(
        {
            "intervals that hold the rate": 0,
            "rate above the interval": 1,
            "rate below the interval": 0,
            "high end over rate": 1,
        }
    )
    below = {row.measure: row.value for row in interval_scores("alike", SLOPE, 0.005, alike)}
    assert below["rate below the interval"] == 1


def test_a_rate_is_told_where_the_factor_of_a_study_reaches_and_else_its_ends(monkeypatch):
    """Of equal sites all or none reach the level at which half of the rate is made."""
    monkeypatch.setattr(rates, "REAL_TRIALS", 4)
    monkeypatch.setattr(rates, "STATIONS", (8,))
    levels = np.geomspace(0.1, 8.0, 60)
    curves = np.tile((levels > 1.0).astype(float), (8, 1))
    for limit, told in ((4.0, 1.0), (0.5, 0.0)):
        pool = RealSites(
            levels, curves, np.where(levels > limit, np.nan, curves), ClusterSample.scattered("abcdefgh")
        )
        found = {row.measure: row.value for row in study_scores("alike", SLOPE, pool)}
        assert found["rates that are told"] == told
        held = "intervals that hold the rate" if told else "ends that hold the rate where it is not told"
        assert found[held] == 1
