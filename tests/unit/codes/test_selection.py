"""Sets of records for a design level: their limits by another routine, their stations, their seed, what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from rocking import DesignSpectrum, select
from rocking.codes.kinds import CheckKind
from rocking.codes.selection import random_sets, search
from rocking.errors import ConfigurationError
from tests.made_pools import made_pool
from tests.oracles.oscillator import spectral_acceleration

SPECTRUM = DesignSpectrum.ntc(2.0, 2.5, 0.4)
LIMITS = {"below": 0.25, "above": 0.35}
"""Wider than the code's: the made records are fewer and more alike than natural ones."""


@pytest.fixture(scope="module")
def pool():
    return made_pool(30)


@pytest.fixture(scope="module")
def selection(pool):
    return select(pool, SPECTRUM, 10, sets=40, seed=3, **LIMITS)


def test_the_mean_spectrum_computed_anew_lies_within_the_limits(pool, selection):
    """By matrix exponentials; both routines miss a peak between two steps by about 1 %."""
    periods = selection.periods[::20]
    anew = {}
    for place in {*selection.chosen, *selection.sets[:2].ravel()}:
        pair = pool[selection.names[place]]
        factor = selection.factors[place]
        of_pair = [
            [
                factor * spectral_acceleration(component.acceleration, component.time_step, period, 0.05)
                for period in periods
            ]
            for component in pair
        ]
        anew[place] = np.mean(of_pair, axis=0)
        np.testing.assert_allclose(anew[place], selection.spectra[place][::20], rtol=0.015)
    target = SPECTRUM.acceleration(periods)
    for places in (selection.chosen, *selection.sets[:2]):
        ratio = np.mean([anew[place] for place in places], axis=0) / target
        assert (ratio > 0.74).all() and (ratio < 1.37).all()


def test_every_set_has_one_pair_a_station_and_is_another_one(pool, selection):
    """Three more records of each of two stations never meet one another."""
    more = dict(pool)
    for number in (0, 1):
        more |= {
            f"again {number} {k}": [item.scaled(1 + 0.1 * k) for item in pool[f"R{number}"]] for k in range(3)
        }
    several = select(more, SPECTRUM, 10, sets=40, seed=3, **LIMITS)
    stations = np.array(several.stations)
    assert {"again 0 1", "again 1 2"} & {several.names[place] for place in several.sets.ravel()}
    for places in (several.chosen, *several.sets):
        assert len(set(stations[places])) == 10
    assert len({tuple(places) for places in selection.sets}) == len(selection.sets) == 40


def test_a_station_under_two_names_is_one(pool):
    """Two catalogues that name an earthquake and a station otherwise; a number that differs is another station."""
    names = {
        "one": ("Northridge-01 1994-01-17", "Rinaldi Receiving Sta RRS"),
        "again": ("NORTHRIDGE EQ 1/17/94", "Rinaldi Receiving Sta"),
        "elsewhere": ("Kobe", "Rinaldi Receiving Sta X"),
        "array 1": ("Northridge-01", "El Centro Array #1"),
        "array 10": ("Northridge-01", "El Centro Array #10"),
        "unnamed": ("", ""),
    }
    records = {
        name: [replace(component, event=event, station=station, network="") for component in pair]
        for (name, (event, station)), pair in zip(names.items(), pool.values(), strict=False)
    }
    one, again, *others = select(records, SPECTRUM, 1, below=0.9, above=9.0).stations
    assert one == again
    assert len({one, *others}) == 5


def test_one_motion_under_two_names_is_one_station(pool):
    """A file that two catalogues list, here as another station, does not count twice; another one does."""
    first, second, *_ = pool.values()
    renamed = [replace(row, event="Manjil", station="Abbar") for row in first]
    named = [replace(one_row, event="MANJIL 06/20/90", station="MANJIL") for one_row in first]
    stations = select(
        {"one": renamed, "again": named, "other": second}, SPECTRUM, 1, below=0.9, above=9.0
    ).stations
    assert stations[0] == stations[1] != stations[2]


