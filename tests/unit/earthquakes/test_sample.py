"""The sample behind a figure: who is of one earthquake, and intervals against laws and truths that are known."""

from dataclasses import dataclass
from functools import partial

import numpy as np
import pytest
from scipy.stats import beta, t

from docs.research.earthquakes import sample_of, weighted_median
from rocking.earthquakes.kinds import SampleKind
from rocking.earthquakes.sample import CORRELATION, FEWEST, ClusterSample, earthquakes_of, interval_words
from rocking.errors import ConfigurationError
from rocking.records import Accelerogram
from tests.refusals import refused


@dataclass
class Named:
    """What names a record."""

    event: str = ""
    station: str = ""
    event_time: str = ""


@pytest.mark.parametrize(("names", "first"), [
    (["Northridge-01 1994-01-17 M6.69", "NORTHRIDGE EQ 1/17/94", "Northridge-01"], [0, 0, 0]),
    (["Kobe Japan 1995-01-16 M6.9", "KOBE 01/16/95 2046"], [0, 0]),
    (["LANDERS 06/28/92 1158", "LANDERS 7/23/92 18:49"], [0, 0]),  # headers of one earthquake, one misdated
    (["Erzincan Turkey 1992-03-13", "Erzican Turkey"], [0, 0]),
    (["Norcia 2016-10-30T06:40", "Norcia 2016-10-30"], [0, 0]),
    (["Van 2011", "VAN TURKEY 10/23/11"], [0, 0]),
    (["Imperial Valley-06", "Imperial Valley-02", "IMPERIAL VALLEY 10/15/79 2316"], [0, 1, 0]),
    (["Imperial Valley 1979", "Imperial Valley 1940"], [0, 1]),
    (["Central Italy 2016-08-24", "Central Italy 2016-10-30"], [0, 1]),
    (["EMSC-20161030_0000029", "EMSC-20160824_0000006"], [0, 1]),
    (["us1000778i", "us7000abcd"], [0, 1]),
    (["event 1", "event 2", "event 1"], [0, 1, 0]),
    (["Emilia 1", "Emilia 2", "Emilia"], [0, 1, 0]),
    (["Emilia 2012-02-30", "Emilia 2012-02-29"], [0, 0]),  # no day: a name without one
    (["Emilia 2012-05-28", "Emilia 2012-05-29", "Emilia 2012-05-30"], [0, 0, 0]),  # local and universal time
    (["Emilia 1/2/30", "Emilia 1930", "Emilia 2030"], [0, 0, 2]), (["Emilia 1/2/29", "Emilia 2029"], [0, 0]),
    (["Emilia-007", "Emilia 7", "Emilia-70"], [0, 0, 2]), (["", "Emilia", " "], [0, 1, 0]),
    (["the earthquake of Amatrice", "Amatrice", "Amat", "Amandola"], [0, 0, 0, 3]), (["Ort", "Orte"], [0, 0]),
])  # fmt: skip
def test_names_of_one_earthquake_are_one_and_of_two_are_two(names, first):
    assert earthquakes_of([Named(event=name) for name in names]) == [names[place].strip() for place in first]


def test_what_says_one_time_is_one_earthquake_by_whatever_name_and_of_two_days_two():
    """Within five minutes; of one name on other days the later bears its day."""
    times = ["2016-10-30T06:40:18", "2016-10-30 06:45:18", "2016/10/30 06:50:18", "2016-10-30T06:55:19"]
    assert earthquakes_of([Named(event_time=time) for time in times]) == [times[0]] * 3 + [times[3]]
    first, second = Named("Norcia", "A", times[0]), Named("Central Italy", "B", times[1])
    assert earthquakes_of([first, second]) == ["Norcia", "Norcia"]
    days = [Named("Emilia", "A", f"2012-05-{day}") for day in (20, 29, 20)]
    assert earthquakes_of(days) == ["Emilia", "Emilia, 2012-05-29", "Emilia"]


def test_what_names_no_earthquake_counts_as_one_unless_each_is_declared():
    records = [Named(station=name) for name in "abc"] + [Named("Kobe", "d")]
    told = ClusterSample.of(records)
    assert (told.count, told.earthquakes) == (4, 2)
    assert [warning.kind for warning in told.warnings] == [
        SampleKind.EARTHQUAKES_UNNAMED,
        SampleKind.EARTHQUAKES_FEW,
    ]
    assert told.warnings[0]["records"] == 3
    declared = ClusterSample.of(records, each_unnamed=True)
    assert declared.earthquakes == 4