def test_the_same_seed_gives_the_same_sets(pool, selection):
    again = select(pool, SPECTRUM, 10, sets=40, seed=3, **LIMITS)
    np.testing.assert_array_equal(again.sets, selection.sets)
    np.testing.assert_array_equal(again.chosen, selection.chosen)
    other = select(pool, SPECTRUM, 10, sets=40, seed=4, **LIMITS)
    assert not np.array_equal(other.sets, selection.sets)


def test_factors_stay_within_their_limits_and_scale_what_is_followed(pool):
    narrow = select(pool, SPECTRUM, 10, sets=5, factors=(0.8, 1.25), below=0.9, above=2.0)
    assert narrow.factors.min() >= 0.8 and narrow.factors.max() <= 1.25
    every = np.ones(narrow.sample.count, dtype=int)
    assert len(narrow.redrawn(every, np.random.default_rng(0), tries=3000, most=2500)) == 2500
    few = np.where(np.arange(every.size) < 9, every, 0)
    assert narrow.redrawn(few, np.random.default_rng(0)).shape == (0, 10)
    place = int(narrow.chosen[0])
    first = narrow.scaled(place)[0]
    np.testing.assert_allclose(
        first.acceleration, narrow.factors[place] * narrow.pairs[place][0].acceleration
    )
    assert f"factors from {narrow.factors[narrow.chosen].min():.3g}" in narrow.words


@pytest.mark.parametrize(
    ("options", "sentence"),
    [
        ({"stations": 31}, "a set of 31 needs as many"),
        ({"below": 0.001, "above": 0.001, "tries": 4000}, "of 4000 drawn; the nearest"),
        ({"periods": (2.0, 0.5)}, "periods is 2 to 0.5 s, but must go from above 0 to a longer one"),
        ({"factors": (0.0, 2.0)}, "factors is 0 to 2, but must go from above 0"),
        ({"stations": 0}, "stations is 0, but must be greater than 0"),
    ],
)
def test_what_cannot_be_met_is_refused_in_a_sentence(pool, options, sentence):
    with pytest.raises(ConfigurationError) as error:
        select(pool, SPECTRUM, **({"stations": 10} | options))
    assert sentence in str(error.value)


def test_the_nearest_set_is_the_one_whose_excess_is_least():
    """Of four records in sets of three the mean of 1, 1 and 1.2 lies nearest to nothing above 5 %."""
    ratios = np.array([[1.0], [1.0], [1.2], [2.0]])
    with pytest.raises(ConfigurationError) as none_near:
        search(ratios, random_sets(np.array(list("abcd")), 3, 2000, np.random.default_rng(0)), 0.05, 0.05)
    warning = none_near.value.warning
    assert warning.kind is CheckKind.NO_SET_WITHIN
    # (1 + 1 + 1.2)/3 − 1
    assert warning["low_percent"] == warning["high_percent"] == pytest.approx(100 * 0.2 / 3)


def test_its_words_say_the_periods_that_were_asked_for_and_the_factors(pool):
    own = select(pool, SPECTRUM, 10, periods=(0.2, 1.5), sets=2, seed=3, **LIMITS)
    used = [own.factors[place] for place in own.chosen]
    assert own.words.startswith("10 records of as many stations out of 30 of 30 stations of 30 earthquakes; ")
    assert "of the target from 0.2 to 1.5 s; " in own.words
    assert f"factors from {min(used):.3g} to {max(used):.3g}, median {np.median(used):.3g}; " in own.words


def test_as_many_random_sets_are_drawn_as_are_asked_for():
    stations = np.array(list("aabcde"))
    drawn = np.concatenate(list(random_sets(stations, 3, 2300, np.random.default_rng(1))))
    assert drawn.shape == (2300, 3)
    assert all(len(set(stations[places])) == 3 for places in drawn)