def test_one_event_for_all_says_that_nothing_is_told_of_others():
    sample = ClusterSample.of([Named("Kobe", name) for name in "abcdef"])
    assert [warning.kind for warning in sample.warnings] == [SampleKind.EARTHQUAKE_ONE]
    assert sample.interval(lambda weights: float(weights.sum())) == (0.0, np.inf)
    low, high = sample.share_bounds(np.array([1.0, 0, 0, 0, 0, 0]))
    assert (low, high) == (0, 1)


def test_a_motion_under_two_earthquakes_is_named():
    wave = np.sin(np.arange(100) / 5)
    records = [Accelerogram(wave, 0.01, station="a", event=event) for event in ("Kobe", "Landers")]
    twice = next(
        warning
        for warning in ClusterSample.of(records).warnings
        if warning.kind is SampleKind.EARTHQUAKE_NAMED_TWICE
    )
    assert (twice["first"], twice["second"]) == ("Kobe", "Landers")


def test_a_station_that_is_given_for_two_earthquakes_counts_for_the_first():
    sample = ClusterSample.of([Named(), Named(), Named()], ["a", "a", "b"], ["one", "two", "two"])
    assert sample.events == ("one", "one", "two")
    assert sample.warnings[0].kind is SampleKind.STATION_OF_TWO_EARTHQUAKES


def test_components_and_processings_of_a_station_are_one():
    names = ["Rinaldi Receiving Sta", "RINALDI RECEIVING STA RRS", "Sylmar"]
    sample = ClusterSample.of([Named("Northridge", name) for name in names])
    assert sample.words == "2 stations of 1 earthquake"
    unnamed = [Named("Kobe"), Named("Kobe"), Named("Kobe")]
    assert ClusterSample.of(unnamed, rows=["r1", "r1", "r2"]).count == 2


def test_as_many_names_as_records_are_asked_for():
    with refused(ConfigurationError, "events", 1):
        ClusterSample.of([Named(), Named()], events=["one"])
    with refused(ConfigurationError, "events", 1):
        ClusterSample(("a", "b"), ("one",))


def test_the_bounds_of_scattered_stations_are_those_of_clopper_and_pearson():
    shares = np.array([1.0, 0.5] + [0.0] * 18)
    low, high = ClusterSample.scattered(range(20)).share_bounds(shares, 0.1)
    assert (low, high) == pytest.approx((beta.ppf(0.1, 1.5, 19.5), beta.ppf(0.9, 2.5, 18.5)), rel=1e-9)


def test_the_bounds_of_few_earthquakes_are_those_of_clopper_and_pearson_on_them():
    shares = np.array([1.0, 1.0, 1.0, 0, 0, 0, 0, 0, 0, 0, 0, 0])
    low, high = sample_of(FEWEST - 1, 3).share_bounds(shares)
    assert (low, high) == pytest.approx((beta.ppf(0.05, 1, 4), beta.ppf(0.95, 2, 3)), rel=1e-9)


def test_stations_that_agree_in_each_earthquake_tell_as_much_as_one():
    """Eight earthquakes of five stations, all alike in each: eight observations, with seven degrees of freedom."""
    shares = np.repeat([1.0, 1, 0, 0, 0, 0, 0, 0], 5)
    low, high = sample_of(8, 5).share_bounds(shares)
    number = 8 * (t.ppf(0.95, 39) / t.ppf(0.95, 7)) ** 2
    ends = beta.ppf(0.05, number / 4, 3 * number / 4 + 1), beta.ppf(0.95, number / 4 + 1, 3 * number / 4)
    assert (low, high) == pytest.approx(ends, rel=1e-9)


def test_a_further_fall_never_lowers_the_bound():
    """Where none falls the correlation within an earthquake is not seen, and is taken to be that of the least."""
    sample = sample_of(8, 5)
    shares = np.zeros(40)
    before = float(sample.share_bounds(shares)[1])
    number = 40 / (1 + 4 * CORRELATION) * (t.ppf(0.95, 39) / t.ppf(0.95, 7)) ** 2
    assert before == pytest.approx(beta.ppf(0.95, 1, number), rel=1e-9)
    for place in (0, 7, 14, 21, 1, 2, 3, 4):
        shares[place] = 1.0
        bound = float(sample.share_bounds(shares)[1])
        assert bound >= before
        before = bound


def test_the_interval_of_few_earthquakes_is_that_of_student_on_their_logarithms():
    values = np.array([1.0, 1.2, 2.0, 2.2, 0.9, 0.8])
    sample = sample_of(3, 2)
    statistic = partial(weighted_median, values)
    logs = np.log(
        [statistic(np.array(own)) for own in ([1, 1, 0, 0, 0, 0], [0, 0, 1, 1, 0, 0], [0, 0, 0, 0, 1, 1])]
    )
    assert np.isnan(sample_of(8, 5).interval(lambda _weights: np.nan)).all()
    alone = ClusterSample.scattered("a").spread(np.ones(1))
    assert alone.reach() == np.inf and np.isnan(alone.error)
    reach = t.ppf(0.95, 2) * logs.std(ddof=1) / 3**0.5
    middle = np.log(statistic(np.ones(6)))
    assert sample.interval(statistic) == pytest.approx(np.exp([middle - reach, middle + reach]), rel=1e-9)


def test_each_draw_has_as_many_stations_of_as_many_earthquakes():
    sample = ClusterSample.of(
        [Named("Kobe", "a"), Named("Kobe", "b"), Named("Landers", "c"), Named("Erzincan", "d")]
    )
    drawn = sample.redrawn(500)
    of_events = np.array([drawn[:, sample.of_station == event].sum(axis=1) for event in range(3)]).T
    # an earthquake that is drawn n times has n times as many draws of its stations as it has
    assert np.all(of_events % sample.sizes == 0)
    assert np.all((of_events / sample.sizes).sum(axis=1) == 3)
    assert drawn[:, 0].std() > drawn[:, 2].std() * 0.9


def test_the_mean_of_means_scatters_as_by_hand():
    """Two stations of one and one of two further earthquakes: weights ½, ¼, ¼."""
    sample = ClusterSample(tuple("abcd"), ("one", "one", "two", "three"))
    spread = sample.spread(np.array([1.0, 3.0, 4.0, 8.0]))
    assert spread.mean == 4.0 and spread.count == pytest.approx(8 / 3)
    squares = 0.5 * (2 - 4) ** 2 + 0.25 * 0 + 0.25 * (8 - 4) ** 2
    assert spread.deviation == pytest.approx((squares / (1 - 0.375)) ** 0.5)
    assert spread.error == pytest.approx(spread.deviation / (8 / 3) ** 0.5)


@pytest.mark.parametrize("earthquakes", [4, pytest.param(8, marks=pytest.mark.slow)])
def test_the_interval_of_a_median_holds_it_with_few_earthquakes_of_several_stations(earthquakes):
    """Half of the variance is between earthquakes. Asked: 85 % of 60; by stations as if independent far fewer hold."""
    rng = np.random.default_rng(3)
    held = np.zeros((60, 2))
    for trial in range(60):
        between = rng.standard_normal((earthquakes, 1))
        logs = 0.4 * (between + rng.standard_normal((earthquakes, 5))).ravel() / 2**0.5
        for column, alone in enumerate((False, True)):
            low, high = sample_of(earthquakes, 5, alone).interval(partial(weighted_median, np.exp(logs)))
            held[trial, column] = low <= 1.0 <= high
    inside, as_if = held.mean(axis=0)
    assert inside >= 0.85 and as_if < inside - 0.1


def test_the_order_of_the_catalogue_draws_no_other_samples():
    """Each station is drawn as often, wherever it stands; by the share of its draws that are zero, one, two, ..."""
    stations, events = tuple("abcdefg"), tuple("XXYZZZY")
    order = np.random.default_rng(2).permutation(7)
    drawn = ClusterSample(stations, events).redrawn(200)
    again = ClusterSample(
        tuple(stations[place] for place in order), tuple(events[place] for place in order)
    ).redrawn(200)
    assert np.array_equal(again, drawn[:, order])


@pytest.mark.parametrize(
    ("earthquakes", "words"),
    [
        (1, "interval, which one earthquake does not give"),
        (FEWEST - 1, "interval of 4 earthquakes, which holds less than nine times in ten"),
        (FEWEST, "90 % interval"),
    ],
)
def test_an_interval_is_called_by_how_many_earthquakes_are_behind_it(earthquakes, words):
    assert interval_words(earthquakes) == words
